//! glTF 2.0, as text and binary (Khronos Group, *glTF 2.0 Specification*).
//!
//! The crate `gltf` 1.4 is not used. It rejects documents for faults that do not concern triangles: a byte order mark,
//! an unknown extension of a material, missing bounds. It truncates its messages and rounds the numbers of nodes to
//! single precision. Its iterators assume that an accessor lies within its view.

mod document;
mod elements;
mod placed;

use std::path::Path;

use super::Loaded;
use super::draft::{Draft, of_strip};
use super::error::{Fault, Place, ReadError};
use super::float::Position;
use super::note::NoteKind;
use super::number::Number;
use super::text::quote;
use document::{Primitive, entry, is_known};
use elements::{Elements, Store, Use};
use placed::{Map, Node};

/// The maximum number of triangles and of primitives. Nodes may repeat a mesh, so a small file could request any
/// number.
const MOST: usize = 1 << 26;

/// Reads the mesh of all nodes of a scene from the bytes of a `.gltf` or `.glb` file.
///
/// It reads the file's default scene, or the first one. Each node's mesh is transformed by the node and its ancestors,
/// in double precision. A coordinate counts as rounded if any step of that rounds. Each node is a part.
///
/// Supported: triangles, strips and fans, with coordinates that are floats or short integers (`KHR_mesh_quantization`),
/// sparse accessors, and instances (`EXT_mesh_gpu_instancing`). Notes count points, lines, skins, morph targets and
/// unknown extensions, which are skipped. A file that requires an unknown extension is rejected. Buffers are in the
/// file, or in `folder` and its subfolders.
///
/// # Errors
/// [`ReadError`], naming the node or the buffer.
pub fn read_gltf<V: Position>(bytes: &[u8], folder: Option<&Path>) -> Result<Loaded<V>, ReadError> {
    let (document, buffers) = document::read(bytes, folder)?;
    let store = Store { document: &document, buffers: &buffers };
    let mut scene = Scene { store, draft: Draft::<V>::new(0, 0), primitives: 0 };
    for name in document.extensions_used.iter().filter(|name| !is_known(name)) {
        scene.draft.notes.add(NoteKind::Extension, 1, || format!("is {}", quote(name)));
    }
    let count = document.nodes.len();
    let mut is_met = vec![false; count];
    let roots = document.roots().map_err(|fault| fault.at(Place::Document))?;
    let mut pending: Vec<_> = roots.iter().rev().map(|&node| (node, Map::IDENTITY)).collect();
    while let Some((index, above)) = pending.pop() {
        let at = |fault: Fault| fault.at(Place::of("node", index, count));
        let node = entry(&document.nodes, index, "node").map_err(at)?;
        // Nodes must form trees. A cycle would not end.
        if std::mem::replace(&mut is_met[index], true) {
            return Err(at(Fault::unexpected("a node below two others", "one above each")));
        }
        let to_world = above.after(&node.map());
        scene.add(index, node, &to_world).map_err(at)?;
        pending.extend(node.children.iter().rev().map(|&child| (child, to_world)));
    }
    scene.draft.finish(|_, node| Place::of("node", node as usize, count))
}

struct Scene<'a, V: Position> {
    store: Store<'a>,
    draft: Draft<V>,
    /// Number of primitives so far.
    primitives: usize,
}

impl<V: Position> Scene<'_, V> {
    /// Adds the mesh of a node at each of its places.
    fn add(&mut self, index: usize, node: &Node, to_world: &Map) -> Result<(), Fault> {
        let place = || format!("in {}", Place::of("node", index, self.store.document.nodes.len()));
        self.draft.notes.add(NoteKind::Skin, node.skin.is_some().into(), place);
        let Some(mesh) = node.mesh else { return Ok(()) };
        let mesh = entry(&self.store.document.meshes, mesh, "mesh")?;
        self.draft.part(node.name.clone().unwrap_or_else(|| format!("node {index}")));
        places(self.store, node, to_world, |map| {
            mesh.primitives.iter().try_for_each(|primitive| self.primitive(index, primitive, map))
        })
    }

    fn primitive(&mut self, node: usize, primitive: &Primitive, to_world: &Map) -> Result<(), Fault> {
        let place = || format!("in {}", Place::of("node", node, self.store.document.nodes.len()));
        self.primitives += 1;
        let (is_list, is_fan) = match primitive.mode {
            0..=3 => {
                self.draft.notes.add(NoteKind::OtherPrimitive, 1, place);
                return self.check(0, 0);
            }
            mode @ 4..=6 => (mode == 4, mode == 6),
            mode => return Err(Fault::unexpected(format!("a primitive of mode {mode}"), "0 to 6")),
        };
        self.draft.notes.add(NoteKind::Morph, (!primitive.targets.is_empty()).into(), place);
        let positions = primitive.attributes.position;
        let positions = positions.ok_or_else(|| Fault::unexpected("a primitive without POSITION", "one with it"))?;
        let positions = self.store.elements(positions, Use::Vectors)?;
        self.check(positions.count, 0)?;
        let first = self.draft.vertices() as u32;
        for own in positions.numbers() {
            self.vertex(own, to_world, node)?;
        }
        let corners: Vec<u32> = match primitive.indices {
            None => (0..positions.count as u32).collect(),
            Some(indices) => self.store.elements(indices, Use::Indices)?.indices().collect(),
        };
        if let Some(found) = corners.iter().find(|&&corner| corner as usize >= positions.count) {
            let expected = format!("0 to {}", positions.count.saturating_sub(1));
            return Err(Fault::Index { found: found.to_string(), expected });
        }
        if is_list && !corners.len().is_multiple_of(3) {
            return Err(Fault::unexpected(format!("{} corners", corners.len()), "three for each triangle"));
        }
        let triangles = if is_list { corners.len() / 3 } else { corners.len().saturating_sub(2) };
        self.check(0, triangles)?;
        for i in 0..triangles {
            let triangle = match (is_list, is_fan) {
                (true, _) => [3 * i, 3 * i + 1, 3 * i + 2],
                (_, true) => [0, i + 1, i + 2],
                _ => of_strip(i),
            };
            self.draft.triangle(triangle.map(|corner| first + corners[corner]));
        }
        Ok(())
    }

    /// Rejects more vertices or triangles than a scene may have.
    fn check(&self, vertices: usize, triangles: usize) -> Result<(), Fault> {
        let vertices = self.draft.vertices().saturating_add(vertices);
        let triangles = self.draft.triangles().saturating_add(triangles);
        if triangles.max(vertices / 3).max(self.primitives) <= MOST {
            return Ok(());
        }
        Err(Fault::unexpected("more triangles or primitives", format!("up to {MOST} in all nodes")))
    }

    fn vertex(&mut self, own: [Number<f64>; 3], to_world: &Map, node: usize) -> Result<(), Fault> {
        let moved = if *to_world == Map::IDENTITY { own } else { to_world.point(own) };
        let mut position = [V::Real::default(); 3];
        for (axis, Number { value, error }) in moved.into_iter().enumerate() {
            let number = Number::coordinate(value, axis);
            let number = number.map(|number| Number { error: number.error + error, ..number });
            position[axis] = self.draft.coordinate(axis, number, node as u64)?;
        }
        self.draft.vertex(position);
        Ok(())
    }
}

/// Visits the transforms of a node's mesh: one, or those of its instances.
fn places(
    store: Store<'_>,
    node: &Node,
    to_world: &Map,
    mut visit: impl FnMut(&Map) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let Some(instancing) = &node.extensions.instancing else { return visit(to_world) };
    let read = |accessor: Option<usize>, what| accessor.map(|index| store.elements(index, what)).transpose();
    let of = &instancing.attributes;
    let (translations, scales) = (read(of.translation, Use::Vectors)?, read(of.scale, Use::Vectors)?);
    let rotations = read(of.rotation, Use::Rotations)?;
    let mut counts = [&translations, &rotations, &scales].into_iter().flatten().map(|all| all.count);
    let Some(count) = counts.next() else { return visit(to_world) };
    if let Some(other) = counts.find(|&other| other != count) {
        return Err(Fault::unexpected(format!("instances with {count} and {other} places"), "as many of each"));
    }
    let [mut translations, mut scales] =
        [&translations, &scales].map(|all| all.as_ref().into_iter().flat_map(Elements::numbers::<3>));
    let mut rotations = rotations.as_ref().into_iter().flat_map(Elements::numbers::<4>);
    (0..count).try_for_each(|_| {
        let map = Map::of(translations.next().as_ref(), rotations.next().as_ref(), scales.next().as_ref());
        visit(&to_world.after(&map))
    })
}

#[cfg(test)]
mod tests;

//! glTF 2.0, as text and binary (Khronos Group, *glTF 2.0 Specification*).
//!
//! The crate `gltf` reads the document and knows what it names. The numbers of buffers are read here: its own iterators
//! trust that an accessor lies within its view. So are those of nodes, which it rounds to single precision.

mod placed;

use std::borrow::Cow;
use std::fmt;
use std::path::{Component, Path};

use base64::prelude::{BASE64_STANDARD, Engine as _};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::{Mode, Primitive};
use gltf::{Accessor, Document, Glb, Gltf, Semantic, buffer};
use stackless_bvh::geom::Mesh;

use super::error::{Fault, Place, ReadError};
use super::float::Position;
use super::number::Number;
use super::text::quote;
use super::{Loaded, MOST_BYTES, Rounding, read_bytes};
use placed::{Map, Nodes};

/// Most triangles of a scene. Nodes may repeat a mesh, so that a small file could ask for any number.
const MOST_TRIANGLES: usize = 1 << 26;

/// Reads the mesh that the nodes of a scene make up, from the bytes of a `.gltf` or `.glb` file.
///
/// It is the scene that the file names, or its first. Each node's mesh is moved by the node and all above it, in double
/// precision; a coordinate counts as rounded if a step of that is rounded. Triangles, strips and fans are read; points, lines, skins and morph targets are not ([`Unread`] counts
/// them for [`load`](crate::load)). Buffers are in the file, or in `folder` and those below it.
///
/// # Errors
/// [`ReadError`], naming the node, mesh or buffer.
pub fn read_gltf<V: Position>(bytes: &[u8], folder: Option<&Path>) -> Result<Mesh<V>, ReadError> {
    load(bytes, folder).map(|loaded| loaded.mesh)
}

/// What was not read of the nodes of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unread {
    /// Primitives of points or lines.
    pub primitives: u64,
    /// Skins, and primitives with morph targets. Their triangles are where they are without.
    pub deformations: u64,
}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { primitives, deformations } = *self;
        let of = |count, what| (count > 0).then(|| format!("{count} {what}"));
        let parts =
            [of(primitives, "primitives of points or lines"), of(deformations, "skins and sets of morph targets")];
        write!(f, "not read: {}", parts.into_iter().flatten().collect::<Vec<_>>().join(", "))
    }
}

/// Reads the mesh, and counts what was rounded and what was not read.
pub(crate) fn load<V: Position>(bytes: &[u8], folder: Option<&Path>) -> Result<Loaded<V>, ReadError> {
    let whole = |found: String| Fault::unexpected(found, "a glTF 2.0 document").at(Place::Document);
    // The crate takes the length of the header off it, whatever it is.
    let length = bytes.get(8..12).and_then(|length| length.first_chunk()).map(|length| u32::from_le_bytes(*length));
    if bytes.starts_with(b"glTF") && length.is_none_or(|length| length as usize != bytes.len()) {
        return Err(whole(format!("{} bytes where the header says {}", bytes.len(), length.unwrap_or(0))));
    }
    let refused = |error: gltf::Error| whole(quote(&error.to_string()));
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(refused)?;
    let text = if bytes.starts_with(b"glTF") { Glb::from_slice(bytes).map_err(refused)?.json } else { bytes.into() };
    let maps: Nodes = serde_json::from_slice(&text).map_err(|error| whole(quote(&error.to_string())))?;
    // It looks positions up before it checks that they are there.
    let json = document.into_json();
    let mut attributes = json.meshes.iter().flat_map(|mesh| &mesh.primitives).flat_map(|one| one.attributes.values());
    if let Some(missing) = attributes.find(|accessor| accessor.value() >= json.accessors.len()) {
        return Err(whole(format!("accessor {missing} of {}", json.accessors.len())));
    }
    let document = Document::from_json(json).map_err(refused)?;
    let of = |name: &str, index: usize, count: usize| Place::Element {
        line: None,
        name: name.into(),
        index: index as u64,
        count: count as u64,
    };
    let buffers = document.buffers().map(|buffer| {
        let place = of("buffer", buffer.index(), document.buffers().len());
        read_buffer(&buffer, blob.as_deref(), folder).map_err(|fault| fault.at(place))
    });
    let buffers = buffers.collect::<Result<Vec<_>, _>>()?;
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene = scene.ok_or_else(|| Fault::Ends { expected: "a scene" }.at(Place::Document))?;

    let (rounding, unread) = (Rounding::default(), Unread::default());
    let mut draft = Draft { vertices: Vec::new(), triangles: Vec::new(), rounding, unread };
    let nodes = document.nodes().len();
    let mut is_met = vec![false; nodes];
    let mut pending: Vec<_> = scene.nodes().map(|node| (node, Map::IDENTITY)).collect();
    pending.reverse();
    while let Some((node, above)) = pending.pop() {
        let place = || of("node", node.index(), nodes);
        // Nodes are trees: else there would be no end of them.
        if std::mem::replace(&mut is_met[node.index()], true) {
            return Err(Fault::unexpected("a node below two others", "one above each").at(place()));
        }
        let to_world = above.after(&maps.map(node.index()));
        draft.unread.deformations += u64::from(node.skin().is_some());
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            draft.add(&primitive, &buffers, &to_world).map_err(|fault| fault.at(place()))?;
        }
        let first = pending.len();
        pending.extend(node.children().map(|child| (child, to_world)));
        pending[first..].reverse();
    }
    let Draft { vertices, triangles, rounding, unread } = draft;
    let unread = (unread != Unread::default()).then_some(unread);
    Ok(Loaded { mesh: Mesh::new(vertices, triangles)?, skipped: None, unread, rounding })
}

/// The bytes of a buffer, at least as many as it says.
fn read_buffer<'a>(
    buffer: &buffer::Buffer<'_>,
    blob: Option<&'a [u8]>,
    folder: Option<&Path>,
) -> Result<Cow<'a, [u8]>, Fault> {
    let bytes = match buffer.source() {
        buffer::Source::Bin => Cow::Borrowed(blob.ok_or(Fault::Ends { expected: "the binary part" })?),
        buffer::Source::Uri(uri) => Cow::Owned(match uri.strip_prefix("data:") {
            Some(data) => {
                let base64 = data.split_once(";base64,").map(|(_, base64)| base64);
                let bytes = base64.and_then(|base64| BASE64_STANDARD.decode(base64).ok());
                bytes.ok_or_else(|| Fault::unexpected(quote(uri), "data in base64"))?
            }
            None => read_beside(uri, folder)?,
        }),
    };
    if bytes.len() < buffer.length() {
        return Err(Fault::unexpected(format!("{} bytes", bytes.len()), format!("{}", buffer.length())));
    }
    Ok(bytes)
}

/// The bytes of a file that a document names. It names none outside of its folder.
fn read_beside(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, Fault> {
    let name = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    let is_below = Path::new(&*name).components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    let folder = folder.filter(|_| is_below && !name.contains(':'));
    let folder = folder.ok_or_else(|| Fault::unexpected(quote(uri), "the name of a file in the folder of this one"))?;
    match read_bytes(&folder.join(&*name), MOST_BYTES) {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err(Fault::unexpected(format!("{} of more than {MOST_BYTES} bytes", quote(uri)), "fewer")),
        Err(error) => Err(Fault::unexpected(format!("{}: {error}", quote(uri)), "a file that can be read")),
    }
}

struct Draft<V> {
    vertices: Vec<V>,
    triangles: Vec<[u32; 3]>,
    /// Of coordinates where they have been moved to.
    rounding: Rounding,
    unread: Unread,
}

impl<V: Position> Draft<V> {
    fn add(&mut self, primitive: &Primitive<'_>, buffers: &[Cow<'_, [u8]>], to_world: &Map) -> Result<(), Fault> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.unread.primitives += 1;
            return Ok(());
        }
        self.unread.deformations += u64::from(primitive.morph_targets().len() > 0);
        let positions = primitive.get(&Semantic::Positions).ok_or(Fault::Ends { expected: "positions" })?;
        let count = positions.count();
        let first = self.vertices.len();
        if (positions.data_type(), positions.dimensions()) != (DataType::F32, Dimensions::Vec3) {
            return Err(Fault::unexpected("positions of another type", "three floats each"));
        }
        for bytes in elements(&positions, buffers)? {
            self.vertex(bytes, to_world)?;
        }
        let corners: Vec<u32> = match primitive.indices() {
            None => (0..count as u32).collect(),
            Some(indices) => {
                let expected = format!("0 to {}", count.saturating_sub(1));
                let corner = |bytes: &[u8]| {
                    let corner = bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte));
                    let found = || Fault::Index { found: corner.to_string(), expected: expected.clone() };
                    ((corner as usize) < count).then_some(corner).ok_or_else(found)
                };
                elements(&indices, buffers)?.map(corner).collect::<Result<_, _>>()?
            }
        };
        let corner = |i: usize| first as u32 + corners[i];
        let triangles = if mode == Mode::Triangles { corners.len() / 3 } else { corners.len().saturating_sub(2) };
        if mode == Mode::Triangles && !corners.len().is_multiple_of(3) {
            return Err(Fault::unexpected(format!("{} corners", corners.len()), "three for each triangle"));
        }
        if self.triangles.len().saturating_add(triangles) > MOST_TRIANGLES || self.vertices.len() > 3 * MOST_TRIANGLES {
            return Err(Fault::unexpected("more triangles", format!("up to {MOST_TRIANGLES} in all nodes")));
        }
        self.triangles.extend((0..triangles).map(|i| match mode {
            Mode::TriangleFan => [corner(0), corner(i + 1), corner(i + 2)],
            // Every other triangle of a strip would be turned around.
            Mode::TriangleStrip => [corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)],
            _ => [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)],
        }));
        Ok(())
    }

    fn vertex(&mut self, bytes: &[u8], to_world: &Map) -> Result<(), Fault> {
        let mut numbers = bytes.chunks_exact(4).map(|number| number.try_into().map_or(f32::NAN, f32::from_le_bytes));
        let own: [f32; 3] = std::array::from_fn(|_| numbers.next().unwrap_or(f32::NAN));
        let own = own.map(|number| Number::exact(f64::from(number)));
        let moved = if *to_world == Map::IDENTITY { own } else { to_world.point(own) };
        let mut position = [V::Real::default(); 3];
        for (axis, Number { value, error }) in moved.into_iter().enumerate() {
            let mut number = Number::coordinate(value, axis)?;
            number.error += error;
            position[axis] = self.rounding.coordinate(number);
        }
        self.vertices.push(V::from_components(position));
        Ok(())
    }
}

/// The bytes of each element of an accessor, all of them within its view, and that within its buffer.
fn elements<'a>(
    accessor: &Accessor<'_>,
    buffers: &'a [Cow<'_, [u8]>],
) -> Result<impl Iterator<Item = &'a [u8]>, Fault> {
    let index = accessor.index();
    let outside = || Fault::unexpected(format!("accessor {index} beyond its buffer"), "one within it");
    let view = accessor.view().filter(|_| accessor.sparse().is_none());
    let view =
        view.ok_or_else(|| Fault::unexpected(format!("accessor {index}, sparse or without data"), "plain data"))?;
    let (size, count) = (accessor.size(), accessor.count());
    let stride = view.stride().unwrap_or(size);
    let buffer: &'a [u8] = buffers.get(view.buffer().index()).ok_or_else(outside)?;
    let end = view.offset().checked_add(view.length()).ok_or_else(outside)?;
    let data = buffer.get(view.offset()..end).and_then(|view| view.get(accessor.offset()..)).ok_or_else(outside)?;
    let needed = count.saturating_sub(1).checked_mul(stride).and_then(|last| last.checked_add(size));
    if count > 0 && (stride < size || needed.is_none_or(|needed| needed > data.len())) {
        return Err(outside());
    }
    Ok((0..count).map(move |i| &data[i * stride..i * stride + size]))
}

#[cfg(test)]
mod tests;

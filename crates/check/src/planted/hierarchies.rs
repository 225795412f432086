//! Hierarchies with a mistake of a builder or of a refit, as files with the right checksum.

use super::draw::Draw;
use super::files::{BOUNDS, DEPTH, File, HEADER_BYTES, PLANES_BYTES, ROOT, cast, hierarchy};
use super::given::{self, Misrecord, misrecorded};
use super::layers::{Hits, Instead, Mistake};
use super::searches::built;
use crate::check_tree;
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SpatialOptions};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::kernel::Exact;
use stackless_bvh::geom::slabs::Directed;
use stackless_bvh::geom::{Mesh, Ray, Triangle};
use stackless_bvh::hash::checksum;
use stackless_bvh::tree::{Node, Recorded};

/// A change of each record in turn.
macro_rules! each {
    ($name:literal, $clause:literal, $change:expr) => {
        Mistake::new(
            $name,
            $clause,
            |draw| stored(draw, $change),
            Instead::Rays(|mesh, rays| of_each(mesh, rays, $change)),
        )
    };
}

/// A refit after which something is as it was before.
macro_rules! refit {
    ($name:literal, $keep:expr) => {
        Mistake::new(
            $name,
            "DET-1",
            |draw| refitted(draw, $keep),
            Instead::Rays(|mesh, rays| moved_to(mesh, rays, $keep)),
        )
    };
}

pub(super) const MISTAKES: [Mistake; 16] = [
    Mistake::new("a triangle is in no leaf", "DET-1", lost, Instead::Rays(without_last)),
    each!("a leaf ends a triangle early", "FILE-5", |file, at| file.add(file.leaf(at) + 4, -1)),
    each!("a leaf begins a triangle late", "FILE-5", |file, at| file.add(file.leaf(at), 1)),
    each!("the box of a leaf is a float short", "BOX-2", short_box),
    Mistake::new("the box of a part is a float short", "SPLIT-1", short_part, Instead::Rays(of_parts)),
    each!("boxes of two children exchanged", "FILE-5", exchanged_boxes),
    each!("children exchanged, their boxes not", "FILE-5", |file, at| file.swap(file.node(at) + 48)),
    each!("indices of two triangles exchanged", "FILE-5", exchanged_triangles),
    Mistake::new(
        "the depth is a level short",
        "DEPTH-1",
        |draw| stored(draw, |file, _| file.add(DEPTH, -1)),
        Instead::Walk(given::shallow),
    ),
    Mistake::new(
        "uncle and grand uncle exchanged",
        "UNCLE-1",
        |draw| stored(draw, |file, at| file.swap(file.node(at) + 56)),
        Instead::Walk(|| misrecorded("", Misrecord::GrandUncle)),
    ),
    Mistake::new(
        "the sibling for the uncle",
        "UNCLE-1",
        |draw| stored(draw, sibling_for_uncle),
        Instead::Walk(|| misrecorded("", Misrecord::Sibling)),
    ),
    Mistake::new(
        "the root's sibling is a child",
        "SPARSE-1",
        sibling_of_root,
        Instead::Walk(given::with_sibling_of_root),
    ),
    Mistake::new(
        "the last axis is lost",
        "FILE-1",
        |draw| stored(draw, |file, _| file.cut()),
        Instead::Nothing("the suite has no files of hierarchies"),
    ),
    refit!("a refit of corners only", boxes_kept),
    refit!("a refit that ends at the leaves' parents", inner_boxes_kept),
    refit!("a refit that keeps the bounds of all", bounds_kept),
];

pub(super) const CONTROLS: [Mistake; 2] =
    [each!("a hierarchy, unchanged", "FILE-5", |_, _| ()), refit!("a refit, unchanged", |_, _| ())];

impl File {
    /// What the checks say: of the file, and of the hierarchy that is read from it.
    fn fault(mut self, mesh: &Mesh, rays: &[Ray]) -> Option<String> {
        self.bytes.extend(checksum(&self.bytes).to_le_bytes());
        match Bvh::<Triangle>::from_bytes(&self.bytes) {
            Err(refusal) => Some(refusal.to_string()),
            Ok(bvh) => check_tree::<Exact, Directed, _>(&bvh, mesh, rays).err().map(|fault| fault.to_string()),
        }
    }
}

fn of_each(mesh: &Mesh, rays: &[Ray], change: fn(&mut File, usize)) -> Option<Hits> {
    let mut file = File::of(&hierarchy(mesh)?);
    (0..file.counts[0]).for_each(|at| change(&mut file, at));
    Some(file.cast::<Exact, Directed>(rays))
}

fn of_parts(mesh: &Mesh, rays: &[Ray]) -> Option<Hits> {
    let mut file = File::of(&in_parts(mesh)?);
    (0..file.counts[0]).for_each(|at| short_box(&mut file, at));
    Some(file.cast::<Exact, Directed>(rays))
}

fn without_last(mesh: &Mesh, rays: &[Ray]) -> Option<Hits> {
    let (_, rest) = mesh.triangles().split_last()?;
    let rest = Mesh::new(mesh.vertices().to_vec(), rest.to_vec()).ok()?;
    cast::<Exact, Directed>(&rest, rays)
}

/// The hierarchy of the mesh at half its size, refitted.
fn moved_to(mesh: &Mesh, rays: &[Ray], keep: fn(&mut File, &File)) -> Option<Hits> {
    let half = mesh.vertices().iter().map(|&vertex| vertex * 0.5).collect();
    let mut bvh = hierarchy(&Mesh::new(half, mesh.triangles().to_vec()).ok()?)?;
    let before = File::of(&bvh);
    bvh.refit(mesh).ok()?;
    let mut after = File::of(&bvh);
    keep(&mut after, &before);
    Some(after.cast::<Exact, Directed>(rays))
}

/// A hierarchy of a drawn mesh is changed, at a drawn record.
fn stored(draw: &mut Draw<'_>, change: fn(&mut File, usize)) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let bvh = built(draw, &mesh)?.with_links(Recorded::Uncles);
    changed(draw, &bvh, change)?.fault(&mesh, &rays)
}

/// `None` for a single leaf.
fn changed(draw: &mut Draw<'_>, bvh: &Bvh, change: fn(&mut File, usize)) -> Option<File> {
    let (mut file, at) = (File::of(bvh), draw.below(16) as usize);
    if bvh.nodes().is_empty() {
        return None;
    }
    change(&mut file, at);
    Some(file)
}

/// The vertices move, and something is as it was before the refit.
fn refitted(draw: &mut Draw<'_>, keep: fn(&mut File, &File)) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let mut bvh = built(draw, &mesh)?;
    let before = File::of(&bvh);
    let vertices = mesh.vertices().iter().map(|&vertex| vertex + draw.ints(1)).collect();
    let moved = Mesh::new(vertices, mesh.triangles().to_vec()).ok()?;
    bvh.refit(&moved).ok()?;
    let mut after = File::of(&bvh);
    keep(&mut after, &before);
    after.fault(&moved, &rays)
}

fn lost(draw: &mut Draw<'_>) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let (_, rest) = mesh.triangles().split_last()?;
    let rest = Mesh::new(mesh.vertices().to_vec(), rest.to_vec()).ok()?;
    File::of(&built(draw, &rest)?).fault(&mesh, &rays)
}

/// The upper plane of a child that is a leaf, on one axis.
fn short_box(file: &mut File, at: usize) {
    let side = usize::from(!file.children(at)[0].is_leaf());
    if file.children(at)[side].is_leaf() {
        let plane = file.node(at) + 16 * (at % 3) + 8 * side + 4;
        file.set(plane, f32::from_bits(file.word(plane)).next_down().to_bits());
    }
}

fn short_part(draw: &mut Draw<'_>) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let bvh = in_parts(&mesh)?;
    changed(draw, &bvh, short_box)?.fault(&mesh, &rays)
}

/// With triangles that are cut.
fn in_parts(mesh: &Mesh) -> Option<Bvh> {
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    let options = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() };
    options.build(mesh).ok().filter(|bvh| bvh.duplicates() > 0)
}

fn exchanged_boxes(file: &mut File, at: usize) {
    for axis in 0..3 {
        let plane = file.node(at) + 16 * axis;
        let [left, right] = [plane, plane + 8].map(|at| [file.word(at), file.word(at + 4)]);
        for (i, word) in [right, left].into_iter().flatten().enumerate() {
            file.set(plane + 4 * i, word);
        }
    }
}

fn exchanged_triangles(file: &mut File, at: usize) {
    let [here, there] = [at, at + 1].map(|at| file.triangle(at) + 36);
    let (index, other) = (file.word(here), file.word(there));
    file.set(here, other);
    file.set(there, index);
}

fn sibling_for_uncle(file: &mut File, at: usize) {
    let [left, right] = file.children(at);
    let links = file.record(left) + if left.is_leaf() { 8 } else { 56 };
    file.set(links, right.to_bits());
}

fn sibling_of_root(draw: &mut Draw<'_>) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let bvh = built(draw, &mesh)?.with_links(Recorded::ParentSibling);
    let change = |file: &mut File, _| {
        let root = Node::from_bits(file.word(ROOT));
        let [child, _] = file.children(root.index());
        file.set(file.record(root) + 60, child.to_bits());
    };
    changed(draw, &bvh, change)?.fault(&mesh, &rays)
}

fn boxes_kept(file: &mut File, before: &File) {
    bounds_kept(file, before);
    for at in 0..file.counts[0] {
        file.copy(before, file.node(at), PLANES_BYTES);
    }
}

fn inner_boxes_kept(file: &mut File, before: &File) {
    for at in 0..file.counts[0] {
        for (side, child) in file.children(at).into_iter().enumerate() {
            if !child.is_leaf() {
                for axis in 0..3 {
                    file.copy(before, file.node(at) + 16 * axis + 8 * side, 8);
                }
            }
        }
    }
}

fn bounds_kept(file: &mut File, before: &File) {
    file.copy(before, BOUNDS, HEADER_BYTES - BOUNDS);
}

//! Hierarchies with a mistake of a builder or of a refit, as files with the right checksum.

use super::draw::Draw;
use super::layers::Mistake;
use super::searches::built;
use crate::bvh::{BuildOptions, Builder, Bvh, SpatialOptions};
use crate::check::check_tree;
use crate::generate::Source;
use crate::geom::kernel::Exact;
use crate::geom::slabs::Directed;
use crate::geom::{Ray, Triangle};
use crate::hash::checksum;
use crate::scene::Mesh;
use crate::tree::{Node, Recorded};

pub(super) const MISTAKES: [Mistake; 16] = [
    Mistake::new("a triangle is in no leaf", "DET-1", lost),
    Mistake::new("a leaf ends a triangle early", "FILE-5", |draw| {
        stored(draw, |file, at| file.add(file.leaf(at) + 4, -1))
    }),
    Mistake::new("a leaf begins a triangle late", "FILE-5", |draw| stored(draw, |file, at| file.add(file.leaf(at), 1))),
    Mistake::new("the box of a leaf is a float short", "BOX-2", |draw| stored(draw, short_box)),
    Mistake::new("the box of a part is a float short", "SPLIT-1", short_part),
    Mistake::new("boxes of two children exchanged", "FILE-5", |draw| stored(draw, exchanged_boxes)),
    Mistake::new("children exchanged, their boxes not", "FILE-5", |draw| {
        stored(draw, |file, at| file.swap(file.node(at) + 48))
    }),
    Mistake::new("indices of two triangles exchanged", "FILE-5", |draw| stored(draw, exchanged_triangles)),
    Mistake::new("the depth is a level short", "DEPTH-1", |draw| stored(draw, |file, _| file.add(DEPTH, -1))),
    Mistake::new("uncle and grand uncle exchanged", "UNCLE-1", |draw| {
        stored(draw, |file, at| file.swap(file.node(at) + 56))
    }),
    Mistake::new("the sibling for the uncle", "UNCLE-1", |draw| stored(draw, sibling_for_uncle)),
    Mistake::new("the root's sibling is a child", "SPARSE-1", sibling_of_root),
    Mistake::new("the last axis is lost", "FILE-1", |draw| stored(draw, |file, _| file.cut())),
    Mistake::new("a refit of corners only", "DET-1", |draw| refitted(draw, boxes_kept)),
    Mistake::new("a refit that ends at the leaves' parents", "DET-1", |draw| refitted(draw, inner_boxes_kept)),
    Mistake::new("a refit that keeps the bounds of all", "DET-1", |draw| refitted(draw, bounds_kept)),
];

pub(super) const CONTROLS: [Mistake; 2] = [
    Mistake::new("a hierarchy, unchanged", "FILE-5", |draw| stored(draw, |_, _| ())),
    Mistake::new("a refit, unchanged", "DET-1", |draw| refitted(draw, |_, _| ())),
];

/// A hierarchy as bytes, without the checksum: spec/bvh-file.md.
struct File {
    bytes: Vec<u8>,
    /// Numbers of inner nodes, leaves and triangles.
    counts: [usize; 3],
}

const ROOT: usize = 20;
const DEPTH: usize = 24;
const BOUNDS: usize = 48;
const HEADER_BYTES: usize = 72;
const PLANES_BYTES: usize = 48;

impl File {
    fn of(bvh: &Bvh) -> Self {
        let mut bytes = bvh.to_bytes();
        bytes.truncate(bytes.len() - size_of::<u64>());
        Self { bytes, counts: [bvh.nodes().len(), bvh.leaves().len(), bvh.triangles().len()] }
    }

    /// Where the record of an inner node begins, that of a leaf, that of a triangle; of the first one where there are fewer.
    fn node(&self, at: usize) -> usize {
        HEADER_BYTES + 64 * (at % self.counts[0].max(1))
    }

    fn leaf(&self, at: usize) -> usize {
        HEADER_BYTES + 64 * self.counts[0] + 16 * (at % self.counts[1].max(1))
    }

    fn triangle(&self, at: usize) -> usize {
        HEADER_BYTES + 64 * self.counts[0] + 16 * self.counts[1] + 40 * (at % self.counts[2].max(1))
    }

    fn record(&self, node: Node) -> usize {
        if node.is_leaf() { self.leaf(node.index()) } else { self.node(node.index()) }
    }

    fn word(&self, at: usize) -> u32 {
        self.bytes[at..].first_chunk().map_or(0, |&word| u32::from_le_bytes(word))
    }

    fn set(&mut self, at: usize, word: u32) {
        self.bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    }

    fn add(&mut self, at: usize, by: i32) {
        self.set(at, self.word(at).wrapping_add_signed(by));
    }

    /// Exchanges a word and the next one.
    fn swap(&mut self, at: usize) {
        let (word, next) = (self.word(at), self.word(at + 4));
        self.set(at, next);
        self.set(at + 4, word);
    }

    fn cut(&mut self) {
        self.bytes.pop();
    }

    fn copy(&mut self, other: &Self, at: usize, bytes: usize) {
        self.bytes[at..at + bytes].copy_from_slice(&other.bytes[at..at + bytes]);
    }

    fn children(&self, node: usize) -> [Node; 2] {
        [0, 4].map(|at| Node::from_bits(self.word(self.node(node) + PLANES_BYTES + at)))
    }

    /// What the checks say: of the file, and of the hierarchy that is read from it.
    fn fault(mut self, mesh: &Mesh, rays: &[Ray]) -> Option<String> {
        self.bytes.extend(checksum(&self.bytes).to_le_bytes());
        match Bvh::<Triangle>::from_bytes(&self.bytes) {
            Err(refusal) => Some(refusal.to_string()),
            Ok(bvh) => check_tree::<Exact, Directed, _>(&bvh, mesh, rays).err().map(|fault| fault.to_string()),
        }
    }
}

/// A hierarchy of a drawn mesh is changed, at a drawn record.
fn stored(draw: &mut Draw<'_>, change: fn(&mut File, usize)) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let bvh = built(draw, &mesh)?;
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
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    let options = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() };
    let bvh = Bvh::build(&mesh, &options, &|_| ()).ok().filter(|bvh| bvh.duplicates() > 0)?;
    changed(draw, &bvh, short_box)?.fault(&mesh, &rays)
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

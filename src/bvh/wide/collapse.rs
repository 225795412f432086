//! Conversion of a tree with a node for each triangle into a wide tree.

use super::collapse_dp::CollapseDp;
use super::draft::{Shapes, draft_of, draft_over_leaves};
use super::layout::assign;
use super::{CUT, MAX_COUNT, WideBvh, WideNode, name_ancestors};
use crate::bvh::build::{Draft, reserve};
use crate::bvh::least::Least;
use crate::bvh::{BuildError, BuildOptions, Bvh};
use crate::geom::lanes::{Block, Precision};
use crate::geom::{Aabb, EnvironmentError, Mesh, Region, Triangle};
use crate::threads;
use crate::tree::Node;

/// Options of the collapse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WideOptions {
    /// Cost of a visit of an inner node.
    pub node_cost: f32,
    /// Cost of a test of four triangles.
    pub block_cost: f32,
    /// Greatest number of triangles in a leaf, 1 to 15. Larger leaves of the binary hierarchy are divided.
    pub max_leaf: u32,
}

impl Default for WideOptions {
    /// A node costs as much as two tests of four triangles; leaves of up to 8. (benches/records/2026-11-28-leaves.md)
    fn default() -> Self {
        Self { node_cost: 1.0, block_cost: 0.5, max_leaf: 8 }
    }
}

/// Errors of the builders of [`WideBvh`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WideError {
    /// The binary hierarchy cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A leaf cannot hold this number of triangles.
    #[error("leaves of {0} triangles, expected 1 to {MAX_COUNT}")]
    LeafSize(u32),
    /// A cost is negative, infinite or not a number.
    #[error("a cost of {0}, expected a finite one that is not negative")]
    Cost(f32),
    /// More inner nodes than references to ancestors can name.
    #[error("more than {max} inner nodes", max = WideBvh::<8>::MAX_NODES)]
    TooManyNodes,
    /// More blocks of four triangles than leaves can name.
    #[error("more than {max} blocks of triangles", max = WideBvh::<8>::MAX_BLOCKS)]
    TooManyBlocks,
    /// The arithmetic of this thread, or of a participating thread, is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<V: Precision> WideBvh<8, V> {
    /// Builds a hierarchy of eight children over a mesh, with [`BuildOptions::default`].
    ///
    /// # Errors
    /// [`WideError`], except those of options.
    pub fn build(mesh: &Mesh<V>) -> Result<Self, WideError> {
        BuildOptions::default().build_wide(mesh)
    }
}

impl BuildOptions {
    /// Builds a wide hierarchy over the triangles of a mesh. It ignores [`sah`](Self::sah), which is for binary
    /// hierarchies.
    ///
    /// ```
    /// use stackless_bvh::bvh::{BuildOptions, Builder, WideBvh};
    /// use stackless_bvh::generate::procedural;
    ///
    /// let options = BuildOptions { builder: Builder::Best, ..BuildOptions::default() };
    /// let wide: WideBvh = options.build_wide(&procedural::strands(1, 100))?;
    /// # Ok::<(), stackless_bvh::bvh::WideError>(())
    /// ```
    ///
    /// # Errors
    /// [`WideError`], except [`LeafSize`](WideError::LeafSize) and [`Cost`](WideError::Cost).
    pub fn build_wide<const A: usize, V: Precision>(&self, mesh: &Mesh<V>) -> Result<WideBvh<A, V>, WideError> {
        self.build_wide_watched(mesh, &|_| ())
    }

    /// Builds a hierarchy as [`build_wide`](Self::build_wide) does, with a progress callback. It is called
    /// periodically, from any thread, with the number of triangles that have found their leaf since the previous call;
    /// the number may be 0.
    ///
    /// # Errors
    /// As [`build_wide`](Self::build_wide).
    pub fn build_wide_watched<const A: usize, V: Precision>(
        &self,
        mesh: &Mesh<V>,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<WideBvh<A, V>, WideError> {
        let options = Self { sah: Self::fine().sah, ..*self };
        threads::guarded(|| {
            let (draft, dropped) = options.draft(mesh, progress)?;
            let region = Region::within(*mesh.frame(), &draft.aabb(0));
            let made = collapse(mesh, &draft, &WideOptions::default())?;
            Ok(made.finish(region, mesh.triangles().len(), dropped))
        })?
    }
}

impl<const A: usize, V: Precision> WideBvh<A, V> {
    /// Converts a binary hierarchy over triangles into a wide one. A binary hierarchy with [one triangle per
    /// leaf](BuildOptions::fine) gives the best result.
    ///
    /// # Errors
    /// [`WideError`], except those of options.
    pub fn of(bvh: &Bvh<Triangle<V>>) -> Result<Self, WideError> {
        Self::with_options(bvh, &WideOptions::default())
    }

    /// Converts a binary hierarchy with options.
    ///
    /// The same hierarchy and options give the same result, for any number of threads. Inner nodes have a level of at
    /// most [`MAX_LEVEL`](Self::MAX_LEVEL), for any depth of the binary hierarchy: if the cheapest hierarchy would be
    /// deeper, a subtree is rebuilt from its leaves, from left to right, with the least possible depth.
    ///
    /// # Errors
    /// [`WideError`].
    pub fn with_options(bvh: &Bvh<Triangle<V>>, options: &WideOptions) -> Result<Self, WideError> {
        let WideOptions { node_cost, block_cost, max_leaf } = *options;
        if !(1..=MAX_COUNT).contains(&max_leaf) {
            return Err(WideError::LeafSize(max_leaf));
        }
        let is_cost = |cost: &f32| cost.is_finite() && *cost >= 0.0;
        if let Some(cost) = [node_cost, block_cost].into_iter().find(|cost| !is_cost(cost)) {
            return Err(WideError::Cost(cost));
        }
        threads::guarded(|| {
            let made = collapse(bvh, &draft_of(bvh)?, options)?;
            let triangles = bvh.triangles().len() - bvh.duplicates() + bvh.dropped();
            Ok(made.finish(*bvh.region(), triangles, bvh.dropped()))
        })?
    }
}

/// Builds the nodes and levels of a hierarchy with the same leaves.
pub(super) fn over_leaves<const A: usize, V: Precision>(
    wide: &WideBvh<A, V>,
) -> Result<(Vec<WideNode<A>>, u32), WideError> {
    let (draft, leaves) = draft_over_leaves(wide)?;
    let made: Made<V, A> = collapse(&leaves, &draft, &WideOptions { max_leaf: 1, ..WideOptions::default() })?;
    Ok((made.nodes, made.levels))
}

/// Collapses the top first; then the parts below it, a few at a time on all threads, so that no second copy of the
/// whole is in memory.
fn collapse<const A: usize, V: Precision>(
    shapes: &impl Shapes<V>,
    draft: &Draft,
    options: &WideOptions,
) -> Result<Made<V, A>, WideError> {
    const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
    let collapse_dp = CollapseDp::of(draft, options)?;
    let collapse = Collapse { shapes, collapse_dp };
    let root = Pending { source: Source::Node(0), index: 0, level: 0 };
    let (mut made, mut pending) = collapse.below(root, CUT);
    name_ancestors(&mut made.nodes, |i| i as u32);
    while !pending.is_empty() {
        let rest = pending.split_off(pending.len().min(8 * threads::count()));
        let parts =
            threads::map(0..pending.len(), 1, |i| collapse.below(Pending { index: 0, ..pending[i].clone() }, 0).0);
        made.take(parts.into_iter().zip(pending.iter().map(|root| root.index)), draft.node(0).count())?;
        pending = rest;
    }
    made.nodes.shrink_to_fit();
    made.blocks.shrink_to_fit();
    Ok(made)
}

struct Collapse<'a, H, const A: usize> {
    shapes: &'a H,
    collapse_dp: CollapseDp<'a, A>,
}

/// The source of an inner node.
#[derive(Clone)]
enum Source {
    /// The choice of the dynamic programme for this node of the draft.
    Node(u32),
    /// These leaves of the draft, from left to right.
    Leaves(Vec<u32>),
}

/// An inner node that is not yet filled.
#[derive(Clone)]
struct Pending {
    source: Source,
    index: usize,
    level: u32,
}

/// Children of a node, and their boxes.
struct Children<const A: usize> {
    sources: [Source; A],
    boxes: [Aabb; A],
    count: usize,
}

/// A part of the hierarchy, with its own indices. Its root is the first node.
struct Made<V: Precision, const A: usize> {
    nodes: Vec<WideNode<A>>,
    blocks: Vec<Block<V>>,
    levels: u32,
    /// Triangles in all leaves.
    references: usize,
}

impl<const A: usize, H> Collapse<'_, H, A> {
    fn draft(&self) -> &Draft {
        self.collapse_dp.draft
    }

    /// Builds the part below a node, and returns the nodes that are not yet filled: those with at most `cut` triangles.
    fn below<V: Precision>(&self, root: Pending, cut: u32) -> (Made<V, A>, Vec<Pending>)
    where
        H: Shapes<V>,
    {
        let mut made = Made { nodes: vec![WideNode::EMPTY], blocks: Vec::new(), levels: 0, references: 0 };
        let (mut pending, mut left, mut held) = (vec![root], Vec::new(), Vec::new());
        while let Some(next) = pending.pop() {
            if self.count(&next.source) <= cut && next.index > 0 {
                left.push(next);
                continue;
            }
            let Pending { source, index, level } = next;
            let Children { sources, boxes, count } = self.children(source, level);
            made.levels = made.levels.max(level);
            let start = pending.len();
            for ((slot, source), aabb) in assign::<A>(&boxes[..count]).into_iter().zip(sources).zip(&boxes[..count]) {
                made.nodes[index].set_child_box(slot, aabb);
                let address = match source {
                    Source::Node(place) if self.collapse_dp.is_leaf(place) => self.leaf(place, &mut held, &mut made),
                    source => {
                        let index = made.nodes.len();
                        made.nodes.push(WideNode::EMPTY);
                        pending.push(Pending { source, index, level: level + 1 });
                        Node::inner(index as u32)
                    }
                };
                made.nodes[index].children[slot as usize & (A - 1)] = address.to_bits();
            }
            pending[start..].reverse();
        }
        (made, left)
    }

    /// Writes the triangles of a leaf.
    fn leaf<V: Precision>(&self, place: u32, held: &mut Vec<u32>, made: &mut Made<V, A>) -> Node
    where
        H: Shapes<V>,
    {
        held.clear();
        self.draft().leaves(place, |leaf| held.push(self.draft().node(leaf).first()));
        let address = self.shapes.write(held, self.draft().has_parts, &mut made.blocks);
        made.references += held.len();
        address
    }

    fn count(&self, source: &Source) -> u32 {
        match source {
            Source::Node(place) => self.draft().node(*place).count(),
            Source::Leaves(leaves) => leaves.len() as u32,
        }
    }

    /// Returns the children of an inner node at this level, from left to right.
    ///
    /// A node at this level can always be rebuilt within the limit. This holds for the root, for children of a rebuilt
    /// node, which have an A-th of its leaves, and for other nodes because this function checks it.
    fn children(&self, source: Source, level: u32) -> Children<A> {
        let mut made = Children { sources: [const { Source::Node(0) }; A], boxes: [Aabb::EMPTY; A], count: 0 };
        let mut add = |aabb: Aabb, source: Source| {
            (made.boxes[made.count % A], made.sources[made.count % A]) = (aabb, source);
            made.count += 1;
        };
        let leaves = match source {
            Source::Leaves(leaves) => leaves,
            Source::Node(place) => {
                let left = max_level::<A>() - level;
                let (children, count) = self.collapse_dp.children(place);
                let fits = |&child: &u32| {
                    self.collapse_dp.is_leaf(child)
                        || left > 0 && flattest::<A>(self.draft().node(child).count()) < left
                };
                if children[..count].iter().all(fits) {
                    children[..count].iter().for_each(|&child| add(self.draft().aabb(child), Source::Node(child)));
                    return made;
                }
                let mut leaves = Vec::new();
                self.draft().leaves(place, |leaf| leaves.push(leaf));
                leaves
            }
        };
        for group in leaves.chunks(leaves.len().div_ceil(A).max(1)) {
            let aabb = group.iter().fold(Aabb::EMPTY, |all, &leaf| all.union(self.draft().aabb(leaf)));
            add(aabb, if let &[leaf] = group { Source::Node(leaf) } else { Source::Leaves(group.to_vec()) });
        }
        made
    }
}

const fn max_level<const A: usize>() -> u32 {
    WideBvh::<A>::MAX_LEVEL
}

/// Returns the least possible level of the deepest inner node below a node with this many triangles.
fn flattest<const A: usize>(count: u32) -> u32 {
    let (mut held, mut levels) = (A as u64, 0);
    while held < u64::from(count) {
        held *= A as u64;
        levels += 1;
    }
    levels
}

impl<V: Precision, const A: usize> Made<V, A> {
    /// Appends parts, with their roots at these indices. `total` is the number of triangles of the whole hierarchy.
    fn take(&mut self, made: impl Iterator<Item = (Self, usize)>, total: u32) -> Result<(), WideError> {
        let (mut nodes, mut blocks, mut parts) = (self.nodes.len(), self.blocks.len(), Vec::new());
        for (made, root) in made {
            let start = [nodes, blocks];
            (nodes, blocks) = (nodes + made.nodes.len() - 1, blocks + made.blocks.len());
            (self.levels, self.references) = (self.levels.max(made.levels), self.references + made.references);
            parts.push(Part { made, root, ancestors: self.nodes[root].ancestors, start });
        }
        if nodes > WideBvh::<A, V>::MAX_NODES {
            return Err(WideError::TooManyNodes);
        }
        if blocks > WideBvh::<A, V>::MAX_BLOCKS {
            return Err(WideError::TooManyBlocks);
        }
        let share = self.references as f64 / f64::from(total);
        make_room(&mut self.nodes, nodes, share)?;
        make_room(&mut self.blocks, blocks, share)?;
        threads::update(&mut parts, 1, Part::place);
        for part in &parts {
            self.nodes[part.root] = part.made.nodes[0];
        }
        threads::append(&mut self.nodes, &parts.iter().map(|part| &part.made.nodes[1..]).collect::<Vec<_>>());
        threads::append(&mut self.blocks, &parts.iter().map(|part| &part.made.blocks[..]).collect::<Vec<_>>());
        Ok(())
    }

    /// Returns the hierarchy of a mesh with this many triangles, some of which are in no leaf.
    fn finish(self, region: Region, triangles: usize, dropped: usize) -> WideBvh<A, V> {
        let Self { nodes, blocks, levels, references } = self;
        let duplicates = references - (triangles - dropped);
        WideBvh { nodes, blocks, region, levels, triangles, duplicates, least: Least::default() }
    }
}

/// Reserves room for `count` elements. If there is not enough, it reserves room for the whole, estimated from the
/// current share: repeated growth would need a second copy.
fn make_room<T>(all: &mut Vec<T>, count: usize, share: f64) -> Result<(), BuildError> {
    if count > all.capacity() {
        let expected = (count as f64 / share * 1.06) as usize;
        return reserve(all, expected.max(count) - all.len()).or_else(|_| reserve(all, count - all.len()));
    }
    Ok(())
}

/// A part of a hierarchy, and its destination.
struct Part<V: Precision, const A: usize> {
    made: Made<V, A>,
    /// The index of the root, and its ancestors.
    root: usize,
    ancestors: [u32; A],
    /// The index of the node after the root, and that of the first block.
    start: [usize; 2],
}

impl<V: Precision, const A: usize> Part<V, A> {
    /// Replaces the indices in its nodes by those in the whole hierarchy.
    fn place(&mut self) {
        let (root, [nodes, blocks]) = (self.root, self.start.map(|start| start as u32));
        let index = |i: usize| if i == 0 { root as u32 } else { nodes - 1 + i as u32 };
        self.made.nodes[0].ancestors = self.ancestors;
        name_ancestors(&mut self.made.nodes, index);
        for bits in self.made.nodes.iter_mut().flat_map(|node| &mut node.children).filter(|bits| **bits != 0) {
            *bits += if Node::from_bits(*bits).is_leaf() { blocks } else { nodes - 1 };
        }
    }
}

//! From a binary hierarchy to a wide one.

use std::borrow::Cow;

use super::draft::{Draft, leaf_address};
use super::layout::{Child, assign};
use super::programme::Programme;
use super::{CUT, MAX_COUNT, WideBvh, WideNode, name_ancestors};
use crate::bvh::least::Least;
use crate::bvh::{BuildError, BuildOptions, Bvh};
use crate::geom::lanes::{Block, Precision};
use crate::geom::{Aabb, EnvironmentError, Mesh, Triangle};
use crate::threads;
use crate::tree::Node;

/// What collapsing may choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WideOptions {
    /// What a visit of an inner node costs.
    pub node_cost: f32,
    /// What a test of four triangles costs.
    pub block_cost: f32,
    /// Triangles that a leaf may hold, 1 to 15. Leaves of the binary hierarchy that hold more are divided.
    pub max_leaf: u32,
}

impl Default for WideOptions {
    /// A node costs as much as two tests of four triangles; leaves of up to 8. (benches/records/2026-11-28-leaves.md)
    fn default() -> Self {
        Self { node_cost: 1.0, block_cost: 0.5, max_leaf: 8 }
    }
}

/// Why a hierarchy cannot be made wide.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WideError {
    /// There is no binary hierarchy.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// No leaf can hold so many.
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
    /// Floats of this thread, or of one that helps, are not those of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<V: Precision> WideBvh<8, V> {
    /// A hierarchy of eight children over a mesh: by surface area with one triangle a leaf, then collapsed.
    ///
    /// It takes two to three times as long as [`Bvh::build`]. Two rounds of
    /// [reinsertion](BuildOptions::reinsertion), as in `BuildOptions { reinsertion: 2, ..BuildOptions::fine() }`, make
    /// rays a few per cent faster and building three times as long again: they pay where tens of millions of rays
    /// are traced.
    ///
    /// # Errors
    /// What [`WideError`] lists but for options.
    pub fn build(mesh: &Mesh<V>) -> Result<Self, WideError> {
        Self::of(&BuildOptions::fine().build(mesh)?)
    }
}

impl<const A: usize, V: Precision> WideBvh<A, V> {
    /// A wide hierarchy over the triangles of a binary one. The best one is made of a binary one with
    /// [one triangle a leaf](BuildOptions::fine).
    ///
    /// # Errors
    /// What [`WideError`] lists but for options.
    pub fn of(bvh: &Bvh<Triangle<V>>) -> Result<Self, WideError> {
        Self::with_options(bvh, &WideOptions::default())
    }

    /// The same with options.
    ///
    /// The same hierarchy and options give the same result, for any number of threads. Inner nodes have a level of at
    /// most [`MAX_LEVEL`](Self::MAX_LEVEL), however deep the binary hierarchy is: where the cheapest one would be deeper,
    /// a subtree is made anew, by its leaves from left to right, as flat as can be.
    ///
    /// # Errors
    /// What [`WideError`] lists.
    pub fn with_options(bvh: &Bvh<Triangle<V>>, options: &WideOptions) -> Result<Self, WideError> {
        const { assert!(A == 4 || A == 8, "nodes have four or eight children") };
        let WideOptions { node_cost, block_cost, max_leaf } = *options;
        if !(1..=MAX_COUNT).contains(&max_leaf) {
            return Err(WideError::LeafSize(max_leaf));
        }
        let is_cost = |cost: &f32| cost.is_finite() && *cost >= 0.0;
        if let Some(cost) = [node_cost, block_cost].into_iter().find(|cost| !is_cost(cost)) {
            return Err(WideError::Cost(cost));
        }
        threads::guarded(|| {
            let draft = Draft::of(bvh, max_leaf);
            let programme = Programme::of(&draft, options);
            Collapse { bvh, draft: &draft, programme: &programme }.run()
        })?
    }
}

struct Collapse<'a, V: Precision, const A: usize> {
    bvh: &'a Bvh<Triangle<V>>,
    draft: &'a Draft,
    programme: &'a Programme<A>,
}

/// What an inner node is made of.
#[derive(Clone)]
enum Source {
    /// The programme's choice for this node of the draft.
    Node(u32),
    /// These leaves of the draft, from left to right.
    Leaves(Vec<u32>),
}

/// An inner node that is still to be filled.
#[derive(Clone)]
struct Pending {
    source: Source,
    index: usize,
    level: u32,
}

/// A part of the hierarchy, with places of its own. Its root is the first node.
struct Made<V: Precision, const A: usize> {
    nodes: Vec<WideNode<A>>,
    blocks: Vec<Block<V>>,
    levels: u32,
    /// Triangles in all leaves.
    references: usize,
}

impl<V: Precision, const A: usize> Collapse<'_, V, A> {
    /// The top first; then what is below it, on all threads.
    fn run(self) -> Result<WideBvh<A, V>, WideError> {
        let (mut made, pending) = self.below(Pending { source: Source::Node(0), index: 0, level: 0 }, CUT as u32);
        let parts = threads::map(0..pending.len(), 1, |i| self.below(Pending { index: 0, ..pending[i].clone() }, 0).0);
        for (Pending { index, .. }, part) in pending.into_iter().zip(parts) {
            made.take(index, part)?;
        }
        let Made { mut nodes, blocks, levels, references } = made;
        name_ancestors(&mut nodes);
        let different = self.bvh.triangles().len() - self.bvh.duplicates();
        let (triangles, duplicates) = (different + self.bvh.dropped(), references - different);
        Ok(WideBvh {
            nodes,
            blocks,
            region: *self.bvh.region(),
            levels,
            triangles,
            duplicates,
            least: Least::default(),
        })
    }

    /// What is below a node, and the nodes that are left to be filled: those that hold at most `cut` triangles.
    fn below(&self, root: Pending, cut: u32) -> (Made<V, A>, Vec<Pending>) {
        let mut made = Made { nodes: vec![WideNode::EMPTY], blocks: Vec::new(), levels: 0, references: 0 };
        let (mut pending, mut left) = (vec![root], Vec::new());
        let mut inner = Vec::new();
        while let Some(next) = pending.pop() {
            if self.count(&next.source) <= cut && next.index > 0 {
                left.push(next);
                continue;
            }
            let Pending { source, index, level } = next;
            let children = self.children(source, level);
            let boxes: Vec<_> = children.iter().map(|child| child.aabb).collect();
            made.levels = made.levels.max(level);
            for (slot, child) in assign::<A>(&boxes).into_iter().zip(children) {
                made.nodes[index].set_child_box(slot, &child.aabb);
                let address = match child.source {
                    Source::Node(place) if self.is_leaf(place) => self.leaf(place, &mut made),
                    source => {
                        let index = made.nodes.len();
                        made.nodes.push(WideNode::EMPTY);
                        inner.push(Pending { source, index, level: level + 1 });
                        Node::inner(index as u32)
                    }
                };
                made.nodes[index].children[slot as usize & (A - 1)] = address.to_bits();
            }
            pending.extend(inner.drain(..).rev());
        }
        (made, left)
    }

    /// How many triangles it has; of several leaves at least how many.
    fn count(&self, source: &Source) -> u32 {
        match source {
            Source::Node(place) => self.draft.nodes[*place as usize].count,
            Source::Leaves(leaves) => leaves.len() as u32,
        }
    }

    fn is_leaf(&self, place: u32) -> bool {
        self.programme.is_leaf(place)
    }

    /// The blocks of a leaf. Parts of one triangle may meet again in it.
    fn leaf(&self, place: u32, made: &mut Made<V, A>) -> Node {
        let node = &self.draft.nodes[place as usize];
        let mut held = Cow::Borrowed(&self.bvh.triangles()[node.first as usize..(node.first + node.count) as usize]);
        if self.bvh.duplicates() > 0 {
            let held = held.to_mut();
            held.sort_by_key(|held| held.prim);
            held.dedup_by_key(|held| held.prim);
        }
        let first = made.blocks.len();
        made.references += held.len();
        for held in held.chunks(4) {
            let mut block = Block::EMPTY;
            for (lane, held) in held.iter().enumerate() {
                block.set(lane, &held.shape, held.prim);
            }
            made.blocks.push(block);
        }
        leaf_address(first, held.len())
    }

    /// The children of an inner node at this level, from left to right.
    ///
    /// What is at this level can always be made anew within the limit: that holds for the root, for children of a node
    /// that is made anew, as they have an A-th of its leaves, and for others because it is asked here.
    fn children(&self, source: Source, level: u32) -> Vec<Child<Source>> {
        let left = WideBvh::<A, V>::MAX_LEVEL - level;
        let leaves = match source {
            Source::Leaves(leaves) => leaves,
            Source::Node(place) => {
                let node =
                    |place: u32| Child { aabb: self.draft.nodes[place as usize].aabb, source: Source::Node(place) };
                if self.is_leaf(place) {
                    // Of the root only.
                    return vec![node(place)];
                }
                let children = self.programme.children(self.draft, place);
                // The levels below and including this one are counted by the programme, but not above 2^16.
                let fits = self.programme.levels(place) <= left + 1
                    || left > 0 && children.iter().all(|&child| self.flattest(child) < left);
                if fits {
                    return children.into_iter().map(node).collect();
                }
                self.draft.leaves_below(place)
            }
        };
        let part = leaves.len().div_ceil(A).max(1);
        let group = |leaves: &[u32]| {
            let aabb = |&place: &u32| self.draft.nodes[place as usize].aabb;
            let aabb = leaves.iter().map(aabb).fold(Aabb::EMPTY, Aabb::union);
            let source = if let &[place] = leaves { Source::Node(place) } else { Source::Leaves(leaves.to_vec()) };
            Child { aabb, source }
        };
        leaves.chunks(part).map(group).collect()
    }

    /// The level of the deepest inner node below this one if this is made anew, as flat as can be; bounded from above
    /// by the number of triangles.
    fn flattest(&self, place: u32) -> u32 {
        let (mut held, mut levels) = (A as u64, 0);
        while held < u64::from(self.draft.nodes[place as usize].count) {
            held *= A as u64;
            levels += 1;
        }
        levels
    }
}

impl<V: Precision, const A: usize> Made<V, A> {
    /// Takes a part over, with its root at this index.
    fn take(&mut self, index: usize, part: Self) -> Result<(), WideError> {
        let (nodes, blocks) = (self.nodes.len() + part.nodes.len() - 1, self.blocks.len() + part.blocks.len());
        if nodes > WideBvh::<A, V>::MAX_NODES {
            return Err(WideError::TooManyNodes);
        }
        if blocks > WideBvh::<A, V>::MAX_BLOCKS {
            return Err(WideError::TooManyBlocks);
        }
        // The index of its second node, less one; the index of its first block.
        let (by_nodes, by_blocks) = (self.nodes.len() as u32 - 1, self.blocks.len() as u32);
        let moved = |mut node: WideNode<A>| {
            for bits in node.children.iter_mut().filter(|bits| **bits != 0) {
                *bits += if Node::from_bits(*bits).is_leaf() { by_blocks } else { by_nodes };
            }
            node
        };
        let mut nodes = part.nodes.into_iter().map(moved);
        self.nodes[index] = nodes.next().unwrap_or(WideNode::EMPTY);
        self.nodes.extend(nodes);
        self.blocks.extend(part.blocks);
        self.levels = self.levels.max(part.levels);
        self.references += part.references;
        Ok(())
    }
}

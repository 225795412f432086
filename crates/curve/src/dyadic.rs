//! The tree of dyadic intervals: complete, and computed.

use stackless_bvh::hash::Lookup;
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::LeftOrder;
use stackless_bvh::traverse::{Skips, Supply, Unfit};
use stackless_bvh::tree::{Node, Recorded, Topology};

/// A part of `[0, 1]` that halving gives, by the key of its node: `[0, 1]` is 1, the halves of `k` are `2k` and
/// `2k + 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span(pub(super) u64);

impl Span {
    pub(super) const ALL: Self = Self(1);

    /// The interval of a node in a tree whose root is this interval.
    pub(super) fn below(self, node: Node) -> Self {
        let key = node.index() as u64;
        let depth = key.ilog2();
        Self(self.0 << depth | (key ^ 1 << depth))
    }

    /// Both ends, exact down to a depth of 52.
    pub(super) fn ends(self) -> [f64; 2] {
        let size = 1_u64 << self.0.ilog2();
        let index = self.0 ^ size;
        [index, index + 1].map(|i| i as f64 / size as f64)
    }
}

/// A complete tree of which nothing is stored: the index of a node is its key.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dyadic {
    depth: u32,
}

impl Dyadic {
    /// Deepest tree whose keys are addresses.
    pub(super) const LIMIT: u32 = 29;

    /// A tree of this depth in edges, or of [`LIMIT`](Self::LIMIT).
    pub(super) const fn new(depth: u32) -> Self {
        Self { depth: if depth < Self::LIMIT { depth } else { Self::LIMIT } }
    }

    const fn at(self, key: u32) -> Node {
        if key >> self.depth == 0 { Node::inner(key) } else { Node::leaf(key) }
    }

    /// The sibling of the ancestor `levels` above; the root where there is none.
    const fn beside(self, node: Node, levels: u32) -> Node {
        let above = node.index() as u32 >> levels;
        self.at(if above > 1 { above ^ 1 } else { 1 })
    }
}

impl Topology for Dyadic {
    fn root(&self) -> Node {
        self.at(1)
    }

    #[inline]
    fn children(&self, node: Node) -> [Node; 2] {
        let key = node.index() as u32;
        [self.at(2 * key), self.at(2 * key + 1)]
    }

    fn node_count(&self) -> usize {
        (2 << self.depth) - 1
    }

    fn slot(&self, node: Node) -> usize {
        node.index() - 1
    }

    fn depth(&self) -> u32 {
        self.depth
    }

    /// All links are computed.
    fn names(&self, _: Recorded) -> bool {
        true
    }

    fn parent(&self, node: Node) -> Node {
        self.at((node.index() as u32 / 2).max(1))
    }

    fn sibling(&self, node: Node) -> Node {
        self.beside(node, 0)
    }

    fn uncles(&self, node: Node) -> [Node; 3] {
        [1, 2, 3].map(|levels| self.beside(node, levels))
    }
}

impl<W: KeyWord> Lookup<W> for Dyadic {
    #[inline]
    fn node(&self, key: &W) -> Node {
        self.at(key.low_bits())
    }
}

/// Whatever is asked for is computed, but for skip pointers.
impl<'t> Supply<'t, u32> for &'t Dyadic {
    type Tree = Dyadic;
    type Memory = Vec<Node>;
    type Hash = Self;
    type Layout = Self;
    type Complete = Self;
    type Chains = Self;
    type BySign = LeftOrder;

    fn tree(&self) -> Self {
        self
    }

    fn memory(self) -> Vec<Node> {
        Vec::new()
    }

    fn by_sign(&self) -> LeftOrder {
        LeftOrder
    }

    fn reached_keys(&self) -> Result<Self, Unfit> {
        Ok(self)
    }

    fn all_keys(&self) -> Result<Self, Unfit> {
        Ok(self)
    }

    fn layout(&self) -> Result<Self, Unfit> {
        Ok(self)
    }

    fn complete(&self) -> Result<Self, Unfit> {
        Ok(self)
    }

    fn chains(&self) -> Result<Self, Unfit> {
        Ok(self)
    }

    fn skips(&self) -> Result<&'t Skips, Unfit> {
        Err(Unfit::NoTable)
    }

    fn skips_by_sign(&self) -> Result<&'t Skips, Unfit> {
        Err(Unfit::NoTable)
    }
}

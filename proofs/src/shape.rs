//! Small trees without memory: nodes are identified by their keys, and links are computed.

use stackless_bvh::hash::Lookup;
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Descent, Side};
use stackless_bvh::tree::{Node, Recorded, Topology};

use crate::Choose;

/// Any tree with at most a given number of inner nodes: a set of keys, bit `k` for the inner node with key `k`.
///
/// The node with key `k` has the index `k`. So the links of a node are computed, and the key of a traversal's state can
/// be compared with its node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    inner: u64,
    inner_nodes: u32,
}

impl Shape {
    /// Maximum number of inner nodes of a shape, so keys of leaves have 6 bits.
    pub const LIMIT: u32 = 5;

    /// Returns any shape with at most `inner_nodes` inner nodes.
    pub fn any(choose: &mut impl Choose, inner_nodes: u32) -> Option<Self> {
        Some(Self { inner: choose.inner_keys(inner_nodes)?, inner_nodes })
    }

    /// Returns whether the node with this key is an inner one.
    pub fn is_inner(self, key: u32) -> bool {
        self.inner >> key & 1 == 1
    }

    /// Returns the node with this key.
    pub fn node(self, key: u32) -> Node {
        if self.is_inner(key) { Node::inner(key) } else { Node::leaf(key) }
    }

    /// Returns the possible keys of inner nodes.
    pub fn keys(self) -> u64 {
        self.inner
    }

    /// Returns the sibling of the ancestor `levels` up, or the root if there is none.
    fn uncle(self, node: Node, levels: u32) -> Node {
        let ancestor = node.index() as u32 >> levels;
        self.node(if ancestor > 1 { ancestor ^ 1 } else { 1 })
    }

    /// Returns whether a key must be hashed: below its sibling there is a node whose record does not link to it, an
    /// inner one or a leaf three levels down. `[HASH-3]`
    fn is_hashed(self, key: u32) -> bool {
        // A node three levels down exists if there is an inner node two levels down.
        let below = |path: u32| {
            let sibling = key ^ 1;
            self.is_inner(sibling)
                && self.is_inner((2 * sibling) | (path >> 1))
                && 4 * sibling < 1 << self.inner_nodes
                && self.is_inner((4 * sibling) | path)
        };
        below(0) || below(1) || below(2) || below(3)
    }
}

impl Topology for Shape {
    fn root(&self) -> Node {
        self.node(1)
    }

    fn children(&self, node: Node) -> [Node; 2] {
        let key = node.index() as u32;
        [self.node(2 * key), self.node(2 * key + 1)]
    }

    /// The number of possible keys.
    fn node_count(&self) -> usize {
        2 << self.inner_nodes
    }

    fn slot(&self, node: Node) -> usize {
        node.index()
    }

    /// The depth of the deepest shape.
    fn depth(&self) -> u32 {
        self.inner_nodes
    }

    /// All links are computed.
    fn names(&self, _: Recorded) -> bool {
        true
    }

    fn parent(&self, node: Node) -> Node {
        let key = node.index() as u32;
        self.node(if key > 1 { key >> 1 } else { 1 })
    }

    fn sibling(&self, node: Node) -> Node {
        self.uncle(node, 0)
    }

    fn uncles(&self, node: Node) -> [Node; 3] {
        [self.uncle(node, 1), self.uncle(node, 2), self.root()]
    }
}

/// The address table of a [`Shape`], computed.
#[derive(Clone, Copy, Debug)]
pub struct Computed(pub Shape);

impl<W: KeyWord> Lookup<W> for Computed {
    fn node(&self, key: &W) -> Node {
        self.0.node(key.low_bits())
    }
}

/// A table of only the hashed keys. It panics for other keys.
#[derive(Clone, Copy, Debug)]
pub struct HashedKeys(pub Shape);

impl<W: KeyWord> Lookup<W> for HashedKeys {
    fn node(&self, key: &W) -> Node {
        let key = key.low_bits();
        assert!(self.0.is_hashed(key));
        self.0.node(key)
    }
}

/// Any decisions of a search, fixed for each node: the wanted children, their order, whether they are disjoint, the
/// leaves with a hit, and the leaves that end the search.
#[derive(Clone, Copy, Debug)]
pub struct Script {
    left: u64,
    right: u64,
    right_first: u64,
    disjoint: u64,
    found: u64,
    last: u64,
}

impl Script {
    /// Returns any decisions, without marks.
    pub fn any(choose: &mut impl Choose, shape: Shape) -> Self {
        let inner = shape.keys();
        let [left, right, right_first] = [(); 3].map(|()| choose.subset(inner));
        Self { left, right, right_first, disjoint: 0, found: 0, last: 0 }
    }

    /// Adds marks, and leaves with a hit. `[ORDER-2]` `[ORDER-3]`
    #[must_use]
    pub fn with_marks(self, choose: &mut impl Choose, shape: Shape) -> Self {
        let [disjoint, found] = [shape.keys(), shape.leaf_keys()].map(|keys| choose.subset(keys));
        Self { disjoint, found, ..self }
    }

    /// Adds leaves that end the search.
    #[must_use]
    pub fn with_ends(self, choose: &mut impl Choose, shape: Shape) -> Self {
        Self { last: choose.subset(shape.leaf_keys()), ..self }
    }

    /// Wants both children of a node or none, like tests of nodes at their visit.
    #[must_use]
    pub fn by_node(self) -> Self {
        Self { right: self.left, ..self }
    }

    /// Visits left children before right ones.
    #[must_use]
    pub fn left_first(self) -> Self {
        Self { right_first: 0, ..self.by_node() }
    }

    /// Returns the decision at an inner node.
    pub fn descent(&self, key: u32) -> Descent {
        let bit = |keys: u64| keys >> key & 1 == 1;
        Descent::new(bit(self.left), bit(self.right), bit(self.right_first))
    }

    /// Returns the first child, for orders that are queried separately from the decision.
    pub fn first(&self, key: u32) -> Side {
        Side::right_if(self.right_first >> key & 1 == 1)
    }

    /// Returns whether the children of an inner node are disjoint.
    pub fn is_disjoint(&self, key: u32) -> bool {
        self.disjoint >> key & 1 == 1
    }

    /// Returns whether a leaf has a hit.
    pub fn finds(&self, key: u32) -> bool {
        self.found >> key & 1 == 1
    }

    /// Returns whether the search ends at a leaf.
    pub fn ends(&self, key: u32) -> bool {
        self.last >> key & 1 == 1
    }
}

impl Shape {
    /// Returns the possible keys of leaves.
    fn leaf_keys(self) -> u64 {
        let reached = (u64::MAX >> (64 - (2 << self.inner_nodes))) & !1;
        reached & !self.inner
    }
}

//! The topology of a wide tree, and an implementation in an array.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use crate::tree::{self, Node};

/// A wide tree: an inner node has `A` slots, each with a child or empty, and every node except the root is the child of
/// one node. The root is an inner node. `[WIDE-1]`
///
/// Methods with a node argument require an inner node of this tree; they may panic for other nodes.
pub trait Topology<const A: usize> {
    /// Returns the node with key 1.
    fn root(&self) -> Node;

    /// Returns the set of slots that hold a child.
    fn children(&self, node: Node) -> u32;

    /// Returns the set of slots that hold a leaf.
    fn leaves(&self, node: Node) -> u32;

    /// Returns the child in a slot that holds one.
    fn child(&self, node: Node, slot: u32) -> Node;

    /// Returns the greatest level of an inner node: edges from the root.
    fn levels(&self) -> u32;

    /// Returns the ancestor `up` levels up, 1 to `A`, from the node's record. Beyond the root it is the root.
    fn ancestor(&self, node: Node, up: u32) -> Node;

    /// Returns the parent; the root is its own parent.
    #[inline(always)]
    fn parent(&self, node: Node) -> Node {
        self.ancestor(node, 1)
    }
}

/// Returns the bits of a slot's number: log2 A.
#[inline(always)]
pub(super) const fn slot_bits<const A: usize>() -> u32 {
    const { assert!(A == 2 || A == 4 || A == 8, "nodes have 2, 4 or 8 slots") };
    A.trailing_zeros()
}

/// A wide tree in an array: node `i` is element `i`, the root is element 0.
///
/// ```
/// use stackless_bvh::wide::{Topology, Tree};
/// // Node 0 has the children 1, 2 and 3. Node 2 has the children 4 and 5.
/// let tree = Tree::<4>::new(&[Some(&[1, 2, 3]), None, Some(&[4, 5]), None, None, None])?;
/// assert_eq!((tree.levels(), tree.children(tree.root()), tree.leaves(tree.root())), (1, 0b111, 0b101));
/// # Ok::<(), stackless_bvh::wide::TreeError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree<const A: usize> {
    nodes: Vec<Record<A>>,
    levels: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Record<const A: usize> {
    /// The children from slot 0 on.
    children: [Node; A],
    count: u32,
    leaves: u32,
    /// The nearest first; the root if there is none.
    ancestors: [Node; A],
}

/// Errors of [`Tree::new`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeError {
    /// There is no root, or it is a leaf.
    NoRoot,
    /// A node has more children than slots.
    TooManyChildren {
        /// The node.
        node: u32,
        /// Number of its children.
        children: usize,
        /// Number of slots.
        slots: usize,
    },
    /// An inner node other than the root has no children.
    NoChildren {
        /// The node.
        node: u32,
    },
    /// Not every node is reached once from the root, or there are more nodes than addresses.
    NotATree(tree::TreeError),
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoRoot => write!(f, "the root, node 0, must be an inner node"),
            Self::TooManyChildren { node, children, slots } => {
                write!(f, "node {node} has {children} children, and there are {slots} slots")
            }
            Self::NoChildren { node } => write!(f, "node {node} is an inner node without children"),
            Self::NotATree(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for TreeError {}

impl From<tree::TreeError> for TreeError {
    fn from(error: tree::TreeError) -> Self {
        Self::NotATree(error)
    }
}

impl<const A: usize> Tree<A> {
    /// Builds a tree from the children of each node (`None` for a leaf), which take the slots from 0 on. Node 0 is the
    /// root. `[WIDE-1]`
    ///
    /// Linear in time and memory, without recursion.
    ///
    /// # Errors
    /// [`TreeError`] with the node at which the array is not a tree.
    pub fn new(children: &[Option<&[u32]>]) -> Result<Self, TreeError> {
        const { assert!(slot_bits::<A>() > 0) };
        if !matches!(children.first(), Some(Some(_))) {
            return Err(TreeError::NoRoot);
        }
        let root = Node::inner(0);
        let empty = Record { children: [root; A], count: 0, leaves: 0, ancestors: [root; A] };
        let mut nodes = vec![empty; children.len()];
        let mut levels = 0;
        tree::walk(children, |node, level| {
            let Some(list) = children[node as usize] else { return Ok(()) };
            levels = levels.max(level);
            if list.len() > A {
                return Err(TreeError::TooManyChildren { node, children: list.len(), slots: A });
            }
            if list.is_empty() && node != 0 {
                return Err(TreeError::NoChildren { node });
            }
            let mut record = Record { count: list.len() as u32, ..nodes[node as usize] };
            let mut ancestors = record.ancestors;
            ancestors.rotate_right(1);
            ancestors[0] = Node::inner(node);
            for (slot, &child) in list.iter().enumerate() {
                let is_leaf = children[child as usize].is_none();
                record.children[slot] = if is_leaf { Node::leaf(child) } else { Node::inner(child) };
                record.leaves |= u32::from(is_leaf) << slot;
                nodes[child as usize].ancestors = ancestors;
            }
            nodes[node as usize] = record;
            Ok(())
        })?;
        Ok(Self { nodes, levels })
    }

    /// Returns the number of inner nodes and leaves together.
    pub const fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the nodes, by number.
    pub fn nodes(&self) -> impl Iterator<Item = Node> + '_ {
        let address = |(i, record): (usize, &Record<A>)| {
            if i > 0 && record.count == 0 { Node::leaf(i as u32) } else { Node::inner(i as u32) }
        };
        self.nodes.iter().enumerate().map(address)
    }
}

/// A root without children.
impl<const A: usize> Default for Tree<A> {
    fn default() -> Self {
        let root = Node::inner(0);
        Self { nodes: vec![Record { children: [root; A], count: 0, leaves: 0, ancestors: [root; A] }], levels: 0 }
    }
}

impl<const A: usize> Topology<A> for Tree<A> {
    #[inline]
    fn root(&self) -> Node {
        Node::inner(0)
    }

    #[inline]
    fn children(&self, node: Node) -> u32 {
        (1 << self.nodes[node.index()].count) - 1
    }

    #[inline]
    fn leaves(&self, node: Node) -> u32 {
        self.nodes[node.index()].leaves
    }

    #[inline]
    fn child(&self, node: Node, slot: u32) -> Node {
        self.nodes[node.index()].children[slot as usize]
    }

    #[inline]
    fn levels(&self) -> u32 {
        self.levels
    }

    #[inline]
    fn ancestor(&self, node: Node, up: u32) -> Node {
        self.nodes[node.index()].ancestors[up as usize - 1]
    }
}

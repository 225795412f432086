//! A tree from any array of children, validated.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::{Node, Recorded, Topology, link_rows};

/// A binary tree in an array: node `i` is element `i`, the root is element 0, inner nodes and leaves mixed.
///
/// ```
/// use stackless_bvh::tree::{Topology, Tree};
/// // 0 has the children 1 and 2; 2 has 3 and 4.
/// let tree = Tree::new(&[Some([1, 2]), None, Some([3, 4]), None, None])?;
/// assert_eq!(tree.depth(), 2);
/// # Ok::<(), stackless_bvh::tree::TreeError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree {
    root: Node,
    /// By node number; unused for leaves.
    children: Vec<[Node; 2]>,
    depth: u32,
    recorded: Recorded,
    /// By node number; empty if nothing is recorded.
    links: Vec<[Node; 2]>,
}

/// Errors of [`Tree::new`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeError {
    /// The array is empty.
    Empty,
    /// More nodes than addresses.
    TooManyNodes {
        /// Number of nodes.
        nodes: usize,
    },
    /// The number of a child is out of range.
    OutOfRange {
        /// The parent.
        node: u32,
        /// The child's number.
        child: u32,
        /// Number of nodes.
        nodes: u32,
    },
    /// A node is reached a second time: it has two parents, or is its own descendant.
    ReachedTwice {
        /// The node.
        node: u32,
        /// The second parent.
        parent: u32,
    },
    /// A node is not reached from the root.
    NotReached {
        /// The first such node.
        node: u32,
    },
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Empty => write!(f, "a tree has at least one node"),
            Self::TooManyNodes { nodes } => {
                write!(f, "{nodes} nodes are more than the {} that an address can tell apart", Node::MAX_INDEX)
            }
            Self::OutOfRange { node, child, nodes } => {
                write!(f, "node {node}: child {child} is not one of the {nodes} nodes")
            }
            Self::ReachedTwice { node, parent } => {
                write!(f, "node {node} is reached a second time, from node {parent}")
            }
            Self::NotReached { node } => write!(f, "node {node} is not reached from the root, node 0"),
        }
    }
}

impl core::error::Error for TreeError {}

impl Tree {
    /// Builds a tree from the children of each node (`None` for a leaf). Node 0 is the root. `[TREE-2]`
    ///
    /// Linear in time and memory, without recursion, so any depth is supported.
    ///
    /// # Errors
    /// [`TreeError`] with the node at which the array is not a tree.
    pub fn new(children: &[Option<[u32; 2]>]) -> Result<Self, TreeError> {
        let address = |index: u32| {
            let leaf = children[index as usize].is_none();
            if leaf { Node::leaf(index) } else { Node::inner(index) }
        };
        let mut arena = vec![[Node::inner(0); 2]; children.len()];
        let mut deepest = 0;
        walk(children, |node, depth| {
            deepest = deepest.max(depth);
            if let Some(pair) = children[node as usize] {
                arena[node as usize] = pair.map(address);
            }
            Ok::<_, TreeError>(())
        })?;
        Ok(Self { root: address(0), children: arena, depth: deepest, recorded: Recorded::Nothing, links: Vec::new() })
    }

    /// Builds the tree of a generator, whose output is always a tree. If it were not, the result would be a single
    /// leaf, which the generators' tests would detect.
    pub fn from_generated(children: &[Option<[u32; 2]>]) -> Self {
        let tree = Self::new(children);
        debug_assert!(tree.is_ok(), "{tree:?}");
        tree.unwrap_or_else(|_| {
            let (root, children) = (Node::leaf(0), vec![[Node::inner(0); 2]]);
            Self { root, children, depth: 0, recorded: Recorded::Nothing, links: Vec::new() }
        })
    }

    /// Returns this tree with other references in its records.
    #[must_use]
    pub fn with_links(self, recorded: Recorded) -> Self {
        let links = if recorded == Recorded::Nothing { Vec::new() } else { link_rows(&self, recorded) };
        Self { recorded, links, ..self }
    }

    /// Returns the node with this number.
    pub fn node(&self, index: u32) -> Option<Node> {
        let pair = self.children.get(index as usize)?;
        // The root is no node's child, so only a leaf has it as a child.
        let leaf = pair[0] == Node::inner(0);
        Some(if leaf { Node::leaf(index) } else { Node::inner(index) })
    }

    /// Returns the array of children from which [`Tree::new`] builds this tree.
    pub fn to_children(&self) -> Vec<Option<[u32; 2]>> {
        let numbers = |pair: &[Node; 2]| pair.map(|child| child.index() as u32);
        self.children.iter().map(|pair| (pair[0] != Node::inner(0)).then(|| numbers(pair))).collect()
    }
}

/// Visits the nodes of an array of children, a parent before its children, with their depths: edges from node 0, the
/// root. All children of a visited node are in the array.
///
/// # Errors
/// [`TreeError`] if the array is not a tree; otherwise the first error of `visit`.
pub(crate) fn walk<L: AsRef<[u32]>, E: From<TreeError>>(
    children: &[Option<L>],
    mut visit: impl FnMut(u32, u32) -> Result<(), E>,
) -> Result<(), E> {
    let nodes = children.len();
    if nodes > Node::MAX_INDEX as usize {
        return Err(TreeError::TooManyNodes { nodes }.into());
    }
    if nodes == 0 {
        return Err(TreeError::Empty.into());
    }
    let mut is_reached = vec![false; nodes];
    is_reached[0] = true;
    let mut pending = vec![(0_u32, 0_u32)];
    while let Some((node, depth)) = pending.pop() {
        let list = children[node as usize].as_ref().map_or(&[][..], AsRef::as_ref);
        for &child in list {
            match is_reached.get_mut(child as usize) {
                None => return Err(TreeError::OutOfRange { node, child, nodes: nodes as u32 }.into()),
                Some(true) => return Err(TreeError::ReachedTwice { node: child, parent: node }.into()),
                Some(is_reached) => *is_reached = true,
            }
        }
        visit(node, depth)?;
        pending.extend(list.iter().rev().map(|&child| (child, depth + 1)));
    }
    match is_reached.iter().position(|is_reached| !is_reached) {
        Some(node) => Err(TreeError::NotReached { node: node as u32 }.into()),
        None => Ok(()),
    }
}

impl Topology for Tree {
    #[inline]
    fn root(&self) -> Node {
        self.root
    }

    #[inline]
    fn children(&self, node: Node) -> [Node; 2] {
        self.children[node.index()]
    }

    #[inline]
    fn node_count(&self) -> usize {
        self.children.len()
    }

    #[inline]
    fn slot(&self, node: Node) -> usize {
        node.index()
    }

    #[inline]
    fn depth(&self) -> u32 {
        self.depth
    }

    fn recorded(&self) -> Recorded {
        self.recorded
    }

    #[inline]
    fn links(&self, node: Node) -> [Node; 2] {
        self.links.get(node.index()).copied().unwrap_or([self.root; 2])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [TREE-2]
    #[test]
    fn errors_name_the_node() {
        let leaf = None;
        for (children, error, text) in [
            (vec![], TreeError::Empty, "a tree has at least one node"),
            (
                vec![Some([1, 7]), leaf, leaf],
                TreeError::OutOfRange { node: 0, child: 7, nodes: 3 },
                "node 0: child 7 is not one of the 3 nodes",
            ),
            (
                vec![Some([1, 1]), leaf],
                TreeError::ReachedTwice { node: 1, parent: 0 },
                "node 1 is reached a second time, from node 0",
            ),
            (
                vec![Some([1, 2]), leaf, Some([0, 3]), leaf],
                TreeError::ReachedTwice { node: 0, parent: 2 },
                "node 0 is reached a second time, from node 2",
            ),
            (
                vec![Some([1, 2]), leaf, leaf, Some([4, 5]), leaf, leaf],
                TreeError::NotReached { node: 3 },
                "node 3 is not reached from the root, node 0",
            ),
            (vec![leaf, leaf], TreeError::NotReached { node: 1 }, "node 1 is not reached from the root, node 0"),
        ] {
            assert_eq!(Tree::new(&children), Err(error));
            assert_eq!(alloc::string::ToString::to_string(&error), text);
        }
    }

    #[test]
    fn round_trip() {
        for children in [vec![None], vec![Some([2, 1]), None, Some([4, 3]), None, None]] {
            let tree = Tree::new(&children).unwrap();
            assert_eq!(tree.to_children(), children);
            for (i, pair) in children.iter().enumerate() {
                assert_eq!(tree.node(i as u32).map(Node::is_leaf), Some(pair.is_none()));
            }
            assert_eq!(tree.node(children.len() as u32), None);
        }
    }

    #[test]
    fn addresses_keep_the_top_bit_for_leaves() {
        assert_eq!(Node::MAX_INDEX, (1 << 31) - 2);
        // With one more, all bits plus one would be 0, which marks an empty cell of a table.
        assert_eq!(Node::leaf(Node::MAX_INDEX + 1).to_bits(), u32::MAX);
        for index in [0, 5, Node::MAX_INDEX] {
            let (inner, leaf) = (Node::inner(index), Node::leaf(index));
            assert_eq!((inner.to_bits(), leaf.to_bits()), (index, index + (1 << 31)));
            assert_eq!((inner.index(), leaf.index()), (index as usize, index as usize));
            assert!(!inner.is_leaf() && leaf.is_leaf());
            assert_eq!((Node::inner(index | 1 << 31), Node::leaf(index | 1 << 31)), (inner, leaf));
        }
    }
}

//! Cuts of a tree, and the pieces between them.

use alloc::vec;
use alloc::vec::Vec;
use core::mem::replace;

use crate::hash::Lookup;
use crate::key::{KeyWord, Side};
use crate::traverse::Method;
use crate::tree::{Node, Reach, Recorded, Topology, Tree};

/// A tree with cuts at regular levels.
///
/// The piece below a node is found in constant time, with one and a half bits of memory for each node of the tree.
#[derive(Debug)]
pub struct Cuts<'t, T> {
    levels: u32,
    top: Piece<'t, T>,
    /// The pieces with a piece above, by slot of their roots.
    below: Vec<Piece<'t, T>>,
    /// Whether a node is the root of a piece, by slot.
    marks: Vec<u64>,
    /// Number of marks before each word of them.
    before: Vec<u32>,
}

impl<'t, T: Topology> Cuts<'t, T> {
    /// Cuts a tree at its inner nodes of the depths `levels` (at least 1), 2 `levels` and so on. Linear time, except
    /// for the sorting of the pieces, and no recursion.
    pub fn every(levels: u32, tree: &'t T) -> Self {
        let levels = levels.max(1);
        let piece = |root| Piece { tree, root, levels, number: 0 };
        let mut marks = vec![0_u64; tree.node_count().div_ceil(64)];
        let (mut below, mut pending) = (Vec::new(), vec![tree.root()]);
        while let Some(root) = pending.pop() {
            let (nodes, children) = piece(root).shape();
            let is_end = |(node, children): (Node, Option<_>)| (children.is_none() && !node.is_leaf()).then_some(node);
            for node in nodes.into_iter().zip(children).filter_map(is_end) {
                let slot = tree.slot(node);
                marks[slot / 64] |= 1 << (slot % 64);
                below.push(piece(node));
                pending.push(node);
            }
        }
        below.sort_unstable_by_key(|piece| tree.slot(piece.root));
        for (number, piece) in (1..).zip(&mut below) {
            piece.number = number;
        }
        let counts = marks.iter().map(|marks| marks.count_ones());
        let before = counts.scan(0, |sum, count| Some(replace(sum, *sum + count))).collect();
        Self { levels, top: piece(tree.root()), below, marks, before }
    }

    /// Returns the piece with the tree's root.
    pub fn top(&self) -> &Piece<'t, T> {
        &self.top
    }

    /// Returns the piece whose root is this node, which is also a node of the piece above.
    #[inline]
    pub fn below(&self, node: Node) -> Option<&Piece<'t, T>> {
        let slot = self.top.tree.slot(node);
        let (word, bit) = (slot / 64, 1 << (slot % 64));
        let marks = self.marks[word];
        if marks & bit == 0 {
            return None;
        }
        self.below.get(self.before[word] as usize + (marks & (bit - 1)).count_ones() as usize)
    }

    /// Returns all pieces, by their numbers.
    pub fn pieces(&self) -> impl Iterator<Item = &Piece<'t, T>> {
        [&self.top].into_iter().chain(&self.below)
    }

    /// Makes a table of each piece, by its number.
    ///
    /// # Errors
    /// The first error of `make`.
    pub fn tables<L, E>(&self, mut make: impl FnMut(&Tree) -> Result<L, E>) -> Result<Vec<PieceTable<L>>, E> {
        self.pieces().map(|piece| piece.table(&mut make)).collect()
    }

    /// Returns the memory of pieces and marks, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.below) + size_of_val(&*self.marks) + size_of_val(&*self.before)
    }

    /// Returns the greatest number of pieces on a path from the root: depth by levels, rounded up, and at least 1.
    pub fn nesting(&self) -> u32 {
        self.top.tree.depth().div_ceil(self.levels).max(1)
    }

    /// Returns the bytes of the state for one search by a traversal in this word: the traversal's state in a tree of a
    /// piece's depth, for each piece on the path.
    pub fn state_bytes<W: KeyWord>(&self, method: Method) -> usize {
        self.nesting() as usize * method.state_bytes::<W>(self.top.depth())
    }
}

/// The part of a tree between cuts, for cursors: the tree from another root, with the slots and links of the whole
/// tree.
///
/// A cut node is an inner node to a cursor, which does not go further. A walk over all children does not detect the end
/// of a piece: [`table`](Self::table) makes tables.
#[derive(Debug)]
pub struct Piece<'t, T> {
    tree: &'t T,
    root: Node,
    levels: u32,
    number: u32,
}

impl<T: Topology> Piece<'_, T> {
    /// Returns the number of the piece: 0 for the piece with the tree's root.
    #[inline]
    pub fn number(&self) -> usize {
        self.number as usize
    }

    /// Computes a table of the piece alone, for a tree of its shape in which cut nodes are leaves.
    ///
    /// Records of cut nodes are those of inner nodes. So a hash for records with more references at leaves than at
    /// inner nodes must be made for the reach of inner nodes ([`Reach`]).
    ///
    /// # Errors
    /// Those of `make`.
    pub fn table<L, E>(&self, make: impl FnOnce(&Tree) -> Result<L, E>) -> Result<PieceTable<L>, E> {
        let (nodes, children) = self.shape();
        Ok(PieceTable { table: make(&Tree::from_generated(&children))?, nodes })
    }

    /// Returns all nodes, by level, and for each the numbers of its children among them: none for leaves and cut nodes.
    fn shape(&self) -> (Vec<Node>, Vec<Option<[u32; 2]>>) {
        let (mut nodes, mut children) = (vec![self.root], vec![None]);
        let mut level = 0..1;
        for _ in 0..self.levels {
            if level.is_empty() {
                break;
            }
            for parent in level.clone().filter(|&i| !nodes[i].is_leaf()).collect::<Vec<_>>() {
                let first = nodes.len() as u32;
                children[parent] = Some([first, first + 1]);
                nodes.extend(self.tree.children(nodes[parent]));
                children.extend([None; 2]);
            }
            level = level.end..nodes.len();
        }
        (nodes, children)
    }
}

impl<T: Topology> Topology for Piece<'_, T> {
    const REACH: Reach = T::REACH;

    #[inline]
    fn root(&self) -> Node {
        self.root
    }

    #[inline]
    fn children(&self, node: Node) -> [Node; 2] {
        self.tree.children(node)
    }

    #[inline]
    fn child(&self, node: Node, side: Side) -> Node {
        self.tree.child(node, side)
    }

    fn node_count(&self) -> usize {
        self.tree.node_count()
    }

    #[inline]
    fn slot(&self, node: Node) -> usize {
        self.tree.slot(node)
    }

    /// A bound for every piece: the levels between cuts, or the depth of the whole tree if that is less.
    #[inline]
    fn depth(&self) -> u32 {
        self.levels.min(self.tree.depth())
    }

    fn recorded(&self) -> Recorded {
        self.tree.recorded()
    }

    #[inline]
    fn links(&self, node: Node) -> [Node; 2] {
        self.tree.links(node)
    }

    fn names(&self, what: Recorded) -> bool {
        self.tree.names(what)
    }

    #[inline]
    fn parent(&self, node: Node) -> Node {
        self.tree.parent(node)
    }

    #[inline]
    fn sibling(&self, node: Node) -> Node {
        self.tree.sibling(node)
    }

    #[inline]
    fn uncles(&self, node: Node) -> [Node; 3] {
        self.tree.uncles(node)
    }
}

/// A table from the keys of a piece, which start at its root, to the nodes of the whole tree.
#[derive(Clone, Debug)]
pub struct PieceTable<L> {
    table: L,
    /// The piece's nodes, by their number in the table's tree.
    nodes: Vec<Node>,
}

impl<L> PieceTable<L> {
    /// Returns the table, for a tree of the piece's shape.
    pub fn table(&self) -> &L {
        &self.table
    }

    /// Returns the memory of the addresses, without the table, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }
}

impl<W, L: Lookup<W>> Lookup<W> for PieceTable<L> {
    #[inline]
    fn node(&self, key: &W) -> Node {
        let node = self.nodes.get(self.table.node(key).index()).copied();
        debug_assert!(node.is_some(), "no node has this key");
        node.unwrap_or(Node::inner(0))
    }
}

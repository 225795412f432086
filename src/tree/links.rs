//! Tables of references beyond the children, for any topology.

use alloc::vec;
use alloc::vec::Vec;

use super::{Node, Recorded, Topology};

/// A table of parents and siblings, by slot.
#[derive(Clone, Debug)]
pub struct Parents {
    rows: Vec<[Node; 2]>,
}

impl Parents {
    /// Computes the table of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        Self { rows: link_rows(tree, Recorded::ParentSibling) }
    }

    /// Returns parent and sibling of a node of that tree.
    #[inline(always)]
    pub fn row(&self, tree: &impl Topology, node: Node) -> [Node; 2] {
        self.rows[tree.slot(node)]
    }

    /// Returns the memory of the references, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }
}

/// Tables of the links that the records of a tree do not have.
#[derive(Clone, Debug, Default)]
pub struct Links {
    pub(super) parents: Option<Parents>,
    pub(super) uncles: Option<Uncles>,
}

impl Links {
    /// Computes the listed links, except those that the tree already has.
    pub fn of(tree: &impl Topology, what: &[Recorded]) -> Self {
        let wants = |links| what.contains(&links) && !tree.names(links);
        let parents = wants(Recorded::ParentSibling).then(|| Parents::of(tree));
        let uncles = wants(Recorded::Uncles).then(|| Uncles::of(tree));
        Self { parents, uncles }
    }

    /// Returns the memory of the tables, in bytes.
    pub fn bytes(&self) -> usize {
        self.parents.as_ref().map_or(0, Parents::bytes) + self.uncles.as_ref().map_or(0, Uncles::bytes)
    }
}

/// Returns the two nodes for each record, by slot.
pub(crate) fn link_rows(tree: &impl Topology, what: Recorded) -> Vec<[Node; 2]> {
    let root = tree.root();
    let mut rows = vec![[root; 2]; tree.node_count()];
    match what {
        Recorded::Nothing => {}
        Recorded::ParentSibling => for_each_parent(tree, |parent, [left, right]| {
            rows[tree.slot(left)] = [parent, right];
            rows[tree.slot(right)] = [parent, left];
        }),
        Recorded::Uncles => {
            for (row, [uncle, grand_uncle, _]) in rows.iter_mut().zip(uncle_rows(tree)) {
                *row = [uncle, grand_uncle];
            }
        }
    }
    rows
}

/// The number of ancestors' siblings in a record: 1 the uncle, 2 also the grand uncle, 3 also the grand grand uncle.
///
/// The text of Binder & Keller gives leaves three references, their Algorithm 1 and Fig. 5 two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    inner: u32,
    leaf: u32,
}

impl Reach {
    /// Two for inner nodes and two for leaves: Algorithm 1 and Fig. 5.
    pub const ALGORITHM_1: Self = Self { inner: 2, leaf: 2 };
    /// Two for inner nodes and three for leaves: Section 2.1.
    pub const SECTION_2_1: Self = Self { inner: 2, leaf: 3 };

    /// Creates any reach from 1 to 3; `None` for other numbers.
    pub const fn new(inner: u32, leaf: u32) -> Option<Self> {
        let fits = matches!(inner, 1..=3) && matches!(leaf, 1..=3);
        if fits { Some(Self { inner, leaf }) } else { None }
    }

    /// Returns the number for a record of this kind.
    #[inline]
    pub const fn of(self, leaf: bool) -> u32 {
        if leaf { self.leaf } else { self.inner }
    }

    /// Returns the trail bits whose nodes are in a record of this kind, from bit 1 up (0x6 for a reach of two).
    #[inline]
    pub const fn mask(self, leaf: bool) -> u32 {
        (2 << self.of(leaf)) - 2
    }
}

/// A table of uncles, grand uncles and grand grand uncles, by slot.
#[derive(Clone, Debug)]
pub struct Uncles {
    rows: Vec<[Node; 3]>,
}

impl Uncles {
    /// Computes the table of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        Self { rows: uncle_rows(tree) }
    }

    /// Returns uncle, grand uncle and grand grand uncle of a node of that tree.
    #[inline(always)]
    pub fn row(&self, tree: &impl Topology, node: Node) -> [Node; 3] {
        self.rows[tree.slot(node)]
    }

    /// Returns the memory of the references, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }
}

/// Returns uncle, grand uncle and grand grand uncle of every node, by slot.
fn uncle_rows(tree: &impl Topology) -> Vec<[Node; 3]> {
    let root = tree.root();
    let mut rows = vec![[root; 3]; tree.node_count()];
    // Parents come before their children: a child's uncles are its parent's, moved up by one.
    let mut siblings = vec![root; tree.node_count()];
    for_each_parent(tree, |parent, children| {
        let slot = tree.slot(parent);
        let [uncle, grand_uncle, _] = rows[slot];
        for (child, sibling) in [(children[0], children[1]), (children[1], children[0])] {
            rows[tree.slot(child)] = [siblings[slot], uncle, grand_uncle];
            siblings[tree.slot(child)] = sibling;
        }
    });
    rows
}

/// Calls `f` for each inner node and its children, parents before children, without recursion.
pub(crate) fn for_each_parent<T: Topology>(tree: &T, mut f: impl FnMut(Node, [Node; 2])) {
    // At most one more than the tree's depth: if that is small, it is allocated once.
    let mut pending = Vec::with_capacity(tree.depth().min(63) as usize + 1);
    pending.push(tree.root());
    while let Some(node) = pending.pop() {
        if !node.is_leaf() {
            let children = tree.children(node);
            f(node, children);
            pending.extend(children);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::{Linked, Tree};

    #[test]
    fn the_tree_of_figure_2() {
        // Keys 1; 2 3; 4 5; 10 11; 22 23 as nodes 0; 1 2; 3 4; 5 6; 7 8.
        let leaf = None;
        let children = [Some([1, 2]), Some([3, 4]), leaf, leaf, Some([5, 6]), leaf, Some([7, 8]), leaf, leaf];
        let tree = Tree::new(&children).unwrap();
        let node = |i| tree.node(i).unwrap();
        let uncles = Uncles::of(&tree);
        assert_eq!(uncles.row(&tree, node(7)), [node(5), node(3), node(2)]);
        assert_eq!(uncles.row(&tree, node(1)), [node(0); 3]);

        let far = Linked::<_, 2, 3>::reaching(&tree);
        assert_eq!(far.lowest_pending(node(7), 0b1000, node(0)), node(2));
        assert_eq!(far.lowest_pending(node(7), 0b1101, node(0)), node(3));
        assert_eq!(far.lowest_pending(node(7), 0b1_0001, node(8)), node(8));
        assert_eq!(Linked::uncles(&tree).lowest_pending(node(7), 0b1000, node(8)), node(8));

        let parents = Parents::of(&tree);
        assert_eq!((parents.row(&tree, node(7)), parents.row(&tree, node(0))), ([node(6), node(8)], [node(0); 2]));
    }

    #[test]
    fn records_are_the_tables() {
        let leaf = None;
        let children = [Some([1, 2]), Some([3, 4]), leaf, leaf, Some([5, 6]), leaf, Some([7, 8]), leaf, leaf];
        let nothing = Tree::new(&children).unwrap();
        let (uncles, parents) = (Uncles::of(&nothing), Parents::of(&nothing));
        assert_eq!((parents.bytes(), uncles.bytes()), (8 * 9, 12 * 9));
        let wants = [Recorded::Nothing, Recorded::ParentSibling, Recorded::Uncles];
        let names = |tree: &dyn Fn(Recorded) -> bool| wants.map(tree);
        assert_eq!(names(&|what| nothing.names(what)), [true, false, false]);
        assert_eq!((nothing.recorded(), nothing.links(nothing.root())), (Recorded::Nothing, [nothing.root(); 2]));

        let with_parents = nothing.clone().with_links(Recorded::ParentSibling);
        let with_uncles = nothing.clone().with_links(Recorded::Uncles);
        assert_eq!(names(&|what| with_parents.names(what)), [true, true, false]);
        assert_eq!(names(&|what| with_uncles.names(what)), [true, false, true]);
        // The tables omit links that are in the records.
        let [beside_parents, beside_uncles] = [&with_parents, &with_uncles].map(Linked::both);
        assert_eq!((beside_parents.bytes(), beside_uncles.bytes()), (uncles.bytes(), parents.bytes()));
        assert_eq!(Linked::both(&nothing).bytes(), uncles.bytes() + parents.bytes());
        assert_eq!(names(&|what| Linked::both(&nothing).names(what)), [true; 3]);
        assert_eq!(names(&|what| Linked::parents(&nothing).names(what)), [true, true, false]);
        assert_eq!(names(&|what| Linked::uncles(&nothing).names(what)), [true, false, true]);
        // Records of two do not reach as far as three.
        assert!(Linked::<_, 2, 3>::reaching(&with_uncles).bytes() > 0);
        for i in 0..9 {
            let node = nothing.node(i).unwrap();
            for tree in [&beside_parents, &beside_uncles, &Linked::both(&nothing)] {
                assert_eq!([tree.parent(node), tree.sibling(node)], parents.row(&nothing, node));
                assert_eq!(tree.uncles(node)[..2], uncles.row(&nothing, node)[..2]);
            }
        }
    }

    #[test]
    fn a_reach_is_one_to_three_and_a_mask() {
        for (inner, leaf) in (0..5).flat_map(|inner| (0..5).map(move |leaf| (inner, leaf))) {
            let reach = Reach::new(inner, leaf);
            assert_eq!(reach.is_some(), (1..=3).contains(&inner) && (1..=3).contains(&leaf));
            let of = |is_leaf| reach.map(|reach| (reach.of(is_leaf), reach.mask(is_leaf)));
            let mask = |n: u32| (1..=n).map(|bit| 1 << bit).sum::<u32>();
            assert_eq!((of(false), of(true)), (reach.map(|_| (inner, mask(inner))), reach.map(|_| (leaf, mask(leaf)))));
        }
    }
}

//! References beyond the children: tables beside a tree, made from any topology.

use alloc::vec;
use alloc::vec::Vec;
use core::hint::select_unpredictable;

use super::{Node, Recorded, Topology};

/// Where [`Afra`](crate::traverse::Afra), [`Sparse`](crate::traverse::Sparse) and [`Hapala`](crate::traverse::Hapala)
/// find parents and siblings: in a table, `&`[`Parents`], or in the tree's own records, [`RecordedParents`].
///
/// The root is its own parent and its own sibling: Barringer & Akenine-Möller's Algorithm 4 ends by that.
pub trait ParentLinks<T> {
    /// Parent and sibling of a node.
    fn row(&self, tree: &T, node: Node) -> [Node; 2];

    /// Parent of a node.
    #[inline(always)]
    fn parent(&self, tree: &T, node: Node) -> Node {
        self.row(tree, node)[0]
    }

    /// Sibling of a node.
    #[inline(always)]
    fn sibling(&self, tree: &T, node: Node) -> Node {
        self.row(tree, node)[1]
    }
}

/// A table of parents and siblings, by slot.
#[derive(Clone, Debug)]
pub struct Parents {
    rows: Vec<[Node; 2]>,
}

impl Parents {
    /// The table of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        Self { rows: link_rows(tree, Recorded::ParentSibling) }
    }

    /// Memory of the references, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }
}

impl<T: Topology> ParentLinks<T> for &Parents {
    #[inline(always)]
    fn row(&self, tree: &T, node: Node) -> [Node; 2] {
        self.rows[tree.slot(node)]
    }
}

/// Parents and siblings as the records of a tree name them.
#[derive(Clone, Copy, Debug)]
pub struct RecordedParents(());

impl RecordedParents {
    /// For a tree whose records name them.
    pub fn of(tree: &impl Topology) -> Option<Self> {
        (tree.recorded() == Recorded::ParentSibling).then_some(Self(()))
    }
}

impl<T: Topology> ParentLinks<T> for RecordedParents {
    #[inline(always)]
    fn row(&self, tree: &T, node: Node) -> [Node; 2] {
        tree.links(node)
    }
}

/// The two nodes that each record is to name, by slot.
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

/// How many ancestors' siblings a record stores: 1 the uncle, 2 the grand uncle too, 3 the grand grand uncle too.
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

    /// Any reach from 1 to 3; `None` for others.
    pub const fn new(inner: u32, leaf: u32) -> Option<Self> {
        let fits = matches!(inner, 1..=3) && matches!(leaf, 1..=3);
        if fits { Some(Self { inner, leaf }) } else { None }
    }

    /// How many a record of this kind names.
    #[inline]
    pub const fn of(self, leaf: bool) -> u32 {
        if leaf { self.leaf } else { self.inner }
    }

    /// Trail bits whose nodes a record of this kind names, from bit 1 up (0x6 for a reach of two).
    #[inline]
    pub const fn mask(self, leaf: bool) -> u32 {
        (2 << self.of(leaf)) - 2
    }
}

/// Where [`Hashed`](crate::traverse::Hashed) and [`Uncle`](crate::traverse::Uncle) find uncle, grand uncle and grand grand
/// uncle, the siblings of a node's parent, grandparent and so on: in a table, `&`[`Uncles`], or in the tree's own records,
/// [`RecordedUncles`]. Where there is none, it is the root, which is never postponed. `[UNCLE-1]`
pub trait UncleLinks<T> {
    /// How many of them a record is taken to name.
    const REACH: Reach;

    /// The references of a node: uncle, grand uncle, and grand grand uncle if the reach is three.
    fn row(&self, tree: &T, node: Node) -> [Node; 3];

    /// The lowest postponed node that the record of `node` names, given the low bits of its trail; `otherwise` if it
    /// names none. `[UNCLE-2]`
    ///
    /// Without a branch: which bits of a trail are set is hard to predict, and the trail is known early.
    #[inline(always)]
    fn lowest_pending(&self, tree: &T, node: Node, trail: u32, otherwise: Node) -> Node {
        let pending = trail & Self::REACH.mask(node.is_leaf());
        let [uncle, grand_uncle, grand_grand_uncle] = self.row(tree, node);
        let named = select_unpredictable(pending & 8 != 0, grand_grand_uncle, otherwise);
        let named = select_unpredictable(pending & 4 != 0, grand_uncle, named);
        select_unpredictable(pending & 2 != 0, uncle, named)
    }

    /// The same on the way down from an inner node, of what the child's record, be it a leaf's or not, will not name any
    /// more; `otherwise` also where the child still names the lowest one.
    #[inline(always)]
    fn lowest_leaving(&self, tree: &T, node: Node, trail: u32, otherwise: Node) -> Node {
        // Bit b of the trail is bit b + 1 at the child. (Bit 0, which no record names, has its node in the register.)
        let named_below = (Self::REACH.mask(false) & Self::REACH.mask(true)) >> 1;
        let lowest = self.lowest_pending(tree, node, trail & !named_below, otherwise);
        select_unpredictable(trail & named_below != 0, otherwise, lowest)
    }
}

/// A table of uncles, grand uncles and grand grand uncles, by slot, of which records of inner nodes are taken to name the
/// first `INNER` and those of leaves the first `LEAF` (1 to 3, else it does not compile).
#[derive(Clone, Debug)]
pub struct Uncles<const INNER: u32 = 2, const LEAF: u32 = 2> {
    rows: Vec<[Node; 3]>,
}

impl<const INNER: u32, const LEAF: u32> Uncles<INNER, LEAF> {
    /// How far records reach.
    pub const REACH: Reach = match Reach::new(INNER, LEAF) {
        Some(reach) => reach,
        None => panic!("a record reaches from 1 to 3"),
    };

    /// The table of a tree.
    pub fn of(tree: &impl Topology) -> Self {
        Self { rows: uncle_rows(tree) }
    }

    /// Memory of the references, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }
}

impl<T: Topology, const INNER: u32, const LEAF: u32> UncleLinks<T> for &Uncles<INNER, LEAF> {
    const REACH: Reach = Uncles::<INNER, LEAF>::REACH;

    #[inline(always)]
    fn row(&self, tree: &T, node: Node) -> [Node; 3] {
        self.rows[tree.slot(node)]
    }
}

/// Uncle and grand uncle as the records of a tree name them: the reach of Algorithm 1.
#[derive(Clone, Copy, Debug)]
pub struct RecordedUncles(());

impl RecordedUncles {
    /// For a tree whose records name them.
    pub fn of(tree: &impl Topology) -> Option<Self> {
        (tree.recorded() == Recorded::Uncles).then_some(Self(()))
    }
}

impl<T: Topology> UncleLinks<T> for RecordedUncles {
    const REACH: Reach = Reach::ALGORITHM_1;

    #[inline(always)]
    fn row(&self, tree: &T, node: Node) -> [Node; 3] {
        let [uncle, grand_uncle] = tree.links(node);
        [uncle, grand_uncle, tree.root()]
    }
}

/// Uncle, grand uncle and grand grand uncle of every node, by slot.
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
    let mut pending = vec![tree.root()];
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
    use crate::tree::Tree;

    #[test]
    fn the_tree_of_figure_2() {
        // Keys 1; 2 3; 4 5; 10 11; 22 23 as nodes 0; 1 2; 3 4; 5 6; 7 8.
        let leaf = None;
        let children = [Some([1, 2]), Some([3, 4]), leaf, leaf, Some([5, 6]), leaf, Some([7, 8]), leaf, leaf];
        let tree = Tree::new(&children).unwrap();
        let node = |i| tree.node(i).unwrap();
        let uncles = &Uncles::<2, 3>::of(&tree);
        assert_eq!(uncles.row(&tree, node(7)), [node(5), node(3), node(2)]);
        assert_eq!(uncles.lowest_pending(&tree, node(7), 0b1000, node(0)), node(2));
        assert_eq!(uncles.lowest_pending(&tree, node(7), 0b1101, node(0)), node(3));
        assert_eq!(uncles.lowest_pending(&tree, node(7), 0b1_0001, node(8)), node(8));
        assert_eq!((&Uncles::<2, 2>::of(&tree)).lowest_pending(&tree, node(7), 0b1000, node(8)), node(8));
        assert_eq!(uncles.row(&tree, node(1)), [node(0); 3]);

        let parents = &Parents::of(&tree);
        let of = |i| (parents.parent(&tree, node(i)), parents.sibling(&tree, node(i)));
        assert_eq!(of(7), (node(6), node(8)));
        assert_eq!(of(0), (node(0), node(0)));
    }

    /// A tree whose records name what is beside its children.
    struct Records(Tree, Recorded);

    impl Topology for Records {
        fn root(&self) -> Node {
            self.0.root()
        }
        fn children(&self, node: Node) -> [Node; 2] {
            self.0.children(node)
        }
        fn node_count(&self) -> usize {
            self.0.node_count()
        }
        fn slot(&self, node: Node) -> usize {
            self.0.slot(node)
        }
        fn depth(&self) -> u32 {
            self.0.depth()
        }
        fn recorded(&self) -> Recorded {
            self.1
        }
        fn links(&self, node: Node) -> [Node; 2] {
            link_rows(&self.0, self.1)[self.0.slot(node)]
        }
    }

    #[test]
    fn records_are_the_tables() {
        let leaf = None;
        let children = [Some([1, 2]), Some([3, 4]), leaf, leaf, Some([5, 6]), leaf, Some([7, 8]), leaf, leaf];
        let tree = || Tree::new(&children).unwrap();
        let (uncles, parents) = (&Uncles::<2, 3>::of(&tree()), &Parents::of(&tree()));
        assert_eq!((parents.bytes(), uncles.bytes()), (8 * 9, 12 * 9));
        let nothing = tree();
        assert!(RecordedParents::of(&nothing).is_none() && RecordedUncles::of(&nothing).is_none());
        assert_eq!((nothing.recorded(), nothing.links(nothing.root())), (Recorded::Nothing, [nothing.root(); 2]));

        let with_parents = Records(tree(), Recorded::ParentSibling);
        let recorded = RecordedParents::of(&with_parents).unwrap();
        assert!(RecordedUncles::of(&with_parents).is_none());
        let with_uncles = Records(tree(), Recorded::Uncles);
        let of_uncles = RecordedUncles::of(&with_uncles).unwrap();
        assert!(RecordedParents::of(&with_uncles).is_none());
        for i in 0..9 {
            let node = nothing.node(i).unwrap();
            assert_eq!(recorded.row(&with_parents, node), parents.row(&nothing, node));
            assert_eq!(of_uncles.row(&with_uncles, node)[..2], uncles.row(&nothing, node)[..2]);
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

//! Records of any reach: the register holds the same node at every turn, whenever it is filled, and the climb finds it.

use std::cell::RefCell;

use stackless_bvh::event::Trace;
use stackless_bvh::generate::{Exhaustive, Kind, Search, Source, Tape, shape};
use stackless_bvh::hash::Lookup;
use stackless_bvh::key::KeyWord;
use stackless_bvh::traverse::{Cursor, Hashed, Stack, Uncle, traverse};
use stackless_bvh::tree::{Keys, Linked, Node, Reach, Recorded, Topology, Tree};

/// Records whose nodes are taken whenever one is loaded, as the paper prints it.
struct Printed<'a, const INNER: u32, const LEAF: u32>(Linked<'a, Tree, INNER, LEAF>);

impl<const INNER: u32, const LEAF: u32> Topology for Printed<'_, INNER, LEAF> {
    const REACH: Reach = Linked::<Tree, INNER, LEAF>::REACH;

    stackless_bvh::topology_of!(0);

    fn names(&self, what: Recorded) -> bool {
        self.0.names(what)
    }

    fn uncles(&self, node: Node) -> [Node; 3] {
        self.0.uncles(node)
    }

    fn lowest_leaving(&self, node: Node, trail: u32, otherwise: Node) -> Node {
        self.lowest_pending(node, trail, otherwise)
    }
}

/// Finds any key, and records the lookups.
struct Asked<'a> {
    tree: &'a Tree,
    nodes: RefCell<Vec<Node>>,
}

impl<W: KeyWord> Lookup<W> for Asked<'_> {
    fn node(&self, key: &W) -> Node {
        let node = Keys::walk(self.tree, key).expect("a key of the tree");
        self.nodes.borrow_mut().push(node);
        node
    }
}

fn run(tree: &Tree, tape: &Tape, cursor: impl Cursor) -> Trace {
    let mut trace = Trace::default();
    traverse(cursor, &mut Search::new(tree, tape, false), &mut trace);
    trace
}

fn same_lookups<const INNER: u32, const LEAF: u32>(tree: &Tree, tape: &Tape, expected: &Trace) -> usize {
    let uncles = Linked::<_, INNER, LEAF>::reaching(tree);
    let as_printed = Printed(Linked::<_, INNER, LEAF>::reaching(tree));
    let [late, printed] = [(); 2].map(|()| Asked { tree, nodes: RefCell::default() });
    let hashed = Hashed::<u32, _, _>::new(&uncles, &late).expect("a shallow tree");
    assert_eq!(run(tree, tape, hashed), *expected, "({INNER}, {LEAF}) {tree:?} {tape:?}");
    let hashed = Hashed::<u32, _, _>::new(&as_printed, &printed).expect("a shallow tree");
    assert_eq!(run(tree, tape, hashed), *expected, "({INNER}, {LEAF}) {tree:?} {tape:?}");
    let [late, printed] = [late, printed].map(|asked| asked.nodes.into_inner());
    assert_eq!(late, printed, "({INNER}, {LEAF}) {tree:?} {tape:?}");
    late.len()
}

fn climbs<const INNER: u32, const LEAF: u32>(tree: &Tree, tape: &Tape, expected: &Trace) {
    let uncles = Linked::<_, INNER, LEAF>::reaching(tree);
    let uncle = Uncle::<u32, _>::new(&uncles).expect("a shallow tree");
    assert_eq!(run(tree, tape, uncle), *expected, "({INNER}, {LEAF}) {tree:?} {tape:?}");
}

/// [REGISTER-2] [UNCLE-2]
#[test]
fn all_trees_of_up_to_6_leaves_at_all_reaches() {
    let (mut all, mut memory, mut lookups) = (Exhaustive::new(), Vec::new(), [0; 9]);
    while all.next_case() {
        let leaves = 1 + all.below(6) as u32;
        let tree = Tree::new(&shape(&mut all, leaves)).expect("a tree");
        let tape = Tape::draw(&mut all, &tree, Kind::Script);
        let expected = run(&tree, &tape, Stack::new(&tree, &mut memory));
        let asked = [
            same_lookups::<1, 1>(&tree, &tape, &expected),
            same_lookups::<1, 2>(&tree, &tape, &expected),
            same_lookups::<1, 3>(&tree, &tape, &expected),
            same_lookups::<2, 1>(&tree, &tape, &expected),
            same_lookups::<2, 2>(&tree, &tape, &expected),
            same_lookups::<2, 3>(&tree, &tape, &expected),
            same_lookups::<3, 1>(&tree, &tape, &expected),
            same_lookups::<3, 2>(&tree, &tape, &expected),
            same_lookups::<3, 3>(&tree, &tape, &expected),
        ];
        lookups.iter_mut().zip(asked).for_each(|(sum, asked)| *sum += asked);
        climbs::<2, 2>(&tree, &tape, &expected);
        climbs::<2, 3>(&tree, &tape, &expected);
        climbs::<3, 2>(&tree, &tape, &expected);
        climbs::<3, 3>(&tree, &tape, &expected);
    }
    // Records of greater reach need fewer lookups.
    assert!(
        lookups.iter().all(|&asked| asked > 0) && lookups[0] > lookups[4] && lookups[4] > lookups[8],
        "{lookups:?}"
    );
}

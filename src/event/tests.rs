use super::*;
use crate::order::{Descent, Side, Visitor};
use crate::tree::Tree;

/// Returns a state with all optional parts.
fn full(is_restarting: bool) -> State<u32> {
    State {
        node: Node::inner(2),
        key: Some(5),
        trail: Some(6),
        counter: Some(7),
        disjoint: Some(8),
        register: Some(Node::leaf(9)),
        is_restarting,
    }
}

#[test]
fn what_a_traversal_does_not_have_is_none() {
    let State { node, key, trail, counter, disjoint, register, is_restarting } = State::<u32>::of(Node::leaf(3));
    assert_eq!((node, [key, trail, counter, disjoint]), (Node::leaf(3), [None; 4]));
    assert_eq!((register, is_restarting), (None, false));
}

#[test]
fn words_are_changed_one_by_one_and_nothing_else_is() {
    for is_restarting in [false, true] {
        let mapped = full(is_restarting).map(|word| (word != 7).then_some(u64::from(word) << 32));
        let [key, trail, disjoint] = [5, 6, 8].map(|word| Some(word << 32));
        let State { node, register, .. } = full(is_restarting);
        assert_eq!(mapped, State { node, key, trail, counter: None, disjoint, register, is_restarting });
    }
}

#[test]
fn restarts_are_left_out_of_a_trace_and_clearing_empties_it() {
    let mut trace = Trace::default();
    assert_eq!(trace.visit(Node::inner(2), || full(false)), Flow::Continue);
    assert_eq!(trace.revisit(Node::inner(2), || full(true)), Flow::Continue);
    assert_eq!(trace.nodes(), [Node::inner(2)]);
    trace.clear();
    assert!(trace.nodes().is_empty());
}

/// Visits the left child first, and no child of one node.
struct But(usize);

impl Visitor for But {
    fn inner(&mut self, node: Node) -> Descent {
        if node.index() == self.0 { Descent::NEITHER } else { Descent::both(Side::Left) }
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

/// [TRACE-1]
#[test]
fn backtracks_name_the_key_and_the_levels() {
    use Event::{Backtrack, End, Enter, Leaf};
    let leaf = None;
    // Keys 1; 2 3; 4 5; 8 9 as nodes 0; 1 2; 3 4; 5 6.
    let children = [Some([1, 2]), Some([3, 4]), leaf, Some([5, 6]), leaf, leaf, leaf];
    let tree = Tree::new(&children).unwrap();
    let keys = Keys::of(&tree);
    let events = |visitor: &mut But| {
        let mut trace = Trace::default();
        crate::oracle::traverse(&tree, visitor, &mut trace);
        trace.events::<u32>(&tree, &keys).collect::<Vec<_>>()
    };
    let whole = [Enter(1), Enter(2), Enter(4), Leaf(8), Backtrack(9, 0), Leaf(9), Backtrack(5, 1), Leaf(5)];
    assert_eq!(events(&mut But(9)), [&whole[..], &[Backtrack(3, 1), Leaf(3), End]].concat());
    // After an inner node without wanted children, the next node is not its child.
    let cut = [Enter(1), Enter(2), Enter(4), Backtrack(5, 0), Leaf(5), Backtrack(3, 1), Leaf(3), End];
    assert_eq!(events(&mut But(3)), cut);
    assert_eq!(events(&mut But(1)), [Enter(1), Enter(2), Backtrack(3, 0), Leaf(3), End]);
}

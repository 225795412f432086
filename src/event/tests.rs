use super::*;
use crate::order::{Descent, Side, Visitor};
use crate::tree::Tree;

/// Knows where it is, and nothing else.
struct Bare;

impl State for Bare {
    type Word = u32;

    fn node(&self) -> Node {
        Node::leaf(3)
    }
}

/// Has all that a state can have.
struct Full {
    restarts: bool,
}

impl State for Full {
    type Word = u32;

    fn node(&self) -> Node {
        Node::inner(2)
    }
    fn key(&self) -> Option<u32> {
        Some(5)
    }
    fn trail(&self) -> Option<u32> {
        Some(6)
    }
    fn counter(&self) -> Option<u32> {
        Some(7)
    }
    fn disjoint(&self) -> Option<u32> {
        Some(8)
    }
    fn register(&self) -> Option<Node> {
        Some(Node::leaf(9))
    }
    fn is_restarting(&self) -> bool {
        self.restarts
    }
}

type All = (Node, [Option<u32>; 4], Option<Node>, bool);

fn all(state: impl State<Word = u32>) -> All {
    let words = [state.key(), state.trail(), state.counter(), state.disjoint()];
    (state.node(), words, state.register(), state.is_restarting())
}

#[test]
fn what_a_traversal_does_not_have_is_none() {
    assert_eq!(all(Bare), (Node::leaf(3), [None; 4], None, false));
    assert_eq!(all(&mut Bare), all(Bare));
}

#[test]
fn a_borrowed_state_is_the_state() {
    for restarts in [false, true] {
        let expected = (Node::inner(2), [Some(5), Some(6), Some(7), Some(8)], Some(Node::leaf(9)), restarts);
        assert_eq!((all(Full { restarts }), all(&mut Full { restarts })), (expected, expected));
    }
}

#[test]
fn restarts_are_left_out_of_a_trace_and_clearing_empties_it() {
    let mut trace = Trace::default();
    for restarts in [false, true] {
        assert_eq!(trace.visit(&Full { restarts }), Flow::Continue);
    }
    assert_eq!(trace.nodes(), [Node::inner(2)]);
    trace.clear();
    assert!(trace.nodes().is_empty());
}

/// Left first, and nothing below one node.
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
    // After an inner node that wants no child, the next one is none of its children.
    let cut = [Enter(1), Enter(2), Enter(4), Backtrack(5, 0), Leaf(5), Backtrack(3, 1), Leaf(3), End];
    assert_eq!(events(&mut But(3)), cut);
    assert_eq!(events(&mut But(1)), [Enter(1), Enter(2), Backtrack(3, 0), Leaf(3), End]);
}

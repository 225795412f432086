use alloc::vec::Vec;

use super::*;

#[test]
fn decisions_from_hits() {
    use Side::{Left, Right};
    for prefer_right in [false, true] {
        assert_eq!(Descent::new(false, false, prefer_right), Descent::NEITHER);
        assert_eq!(Descent::new(true, false, prefer_right), Descent::only(Left));
        assert_eq!(Descent::new(false, true, prefer_right), Descent::only(Right));
        assert_eq!(Descent::new(true, true, prefer_right), Descent::both(Side::right_if(prefer_right)));
    }
    for side in [Left, Right] {
        let (only, both) = (Descent::only(side), Descent::both(side));
        assert_eq!((only.is_neither(), only.first(), only.postpones()), (false, side, false));
        assert_eq!((both.is_neither(), both.first(), both.postpones()), (false, side, true));
    }
    assert!(Descent::NEITHER.is_neither() && !Descent::NEITHER.postpones());
    let marked = Descent::both(Left).disjoint_if(true);
    assert!(marked.is_disjoint() && marked.postpones() && marked != Descent::both(Left));
    assert_eq!(Descent::both(Left).disjoint_if(false), Descent::both(Left));
}

#[test]
fn decisions_are_marked_once_and_say_what_they_are() {
    let marked = Descent::both(Side::Right).disjoint_if(true);
    assert_eq!(marked.disjoint_if(true), marked);
    assert_eq!(marked.disjoint_if(false), marked);
    let texts = [
        (Descent::NEITHER, "neither"),
        (Descent::only(Side::Left), "only Left"),
        (Descent::both(Side::Right), "both, Right first"),
        (marked, "both, Right first, disjoint"),
    ];
    for (descent, text) in texts {
        assert_eq!(alloc::format!("{descent:?}"), text);
    }
}

/// Has no answers about pruning.
struct Plain;

impl Visitor for Plain {
    fn inner(&mut self, _: Node) -> Descent {
        Descent::NEITHER
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

/// Answers each query differently.
struct Answers;

impl Visitor for Answers {
    fn inner(&mut self, node: Node) -> Descent {
        Descent::only(Side::right_if(node.index() == 1))
    }
    fn leaf(&mut self, node: Node) -> Flow {
        if node.index() == 1 { Flow::Stop } else { Flow::Continue }
    }
}

impl Pruned for Answers {
    fn allows(&self, pruning: Pruning) -> bool {
        pruning == Pruning::Distance
    }
    fn inner_marked(&mut self, _: Node) -> Descent {
        Descent::both(Side::Right).disjoint_if(true)
    }
    fn found_at(&self, leaf: Node) -> bool {
        leaf.index() == 1
    }
    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        10 + node.index() as u32 + u32::from(descent.postpones())
    }
    fn end(&self) -> u32 {
        77
    }
}

impl NodeTest for Answers {
    fn accept(&mut self, node: Node) -> bool {
        node.index() == 1
    }
    fn leaf(&mut self, node: Node) -> Flow {
        Visitor::leaf(self, node)
    }
}

/// Returns all answers of a visitor about a node.
fn answers(mut visitor: impl Pruned, index: u32) -> (Descent, Flow, [bool; 3], Descent, bool, u32, u32) {
    let (inner, leaf) = (Node::inner(index), Node::leaf(index));
    let allowed = [Pruning::Never, Pruning::Disjoint, Pruning::Distance].map(|pruning| visitor.allows(pruning));
    let decided = (visitor.inner(inner), visitor.leaf(leaf), allowed, visitor.inner_marked(inner));
    let postponed = visitor.postponed(inner, Descent::both(Side::Left));
    (decided.0, decided.1, decided.2, decided.3, visitor.found_at(leaf), postponed, visitor.end())
}

#[test]
fn a_search_that_says_nothing_is_not_pruned() {
    let nothing = (Descent::NEITHER, Flow::Continue, [true, false, false], Descent::NEITHER, false, 0, u32::MAX);
    assert_eq!(answers(Unpruned(Plain), 0), nothing);
    assert_eq!(answers(&mut Unpruned(&mut Plain), 0), nothing);
}

#[test]
fn a_borrowed_search_answers_as_itself() {
    let marked = Descent::both(Side::Right).disjoint_if(true);
    let only = Descent::only;
    for (index, side, flow) in [(0, Side::Left, Flow::Continue), (1, Side::Right, Flow::Stop)] {
        let expected = (only(side), flow, [false, false, true], marked, index == 1, 11 + index, 77);
        assert_eq!(answers(Answers, index), expected);
        assert_eq!(answers(&mut Answers, index), expected);
        let mut borrowed = &mut Answers;
        assert_eq!(NodeTest::accept(&mut borrowed, Node::inner(index)), index == 1);
        assert_eq!(NodeTest::leaf(&mut borrowed, Node::leaf(index)), flow);
        let mut by_node = ByNode { test: Answers, order: LeftOrder };
        let accepted = if index == 1 { Descent::both(Side::Left) } else { Descent::NEITHER };
        assert_eq!((by_node.inner(Node::inner(index)), by_node.leaf(Node::leaf(index))), (accepted, flow));
    }
}

#[test]
fn the_near_child_is_the_one_the_ray_comes_from() {
    let axes: Vec<u8> = (0..3).flat_map(|axis| [axis, axis | SignOrder::REVERSED]).collect();
    for octant in 0..8 {
        let order = SignOrder { axes: &axes, octant };
        for (i, &axis) in axes.iter().enumerate() {
            // The left child has the smaller coordinates unless reversed. They are farther away if the direction is
            // negative.
            let is_negative = octant >> (axis & 3) & 1 == 1;
            let is_reversed = axis >= SignOrder::REVERSED;
            assert_eq!(order.first(Node::inner(i as u32)), Side::right_if(is_negative != is_reversed));
        }
    }
}

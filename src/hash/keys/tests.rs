use super::*;
use crate::tree::Tree;

#[test]
fn the_top_has_enough_subtrees() {
    let complete = |depth: u32| {
        let leaves = 1 << depth;
        let inner = (1..leaves).map(|i| Some([2 * i - 1, 2 * i]));
        Tree::new(&inner.chain((0..leaves).map(|_| None)).collect::<Vec<_>>()).unwrap()
    };
    let numbers = |depth| {
        let top = Top::of(&complete(depth), 1_u64);
        (top.inner.len(), top.below.len())
    };
    assert_eq!(numbers(0), (0, 1));
    assert_eq!(numbers(3), (7, 8));
    assert_eq!(numbers(12), (256, 257));
}

//! Stored states: as bytes, and the errors of states that cannot be resumed.

use stackless_bvh::generate::{Exhaustive, Source, shape};
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::traverse::{Complete, Incomplete, Next, NoSuchKey, Paused, StateError, States, Unsupported};
use stackless_bvh::tree::{Node, Topology, Tree};

use super::chain;

/// [FILE-4]
#[test]
fn states_come_back_with_what_they_have_and_nothing_else_does() {
    let tree = chain(8);
    let states = States::of(&tree);
    let node = tree.node(9).unwrap();
    // The leaf at depth 5, with the siblings of its ancestors 0 and 2 levels up postponed.
    let sibling = tree.node(10).unwrap();
    for (trail, register) in [(0_u32, None), (0b101, None), (0b101, Some(sibling))] {
        for (key, disjoint) in [(None, None), (None, Some(0b100)), (Some(0b11_1110), None), (Some(0b11_1110), Some(0))]
        {
            for next in [Next::Visit, Next::Backtrack] {
                let paused = Paused { node, register, key, trail, disjoint, next };
                assert_eq!(states.check(&paused), Ok(()), "{paused:?}");
                let bytes = states.to_bytes(&paused);
                let words = 1 + usize::from(key.is_some()) + usize::from(disjoint.is_some());
                assert_eq!((bytes.len(), states.bytes(&paused)), (26 + 4 * words + 8, 26 + 4 * words + 8));
                // If the sibling is postponed, the bytes have its address, whether or not the traversal stores it.
                let register = if trail == 0 { None } else { Some(sibling) };
                assert_eq!(states.from_bytes::<u32>(&bytes), Ok(Paused { register, ..paused }));
            }
        }
    }
    let refused = |trail: u32, register| {
        states.check(&Paused { node, register, key: None, trail, disjoint: None, next: Next::Visit })
    };
    assert_eq!(refused(0, Some(sibling)), Err(StateError::Register));
    assert_eq!(refused(0b101, tree.node(11)), Err(StateError::Register));
    assert_eq!(refused(0b100, Some(sibling)), Err(StateError::Register));
    // A growing word has the bytes of the longest key.
    for (depth, bytes) in [(62, 8), (63, 8), (64, 9), (71, 9), (72, 10)] {
        let tree = chain(depth);
        let paused = Paused {
            node: tree.root(),
            register: None,
            key: None,
            trail: Grow::default(),
            disjoint: None,
            next: Next::Visit,
        };
        assert_eq!(States::of(&tree).bytes(&paused), 26 + bytes + 8);
    }
}

#[test]
fn states_of_other_trees_are_told_apart() {
    let (mut all, mut seen) = (Exhaustive::new(), std::collections::HashSet::new());
    let mut count = 0;
    while all.next_case() {
        let leaves = 1 + all.below(8) as u32;
        let children = shape(&mut all, leaves);
        let swapped = children.iter().map(|pair| pair.map(|[left, right]| [right, left])).collect();
        for children in [children, swapped] {
            let tree = Tree::new(&children).unwrap();
            let node = tree.root();
            let paused = Paused { node, register: None, key: None, trail: 0_u32, disjoint: None, next: Next::Visit };
            seen.insert(States::of(&tree).to_bytes(&paused)[10..18].to_vec());
            count += usize::from(leaves > 1 || seen.len() == 1);
        }
    }
    assert_eq!((seen.len(), count > 1000), (count - 1, true));
}

#[test]
fn errors_are_told_apart_by_their_texts() {
    let too_deep = u32::carries(32, 1).unwrap_err();
    let tree = Tree::new(&[Some([1, 2]), None, Some([3, 4]), None, None]).unwrap();
    let not_complete = Complete::of(&tree).unwrap_err();
    for (unfit, text) in [
        (Unsupported::TooDeep(too_deep), too_deep.to_string()),
        (Unsupported::NotComplete(not_complete), not_complete.to_string()),
        (Unsupported::NoSuchWord { word: "grow" }, "not made for the word grow".into()),
        (Unsupported::NoTable, "its tables were not built".into()),
        (Unsupported::NoPause, "its state cannot be put aside".into()),
        (Unsupported::Unordered, "it prunes, and the search is not ordered by distance".into()),
    ] {
        assert_eq!(unfit.to_string(), text);
    }
    assert_eq!(Incomplete::Key.to_string(), "the state has no key");
    let register = "the sibling is postponed, and the state does not have its address";
    assert_eq!(Incomplete::Register.to_string(), register);
    assert_eq!(NoSuchKey.to_string(), "no node of the tree has this key");
    for (error, text) in [
        (StateError::Magic, "not a paused state: it does not begin with SBVP"),
        (StateError::Version { version: 2 }, "version 2 of the format, expected 1"),
        (StateError::WordBytes { expected: 8, found: 4 }, "words of 4 bytes, expected 8"),
        (StateError::Length { expected: 40, found: 39 }, "39 bytes, expected 40"),
        (StateError::Flags { flags: 0x80 }, "unknown flags in 0b10000000"),
        (StateError::Node(Node::leaf(9)), "the tree has no leaf 9"),
        (StateError::Trail, "a trail has bits above the root"),
    ] {
        assert_eq!(error.to_string(), text);
    }
}

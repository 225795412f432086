use alloc::vec::Vec;

use super::*;
use crate::event::Recorder;
use crate::generate::Family;
use crate::hash::{KeyMap, Lookup};
use crate::key::TooDeep;
use crate::order::{Flow, Side, Visitor};
use crate::traverse::{Afra, HashOnly, Laine, Method, Sparse, Uncle, traverse};
use crate::tree::{Keys, Linked, Recorded, Tree};

/// Returns a comb that changes sides at every third level.
fn comb(depth: u32) -> Tree {
    Family::comb(depth, |i| (i / 3).is_multiple_of(2))
}

#[test]
fn a_tree_is_cut_at_inner_nodes_of_certain_depths() {
    for depth in [0, 1, 2, 3, 9, 10, 63, 64, 65, 300] {
        let tree = comb(depth);
        for levels in [1, 2, 3, 7, 32, 64, 400] {
            let cuts = Cuts::every(levels, &tree);
            let below: Vec<_> = (0..=2 * depth).filter_map(|slot| cuts.below(tree.node(slot).unwrap())).collect();
            let expected = (levels..depth).step_by(levels as usize).map(|at| 2 * at as usize);
            assert!(below.iter().map(|piece| piece.root().index()).eq(expected), "{depth} {levels}");
            let numbers: Vec<_> = cuts.pieces().map(Piece::number).collect();
            assert!(numbers.iter().copied().eq(0..=below.len()));
            assert_eq!(cuts.nesting() as usize, numbers.len(), "{depth} {levels}");
            assert_eq!((cuts.top().root(), cuts.top().depth()), (tree.root(), depth.min(levels)));
        }
    }
    assert_eq!(Cuts::every(0, &comb(5)).nesting(), 5);
}

#[test]
fn tables_of_pieces_know_their_nodes_by_keys_from_their_roots() {
    let tree = comb(20);
    let cuts = Cuts::every(6, &tree);
    let tables = cuts.tables(|tree| Ok::<_, TooDeep>(KeyMap::of(tree))).unwrap();
    assert_eq!(tables.iter().map(|table| table.bytes() / size_of::<Node>()).collect::<Vec<_>>(), [13, 13, 13, 5]);
    for (piece, table) in cuts.pieces().zip(&tables) {
        let mut key = key::root::<u8>();
        let mut node = piece.root();
        assert_eq!(table.node(&key), node);
        for _ in 0..6 {
            if node.is_leaf() {
                break;
            }
            let [left, right] = tree.children(node);
            assert_eq!([key::child(key, 0), key::child(key, 1)].map(|key| table.node(&key)), [left, right]);
            let side = u8::from(left.is_leaf());
            (key, node) = (key::child(key, side), [left, right][usize::from(side)]);
        }
    }
}

#[test]
fn state_takes_one_traversal_for_each_piece_on_the_way() {
    let tree = comb(200);
    let cuts = Cuts::every(30, &tree);
    assert_eq!(cuts.state_bytes::<u32>(Method::Afra), 7 * 8);
    assert_eq!(cuts.state_bytes::<u32>(Method::Hashed), 7 * 16);
    assert_eq!(Cuts::every(31, &comb(31)).state_bytes::<u32>(Method::Afra), 8);
    // Marks for 401 nodes, and the pieces below 6 cuts.
    assert_eq!(cuts.bytes(), 7 * 12 + 6 * size_of::<Piece<'_, Tree>>());
}

#[test]
fn words_must_carry_a_piece() {
    let tree = comb(100);
    let linked = Linked::parents(&tree);
    let refused = |levels| {
        let cuts = Cuts::every(levels, &linked);
        Split::new(&cuts, &mut Vec::new(), Afra::<u8, _>::new).err()
    };
    assert_eq!(refused(8), None);
    assert_eq!(refused(9), Some(TooDeep { depth: 9, limit: 8, word: "u8" }.into()));
    assert_eq!(refused(200), Some(TooDeep { depth: 100, limit: 8, word: "u8" }.into()));
}

#[test]
fn keys_are_put_together() {
    let tree = comb(150);
    let keys = Keys::of(&tree);
    let long: Grow = keys.key(2 * 140);
    let parts = [31, 31, 31, 31, 16].into_iter().rev().fold((long.clone(), Vec::new()), |(rest, mut parts), bits| {
        let low = (0..bits).fold(0_u32, |low, at| low | (rest.clone().shr(at).low_bits() & 1) << at);
        parts.insert(0, low | 1 << bits);
        (rest.shr(bits), parts)
    });
    assert_eq!(parts.0, Grow::one());
    let whole = parts.1.iter().fold(key::root(), |whole, part| append(whole, part, key::depth(part)));
    assert_eq!(whole, long);
}

/// At each visit: the node's key, and whether the state has a trail, a register, a counter of equal length, and a
/// restart.
#[derive(Default)]
struct Shown(Vec<(Node, Option<Grow>, [bool; 4])>);

impl Recorder for Shown {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let state = state().map(|word| Some(append(Grow::zero(), &word, KeyWord::bit_length(&word))));
        let State { key, trail, counter, register, is_restarting, .. } = state;
        let shows = [trail.is_some(), register.is_some(), counter.is_some(), is_restarting];
        self.0.push((node, key.or(counter), shows));
        Flow::Continue
    }
}

/// Wants both children, the inner one first or last.
struct Both(bool);

impl Visitor for Both {
    fn inner(&mut self, node: Node) -> Descent {
        // The comb changes sides at every third node.
        let is_left = (node.index() / 6).is_multiple_of(2);
        Descent::both(if is_left == self.0 { Side::Left } else { Side::Right })
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

#[test]
fn pieces_show_the_state_of_the_whole() {
    let tree = comb(40);
    let linked = Linked::both(&tree);
    let (keys, cuts) = (Keys::of(&tree), Cuts::every(12, &linked));
    let tables = cuts.tables(|tree| Ok::<_, TooDeep>(KeyMap::of(tree))).unwrap();
    let table = |piece: &Piece<'_, Linked<'_, Tree>>| &tables[piece.number()];
    for leaf_first in [false, true] {
        let check = |shown: Shown, has_key: bool| {
            assert_eq!(shown.0.iter().filter(|visit| !visit.2[3]).count(), 81);
            for (node, key, shows) in &shown.0 {
                let slot = tree.slot(*node);
                let is_as_long = key.as_ref().is_some_and(|key| key::depth(key) == keys.depth(slot));
                assert!(!(has_key || shows[2]) || is_as_long, "{node:?} {key:?}");
                assert!(!has_key || *key == Some(keys.key(slot)));
            }
            [0, 1, 2, 3].map(|i| shown.0.iter().filter(|visit| visit.2[i]).count())
        };
        let mut shown = Shown::default();
        let start = |piece| HashOnly::<u32, _, _>::new(piece, table(piece));
        traverse(Split::new(&cuts, &mut Vec::new(), start).unwrap(), &mut Both(leaf_first), &mut shown);
        assert_eq!(check(shown, true), [81, 0, 0, 0]);
        let mut shown = Shown::default();
        let start = Uncle::<u32, _>::new;
        traverse(Split::new(&cuts, &mut Vec::new(), start).unwrap(), &mut Both(leaf_first), &mut shown);
        let [trails, registers, ..] = check(shown, false);
        assert!(trails == 81 && registers > 0, "{registers}");
        let mut shown = Shown::default();
        let start = Sparse::<u32, _>::new;
        traverse(Split::new(&cuts, &mut Vec::new(), start).unwrap(), &mut Both(leaf_first), &mut shown);
        assert_eq!(check(shown, false), [0, 0, 81, 0]);
        let mut shown = Shown::default();
        traverse(
            Split::new(&cuts, &mut Vec::new(), Laine::<0, u32, _>::new).unwrap(),
            &mut Both(leaf_first),
            &mut shown,
        );
        let [.., restarts] = check(shown, false);
        assert!(restarts > 0);
    }
}

#[test]
fn a_piece_is_the_tree_from_another_root() {
    let tree = comb(20).with_links(Recorded::Uncles);
    let cuts = Cuts::every(6, &tree);
    for piece in cuts.pieces() {
        assert_eq!((piece.node_count(), piece.recorded()), (41, Recorded::Uncles));
    }
}

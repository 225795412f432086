//! The target of keys, trails and swaps: compares with the literal formulas, and every word with the widest one.

use std::collections::HashSet;

use arbitrary::Unstructured;
use stackless_bvh::generate::Source;
use stackless_bvh::key::{self, Grow, KeyWord};
use stackless_bvh::{swap, trail};

/// Checks a key, a trail below its depth and any mask, in all words that can represent them. `[SWAP-2]` `[SWAP-4]`
/// `[TRAIL-4]` `[TRAIL-5]`
pub(crate) fn keys(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    let depth = source.below(200) as u32;
    let mut bits = |count: u32| (0..count).map(|_| source.coin()).collect::<Vec<_>>();
    let (key, trail, mask) = (bits(depth), bits(depth), bits(depth + 1));
    let grown = forms::<Grow>(&key, &trail, &mask);
    // Equal words have equal hashes and texts.
    let [one, other] =
        [(); 2].map(|()| key.iter().fold(key::root::<Grow>(), |key, &bit| key::child(key, Grow::from_bit(bit))));
    assert_eq!(format!("{one:?}"), format!("{other:?}"));
    assert!(HashSet::from([one]).contains(&other), "{key:?}");
    if depth < 128 {
        assert_eq!(forms::<u128>(&key, &trail, &mask), grown);
    }
    if depth < 64 {
        assert_eq!(forms::<u64>(&key, &trail, &mask), grown);
    }
    if depth < 32 {
        assert_eq!(forms::<u32>(&key, &trail, &mask), grown);
    }
}

/// Formats the results of backtracking and of the swaps. All words format equal bits equally.
fn forms<W: KeyWord>(key: &[bool], trail: &[bool], mask: &[bool]) -> [String; 4] {
    let word = |bits: &[bool]| bits.iter().fold(W::zero(), |word, &bit| word.shl1().or(&W::from_bit(bit)));
    let key = key.iter().fold(key::root::<W>(), |key, &bit| key::child(key, W::from_bit(bit)));
    let (trail, mask) = (word(trail), word(mask));
    let next = if trail.is_zero() { (W::zero(), W::zero()) } else { trail::backtrack(key.clone(), trail.clone()) };
    assert_eq!(next, trail::backtrack_climbing(key.clone(), trail.clone()), "{key:?} {trail:?}");
    let swapped = swap::fcomp(key.clone(), &mask);
    assert_eq!(swapped, swap::fcomp_printed(key.clone(), &mask), "{key:?} {mask:?}");
    assert_eq!(swapped, swap::swap_levels(key.clone(), &mask), "{key:?} {mask:?}");
    assert_eq!(swap::fcomp(swapped.clone(), &mask), key, "{mask:?}");
    [next.0, next.1, swapped, key.and(&mask)].map(|word| {
        let length = word.bit_length();
        (0..length).rev().map(|at| if word.clone().shr(at).low_bits() & 1 == 1 { '1' } else { '0' }).collect()
    })
}

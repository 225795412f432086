use super::*;
use crate::key::{Grow, Word};
use proptest::prelude::*;

#[test]
fn the_three_forms_are_equal_for_every_u8() {
    for index in 0..=u8::MAX {
        for mask in 0..=u8::MAX {
            let swapped = fcomp(index, &mask);
            assert_eq!(swapped, fcomp_printed(index, &mask));
            assert_eq!(swapped, swap_levels(index, &mask));
            assert_eq!(fcomp(swapped, &mask), index);
        }
    }
}

#[test]
fn swaps_commute_for_every_pair_of_levels_of_u8() {
    for index in 0..=u8::MAX {
        for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (1_u8 << i, 1_u8 << j))) {
            let ij = swap_level(swap_level(index, &j), &i);
            assert_eq!(ij, swap_level(swap_level(index, &i), &j));
        }
    }
}

#[test]
fn figure_3() {
    let f = |bit: u32| [0, 1, 2, 3].map(|x| swap_level(x, &bit));
    assert_eq!(f(1), [1, 0, 3, 2]);
    assert_eq!(f(2), [2, 3, 0, 1]);
    assert_eq!([0, 1, 2, 3].map(|x| fcomp_printed(x, &3_u32)), [3, 2, 1, 0]);
}

fn check<W: KeyWord>(index: W, mask: &W) {
    let swapped = fcomp(index.clone(), mask);
    assert_eq!(swapped, fcomp_printed(index.clone(), mask));
    assert_eq!(swapped, swap_levels(index, mask));
}

proptest! {
    #[test]
    fn the_three_forms_are_equal(index: u128, mask: u128, narrow in 0..128_u32) {
        check(index as u32, &(mask as u32));
        check(index as u64, &(mask as u64));
        check(index, &mask);
        let grow = |bits: u128, length: u32| {
            (0..length).fold(Grow::zero(), |word, i| word.shl1().or(&Grow::from_bit(bits >> (i % 128) & 1 == 1)))
        };
        check(grow(index, 200), &grow(mask, 200 - narrow));
    }
}

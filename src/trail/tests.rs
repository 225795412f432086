use super::*;
use crate::key::Grow;
use proptest::prelude::*;

#[test]
fn the_constant_time_form_is_the_loop_for_every_u8() {
    for key in 0..=u8::MAX {
        for trail in 1..=u8::MAX {
            assert_eq!(backtrack(key, trail), backtrack_climbing(key, trail), "{key} {trail}");
        }
        assert_eq!(backtrack_climbing(key, 0), (0, 0));
    }
}

#[test]
fn the_counter_is_the_complement_for_every_depth_of_u8() {
    for depth in 0..8 {
        let start = 1_u8 << depth;
        for trail in 0..start {
            let counter = counter(trail, start);
            assert_eq!(counter, !trail & (start - 1));
            assert_eq!(super::counter(counter, start), trail);
            assert_eq!(trail == 0, counter == start - 1);
            if trail != 0 {
                assert_eq!((counter + 1).trailing_zeros(), trail.trailing_zeros());
                // Incrementing and shifting the counter backtracks the trail by one or more levels.
                let up = trail.trailing_zeros();
                assert_eq!(super::counter((counter + 1) >> up, start >> up), leave(trail));
            }
        }
    }
}

#[test]
fn a_trail_stays_below_two_to_the_depth() {
    for depth in 0..8_u32 {
        for trail in 0..1_u8 << depth {
            for both in [0, 1] {
                assert!(depth == 7 || u32::from(child(trail, both)) < 2 << depth);
            }
            if trail != 0 {
                let up = levels(&trail);
                let next = leave(trail);
                assert!(u32::from(next) < 1 << (depth - up));
                assert!(!is_pending(&next));
            }
        }
    }
}

fn check<W: KeyWord>(key: W, trail: W) {
    if !trail.is_zero() {
        assert_eq!(backtrack(key.clone(), trail.clone()), backtrack_climbing(key, trail.clone()));
        assert_eq!(leave(trail.clone()), backtrack(trail.clone(), trail).1);
    }
}

proptest! {
    #[test]
    fn the_constant_time_form_is_the_loop(key: u128, trail: u128, low in 0..128_u32, pushes in 0..300_u32) {
        let trail = trail >> low << low;
        check(key as u32, trail as u32);
        check(key as u64, trail as u64);
        check(key, trail);
        // Repeats the bits to any length, for the growing word.
        let repeat = |bits: u128| {
            (0..pushes).fold(Grow::one(), |word, i| word.shl1().or(&Grow::from_bit(bits >> (i % 128) & 1 == 1)))
        };
        check(repeat(key), repeat(trail));
    }

    #[test]
    fn the_counter_is_the_complement(trail: u64, depth in 0..64_u32) {
        let start = 1_u64 << depth;
        let trail = trail & (start - 1);
        let c = counter(trail, start);
        prop_assert_eq!(c, !trail & (start - 1));
        prop_assert_eq!(counter(u128::from(trail), u128::from(start)), u128::from(c));
        if trail != 0 {
            prop_assert_eq!((c + 1).trailing_zeros(), trail.trailing_zeros());
        }
    }
}

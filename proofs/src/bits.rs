//! Keys, trails, counters and swap masks, at full width.

use stackless_bvh::key::{self, KeyWord};
use stackless_bvh::{swap, trail};

use crate::harness::{claim, harnesses};
use crate::{Any, Choose, cover};

/// A word whose values can be chosen and compared by order.
pub trait Full: KeyWord + Any + Copy + Ord {}

impl<W: KeyWord + Any + Copy + Ord> Full for W {}

harnesses! {
    /// Backtracking in constant time equals the climb that it replaces, for every trail except 0. `[TRAIL-4]`
    /// `[TRAIL-5]`
    backtrack_u32, backtrack_u32_twin, 34 => backtrack::<u32>;
    /// For u64. `[TRAIL-4]` `[TRAIL-5]`
    backtrack_u64, backtrack_u64_twin, 66 => backtrack::<u64>;
    /// For u128. `[TRAIL-4]` `[TRAIL-5]`
    backtrack_u128, backtrack_u128_twin, 130 => backtrack::<u128>;
    /// Steps down and up preserve keys: root, child, parent, sibling, depth, start of the level. `[KEY-1]` `[KEY-2]`
    /// `[KEY-3]` `[KEY-4]` `[KEY-5]` `[KEY-6]`
    keys_u32, keys_u32_twin, 2 => keys::<u32>;
    /// For u64. `[KEY-1]` `[KEY-2]` `[KEY-3]` `[KEY-4]` `[KEY-5]` `[KEY-6]`
    keys_u64, keys_u64_twin, 2 => keys::<u64>;
    /// For u128. `[KEY-1]` `[KEY-2]` `[KEY-3]` `[KEY-4]` `[KEY-5]` `[KEY-6]`
    keys_u128, keys_u128_twin, 2 => keys::<u128>;
    /// A trail stays below its key's leading one on descents and backtracks. A backtrack goes to the sibling of the
    /// ancestor at the lowest set bit. `[TRAIL-1]` `[TRAIL-2]` `[TRAIL-3]`
    trails_u32, trails_u32_twin, 2 => trails::<u32>;
    /// For u64. `[TRAIL-1]` `[TRAIL-2]` `[TRAIL-3]`
    trails_u64, trails_u64_twin, 2 => trails::<u64>;
    /// For u128. `[TRAIL-1]` `[TRAIL-2]` `[TRAIL-3]`
    trails_u128, trails_u128_twin, 2 => trails::<u128>;
    /// The counter equals the trail's complement below the depth. `[TRAIL-6]`
    counter_u32, counter_u32_twin, 2 => counter::<u32>;
    /// For u64. `[TRAIL-6]`
    counter_u64, counter_u64_twin, 2 => counter::<u64>;
    /// For u128. `[TRAIL-6]`
    counter_u128, counter_u128_twin, 2 => counter::<u128>;
    /// Equation 1 as printed equals the exclusive or, also at full width, and so does the swap at one level. Swaps of
    /// levels commute. `[SWAP-1]` `[SWAP-2]` `[SWAP-3]`
    swaps_u32, swaps_u32_twin, 2 => swaps::<u32>;
    /// For u64. `[SWAP-1]` `[SWAP-2]` `[SWAP-3]`
    swaps_u64, swaps_u64_twin, 2 => swaps::<u64>;
    /// For u128. `[SWAP-1]` `[SWAP-2]` `[SWAP-3]`
    swaps_u128, swaps_u128_twin, 2 long => swaps::<u128>;
    /// The sequence of level swaps equals the exclusive or. `[SWAP-4]`
    composition_u8, composition_u8_twin, 10 => composition::<u8>;
    /// For u16. `[SWAP-4]`
    composition_u16, composition_u16_twin, 18 => composition::<u16>;
    /// A key keeps its leading one down to the depth that `carries` accepts, and loses it at the next depth.
    /// `[DEPTH-1]` `[DEPTH-2]`
    depth_u32, depth_u32_twin, 2 => depth::<u32>;
    /// For u64. `[DEPTH-1]` `[DEPTH-2]`
    depth_u64, depth_u64_twin, 2 => depth::<u64>;
    /// For u128. `[DEPTH-1]` `[DEPTH-2]`
    depth_u128, depth_u128_twin, 2 => depth::<u128>;
    /// Each step of key and trail in a narrow word equals the step in a wide word, at every accepted depth. `[DEPTH-1]`
    narrow_u32, narrow_u32_twin, 2 => narrow::<u32>;
    /// For u64. `[DEPTH-1]`
    narrow_u64, narrow_u64_twin, 2 => narrow::<u64>;
}

/// Returns the width of a word type with a fixed width.
fn width<W: KeyWord>() -> u32 {
    W::WIDTH.unwrap_or(u32::MAX)
}

/// Returns a key and a trail below its leading one, of a node at any depth.
fn key_and_trail<W: Full>(choose: &mut impl Choose) -> Option<(W, W)> {
    let (key, trail): (W, W) = (choose.any(), choose.any());
    choose.assume(key > W::zero() && trail < key::level_start(&key))?;
    Some((key, trail))
}

/// `[TRAIL-4]` `[TRAIL-5]`
pub fn backtrack<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (key, trail): (W, W) = (choose.any(), choose.any());
    choose.assume(trail > W::zero())?;
    let levels = trail::levels(&trail);
    cover!(choose, levels == 0, "the sibling is pending");
    cover!(choose, levels == width::<W>() - 1, "only the highest bit is pending");
    let (expected_key, expected_trail) = trail::backtrack_climbing(key, trail);
    let (next_key, next_trail) = trail::backtrack(key, trail);
    let next_trail =
        choose.plant(next_trail, |next| if levels == width::<W>() - 1 { next.or(&W::one()) } else { next });
    claim!(next_key == expected_key && next_trail == expected_trail);
    Some(())
}

/// `[KEY-1]` `[KEY-2]` `[KEY-3]` `[KEY-4]` `[KEY-5]` `[KEY-6]`
pub fn keys<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (key, right): (W, bool) = (choose.any(), choose.any());
    choose.assume(key > W::zero())?;
    let depth = key::depth(&key);
    assert!(key::depth(&key::root::<W>()) == 0 && key::root::<W>() == W::one());
    let start = key::level_start(&key);
    assert!(start <= key && key.shr(depth) == W::one() && start.shr(depth) == W::one());
    assert!(key::level_start(&start) == start && start.and(&start.wrapping_sub(&W::one())) == W::zero());
    cover!(choose, depth == width::<W>() - 1, "a key that fills its word");

    choose.assume(depth < width::<W>() - 1)?;
    cover!(choose, depth == width::<W>() - 2, "the deepest key with children");
    let side = W::from_bit(right);
    let side = choose.plant(side, |side| if depth == width::<W>() - 2 { side.xor(&W::one()) } else { side });
    let child = key::child(key, side);
    claim!(child == key.wrapping_add(&key).wrapping_add(&W::from_bit(right)));
    assert!(key::depth(&child) == depth + 1 && key::parent(child) == key);
    assert!(key::sibling(child) == key::child(key, W::from_bit(!right)) && key::sibling(key::sibling(child)) == child);
    assert!(key::level_start(&child) == start.shl1());
    Some(())
}

/// `[TRAIL-1]` `[TRAIL-2]` `[TRAIL-3]`
pub fn trails<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (key, trail) = key_and_trail::<W>(choose)?;
    let depth = key::depth(&key);
    if trail > W::zero() {
        let levels = trail::levels(&trail);
        cover!(choose, levels == width::<W>() - 2, "from the deepest leaf to the root's child");
        assert!(levels < depth && lowest(trail).shr(levels) == W::one());
        let (next, rest) = trail::backtrack(key, trail);
        let rest = choose.plant(rest, |rest| rest.or(&W::one()));
        assert!(next == key::sibling(key.shr(levels)) && key::depth(&next) == depth - levels);
        claim!(rest < key::level_start(&next) && !trail::is_pending(&rest) && rest == trail::leave(trail));
        // The remaining trail is that of the levels above.
        assert!(rest == trail.shr(levels).wrapping_sub(&W::one()));
    }
    choose.assume(depth < width::<W>() - 1)?;
    let (right, both): (bool, bool) = (choose.any(), choose.any());
    let (child, below) = (key::child(key, W::from_bit(right)), trail::child(trail, W::from_bit(both)));
    cover!(choose, both && trail > W::zero() && depth == width::<W>() - 2, "the deepest descent");
    assert!(below < key::level_start(&child) && trail::is_pending(&below) == both && below.shr1() == trail);
    Some(())
}

/// `[TRAIL-6]`
pub fn counter<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (key, trail) = key_and_trail::<W>(choose)?;
    let start = key::level_start(&key);
    let counter = trail::counter(trail, start);
    assert!(counter < start && trail::counter(counter, start) == trail);
    assert!(counter.wrapping_add(&trail) == start.wrapping_sub(&W::one()));
    cover!(choose, trail == W::zero(), "nothing is pending");
    cover!(choose, trail > W::zero() && start == W::highest().unwrap_or_default(), "at the greatest depth");
    // At the end, the index combined with its level's start is all ones.
    let is_end = start.or(&counter).is_all_ones();
    claim!(is_end == (choose.plant(trail, W::shr1) == W::zero()));
    if trail > W::zero() {
        assert!(counter.wrapping_add(&W::one()).trailing_zeros() == trail::levels(&trail));
    }
    Some(())
}

/// `[SWAP-1]` `[SWAP-2]` `[SWAP-3]`
pub fn swaps<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (index, mask): (W, W) = (choose.any(), choose.any());
    let highest = W::highest().unwrap_or_default();
    cover!(choose, index.and(&mask) >= highest, "the highest level is swapped back");
    let printed = swap::fcomp_printed(index, &mask);
    let printed = choose.plant(printed, |printed| if mask == highest { index } else { printed });
    claim!(printed == swap::fcomp(index, &mask) && printed == index.xor(&mask));
    let (a, b) = (lowest(mask), lowest(index));
    let swapped = swap::swap_level(index, &a);
    assert!(swapped == index.xor(&a) && swap::swap_level(swapped, &a) == index);
    assert!(swap::swap_level(swapped, &b) == swap::swap_level(swap::swap_level(index, &b), &a));
    Some(())
}

/// `[SWAP-4]`
pub fn composition<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (index, mask): (W, W) = (choose.any(), choose.any());
    cover!(choose, mask.wrapping_add(&W::one()) == W::zero(), "all levels are swapped");
    let swapped = swap::swap_levels(index, &mask);
    let swapped =
        choose.plant(swapped, |swapped| if mask == W::highest().unwrap_or_default() { index } else { swapped });
    claim!(swapped == swap::fcomp(index, &mask));
    Some(())
}

/// Returns only the lowest one of a word.
fn lowest<W: Full>(word: W) -> W {
    word.and(&W::zero().wrapping_sub(&word))
}

/// `[DEPTH-1]` `[DEPTH-2]`
pub fn depth<W: Full>(choose: &mut impl Choose) -> Option<()> {
    let (deepest, key): (u32, W) = (choose.any(), choose.any());
    let accepted = W::carries(deepest, 1).is_ok();
    claim!(accepted == (deepest < choose.plant(width::<W>(), |width| width + 1)));
    cover!(choose, accepted && deepest == width::<W>() - 1, "the deepest tree that is accepted");
    cover!(choose, !accepted, "a tree that is refused");
    match W::carries(deepest, 1) {
        Ok(()) => {}
        Err(error) => assert!(error.depth == deepest && error.limit == width::<W>() - 1 && error.word == W::NAME),
    }
    assert!(W::carries(deepest, 0).is_ok() == (deepest <= width::<W>()));

    choose.assume(key > W::zero())?;
    let child = key::child(key, W::zero());
    let kept = key::depth(&child) == key::depth(&key) + 1;
    assert!(kept == W::carries(key::depth(&key) + 1, 1).is_ok());
    Some(())
}

/// `[DEPTH-1]`
pub fn narrow<W: Full + Into<u128>>(choose: &mut impl Choose) -> Option<()> {
    let (key, trail) = key_and_trail::<W>(choose)?;
    let wide: (u128, u128) = (key.into(), trail.into());
    let same = |narrow: (W, W), wide: (u128, u128)| (narrow.0.into(), narrow.1.into()) == wide;
    assert!(key::depth(&key) == key::depth(&wide.0));
    if trail > W::zero() {
        assert!(same(trail::backtrack(key, trail), trail::backtrack(wide.0, wide.1)));
    }
    let (right, both): (bool, bool) = (choose.any(), choose.any());
    let limit = choose.plant(width::<W>() - 1, |limit| limit + 1);
    choose.assume(W::carries(key::depth(&key) + 1, 1).is_ok() || key::depth(&key) < limit)?;
    cover!(choose, key::depth(&key) == width::<W>() - 2, "to the greatest depth");
    let below = (key::child(key, W::from_bit(right)), trail::child(trail, W::from_bit(both)));
    let wide_below = (key::child(wide.0, u128::from(right)), trail::child(wide.1, u128::from(both)));
    claim!(same(below, wide_below));
    Some(())
}

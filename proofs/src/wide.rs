//! Keys and trails of wide trees, at full width.

use stackless_bvh::wide::{ancestor_key, back, child_key, key_level, leave};
use stackless_bvh::{key, trail};

use crate::bits::Full;
use crate::harness::{claim, harnesses};
use crate::{Choose, cover};

harnesses! {
    /// Steps down and up preserve keys of nodes of two children: child, ancestor, level. `[WIDE-9]`
    wide_keys_2, wide_keys_2_twin, 4 => keys::<2>;
    /// For four children. `[WIDE-9]`
    wide_keys_4, wide_keys_4_twin, 4 => keys::<4>;
    /// For eight children. `[WIDE-9]`
    wide_keys_8, wide_keys_8_twin, 4 => keys::<8>;
    /// A backtrack from a child goes to its parent, with the parent's pending set and trail. Without pending children
    /// of the parent, it equals the parent's backtrack, one level further. `[WIDE-10]` `[WIDE-11]`
    wide_trails_2_u64, wide_trails_2_u64_twin, 4 => trails::<2, u64>;
    /// For four children. `[WIDE-10]` `[WIDE-11]`
    wide_trails_4_u64, wide_trails_4_u64_twin, 6 => trails::<4, u64>;
    /// For eight children. `[WIDE-10]` `[WIDE-11]`
    wide_trails_8_u64, wide_trails_8_u64_twin, 10 => trails::<8, u64>;
    /// For eight children and u128. `[WIDE-10]` `[WIDE-11]`
    wide_trails_8_u128, wide_trails_8_u128_twin, 10 => trails::<8, u128>;
    /// With two children, if the lowest group is only the sibling's slot, the child in that slot is the target of the
    /// binary trail's backtrack. `[WIDE-12]`
    wide_binary_u64, wide_binary_u64_twin, 34 => binary;
}

/// `[WIDE-9]`
pub fn keys<const A: usize>(choose: &mut impl Choose) -> Option<()> {
    let (key, slot): (u64, u64) = (choose.any(), choose.any());
    let (slot, bits) = (slot % A as u64, A.trailing_zeros());
    choose.assume(key > 0 && key.leading_zeros() >= bits)?;
    let child = child_key::<A, u64>(key, slot);
    let levels = choose.plant(1, |levels| levels + 1);
    claim!(ancestor_key::<A, u64>(child, levels) == key && child % A as u64 == slot);
    assert!(u128::from(child) == u128::from(key) * A as u128 + u128::from(slot));
    assert!(key_level::<A>(child) == key_level::<A>(key) + 1 && key_level::<A>(1) == 0);
    cover!(choose, key.leading_zeros() == bits, "the deepest key with children");
    let up = choose.bits(6) as u32;
    choose.assume(up <= key_level::<A>(key))?;
    assert!(ancestor_key::<A, u64>(child, up + 1) == ancestor_key::<A, u64>(key, up));
    assert!(key_level::<A>(ancestor_key::<A, u64>(key, up)) == key_level::<A>(key) - up);
    Some(())
}

/// `[WIDE-10]` `[WIDE-11]`
pub fn trails<const A: usize, W: Full + From<u32>>(choose: &mut impl Choose) -> Option<()> {
    let (trail, pending): (W, W) = (choose.any(), W::from(choose.bits(A as u32) as u32));
    choose.assume(leave::<A, W>(trail, &pending).shr(A as u32) == trail)?;
    let below = leave::<A, W>(trail, &pending);
    cover!(choose, trail == W::zero() && pending > W::zero(), "a child of the root");
    cover!(choose, trail > W::zero() && pending == W::zero(), "an only child");
    if pending > W::zero() {
        let planted = choose.plant(below, |below| below.xor(&W::one()));
        claim!(back::<A, W>(planted) == (1, pending, trail));
    } else if trail > W::zero() {
        let (up, set, rest) = back::<A, W>(trail);
        assert!(back::<A, W>(below) == (up + 1, set, rest));
        assert!(up > 0 && set > W::zero() && set < leave::<A, W>(W::one(), &W::zero()));
    }
    Some(())
}

/// `[WIDE-12]`
pub fn binary(choose: &mut impl Choose) -> Option<()> {
    let (key, trail): (u64, u64) = (choose.any(), choose.any());
    choose.assume(key > 0 && trail > 0)?;
    // Bit i: group i is not 0.
    let bits = (0..32).fold(0_u64, |bits, i| bits | u64::from(trail >> (2 * i) & 3 != 0) << i);
    let (up, set, rest) = back::<2, u64>(trail);
    assert!(up == trail::levels(&bits) + 1);
    let slot = 1 - (key >> (up - 1) & 1);
    choose.assume(set == 1 << slot && key >> up > 0)?;
    cover!(choose, up > 1, "more than a level up");
    let (next, left) = trail::backtrack(key, bits);
    let slot = choose.plant(slot, |slot| 1 - slot);
    claim!(child_key::<2, u64>(ancestor_key::<2, u64>(key, up), slot) == next);
    assert!((0..32).all(|i| (leave::<2, u64>(rest, &0) >> (2 * i) & 3 != 0) == (left >> i & 1 == 1)));
    assert!(key::sibling(next) == key >> (up - 1));
    Some(())
}

//! The swap mask: a path in any order, from a counter that always goes left first.
//!
//! Barringer & Akenine-Möller (2013, Section 2.2) traverse as if every left child came first, and record in a mask the
//! levels at which the children were swapped. The index of a node within its level is then a composition of one swap
//! for each such level, and that composition is one exclusive or.
//!
//! ```
//! use stackless_bvh::swap;
//! assert_eq!(swap::fcomp(0b010_u32, &0b110), 0b100);
//! assert_eq!(swap::fcomp_printed(0b010_u32, &0b110), 0b100);
//! ```

use crate::key::{KeyWord, Word};

/// Returns the index after swaps of the levels in `mask`. `[SWAP-3]`
///
/// Equal to [`fcomp_printed`]: `x + m - 2 (x & m)` toggles each bit that is set in the mask, without carries.
#[inline]
pub fn fcomp<W: Word>(index: W, mask: &W) -> W {
    index.xor(mask)
}

/// Equation 1 as printed: `x + m - 2 (x & m)`, in wrapping arithmetic. `[SWAP-2]`
#[inline]
pub fn fcomp_printed<W: Word>(index: W, mask: &W) -> W {
    let common = index.clone().and(mask);
    index.wrapping_add(mask).wrapping_sub(&common.shl1())
}

/// The swap at one level, as printed: `fn(x) = x + 2^n - 2 (x & 2^n)`, with `bit` = two to the power n. `[SWAP-1]`
#[inline]
pub fn swap_level<W: Word>(index: W, bit: &W) -> W {
    fcomp_printed(index, bit)
}

/// Applies the swaps of all levels in `mask` one after the other, lowest first. `[SWAP-4]`
pub fn swap_levels<W: KeyWord>(mut index: W, mask: &W) -> W {
    let (mut rest, mut bit) = (mask.clone(), W::one());
    while !rest.is_zero() {
        if rest.low_bits() & 1 == 1 {
            index = swap_level(index, &bit);
        }
        rest = rest.shr1();
        bit = bit.shl1();
    }
    index
}

#[cfg(test)]
mod tests;

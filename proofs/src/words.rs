//! Words as pieces, and the word that grows.

use stackless_bvh::key::{Grow, KeyWord, Word};

use crate::bits::Full;
use crate::harness::{claim, harnesses};
use crate::{Choose, cover};

harnesses! {
    /// The pieces of a word are its bits from the highest set bit down, 63 each. `[HASH-6]`
    pieces_u32, pieces_u32_twin, 4 => pieces::<u32>;
    /// For u64. `[HASH-6]`
    pieces_u64, pieces_u64_twin, 4 => pieces::<u64>;
    /// For u128. `[HASH-6]`
    pieces_u128, pieces_u128_twin, 5 => pieces::<u128>;
    /// A growing word of up to 65 bits, beyond its register, equals the wide number in all operations of a traversal.
    /// `[DEPTH-3]`
    grow, grow_twin, 66 kani => grow_is_u128::<65>;
}

/// Bits of a piece.
const PIECE: u32 = 63;

/// `[HASH-6]`
pub fn pieces<W: Full + Into<u128>>(choose: &mut impl Choose) -> Option<()> {
    let word: W = choose.any();
    let (count, length) = (word.piece_count(), word.bit_length());
    assert!(count == length.div_ceil(PIECE));
    cover!(choose, count == W::WIDTH?.div_ceil(PIECE), "as many pieces as the word can have");
    let mut joined = 0_u128;
    for index in 0..count {
        let bits = PIECE.min(length - index * PIECE);
        let piece = word.piece(index);
        assert!(piece >> bits == 0);
        joined = joined << bits | u128::from(piece);
    }
    assert!(joined == word.into());
    let beyond = word.piece(count);
    claim!(choose.plant(beyond, |beyond| beyond | u64::from(length == W::WIDTH.unwrap_or(0))) == 0);
    Some(())
}

/// `[DEPTH-3]`
pub fn grow_is_u128<const BITS: u32>(choose: &mut impl Choose) -> Option<()> {
    let (high, low) = (choose.bits(BITS - 63), choose.bits(63));
    let wide = u128::from(high) << 63 | u128::from(low);
    let mut word = Grow::zero();
    for bit in (0..BITS).rev() {
        word = word.shl1().or(&Grow::from_bit(wide >> bit & 1 == 1));
    }
    cover!(choose, high > 1, "beyond the register");
    assert!(word.is_zero() == (wide == 0) && word.is_all_ones() == wide.is_all_ones());
    assert!(word.bit_length() == wide.bit_length() && word.low_bits() == wide as u32 && word.to_u64() == wide.to_u64());
    if wide != 0 {
        let zeros = wide.trailing_zeros();
        claim!(Word::trailing_zeros(&word) == choose.plant(zeros, |zeros| if zeros == 64 { 0 } else { zeros }));
        let climbed = word.shr(zeros).xor(&Grow::one());
        assert!(
            climbed.to_u64() == ((wide >> zeros) ^ 1).to_u64()
                && climbed.bit_length() == ((wide >> zeros) ^ 1).bit_length()
        );
    }
    Some(())
}

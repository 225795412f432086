use super::*;
use proptest::prelude::*;

fn grow(value: u128) -> Grow {
    (0..128).rev().fold(Grow::zero(), |word, bit| word.shl1().or(&Grow::from_bit(value >> bit & 1 == 1)))
}

fn same(word: &Grow, value: u128) -> bool {
    word.bit_length() == value.bit_length()
        && (0..3).all(|i| word.piece(i) == value.piece(i))
        && word.is_zero() == (value == 0)
        && word.is_all_ones() == value.is_all_ones()
        && value.is_all_ones() == (value.count_ones() == value.bit_length())
        && word.low_bits() == value as u32
        && word.to_u64() == value.to_u64()
        && (value == 0 || word.trailing_zeros() == value.trailing_zeros())
        && *word == grow(value)
}

#[test]
fn keys_of_all_nodes_to_depth_6_in_u8() {
    for k in 1..128_u8 {
        let [left, right] = [child(k, 0), child(k, 1)];
        assert_eq!((left, right), (2 * k, 2 * k + 1));
        assert_eq!((sibling(left), sibling(right)), (right, left));
        assert_eq!((parent(left), parent(right)), (k, k));
        assert_eq!(depth(&left), depth(&k) + 1);
    }
    assert_eq!(depth(&root::<u8>()), 0);
}

#[test]
fn depth_limits_are_those_of_the_inventory() {
    assert!(u32::carries(31, 1).is_ok() && u64::carries(63, 1).is_ok() && u128::carries(127, 1).is_ok());
    assert_eq!(u32::carries(32, 1), Err(TooDeep { depth: 32, limit: 31, word: "u32" }));
    assert_eq!(u64::carries(64, 1).unwrap_err().limit, 63);
    assert!(u32::carries(32, 0).is_ok() && u32::carries(33, 0).is_err());
    assert!(Grow::carries(u32::MAX, 1).is_ok());
}

/// One step of a random program on a growing word and on `u128`.
#[derive(Clone, Debug)]
enum Step {
    Push(bool),
    Drop(u32),
    Toggle,
    Increment,
    Fill,
    Combine(u8, u128),
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        8 => any::<bool>().prop_map(Step::Push),
        2 => (0..100_u32).prop_map(Step::Drop),
        2 => Just(Step::Toggle),
        2 => Just(Step::Increment),
        1 => Just(Step::Fill),
        1 => (0..5_u8, any::<u128>(), 0..128_u32).prop_map(|(op, x, s)| Step::Combine(op, x >> s)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// [DEPTH-3]
    #[test]
    fn the_growing_word_is_u128_where_u128_reaches(steps in prop::collection::vec(step(), 0..200)) {
        let (mut word, mut value) = (Grow::one(), 1_u128);
        for step in steps {
            match step {
                Step::Push(bit) if value >> 127 == 0 => {
                    word = child(word, Grow::from_bit(bit));
                    value = child(value, u128::from(bit));
                }
                Step::Push(_) => {}
                Step::Drop(n) => {
                    word = word.shr(n);
                    value >>= n;
                }
                Step::Toggle => {
                    word = word.xor(&Grow::one());
                    value ^= 1;
                }
                Step::Increment if value == u128::MAX => {}
                Step::Increment => {
                    word = word.wrapping_add(&Grow::one());
                    value += 1;
                }
                Step::Fill => {
                    // Ones below the highest.
                    let ones = u128::MAX.checked_shr(128 - value.bit_length()).unwrap_or(0);
                    (word, value) = (word.or(&grow(ones)), value | ones);
                }
                Step::Combine(op, other) => {
                    let wide = grow(other);
                    match op {
                        0 => (word, value) = (word.and(&wide), value & other),
                        1 => (word, value) = (word.or(&wide), value | other),
                        2 => (word, value) = (word.xor(&wide), value ^ other),
                        3 if value.checked_add(other).is_some() => {
                            (word, value) = (word.wrapping_add(&wide), value + other);
                        }
                        3 => {}
                        _ => (word, value) = (word.wrapping_sub(&wide), value.saturating_sub(other)),
                    }
                }
            }
            prop_assert!(same(&word, value), "{word:?} is not {value}");
        }
    }

    #[test]
    fn pieces_make_up_the_value(value: u128, shift in 0..128_u32) {
        let value = value >> shift;
        let length = value.bit_length();
        let mut sum = 0_u128;
        for i in 0..value.piece_count() {
            let bits = PIECE.min(length - i * PIECE);
            sum = sum << bits | u128::from(value.piece(i));
        }
        prop_assert_eq!(sum, value);
        prop_assert_eq!((value.piece(value.piece_count()), value.piece(u32::MAX), grow(value).piece(u32::MAX)), (0, 0, 0));
    }
}

#[test]
fn long_values_keep_every_bit() {
    let bits: Vec<bool> = (0..1000_u32).map(|i| i.wrapping_mul(0x9e37_79b9) >> 31 == 1).collect();
    let mut word = Grow::one();
    for &bit in &bits {
        word = child(word, Grow::from_bit(bit));
    }
    for (i, &bit) in bits.iter().enumerate().rev() {
        assert_eq!(depth(&word), i as u32 + 1);
        assert_eq!(word.low_bits() & 1 == 1, bit);
        word = parent(word);
    }
    assert_eq!(word, Grow::one());
}

#[test]
fn the_extension_is_left_alone_by_shallow_values() {
    let mut word = Grow::one();
    for _ in 0..62 {
        word = word.shl1();
    }
    assert!(!format!("{word:?}").contains("bits"));
    assert_eq!(word.clone().shl1().shl1().shr(2), word);
}

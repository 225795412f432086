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

/// One step of a random program, for the growing word and for `u128`.
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
                    // Ones below the highest one.
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

/// Returns a word like those of children: without stored zeros above its highest bit.
fn short(value: u128) -> Grow {
    let below = (0..value.bit_length().saturating_sub(1)).rev();
    below.fold(Grow::from_bit(value > 0), |word, bit| child(word, Grow::from_bit(value >> bit & 1 == 1)))
}

/// Lost bits, and stored bits that should not count, appear after the result is shifted up.
#[test]
fn operands_of_any_two_lengths() {
    let lengths = [1, 2, 3, 30, 62, 63, 64, 65, 100, 125, 126];
    let ones = |n: u32| u128::MAX >> (128 - n);
    for (a, b) in lengths.iter().flat_map(|&a| lengths.map(|b| (a, b))) {
        let odd = 0x5555_5555_5555_5555_5555_5555_5555_5555 & ones(b);
        for (x, y) in [(1 << (a - 1), ones(b)), (ones(a), 1 << (b - 1)), (ones(a), odd | 1 << (b - 1))] {
            let (p, q) = (short(x), short(y));
            let results = [
                (p.clone().and(&q), x & y),
                (p.clone().or(&q), x | y),
                (p.clone().xor(&q), x ^ y),
                (p.clone().wrapping_add(&q), x + y),
                (p.wrapping_sub(&q), x.saturating_sub(y)),
            ];
            for (i, (word, value)) in results.into_iter().enumerate() {
                assert!(same(&word, value), "{i}: {x:#b} {y:#b}");
                let up = 128 - value.bit_length().max(1);
                let shifted = (0..up).fold(word, |word, _| word.shl1());
                assert!(same(&shifted, value << up), "{i}: {x:#b} {y:#b}");
            }
        }
    }
}

/// A word that was shifted up from 1 or 0 stores no more bits than it was shifted by.
#[test]
fn operands_of_any_two_shifts() {
    let number = |word: &Grow| {
        let pieces = (0..word.piece_count()).map(|i| (word.piece(i), PIECE.min(word.bit_length() - i * PIECE)));
        pieces.fold(0_u128, |sum, (piece, bits)| sum << bits | u128::from(piece))
    };
    let shifted = |word: Grow, n: u32| (0..n).fold(word, |word, _| word.shl1());
    for (a, b) in (0..70).flat_map(|a| (0..70).map(move |b| (a, b))) {
        let (p, q) = (shifted(Grow::one(), a), shifted(Grow::one(), b));
        let sum = p.clone().wrapping_add(&q);
        let (x, y) = (1_u128 << a, 1_u128 << b);
        for (word, value) in [(p.clone().or(&q), x | y), (p.clone().xor(&q), x ^ y), (p.and(&q), x & y), (sum, x + y)] {
            assert_eq!(number(&shifted(word, 50)), value << 50, "{a} {b}");
        }
        assert_eq!(number(&shifted(shifted(Grow::zero(), a).or(&q), 50)), y << 50, "{a} {b}");
    }
}

/// [KEY-6]
#[test]
fn a_level_starts_at_the_leading_one() {
    assert!(level_start(&0_u8) == 0 && level_start(&Grow::zero()).is_zero());
    for key in 1..=u8::MAX {
        assert_eq!(level_start(&key), 1 << depth(&key));
    }
    for length in [1, 2, 63, 64, 65, 128] {
        let ones = u128::MAX >> (128 - length);
        assert_eq!((level_start(&ones), level_start(&short(ones))), (1 << (length - 1), short(1 << (length - 1))));
    }
}

#[test]
fn growing_words_are_equal_by_value() {
    let ones = |n: u32| u128::MAX >> (128 - n);
    // Stored in equal and in different numbers of bits, with and without leading zeros.
    assert_eq!((0..63).fold(Grow::zero(), |word, _| word.shl1()), Grow::zero());
    assert_eq!(short(0b101), grow(0b101));
    assert_ne!(short(0b101), grow(0b110));
    assert_ne!(short(0b101), short(0b110));
    let long = 1 << 100 | 1;
    assert!(short(long) != short(long ^ 2) && short(long) != short(long ^ 1 << 99));
    // The first piece of one word equals the whole other word.
    assert!(short(ones(63)) != grow(ones(126)) && grow(ones(126)) != short(ones(63)));
    let hash = |word: &Grow| {
        let mut hasher = std::hash::DefaultHasher::new();
        std::hash::Hash::hash(word, &mut hasher);
        std::hash::Hasher::finish(&hasher)
    };
    assert_eq!(hash(&short(0b101)), hash(&grow(0b101)));
    assert_ne!(hash(&short(0b101)), hash(&short(0b110)));
    assert_ne!(hash(&short(ones(63))), hash(&short(ones(126))));
}

#[test]
fn words_say_what_they_are() {
    assert_eq!(
        (format!("{:?}", short(5)), format!("{:?}", short(1 << 99))),
        ("5".into(), "a number of 100 bits".into())
    );
    let text = "the tree is 32 edges deep, and this state in u32 carries at most 31";
    assert_eq!(u32::carries(32, 1).unwrap_err().to_string(), text);
    assert_eq!((Grow::highest(), u8::highest(), u64::highest()), (None, Some(1 << 7), Some(1 << 63)));
    // A register, and a piece for every 63 bits below the leading one.
    assert_eq!([0, 62, 63, 125, 126, 200].map(Grow::bytes), [8, 8, 16, 16, 24, 32]);
    assert_eq!((u8::bytes(200), u64::bytes(0), u128::bytes(1)), (1, 8, 16));
}

//! The trusted parts of the lemmas, compared with the compiled library on numbers, and tests that a lemma can fail.

use stackless_bvh::internals::hash::{Modulo, Reciprocal, TableSize};
use stackless_bvh::key::{KeyWord, Word};
use stackless_bvh::trail;
use z3::ast::{Ast, BV, Bool};

use crate::all;
use crate::lemma::Query;
use crate::machine::{Machine, Number};
use crate::numbers::{Bits, Whole};
use crate::source::{Source, Type};
use crate::word::{Symbolic, take_required};

/// Numbers with few and many bits, at both ends of a word.
const SAMPLES: [u128; 9] = [
    0,
    1,
    2,
    0b1011,
    0x8000_0000,
    0xffff_ffff,
    0x8000_0000_0000_0000,
    0x0123_4567_89ab_cdef_0f1e_2d3c_4b5a_6978,
    u128::MAX,
];

fn bits(value: u128, width: u32) -> BV {
    Bits::literal(value, Type::unsigned(width)).bits
}

fn number(bits: &BV) -> u128 {
    let wide = bits.zero_ext(128 - bits.get_size());
    let half = |high, low| wide.extract(high, low).simplify().as_u64().unwrap();
    u128::from(half(127, 64)) << 64 | u128::from(half(63, 0))
}

fn holds(condition: &Bool) -> bool {
    condition.simplify().as_bool().unwrap()
}

/// Compares each operation of a symbolic word with the operation on numbers.
fn agrees<W: KeyWord + Into<u128> + TryFrom<u128>, const N: u32>() {
    let word = |value: u128| (W::try_from(value).ok().unwrap(), Symbolic::<N>(bits(value, N)));
    let same = |real: W, symbolic: Symbolic<N>| assert_eq!(real.into(), number(&symbolic.0));
    same(W::zero(), Word::zero());
    same(W::one(), Word::one());
    let samples = SAMPLES.map(|sample| sample & u128::MAX >> (128 - N));
    for (a, x) in samples.map(word) {
        same(a.clone().shl1(), x.clone().shl1());
        same(a.clone().shr1(), x.clone().shr1());
        for n in [0, 1, 7, N - 1] {
            same(a.clone().shr(n), x.clone().shr(Symbolic::number(n.into())));
        }
        same(a.clone().wrapping_add(&W::one()), x.clone() + 1);
        same(a.clone().wrapping_add(&a), x.clone() * 2);
        same(a.clone().shl1(), x.clone() << 1);
        same(a.clone().shr(7), x.clone() >> 7);
        take_required();
        if !a.is_zero() {
            let count = x.trailing_zeros();
            assert_eq!(u128::from(a.trailing_zeros()), number(&count.0));
            assert!(take_required().iter().all(holds));
        }
        for (b, y) in samples.map(word) {
            same(a.clone().and(&b), x.clone().and(&y));
            same(a.clone().or(&b), x.clone().or(&y));
            same(a.clone().xor(&b), x.clone().xor(&y));
            same(a.clone().wrapping_add(&b), x.clone().wrapping_add(&y));
            same(a.clone().wrapping_sub(&b), x.clone().wrapping_sub(&y));
        }
    }
}

#[test]
fn symbolic_words_compute_as_words_do() {
    agrees::<u32, 32>();
    agrees::<u64, 64>();
    agrees::<u128, 128>();
}

#[test]
fn what_an_operation_requires_is_noted() {
    take_required();
    let _ = Symbolic::<32>::number(5).shr(Symbolic::number(32));
    Symbolic::<32>::number(0).trailing_zeros();
    assert!(take_required().iter().all(|required| !holds(required)));
    let [a, b] = [u128::from(u32::MAX), 1].map(|value| Bits::literal(value, Type::unsigned(32)));
    a.binary(crate::machine::Op::Add, &b).unwrap();
    assert!(!holds(&take_required()[0]));
}

#[test]
fn interpreted_remainders_are_those_of_the_library() {
    let source = Source::library().unwrap();
    for size in [1, 2, 3, 127, 65_537, 0x7fff_ffff, 1 << 31] {
        let modulo = Reciprocal::of(TableSize::new(size).unwrap());
        for key in SAMPLES.map(|sample| sample as u64) {
            for (name, key, width, expected) in [
                ("Reciprocal::of_u32", u64::from(key as u32), 32, modulo.of_u32(key as u32)),
                ("Reciprocal::of_u64", key, 64, modulo.of_u64(key)),
            ] {
                let stored = u64::MAX / u64::from(size);
                let values = [("key", key, width), ("self.size", size.into(), 32), ("self.reciprocal", stored, 64)];
                let values =
                    values.map(|(text, value, width)| (text, Whole::literal(value.into(), Type::unsigned(width))));
                let mut machine = Machine::new(&source, Type::unsigned(64), values);
                let value = machine.run(&source.function(name).unwrap().body).unwrap().unwrap();
                assert_eq!(value.number.simplify().as_u64(), Some(expected.into()), "{key} mod {size}");
            }
        }
    }
}

/// The first output of `SplitMix64` from 0, the paper's encoding, and a step of Algorithm 4 compared with the trail's.
#[test]
fn interpreted_bits_are_known_ones() {
    let source = Source::library().unwrap();
    let machine = Machine::new(&source, Type::unsigned(64), []);
    let call = |name, value, width| number(&machine.call(name, &[Bits::new(bits(value, width))]).unwrap().bits);
    assert_eq!(call("mix", 0x9e37_79b9_7f4a_7c15, 64), 0xe220_a839_7b1d_cdaf);
    assert_eq!(call("mix_u32", 1, 32), u128::from(lowbias32(1)));
    assert_eq!(call("decode", 0x8000_0005, 32), 5);
    assert_eq!(call("decode", 0xffff_fffa, 32), 0x8000_0005);

    let (start, pending) = (1_u64 << 5, 0b10100);
    let index = start + trail::counter(pending, start);
    let values = [("self.index", index), ("self.node", 0b10_1101), ("self.marks", 0b11000)];
    let values = values.map(|(text, value)| (text, Bits::new(bits(value.into(), 64))));
    let mut machine = Machine::new(&source, Type::unsigned(64), values);
    machine.run(&source.function("Sparse::backtrack").unwrap().body).unwrap();
    let (start, pending) = (start >> 2, trail::leave(pending));
    let value = |name| number(&machine.value(name).unwrap().bits);
    assert_eq!(value("self.index"), u128::from(start + trail::counter(pending, start)));
    assert_eq!((value("self.node"), value("self.marks")), (0b1010, 0b110));
    assert_eq!(machine.loops.iter().map(|times| number(&times.bits)).collect::<Vec<_>>(), [2]);
}

fn lowbias32(mut x: u32) -> u32 {
    for (shift, factor) in [(16, 0x7feb_352d), (15, 0x846c_a68b)] {
        x = (x ^ x >> shift).wrapping_mul(factor);
    }
    x ^ x >> 16
}

/// Runs the body of a function that is in no file.
fn interpret(body: &str) -> Result<Option<Bits>, String> {
    let source = Source::library()?;
    let x = [("x", Bits::new(bits(6, 32))), ("flag", Bits::new(bits(1, 1)))];
    Machine::new(&source, Type::unsigned(32), x).run(&syn::parse_str(body).unwrap())
}

#[test]
fn what_is_not_understood_is_an_error() {
    let value = |body| interpret(body).map(|value| number(&value.unwrap().bits));
    assert_eq!(value("{ let y = x << 1; y ^ 1 }"), Ok(13));
    assert_eq!(value("{ let y = x; for _ in 0..2 { y = self.tree.parent(y); } y }"), Ok(1));
    for body in [
        "{ x.rotate_left(1) }",
        "{ while flag { x = x >> 1; } x }",
        "{ if flag { x = x >> 1; } x }",
        "{ let y = if flag { x ^= 1; x } else { x }; y }",
        "{ let z = take(&mut x); x ^ z }",
        "{ x < 3 }",
        "{ x + flag }",
        "{ x + 1; x += 1; x }",
        "{ unknown }",
        "{ return x; }",
        "{ x.clone(); x }",
        "{ for _ in 0..x { x = x >> 1; } x }",
        "{ for _ in 1..x { x = self.tree.parent(x); } x }",
        "{ for _ in 0..=x { x = self.tree.parent(x); } x }",
        "{ for _ in 0..x { flag = self.tree.parent(x); } x }",
        "{ for _ in 0..x { x = self.tree.parent(x); x = x << 1; } x }",
        "{ self.marks.climb(x); x }",
        "{ self.node = self.tree.cousin(x); x }",
    ] {
        assert!(interpret(body).is_err(), "{body}");
    }
    assert!(Source::with("text that is nowhere", "").is_err());
    assert!(Source::with("let", "").is_err(), "it is there more than once");
}

#[test]
fn false_claims_fail() {
    let mut query = Query::default();
    assert!(!query.is_proved(), "it claims nothing");
    let key = query.word::<32>("key");
    query.claim("no key is 7", key.is_number(7).not());
    assert!(!query.is_proved());
    query.assume(key.less(&Symbolic::number(7)));
    assert!(query.is_proved());
}

#[test]
fn each_lemma_names_its_clauses_once_a_width() {
    let lemmas = all().unwrap();
    for (i, lemma) in lemmas.iter().enumerate() {
        assert!(lemma.clauses.split(' ').all(|id| id.starts_with('[') && id.ends_with(']')), "{}", lemma.name);
        assert!(
            lemmas[..i].iter().all(|other| (other.name, other.width) != (lemma.name, lemma.width)),
            "{}",
            lemma.name
        );
    }
}

/// If words have several widths, tests the first. The other widths have equal claims.
#[test]
fn every_claim_is_broken_by_a_slip() {
    let lemmas = all().unwrap();
    let mut names = std::collections::BTreeSet::new();
    let first = lemmas.iter().filter(|lemma| names.insert(lemma.name));
    let unbroken: Vec<_> = first.map(|lemma| (lemma.name, lemma.unbroken())).collect();
    let missed: Vec<_> = unbroken.iter().filter(|(_, claims)| !claims.is_empty()).collect();
    assert!(missed.is_empty() && unbroken.len() > 40, "{missed:#?}");
}

#[test]
fn every_slip_has_its_place() {
    for (from, to) in crate::hash::SLIPS {
        assert!(Source::with(from, to).is_ok(), "{from}");
    }
}

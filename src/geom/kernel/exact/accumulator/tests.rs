use dashu_int::Sign;
use dashu_int::ops::BitTest as _;
use dashu_ratio::RBig;
use glam::DVec3;
use proptest::prelude::*;

use super::super::predicates::apart;
use super::*;

/// Draws any finite double: with all bits, or with a few digits times any power of two.
fn double() -> impl Strategy<Value = f64> {
    let finite = any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite());
    let short = (-9..9i32, -1074..1021i32).prop_map(|(digits, exponent)| f64::from(digits) * 2f64.powi(exponent));
    prop_oneof![finite, short, Just(0.0), Just(-0.0), Just(5e-324), Just(f64::MAX)]
}

fn vector() -> impl Strategy<Value = DVec3> {
    [double(), double(), double()].prop_map(DVec3::from)
}

/// One bit or many, in up to three limbs.
fn digits() -> impl Strategy<Value = [u64; 3]> {
    let limb = || prop_oneof![Just(0), (0..64u32).prop_map(|bit| 1 << bit), any::<u64>()];
    [limb(), limb(), limb()]
}

fn rational(x: f64) -> RBig {
    RBig::try_from(x).expect("a finite number")
}

/// Returns the sum as a rational number.
fn value(sum: &Accumulator) -> RBig {
    RBig::from(sum.integer()) / RBig::from(UBig::ONE << (-UNIT) as usize)
}

proptest! {
    /// [EXACT-8]
    #[test]
    fn sums_are_exact(products in prop::collection::vec([double(), double(), double()], 0..40)) {
        let (mut sum, mut truth) = (Accumulator::new(), RBig::ZERO);
        for factors in products {
            sum.add_product(factors);
            truth += factors.map(rational).into_iter().fold(RBig::ONE, |a, b| a * b);
        }
        prop_assert_eq!(sum.sign(), truth.cmp(&RBig::ZERO));
        prop_assert_eq!(value(&sum), truth);
    }

    /// [EXACT-8]
    ///
    /// Also differences, where they overflow.
    #[test]
    fn volumes_are_exact(d in [vector(), vector()], a in [vector(), vector()], b in [vector(), vector()]) {
        let sum = Accumulator::volume(&apart(d), &apart(a), &apart(b));
        let [d, a, b] = [d, a, b].map(|[x, y]| [0, 1, 2].map(|k| rational(y[k]) - rational(x[k])));
        let terms = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            &d[k] * (&a[i] * &b[j] - &a[j] * &b[i])
        });
        prop_assert_eq!(value(&sum), terms.into_iter().fold(RBig::ZERO, |a, b| a + b));
    }

    /// The first 128 digits, and whether any limb has further digits. [EXACT-8]
    #[test]
    fn the_first_digits_are_those_of_the_sum(
        base in 0..5000usize,
        parts in prop::collection::vec((digits(), 0..600usize, any::<bool>()), 0..4),
    ) {
        let mut sum = Accumulator::new();
        for (digits, place, is_negative) in parts {
            sum.add(digits, base + place, is_negative);
        }
        let (sign, whole) = sum.integer().into_parts();
        let Some(found) = sum.leading() else {
            prop_assert_eq!(whole, UBig::ZERO);
            return Ok(());
        };
        let (digits, exponent) = (UBig::from(found.digits), whole.bit_len() as i32 - 128);
        let first = if exponent < 0 { &whole << -exponent as usize } else { &whole >> exponent as usize };
        let is_all = exponent < 0 || &digits << exponent as usize == whole;
        prop_assert_eq!((digits, found.exponent), (first, exponent));
        prop_assert_eq!((found.is_negative, found.is_exact), (sign == Sign::Negative, is_all));
    }

    /// Adding and subtracting equal products in any order gives 0, with carries over many limbs.
    #[test]
    fn what_is_added_and_subtracted_is_nothing(
        parts in prop::collection::vec(([any::<u64>(), any::<u64>(), any::<u64>()], 0..6000usize), 1..20),
        seed in any::<u64>(),
    ) {
        let mut sum = Accumulator::new();
        for &(digits, place) in &parts {
            sum.add(digits, place, false);
        }
        prop_assert_eq!(sum.sign() == Ordering::Equal, parts.iter().all(|(digits, _)| *digits == [0; 3]));
        let start = seed as usize % parts.len();
        for &(digits, place) in parts[start..].iter().chain(&parts[..start]) {
            sum.add(digits, place, true);
        }
        prop_assert_eq!(sum.sign(), Ordering::Equal);
    }
}

#[test]
fn a_carry_runs_as_far_as_it_has_to() {
    for place in [0, 1, 63, 64, 65, 700] {
        let mut sum = Accumulator::new();
        let end = place + 80 * 64;
        for limb in (place..end).step_by(64) {
            sum.add([u64::MAX, 0, 0], limb, false);
        }
        sum.add([1, 0, 0], place, false);
        sum.add([1, 0, 0], end, true);
        assert_eq!(sum.sign(), Ordering::Equal, "{place}");
    }
}

/// The greatest and the least products, in the maximum number.
#[test]
fn the_register_holds_all_products() {
    let mut sum = Accumulator::new();
    for _ in 0..1000 {
        sum.add_product([f64::MAX; 3]);
        sum.add_product([-5e-324; 3]);
    }
    let cube = |x: f64| rational(x) * rational(x) * rational(x);
    assert_eq!(value(&sum), (cube(f64::MAX) - cube(5e-324)) * RBig::from(1000));
}

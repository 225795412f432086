use proptest::prelude::*;

use super::*;
use crate::geom::truth::Number as _;

/// The distance of a plane that is `far` away, in steps of `d`.
fn ahead(far: f64, d: f64) -> f64 {
    let (o, interval) = (DVec3::new(0.25, 0.25, -far), [f64::NEG_INFINITY, f64::INFINITY]);
    distance(&[DVec3::ZERO, DVec3::X, DVec3::Y], o, DVec3::Z * d, interval).expect("within all numbers")
}

#[test]
fn distances_of_all_sizes_are_rounded_once() {
    let power = |exponent: i32| 2f64.powi(exponent);
    for sign in [1.0, -1.0] {
        assert_eq!(ahead(sign, 3.0), sign / 3.0);
        assert_eq!(ahead(0.0, 3.0 * sign).to_bits(), 0);
        assert_eq!(ahead(sign * power(1000), power(-20).next_up()), sign * power(1020).next_down().next_down());
        // Subnormal, and halfway between two subnormal numbers.
        assert_eq!(ahead(sign * 3.0, power(500)), sign * 3.0 * power(-500));
        assert_eq!(ahead(sign * 5.0 * power(-100), power(975)), sign * power(-1073));
        assert_eq!(ahead(sign * 7.0 * power(-100), power(975)), sign * power(-1072));
        // Almost 0, and beyond all floats.
        assert_eq!(ahead(sign * power(-1000), power(1000)), 0.0);
        assert_eq!(ahead(sign * power(1000), power(-1000)), sign * f64::INFINITY);
    }
}

#[test]
fn ends_belong_to_the_interval() {
    let third = |interval| distance(&[DVec3::ZERO, DVec3::X, DVec3::Y], DVec3::NEG_Z, DVec3::Z * 3.0, interval);
    let nearest = 1.0 / 3.0;
    // The nearest double is below 1/3.
    assert_eq!(third([nearest, 1.0]), Some(nearest));
    assert_eq!(third([0.0, nearest]), None);
    assert_eq!(third([nearest.next_up(), 1.0]), None);
    assert_eq!(third([0.0, nearest.next_up()]), Some(nearest));
    // The nearest float is above 1/3.
    let third = |interval| distance(&[DVec3::ZERO, DVec3::X, DVec3::Y], DVec3::NEG_Z, DVec3::Z * 3.0, interval);
    let nearest = 1.0f32 / 3.0;
    assert_eq!([third([nearest, 1.0]), third([0.0, nearest])], [None, Some(nearest)]);
}

/// Hits exactly at midpoints between floats, or so close that a quotient of doubles does not show the difference.
#[test]
fn ties_of_floats_go_to_even() {
    for odd in [0, 1, 2, 3u32] {
        // The plane is at 2^24 + 2 odd, and 4 above that at the second corner. At (0, 0) the weight of that is a
        // quarter: the distance ends in 1, and floats are 2 apart.
        let low = 2f64.powi(24) + 2.0 * f64::from(odd);
        let [a, b, c] = [[-1.0, -1.0, low], [3.0, -1.0, low + 4.0], [-1.0, 3.0, low]].map(DVec3::from);
        for nudge in [0.0, 2f64.powi(-30), -2f64.powi(-30), 1e-300, -1e-300] {
            let is_up = if nudge == 0.0 { odd % 2 == 1 } else { nudge > 0.0 };
            let expected = low + if is_up { 2.0 } else { 0.0 };
            for corners in [[a, b, c], [a, c, b]] {
                let found = distance(&corners, DVec3::X * nudge, DVec3::Z, [0.0, f32::INFINITY]);
                assert_eq!(found.map(f64::from), Some(expected), "{odd} {nudge}");
                // Behind the origin.
                let found = distance(&corners, DVec3::X * nudge, -DVec3::Z, [f32::NEG_INFINITY.next_up(), 0.0]);
                assert_eq!(found.map(f64::from), Some(-expected), "{odd} {nudge}");
            }
        }
    }
}

fn sum(products: &[[f64; 3]]) -> Accumulator {
    let mut sum = Accumulator::new();
    for &product in products {
        sum.add_product(product);
    }
    sum
}

/// Draws a number of some digits, or an integer, times a power of two.
fn double(exponents: std::ops::Range<i32>) -> impl Strategy<Value = f64> {
    let digits = prop_oneof![-1.0..1.0f64, (-9..9i8).prop_map(f64::from), (0..1i64 << 40).prop_map(|x| x as f64)];
    (digits, exponents).prop_map(|(digits, exponent)| digits * 2f64.powi(exponent))
}

fn products(exponents: std::ops::Range<i32>) -> impl Strategy<Value = Vec<[f64; 3]>> {
    let factor = || double(exponents.clone());
    prop::collection::vec([factor(), factor(), factor()], 1..4)
}

/// Returns whether the first digits decide. If so, checks that all digits agree.
fn tells<R: Real>(ratio: &Ratio<'_>) -> bool {
    ratio.nearest::<R>().inspect(|&t| assert_eq!(t, R::nearest_to(&ratio.fraction()))).is_some()
}

proptest! {
    /// [EXACT-8]
    #[test]
    fn first_digits_tell_the_truth(top in products(-1000..1000), det in products(-1000..1000)) {
        let ratio = Ratio { top: &sum(&top), det: &sum(&det) };
        prop_assume!(ratio.det.sign().is_ne());
        tells::<f32>(&ratio);
        tells::<f64>(&ratio);
    }

    /// For numbers with few digits they decide all cases, including ties.
    #[test]
    fn first_digits_tell_short_quotients(
        top in -1i64 << 52..1i64 << 52,
        det in 1..1i64 << 20,
        power in -30..30i32,
        is_tie in any::<bool>(),
    ) {
        let (top, det) = (top as f64, if is_tie { 4.0 } else { det as f64 });
        for det in [det, -det] {
            let (top, det) = (sum(&[[top, 3.0, 1.0], [top, -1.0, 1.0]]), sum(&[[det, 2f64.powi(power), 1.0]]));
            let ratio = Ratio { top: &top, det: &det };
            prop_assert!(tells::<f32>(&ratio) && tells::<f64>(&ratio));
        }
    }
}

/// Returns 2^exponent with a sign, if there is an exponent, and otherwise 0.
fn nudge(exponent: Option<i32>, is_negative: bool) -> f64 {
    exponent.map_or(0.0, |exponent| if is_negative { -2f64.powi(exponent) } else { 2f64.powi(exponent) })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Quotients that are midpoints between floats, or almost. The difference is in any limb of the dividend or of the
    /// divisor. [EXACT-8]
    #[test]
    fn first_digits_tell_no_tie_that_is_none(
        m in 1i64 << 52..1i64 << 53,
        is_single in any::<bool>(),
        divisor in prop_oneof![Just(1), (1..1i64 << 20)],
        nudges in [(prop::option::of(-400..0i32), any::<bool>()), (prop::option::of(-400..0i32), any::<bool>())],
    ) {
        // In single precision it is 2 m + 1 with fewer digits.
        let (m, divisor) = (if is_single { m >> 29 } else { m } as f64, divisor as f64);
        let [top, det] = nudges.map(|(exponent, is_negative)| nudge(exponent, is_negative));
        let top = sum(&[[m, 2.0, divisor], [divisor, 1.0, 1.0], [top, 1.0, 1.0]]);
        let ratio = Ratio { top: &top, det: &sum(&[[divisor, 1.0, 1.0], [det, 1.0, 1.0]]) };
        tells::<f32>(&ratio);
        tells::<f64>(&ratio);
    }
}

/// A midpoint between floats, and a number that differs from it only after the first digits.
#[test]
fn first_digits_do_not_tell_what_is_beyond_them() {
    let middle = 2f64.powi(60) + 2f64.powi(36);
    for (nudge, is_told, expected) in [(0.0, true, 2f32.powi(60)), (2f64.powi(-200), false, 2f32.powi(60).next_up())] {
        let ratio = Ratio { top: &sum(&[[middle, 1.0, 1.0], [nudge, 1.0, 1.0]]), det: &sum(&[[1.0; 3]]) };
        assert_eq!(ratio.nearest::<f32>(), is_told.then_some(expected));
        assert_eq!(f32::nearest_to(&ratio.fraction()), expected);
    }
    let zero = Ratio { top: &Accumulator::new(), det: &sum(&[[-1.0; 3]]) };
    assert_eq!(zero.nearest::<f64>().map(f64::to_bits), Some(0));
}

/// Overflow is certain from the first unit on that is surely beyond all floats.
#[test]
fn first_digits_tell_what_is_beyond_all_numbers() {
    let power = |exponent: i32| 2f64.powi(exponent);
    for sign in [1.0, -1.0] {
        let below = Ratio { top: &sum(&[[power(1000), power(23), sign]]), det: &sum(&[[1f64.next_down(), 1.0, 1.0]]) };
        assert_eq!((below.nearest::<f64>(), f64::nearest_to(&below.fraction())), (None, sign * power(1023).next_up()));
        let beyond = Ratio { top: &sum(&[[power(1000), power(24), sign]]), ..below };
        assert_eq!(beyond.nearest(), Some(sign * f64::INFINITY));
        assert_eq!(f64::nearest_to(&beyond.fraction()), sign * f64::INFINITY);
        assert_eq!(beyond.nearest(), Some(sign as f32 * f32::INFINITY));
    }
}

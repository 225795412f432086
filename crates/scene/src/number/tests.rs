use stackless_bvh::internals::geom::truth::{Number as _, RBig};

use super::*;
use crate::tests::Random;

/// Returns the exact value of a decimal.
fn rational(word: &str) -> RBig {
    let (mantissa, power) = word.split_once(['e', 'E']).unwrap_or((word, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = [whole, fraction].concat();
    let power = power.parse::<i64>().unwrap() - fraction.len() as i64;
    let ten = |power: i64| format!("1{}", "0".repeat(power as usize));
    let quotient =
        if power < 0 { format!("{digits}/{}", ten(-power)) } else { format!("{digits}{}", &ten(power)[1..]) };
    quotient.trim_start_matches('+').parse().unwrap()
}

fn abs(x: RBig) -> RBig {
    if x < RBig::ZERO { -x } else { x }
}

/// Checks that the error is 0 if and only if the decimal equals the float, and never too small.
fn check<F: Float>(word: &str) -> bool {
    let Number { value, error } = Number::<F>::parse(word).unwrap();
    let exact = rational(word);
    let [read, bound] = [value.into(), error].map(|float| RBig::try_from(float).unwrap());
    assert_eq!(value, F::nearest(&exact), "{word}");
    assert_eq!(error == 0.0, read == exact, "{word}: {value:?}, {error:e}");
    assert!(abs(read - exact) <= bound, "{word}: {error:e}");
    assert!(error <= half_unit::<F>(value.into()), "{word}: {error:e}");
    error == 0.0
}

#[test]
fn a_decimal_is_told_from_its_float() {
    for exact in [
        "0",
        "-0.0",
        "+.5",
        "5.",
        "0.25",
        "1e0",
        "100e-2",
        "0.00390625",
        "16777216",
        "1e10",
        "1E+10",
        "2.5e-1",
        "0.50000000000000000000000000000000",
        "18446744073709551616",
        "340282346638528859811704183484516925440",
        "0.1000000014901161193847656250",
        "9007199254740992000e-3",
        "1.40129846432481707092372958328991613128026194187651577175706828388979108268586060148663818836212158203125e-45",
    ] {
        assert_eq!([check::<f32>(exact), check::<f64>(exact)], [true; 2], "{exact}");
    }
    for rounded in [
        "0.1",
        "1e-1",
        "16777217.5e-40",
        "691607.1",
        "1e23",
        "123456789012345678901234567890",
        "0.30000000000000000001",
        "1e-300",
        "18446744073709551617",
        "0.500000000000000000000000000000000001",
    ] {
        assert!(!check::<f32>(rounded), "{rounded}");
    }
    for rounded in
        ["0.1", "9007199254740993", "1e23", "18446744073709551615", "0.30000000000000000001", "4.9e-324", "1e-400"]
    {
        assert!(!check::<f64>(rounded), "{rounded}");
    }
    assert_eq!([check::<f32>("16777217"), check::<f64>("16777217")], [false, true]);
    for no_error in ["-inf", "0e999999999999", "-0.000e-99999999999999999999"] {
        assert_eq!(Number::<f32>::parse(no_error).unwrap().error, 0.0);
    }
    assert!(Number::<f64>::parse("1e-99999999999999999999").unwrap().error > 0.0);
    assert!(Number::<f64>::parse("0,1").is_none() && Number::<f64>::parse("").is_none());
}

#[test]
fn decimals_of_all_lengths_are_told_from_their_floats() {
    let mut random = Random(1);
    let mut counts = [0; 2];
    for _ in 0..5_000 {
        let double = f64::from_bits(random.next());
        let single = f32::from_bits(random.next() as u32);
        let short = (random.below(2000) as f64 - 1000.0) / f64::from(1 << random.below(12));
        let places = random.below(30);
        let mut words = vec![
            format!("{}.{:0>1$}e{2}", random.below(1000), places, random.below(40) as i32 - 20),
            format!("{short:.places$}"),
            format!("{short:.60}"),
            format!("{}{}", random.next(), random.next()),
            format!("{}e-{}", random.next() >> random.below(64), random.below(30)),
        ];
        if double.is_finite() && double.abs() > 1e-30 && double.abs() < 1e30 {
            words.extend([
                format!("{double}"),
                format!("{double:.120}"),
                format!("{double:.20}"),
                format!("{double:e}"),
            ]);
        }
        if single.is_finite() {
            words.extend([format!("{single}"), format!("{single:.150}"), format!("{single:.8e}")]);
        }
        for word in words {
            counts[usize::from(check::<f64>(&word))] += 1;
            if f32::nearest(&rational(&word)).is_finite() {
                check::<f32>(&word);
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 2_000), "{counts:?}");
}

#[test]
fn sums_and_products_know_what_rounding_leaves_out() {
    let mut random = Random(2);
    let mut exact = 0;
    for _ in 0..20_000 {
        let mut float = || loop {
            let float = f64::from_bits(random.next());
            // Few bits: many results are exact.
            let float = f64::from_bits(float.to_bits() & !0 << random.below(53));
            if float == 0.0 || (1e-100..1e100).contains(&float.abs()) {
                return Number { value: float, error: [0.0, float.abs() * 1e-16][random.below(2)] };
            }
        };
        let [a, b] = [float(), float()];
        let number = |x: f64| RBig::try_from(x).unwrap();
        for (result, truth) in [(a + b, number(a.value) + number(b.value)), (a * b, number(a.value) * number(b.value))]
        {
            let from_operands = a.error + b.error;
            let left = abs(number(result.value) - truth);
            assert!(left <= number(result.error), "{a:?} {b:?}: {result:?}");
            if from_operands == 0.0 && result.value.abs() > 1e-200 {
                assert_eq!(result.error == 0.0, left == RBig::ZERO, "{a:?} {b:?}: {result:?}");
                exact += u32::from(result.error == 0.0);
            }
        }
        // Operands with their greatest errors.
        let ends = |number_of: Number<f64>| {
            [-1, 1].map(|sign| number(number_of.value) + number(number_of.error) * RBig::from(sign))
        };
        for (x, y) in ends(a).into_iter().flat_map(|x| ends(b).map(|y| (x.clone(), y))) {
            let tolerance = |result: Number<f64>| number(result.error) * number(1.0 + 1e-12);
            assert!(abs(&x + &y - number((a + b).value)) <= tolerance(a + b), "{a:?} {b:?}");
            assert!(abs(&x * &y - number((a * b).value)) <= tolerance(a * b), "{a:?} {b:?}");
        }
    }
    assert!(exact > 2_000, "{exact}");
}

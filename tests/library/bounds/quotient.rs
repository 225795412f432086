//! The interval of the quotient T / det, and when its ends determine the rounded distance [EXACT-9].

use stackless_bvh::generate::{Rng, Source};

use super::constants::{QUOTIENT, QUOTIENT_ROUNDINGS};
use super::draw::{Family, draw, power, unit};
use super::dyadic::{Dyadic, nearest};
use super::filter::{exact, rounded};

const U: f64 = f64::EPSILON / 2.0;

/// Returns bounds of the exact quotient; `None` if the determinant is smaller than the derivation requires.
fn ends([t, det]: [f64; 2], [dt, ddet]: [f64; 2], factor: f64, roundings: f64) -> Option<[f64; 2]> {
    let reciprocal = 1.0 / det;
    let q = t * reciprocal;
    let error = (dt * factor + q.abs() * (ddet * factor)) * reciprocal.abs() + q.abs() * (roundings * U);
    (det.abs() >= 7.5 * ddet).then_some([q - error, q + error])
}

/// Returns whether `t / det`, both positive, is between the ends.
fn holds([low, high]: [f64; 2], t: &Dyadic, det: &Dyadic) -> bool {
    &Dyadic::from(low) * det <= *t && *t <= &Dyadic::from(high) * det
}

/// Counts how many of the four extreme quotients, over many cases, are outside.
fn escapes(factor: f64, roundings: f64) -> u32 {
    let mut rng = Rng::new(4);
    let mut count = 0;
    for _ in 0..20_000 {
        let values = [1.0 + unit(&mut rng), 1.0 + unit(&mut rng)];
        let errors = [power(&mut rng, -70, -3), power(&mut rng, -54, -3)].map(|scale| scale * unit(&mut rng));
        let Some(ends) = ends(values, errors, factor, roundings) else { continue };
        for signs in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
            let [t, det] = [0, 1].map(|k| &Dyadic::from(values[k]) + &Dyadic::from(signs[k] * errors[k]));
            count += u32::from(!holds(ends, &t, &det));
        }
    }
    count
}

#[test]
fn the_true_quotient_is_between_the_ends_and_half_of_a_constant_is_too_little() {
    assert_eq!(escapes(QUOTIENT, QUOTIENT_ROUNDINGS), 0);
    assert_ne!(escapes(QUOTIENT / 2.0, QUOTIENT_ROUNDINGS), 0);
    assert_ne!(escapes(QUOTIENT, QUOTIENT_ROUNDINGS / 2.0), 0);
}

/// [EXACT-3]
#[test]
fn ends_that_round_alike_give_the_nearest_float() {
    let mut rng = Rng::new(5);
    let (mut decided, mut open, mut beyond) = (0, 0, 0);
    for _ in 0..3000 {
        for (family, range) in Family::ALL.into_iter().flat_map(|f| [(f, [-30, 30]), (f, [-149, 128])]) {
            let input = draw(&mut rng, family, range).map(|a| a.map(|x| x as f32));
            if input.as_flattened().iter().any(|x| !x.is_finite()) {
                continue;
            }
            let input = input.map(|a| a.map(f64::from));
            let (rounded, [.., det, t]) = (rounded(input), exact(input));
            let ([.., rounded_det, rounded_t], [.., ddet, dt]) = (rounded.values, rounded.bounds(1.0));
            let Some(mut ends) = ends([rounded_t, rounded_det], [dt, ddet], QUOTIENT, QUOTIENT_ROUNDINGS) else {
                continue;
            };
            // For a negative quotient the interval is mirrored.
            if t.sign() * det.sign() < 0 {
                ends = [-ends[1], -ends[0]];
            }
            if ends.iter().any(|end| !end.is_finite()) {
                continue;
            }
            let (t, det) = (t.abs(), det.abs());
            assert!(holds(ends, &t, &det), "{input:?}");
            let [low, high] = ends.map(|end| end as f32);
            if low.to_bits() == high.to_bits() {
                assert_eq!(low.to_bits(), nearest::<f32>(&t, &det).to_bits(), "{input:?}");
                decided += 1;
                beyond += u32::from(low == 0.0 || low == f32::INFINITY);
            } else {
                open += 1;
            }
        }
    }
    assert!(decided > 10_000 && open > 0 && beyond > 10, "{decided} {open} {beyond}");
}

/// The determinant must be large: below 5 times its error, the factor is insufficient.
#[test]
fn a_small_determinant_must_not_decide() {
    let (values, errors) = ([1.0, 1.0], [0.0, 0.25]);
    assert_eq!(ends(values, errors, QUOTIENT, QUOTIENT_ROUNDINGS), None);
    let high = values[0] + errors[1] * QUOTIENT;
    assert!(high < values[0] / (values[1] - errors[1]));
}

/// A quotient at the midpoint between two floats rounds to even, and only an exact sign decides.
#[test]
fn middles_are_left_open() {
    let mut rng = Rng::new(6);
    for _ in 0..1000 {
        let det = (1 + rng.below(1 << 20)) as f64;
        let middle = f64::from(1 + 2 * rng.below(1 << 23) as u32 + (1 << 24));
        let Some([low, high]) = ends([middle * det, det], [middle * det * U, det * U], QUOTIENT, QUOTIENT_ROUNDINGS)
        else {
            panic!("the error is small");
        };
        assert_ne!(low as f32, high as f32);
    }
}

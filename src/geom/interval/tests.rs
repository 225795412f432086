use proptest::prelude::*;

use super::*;
use crate::generate::draw::Draw;
use crate::geom::tests::{exact, exponent, holds, sorted, threshold};

fn number() -> impl Strategy<Value = f64> {
    let few = [0.0, -0.0, 1.0, -1.0, 3.0, 0.1, 5e-324, -5e-324, 1e-200, -1e200, f64::MAX, f64::MIN];
    let any = any::<f64>().prop_filter("finite", |x| x.is_finite());
    prop_oneof![prop::sample::select(few.to_vec()), any, threshold()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn results_hold_the_exact_ones(a in [number(), number()], b in [number(), number()], c in number()) {
        let (p, q, r) = (sorted(a), sorted(b), Interval::exact(c));
        for x in a {
            for y in b {
                let (x, y, z) = (exact(x), exact(y), exact(c));
                prop_assert!(holds(p + q, &(&x + &y)) && holds(p - q, &(&x - &y)) && holds(p * q, &(&x * &y)));
                prop_assert!(holds((p + q) * r, &((&x + &y) * &z)) && holds((p * q) - r, &(&x * &y - &z)));
                prop_assert!(holds((p * q) * (q - r), &(&x * &y * (&y - &z))));
            }
            let ([lo, hi], [middle, radius]) = (p.ends_in_single(), p.middle_and_radius());
            prop_assert!(f64::from(lo) <= x && x <= f64::from(hi));
            if middle.is_finite() && radius.is_finite() {
                prop_assert!(holds(Interval::between([-radius, radius]), &(exact(x) - exact(middle))));
            }
        }
    }
}

#[test]
fn what_is_exact_stays_so() {
    let [one, three] = [1.0, 3.0].map(Interval::exact);
    assert_eq!(one + three, Interval::exact(4.0));
    assert_eq!(three * three, Interval::exact(9.0));
    assert_ne!(Interval::exact(0.1) * three, Interval::exact(0.1 * 3.0));
    assert_eq!(one - one, Interval::exact(0.0));
    assert!((three * Interval::exact(0.0) + Interval::exact(-0.0) * one).is_zero());
    assert_eq!(Interval::between([1.0, 1e300]).ends_in_single(), [1.0, f32::INFINITY]);
}

/// Multiplies by a power of two. The bounds are as narrow as doubles permit, so inexact results are not reported as
/// exact. [INST-3]
#[test]
fn scaled_numbers_are_held_by_the_narrowest_bounds() {
    let (mut draw, mut seen) = (Draw::new(1), [0; 2]);
    for _ in 0..100_000 {
        let ends = [draw.threshold(), draw.threshold()];
        let exponent = exponent(&mut draw, ends[0]);
        let narrowest = |x: f64| Interval::around((exact(x) * exact(power_of_two(exponent))).as_relaxed());
        for x in ends {
            let (found, expected) = (Interval::exact(x).scaled(exponent), narrowest(x));
            assert_eq!(found, expected, "{x:e} 2^{exponent}");
            seen[usize::from(found.is_exact())] += 1;
        }
        let [lo, hi] = sorted(ends).ends();
        let expected = Interval::between([narrowest(lo).lo, narrowest(hi).hi]);
        assert_eq!(sorted(ends).scaled(exponent), expected, "{ends:?} 2^{exponent}");
    }
    assert!(seen.into_iter().all(|seen| seen > 20_000), "{seen:?}");
}

/// Results reported as exact at thresholds are exact. [INST-3]
#[test]
fn what_is_exact_is_the_result() {
    let (mut draw, mut seen) = (Draw::new(2), [0; 3]);
    for _ in 0..100_000 {
        let [x, y] = [draw.threshold(), draw.threshold()];
        let [p, q] = [x, y].map(Interval::exact);
        let results = [(p + q, exact(x) + exact(y)), (p - q, exact(x) - exact(y)), (p * q, exact(x) * exact(y))];
        for ((found, expected), seen) in results.into_iter().zip(&mut seen) {
            assert!(holds(found, &expected), "{x:e} {y:e}: {found:?}");
            *seen += usize::from(found.is_exact());
        }
        let [middle, radius] = sorted([x, y]).middle_and_radius();
        for x in [x, y] {
            assert!(holds(Interval::between([-radius, radius]), &(exact(x) - exact(middle))), "{x:e} {y:e}");
        }
    }
    assert!(seen.into_iter().all(|seen| seen > 5000), "{seen:?}");
}

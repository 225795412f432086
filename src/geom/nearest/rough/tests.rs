use super::*;
use crate::generate::{Rng, Source};
use crate::geom::nearest::enclosure::Enclosure;
use crate::geom::tests::exact;
use crate::geom::truth::RBig;

fn holds(x: Rough, number: &RBig) -> bool {
    let middle = exact(x.middle);
    let off = if middle < *number { number - middle } else { middle - number };
    !x.radius.is_finite() || off <= exact(x.radius)
}

/// Draws a number in the range, and an exact value that it encloses, at one of its ends. A third are exact.
fn number(random: &mut Rng, powers: i32) -> (Rough, RBig) {
    let magnitude = 1.0 + (random.bits() >> 12) as f64 * 2f64.powi(-52);
    let scaled = magnitude * 2f64.powi(random.below(2 * powers as u64) as i32 - powers);
    let middle = if random.coin() { scaled } else { -scaled };
    let radius = if random.below(3) == 0 { 0.0 } else { middle.abs() * 2f64.powi(-(random.below(60) as i32) - 1) };
    (Rough { middle, radius }, exact(middle) + if random.coin() { exact(radius) } else { -exact(radius) })
}

/// [NEAR-3]
#[test]
fn results_hold_the_exact_ones() {
    let mut random = Rng::new(1);
    let mut quotients = 0;
    for round in 0..20_000 {
        let powers = if round % 2 == 0 { 4 } else { 150 };
        let [(a, x), (b, y), (c, z)] = [(); 3].map(|()| number(&mut random, powers));
        assert!(holds(a + b, &(&x + &y)) && holds(a - b, &(&x - &y)) && holds(a * b, &(&x * &y)), "{a:?} {b:?}");
        // Of degree four, like areas.
        let (product, truth) = ((a * b - c * a) * (b * c - a * a), (&x * &y - &z * &x) * (&y * &z - &x * &x));
        assert!(holds(product, &truth), "{a:?} {b:?} {c:?}");
        // Nearly all digits cancel.
        let (d, w) = (Rough { middle: a.middle.next_up(), ..a }, &x + exact(a.middle.next_up()) - exact(a.middle));
        assert!(holds((a - d) * b * (c - a), &((&x - &w) * &y * (&z - &x))), "{a:?} {b:?} {c:?}");
        let whole = a * a + b * b;
        let quotient = (a * a).share(whole);
        quotients += usize::from(quotient.radius < 1e-9);
        assert!(holds(quotient, &((&x * &x) / (&x * &x + &y * &y))), "{a:?} {b:?}");
        let hull = a.hull(b);
        assert!(holds(hull, &x) && holds(hull, &y), "{a:?} {b:?}");
        assert!(!a.is_negative() || x < RBig::ZERO, "{a:?}");
        assert!(!a.is_positive() || x > RBig::ZERO, "{a:?}");
    }
    assert!(quotients > 5000, "{quotients}");
}

#[test]
fn what_may_underflow_is_not_taken() {
    for x in [2f64.powi(-151), 2f64.powi(151), f64::MIN_POSITIVE, f64::INFINITY, f64::NAN] {
        assert!(Rough::of(x).is_none() && Rough::of(-x).is_none(), "{x}");
    }
    for x in [0.0, 1.0, f64::from(f32::MAX), f64::from(f32::from_bits(1))] {
        assert!(Rough::of(x).is_some() && Rough::of(-x).is_some(), "{x}");
    }
}

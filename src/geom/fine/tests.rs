use super::*;
use crate::generate::draw::Draw;
use crate::generate::{Rng, Source};
use crate::geom::tests::{self as shared, exact, vectors};
use crate::geom::truth::RBig;

fn holds(x: Fine, number: &RBig) -> bool {
    let middle = exact(x.high) + exact(x.low);
    let off = if middle < *number { number - middle } else { middle - number };
    off <= exact(x.radius)
}

/// Draws a number and an exact value that it encloses, at one of its ends. Half are sums of two doubles, and a third
/// have a radius.
fn number(random: &mut Rng) -> (Fine, RBig) {
    let mut double = |powers: u64| {
        let scale = 2f64.powi((random.bits() % powers) as i32 - powers as i32 / 2);
        ((random.bits() >> 10) as f64 / (1u64 << 53) as f64 - 1.0) * scale
    };
    let (high, low) = two_sum(double(60), double(2) * 1e-30);
    let radius = double(2).abs() * high.abs() * 1e-25;
    let [low, radius] = [(low, random.coin()), (radius, random.below(3) == 0)].map(|(x, is)| if is { x } else { 0.0 });
    (Fine { high, low, radius }, exact(high) + exact(low) + if random.coin() { exact(radius) } else { -exact(radius) })
}

/// [NEAR-5]
#[test]
fn results_hold_the_exact_ones() {
    let mut random = Rng::new(1);
    let mut quotients = 0;
    for _ in 0..20_000 {
        let ((a, x), (b, y), (c, z)) = (number(&mut random), number(&mut random), number(&mut random));
        let near = |a: Fine| Fine { high: a.high.next_up(), low: -a.low, radius: a.radius };
        assert!(holds(a + b, &(&x + &y)) && holds(a - b, &(&x - &y)) && holds(a * b, &(&x * &y)), "{a:?} {b:?}");
        assert!(holds(a * b - c * a, &(&x * &y - &z * &x)), "{a:?} {b:?} {c:?}");
        // Nearly all digits cancel.
        let (d, w) = (near(a), exact(a.high.next_up()) - exact(a.low) + (&x - exact(a.high) - exact(a.low)));
        assert!(holds(a - d, &(&x - &w)) && holds(a * b - d * b, &((&x - &w) * &y)), "{a:?} {b:?}");
        let (part, whole) = (a * a, a * a + b * b);
        if let Some(quotient) = part.over(whole) {
            assert!(holds(quotient, &((&x * &x) / (&x * &x + &y * &y))), "{a:?} {b:?}");
        }
        if let Some(quotient) = a.over(b) {
            quotients += 1;
            assert!(holds(quotient, &(&x / &y)), "{a:?} {b:?}");
        }
        let hull = a.hull(b);
        assert!(holds(hull, &x) && holds(hull, &y), "{a:?} {b:?}");
        if let Some(root) = part.root() {
            assert!(holds(root, &if x < RBig::ZERO { -x } else { x }), "{a:?}");
        }
    }
    assert!(quotients > 19_000, "{quotients}");
}

/// The radius is larger than the lost digits.
#[test]
fn wide_radii_are_not_forgotten() {
    let mut random = Rng::new(3);
    for _ in 0..2000 {
        let (a, _) = number(&mut random);
        let wide = Fine { radius: a.high.abs() * 1e-20, ..a };
        let ends = [exact(wide.radius), -exact(wide.radius)].map(|end| exact(a.high) + exact(a.low) + end);
        let hull = Fine { radius: 0.0, ..a }.hull(wide);
        assert!(ends.iter().all(|end| holds(hull, end)), "{a:?}");
    }
    let wide = Fine { high: 1.0, low: 0.0, radius: 0.125 };
    let [[least, _], [most, _]] = wide.root().expect("positive").bounds();
    assert!(least * least <= 0.875 && most * most >= 1.125, "{least} {most}");
    let [[least, _], [most, _]] = (wide * wide).bounds();
    assert!(least <= 0.875 * 0.875 && most >= 1.125 * 1.125, "{least} {most}");
    let [[least, _], [most, _]] = Fine::exact(0.5).over(wide).expect("positive").bounds();
    assert!(least * 1.125 <= 0.5 && most * 0.875 >= 0.5, "{least} {most}");
}

/// Radii are at most some units in the last place of double-double precision.
#[test]
fn results_are_near() {
    let mut random = Rng::new(2);
    for _ in 0..2000 {
        let [a, b] = [(); 2].map(|()| Fine { radius: 0.0, ..number(&mut random).0 });
        let (part, whole) = (a * a, a * a + b * b);
        for result in [part, whole, part.over(whole).expect("positive"), whole.root().expect("positive")] {
            assert!(result.radius <= result.high.abs() * ERROR * 16.0, "{a:?} {b:?} {result:?}");
        }
    }
}

#[test]
fn what_is_exact_stays_so() {
    let of = Fine::exact;
    assert!((of(1.0) - of(1.0)).is_exact() && (of(1.0) + of(1e-30)).is_exact());
    assert!((of(0.0) * (of(0.1) * of(0.1))).is_exact());
    let [a, b, c] = [0.1f32, 0.3, 0.7].map(|x| of(1.0 + f64::from(x)));
    let zero = (a * b - b * c) * c + (b * c - a * b) * c;
    assert_eq!((zero.sign(), zero.is_exact()), (Some(0.0), true));
    // A sum of three numbers of very different magnitudes is not exact.
    assert!(!(of(1.0) + of(1e-30) + of(1e-60)).is_exact());
    assert_eq!((of(1.0) + of(1e-30)).bounds(), [[1.0, 1e-30]; 2]);
    assert_eq!(of(0.0).root().map(Fine::bounds), Some([[0.0; 2]; 2]));
    assert!(of(1.0).over(of(0.0)).is_none() && of(0.0).over(of(0.0)).is_none());
    assert_eq!(of(-6.0).over(of(-3.0)).map(|two| two.bounds().map(|[end, _]| end)), Some([2.0; 2]));
    // The sign is uncertain: it may be 0.
    let wide = Fine { high: 1.0, low: 0.0, radius: 0.5 };
    assert!(wide.root().is_none() && (of(1.0) - wide).root().is_none());
    assert!(of(1.0).over(wide - wide).is_none());
    assert_eq!(Fine::UNIT.bounds(), [[0.0, 0.0], [1.0, 0.0]]);
}

/// Underflow loses a part of the product. [NEAR-5]
#[test]
fn a_product_that_underflows_is_not_exact() {
    let x = 1.0 + f64::EPSILON;
    for (exponent, is_exact) in [(0, true), (-440, true), (-460, false), (-510, false), (-530, false)] {
        let product = Fine::exact(x * power_of_two(exponent)) * Fine::exact(x * power_of_two(exponent));
        assert_eq!(product.is_exact(), is_exact, "{exponent}");
    }
}

/// Numbers at thresholds, up to 2^200: results without a radius are exact, and all others enclose the exact result.
/// [NEAR-5]
#[test]
fn thresholds_are_held() {
    let (mut draw, mut exactly) = (Draw::new(4), [0; 2]);
    for _ in 0..50_000 {
        let [DVec3 { x, y, z }] = vectors(&mut draw, power_of_two(200), Draw::threshold);
        let ([a, b, c], [x, y, z]) = ([x, y, z].map(Fine::exact), [x, y, z].map(exact));
        let (sum, product) = ((&x + &y, a + b), (&x * &y, a * b));
        let (part, whole) = ((&product.0 + &z, product.1 + c), (&sum.0 * &z - &product.0, sum.1 * c - product.1));
        for (number, found) in [&sum, &product, &part, &whole, &(&part.0 * &z, part.1 * c)] {
            assert!(holds(*found, number), "{a:?} {b:?} {c:?}: {found:?}");
            assert!(shared::holds(found.interval(), number), "{a:?} {b:?} {c:?}: {found:?}");
            assert!(
                found.sign().is_none_or(|sign| exact(sign).sign() == number.sign()),
                "{a:?} {b:?} {c:?}: {found:?}"
            );
            let [[lo, below], [hi, above]] = found.bounds();
            assert!(
                exact(lo) + exact(below) <= *number && *number <= exact(hi) + exact(above),
                "{a:?} {b:?} {c:?}: {found:?}"
            );
            exactly[usize::from(found.is_exact())] += 1;
        }
        if let Some(found) = part.1.over(whole.1) {
            assert!(holds(found, &(&part.0 / &whole.0)), "{a:?} {b:?} {c:?}: {found:?}");
        }
        if let Some(found) = part.1.root() {
            let [least, most] = found.bounds().map(|[end, rest]| exact(end) + exact(rest));
            assert!(&least * &least <= part.0 && part.0 <= &most * &most, "{a:?} {b:?} {c:?}: {found:?}");
        }
        assert!(holds(a.hull(b), &x) && holds(a.hull(b), &y), "{a:?} {b:?}");
    }
    assert!(exactly.into_iter().all(|seen| seen > 50_000), "{exactly:?}");
}

/// The remainder equals the original vector minus the reported multiples of the direction, despite all roundings.
/// [EXACT-12]
#[test]
fn ways_at_thresholds_are_shortened_by_what_is_told() {
    let (mut draw, mut seen) = (Draw::new(5), 0);
    for _ in 0..20_000 {
        let [way, d] = vectors(&mut draw, power_of_two(200), Draw::threshold);
        let (left, parts) = shortened(way.to_array().map(Fine::exact), d);
        let is_told = left.iter().all(|x| x.high.is_finite() && x.radius.is_finite());
        if !is_told || !parts.iter().all(|part| part.is_finite()) {
            continue;
        }
        seen += 1;
        for k in 0..3 {
            let expected = parts.iter().fold(exact(way[k]), |way, part| way - exact(*part) * exact(d[k]));
            assert!(holds(left[k], &expected), "{way} {d}: {left:?} {parts:?}");
        }
    }
    assert!(seen > 5000, "{seen}");
}

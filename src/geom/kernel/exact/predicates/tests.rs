use super::*;
use crate::generate::Rng;
use crate::generate::draw::Draw;
use crate::geom::tests::{exact, vectors};
use crate::geom::truth::RBig;

/// Returns the triangle as seen along each axis.
fn turned(corners: [DVec3; 3]) -> [[DVec3; 3]; 3] {
    [0, 1, 2].map(|turn| corners.map(|v| DVec3::from([0, 1, 2].map(|k| v[(k + turn) % 3]))))
}

/// The products are 1 + k ε and 1, and the bound of their difference is 4 ε of their sum.
#[test]
fn an_area_is_certain_beyond_four_roundings() {
    for (roundings, expected) in [(0.0, false), (8.0, false), (9.0, true), (1e9, true)] {
        let tip = DVec3::new(1.0, 1.0 + roundings * f64::EPSILON, 0.0);
        for corners in turned([DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), tip]) {
            assert_eq!(has_certain_area(&corners), expected, "{corners:?}");
            assert_eq!(is_degenerate(&corners), roundings == 0.0, "{corners:?}");
        }
    }
}

/// Triangles with a significant area need no exact sum.
#[test]
fn double_precision_is_certain_of_triangles_in_general_position() {
    let (mut random, mut asked) = (Rng::new(1), 0);
    let mut unit = || (random.bits() >> 11) as f64 / 2f64.powi(52) - 1.0;
    for exponent in [-200, -60, 0, 60, 200] {
        for _ in 0..1000 {
            let [a, b, c] = [(); 3].map(|()| DVec3::new(unit(), unit(), unit()));
            if (b - a).cross(c - a).length() > 1e-9 {
                for corners in [[a, b, c], [b, c, a], [c, b, a]] {
                    assert!(has_certain_area(&corners.map(|v| v * 2f64.powi(exponent))), "{corners:?}");
                }
                asked += 1;
            }
            // In a plane of two axes.
            let flat = [DVec3::ZERO, DVec3::new(unit(), 0.0, 0.0), DVec3::new(unit(), unit(), 0.0)];
            assert!(turned(flat).iter().all(has_certain_area), "{flat:?}");
        }
    }
    assert!(asked > 4990, "{asked}");
}

/// A line along a triangle of floats is parallel to it, and double-double arithmetic proves that.
#[test]
fn lines_along_a_triangle_are_parallel_without_exact_sums() {
    let mut random = Rng::new(3);
    let mut float =
        || f64::from(((random.bits() >> 40) as f32 / 2f32.powi(23) - 1.0) * 2f32.powi((random.bits() % 3) as i32));
    for _ in 0..1000 {
        let [a, b] = [(); 2].map(|()| DVec3::new(float(), float(), float()));
        let (i, j) = (float(), float());
        // Multiples of one edge are parallel to both edges.
        for c in [a + (b - a) * 0.5, a + (b - a) * 4.0] {
            assert!(is_parallel(&[a, b, c], DVec3::new(i, j, 1.0)), "{a} {b} {c}");
        }
        let c = DVec3::new(float(), float(), float());
        for (along, across) in [(b - a, (b - a).cross(c - a)), (c - b, DVec3::new(i, j, 1.0))] {
            assert!(is_parallel(&[a, b, c], along) && !is_parallel(&[a, b, c], across), "{a} {b} {c}");
        }
    }
}

/// Areas and volumes of numbers at thresholds have the signs of rational arithmetic. [EXACT-8]
#[test]
fn signs_are_true_at_thresholds() {
    let (mut draw, mut flat, mut zero) = (Draw::new(1), 0, 0);
    for round in 0..60_000 {
        let most = if round % 2 == 0 { f64::MAX } else { power_of_two(199) };
        let [a, b, c, d] = vectors(&mut draw, most, Draw::threshold);
        let [x, y, way] =
            [[a, b], [a, c], [DVec3::ZERO, d]].map(|[from, to]| [0, 1, 2].map(|k| exact(to[k]) - exact(from[k])));
        let cross = [[1, 2], [2, 0], [0, 1]].map(|[i, j]| &x[i] * &y[j] - &x[j] * &y[i]);
        let is_flat = cross.iter().all(RBig::is_zero);
        assert_eq!(is_degenerate(&[a, b, c]), is_flat, "{a} {b} {c}");
        let volume = (0..3).map(|k| &way[k] * &cross[k]).fold(RBig::ZERO, |sum, x| sum + x);
        let expected = volume.cmp(&RBig::ZERO);
        assert_eq!(sign(d, [a, b], [a, c], most < f64::MAX), expected, "{a} {b} {c} {d}");
        (flat, zero) = (flat + u32::from(is_flat), zero + u32::from(expected.is_eq()));
    }
    assert!(flat > 1000 && (5000..50_000).contains(&zero), "{flat} {zero}");
}

use fearless_simd::{dispatch, f32x8};

use super::super::tests::levels;
use super::*;
use crate::generate::{Rng, Source};
use crate::geom::Aabb;

#[inline(always)]
fn within<S: Simd>(simd: S, point: Vec3, planes: &[[[f32; 8]; 2]; 3], limit: f32) -> ([f32; 8], u32) {
    let (ranks, set) = BoxPoint::<S, f32x8<S>, 8>::new(simd, [point; 2]).within(planes, limit);
    (*ranks, set)
}

fn planes(boxes: &[Aabb; 8]) -> [[[f32; 8]; 2]; 3] {
    [0, 1, 2].map(|axis| [boxes.map(|aabb| aabb.lo[axis]), boxes.map(|aabb| aabb.hi[axis])])
}

/// Returns the distance in double precision, with an error of at most a few ulps.
fn distance(point: Vec3, aabb: &Aabb) -> f64 {
    let (point, lo, hi) = (point.as_dvec3(), aabb.lo.as_dvec3(), aabb.hi.as_dvec3());
    (lo - point).max(point - hi).max(glam::DVec3::ZERO).length()
}

/// [NEAR-4]
#[test]
fn ranks_are_just_below_the_distances_of_boxes() {
    let mut rng = Rng::new(7);
    let mut nearly = 0;
    for round in 0..20_000 {
        // Magnitudes from where squares underflow to where they overflow.
        let scale = f32::from_bits((1 + round % 254) << 23);
        let mut coordinate = || (rng.below(4001) as f32 / 2000.0 - 1.0) * scale;
        let mut corner = || Vec3::new(coordinate(), coordinate(), coordinate());
        let point = corner();
        let mut boxes = [(); 8].map(|()| {
            let (a, b) = (corner(), corner());
            Aabb { lo: a.min(b), hi: a.max(b) }
        });
        boxes[7] = Aabb { lo: Vec3::INFINITY, hi: Vec3::NEG_INFINITY };
        boxes[6] = Aabb { lo: Vec3::NEG_INFINITY, hi: Vec3::INFINITY };
        boxes[5] = Aabb { lo: point, hi: point };
        let (planes, limit) = (planes(&boxes), distance(point, &boxes[0]) as f32);
        let expected = dispatch!(levels()[0], simd => within(simd, point, &planes, limit));
        for level in levels() {
            let found = dispatch!(level, simd => within(simd, point, &planes, limit));
            assert_eq!((found.0.map(f32::to_bits), found.1), (expected.0.map(f32::to_bits), expected.1), "{level:?}");
        }
        let (ranks, set) = expected;
        let within = |limit: f32| dispatch!(levels()[0], simd => within(simd, point, &planes, limit)).1;
        assert_eq!(within(f32::INFINITY), 0x7f, "all but the empty one");
        assert_eq!(set >> 5 & 7, if limit >= 0.0 { 3 } else { 0 });
        for (lane, (rank, aabb)) in ranks.into_iter().zip(&boxes).enumerate().take(7) {
            assert_eq!(rank.to_bits() & 7, lane as u32);
            let (below, exact) = (f32::from_bits(rank.to_bits() & !7), distance(point, aabb));
            assert!(f64::from(below) <= exact, "{below:e} {exact:e}");
            assert_eq!(set >> lane & 1 == 1, below <= limit);
            assert_eq!(within(below) >> lane & 1, 1, "a limit as far as the rank, with the lane cleared");
            // For tiny vectors, the greatest component is used.
            assert!(exact == 0.0 || exact < 1e-43 || f64::from(below) > exact * 0.5, "{below:e} {exact:e}");
            let is_usual = (2e-36..f32::MAX.into()).contains(&exact);
            assert!(!is_usual || f64::from(below) > exact * (1.0 - 2e-6), "{below:e} {exact:e}");
            nearly += usize::from(is_usual);
        }
    }
    assert!(nearly > 10_000, "{nearly}");
}

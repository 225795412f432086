use fearless_simd::{Level, dispatch};

use super::*;
use glam::{DVec3, Vec3};

use crate::generate::{Rng, Source as _, stress};
use crate::geom::kernel::Exact;
use crate::geom::{Aabb, Kernel, Measure, Ray, Real as _, Region, Triangle};

/// Returns all supported levels of this machine, the scalar one first.
pub(super) fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let others = [
        best.as_sse2().map(Level::Sse2),
        best.as_sse4_2().map(Level::Sse4_2),
        best.as_avx2().map(Level::Avx2),
        best.as_avx512().map(Level::Avx512),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let others = [Some(best)];
    [Level::fallback()].into_iter().chain(others.into_iter().flatten()).collect()
}

#[test]
fn there_are_several_levels() {
    println!("{:?}", levels());
    assert!(levels().len() > 1);
}

#[inline(always)]
fn ask<S: Simd>(simd: S, ray: &Ray, region: &Region, blocks: &[Block], count: u32) -> (Nearest, Option<u32>) {
    let (filter, mut exact) = (TriangleRay::new(simd, ray, region), LazyExact::new(ray, region));
    let nearest = exact.nearest(simd, &filter, blocks, count, Nearest::none(ray));
    (nearest, exact.any(simd, &filter, blocks, count))
}

/// Leaves of one to twelve triangles have the hits of the exact test alone.
#[test]
fn leaves_have_the_nearest_hit() {
    for case in stress::cases(20) {
        let n = case.mesh.triangles().len();
        let region = Region::of(&Aabb::of(case.mesh.vertices()));
        for (i, ray) in case.rays.iter().enumerate() {
            let count = 1 + i % 12;
            let held: Vec<_> =
                (0..count).map(|k| (i + k * k) % n).map(|at| (Triangle(case.mesh.triangle(at)), at as u32)).collect();
            let mut blocks = vec![Block::EMPTY; count.div_ceil(4)];
            for (k, (triangle, prim)) in held.iter().enumerate() {
                blocks[k / 4].set(k % 4, triangle, *prim);
            }
            let exact = Exact::new(ray, &region);
            let hits = held.iter().filter_map(|held| Some((exact.distance(&held.0, f32::INFINITY)?, held)));
            let least = hits.min_by(|(t, a), (other, b)| {
                t.total_cmp(other).then_with(|| exact.compare(&a.0, &b.0)).then(a.1.cmp(&b.1))
            });
            let least = least.map(|(t, (_, prim))| (t, *prim));
            for level in levels() {
                let (nearest, any) = dispatch!(level, simd => ask(simd, ray, &region, &blocks, count as u32));
                assert_eq!(
                    nearest.is_some().then_some((nearest.t, nearest.prim)),
                    least,
                    "{} {i} {level:?}",
                    case.name
                );
                assert_eq!(any.is_some(), least.is_some(), "{} {i} {level:?}", case.name);
            }
        }
    }
}

/// No triangle at the limit is omitted, and half of the limit omits many. [NEAR-1]
fn lanes_at_the_limit_are_near<V: Precision>(exponents: std::ops::Range<i32>) {
    let mut rng = Rng::new(3);
    let [mut all, mut left_out] = [0, 0];
    for round in 0..40_000 {
        let scale = 2_f64.powi(exponents.start + round % (exponents.end - exponents.start));
        let mut vector = |size: f64| {
            let components = [(); 3].map(|()| (rng.below(2001) as f64 / 1000.0 - 1.0) * size);
            V::from_components(components.map(|x| V::Real::rounded(x * scale)))
        };
        let point = vector(1.0);
        let mut block = Block::<V>::EMPTY;
        // Half of the triangles are points, which are as far as their boxes.
        let triangles = [0.0, 0.1, 0.0, 1.0].map(|size| {
            let first = vector(1.0).widen();
            let mut corner = || (first + vector(size).widen()).to_array().map(V::Real::rounded);
            Triangle([corner(), corner(), corner()].map(V::from_components))
        });
        triangles.iter().zip(0..).for_each(|(triangle, lane)| block.set(lane, triangle, lane as u32));
        let measure = Measure::new(point, V::Real::INFINITY);
        for (lane, triangle) in triangles.iter().enumerate() {
            let Some(distance) = measure.distance(triangle, V::Real::INFINITY) else { continue };
            let half = V::Real::rounded(distance.into() * 0.5);
            for level in levels() {
                let [at, below] =
                    [distance, half].map(|limit| dispatch!(level, simd => block.near(simd, point, limit)));
                assert_eq!(at >> lane & 1, 1, "{level:?} {point:?} {triangle:?} {distance:?}");
                (all, left_out) = (all + 1, left_out + (below >> lane & 1 ^ 1));
            }
        }
    }
    println!("{left_out} of {all} left out");
    // Limits below 2^-50, and those whose squares overflow, leave out none.
    assert!(left_out > all / 20);
}

#[test]
fn lanes_at_the_limit_are_near_in_single_precision() {
    lanes_at_the_limit_are_near::<Vec3>(-120..120);
}

#[test]
fn lanes_at_the_limit_are_near_in_double_precision() {
    lanes_at_the_limit_are_near::<DVec3>(-1000..1000);
}

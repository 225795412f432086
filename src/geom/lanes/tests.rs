use fearless_simd::{Level, dispatch};

use super::*;
use crate::generate::stress;
use crate::geom::kernel::Exact;
use crate::geom::{Aabb, Kernel, Ray, Region, Triangle};

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

use fearless_simd::dispatch;

use super::*;
use crate::generate::{double, stress};
use crate::geom::lanes::tests::levels;
use crate::geom::lanes::{Level, Precision as _};
use crate::geom::tests::exact;
use crate::geom::truth;
use crate::geom::{Frame, Mesh};

/// The lanes of a block that are left at a level, those that are certain, and the bits of the bounds.
#[inline(always)]
fn told<S: Simd>(simd: S, ray: &TriangleRay<S, DVec3>, block: &Block<DVec3>, best: f64) -> (u32, u32, [[u64; 4]; 2]) {
    let found = ray.found(simd, block);
    let (certain, ends) = ray.certain(simd, block, &found);
    // Of other lanes they mean nothing.
    let bits = |lane: usize, end: f64| if certain >> lane & 1 == 1 { end.to_bits() } else { 0 };
    let ends = ends.map(|ends| [0, 1, 2, 3].map(|lane| bits(lane, ends[lane])));
    (ray.left(simd, block, best, &found), certain, ends)
}

fn region(frame: &Frame, triangles: &[Triangle<DVec3>]) -> Region {
    let around = triangles.iter().map(|triangle| frame.aabb(triangle)).reduce(crate::geom::Aabb::union);
    Region::within(*frame, &around.expect("a triangle"))
}

/// Scenes in places that single precision cannot hold, with rays at what is hard to hit.
fn scenes(rays: usize) -> impl Iterator<Item = (Mesh<DVec3>, Vec<Ray<DVec3>>)> {
    stress::cases(rays).enumerate().filter_map(move |(i, case)| {
        let place = double::PLACES[i % double::PLACES.len()];
        let mesh = place.mesh(&case.mesh).ok()?;
        let mut aimed = double::aimed(&mesh, i as u64, rays);
        aimed.extend(case.rays.iter().filter_map(|ray| place.ray(ray)));
        Some((mesh, aimed))
    })
}

/// [LANES-3] [LANES-4] [LANES-5] [LANES-6]
#[test]
fn what_is_told_of_four_triangles_is_true() {
    let (mut rejected, mut certain_hits, mut enclosed) = (0, 0, 0);
    for (mesh, rays) in scenes(40) {
        let n = mesh.triangles().len();
        for (i, ray) in rays.iter().enumerate() {
            let triangles = [0, 1, 2, 3].map(|k| Triangle(mesh.triangle((i + k * k * 7) % n)));
            let region = region(mesh.frame(), &triangles);
            let mut block = Block::EMPTY;
            triangles.iter().enumerate().for_each(|(lane, triangle)| block.set(lane, triangle, lane as u32));
            let hits = triangles.map(|Triangle(corners)| {
                let meeting =
                    truth::meet(corners.map(|v| v.to_array()), ray.origin().to_array(), ray.direction().to_array());
                meeting.within([f64::MIN, f64::MAX]).map(|point| point.t)
            });
            let of_hits = hits.iter().flatten().map(truth::round_f64).flat_map(|t| [t, t.next_down(), t.next_up()]);
            for best in of_hits.chain([0.0, f64::INFINITY]).filter(|best| *best >= 0.0) {
                let mut answers = levels().into_iter().map(|level| {
                    dispatch!(level, simd => told(simd, &TriangleRay::double(simd, ray, &region), &block, best))
                });
                let (left, certain, ends) = answers.next().expect("a level");
                assert!(answers.all(|answer| answer == (left, certain, ends)), "{ray:?} {triangles:?} {best}");
                for (lane, t) in hits.iter().enumerate() {
                    let is_left = left >> lane & 1 == 1;
                    rejected += u32::from(!is_left);
                    let is_near = |t: &truth::RBig| *t >= truth::RBig::ZERO && truth::round_f64(t) <= best;
                    assert!(is_left || !t.as_ref().is_some_and(is_near), "{ray:?} {:?} {best}", triangles[lane]);
                    if certain >> lane & 1 == 1 {
                        let [lo, hi] = ends.map(|ends| f64::from_bits(ends[lane]));
                        let t = t.as_ref().expect("a certain hit is one");
                        assert!(exact(lo) <= *t && *t <= exact(hi), "{ray:?} {:?} {lo} {hi}", triangles[lane]);
                        certain_hits += 1;
                    }
                }
                // The ray is within bounds that hold it: nothing of it is rejected either.
                let wide = |x: f64, by: f64| Interval::between([x - by, x + by * 0.5]);
                let by = ray.direction().abs().max_element() * power_of_two(-20 - (i % 30) as i32);
                let off = region.size() * power_of_two(-20 - (i % 23) as i32);
                let bounds = EnclosedRay::new(
                    ray.origin().to_array().map(|x| wide(x, off)),
                    ray.direction().to_array().map(|x| wide(x, by)),
                );
                let left = dispatch!(Level::new(), simd => DVec3::enclosed(simd, &bounds, &region).survivors(simd, &block, best));
                for (lane, t) in hits.iter().enumerate() {
                    let is_near = |t: &truth::RBig| *t >= truth::RBig::ZERO && truth::round_f64(t) <= best;
                    let is_left = left >> lane & 1 == 1;
                    enclosed += u32::from(!is_left);
                    assert!(is_left || !t.as_ref().is_some_and(is_near), "{bounds:?} {:?} {best}", triangles[lane]);
                }
            }
        }
    }
    assert!(rejected > 10_000 && certain_hits > 10_000 && enclosed > 5_000, "{rejected} {certain_hits} {enclosed}");
}

#[inline(always)]
fn ask<S: Simd>(
    simd: S,
    ray: &Ray<DVec3>,
    region: &Region,
    blocks: &[Block<DVec3>],
    count: u32,
) -> (Option<(u32, f64)>, Option<u32>) {
    let mut hits = <LazyExact64<'_> as Hits<'_, DVec3>>::new(ray, region);
    let (filter, none) = (hits.filter(simd), hits.none());
    let nearest = hits.nearest(simd, &filter, blocks, count, none);
    let found = LazyExact64::prim(&nearest).map(|prim| (prim, hits.distance(simd, &nearest)));
    let whole = hits.whole::<S, false>(simd, &nearest);
    assert_eq!(found.map(|(_, t)| t), whole.map(|(t, _)| t).filter(|_| found.is_some()));
    (found, hits.any(simd, &filter, blocks, count).map(|hit| hit.prim))
}

/// Leaves of one to twelve triangles have the first hit of rational arithmetic, whatever is equal or nearly so. [LANES-7]
#[test]
fn leaves_have_the_nearest_hit() {
    let mut found = 0;
    for (mesh, rays) in scenes(30) {
        let n = mesh.triangles().len();
        for (i, ray) in rays.iter().enumerate() {
            let held: Vec<_> = (0..=i % 12).map(|k| (i + k * k) % n).collect();
            let triangles: Vec<_> = held.iter().map(|&at| Triangle(mesh.triangle(at))).collect();
            let region = region(mesh.frame(), &triangles);
            let mut blocks = vec![Block::EMPTY; held.len().div_ceil(4)];
            for (k, (triangle, &at)) in triangles.iter().zip(&held).enumerate() {
                // Some have the same corners and other numbers.
                blocks[k / 4].set(k % 4, triangle, (at ^ (k * 64)) as u32);
            }
            let hits = triangles.iter().zip(&held).enumerate().filter_map(|(k, (Triangle(corners), &at))| {
                let corners = corners.map(|v| v.to_array());
                let meeting = truth::meet(corners, ray.origin().to_array(), ray.direction().to_array());
                Some((meeting.within([ray.tmin(), ray.tmax()])?.t, (at ^ (k * 64)) as u32))
            });
            let first = hits.min().map(|(t, prim)| (prim, truth::round_f64(&t)));
            found += u32::from(first.is_some());
            for level in levels() {
                let (nearest, any) = dispatch!(level, simd => ask(simd, ray, &region, &blocks, held.len() as u32));
                assert_eq!(nearest, first, "{level:?} {ray:?} {triangles:?}");
                assert_eq!(any.is_some(), first.is_some(), "{level:?} {ray:?} {triangles:?}");
            }
        }
    }
    assert!(found > 1_000, "{found}");
}

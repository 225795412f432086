use fearless_simd::{Fallback, Level, dispatch};
use glam::Vec3;

use super::*;
use crate::generate::draw::Draw;
use crate::generate::stress;
use crate::geom::kernel::{Exact, Filter as _};
use crate::geom::lanes::TriangleFilter;
use crate::geom::lanes::tests::levels;
use crate::geom::{Aabb, Kernel, Triangle, truth};

fn block_of(triangles: &[Triangle; 4]) -> Block {
    let mut block = Block::EMPTY;
    for (lane, triangle) in triangles.iter().enumerate() {
        block.set(lane, triangle, lane as u32);
    }
    block
}

#[inline(always)]
fn survivors<S: Simd>(simd: S, ray: &Ray, region: &Region, block: &Block, best: f32, constants: [f32; 3]) -> u32 {
    TriangleRay::with_constants(simd, [ray.origin(), ray.direction()], region, constants).survivors(simd, block, best)
}

fn survive(level: Level, ray: &Ray, region: &Region, block: &Block, best: f32, constants: [f32; 3]) -> u32 {
    dispatch!(level, simd => survivors(simd, ray, region, block, best, constants))
}

/// Counts of the outcomes for triangles.
#[derive(Debug, Default)]
struct Counts {
    rejected: u32,
    left: u32,
    wrong: u32,
}

/// Checks that all levels reject equal sets, and that no rejected triangle is hit in exact arithmetic at `best` or
/// before, for these constants.
fn check(ray: &Ray, region: &Region, triangles: &[Triangle; 4], best: f32, constants: [f32; 3], counts: &mut Counts) {
    let block = block_of(triangles);
    let mut sets = levels().into_iter().map(|level| survive(level, ray, region, &block, best, constants));
    let left = sets.next().expect("a level");
    assert!(sets.all(|set| set == left), "{ray:?} {triangles:?} {best}");
    if constants == CONSTANTS {
        let filter = TriangleFilter::new(ray, region);
        assert_eq!(filter.survivors(triangles.each_ref(), best), left, "{ray:?} {triangles:?} {best}");
    }
    let exact = Exact::new(ray, region);
    for (lane, triangle) in triangles.iter().enumerate() {
        if left >> lane & 1 == 1 {
            counts.left += 1;
            continue;
        }
        counts.rejected += 1;
        counts.wrong += u32::from(exact.distance(triangle, f32::INFINITY).is_some_and(|t| t <= best));
        if counts.rejected.is_multiple_of(32) && constants == CONSTANTS {
            let corners = triangle.0.map(|corner| corner.to_array());
            let meeting = truth::meet(corners, ray.origin().to_array(), ray.direction().to_array());
            let hit = meeting.within([ray.tmin(), ray.tmax()]);
            assert!(hit.is_none_or(|hit| truth::round_f32(&hit.t) > best), "{ray:?} {triangle:?} {best}");
        }
    }
}

/// On all levels, with zeros of either sign.
#[test]
fn four_triangles_at_once_are_those_of_the_lanes() {
    let mut triangles = 0;
    for case in stress::cases(24) {
        let n = case.mesh.triangles().len();
        for i in 0..n.min(200) {
            let four = [0, 1, 2, 3]
                .map(|k| Triangle(case.mesh.triangle((i + k) % n).map(|corner| corner * [1.0, -1.0][k & 1])));
            let expected = Block { prims: [Block::NONE; 4], ..block_of(&four) };
            for level in levels() {
                let block = dispatch!(level, simd => Block::of(simd, four.each_ref()));
                assert_eq!(format!("{block:?}"), format!("{expected:?}"), "{level:?}");
            }
            triangles += 4;
        }
    }
    assert!(triangles > 1000, "{triangles}");
}

/// Checks the triangles of all stress cases, with ends at their hits and next to them. The scene is that of the four
/// triangles alone or of the case.
fn all_cases(constants: [f32; 3]) -> Counts {
    let mut counts = Counts::default();
    for case in stress::cases(24) {
        let n = case.mesh.triangles().len();
        let whole = Region::of(&Aabb::of(case.mesh.vertices()));
        for (i, ray) in case.rays.iter().enumerate() {
            let triangles = [0, 1, 7, 31].map(|k| Triangle(case.mesh.triangle((i + k) % n)));
            let own = Region::of(&triangles.iter().fold(Aabb::EMPTY, |aabb, t| aabb.union(t.aabb())));
            let exact = Exact::new(ray, &whole);
            let hits = triangles.iter().filter_map(|triangle| exact.distance(triangle, f32::INFINITY));
            let ends = hits.flat_map(|t| [t.next_down().max(0.0), t, t.next_up()]).chain([ray.tmax()]);
            for (best, region) in ends.flat_map(|best| [(best, own), (best, whole)]) {
                check(ray, &region, &triangles, best, constants, &mut counts);
            }
        }
    }
    counts
}

/// The bounds are as wide as derived, and no term is below its minimum. [LANES-3] [LANES-4]
#[test]
fn bounds_are_those_derived() {
    let power = |exponent: i32| 2f32.powi(exponent);
    for [d, far, reach] in [[3.0, 5.0, 7.0], [0.5, 9.0, 0.25], [1.0, power(-60), power(-50)], [1.0, 0.0, power(-41)]] {
        let region = Region::of(&Aabb { lo: Vec3::splat(-reach), hi: Vec3::ZERO });
        let ray = Ray::new(Vec3::X * far, Vec3::Y * d).expect("a ray");
        let bounds = TriangleRay::new(Fallback::new(), &ray, &region);
        let found = [bounds.edge, bounds.det, bounds.t, bounds.twice_c].map(<[f32; 4]>::from);
        let c = (far + reach).max(power(-40));
        assert_eq!(
            found,
            [39.0 * UNIT * d, 40.0 * UNIT * d, 44.0 * UNIT * c, 2.0 * c].map(|x| [x; 4]),
            "{d} {far} {reach}"
        );
    }
    let tiny = Triangle([Vec3::ZERO, Vec3::X * power(-41), Vec3::Y * power(-50)]);
    let block = dispatch!(levels()[0], simd => Block::of(simd, [&tiny; 4]));
    assert_eq!([block.edges, block_of(&[tiny; 4]).edges], [[power(-40); 4]; 2]);
}

/// Single precision is used, and rejects triangles far from a ray, exactly where it can neither overflow nor underflow.
/// [LANES-3] [LANES-5]
#[test]
fn single_precision_is_asked_within_its_range() {
    let block = block_of(&[Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]); 4]);
    let region = |reach: f32| Region::of(&Aabb { lo: Vec3::splat(-reach), hi: Vec3::ONE });
    let rejects = |[far, reach, d]: [f32; 3]| {
        let ray = Ray::new(Vec3::new(-far, far, -1.0), Vec3::Z * d).expect("a ray");
        survive(levels()[0], &ray, &region(reach), &block, f32::INFINITY, CONSTANTS) == 0
    };
    let [few, many, most] = [-20, 20, 40].map(|exponent| 2f32.powi(exponent));
    for usual in [[9.0, 1.0, few], [9.0, 1.0, many], [most, 1.0, 1.0], [most, most, 1.0]] {
        assert!(rejects(usual), "{usual:?}");
    }
    let [few, many, beyond] = [few.next_down(), many.next_up(), most.next_up()];
    for unusual in [[9.0, 1.0, few], [9.0, 1.0, many], [beyond, 1.0, 1.0], [most, beyond, 1.0]] {
        assert!(!rejects(unusual), "{unusual:?}");
    }
    // A direction within bounds of 2^-10 of it.
    for (off, expected) in [(f64::powi(2.0, -10) * 0.999, 0), (f64::powi(2.0, -10) * 1.001, 15)] {
        let [origin, mut direction] = [[-9.0, 9.0, -1.0], [0.0, 0.0, 1.0]].map(|v| v.map(Interval::exact));
        direction[1] = Interval::between([-off, off]);
        let (ray, off) = (EnclosedRay::new(origin, direction), [OFF_EDGE, OFF_REACH, OFF]);
        let left = dispatch!(levels()[0], simd => survivors_of(simd, &ray, &region(1.0), &block, f32::INFINITY, off));
        assert_eq!(left, expected);
    }
}

#[test]
fn no_hit_is_rejected() {
    let counts = all_cases(CONSTANTS);
    println!("{counts:?}");
    assert!(counts.wrong == 0 && counts.rejected > counts.left / 3, "{counts:?}");
}

/// No such case is known for the determinant's bound alone: a scene that contains the triangle makes the other bound
/// large.
#[test]
fn without_a_bound_hits_are_rejected() {
    let [edge, det, t] = CONSTANTS;
    for constants in [[0.0, det, t], [edge, 0.0, 0.0], [edge, det, 0.0]] {
        let counts = all_cases(constants);
        println!("{constants:?} {counts:?}");
        assert!(counts.wrong > 0, "{constants:?} {counts:?}");
    }
}

/// Draws bounds that enclose a ray: of widths from 2^-44 to 2^-10 of the greatest component, extending in one direction
/// or two.
fn bounds_of(ray: &Ray, draw: &mut Draw) -> EnclosedRay {
    let exponents = [44, 30, 26, 22, 18, 14, 11];
    let mut around = |v: Vec3| {
        let size = f64::from(v.abs().max_element()) * f64::powi(2.0, -exponents[draw.below(exponents.len())]);
        v.to_array().map(|x| {
            let [below, above] = [[0.0, size], [size, 0.0], [size / 2.0, size / 2.0], [0.0; 2]][draw.below(4)];
            Interval::between([f64::from(x) - below, f64::from(x) + above])
        })
    };
    EnclosedRay::new(around(ray.origin()), around(ray.direction()))
}

#[inline(always)]
fn survivors_of<S: Simd>(simd: S, ray: &EnclosedRay, scene: &Region, block: &Block, best: f32, off: [f32; 3]) -> u32 {
    TriangleRay::enclosed_with(simd, ray, scene, off).survivors(simd, block, best)
}

/// Like [`all_cases`], for bounds that enclose the ray, and these constants of `[LANES-5]`. The ray must not hit a
/// rejected triangle.
fn all_cases_within(off: [f32; 3]) -> Counts {
    let (mut counts, mut draw) = (Counts::default(), Draw::new(5));
    for case in stress::cases(24) {
        let n = case.mesh.triangles().len();
        let scene = Region::of(&Aabb::of(case.mesh.vertices()));
        for (i, ray) in case.rays.iter().enumerate() {
            let (triangles, exact) =
                ([0, 1, 7, 31].map(|k| Triangle(case.mesh.triangle((i + k) % n))), Exact::new(ray, &scene));
            let hits = triangles.map(|triangle| exact.distance(&triangle, f32::INFINITY));
            let own = Region::of(&triangles.iter().fold(Aabb::EMPTY, |aabb, t| aabb.union(t.aabb())));
            for best in hits.iter().flatten().copied().chain([ray.tmax()]) {
                let (ray, block) = (bounds_of(ray, &mut draw), block_of(&triangles));
                let mut sets = levels()
                    .into_iter()
                    .map(|level| dispatch!(level, simd => survivors_of(simd, &ray, &own, &block, best, off)));
                let left = sets.next().expect("a level");
                assert!(sets.all(|set| set == left), "{ray:?} {triangles:?} {best}");
                counts.left += left.count_ones();
                counts.rejected += 4 - left.count_ones();
                let wrong = (0..4).filter(|lane| left >> lane & 1 == 0 && hits[*lane].is_some_and(|t| t <= best));
                counts.wrong += wrong.count() as u32;
            }
        }
    }
    counts
}

/// Numbers within the bounds differ from the floats by at most the reported offset. Rational arithmetic checks the
/// ends. For bounds of zero width the offset is only the rounding error. [LANES-5]
#[test]
fn a_ray_within_bounds_is_off_by_its_radius_and_by_what_is_rounded() {
    let (mut draw, mut alone) = (Draw::new(9), 0);
    for _ in 0..4000 {
        let bounds = [(); 3].map(|()| {
            let middle = f64::from(draw.centred().x) * (1.0 + f64::from(draw.centred().y) * f64::powi(2.0, -26));
            let radius = [0.0, 0.0, f64::powi(2.0, -(draw.below(60) as i32))][draw.below(3)];
            Interval::between([middle - radius, middle + radius])
        });
        let (floats, off) = nearest(&bounds);
        let exact = |x: f64| truth::RBig::try_from(x).expect("finite");
        let mut farthest = exact(0.0);
        for (bounds, x) in bounds.iter().zip(floats.to_array()) {
            for end in bounds.ends() {
                let apart = exact(end) - exact(x.into());
                farthest = farthest.max(if apart < exact(0.0) { -apart } else { apart });
            }
        }
        // The sum of radius and rounding is itself rounded.
        let off = f64::from(off);
        assert!(farthest <= exact(off) * exact(1.0 + f64::EPSILON), "{bounds:?}: {floats} {off}");
        let is_alone = bounds.iter().all(Interval::is_exact);
        assert!(
            !is_alone || farthest >= exact(off) * exact(1.0 - f64::from(f32::EPSILON)),
            "{bounds:?}: {floats} {off}"
        );
        alone += usize::from(is_alone && off > 0.0);
    }
    assert!(alone > 500, "{alone}");
}

/// [LANES-5]
#[test]
fn no_hit_of_a_ray_within_bounds_is_rejected() {
    let counts = all_cases_within([OFF_EDGE, OFF_REACH, OFF]);
    println!("{counts:?}");
    assert!(counts.wrong == 0 && counts.rejected > counts.left / 3, "{counts:?}");
}

/// [LANES-5]
#[test]
fn without_what_the_ray_is_off_by_hits_are_rejected() {
    for off in [[0.0, OFF_REACH, OFF], [OFF_EDGE, 0.0, OFF], [OFF_EDGE, OFF_REACH, 0.0]] {
        let counts = all_cases_within(off);
        println!("{off:?} {counts:?}");
        assert!(counts.wrong > 0, "{off:?} {counts:?}");
    }
}

/// A ray (direction, origin) and a triangle, found by hill climbing, whose errors reach 0.44 of the bound of `[LANES-4]`.
const HARD: [[u32; 3]; 5] = [
    [0xbf90_3d6e, 0x3f97_be5a, 0x3f92_8989],
    [0x3f7c_782c, 0x3f7f_00bb, 0xbf80_2000],
    [0, 0xbc52_616b, 0x3c04_a4c0],
    [0xbf80_0b00, 0x3f7f_e3ce, 0xbf81_a24d],
    [0x3f7e_b206, 0x3f80_7a3a, 0xbf7f_849e],
];

/// Half of the bound comes from using the scene instead of the triangle, so a fifth of the constants is too small.
#[test]
fn errors_come_near_the_bound() {
    let [d, o, corners @ ..] = HARD.map(|v| Vec3::from_array(v.map(f32::from_bits)));
    let (ray, triangle) = (Ray::new(o, d).expect("a ray"), Triangle(corners));
    assert!(share(&ray, &triangle).is_some_and(|share| share > 0.44));
    let region = Region::of(&triangle.aabb());
    let best = Exact::new(&ray, &region).distance(&triangle, f32::INFINITY).expect("a hit");
    let (mut as_is, mut less) = (Counts::default(), Counts::default());
    check(&ray, &region, &[triangle; 4], best, CONSTANTS, &mut as_is);
    check(&ray, &region, &[triangle; 4], best, [CONSTANTS[0], CONSTANTS[1] / 5.0, CONSTANTS[2] / 5.0], &mut less);
    assert_eq!((as_is.wrong, less.wrong), (0, 4));
}

/// Returns the error of a hit as a fraction of the bound of `[LANES-4]`, if the best distance is its own.
fn share(ray: &Ray, triangle: &Triangle) -> Option<f64> {
    let region = Region::of(&triangle.aabb());
    let best = Exact::new(ray, &region).distance(triangle, f32::INFINITY)?;
    let ([v0, v1, v2], o, d) = (triangle.0, ray.origin(), ray.direction());
    let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);
    let cross = |a: Vec3, b: Vec3| Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    let dot = |a: Vec3, b: Vec3| (a.x * b.x + a.y * b.y) + a.z * b.z;
    let (det, t) = (dot(e1, cross(d, e2)), dot(e2, cross(s, e1)));
    let excess = f64::from(t * det.signum()) - f64::from(det.abs()) * f64::from(best);
    let [c, e] = [s.abs().max_element(), e1.abs().max(e2.abs()).max_element()].map(f64::from);
    let unit = f64::from(UNIT) * e * e;
    let bound = f64::from(DISTANCE) * c + f64::from(best) * f64::from(DETERMINANT) * f64::from(d.abs().max_element());
    Some(excess / (unit * bound))
}

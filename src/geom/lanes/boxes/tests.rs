use fearless_simd::{dispatch, f32x4, f32x8};

use super::*;
use crate::generate::draw::{Draw, one_of};
use crate::generate::stress;
use crate::geom::lanes::tests::levels;
use crate::geom::slabs::{Directed, Slabs};
use crate::geom::{Aabb, truth};
use crate::wide::is_beyond;

type Planes<const A: usize> = [[[f32; A]; 2]; 3];

fn planes<const A: usize>(boxes: &[Aabb; A]) -> Planes<A> {
    std::array::from_fn(|axis| [boxes.map(|aabb| aabb.lo[axis]), boxes.map(|aabb| aabb.hi[axis])])
}

/// Implements the clause, lane by lane. `[LANES-1]` `[LANES-2]`
fn by_definition<const A: usize>(ray: &Ray, boxes: &[Aabb; A], end: f32) -> ([u32; A], u32) {
    let mut set = 0;
    let ranks = std::array::from_fn(|lane| {
        let (mut near, mut far) = (ray.tmin(), end);
        for axis in 0..3 {
            let (o, d) = (ray.origin()[axis], ray.direction()[axis]);
            let i = d.abs().recip();
            let (down, up) = (i.next_down().next_down(), i.next_up().next_up());
            let (lo, hi) = (boxes[lane].lo[axis], boxes[lane].hi[axis]);
            let (first, last) =
                if d < 0.0 { ((hi - o) * -down, (lo - o) * -up) } else { ((lo - o) * down, (hi - o) * up) };
            near = near.max(first);
            far = if last < far { last } else { far };
        }
        let cleared = near.abs().min(f32::MAX).to_bits() / A as u32 * A as u32;
        set |= u32::from(f32::from_bits(cleared) <= far) << lane;
        cleared + lane as u32
    });
    (ranks, set)
}

#[inline(always)]
fn enter<S: Simd, V: Lanes<S, A>, const A: usize>(
    simd: S,
    ray: &Ray,
    region: &Region,
    boxes: &[Aabb; A],
    end: f32,
) -> ([u32; A], u32) {
    let prepared = BoxRay::<S, V, A>::new(simd, ray, region);
    let (ranks, set) = prepared.enter(&planes(boxes), end);
    (ranks.as_array().map(f32::to_bits), set)
}

/// Checks that all levels agree, and returns their answer.
fn entered<const A: usize>(ray: &Ray, region: &Region, boxes: &[Aabb; A], end: f32) -> ([u32; A], u32) {
    let mut results = levels().into_iter().map(|level| {
        let mut out = ([0; A], 0);
        if A == 8 {
            let boxes: &[Aabb; 8] = boxes[..].try_into().expect("eight");
            let (ranks, set) = dispatch!(level, simd => enter::<_, f32x8<_>, 8>(simd, ray, region, boxes, end));
            out = (ranks[..].try_into().expect("eight"), set);
        } else {
            let boxes: &[Aabb; 4] = boxes[..].try_into().expect("four");
            let (ranks, set) = dispatch!(level, simd => enter::<_, f32x4<_>, 4>(simd, ray, region, boxes, end));
            out.0.copy_from_slice(&ranks);
            out.1 = set;
        }
        out
    });
    let first = results.next().expect("a level");
    assert!(results.all(|result| result == first), "{ray:?} {boxes:?} {end}");
    first
}

fn region_of(boxes: &[Aabb]) -> Region {
    Region::of(
        &boxes
            .iter()
            .copied()
            .filter(|aabb| *aabb != Aabb::EMPTY)
            .fold(Aabb { lo: Vec3::ZERO, hi: Vec3::ZERO }, Aabb::union),
    )
}

/// Checks the invariants of every test.
fn check<const A: usize>(ray: &Ray, boxes: &[Aabb; A], end: f32) {
    let region = region_of(boxes);
    let (ranks, set) = entered(ray, &region, boxes, end);
    let direction = (ray.direction() + Vec3::ZERO).extend(0.0);
    let is_rare = is_beyond_single(ray.origin().extend(0.0), direction, direction.recip(), &region);
    if !is_rare {
        assert_eq!((ranks, set), by_definition(ray, boxes, end), "{ray:?} {boxes:?} {end}");
    }
    let directed = Directed::new(ray, &region);
    for (lane, aabb) in boxes.iter().enumerate() {
        let (rank, is_met) = (ranks[lane], set >> lane & 1 == 1);
        assert_eq!(rank as usize % A, lane);
        let cleared = f32::from_bits(rank - lane as u32);
        if *aabb == Aabb::EMPTY {
            assert!(!is_met);
            continue;
        }
        if let Some(near) = directed.one(aabb, end) {
            assert!(is_met && cleared <= near, "{ray:?} {aabb:?} {end}");
        }
        let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
        if let Some(t) = truth::entry(o, d, [ray.tmin(), end], lo, hi) {
            assert!(is_met && cleared <= truth::round_f32(&t), "{ray:?} {aabb:?} {end}");
        }
    }
    // Exactly the boxes beyond the other end are skipped.
    let (_, without_end) = entered(ray, &region, boxes, f32::INFINITY);
    // The end -0 has become 0.
    let end_bits = (end + 0.0).to_bits();
    let beyond = (0..A).fold(0, |set, lane| set | u32::from(is_beyond::<A>(ranks[lane], end_bits)) << lane);
    assert_eq!(set, without_end & !beyond, "{ray:?} {end}");
}

/// Numbers that combine to zeros, infinities and NaNs.
const EDGES: [f32; 12] = [0.0, -0.0, 1.0, -1.0, 2.0, 0.5, 1e-45, -1e-45, f32::MIN_POSITIVE, 1e38, -1e38, 3.0];

fn edges(draw: &mut Draw) -> Vec3 {
    Vec3::from([(); 3].map(|()| one_of(EDGES, draw)))
}

#[test]
fn numbers_at_the_edges_are_tested_alike_on_all_levels() {
    let (mut draw, mut seen) = (Draw::new(1), 0);
    while seen < 6000 {
        let direction = edges(&mut draw) * one_of([1.0, 3.0, f32::MAX], &mut draw);
        let tmin = one_of([0.0, -0.0, 1e-45, 0.5, 1.0], &mut draw);
        let Ok(ray) = Ray::within(edges(&mut draw), direction, tmin, f32::INFINITY) else { continue };
        let mut one = || {
            let (a, b) = (edges(&mut draw), edges(&mut draw));
            if draw.one_in(6) { Aabb::EMPTY } else { Aabb { lo: a.min(b), hi: a.max(b) } }
        };
        let (eight, four) = ([(); 8].map(|()| one()), [(); 4].map(|()| one()));
        let end = one_of([tmin, 0.75, 1.0, 2.0, f32::MAX, f32::INFINITY], &mut draw);
        if end >= tmin {
            check(&ray, &eight, end);
            check(&ray, &four, end);
            seen += 1;
        }
    }
}

#[test]
fn no_box_that_is_touched_is_left_out() {
    for case in stress::cases(12) {
        let n = case.mesh.triangles().len();
        let aabb = |i: usize| Aabb::of(&case.mesh.triangle(i % n));
        for (i, ray) in case.rays.iter().enumerate() {
            let boxes: [Aabb; 8] = std::array::from_fn(|k| aabb(i + 3 * k));
            let near = entered(ray, &region_of(&boxes), &boxes, f32::INFINITY).0[0] & !7;
            let ends = [ray.tmax(), f32::from_bits(near), f32::from_bits(near).next_down()];
            for end in ends.into_iter().filter(|end| *end >= ray.tmin()) {
                check(ray, &boxes, end);
                check(ray, &[0, 1, 2, 3].map(|k| boxes[k]), end);
            }
        }
    }
}

/// A box that a single step of the reciprocal would lose: the ranks are rounded down, but the far planes are not.
#[test]
fn a_box_at_an_edge_is_met() {
    let ray = Ray::new(Vec3::ZERO, Vec3::new(1.0, 41.0, 0.0)).expect("a ray");
    let aabb = Aabb { lo: Vec3::new(1.0, 40.0, 0.0), hi: Vec3::new(2.0, 41.0, 1.0) };
    check(&ray, &[aabb; 8], 1.0);
    let (ranks, set) = entered(&ray, &Region::of(&aabb), &[aabb; 8], 1.0);
    assert_eq!((ranks[3], set), (0x3f7f_fff8 + 3, 255));
}

/// A ray that leaves the plane of flat boxes, even slowly, is soon above them. [BOX-9]
#[test]
fn a_slow_component_takes_a_ray_out_of_a_plane() {
    let boxes: [Aabb; 8] = std::array::from_fn(|i| {
        let lo = Vec3::new(i as f32, 0.0, 1.0);
        Aabb { lo, hi: lo + Vec3::new(1.0, 1.0, 0.0) }
    });
    for (slow, expected) in [(0.0, 255), (1e-45, 1), (-1e-45, 1), (1e-38, 1)] {
        let ray = Ray::new(Vec3::new(0.5, 0.5, 1.0), Vec3::new(64.0, 0.0, slow)).expect("a ray");
        let (_, set) = entered(&ray, &region_of(&boxes), &boxes, f32::INFINITY);
        assert_eq!(set, expected, "{slow}");
    }
}

/// Rays from so far away that they are tested from their entry, at corners and next to them. [BOX-9]
#[test]
fn from_afar_no_box_that_is_touched_is_left_out() {
    let (mut draw, mut rare, mut touched) = (Draw::new(4), 0, 0);
    while rare < 4000 {
        let mut one = || Aabb::of(&[draw.ints(3), draw.ints(3)]);
        let boxes = [(); 8].map(|()| one());
        let (d, aabb) = (draw.ints(3), boxes[draw.below(8)]);
        let target = one_of([aabb.lo, aabb.hi, aabb.lo.with_x(aabb.hi.x), aabb.lo * 0.5 + aabb.hi * 0.5], &mut draw);
        // The origin is exact, up to about 2^20.
        let powers = if draw.one_in(4) { 110 } else { 10 };
        let far = 2f32.powi(10 + draw.below(powers) as i32);
        let o = draw.nudged(target - d * far, 1);
        let [tmin, tmax] = one_of([[0.0, f32::INFINITY], [0.0, far], [far, f32::INFINITY], [far, far]], &mut draw);
        let Ok(ray) = Ray::within(o, d * one_of([1.0, 1.0, 0.75], &mut draw), tmin, tmax) else { continue };
        let slabs = BoxRay::<_, f32x8<_>, 8>::new(fearless_simd::Fallback::new(), &ray, &region_of(&boxes));
        if slabs.is_wide {
            check(&ray, &boxes, tmax);
            check(&ray, &[0, 1, 2, 3].map(|k| boxes[k]), tmax);
            let [lo, hi] = [aabb.lo, aabb.hi].map(|v| v.to_array());
            let entry = truth::entry(o.to_array(), ray.direction().to_array(), [tmin, tmax], lo, hi);
            (rare, touched) = (rare + 1, touched + u32::from(entry.is_some()));
        }
    }
    assert!(touched > 1000, "{touched}");
}

/// No ray that touches a box passes by it, whether it starts nearby or far away. [BOX-9]
#[test]
fn what_is_touched_is_not_passed_by() {
    let (mut draw, mut touched, mut passed) = (Draw::new(5), 0, 0);
    for _ in 0..40_000 {
        let (aabb, d) = (Aabb::of(&[draw.ints(3), draw.ints(3)]), draw.ints(3));
        let corner = aabb.lo.with_x(aabb.hi.x);
        let target = one_of([aabb.lo, aabb.hi, corner, aabb.lo * 0.5 + aabb.hi * 0.5], &mut draw);
        // The origin is exact, up to about 2^20.
        let far = 2f32.powi(draw.below(40) as i32);
        let o = draw.nudged(target - d * far, 1);
        let Ok(ray) = Ray::new(o, d * one_of([1.0, -1.0, 1e-30, 1e30], &mut draw)) else { continue };
        let is_passed_by = Region::of(&aabb).is_passed_by_single(&ray);
        let [lo, hi] = [aabb.lo, aabb.hi].map(|v| v.to_array());
        let entry = truth::entry(o.to_array(), ray.direction().to_array(), [0.0, f32::INFINITY], lo, hi);
        assert!(!(is_passed_by && entry.is_some()), "{ray:?} {aabb:?}");
        (touched, passed) = (touched + u32::from(entry.is_some()), passed + u32::from(is_passed_by));
    }
    assert!(touched > 5000 && passed > 5000, "{touched} {passed}");
}

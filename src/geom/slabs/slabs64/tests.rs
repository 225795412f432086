use fearless_simd::Fallback;
use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::geom::lanes::{FramedBoxes, NodeBoxes as _};
use crate::geom::tests::threshold;
use crate::geom::truth::{self, entry as true_entry};
use crate::geom::{Aabb, Frame};

/// Draws multiples of 2^-12 up to 8. The frame's origin is a multiple up to 2^36, so planes are also doubles in space.
fn plane() -> impl Strategy<Value = f64> {
    let few = prop::sample::select(vec![0.0, 1.0, -1.0, 2.0, 1.0 / 4096.0, 8.0, -8.0]);
    prop_oneof![few, (-32768..=32768i32).prop_map(|x| f64::from(x) / 4096.0)]
}

fn point() -> impl Strategy<Value = DVec3> {
    [plane(), plane(), plane()].prop_map(DVec3::from)
}

fn frame() -> impl Strategy<Value = Frame> {
    let origin = prop::sample::select(vec![0.0, 6.4e6, -1e9, 0.25, 6e10]);
    let exponent = prop::sample::select(vec![0, 0, 0, 40, -70, 300, -300, 400]);
    (origin, exponent).prop_filter_map("a frame", |(x, exponent)| {
        Frame::new(DVec3::new(x, -x, 0.5 * x) * power_of_two(exponent), exponent)
    })
}

/// Draws a component of a direction: of any magnitude, or toward a point.
fn component() -> impl Strategy<Value = f64> {
    let few = vec![0.0, -0.0, 1.0, -1.0, 1e-130, -1e-130, 5e-324, -5e-324, 1e-40, -1e-45, 1e300, -1e20, 3.0];
    prop_oneof![prop::sample::select(few), -2.0..2.0f64, threshold()]
}

#[derive(Clone, Debug)]
struct Case {
    frame: Frame,
    boxes: [Aabb; 2],
    ray: Ray<DVec3>,
}

fn case() -> impl Strategy<Value = Case> {
    let origin = prop_oneof![
        2 => point(),
        1 => (point(), prop::sample::select(vec![1e3, 1e9, 1e15, 1e30, 1e100, 1e200])).prop_map(|(p, far)| p * far),
        1 => [component(), component(), component()].prop_map(DVec3::from),
        1 => [-8.0..8.0, -8.0..8.0, -8.0..8.0f64].prop_map(DVec3::from),
    ];
    let direction = [component(), component(), component()].prop_map(DVec3::from);
    let end = || prop_oneof![6 => Just(None), 2 => (0.0..2.0f64).prop_map(Some), 1 => Just(Some(1.0))];
    let length = prop::sample::select(vec![0, 0, 0, 100, -100, 500, -500, 1000, -1000]);
    let corners = [point(), point(), point(), point()];
    (frame(), corners, origin, direction, (0..3, point(), length), (end(), end())).prop_filter_map(
        "not a ray",
        |(frame, [a, b, c, d], origin, direction, (aim, target, length), (tmin, tmax))| {
            let boxes = [[a, b], [c, d]].map(|corners| Aabb::of(&corners.map(DVec3::as_vec3)));
            let space = |p: DVec3| p * power_of_two(frame.exponent()) + frame.origin();
            // In any direction, at a point, or at a corner of the first box.
            let (o, target) = (space(origin), if aim == 1 { target } else { a });
            let d = if aim == 0 { direction } else { space(target) - o } * power_of_two(length);
            let t = if aim == 0 { 1.0 } else { power_of_two(-length) };
            let ray = Ray::within(o, d, tmin.unwrap_or(0.0) * t, tmax.map_or(f64::INFINITY, |x| x * t)).ok()?;
            Some(Case { frame, boxes, ray })
        },
    )
}

fn planes([a, b]: [Aabb; 2]) -> [[f32; 4]; 3] {
    [0, 1, 2].map(|axis| [a.lo[axis], a.hi[axis], b.lo[axis], b.hi[axis]])
}

/// Places two boxes in the lanes of a node. Six lanes are empty.
fn eight([a, b]: [Aabb; 2]) -> [[[f32; 8]; 2]; 3] {
    let boxes: [Aabb; 8] = std::array::from_fn(|lane| *[a, b].get(lane).unwrap_or(&Aabb::EMPTY));
    [0, 1, 2].map(|axis| [boxes.map(|aabb| aabb.lo[axis]), boxes.map(|aabb| aabb.hi[axis])])
}

/// Returns the exact distance where a box is entered, rounded to double.
fn truly(Case { frame, ray, .. }: &Case, aabb: &Aabb, ends: [f64; 2]) -> Option<f64> {
    let space = |v: Vec3| (v.as_dvec3() * power_of_two(frame.exponent()) + frame.origin()).to_array();
    let [o, d] = [ray.origin(), ray.direction()].map(|v| v.to_array());
    true_entry(o, d, ends, space(aabb.lo), space(aabb.hi)).map(|t| truth::round_f64(&t))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40_000))]

    /// [BOX-8] [BOX-9]
    #[test]
    fn what_is_touched_is_hit_in_every_frame(case in case()) {
        let Case { frame, boxes: [a, b], ray } = &case;
        let region = Region::within(*frame, &a.union(*b));
        let (wide, entered, exact) =
            (Slabs64::new(ray, &region), Entered::new(ray, &region), Entered::exactly(ray, &region));
        holds(&case, |planes, tmax| wide.pair(planes, tmax))?;
        holds(&case, |planes, tmax| entered.pair(planes, tmax))?;
        holds(&case, |planes, tmax| exact.pair(planes, tmax))?;
    }

    /// All boxes of a node at once. [BOX-8] [BOX-9]
    #[test]
    fn a_node_skips_no_box_that_is_touched(case in case()) {
        let Case { frame, boxes, ray } = &case;
        let region = Region::within(*frame, &boxes[0].union(boxes[1]));
        let slabs = FramedBoxes::new(Fallback::new(), ray, &region);
        let planes = eight(*boxes);
        for (side, aabb) in boxes.iter().enumerate() {
            let Some(t) = truly(&case, aabb, [ray.tmin(), ray.tmax()]) else { continue };
            // Up to the end of the ray, and up to a hit at the entry of the box.
            for end in [ray.tmax(), t] {
                let (_, set) = slabs.enter(&planes, slabs.end(end));
                prop_assert!(set >> side & 1 == 1, "{side} {t} {end} {set:b}");
            }
        }
    }

    /// No ray that touches a box passes by it, and every distant ray does that clearly misses it. [BOX-9]
    #[test]
    fn what_is_touched_is_not_passed_by(case in case()) {
        let Case { frame, boxes: [a, b], ray } = &case;
        let (far, d) = (frame.rounded(ray.origin()).abs().max_element(), ray.direction().abs());
        let length = d.max_element();
        // The line misses the box clearly on some pair of axes.
        let is_plain = d.to_array().iter().all(|&x| x == 0.0 || x > 1e-3 * length);
        let is_distant = is_plain && (100.0..1e30).contains(&far) && (1e-200..1e200).contains(&length);
        for aabb in [*a, a.union(*b)] {
            let is_passed_by = Region::within(*frame, &aabb).is_passed_by(ray);
            let is_touched = truly(&case, &aabb, [ray.tmin(), f64::INFINITY]).is_some();
            prop_assert!(!(is_passed_by && is_touched));
            let margin = (far * 1e-11) as f32 + 1e-5;
            let wider = Aabb { lo: aabb.lo - margin, hi: aabb.hi + margin };
            if is_distant && truly(&case, &wider, [0.0, f64::INFINITY]).is_none() {
                prop_assert!(is_passed_by, "{far}");
            }
        }
    }

    /// The test is not too coarse: boxes that are clearly missed are skipped, from any distance. [BOX-8] [BOX-9]
    #[test]
    fn it_is_as_fine_as_single_precision(case in case()) {
        let Case { frame, boxes: [a, b], ray } = &case;
        if ray.tmin() != 0.0 || ray.tmax() != f64::INFINITY {
            return Ok(());
        }
        let (region, wider) = (Region::within(*frame, &a.union(*b)), Aabb { lo: a.lo - 1e-4, hi: a.hi + 1e-4 });
        // An almost vanishing component gives weaker bounds.
        let d = ray.direction().abs();
        let is_plain = d.to_array().iter().all(|&x| x == 0.0 || x > 1e-30 * d.max_element());
        if is_plain && truly(&case, &wider, [0.0, f64::INFINITY]).is_none() {
            prop_assert!(Slabs64::new(ray, &region).one(a, f64::INFINITY).is_none());
            let [exact, entered] = [Entered::exactly(ray, &region), Entered::new(ray, &region)];
            prop_assert!([exact, entered].iter().all(|slabs| !slabs.pair(&planes([*a, *b]), f64::INFINITY).hit[0]));
        }
    }
}

/// Checks two boxes, and one around both boxes.
fn holds(case: &Case, pair: impl Fn(&[[f32; 4]; 3], f64) -> Intervals<f64>) -> Result<(), TestCaseError> {
    let Case { boxes: [a, b], ray, .. } = case;
    let [tmin, tmax] = [ray.tmin(), ray.tmax()];
    let found = pair(&planes([*a, *b]), tmax);
    let one = |aabb: &Aabb, tmax| {
        let Intervals { hit: [hit, _], near: [near, _], .. } = pair(&aabb.planes_twice(), tmax);
        hit.then_some(near)
    };
    for (side, aabb) in [a, b].into_iter().enumerate() {
        let Some(t) = truly(case, aabb, [tmin, tmax]) else { continue };
        prop_assert!(found.hit[side] && found.near[side] <= t && t <= found.far[side], "{t} {found:?}");
        // A hit there, after rounding, does not hide the box.
        prop_assert!(one(aabb, t).is_some(), "{t}");
    }
    let [inner, both] = [one(a, tmax), one(&a.union(*b), tmax)];
    prop_assert_eq!(inner, found.hit[0].then_some(found.near[0]));
    if truly(case, a, [tmin, tmax]).is_some() {
        prop_assert!(both <= inner, "{both:?} {inner:?}");
    }
    Ok(())
}

/// Cases beyond the fast range, with their results. [BOX-8] [BOX-9]
#[test]
fn beyond_its_range_it_is_slow_and_still_skips() {
    let aabb = Aabb { lo: Vec3::ZERO, hi: Vec3::ONE };
    let hits = |o: DVec3, d: DVec3| {
        let slabs = Slabs64::new(&Ray::new(o, d).expect("a ray"), &Region::of(&aabb));
        (slabs.entered.is_some(), slabs.one(&aabb, f64::INFINITY).is_some())
    };
    assert_eq!(hits(DVec3::splat(-1.0), DVec3::splat(1e-200)), (false, true));
    assert_eq!(hits(DVec3::splat(2.0), DVec3::splat(1e-200)), (false, false));
    for d in [1e-302, 5e-324, 1e-290] {
        assert_eq!(hits(DVec3::splat(-2.0), DVec3::splat(d)), (true, true), "{d}");
        assert_eq!(hits(DVec3::splat(-2.0), DVec3::new(d, d, -d)), (true, false), "{d}");
    }
    assert_eq!(hits(DVec3::new(-1e300, 0.5, 0.5), DVec3::X), (true, true));
    assert_eq!(hits(DVec3::new(-1e300, 1.5, 0.5), DVec3::X), (false, false));
    assert_eq!(hits(DVec3::splat(-1e300), DVec3::ONE), (true, true));
    assert_eq!(hits(DVec3::splat(-1e300), DVec3::new(1.0, 1.0, 1f64.next_up())), (true, false));
    assert_eq!(hits(DVec3::splat(1e300), DVec3::X), (false, false));
}

/// Rays whose products underflow do not pass by: with rounded products, the first one would. [BOX-9]
#[test]
fn tiny_rays_do_not_pass_by() {
    let region = Region::of(&Aabb { lo: Vec3::splat(-0.5), hi: Vec3::splat(0.5) });
    let passes_by = |tiny: f64, y: f64| {
        let ray = Ray::new(DVec3::new(-10.0, y, 0.0), DVec3::new(tiny, tiny, 0.0)).expect("a ray");
        region.is_passed_by(&ray)
    };
    assert_eq!([-10.6, -11.1, 10.0].map(|y| passes_by(5e-324, y)), [false; 3]);
    assert_eq!([-10.6, -11.1, 10.0].map(|y| passes_by(1.0, y)), [false, true, true]);
}

/// A ray that approaches the boxes on one axis, but almost parallel to them, has passed them long before. [BOX-8]
#[test]
fn what_is_passed_by_is_skipped() {
    let aabb = Aabb { lo: Vec3::ZERO, hi: Vec3::ONE };
    for tiny in [1e-30, 1e-130, 5e-324] {
        for (o, d) in [
            (DVec3::new(-2.0, -1.0, 0.5), DVec3::new(1.0, tiny, 0.0)),
            (DVec3::new(3.0, 2.0, 0.5), DVec3::new(-1.0, -tiny, 0.0)),
            (DVec3::new(1e300, 0.5, 0.5), DVec3::new(1.0, tiny, 0.0)),
            (DVec3::new(-2.0, -1e300, 0.5), DVec3::new(1.0, 0.0, tiny)),
        ] {
            let slabs = Slabs64::new(&Ray::new(o, d).expect("a ray"), &Region::of(&aabb));
            assert!(slabs.entered.is_none() && slabs.one(&aabb, f64::INFINITY).is_none(), "{o} {d}");
        }
        let inside = Ray::new(DVec3::new(-2.0, 0.5, 0.5), DVec3::new(1.0, -tiny, tiny)).expect("a ray");
        assert!(Slabs64::new(&inside, &Region::of(&aabb)).one(&aabb, f64::INFINITY).is_some());
    }
}

/// Boxes beyond the end of the ray are skipped, from any distance.
#[test]
fn what_is_beyond_the_end_is_skipped_from_afar() {
    let cube = |x: f32| Aabb { lo: Vec3::new(x, 0.0, 0.0), hi: Vec3::new(x + 1.0, 1.0, 1.0) };
    let (near, far) = (cube(-10.0), cube(0.0));
    let region = Region::of(&near.union(far));
    for (tmax, reaches) in [(1e9 - 20.0, [false, false]), (1e9 - 5.0, [true, false]), (1e9 + 0.5, [true, true])] {
        let ray = Ray::within(DVec3::new(-1e9, 0.5, 0.5), DVec3::X, 0.0, tmax).expect("a ray");
        let slabs = Slabs64::new(&ray, &region);
        assert_eq!([near, far].map(|aabb| slabs.one(&aabb, tmax).is_some()), reaches, "{tmax}");
    }
}

/// An almost vanishing component may still take a ray into the next box. [BOX-9]
#[test]
fn next_to_nothing_is_not_nothing() {
    const TINY: f64 = 1e-310;
    let below = Aabb { lo: Vec3::new(0.0, -1.0, 0.0), hi: Vec3::new(1.0, 0.0, 1.0) };
    let above = Aabb { lo: Vec3::new(1.0, 0.0, 0.0), hi: Vec3::new(2.0, 1.0, 1.0) };
    for (o, d) in [(-0.5 * TINY, TINY), (0.5 * TINY, -TINY)] {
        // From one half of the region to the other.
        let boxes = if d > 0.0 { [below, above] } else { [below, above].map(|aabb| mirrored(&aabb)) };
        let ray = Ray::new(DVec3::new(0.0, o, 0.5), DVec3::new(1.0, d, 0.0)).expect("a ray");
        let slabs = Entered::exactly(&ray, &Region::of(&boxes[0].union(boxes[1])));
        assert_eq!(slabs.pair(&planes(boxes), f64::INFINITY).hit, [true; 2], "{d}");
    }
}

/// Mirrors a box at y = 0.
fn mirrored(aabb: &Aabb) -> Aabb {
    Aabb { lo: aabb.lo.with_y(-aabb.hi.y), hi: aabb.hi.with_y(-aabb.lo.y) }
}

//! Properties of every box test.

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use stackless_bvh::generate::draw::Draw;
use stackless_bvh::geom::{Aabb, Ray, Region};
use stackless_bvh::internals::geom::slabs::{Directed, EnclosedSlabs, Intervals, Plain, Slabs, Slabs64, TwoSided};
use stackless_bvh::internals::geom::{EnclosedRay, Interval, truth};
use stackless_check::check_slabs;

/// Draws from few values, so planes and origins often coincide, with some extreme ones.
fn coordinate() -> impl Strategy<Value = f32> {
    let few = [0.0, -0.0, 1.0, -1.0, 2.0, 0.1, -3.0, 1e-20, 1e30, -1e38, f32::MAX, 1e-42, -1e-42, 1e-45];
    let threshold = any::<u64>().prop_map(|seed| Draw::new(seed).threshold_in_single());
    prop_oneof![6 => prop::sample::select(few.to_vec()), 2 => -4.0..4.0f32, 1 => threshold]
}

fn point() -> impl Strategy<Value = Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vec3::from)
}

fn aabb() -> impl Strategy<Value = Aabb> {
    (point(), point()).prop_map(|(a, b)| Aabb::of(&[a, b]))
}

fn ray() -> impl Strategy<Value = Ray> {
    let end = || prop_oneof![Just(0.0), Just(f32::INFINITY), Just(1.0), 0.0..4.0f32, coordinate().prop_map(f32::abs)];
    (point(), point(), end(), end()).prop_filter_map("not a ray", |(o, d, a, b)| Ray::within(o, d, a, b).ok())
}

/// Draws a ray and a box on a grid of small integers, where a ray is often in a face or through an edge or corner.
fn lattice() -> impl Strategy<Value = (Ray, Aabb)> {
    let small = || [-2..3i8, -2..3i8, -2..3i8].prop_map(|p| Vec3::from(p.map(f32::from)));
    // With zeros of either sign.
    (small(), small(), small(), small(), any::<bool>()).prop_filter_map("no direction", |(o, d, a, b, is_back)| {
        let d = if is_back { -d } else { d };
        Some((Ray::new(o, d).ok()?, Aabb::of(&[a, b])))
    })
}

/// Draws half the width of an interval, relative to its number if that is small.
fn width() -> impl Strategy<Value = f64> {
    prop::sample::select(vec![0.0, 0.0, 1e-16, 1e-9, 1e-5, 0.01, 1.0])
}

fn planes(boxes: [Aabb; 2]) -> [[f32; 4]; 3] {
    let [a, b] = boxes;
    [0, 1, 2].map(|axis| [a.lo[axis], a.hi[axis], b.lo[axis], b.hi[axis]])
}

fn touches(ray: &Ray, aabb: &Aabb) -> bool {
    let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
    truth::touches(o, d, [ray.tmin(), ray.tmax()], lo, hi)
}

/// Checks all properties of a form for any ray, and, if it promises that, that no touched box is skipped.
fn holds<B: Slabs<Vector = Vec3>>(ray: &Ray, a: Aabb, more: Aabb, promises: bool) -> Result<(), TestCaseError> {
    check_slabs::<B>(ray, &a, &more, promises).map(|_| ()).map_err(|fault| TestCaseError::fail(fault.to_string()))
}

/// A flat box just behind the origin: one product underflows to 0, the other does not. Nothing is promised there.
/// [BOX-3]
#[test]
fn a_box_behind_the_origin_may_count_as_hit() {
    let ray = Ray::new(Vec3::new(1e-45, 2.0, 1.0), Vec3::new(2.0, -0.0, 1.0)).unwrap();
    let inner = Aabb { lo: Vec3::new(-0.0, 2.0, 1.0), hi: Vec3::new(-0.0, 3.0, 2.0) };
    let outer = Aabb { lo: Vec3::new(-3.0, -3.0, -0.0), hi: Vec3::new(-0.0, 3.0, 2.0) };
    let slabs = Directed::new(&ray, &Region::of(&outer));
    let hits = [inner, outer].map(|aabb| slabs.one(&aabb, f32::INFINITY).is_some());
    assert_eq!((hits, [inner, outer].map(|aabb| touches(&ray, &aabb))), ([true, false], [false; 2]));
    assert!(check_slabs::<Directed>(&ray, &inner, &outer, true).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn all_forms_agree_with_themselves_and_nest(ray in ray(), a in aabb(), b in aabb()) {
        holds::<Plain>(&ray, a, b, false)?;
        holds::<TwoSided>(&ray, a, b, false)?;
        holds::<Directed>(&ray, a, b, true)?;
        holds::<EnclosedSlabs>(&ray, a, b, true)?;
    }

    /// Every ray at a corner of the bounds, or in the middle, and ends that are rounded as the distance of a hit is.
    /// [INST-4]
    #[test]
    fn what_any_ray_within_bounds_touches_is_hit(
        ray in ray(), wide in [width(), width(), width(), width(), width(), width()], a in aabb(), b in aabb(),
    ) {
        let numbers = [ray.origin().to_array(), ray.direction().to_array()].concat();
        let bounds: Vec<_> = numbers.iter().zip(wide).map(|(&x, wide)| {
            let x = f64::from(x);
            let most = if wide < 1e-3 { (x.abs() * wide).max(wide * 1e-30) } else { wide };
            if wide == 0.0 { Interval::exact(x) } else { Interval::between([x - most, x + most]) }
        }).collect();
        let rays = EnclosedRay::new([bounds[0], bounds[1], bounds[2]], [bounds[3], bounds[4], bounds[5]]);
        let slabs = EnclosedSlabs::of(&rays, ray.tmin(), &Region::of(&a.union(b)));
        let Intervals { hit: hits, near: nears, .. } = slabs.pair(&planes([a, b]), ray.tmax());
        for corner in 0..65 {
            let pick = |k: usize| {
                let [lo, hi] = bounds[k].ends();
                if corner == 64 { numbers[k].into() } else if corner >> k & 1 == 0 { lo } else { hi }
            };
            let ([o, d], interval) = ([[0, 1, 2], [3, 4, 5]].map(|k| k.map(pick)), [ray.tmin(), ray.tmax()].map(f64::from));
            for (side, aabb) in [a, b].iter().enumerate() {
                let [lo, hi] = [aabb.lo, aabb.hi].map(|v| v.as_dvec3().to_array());
                if let Some(entry) = truth::entry(o, d, interval, lo, hi) {
                    let t = truth::round_f32(&entry);
                    prop_assert!(hits[side] && nears[side] <= t, "{o:?} {d:?} {aabb:?}");
                    prop_assert!(slabs.one(aabb, t).is_some());
                }
            }
        }
    }

    #[test]
    fn touched_boxes_are_hit(ray in ray(), aabb in aabb()) {
        let slabs = Directed::new(&ray, &Region::of(&aabb));
        let hit = slabs.one(&aabb, ray.tmax()).is_some();
        prop_assert!(hit || !touches(&ray, &aabb));
        let [o, d] = [ray.origin(), ray.direction()].map(Vec3::as_dvec3);
        let wide = Ray::within(o, d, ray.tmin().into(), ray.tmax().into()).expect("a ray");
        let hit = Slabs64::new(&wide, &Region::of(&aabb)).one(&aabb, wide.tmax()).is_some();
        prop_assert!(hit || !touches(&ray, &aabb));
    }

    #[test]
    fn no_other_box_of_the_lattice_is((ray, aabb) in lattice()) {
        // Distances differ by a thirtieth or more here, so padding hits no untouched box.
        let slabs = Directed::new(&ray, &Region::of(&aabb));
        prop_assert_eq!(slabs.one(&aabb, f32::INFINITY).is_some(), touches(&ray, &aabb));
        let two_sided = TwoSided::new(&ray, &Region::of(&aabb));
        prop_assert_eq!(two_sided.one(&aabb, f32::INFINITY).is_some(), touches(&ray, &aabb));
    }

    #[test]
    fn no_form_hits_another_box_of_the_lattice_or_far_before_it((ray, aabb) in lattice()) {
        let expected = touches(&ray, &aabb);
        let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
        let entry = truth::entry(o, d, [0.0, f32::INFINITY], lo, hi).map(|entry| truth::round_f32(&entry));
        let is_right = |near: Option<f32>| match (near, entry) {
            (Some(near), Some(entry)) => expected && near <= entry && entry - near <= 1e-4 * entry,
            (near, entry) => near.is_none() && entry.is_none() && !expected,
        };
        // In the larger region, single precision is not used.
        let great = Aabb { lo: Vec3::splat(-f32::MAX), hi: Vec3::splat(f32::MAX) };
        for region in [aabb, great].map(|aabb| Region::of(&aabb)) {
            prop_assert!(is_right(Directed::new(&ray, &region).one(&aabb, f32::INFINITY)));
            prop_assert!(is_right(EnclosedSlabs::new(&ray, &region).one(&aabb, f32::INFINITY)));
            let [o, d] = [ray.origin(), ray.direction()].map(Vec3::as_dvec3);
            let wide = Slabs64::new(&Ray::new(o, d).expect("a ray"), &region);
            prop_assert!(is_right(wide.one(&aabb, f64::INFINITY).map(|near| near as f32)));
        }
    }

    #[test]
    fn a_box_is_hit_by_rays_that_end_where_they_enter_it(ray in ray(), aabb in aabb()) {
        // The end is rounded like the distance of a hit, possibly down.
        let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
        if let Some(entry) = truth::entry(o, d, [ray.tmin(), ray.tmax()], lo, hi) {
            let t = truth::round_f32(&entry);
            let slabs = Directed::new(&ray, &Region::of(&aabb));
            prop_assert!(slabs.one(&aabb, t).is_some(), "{t}");
        }
    }

    #[test]
    fn a_box_is_hit_by_rays_at_its_corners(
        corner in [-2047..2048i32, -2047..2048i32, -2047..2048i32],
        d in [1..2048i32, 1..2048i32, 1..2048i32],
        s in 1..2048i32,
    ) {
        // All of these numbers are exact. The ray hits the box in one point, beyond the first of its planes.
        let [corner, d] = [corner, d].map(|p| Vec3::from(p.map(|x| x as f32)));
        let ray = Ray::new(corner - d * s as f32, d).expect("a ray");
        let aabb = Aabb::of(&[corner, corner + Vec3::new(9.0, -9.0, 9.0)]);
        let region = Region::of(&aabb);
        prop_assert!(Directed::new(&ray, &region).one(&aabb, f32::INFINITY).is_some());
        prop_assert!(TwoSided::new(&ray, &region).one(&aabb, f32::INFINITY).is_some());
    }
}

/// A ray that touches the box in one edge, and that padding by 4 units of 2^-24 on one side misses.
#[test]
fn padding_suffices_where_2_ulps_do_not() {
    let point = |bits: [u32; 3]| Vec3::from(bits.map(f32::from_bits));
    let (o, d) = (point([0x33fd_9472, 0xb3f2_3a88, 0]), point([0x3feb_b676, 0x3ffe_1fe8, 0]));
    let lo = Vec3::new(f32::from_bits(0x4000_4c97), -1.0, -1.0);
    let hi = Vec3::new(9.0, f32::from_bits(0x400a_5221), 1.0);
    let (ray, aabb) = (Ray::new(o, d).expect("a ray"), Aabb { lo, hi });
    let region = Region::of(&aabb);
    assert!(Plain::new(&ray, &region).one(&aabb, f32::INFINITY).is_none());
    assert!(TwoSided::new(&ray, &region).one(&aabb, f32::INFINITY).is_some());
    assert!(Directed::new(&ray, &region).one(&aabb, f32::INFINITY).is_some());
}

/// Two rays, found by `lab accuracy`, that start on a plane which they leave so slowly that the reciprocal
/// overflows: 0 times minus infinity fell on the wrong side of the sorted lanes, and the flat box was skipped.
#[test]
fn a_ray_that_hardly_leaves_its_plane_enters_the_box_there() {
    let triangles = [
        (
            [0x3b98_0944, 0xbbc6_5931, 0x3b9b_2074],
            [0x3c92_e57d, 0x8000_004a, 0xbcc7_1db8],
            [
                [0x3be9_6b85, 0xbbc6_5931, 0x3ca0_3ea4],
                [0xbca0_5f16, 0xbbc6_5931, 0xbc82_a8d7],
                [0x3c95_e108, 0xbbc6_5931, 0xbc8e_88ff],
            ],
        ),
        (
            [0xc250_ab4a, 0xc200_2000, 0xc225_18d2],
            [0x430c_21c2, 0x8000_039c, 0x4175_12fc],
            [
                [0x4282_2000, 0xc200_2000, 0xc1a6_2000],
                [0xc28f_0000, 0xc200_2000, 0xc22d_6000],
                [0x4282_2000, 0xc200_2000, 0xc22d_6000],
            ],
        ),
    ];
    let point = |bits: [u32; 3]| Vec3::from(bits.map(f32::from_bits));
    for (o, d, corners) in triangles {
        let ray = Ray::new(point(o), point(d)).expect("a ray");
        let aabb = Aabb::of(&corners.map(point));
        assert!(touches(&ray, &aabb));
        assert_eq!(Directed::new(&ray, &Region::of(&aabb)).one(&aabb, 0.0), Some(0.0));
    }
}

#[test]
fn rays_in_double_precision_beyond_its_range_hit_what_they_touch() {
    let aabb = Aabb { lo: Vec3::ZERO, hi: Vec3::ONE };
    for (o, d) in [(DVec3::new(-1e300, 0.5, 0.5), DVec3::X), (DVec3::splat(-1.0), DVec3::splat(1e-300))] {
        let ray = Ray::new(o, d).expect("a ray");
        assert!(Slabs64::new(&ray, &Region::of(&aabb)).one(&aabb, f64::INFINITY).is_some());
    }
}

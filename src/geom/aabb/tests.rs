use glam::Vec3;
use proptest::prelude::*;

use super::*;

/// Few values, so that planes, origins and each other often coincide, and some extreme ones.
fn coordinate() -> impl Strategy<Value = f32> {
    let few = prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 2.0, 0.1, -3.0, 1e-20, 1e30, -1e38, 1e-42, -1e-42]);
    prop_oneof![3 => few, 1 => -4.0..4.0f32]
}

fn point() -> impl Strategy<Value = Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vec3::from)
}

fn aabb() -> impl Strategy<Value = Aabb> {
    (point(), point()).prop_map(|(a, b)| Aabb::of(&[a, b]))
}

fn ray() -> impl Strategy<Value = Ray> {
    let end = || prop_oneof![Just(0.0), Just(f32::INFINITY), Just(1.0), 0.0..4.0f32];
    (point(), point(), end(), end()).prop_filter_map("not a ray", |(o, d, a, b)| Ray::new(o, d, a, b).ok())
}

/// A ray and a box in the grid of small integers, where a ray often runs in a face or through an edge or corner.
fn lattice() -> impl Strategy<Value = (Ray, Aabb)> {
    let small = || [-2..3i8, -2..3i8, -2..3i8].prop_map(|p| Vec3::from(p.map(f32::from)));
    (small(), small(), small(), small()).prop_filter_map("no direction", |(o, d, a, b)| {
        Some((Ray::new(o, d, 0.0, f32::INFINITY).ok()?, Aabb::of(&[a, b])))
    })
}

fn planes(boxes: [Aabb; 2]) -> [[f32; 4]; 3] {
    let [a, b] = boxes;
    [0, 1, 2].map(|axis| [a.lo[axis], a.hi[axis], b.lo[axis], b.hi[axis]])
}

/// Whether the closed intervals meet, in integers: each plane's distance is a fraction with denominator `d`.
fn meets_exactly(ray: &Ray, aabb: &Aabb) -> bool {
    let (mut near, mut far) = ((0, 1), (1, 0));
    for axis in 0..3 {
        let [o, d, lo, hi] =
            [ray.origin()[axis], ray.direction()[axis], aabb.lo[axis], aabb.hi[axis]].map(|x| x as i64);
        if d == 0 {
            if o < lo || hi < o {
                return false;
            }
            continue;
        }
        let [first, last] = if d > 0 { [lo - o, hi - o] } else { [o - hi, o - lo] };
        let d = d.abs();
        if first * near.1 > near.0 * d {
            near = (first, d);
        }
        if last * far.1 < far.0 * d {
            far = (last, d);
        }
    }
    near.0 * far.1 <= far.0 * near.1
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn one_and_pair_agree_in_every_bit(ray in ray(), a in aabb(), b in aabb(), tmax in coordinate()) {
        let slabs = RaySlabs::new(&ray);
        for tmax in [ray.tmax(), tmax.abs()] {
            let (hits, nears) = slabs.pair(&planes([a, b]), tmax);
            for (i, aabb) in [a, b].iter().enumerate() {
                let one = slabs.one(aabb, tmax);
                prop_assert_eq!(hits[i], one.is_some());
                if let Some([near, far]) = one {
                    prop_assert_eq!(nears[i].to_bits(), near.to_bits());
                    prop_assert!(near <= far);
                }
            }
        }
    }

    #[test]
    fn intervals_nest_as_boxes_do(ray in ray(), inner in aabb(), more in aabb()) {
        let slabs = RaySlabs::new(&ray);
        let outer = inner.union(more);
        prop_assert!(outer.encloses(&inner));
        if let Some([near, far]) = slabs.one(&inner, ray.tmax()) {
            let around = slabs.one(&outer, ray.tmax());
            prop_assert!(around.is_some_and(|around| around[0] <= near && far <= around[1]), "{around:?}");
        }
    }

    #[test]
    fn near_and_far_bound_the_truth(
        o in [-4.0..4.0f32, -4.0..4.0f32, -4.0..4.0f32],
        d in [0.1..1.0f32, 0.1..1.0f32, 0.1..1.0f32],
        lo in [5.0..9.0f32, 5.0..9.0f32, 5.0..9.0f32],
    ) {
        let ray = Ray::new(o.into(), d.into(), 0.0, f32::INFINITY).expect("a ray");
        let aabb = Aabb { lo: lo.into(), hi: Vec3::splat(99.0) };
        if let Some([near, far]) = RaySlabs::new(&ray).one(&aabb, ray.tmax()) {
            // Differences are exact in double precision; the quotient's error is nothing beside the padding.
            let to = |plane: Vec3, axis: usize| {
                (f64::from(plane[axis]) - f64::from(o[axis])) / f64::from(d[axis])
            };
            prop_assert!(f64::from(near) <= [0, 1, 2].map(|axis| to(aabb.lo, axis)).into_iter().fold(0.0, f64::max));
            prop_assert!(f64::from(far) >= [0, 1, 2].map(|axis| to(aabb.hi, axis)).into_iter().fold(1e9, f64::min));
        }
    }

    #[test]
    fn touched_boxes_are_hit((ray, aabb) in lattice()) {
        // Distances differ by a thirtieth or more here, so that padding hits nothing that is not touched.
        let hit = RaySlabs::new(&ray).one(&aabb, ray.tmax()).is_some();
        prop_assert_eq!(hit, meets_exactly(&ray, &aabb));
    }

    #[test]
    fn a_box_is_hit_by_rays_at_its_corners(
        corner in [-2047..2048i32, -2047..2048i32, -2047..2048i32],
        d in [1..2048i32, 1..2048i32, 1..2048i32],
        s in 1..2048i32,
    ) {
        // All of these numbers are exact. The box is met in one point, beyond the first of its planes.
        let [corner, d] = [corner, d].map(|p| Vec3::from(p.map(|x| x as f32)));
        let ray = Ray::new(corner - d * s as f32, d, 0.0, f32::INFINITY).expect("a ray");
        let aabb = Aabb::of(&[corner, corner + Vec3::new(9.0, -9.0, 9.0)]);
        prop_assert!(RaySlabs::new(&ray).one(&aabb, ray.tmax()).is_some());
    }
}

/// A ray that touches the box in one edge, and that padding by 4 units of 2^-24 on one side misses.
#[test]
fn padding_suffices_where_2_ulps_do_not() {
    let point = |bits: [u32; 3]| Vec3::from(bits.map(f32::from_bits));
    let (o, d) = (point([0x33fd_9472, 0xb3f2_3a88, 0]), point([0x3feb_b676, 0x3ffe_1fe8, 0]));
    let lo = Vec3::new(f32::from_bits(0x4000_4c97), -1.0, -1.0);
    let hi = Vec3::new(9.0, f32::from_bits(0x400a_5221), 1.0);
    let ray = Ray::new(o, d, 0.0, f32::INFINITY).expect("a ray");
    assert!(RaySlabs::new(&ray).one(&Aabb { lo, hi }, f32::INFINITY).is_some());
}

#[test]
fn boxes_measure_themselves() {
    let aabb = Aabb { lo: Vec3::ZERO, hi: Vec3::new(1.0, 2.0, 3.0) };
    assert_eq!(aabb.half_area(), 11.0);
    assert_eq!(aabb.centroid(), Vec3::new(0.5, 1.0, 1.5));
    assert_eq!(Aabb::EMPTY.union(aabb), aabb);
    assert!(aabb.contains(aabb.hi) && !aabb.contains(Vec3::splat(1.5)));
    let greatest = Aabb::of(&[Vec3::MAX, Vec3::splat(1e38)]);
    assert!(greatest.centroid().is_finite());
}

use proptest::prelude::*;

use super::*;

const UNIT: Triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);

fn hit(triangle: Triangle, o: [f32; 3], d: [f32; 3], tmin: f32, tmax: f32) -> Option<Hit> {
    let ray = Ray::new(o.into(), d.into(), tmin, tmax).expect("a ray");
    triangle.intersect(&ray, &RaySlabs::new(&ray))
}

#[test]
fn edges_corners_and_both_sides_count() {
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5], [0.25, 0.25]] {
        for side in [1.0, -1.0] {
            let found = hit(UNIT, [x, y, -2.0 * side], [0.0, 0.0, side], 0.0, f32::INFINITY);
            assert_eq!(found, Some(Hit { t: 2.0, u: x, v: y }));
        }
    }
    for [x, y] in [[-0.001, 0.5], [0.5, -0.001], [0.501, 0.501]] {
        assert_eq!(hit(UNIT, [x, y, -2.0], [0.0, 0.0, 1.0], 0.0, f32::INFINITY), None);
    }
}

#[test]
fn both_ends_of_the_interval_count() {
    let within = |tmin, tmax| hit(UNIT, [0.25, 0.25, -2.0], [0.0, 0.0, 1.0], tmin, tmax).is_some();
    assert!(within(2.0, 2.0) && within(0.0, 2.0) && within(2.0, 9.0));
    assert!(!within(0.0, 2.0f32.next_down()) && !within(2.0f32.next_up(), 9.0));
    assert!(hit(UNIT, [0.25, 0.25, 1.0], [0.0, 0.0, 1.0], 0.0, f32::INFINITY).is_none(), "behind");
}

#[test]
fn flat_triangles_are_missed() {
    let (point, line) = (Triangle([Vec3::X; 3]), Triangle([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]));
    for triangle in [point, line] {
        assert_eq!(hit(triangle, [1.0, 0.0, -1.0], [0.0, 0.0, 1.0], 0.0, f32::INFINITY), None);
    }
    assert_eq!(hit(UNIT, [-1.0, 0.25, 0.0], [1.0, 0.0, 0.0], 0.0, f32::INFINITY), None, "edge-on");
}

#[test]
fn numbers_out_of_range_are_no_hits() {
    let huge = Triangle(UNIT.0.map(|corner| corner * 1e38));
    assert_eq!(hit(huge, [1e37, 1e37, -3e38], [0.0, 0.0, 1e38], 0.0, f32::INFINITY), None);
    let far = hit(UNIT, [0.25, 0.25, -1e38], [0.0, 0.0, 1e-7], 0.0, f32::INFINITY);
    assert_eq!(far, None, "t would be infinite");
}

#[test]
fn what_the_box_moves_off_the_ray_is_no_hit() {
    // The box is 4 ulps beyond the ray's end: padding reaches it, but its near end is still beyond.
    let end = 1.0 + 4.0 * f32::EPSILON;
    let ray = Ray::new(Vec3::new(0.25, 0.25, -end), Vec3::Z, 0.0, 1.0).expect("a ray");
    let slabs = RaySlabs::new(&ray);
    assert!(slabs.one(&UNIT.aabb(), ray.tmax()).is_some());
    assert_eq!(UNIT.place(1.0, &ray, &slabs), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50_000))]

    /// Near misses of the rounding kind: thin triangles far away, hit at an edge, with the interval's end nearby.
    #[test]
    fn a_hit_is_in_the_triangles_own_box(
        corners in [-1.0..1.0f32, -1.0..1.0f32, -1.0..1.0f32],
        thin in prop::sample::select(vec![1.0f32, 1e-3, 1e-6]),
        from in [-9.0..9.0f32, -9.0..9.0f32, -9.0..9.0f32],
        weight in 0.0..1.0f32,
        tmax in prop::sample::select(vec![1.0, 1.0f32.next_down(), f32::INFINITY]),
    ) {
        let v0 = Vec3::from(corners);
        let (v1, v2) = (v0 + Vec3::new(1.0, 0.5, thin * 0.25), v0 + Vec3::new(0.3, 0.2, thin));
        let triangle = Triangle([v0, v1, v2]);
        let origin = Vec3::from(from) * 10.0;
        let ray = Ray::new(origin, v0.lerp(v1, weight) - origin, 0.5, tmax).expect("a ray");
        let slabs = RaySlabs::new(&ray);
        if let Some(Hit { t, .. }) = triangle.intersect(&ray, &slabs) {
            let [near, far] = slabs.one(&triangle.aabb(), ray.tmax()).expect("a hit box");
            prop_assert!(near <= t && t <= far && 0.5 <= t && t <= tmax);
        }
    }
}

use super::*;

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

#[test]
fn a_box_encloses_what_is_inside_it_on_every_side() {
    let aabb = Aabb { lo: Vec3::new(-1.0, 2.0, 5.0), hi: Vec3::new(1.0, 6.0, 7.0) };
    assert_eq!(aabb.extent(), Vec3::new(2.0, 4.0, 2.0));
    assert!(aabb.encloses(&aabb));
    for axis in 0..3 {
        let (mut lower, mut upper) = (aabb, aabb);
        lower.lo[axis] -= 1.0;
        upper.hi[axis] += 1.0;
        for wide in [lower, upper] {
            assert!(wide.encloses(&aabb) && !aabb.encloses(&wide));
        }
    }
}

use super::*;
use crate::geom::Aabb;

/// Single precision takes all but coordinates beyond 2^126 and components whose reciprocals overflow.
#[test]
fn double_precision_is_asked_only_where_it_is_needed() {
    let is_wide = |o: f32, d: f32, reach: f32| {
        let ray = Ray::new(Vec3::new(0.0, o, 0.0), Vec3::new(1.0, 0.0, d)).expect("a ray");
        Directed::new(&ray, &Region::of(&Aabb { lo: Vec3::splat(-reach), hi: Vec3::ZERO })).is_wide
    };
    let most = 2f32.powi(126);
    for x in [0.0, 1.0, most] {
        assert_eq!([is_wide(x, 0.5, 1.0), is_wide(-x, -0.5, 1.0), is_wide(0.0, 0.5, x)], [false; 3], "{x}");
    }
    let beyond = most.next_up();
    assert_eq!([is_wide(beyond, 0.5, 1.0), is_wide(-beyond, 0.5, 1.0), is_wide(0.0, 0.5, beyond)], [true; 3]);
    for d in [0.0, -0.0, f32::MIN_POSITIVE, -f32::MIN_POSITIVE, f32::MAX] {
        assert!(!is_wide(1.0, d, 1.0), "{d}");
    }
    for d in [1e-39, -1e-39, 1e-45] {
        assert!(is_wide(1.0, d, 1.0), "{d}");
    }
}

use super::*;
use crate::geom::Ray;

/// Numbers from 2^-200 to 2^200 and 0, in the ray as in the triangle; and no others.
#[test]
fn usual_numbers_are_summed() {
    let [least, most] = [-200, 200].map(|exponent| 2f64.powi(exponent));
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let can_sum = |corner: DVec3, o: DVec3| {
        let triangle = Triangle([corners[0], corner, corners[2]]);
        let ray = Ray::new(o, DVec3::Z).expect("a ray");
        Exact64::new(&ray, &Region::of(&Triangle(corners).aabb())).can_sum(&triangle)
    };
    for k in 0..3 {
        let with = |x: f64| {
            let mut v = DVec3::new(1.0, -2.0, 0.0);
            v[k] = x;
            v
        };
        for x in [0.0, -0.0, 1.0, least, -least, most, -most] {
            assert!(is_usual(with(x)) && can_sum(with(x), with(x)), "{x}");
        }
        for x in [least.next_down(), -least.next_down(), most.next_up(), -most.next_up(), 5e-324, f64::MAX] {
            assert!(!is_usual(with(x)) && !can_sum(with(x), DVec3::ONE) && !can_sum(DVec3::ONE, with(x)), "{x}");
        }
    }
}

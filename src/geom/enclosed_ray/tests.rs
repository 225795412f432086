use glam::Vec3;

use super::*;
use crate::generate::draw::{Draw, one_of};
use crate::geom::slabs::{EnclosedSlabs, Slabs};
use crate::geom::tests::exact;
use crate::geom::truth::{self, Number};
use crate::geom::{Aabb, AffineMap, ExactRay};

/// Draws a box within -1 to 1, and a ray from a distance of up to `far` that may be aimed at it.
fn case(draw: &mut Draw, far: f64) -> (Aabb, [DVec3; 2]) {
    let (a, b) = (draw.centred(), draw.centred());
    let (inner, way) = (Aabb::of(&[a, b]), if draw.one_in(2) { draw.axis() } else { draw.ints(5) }.as_dvec3());
    let at = if draw.one_in(2) { a.as_dvec3() } else { DVec3::ZERO };
    (inner, [at - way * far, way * f64::from(draw.float(-60, 60)).abs()])
}

/// Rays from distances of up to 2^1000, exact and within bounds. A touched box is not missed, and not entered too late.
/// A box that is not touched is missed, unless the bounds are too wide. [INST-7]
#[test]
fn what_is_touched_from_afar_is_told() {
    let (mut draw, mut touched, mut missed, mut moved) = (Draw::new(1), 0, 0, 0);
    let all = Region::of(&Aabb { lo: Vec3::NEG_ONE, hi: Vec3::ONE });
    for _ in 0..40_000 {
        let far = 2f64.powi(draw.below(900) as i32 / one_of([1, 10], &mut draw));
        let (inner, [o, d]) = case(&mut draw, far);
        if d == DVec3::ZERO || !o.is_finite() {
            continue;
        }
        let off = one_of([0.0, 1e-16, 1e-9], &mut draw);
        let bounds = |v: DVec3| v.to_array().map(|x| Interval::between([x - x.abs() * off, x + x.abs() * off]));
        let ray = EnclosedRay::new(bounds(o), bounds(d));
        let line = [o, d].map(|v| v.to_array().map(|x| Relaxed::try_from(x).unwrap()));
        let exactly = EnclosedRay::of_line(&line, &all).map_or(Approach::Misses, Approach::Enters);
        let [lo, hi] = [inner.lo, inner.hi].map(|v| v.as_dvec3().to_array());
        let [o, d] = [o, d].map(|v| v.to_array());
        let t = truth::entry(o, d, [0.0, f64::INFINITY], lo, hi);
        for approach in [ray.approach(&all), exactly] {
            match approach {
                Approach::Misses => assert_eq!(t, None, "{ray:?}"),
                Approach::Unknown => {}
                Approach::Enters(near) => {
                    moved += u32::from(near.start.ends()[1] > 0.0);
                    let told = EnclosedSlabs::of(&near, 0.0, &all).one(&inner, f32::INFINITY);
                    match &t {
                        Some(t) => {
                            touched += 1;
                            assert!(told.is_some_and(|told| told <= f32::nearest(t)), "{told:?} {ray:?} {near:?}");
                        }
                        None => missed += u32::from(told.is_none()),
                    }
                }
            }
        }
    }
    assert!(touched > 5000 && missed > 5000 && moved > 10_000, "{touched} {missed} {moved}");
}

/// Exact lines stay exact through maps. [INST-7]
#[test]
fn lines_are_pulled_back_exactly() {
    let map = AffineMap::new([[3.0, 1.0, 0.0, 0.1], [0.0, -0.7, 0.0, 1e6], [0.2, 0.0, 1e-3, 5.0]]).unwrap();
    let region = Region::of(&Aabb { lo: Vec3::NEG_ONE, hi: Vec3::ONE });
    // The line from the image of a point, along the image of a direction.
    let image = |v: [f64; 3], w: f64| {
        map.rows()
            .map(|[x, y, z, b]| exact(x) * exact(v[0]) + exact(y) * exact(v[1]) + exact(z) * exact(v[2]) + exact(b * w))
    };
    let (o, d) = (image([-8.0, 0.25, 0.5], 1.0), image([2.0, 0.0, 0.0], 0.0));
    let [o, d] = [o, d].map(|v| v.map(|x| x.to_f64().value()));
    let ray = Ray::new(DVec3::from(o), DVec3::from(d)).unwrap();
    let found = ExactRay::from(&ray).approach(&[map], &region).unwrap();
    // Except for the rounding of the ray, it enters at x = -1 after 3.5 lengths.
    let near = |interval: Interval, x: f64| interval.ends().iter().all(|end| (end - x).abs() < 1e-9);
    assert!(near(found.start, 3.5) && near(found.origin[0], -1.0) && near(found.origin[1], 0.25), "{found:?}");
    assert!(near(found.direction[0], 2.0) && near(found.direction[1], 0.0), "{found:?}");
}

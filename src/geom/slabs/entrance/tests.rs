use proptest::prelude::*;

use super::*;
use crate::geom::Aabb;
use crate::geom::truth::{self, RBig};

const LEAST: f32 = f32::from_bits(1);

/// Draws numbers that are often equal, and of all magnitudes.
fn number() -> impl Strategy<Value = f32> {
    let few = [0.0, -0.0, 1.0, -1.0, 3.0, 0.1, LEAST, -LEAST, -3.0 * LEAST, 1e-20, -1e-38, 1e30, -1e38, f32::MAX];
    prop_oneof![3 => prop::sample::select(few.to_vec()), 2 => -4.0..4.0f32]
}

fn point() -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from)
}

fn aabb() -> impl Strategy<Value = Aabb> {
    (point(), point()).prop_map(|(a, b)| Aabb::of(&[a, b]))
}

/// Draws a ray from any point, or from far away toward a point.
fn ray() -> impl Strategy<Value = Ray> {
    let power = |exponents: std::ops::Range<i32>| exponents.prop_map(|exponent| 2f32.powi(exponent));
    let far = prop_oneof![Just(0.0), power(0..40), power(40..120)];
    let tmin = prop_oneof![4 => Just(0.0), 1 => Just(0.5), 1 => power(-149..100)];
    (point(), point(), power(-60..60), far, tmin).prop_filter_map("not a ray", |(at, d, length, far, tmin)| {
        Ray::within(at - d * far, d * length, tmin, f32::INFINITY).ok()
    })
}

/// Returns the distance where the line leaves a box that it hits.
fn exit([o, d, lo, hi]: [[f32; 3]; 4]) -> Option<RBig> {
    let exact = |x: f32| RBig::try_from(x).expect("finite");
    let axes = (0..3).filter(|&k| d[k] != 0.0);
    axes.map(|k| [lo[k], hi[k]].map(|plane| (exact(plane) - exact(o[k])) / exact(d[k]))).map(|[a, b]| a.max(b)).min()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// For all cases that single precision accepts: no box is entered too late or left too early, with distances
    /// rounded like those of hits. [BOX-9]
    #[test]
    fn from_the_entrance_boxes_are_met_where_they_are(ray in ray(), a in aabb(), b in aabb(), more in aabb()) {
        let entered = entered(&ray, &Region::of(&a.union(b).union(more)));
        let planes = [0, 1, 2].map(|axis| [a.lo[axis], a.hi[axis], b.lo[axis], b.hi[axis]]);
        for (met, aabb) in entered.pair(&planes).into_iter().zip([a, b]) {
            let [o, d, lo, hi] = [ray.origin(), ray.direction(), aabb.lo, aabb.hi].map(|v| v.to_array());
            let Some(entry) = truth::entry(o, d, [ray.tmin(), f32::INFINITY], lo, hi) else { continue };
            let entry = truth::round_f32(&entry);
            let exit = exit([o, d, lo, hi]).map(|exit| truth::round_f32(&exit).min(f32::MAX));
            prop_assert!(met.is_some_and(|[near, far]| near <= entry && Some(far) >= exit), "{met:?} {entry:?} {exit:?}");
        }
    }
}

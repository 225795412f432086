use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::generate::{Rng, Source};
use crate::geom::truth::{self, Meeting, RBig};

fn vector() -> impl Strategy<Value = DVec3> {
    let few = vec![0.0, 1.0, -1.0, 0.5, 3.0, 1e-130, -1e-300, 0.1];
    let number = || prop_oneof![1 => prop::sample::select(few.clone()), 2 => -2.0..2.0f64];
    [number(), number(), number()].prop_map(DVec3::from)
}

fn exact(x: Twofold) -> RBig {
    let [high, low] = [x.high, x.low].map(|x| RBig::try_from(x).expect("finite"));
    high + low
}

fn size(v: DVec3) -> f64 {
    v.abs().max_element()
}

/// The exact determinant of three rows.
fn determinant(rows: [[RBig; 3]; 3]) -> RBig {
    let [a, b, c] = &rows;
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// The bound, and no result that rounds otherwise than the exact one. A half of the bound is not known to be too
    /// little: the greatest error that was found is a 66th of it. [EXACT-10]
    #[test]
    fn errors_are_within_their_bounds(
        corners in [vector(), vector(), vector()], o in vector(), d in vector(),
        scales in prop::sample::select(vec![[0, 0], [100, -100], [-190, 150], [190, 0], [-100, -199]]), far in any::<bool>(),
    ) {
        let [size_of_space, length] = scales.map(|exponent| 2f64.powi(exponent));
        let shift = if far { 1e9 } else { 0.0 };
        let (corners, o, d) = (corners.map(|v| (v + shift) * size_of_space), (o + shift) * size_of_space, d * length);
        let Some(found) = Twofolds::new(&corners, o, d) else { return Ok(()) };
        let row = |a: DVec3, b: DVec3| -> [RBig; 3] {
            [0, 1, 2].map(|k| RBig::try_from(a[k]).expect("finite") - RBig::try_from(b[k]).expect("finite"))
        };
        let [v0, v1, v2] = corners;
        let (e1, e2, s, d_exact) = (row(v1, v0), row(v2, v0), row(o, v0), row(d, DVec3::ZERO));
        let [c, e] = [size(o - v0), size(v1 - v0).max(size(v2 - v0))];
        let top = dot(&found.e2, &cross(&found.s, &found.e1));
        for (computed, rows, bound) in [
            (found.det, [e1.clone(), d_exact, e2.clone()], ERROR * (size(d) * e * e)),
            (top, [e2, s, e1], ERROR * (c * e * e)),
        ] {
            let error = exact(computed) - determinant(rows);
            let bound = RBig::try_from(bound).expect("finite");
            prop_assert!(error <= bound && -error <= bound);
        }
        let meeting = truth::meet(corners.map(|v| v.to_array()), o.to_array(), d.to_array());
        let (Meeting::Hit(point), true) = (meeting, found.det.high.abs() > 1e-20 * size(d) * e * e) else {
            return Ok(());
        };
        if let Some(t) = found.distance() {
            prop_assert_eq!(t, truth::round_f64(&point.t));
        }
        if let Some(weights) = found.weights() {
            prop_assert_eq!(weights, [&point.u, &point.v].map(truth::round_f64));
        }
    }
}

/// It settles nearly all: else it would be no use.
#[test]
fn nearly_all_are_settled() {
    let mut rng = Rng::new(3);
    let mut settled = 0;
    for _ in 0..1000 {
        let mut vector = || DVec3::from([(); 3].map(|()| rng.below(1 << 20) as f64 / 1e6));
        let corners = [vector(), vector(), vector()];
        let o = vector() - 5.0;
        let target = corners[0] * 0.3 + corners[1] * 0.3 + corners[2] * 0.4;
        let found = Twofolds::new(&corners, o, target - o).expect("usual");
        settled += u32::from(found.distance().is_some() && found.weights().is_some());
    }
    assert!(settled > 990, "{settled}");
}

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::generate::{Rng, Source};
use crate::geom::truth::{self, Meeting};

fn vector() -> impl Strategy<Value = DVec3> {
    let few = vec![0.0, 1.0, -1.0, 0.5, 3.0, 1e-130, -1e-300, 0.1, 5e-324];
    let number = || prop_oneof![1 => prop::sample::select(few.clone()), 2 => -2.0..2.0f64];
    [number(), number(), number()].prop_map(DVec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// No answer that is certain is another than that of rational arithmetic. [EXACT-10]
    #[test]
    fn what_is_certain_is_the_truth(
        corners in [vector(), vector(), vector()], o in vector(), d in vector(),
        scales in prop::sample::select(vec![[0, 0], [100, -100], [-190, 150], [198, 0], [-100, -199], [-500, 0], [0, -900]]),
        shift in prop::sample::select(vec![0.0, 0.0, 1e9, 1e15]), is_aimed in any::<bool>(),
    ) {
        let [size, length] = scales.map(|exponent| 2f64.powi(exponent));
        let d = if is_aimed { corners[0] * 0.25 + corners[1] * 0.5 + corners[2] * 0.25 - o } else { d };
        let (corners, o, d) = (corners.map(|v| (v + shift) * size), (o + shift) * size, d * length);
        let found = FineDeterminants::new(&corners, o, d);
        match truth::meet(corners.map(|v| v.to_array()), o.to_array(), d.to_array()) {
            Meeting::Hit(point) => {
                if let Some(t) = found.distance::<f64>() {
                    prop_assert_eq!(t, truth::round_f64(&point.t));
                }
                if let Some(weights) = found.weights::<f64>() {
                    prop_assert_eq!(weights, [&point.u, &point.v].map(truth::round_f64));
                }
            }
            // The determinant is 0, and never certainly another.
            Meeting::Coplanar => prop_assert_eq!((found.distance::<f64>(), found.weights::<f64>()), (None, None)),
            Meeting::Miss => {}
        }
    }
}

/// Nearly all are certain: else it would be no use.
#[test]
fn nearly_all_are_certain() {
    let mut rng = Rng::new(3);
    let mut certain = 0;
    for _ in 0..1000 {
        let mut vector = || DVec3::from([(); 3].map(|()| rng.below(1 << 20) as f64 / 1e6));
        let corners = [vector(), vector(), vector()];
        let o = vector() - 5.0;
        let target = corners[0] * 0.3 + corners[1] * 0.3 + corners[2] * 0.4;
        let found = FineDeterminants::new(&corners, o, target - o);
        certain += u32::from(found.distance::<f64>().is_some() && found.weights::<f64>().is_some());
    }
    assert!(certain > 990, "{certain}");
}

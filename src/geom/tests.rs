//! Helpers of tests against rational arithmetic: numbers at the thresholds of the format, and their exact values.

use glam::DVec3;
use proptest::prelude::*;

use super::truth::RBig;
use super::{Frame, Interval};
use crate::generate::draw::Draw;

/// Draws doubles at thresholds, like [`Draw::threshold`].
pub(crate) fn threshold() -> impl Strategy<Value = f64> + Clone {
    any::<u64>().prop_map(|seed| Draw::new(seed).threshold())
}

/// Draws floats at thresholds.
pub(crate) fn threshold_in_single() -> impl Strategy<Value = f32> + Clone {
    any::<u64>().prop_map(|seed| Draw::new(seed).threshold_in_single())
}

/// Returns the exact value of a finite number.
pub(crate) fn exact(x: impl Into<f64>) -> RBig {
    RBig::try_from(x.into()).expect("a finite number")
}

/// Returns whether a number is between the ends.
pub(crate) fn holds(interval: Interval, x: &RBig) -> bool {
    let [lo, hi] = interval.ends();
    let is_above = RBig::try_from(lo).map_or(lo == f64::NEG_INFINITY, |lo| lo <= *x);
    is_above && RBig::try_from(hi).map_or(hi == f64::INFINITY, |hi| *x <= hi)
}

/// Returns the interval between two numbers.
pub(crate) fn sorted([x, y]: [f64; 2]) -> Interval {
    Interval::between(if x <= y { [x, y] } else { [y, x] })
}

/// Draws the exponent of a frame. Half of the exponents scale the number to a threshold.
pub(crate) fn exponent(draw: &mut Draw, x: f64) -> i32 {
    let place = [-1074, -1022, 1023, 0][draw.below(4)] - super::frame::exponent_of(x.abs()) + draw.int(2) as i32;
    let any = draw.int(Frame::MAX_EXPONENT) as i32;
    if draw.one_in(2) { any } else { place.clamp(-Frame::MAX_EXPONENT, Frame::MAX_EXPONENT) }
}

/// Draws vectors from a few numbers at thresholds, up to a magnitude, so coordinates often coincide.
pub(crate) fn vectors<const N: usize>(draw: &mut Draw, most: f64, number: fn(&mut Draw) -> f64) -> [DVec3; N] {
    let mut small = || loop {
        let x = number(draw);
        if x.abs() <= most {
            return x;
        }
    };
    let pool = [0.0, small(), small(), small(), small()];
    [(); N].map(|()| DVec3::from([(); 3].map(|()| pool[draw.below(pool.len())])))
}

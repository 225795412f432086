//! A test that detects only misses by a wide margin: a thousand times the rounding error and more.

use std::ops::RangeInclusive;

use super::Corners;
use crate::geom::{Ray, Vector};

/// A box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) lo: [f64; 3],
    pub(super) hi: [f64; 3],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };

    pub(super) fn of<V: Vector>(corners: &Corners<V>) -> Self {
        corners.iter().map(|corner| corner.map(Into::into)).fold(Self::EMPTY, Self::grow)
    }

    pub(super) fn grow(self, point: [f64; 3]) -> Self {
        self.union(Self { lo: point, hi: point })
    }

    pub(super) fn union(self, other: Self) -> Self {
        let each = |f: fn(f64, f64) -> f64, a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| f(a[k], b[k]));
        Self { lo: each(f64::min, self.lo, other.lo), hi: each(f64::max, self.hi, other.hi) }
    }

    pub(super) fn middle(&self) -> [f64; 3] {
        std::array::from_fn(|axis| 0.5 * (self.lo[axis] + self.hi[axis]))
    }
}

/// A ray with tests for misses by a wide margin.
pub(super) struct ConservativeCull {
    origin: [f64; 3],
    direction: [f64; 3],
    tmin: f64,
    tmax: f64,
    /// Whether the nonzero components of the direction are in [`RANGE`].
    in_range: bool,
}

/// The tests do not overflow for numbers in this range, which includes all numbers of single precision.
const RANGE: RangeInclusive<f64> = f64::from_bits((1023 - 400) << 52)..=f64::from_bits((1023 + 400) << 52);

/// 2^-600.
const LEAST: f64 = f64::from_bits((1023 - 600) << 52);

impl ConservativeCull {
    pub(super) fn new<V: Vector>(ray: &Ray<V>) -> Self {
        let [origin, direction] = [ray.origin(), ray.direction()].map(|x| x.widen().to_array());
        Self::along(origin, direction, [ray.tmin().into(), ray.tmax().into()])
    }

    /// Prepares a ray. The origin may be rounded; the margin covers this.
    pub(super) fn along(origin: [f64; 3], direction: [f64; 3], [tmin, tmax]: [f64; 2]) -> Self {
        let in_range = direction.into_iter().all(|x| x == 0.0 || RANGE.contains(&x.abs()));
        Self { origin, direction, tmin, tmax, in_range }
    }

    /// Returns a lower bound of the distance at which the ray enters a box. Never `None` for a box that it touches.
    ///
    /// The box is enlarged by a margin of 10^-9 of the greatest coordinate `m` involved. Rounding moves a plane of it,
    /// relative to the ray, by less than 10^-15 `m`: 1.1 units of 2^-53 for the addition of the margin, 2.1 for the
    /// subtraction of the origin, and 2.1 for the quotient, whose numerator is below 2.1 `m`. So the margin is a
    /// million times the necessary one, and a ray that touches the box at some `t` has `near <= t <= far` on every
    /// axis.
    ///
    /// `m` and the direction's components must be 0 or from 2^-400 to 2^400; otherwise no box is missed. So nothing
    /// overflows, and no NaN occurs: differences are below 2^402, quotients below 2^803. Sums and differences do not
    /// underflow. A quotient may, by 2^-1075; but the margin, over a component of the direction, is above 2^-830.
    pub(super) fn entry(&self, bounds: &Bounds) -> Option<f64> {
        let Self { origin: o, direction: d, .. } = self;
        let Bounds { lo, hi } = bounds;
        let greatest = [o, lo, hi].into_iter().flatten().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
        if !self.in_range || greatest != 0.0 && !RANGE.contains(&greatest) {
            return Some(self.tmin);
        }
        let margin = 1e-9 * greatest;
        let (mut near, mut far) = (self.tmin, self.tmax);
        for k in 0..3 {
            let (lo, hi) = (lo[k] - margin, hi[k] + margin);
            if d[k] == 0.0 {
                if o[k] < lo || hi < o[k] {
                    return None;
                }
            } else {
                let (t1, t2) = ((lo - o[k]) / d[k], (hi - o[k]) / d[k]);
                near = near.max(t1.min(t2));
                far = far.min(t1.max(t2));
            }
        }
        (near <= far).then_some(near)
    }

    /// Returns whether a box that the ray enters at `near` is beyond its end.
    pub(super) fn ends_before(&self, near: f64) -> bool {
        near > self.tmax
    }

    /// Shortens the ray to the hits whose rounded distance is at most this. The rounding error of a distance is a
    /// millionth, or less than 10^-44.
    pub(super) fn end_by(&mut self, rounded: f64) {
        self.tmax = self.tmax.min((rounded * 1.001).max(1e-30));
    }

    /// Returns whether the ray certainly misses a triangle: false for every triangle that the ray's line meets.
    ///
    /// With corners a, b, c relative to the origin, the line meets the triangle only if d·(a × b), d·(b × c) and d·(c ×
    /// a) do not have both signs. Each is a sum of six products, whose sizes add up to at most `size`, where every
    /// difference is replaced by the sum of its operands' sizes. Rounding changes it by less than 10^-14 `size`: by 4
    /// units of 2^-53 for two differences and the rounding of the origin in each, and by 5 more for products and sums.
    /// So a sign is certain from 10^-9 `size` on, which is a hundred thousand times the necessary margin.
    ///
    /// Nothing overflows if `size` is finite. Below 2^-600 nothing is certain: the error of a product that underflows
    /// is 2^-1075, and 2^-675 after multiplication with the direction, which is below 2^400.
    pub(super) fn misses_triangle<V: Vector>(&self, corners: &Corners<V>) -> bool {
        if !self.in_range {
            return false;
        }
        let (o, d) = (self.origin, self.direction);
        let corners: [[f64; 3]; 3] = corners.map(|corner| corner.map(Into::into));
        let from_origin = corners.map(|corner| [0, 1, 2].map(|k| corner[k] - o[k]));
        let sizes = corners.map(|corner| [0, 1, 2].map(|k| corner[k].abs() + o[k].abs()));
        let (mut is_left, mut is_right) = (false, false);
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b, a_size, b_size) = (from_origin[i], from_origin[j], sizes[i], sizes[j]);
            let (mut side, mut size) = (0.0, 0.0);
            for (x, y, z) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                side += d[x] * (a[y] * b[z] - a[z] * b[y]);
                size += d[x].abs() * (a_size[y] * b_size[z] + a_size[z] * b_size[y]);
            }
            let is_certain = size >= LEAST && side.abs() > 1e-9 * size;
            is_left |= is_certain && side > 0.0;
            is_right |= is_certain && side < 0.0;
        }
        is_left && is_right
    }
}

//! A ray with its interval, valid by construction.

use glam::Vec3;

/// A half-line `origin + t direction` with `tmin <= t <= tmax`, both ends included.
///
/// The direction need not have unit length; `t` is measured in its lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    origin: Vec3,
    direction: Vec3,
    tmin: f32,
    tmax: f32,
}

/// Why numbers are not a ray.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RayError {
    /// A component of the origin is NaN or infinite.
    #[error("origin {0} is not finite")]
    Origin(Vec3),
    /// A component of the direction is NaN or infinite.
    #[error("direction {0} is not finite")]
    Direction(Vec3),
    /// All components of the direction are zero.
    #[error("direction is zero")]
    ZeroDirection,
    /// An end of the interval is NaN, or the near end is not finite.
    #[error("interval [{tmin}, {tmax}] is not a number")]
    Interval {
        /// Near end.
        tmin: f32,
        /// Far end.
        tmax: f32,
    },
    /// The near end is negative.
    #[error("tmin {0} is negative")]
    NegativeTmin(f32),
    /// The interval is empty.
    #[error("tmin {tmin} is greater than tmax {tmax}")]
    EmptyInterval {
        /// Near end.
        tmin: f32,
        /// Far end.
        tmax: f32,
    },
}

impl Ray {
    /// A ray over the given interval. `tmax` may be infinite.
    ///
    /// # Errors
    /// What [`RayError`] lists.
    pub fn new(origin: Vec3, direction: Vec3, tmin: f32, tmax: f32) -> Result<Self, RayError> {
        if !origin.is_finite() {
            return Err(RayError::Origin(origin));
        }
        if !direction.is_finite() {
            return Err(RayError::Direction(direction));
        }
        if direction == Vec3::ZERO {
            return Err(RayError::ZeroDirection);
        }
        if !tmin.is_finite() || tmax.is_nan() {
            return Err(RayError::Interval { tmin, tmax });
        }
        if tmin < 0.0 {
            return Err(RayError::NegativeTmin(tmin));
        }
        if tmin > tmax {
            return Err(RayError::EmptyInterval { tmin, tmax });
        }
        Ok(Self { origin, direction, tmin, tmax })
    }

    /// Where `t` is 0.
    #[inline]
    pub const fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Finite and not zero.
    #[inline]
    pub const fn direction(&self) -> Vec3 {
        self.direction
    }

    /// Near end of the interval, at least 0.
    #[inline]
    pub const fn tmin(&self) -> f32 {
        self.tmin
    }

    /// Far end of the interval, at least `tmin`.
    #[inline]
    pub const fn tmax(&self) -> f32 {
        self.tmax
    }

    /// Bit `a` is set where component `a` of the direction is negative; for [`SignOrder`](crate::order::SignOrder).
    #[inline]
    pub fn octant(&self) -> u8 {
        self.direction.cmplt(Vec3::ZERO).bitmask() as u8
    }
}

//! A ray with its interval, valid by construction.

use glam::{DVec3, Vec3};

use super::{EnvironmentError, Real, Vector, check_environment};

/// A half-line `origin + t direction`, or the part of it with `tmin <= t <= tmax`, both ends included. It is in single
/// precision, or with [`DVec3`] in double precision.
///
/// The direction need not have unit length; `t` is in units of its length.
///
/// ```
/// use stackless_bvh::geom::{Ray, RayError};
/// use stackless_bvh::glam::Vec3;
///
/// let ray = Ray::new(Vec3::ZERO, Vec3::X)?;
/// assert_eq!((ray.tmin(), ray.tmax()), (0.0, f32::INFINITY));
/// // From a surface to a light, without the two end points.
/// let shadow = Ray::within(Vec3::ZERO, Vec3::X, 1e-3, 0.999)?;
/// assert_eq!((shadow.tmin(), shadow.tmax()), (1e-3, 0.999));
/// assert_eq!(Ray::new(Vec3::ZERO, Vec3::ZERO), Err(RayError::ZeroDirection));
/// # Ok::<(), RayError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<V: Vector = Vec3> {
    origin: V,
    direction: V,
    tmin: V::Real,
    tmax: V::Real,
}

/// Errors of the constructors of [`Ray`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RayError {
    /// A component of the origin is NaN or infinite.
    #[error("origin {0} is not finite")]
    Origin(DVec3),
    /// A component of the direction is NaN or infinite.
    #[error("direction {0} is not finite")]
    Direction(DVec3),
    /// All components of the direction are zero.
    #[error("direction is zero")]
    ZeroDirection,
    /// An end of the interval is NaN, or the near end is not finite.
    #[error("interval [{tmin}, {tmax}] is not a number")]
    Interval {
        /// Near end.
        tmin: f64,
        /// Far end.
        tmax: f64,
    },
    /// The near end is negative.
    #[error("tmin {0} is negative")]
    NegativeTmin(f64),
    /// The interval is empty.
    #[error("tmin {tmin} is greater than tmax {tmax}")]
    EmptyInterval {
        /// Near end.
        tmin: f64,
        /// Far end.
        tmax: f64,
    },
    /// This thread's floating-point arithmetic is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<V: Vector> Ray<V> {
    /// Creates a ray from its origin to infinity.
    ///
    /// # Errors
    /// [`RayError`], for origin and direction.
    pub fn new(origin: V, direction: V) -> Result<Self, RayError> {
        Self::within(origin, direction, V::Real::default(), V::Real::INFINITY)
    }

    /// Creates a ray over the given interval. `tmax` may be infinite.
    ///
    /// # Errors
    /// [`RayError`].
    #[inline]
    pub fn within(origin: V, direction: V, tmin: V::Real, tmax: V::Real) -> Result<Self, RayError> {
        let ray = Self { origin, direction, tmin, tmax };
        if check_environment().is_ok() && ray.is_valid() { Ok(ray) } else { Err(ray.fault()) }
    }

    /// Creates many rays, each from origin, direction, `tmin` and `tmax`. This takes less time than [`Self::within`],
    /// because the arithmetic of the thread is checked once.
    ///
    /// ```
    /// use stackless_bvh::geom::{Ray, RayError};
    /// use stackless_bvh::glam::Vec3;
    ///
    /// let toward = |z| (Vec3::ZERO, Vec3::Z * z, 0.0, 1.0);
    /// assert_eq!(Ray::collect([toward(2.0)]), Ok(vec![Ray::within(Vec3::ZERO, Vec3::Z * 2.0, 0.0, 1.0)?]));
    /// assert_eq!(Ray::collect([toward(2.0), toward(0.0)]), Err((1, RayError::ZeroDirection)));
    /// # Ok::<(), RayError>(())
    /// ```
    ///
    /// # Errors
    /// The index of the first invalid ray, and its [`RayError`].
    pub fn collect(rays: impl IntoIterator<Item = (V, V, V::Real, V::Real)>) -> Result<Vec<Self>, (usize, RayError)> {
        check_environment().map_err(|error| (0, error.into()))?;
        let rays = rays.into_iter();
        // `collect` of results has no room at first.
        let mut all = Vec::with_capacity(rays.size_hint().0);
        for (origin, direction, tmin, tmax) in rays {
            let ray = Self { origin, direction, tmin, tmax };
            if !ray.is_valid() {
                return Err((all.len(), ray.fault()));
            }
            all.push(ray);
        }
        Ok(all)
    }

    /// Returns whether the ray is valid, by one branch.
    #[inline(always)]
    #[allow(clippy::needless_bitwise_bool, reason = "`&&` would be a branch each")]
    fn is_valid(&self) -> bool {
        let Self { origin, direction, tmin, tmax } = *self;
        origin.is_finite()
            & direction.is_finite()
            & (direction.widen() != DVec3::ZERO)
            & (tmin >= V::Real::default())
            & (tmin < V::Real::INFINITY)
            & (tmin <= tmax)
    }

    /// Returns what is wrong with the thread or with the invalid ray. Apart, so that valid rays stay in registers.
    #[cold]
    fn fault(self) -> RayError {
        let Self { origin, direction, .. } = self;
        let [tmin, tmax]: [f64; 2] = [self.tmin.into(), self.tmax.into()];
        if let Err(error) = check_environment() {
            return error.into();
        }
        if !origin.is_finite() {
            RayError::Origin(origin.widen())
        } else if !direction.is_finite() {
            RayError::Direction(direction.widen())
        } else if direction.widen() == DVec3::ZERO {
            RayError::ZeroDirection
        } else if !tmin.is_finite() || tmax.is_nan() {
            RayError::Interval { tmin, tmax }
        } else if tmin < 0.0 {
            RayError::NegativeTmin(tmin)
        } else {
            RayError::EmptyInterval { tmin, tmax }
        }
    }

    /// Returns the point at `t` = 0.
    #[inline]
    pub const fn origin(&self) -> V {
        self.origin
    }

    /// Returns the direction, which is finite and not zero.
    #[inline]
    pub const fn direction(&self) -> V {
        self.direction
    }

    /// Returns the near end of the interval, at least 0.
    #[inline]
    pub const fn tmin(&self) -> V::Real {
        self.tmin
    }

    /// Returns the far end of the interval, at least `tmin`.
    #[inline]
    pub const fn tmax(&self) -> V::Real {
        self.tmax
    }

    /// Converts the ray to double precision, exactly.
    pub(super) fn widen(&self) -> Ray<DVec3> {
        let Self { origin, direction, tmin, tmax } = *self;
        Ray { origin: origin.widen(), direction: direction.widen(), tmin: tmin.into(), tmax: tmax.into() }
    }

    /// Returns a mask whose bit `a` is set if component `a` of the direction is negative; for
    /// [`SignOrder`](crate::order::SignOrder).
    #[inline]
    pub fn octant(&self) -> u8 {
        self.direction.widen().cmplt(DVec3::ZERO).bitmask() as u8
    }
}

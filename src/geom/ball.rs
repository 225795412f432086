//! A point with a radius, valid by construction.

use glam::{DVec3, Vec3};

use super::{EnvironmentError, Real, Vector, check_environment};

/// All points within a radius of a center, the border included: the range of a nearest-point query. It is in single
/// precision, or with [`DVec3`] in double precision.
///
/// ```
/// use stackless_bvh::geom::{Ball, BallError};
/// use stackless_bvh::glam::Vec3;
///
/// assert_eq!(Ball::around(Vec3::X)?.radius(), f32::INFINITY);
/// assert_eq!(Ball::new(Vec3::X, -1.0), Err(BallError::Radius(-1.0)));
/// # Ok::<(), BallError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball<V: Vector = Vec3> {
    center: V,
    radius: V::Real,
}

/// Errors of the constructors of [`Ball`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BallError {
    /// A coordinate is NaN or infinite.
    #[error("point {0} is not finite")]
    Center(DVec3),
    /// The radius is negative or NaN.
    #[error("radius {0} is negative or not a number")]
    Radius(f64),
    /// This thread's floating-point arithmetic is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<V: Vector> Ball<V> {
    /// Creates a ball of infinite radius around a point.
    ///
    /// # Errors
    /// [`BallError::Center`].
    pub fn around(center: V) -> Result<Self, BallError> {
        Self::new(center, V::Real::INFINITY)
    }

    /// Creates a ball. The radius may be 0, and infinite.
    ///
    /// # Errors
    /// [`BallError`].
    pub fn new(center: V, radius: V::Real) -> Result<Self, BallError> {
        check_environment()?;
        if !center.is_finite() {
            return Err(BallError::Center(center.widen()));
        }
        let length: f64 = radius.into();
        if length.is_nan() || length < 0.0 {
            return Err(BallError::Radius(length));
        }
        Ok(Self { center, radius })
    }

    /// Returns the center, which is finite.
    pub const fn center(&self) -> V {
        self.center
    }

    /// Returns the radius, which is not negative; it is infinite for the whole space.
    pub const fn radius(&self) -> V::Real {
        self.radius
    }
}

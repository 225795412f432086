//! A point with a radius, valid by construction.

use glam::{DVec3, Vec3};

use super::{EnvironmentError, Real, Vector, check_environment};

/// All points within a radius of one, the border included: where what is nearest is looked for. In single precision,
/// or with [`DVec3`] in double.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::geom::{Ball, BallError};
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

/// Why numbers are not a ball.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BallError {
    /// A coordinate is NaN or infinite.
    #[error("point {0} is not finite")]
    Center(DVec3),
    /// The radius is negative or NaN.
    #[error("radius {0} is negative or not a number")]
    Radius(f64),
    /// This thread's floats are not those of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<V: Vector> Ball<V> {
    /// The whole space, around a point.
    ///
    /// # Errors
    /// [`BallError::Center`].
    pub fn around(center: V) -> Result<Self, BallError> {
        Self::new(center, V::Real::INFINITY)
    }

    /// A ball. The radius may be 0, and infinite.
    ///
    /// # Errors
    /// What [`BallError`] lists.
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

    /// Its middle, finite.
    pub const fn center(&self) -> V {
        self.center
    }

    /// Not negative; infinite for the whole space.
    pub const fn radius(&self) -> V::Real {
        self.radius
    }
}

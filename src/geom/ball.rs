//! A point with a radius, valid by construction.

use glam::Vec3;

use super::{EnvironmentError, check_environment};

/// All points within a radius of one, the border included: where what is nearest is looked for.
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
pub struct Ball {
    center: Vec3,
    radius: f32,
}

/// Why numbers are not a ball.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BallError {
    /// A coordinate is NaN or infinite.
    #[error("point {0} is not finite")]
    Center(Vec3),
    /// The radius is negative or NaN.
    #[error("radius {0} is negative or not a number")]
    Radius(f32),
    /// This thread's floats are not those of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl Ball {
    /// The whole space, around a point.
    ///
    /// # Errors
    /// [`BallError::Center`].
    pub fn around(center: Vec3) -> Result<Self, BallError> {
        Self::new(center, f32::INFINITY)
    }

    /// A ball. The radius may be 0, and infinite.
    ///
    /// # Errors
    /// What [`BallError`] lists.
    pub fn new(center: Vec3, radius: f32) -> Result<Self, BallError> {
        check_environment()?;
        if !center.is_finite() {
            return Err(BallError::Center(center));
        }
        if radius.is_nan() || radius < 0.0 {
            return Err(BallError::Radius(radius));
        }
        Ok(Self { center, radius })
    }

    /// Its middle, finite.
    pub const fn center(&self) -> Vec3 {
        self.center
    }

    /// Not negative; infinite for the whole space.
    pub const fn radius(&self) -> f32 {
        self.radius
    }
}

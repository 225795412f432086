//! Floating-point arithmetic of a thread.

use std::hint::black_box;

/// Errors of [`check_environment`]: this thread's arithmetic is not that of IEEE 754, which every exact answer
/// requires.
///
/// Processors can use other arithmetic, separately for each thread. A library that was compiled with `-ffast-math`
/// changes it when it is loaded, and threads inherit the change. `[ENV-1]`
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EnvironmentError {
    /// Numbers below the least normal number are flushed to zero, as operands or as results.
    #[error("this thread takes subnormal numbers for zero (was a library compiled with -ffast-math?)")]
    Subnormals,
    /// Sums are not rounded to the nearest float.
    #[error("this thread does not round to the nearest float")]
    Rounding,
}

/// Checks that this thread keeps subnormal numbers and rounds to the nearest float, in both precisions.
///
/// It takes some nanoseconds: six additions. Rays, balls, hierarchies and the parallel queries call it and return its
/// error. A program that makes rays on one thread and traces them on another thread, which this library did not start,
/// calls it there. `[ENV-1]`
///
/// ```
/// assert_eq!(stackless_bvh::geom::check_environment(), Ok(()));
/// ```
///
/// # Errors
/// [`EnvironmentError`].
#[inline(never)]
pub fn check_environment() -> Result<(), EnvironmentError> {
    // A quarter and three quarters of a unit in the last place of 1: only rounding to nearest takes one down and the
    // other up. The sum of two subnormal numbers is subnormal too. Multiplications would take longer.
    let singles = [[1.0, f32::EPSILON * 0.25], [1.0, f32::EPSILON * 0.75], [f32::from_bits(0x0030_0000); 2]];
    let [down, up, subnormal] = singles.map(|[a, b]| (black_box(a) + black_box(b)).to_bits());
    let single = [subnormal ^ 0x0060_0000, (down ^ 0x3F80_0000) | (up ^ 0x3F80_0001)];
    let doubles = [[1.0, f64::EPSILON * 0.25], [1.0, f64::EPSILON * 0.75], [f64::from_bits(0x0006 << 48); 2]];
    let [down, up, subnormal] = doubles.map(|[a, b]| (black_box(a) + black_box(b)).to_bits());
    let double = [subnormal ^ (0x000C << 48), (down ^ (0x3FF0 << 48)) | (up ^ (0x3FF0 << 48 | 1))];
    match [0, 1].map(|i| u64::from(single[i]) | double[i]) {
        [0, 0] => Ok(()),
        [0, _] => Err(EnvironmentError::Rounding),
        _ => Err(EnvironmentError::Subnormals),
    }
}

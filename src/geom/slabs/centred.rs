//! The textbook slab test, with one reciprocal for both planes of an axis.

use glam::{Vec3, Vec4};

use super::{Intervals, Slabs, near_and_far};
use crate::geom::{Ray, Region};

/// The common form of the slab test (Kay & Kajiya 1986; Williams et al. 2005): fast, and it leaks.
///
/// The distance to a plane takes three roundings, so a ray through an edge or a corner of a box may miss it.
pub type Plain = Centred<false>;

/// [`Plain`] with the near distance moved down by 3 units of 2^-24 and the far distance up by 4 (after Ize 2013,
/// "Robust BVH ray traversal", whose 2 ulps on one side are not enough). `[BOX-5]`
///
/// It skips no box that the ray touches if coordinates are at most 2^126, `|b - o| >= 2^-125` or `b = o` for each
/// plane `b` and the origin `o`, and the direction has a greatest component between 1 and 2 and others that are 0 or
/// at least 2^-126.
pub type TwoSided = Centred<true>;

/// [`Plain`] or [`TwoSided`].
#[derive(Clone, Copy, Debug)]
pub struct Centred<const PADDED: bool> {
    // Each component in all four lanes.
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    tmin: f32,
}

/// The factors 1 - 3u and 1 + 4u with u = 2^-24 of near and far distances. With 1 - 2u or 1 + 2u, a ray may miss a box
/// that it touches.
pub const PADDING: [f32; 2] = [1.0 - 1.5 * f32::EPSILON, 1.0 + 2.0 * f32::EPSILON];

impl<const PADDED: bool> Centred<PADDED> {
    const DOWN: f32 = if PADDED { PADDING[0] } else { 1.0 };
    const UP: f32 = if PADDED { PADDING[1] } else { 1.0 };
}

impl<const PADDED: bool> Slabs for Centred<PADDED> {
    type Vector = Vec3;

    #[inline]
    fn new(ray: &Ray, _: &Region) -> Self {
        let inverse = ray.direction().recip();
        // Positive infinity, also for -0: then an origin on a plane makes a NaN only where it is dropped.
        let inverse = Vec3::select(inverse.is_finite_mask(), inverse, Vec3::INFINITY);
        Self {
            origin: ray.origin().to_array().map(Vec4::splat),
            inverse: inverse.to_array().map(Vec4::splat),
            tmin: ray.tmin(),
        }
    }

    #[inline(always)]
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f32) -> Intervals<f32> {
        let [near, far] = near_and_far(planes, &self.origin, &self.inverse, self.tmin, tmax);
        let (near, far) = if PADDED { (near * Self::DOWN, far * Self::UP) } else { (near, far) };
        Intervals::of_lanes([near, far])
    }
}

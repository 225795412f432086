//! The slab test that skips no box which the ray touches, at no cost.

use glam::{Vec3, Vec4, Vec4Swizzles};

use super::{Slabs, Wide, near_and_far, twice};
use crate::geom::{Aabb, Ray, Region, Vector};

/// The slab test with a reciprocal for the near plane of each axis that is too small, and one for the far plane that
/// is too great: no box is skipped that the exact closed interval of the ray touches. `[BOX-1]`
///
/// The distance to a plane takes four roundings: reciprocal, its move, difference, product. The move makes up for all
/// of them, so a near distance is never above the exact one, and a far distance never below. As which plane is the near
/// one depends on the ray alone, the two reciprocals stand in the lanes of lo and hi where they are needed, and the test
/// takes the very instructions of [`Plain`](super::Plain).
///
/// Distances are in units of 2^-55, so that no product underflows. Rays for which one might overflow go to [`Wide`].
#[derive(Clone, Copy, Debug)]
pub struct Directed {
    origin: [Vec4; 3],
    /// Lanes of lo and hi, twice.
    inverse: [Vec4; 3],
    tmin: f32,
    is_wide: bool,
    ray: Ray,
}

/// A near reciprocal is moved down by so many times 2^-24. With half, a ray through the corner of a box may miss it.
pub(super) const NEAR: f64 = 4.0;

/// A far reciprocal is moved up by so many times 2^-24.
pub(super) const FAR: f64 = 6.0;

const DOWN: f32 = 1.0 - NEAR as f32 * (f32::EPSILON / 2.0);
const UP: f32 = 1.0 + FAR as f32 * (f32::EPSILON / 2.0);

const fn power_of_two(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent) as u32) << 23)
}

/// Number of units in 1.
const SCALE: f32 = power_of_two(55);

/// Greatest magnitude of a coordinate for which no distance along the greatest component of a direction overflows.
const MAX_COORDINATE: f32 = power_of_two(38);

/// Bounds of the greatest component of a direction; one above would let products underflow, one below overflow.
const DIRECTION: [f32; 2] = [power_of_two(-32), power_of_two(31)];

/// Least component of a direction, but for 0, whose reciprocal does not overflow.
const MIN_COMPONENT: f32 = power_of_two(-70);

impl Slabs for Directed {
    type Vector = Vec3;

    #[inline]
    fn new(ray: &Ray, region: &Region) -> Self {
        // Without -0, a component of 0 has the reciprocal +inf: so an origin on a plane makes a NaN only where it is
        // dropped.
        let direction = ray.direction().extend(1.0) + 0.0;
        let origin = ray.origin().extend(0.0);
        let inverse = Vec4::splat(SCALE) / direction;
        let (near, far) = (inverse * DOWN, inverse * UP);
        let backward = direction.cmplt(Vec4::ZERO);
        let (lo, hi) = (Vec4::select(backward, far, near), Vec4::select(backward, near, far));
        let size = direction.abs();
        let greatest = size.x.max(size.y).max(size.z);
        let is_usual = size.cmpge(Vec4::splat(MIN_COMPONENT)) | direction.cmpeq(Vec4::ZERO);
        let is_near = origin.abs().cmple(Vec4::splat(MAX_COORDINATE));
        let is_wide = (is_usual & is_near).bitmask() != 15
            || !(DIRECTION[0]..DIRECTION[1]).contains(&greatest)
            || region.reach() > MAX_COORDINATE;
        let tmin = ray.tmin() * SCALE;
        Self {
            origin: [origin.xxxx(), origin.yyyy(), origin.zzzz()],
            inverse: [
                Vec4::new(lo.x, hi.x, lo.x, hi.x),
                Vec4::new(lo.y, hi.y, lo.y, hi.y),
                Vec4::new(lo.z, hi.z, lo.z, hi.z),
            ],
            // 0 is a lower bound where the product overflows.
            tmin: if tmin < f32::INFINITY { tmin } else { 0.0 },
            is_wide,
            ray: *ray,
        }
    }

    /// Infinite where it overflows. Among subnormal numbers, `t` may have been rounded to below where a box is entered in
    /// the finer units, so all of those stand for the greatest.
    #[inline]
    fn limit(&self, t: f32) -> f32 {
        t.max(f32::MIN_POSITIVE) * SCALE
    }

    #[inline]
    fn one(&self, aabb: &Aabb, limit: f32) -> Option<f32> {
        let ([hit, _], [near, _]) = self.pair(&twice(aabb), limit);
        hit.then_some(near)
    }

    #[inline(always)]
    fn pair(&self, planes: &[[f32; 4]; 3], limit: f32) -> ([bool; 2], [f32; 2]) {
        if self.is_wide {
            return pair_wide(self.ray, planes, limit);
        }
        let [near, far] = near_and_far(planes, &self.origin, &self.inverse, self.tmin, limit);
        let hit = near.cmple(far.yxwz()).bitmask();
        ([hit & 1 != 0, hit & 4 != 0], [near.x, near.z])
    }
}

/// The test in double precision. Rays that need it are so rare that it prepares them anew each time. (The ray is passed
/// by value so that the others need not have theirs in memory.)
#[cold]
#[inline(never)]
fn pair_wide(ray: Ray, planes: &[[f32; 4]; 3], limit: f32) -> ([bool; 2], [f32; 2]) {
    let wide = Wide::of(ray.origin().widen(), ray.direction().widen(), f64::from(ray.tmin()));
    let limit = f64::from(limit) / f64::from(SCALE);
    let (hits, nears) = wide.pair(planes, f64::INFINITY);
    // A hit's distance is rounded to single precision, perhaps to below where its box is entered. Rounding keeps the
    // order, so entries are rounded before they are compared with it.
    let nears = nears.map(|near| near as f32);
    ([0, 1].map(|i| hits[i] && f64::from(nears[i]) <= limit), nears)
}

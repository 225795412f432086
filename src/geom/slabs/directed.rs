//! The slab test that skips no box that the ray touches, without extra cost.

use glam::{Vec3, Vec4, Vec4Swizzles};

use super::entrance::{Entrance, enter_if};
use super::{Intervals, MAX_COORDINATE, MISSED, Slabs, near_and_far};
use crate::geom::{Ray, Region};

/// The slab test with a reciprocal for the near plane of each axis that is too small, and one for the far plane that is
/// too great: it skips no box that the exact closed interval of the ray touches. `[BOX-1]` `[BOX-2]`
///
/// The distance to a plane takes three roundings: reciprocal, difference, product. Moving the reciprocal by two floats
/// compensates the first two, and the third keeps the order. So a near distance is never above the nearest float of the
/// exact distance, and a far distance never below. That suffices, because the distances of hits are also rounded to the
/// nearest float. The near plane depends on the ray alone, so the two reciprocals are in the lanes of lo and hi where
/// they are needed, and the test has exactly the instructions of [`Plain`](super::Plain).
///
/// Directions may be of any size. Some rays are tested from their entry into the region: those with a component (other
/// than 0) whose reciprocal overflows, those with coordinates beyond 2^126 or distances that overflow, and those from
/// far away. `[BOX-9]`
#[derive(Clone, Copy, Debug)]
pub struct Directed {
    origin: [Vec4; 3],
    /// Lanes of lo and hi, twice.
    inverse: [Vec4; 3],
    tmin: f32,
    is_wide: bool,
    direction: Vec3,
    /// The entrance of wide rays.
    entrance: Entrance,
}

/// Floats by which a reciprocal is moved. With 1, a ray through the edge of a box may miss it. `[BOX-4]`
pub const STEPS: u32 = 2;

/// Returns whether single precision does not suffice for the boxes that a ray meets. Differences or all distances may
/// overflow. Or the ray comes from far away, where rounding moves it by more than the size of boxes. Or a reciprocal
/// overflows, and the ray leaves a plane so slowly that it would seem to stay in it. The fourth lane of the origin is 0.
#[inline(always)]
pub(in crate::geom) fn is_beyond_single(origin: Vec4, direction: Vec4, inverse: Vec4, region: &Region) -> bool {
    let [middle, far, short] = region.near();
    let is_near = origin.abs().cmple(Vec4::splat(MAX_COORDINATE)) & (origin - middle).abs().cmple(far);
    let is_usual = is_near & (inverse.abs().cmplt(Vec4::MAX) | direction.cmpeq(Vec4::ZERO));
    let is_short = direction.abs().cmplt(short);
    is_usual.bitmask() != 15 || is_short.bitmask() == 15 || region.reach() > f64::from(MAX_COORDINATE)
}

/// Returns the reciprocals of a direction without -0: the nearest ones; [`STEPS`] floats nearer to zero, for near
/// planes; and [`STEPS`] floats farther from zero, for far planes. The last are valid if the nearest ones are less than
/// `f32::MAX`, or infinite for a component of 0.
#[inline(always)]
pub(in crate::geom) fn reciprocals(direction: Vec4) -> [Vec4; 3] {
    let inverse = Vec4::ONE / direction;
    let moved = |by: i32| Vec4::from(inverse.to_array().map(|i| f32::from_bits(i.to_bits().wrapping_add_signed(by))));
    let is_zero = direction.cmpeq(Vec4::ZERO);
    [inverse, moved(-(STEPS as i32)), Vec4::select(is_zero, Vec4::INFINITY, moved(STEPS as i32))]
}

impl Slabs for Directed {
    type Vector = Vec3;

    #[inline]
    fn new(ray: &Ray, region: &Region) -> Self {
        // Without -0, a component of 0 has the reciprocal +inf: so an origin on a plane makes a NaN only where it is
        // dropped.
        let direction = ray.direction().extend(1.0) + 0.0;
        let origin = ray.origin().extend(0.0);
        let [inverse, near, far] = reciprocals(direction);
        let backward = direction.cmplt(Vec4::ZERO);
        let (lo, hi) = (Vec4::select(backward, far, near), Vec4::select(backward, near, far));
        let is_wide = is_beyond_single(origin, direction, inverse, region);
        Self {
            origin: [origin.xxxx(), origin.yyyy(), origin.zzzz()],
            inverse: [
                Vec4::new(lo.x, hi.x, lo.x, hi.x),
                Vec4::new(lo.y, hi.y, lo.y, hi.y),
                Vec4::new(lo.z, hi.z, lo.z, hi.z),
            ],
            tmin: ray.tmin(),
            is_wide,
            direction: ray.direction(),
            entrance: enter_if(is_wide, ray, region),
        }
    }

    #[inline(always)]
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f32) -> Intervals<f32> {
        let lanes = if self.is_wide {
            [Vec4::from_array(pair_wide(self.entrance, self.direction, self.tmin, planes, tmax)); 2]
        } else {
            near_and_far(planes, &self.origin, &self.inverse, self.tmin, tmax)
        };
        Intervals::of_lanes(lanes)
    }
}

/// Tests from the entry of a ray into the region: near and far of the first box, then of the second. Rays that need it
/// are so rare that it prepares them again each time. (It takes numbers, so the other rays need not be in memory as a
/// whole. Its results fit registers, so they need not be in memory either.)
#[cold]
#[inline(never)]
fn pair_wide(entrance: Entrance, direction: Vec3, tmin: f32, planes: &[[f32; 4]; 3], tmax: f32) -> [f32; 4] {
    let met = entrance.ray(direction, tmin).pair(planes);
    let lanes = met.map(|met| met.map_or(MISSED, |[near, far]| [near, far.min(tmax)]));
    [lanes[0][0], lanes[0][1], lanes[1][0], lanes[1][1]]
}

#[cfg(test)]
mod tests;

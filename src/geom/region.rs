//! Properties of the whole scene that ray tests need.

use glam::{DVec3, Vec3, Vec3Swizzles as _, Vec4};

use super::frame::power_of_two;
use super::{Aabb, Frame, Ray};

/// Extents of the region that contains all boxes and triangles of a ray test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    reach: f64,
    size: f64,
    bounds: Aabb,
    /// Its greatest magnitude of a coordinate, in the frame.
    reach_in_frame: f32,
    near: Near,
    frame: Frame,
}

/// The range of rays for which single precision suffices, in the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Near {
    /// The center of the box, and 0.
    middle: Vec4,
    /// Points farther from the center on some axis are far.
    far: f32,
    /// For shorter directions, distances from points that are not far to points in the box may overflow, or the
    /// replacement of a component of 0 may have an effect. Infinity in the last lane.
    short: Vec4,
    /// The distances from the center to the sides of the box, rounded.
    half: DVec3,
    /// Rays that start farther from the center on some axis are distant, in single precision.
    afar: f32,
}

/// A direction is also short if all its components are below this. Slab tests in single precision replace a component
/// of 0 by 2^-128 or 2^-126; for short directions the other components are not great enough for this to have no effect.
pub(super) const SHORT: f64 = power_of_two(-102);

/// A ray is distant if it starts farther from the center of the box, on some axis, than this number of times half of
/// the longest edge. In double precision: farther from the origin of the frame than this number of reaches.
pub(super) const NEAR: f64 = 4.0;

/// A bound of all rounding errors in [`Region::is_passed_by`], relative to a coordinate and a component. `[BOX-9]`
const PASSING: f64 = 16.0 * (f64::EPSILON / 2.0);

/// Underflow is negligible against coordinates, and products of a coordinate and a component, from here on.
const USUAL: f64 = power_of_two(-900);

/// A point is far if its distance from the center of the box is more than this number of longest edges.
const FAR: f64 = 8192.0;

impl Region {
    /// Creates the region of a box.
    pub fn of(aabb: &Aabb) -> Self {
        Self::within(Frame::IDENTITY, aabb)
    }

    /// Creates the region of a box in a frame, as all its other boxes are.
    pub fn within(frame: Frame, aabb: &Aabb) -> Self {
        let size = aabb.hi.as_dvec3() - aabb.lo.as_dvec3();
        let unit = power_of_two(frame.exponent());
        let reach = f64::from(aabb.lo.abs().max(aabb.hi.abs()).max_element());
        let size = size.max_element();
        Self {
            reach: reach * unit,
            size: size * unit,
            bounds: *aabb,
            reach_in_frame: reach as f32,
            near: near_of(aabb, size),
            frame,
        }
    }

    /// Returns the greatest magnitude of a coordinate, relative to the origin of the [frame](Self::frame).
    #[inline]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Returns the length of the longest edge of the box, rounded.
    #[inline]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Returns the greatest magnitude of a coordinate in the frame.
    #[inline]
    pub(super) fn reach_in_frame(&self) -> f32 {
        self.reach_in_frame
    }

    /// Returns the center of the box, in the frame; the distance from it, on each axis, up to which single precision
    /// suffices for the box; and the least component of a direction.
    #[inline(always)]
    pub(super) fn near(&self) -> [Vec4; 3] {
        let Near { middle, far, short, .. } = self.near;
        [middle, Vec4::splat(far), short]
    }

    /// Returns the region without near rays: each is tested from its entry. `[BOX-9]`
    pub(crate) fn without_near_rays(self) -> Self {
        let near = Near { far: f32::NEG_INFINITY, ..self.near };
        // In double precision, coordinates in the frame that are not ordinary.
        Self { near, reach_in_frame: self.reach_in_frame.max(power_of_two(100) as f32), ..self }
    }

    /// Returns a region with at least this reach, which is valid for the same boxes and triangles.
    pub(crate) fn reaching(self, reach: f64) -> Self {
        Self { reach: self.reach.max(reach), ..self }
    }

    /// Returns the box, in the frame.
    #[inline]
    pub fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// Returns the frame of the boxes.
    #[inline]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns whether a point, or the uncertainty of its position, is too large on some axis for tests in single
    /// precision.
    #[inline]
    pub(super) fn is_far(&self, point: DVec3, off: f64) -> bool {
        let unit = power_of_two(self.frame.exponent());
        let middle = (self.bounds.lo.as_dvec3() + self.bounds.hi.as_dvec3()) * (0.5 * unit) + self.frame.origin();
        let is_far = (point - middle).abs().max_element() > FAR * self.size || off > self.size / FAR;
        // Every point is far from a box without a size; no test can change this.
        is_far && self.size > 0.0 && self.size < f64::INFINITY
    }

    /// Returns whether a distant ray in single precision certainly misses the box, so that it needs no preparation.
    /// `[BOX-9]`
    #[inline(always)]
    pub(crate) fn is_passed_by_single(&self, ray: &Ray) -> bool {
        // The difference is also that of the preparation of a ray, so near rays make it once.
        let is_near = (ray.origin().extend(0.0) - self.near.middle).abs().cmple(Vec4::splat(self.near.afar)).all();
        !is_near && self.is_missed_by(self.frame.rounded(ray.origin().as_dvec3()), ray.direction().as_dvec3())
    }

    /// Returns whether a distant ray in double precision certainly misses the box. `[BOX-9]`
    #[inline(always)]
    pub(crate) fn is_passed_by(&self, ray: &Ray<DVec3>) -> bool {
        // Coordinates and comparison are also those of the preparation.
        let origin = self.frame.rounded(ray.origin());
        let is_near = origin.abs().max_element() <= NEAR * f64::from(self.reach_in_frame);
        !is_near && self.is_missed_by(origin, ray.direction())
    }

    /// Returns whether a ray, whose rounded origin in the frame is given, certainly misses the box. `false` for tiny
    /// numbers. `[BOX-9]`
    #[inline]
    fn is_missed_by(&self, origin: DVec3, direction: DVec3) -> bool {
        let Near { middle, half, .. } = self.near;
        let start = origin - middle.truncate().as_dvec3();
        let speed = direction.abs();
        let coordinate = start.abs().max_element() + f64::from(self.reach_in_frame);
        let product = coordinate * speed.max_element();
        let of_box = half.zxy() * speed.yzx() + half.yzx() * speed.zxy();
        // The greatest of three numbers: a branch for each axis costs more than the arithmetic.
        let is_beside = (start.cross(direction).abs() - of_box).max_element() > PASSING * product;
        let is_leaving = (direction * DVec3::ONE.copysign(start)).cmpge(DVec3::ZERO);
        let outside = DVec3::select(is_leaving, start.abs() - half, DVec3::ZERO);
        (is_beside || outside.max_element() > PASSING * coordinate) && coordinate.min(product) >= USUAL
    }

    /// Returns the lower and the upper side of the box on each axis, out of the frame. The box is between them. They
    /// are finite.
    pub(super) fn sides(&self) -> [[f64; 3]; 2] {
        let sides = self.frame.leave(&self.bounds).map(|x| x.ends());
        // The region contains no point beyond the greatest double.
        [sides.map(|[lo, _]| lo.max(f64::MIN)), sides.map(|[_, hi]| hi.min(f64::MAX))]
    }

    /// Returns a bound of the distance on any axis from this point to any point of the region.
    #[inline]
    pub fn distance(&self, point: DVec3) -> f64 {
        // Three roundings, each of a unit of 2^-53 at most.
        ((point - self.frame.origin()).abs().max_element() + self.reach) * (1.0 + 2.0 * f64::EPSILON)
    }
}

fn near_of(aabb: &Aabb, size: f64) -> Near {
    if aabb.lo.cmpgt(aabb.hi).any() {
        // No point is far from an empty box.
        let (far, half) = (f32::INFINITY, DVec3::INFINITY);
        return Near { middle: Vec4::ZERO, far, short: Vec4::ZERO, half, afar: far };
    }
    let far = (FAR * size).min(f64::from(f32::MAX));
    // Coordinates are at most 2^126.
    let longest = (far + size).min(power_of_two(127));
    let short = Vec3::splat(((longest / f64::from(f32::MAX)) as f32).max(SHORT as f32)).extend(f32::INFINITY);
    let middle = aabb.lo * 0.5 + aabb.hi * 0.5;
    let half = (aabb.hi.as_dvec3() - middle.as_dvec3()).max(middle.as_dvec3() - aabb.lo.as_dvec3());
    let afar = (NEAR * half.max_element()) as f32;
    Near { middle: middle.extend(0.0), far: far as f32, short, half, afar }
}

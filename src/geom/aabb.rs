//! Axis-aligned boxes, and the slab test that skips no box which the ray touches.
//!
//! The distance to a plane takes three roundings: difference, reciprocal, product. So the near distance is moved
//! down and the far distance up by 6 units of 2^-24 each; then the near distance is a true lower bound, and the
//! closed intervals of ray and box meet in the computation whenever they meet in fact (after Ize 2013, "Robust BVH
//! ray traversal", whose one-sided 2 ulps are not enough). This needs coordinates up to 2^126, `|b - o| >= 2^-100`
//! or `b = o` for each plane `b` and the origin `o`, and a direction whose greatest component is between 1 and 2 and
//! whose others are 0 or at least 2^-126. For other rays the test may err, but it errs alike everywhere:
//!
//! - `near` is monotone under nesting of boxes, for every ray. With a component of 0, the reciprocal is infinite and
//!   an origin on the plane makes a NaN; the order of operands drops it, so the plane does not bound the ray. A
//!   component below 2^-128, whose reciprocal overflows, counts as 0.
//! - [`RaySlabs::one`] and [`RaySlabs::pair`] do the same operations in the same order: for the same box they agree
//!   in every bit.

use glam::{Vec3, Vec4, Vec4Swizzles};

use super::Ray;

/// A box with faces across the axes, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub lo: Vec3,
    /// Greatest coordinates.
    pub hi: Vec3,
}

impl Aabb {
    /// The box of no points: from plus to minus infinity. It must not be given to the slab test, which hits it.
    pub const EMPTY: Self = Self { lo: Vec3::INFINITY, hi: Vec3::NEG_INFINITY };

    /// The smallest box of these points.
    #[inline]
    pub fn of(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |aabb, &point| aabb.grow(point))
    }

    /// The smallest box of this one and a point.
    #[inline]
    #[must_use]
    pub fn grow(self, point: Vec3) -> Self {
        Self { lo: self.lo.min(point), hi: self.hi.max(point) }
    }

    /// The smallest box of both.
    #[inline]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Whether a point is inside or on the boundary.
    #[inline]
    pub fn contains(&self, point: Vec3) -> bool {
        self.lo.cmple(point).all() && point.cmple(self.hi).all()
    }

    /// Whether all of `other` is inside.
    #[inline]
    pub fn encloses(&self, other: &Self) -> bool {
        self.lo.cmple(other.lo).all() && other.hi.cmple(self.hi).all()
    }

    /// Lengths of the edges. Negative for the empty box.
    #[inline]
    pub fn extent(&self) -> Vec3 {
        self.hi - self.lo
    }

    /// Half of the surface area. Meaningless for the empty box.
    #[inline]
    pub fn half_area(&self) -> f32 {
        let e = self.extent();
        (e.x + e.y) * e.z + e.x * e.y
    }

    /// The middle. It does not overflow.
    #[inline]
    pub fn centroid(&self) -> Vec3 {
        self.lo * 0.5 + self.hi * 0.5
    }
}

/// What the slab test needs of a ray, computed once per ray.
#[derive(Clone, Copy, Debug)]
pub struct RaySlabs {
    // Each component in all four lanes, as `pair` wants them.
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    tmin: f32,
}

impl RaySlabs {
    /// 1 - 6u and 1 + 6u with u = 2^-24; both are floats.
    const DOWN: f32 = 1.0 - 3.0 * f32::EPSILON;
    const UP: f32 = 1.0 + 3.0 * f32::EPSILON;

    /// Prepares a ray.
    pub fn new(ray: &Ray) -> Self {
        let inverse = ray.direction().recip();
        // Positive infinity, of -0 too: then an origin on a plane makes a NaN only where it is dropped.
        let inverse = Vec3::select(inverse.is_finite_mask(), inverse, Vec3::INFINITY);
        Self {
            origin: ray.origin().to_array().map(Vec4::splat),
            inverse: inverse.to_array().map(Vec4::splat),
            tmin: ray.tmin(),
        }
    }

    /// Where the ray, up to `tmax`, enters and leaves a box: `[near, far]`, or `None` if it misses.
    ///
    /// `near` is never above the true distance, and `far` never below. They may exceed the ray's own interval by 6
    /// units of 2^-24.
    #[inline]
    pub fn one(&self, aabb: &Aabb, tmax: f32) -> Option<[f32; 2]> {
        let (mut near, mut far) = (self.tmin, tmax);
        for axis in 0..3 {
            let t1 = (aabb.lo[axis] - self.origin[axis].x) * self.inverse[axis].x;
            let t2 = (aabb.hi[axis] - self.origin[axis].x) * self.inverse[axis].x;
            near = greater(lesser(t2, t1), near);
            far = lesser(greater(t1, t2), far);
        }
        let (near, far) = (near * Self::DOWN, far * Self::UP);
        (near <= far).then_some([near, far])
    }

    /// Two boxes at once: which are hit, and `near` of each (meaningless where missed).
    ///
    /// `planes` holds for each axis lo and hi of the first box, then lo and hi of the second (Aila & Laine 2009).
    #[inline]
    pub fn pair(&self, planes: &[[f32; 4]; 3], tmax: f32) -> ([bool; 2], [f32; 2]) {
        let (mut near, mut far) = (Vec4::splat(self.tmin), Vec4::splat(tmax));
        for (axis, &planes) in planes.iter().enumerate() {
            let t = (Vec4::from_array(planes) - self.origin[axis]) * self.inverse[axis];
            let other = t.yxwz();
            // The even lanes have the operands of `one` for near, the odd lanes those for far.
            near = greater4(lesser4(other, t), near);
            far = lesser4(greater4(other, t), far);
        }
        let (near, far) = (near * Self::DOWN, far * Self::UP);
        let hit = near.cmple(far.yxwz()).bitmask();
        ([hit & 1 != 0, hit & 4 != 0], [near.x, near.z])
    }
}

/// The lesser number; `b` if either is NaN.
#[inline]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater number; `b` if either is NaN.
#[inline]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// [`lesser`] in each lane. `Vec4::min` leaves open what becomes of a NaN; this compiles to the same instruction.
#[inline]
fn lesser4(a: Vec4, b: Vec4) -> Vec4 {
    let (a, b) = (a.to_array(), b.to_array());
    Vec4::from_array(std::array::from_fn(|i| lesser(a[i], b[i])))
}

/// [`greater`] in each lane.
#[inline]
fn greater4(a: Vec4, b: Vec4) -> Vec4 {
    let (a, b) = (a.to_array(), b.to_array());
    Vec4::from_array(std::array::from_fn(|i| greater(a[i], b[i])))
}

#[cfg(test)]
mod tests;

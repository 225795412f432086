//! Axis-aligned boxes.

use glam::Vec3;

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

    /// What is in both: with a `lo` above its `hi` on some axis if nothing is.
    #[inline]
    #[must_use]
    pub fn intersection(self, other: &Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
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

    /// For each axis lo and hi, twice: a pair of boxes, both this one.
    #[inline]
    pub fn planes_twice(&self) -> [[f32; 4]; 3] {
        [0, 1, 2].map(|axis| [self.lo[axis], self.hi[axis], self.lo[axis], self.hi[axis]])
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

#[cfg(test)]
mod tests;

//! Axis-aligned boxes.

use glam::Vec3;

/// An axis-aligned box, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least coordinates.
    pub lo: Vec3,
    /// Greatest coordinates.
    pub hi: Vec3,
}

impl Aabb {
    /// The box of no points: from plus to minus infinity. Do not pass it to the slab test, which hits it.
    pub const EMPTY: Self = Self { lo: Vec3::INFINITY, hi: Vec3::NEG_INFINITY };

    /// Returns the smallest box of these points.
    #[inline]
    pub fn of(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |aabb, &point| aabb.grow(point))
    }

    /// Returns the smallest box of this box and a point.
    #[inline]
    #[must_use]
    pub fn grow(self, point: Vec3) -> Self {
        Self { lo: self.lo.min(point), hi: self.hi.max(point) }
    }

    /// Returns the smallest box of the two boxes.
    #[inline]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Returns the intersection: with a `lo` above its `hi` on some axis if it is empty.
    #[inline]
    #[must_use]
    pub fn intersection(self, other: &Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    /// Returns whether a point is inside or on the boundary.
    #[inline]
    pub fn contains(&self, point: Vec3) -> bool {
        self.lo.cmple(point).all() && point.cmple(self.hi).all()
    }

    /// Returns whether all of `other` is inside.
    #[inline]
    pub fn encloses(&self, other: &Self) -> bool {
        self.lo.cmple(other.lo).all() && other.hi.cmple(self.hi).all()
    }

    /// Returns lo and hi for each axis, twice: a pair of boxes that are equal to this one.
    #[inline]
    pub fn planes_twice(&self) -> [[f32; 4]; 3] {
        [0, 1, 2].map(|axis| [self.lo[axis], self.hi[axis], self.lo[axis], self.hi[axis]])
    }

    /// Returns the lengths of the edges. They are negative for the empty box.
    #[inline]
    pub fn extent(&self) -> Vec3 {
        self.hi - self.lo
    }

    /// Returns half of the surface area. It is meaningless for the empty box.
    #[inline]
    pub fn half_area(&self) -> f32 {
        let e = self.extent();
        (e.x + e.y) * e.z + e.x * e.y
    }

    /// Returns the center. It does not overflow.
    #[inline]
    pub fn centroid(&self) -> Vec3 {
        self.lo * 0.5 + self.hi * 0.5
    }
}

#[cfg(test)]
mod tests;

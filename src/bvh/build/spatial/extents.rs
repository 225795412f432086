//! Growing boxes of items and parts.

use glam::Vec3A;

use super::super::record::{Planes, Record};
use crate::geom::Aabb;

/// The box of some items, and that of their centroids.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extents {
    pub(super) boxes: Spread,
    pub(super) centroids: Spread,
}

impl Extents {
    pub(super) fn of(items: &[Record]) -> Self {
        let (mut boxes, mut centroids) = (Spread::EMPTY, Spread::EMPTY);
        for item in items {
            boxes = boxes.union(Spread::of(item));
            centroids = centroids.add(item.centroid());
        }
        Self { boxes, centroids }
    }
}

/// A growing box, in SIMD registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
}

impl Spread {
    pub(super) const EMPTY: Self = Self { lo: Vec3A::INFINITY, hi: Vec3A::NEG_INFINITY };

    #[inline]
    pub(super) fn of(item: &Record) -> Self {
        Self { lo: item.lo(), hi: item.hi() }
    }

    #[inline]
    pub(super) fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    #[inline]
    pub(super) fn intersection(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    /// Returns the box with a point. SSE's instructions ignore a NaN here.
    #[inline]
    pub(super) fn add(self, point: Vec3A) -> Self {
        Self { lo: point.min(self.lo), hi: point.max(self.hi) }
    }

    /// Returns whether it contains no point, because it is empty or has a NaN.
    #[inline]
    pub(super) fn is_empty(self) -> bool {
        !self.lo.cmple(self.hi).all()
    }

    #[inline]
    pub(super) fn extent(self) -> Vec3A {
        self.hi - self.lo
    }

    #[inline]
    pub(super) fn half_area(self) -> f32 {
        self.aabb().half_area()
    }

    #[inline]
    pub(super) fn aabb(self) -> Aabb {
        Aabb { lo: self.lo.into(), hi: self.hi.into() }
    }

    /// Returns the planes of a record.
    pub(super) fn planes(self) -> Planes {
        *Record::item(&self.aabb(), 0).planes()
    }
}

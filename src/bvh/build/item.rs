//! What builders sort.

use glam::{Vec3A, Vec4};

use super::{BuildError, Primitives};
use crate::geom::Aabb;
use crate::tree::Node;

/// A primitive, or a part of one, while it is sorted: its box and its index. 32 bytes, two registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    /// In the last lane the bits of the index.
    lo: Vec4,
    hi: Vec4,
}

impl Item {
    pub(super) fn new(aabb: &Aabb, prim: u32) -> Self {
        Self { lo: aabb.lo.extend(f32::from_bits(prim)), hi: aabb.hi.extend(0.0) }
    }

    #[inline]
    pub(super) fn prim(&self) -> u32 {
        self.lo.w.to_bits()
    }

    #[inline]
    pub(super) fn spread(&self) -> Spread {
        Spread { lo: Vec3A::from_vec4(self.lo), hi: Vec3A::from_vec4(self.hi) }
    }

    /// Middle of the box. It does not overflow.
    #[inline]
    pub(super) fn centroid(&self) -> Vec3A {
        let Spread { lo, hi } = self.spread();
        lo * 0.5 + hi * 0.5
    }
}

/// All primitives that can be hit. No ray meets a degenerate triangle, so those are left out.
pub(super) fn items<P: Primitives + ?Sized>(primitives: &P) -> Result<Vec<Item>, BuildError> {
    match primitives.count() {
        0 => Err(BuildError::Empty),
        n if n > Node::MAX_INDEX as usize => Err(BuildError::TooManyTriangles(n)),
        n => {
            let item = |i: usize| Item::new(&primitives.aabb(i), i as u32);
            let items: Vec<_> = (0..n).filter(|&i| primitives.can_be_hit(i)).map(item).collect();
            // A tree has at least one leaf, even if nothing can be hit.
            Ok(if items.is_empty() { vec![item(0)] } else { items })
        }
    }
}

/// A box while it grows, in SIMD registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
}

impl Spread {
    pub(super) const EMPTY: Self = Self { lo: Vec3A::INFINITY, hi: Vec3A::NEG_INFINITY };

    #[inline]
    pub(super) fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
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

    /// Of all boxes.
    pub(super) fn of(items: &[Item]) -> Self {
        items.iter().map(Item::spread).fold(Self::EMPTY, Self::union)
    }

    /// Of the centroids.
    pub(super) fn of_centroids(items: &[Item]) -> Self {
        items.iter().map(Item::centroid).fold(Self::EMPTY, |s, c| s.union(Self { lo: c, hi: c }))
    }

    /// Axis of the greatest extent, the first of equals.
    pub(super) fn widest_axis(self) -> usize {
        let extent = self.extent();
        let later_wins = |best: usize, axis: usize| if extent[axis] > extent[best] { axis } else { best };
        later_wins(later_wins(0, 1), 2)
    }
}

//! What builders sort.

use glam::{Vec3A, Vec4};

use super::{BuildError, Degenerate, Primitives};
use crate::geom::Aabb;
use crate::threads;
use crate::tree::Node;

/// A primitive, or a part of one, while it is sorted: its box and its index. 32 bytes, two registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    /// In the last lane the bits of the index.
    lo: Vec4,
    hi: Vec4,
}

/// Items that one task deals with before another thread may help.
pub(super) const CHUNK: usize = 1 << 14;

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

    /// Middle of the box. It does not overflow, but is NaN where the box is infinite on both sides.
    #[inline]
    pub(super) fn centroid(&self) -> Vec3A {
        let Spread { lo, hi } = self.spread();
        lo * 0.5 + hi * 0.5
    }
}

/// All primitives, or those that can be hit.
pub(super) fn items<P: Primitives + ?Sized>(primitives: &P, degenerate: Degenerate) -> Result<Vec<Item>, BuildError> {
    match primitives.count() {
        0 => Err(BuildError::Empty),
        n if n > Node::MAX_INDEX as usize => Err(BuildError::TooManyTriangles(n)),
        n => {
            let is_wanted = |i| degenerate == Degenerate::Kept || primitives.can_be_hit(i);
            let item = |i| Item::new(&primitives.aabb(i), if is_wanted(i) { i as u32 } else { NONE });
            let mut items = threads::map(0..n, CHUNK, item);
            items.retain(|item| item.prim() != NONE);
            // A tree has at least one leaf, even if nothing can be hit.
            if items.is_empty() {
                items.push(Item::new(&primitives.aabb(0), 0));
            }
            // A NaN would spoil the boxes of others, an empty box the cuts.
            match items.iter().find(|item| item.spread().is_empty()) {
                Some(item) => Err(BuildError::NoBox(item.prim())),
                None => Ok(items),
            }
        }
    }
}

/// No primitive has this index.
const NONE: u32 = u32::MAX;

/// What is known of a range of items: the box of all, and the box of their centroids.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extents {
    pub(super) boxes: Spread,
    pub(super) centroids: Spread,
}

impl Extents {
    pub(super) const EMPTY: Self = Self { boxes: Spread::EMPTY, centroids: Spread::EMPTY };

    #[inline]
    pub(super) fn add(self, item: &Item) -> Self {
        Self { boxes: self.boxes.union(item.spread()), centroids: self.centroids.add(item.centroid()) }
    }

    fn union(self, other: Self) -> Self {
        Self { boxes: self.boxes.union(other.boxes), centroids: self.centroids.union(other.centroids) }
    }

    /// Of all of these.
    #[inline]
    pub(super) fn of(items: &[Item]) -> Self {
        let of_chunk = |chunk: &[Item]| chunk.iter().fold(Self::EMPTY, Self::add);
        if items.len() < 2 * CHUNK {
            return of_chunk(items);
        }
        threads::reduce(items, CHUNK, of_chunk, Self::union).unwrap_or(Self::EMPTY)
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
    pub(super) fn intersection(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    /// With a point. Where this is a NaN, SSE's instructions leave it out.
    #[inline]
    pub(super) fn add(self, point: Vec3A) -> Self {
        Self { lo: point.min(self.lo), hi: point.max(self.hi) }
    }

    /// Whether it holds no point, as it is empty or has a NaN.
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

    /// Axis of the greatest extent, the first of equals.
    pub(super) fn widest_axis(self) -> usize {
        let extent = self.extent();
        let later_wins = |best: usize, axis: usize| if extent[axis] > extent[best] { axis } else { best };
        later_wins(later_wins(0, 1), 2)
    }
}

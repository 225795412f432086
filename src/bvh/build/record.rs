//! The items that builders sort, which are also the nodes of a tree under construction.

use fearless_simd::{Simd, SimdBase, f32x8};
use glam::{Vec3, Vec3A};

use super::{BuildError, Degenerate, Primitives, room};
use crate::geom::{Aabb, exponent_of, power_of_two};
use crate::threads;
use crate::tree::Node;

/// A box and two words, in one register of eight lanes: the lower corner, a word, the upper corner *negated*, a word.
/// So the box around two boxes is one `min` of all lanes.
///
/// For a primitive, or a part of one, the words are its index and 1. For an inner node they are the place of its left
/// child, which is adjacent to the right child, and the number of primitives below. No coordinate is -0, for which
/// `min` would give different bits on different machines. Operations also compute the lanes of the words, and ignore
/// the results. If they were subnormal, as small integers are, some machines would take ten times as long.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(in crate::bvh) struct Record([f32; 8]);

/// Box and words without an order: the operand of a union.
pub(super) type Planes = [f32; 8];

/// Added to words to make them normal floats: 0 becomes 2^-63.
const USUAL: u32 = 64 << 23;

/// The empty box.
pub(super) const EMPTY: Planes = [f32::INFINITY; 8];

/// Items that one task processes before another thread may help.
pub(super) const CHUNK: usize = 1 << 14;

impl Record {
    /// The absent node.
    pub(in crate::bvh) const NONE: Self = Self::over(&EMPTY, 0, 0);

    /// Creates a primitive, or a part of one.
    #[inline]
    pub(in crate::bvh) fn item(aabb: &Aabb, prim: u32) -> Self {
        let (lo, hi) = (aabb.lo + Vec3::ZERO, Vec3::ZERO - aabb.hi);
        Self::over(&[lo.x, lo.y, lo.z, 0.0, hi.x, hi.y, hi.z, 0.0], prim, 1)
    }

    /// Creates a node with these planes, whose word lanes are ignored.
    #[inline(always)]
    pub(super) const fn over(planes: &Planes, first: u32, count: u32) -> Self {
        let mut made = *planes;
        made[3] = f32::from_bits(first.wrapping_add(USUAL));
        made[7] = f32::from_bits(count.wrapping_add(USUAL));
        Self(made)
    }

    /// Creates an inner node over two children; the left one is at `first`.
    #[inline(always)]
    pub(in crate::bvh) fn parent([left, right]: [&Self; 2], first: u32) -> Self {
        Self::over(&left.union(right), first, left.count() + right.count())
    }

    /// Creates an item around other items.
    #[inline(always)]
    pub(in crate::bvh) fn around(items: &[Self], first: u32) -> Self {
        Self::over(&items.iter().fold(EMPTY, |all, item| union(&all, &item.0)), first, 1)
    }

    /// Returns the index of a primitive, or the place of an inner node's left child.
    #[inline(always)]
    pub(in crate::bvh) fn first(&self) -> u32 {
        self.0[3].to_bits().wrapping_sub(USUAL)
    }

    /// Returns the number of primitives below; each part of a primitive counts.
    #[inline(always)]
    pub(in crate::bvh) fn count(&self) -> u32 {
        self.0[7].to_bits().wrapping_sub(USUAL)
    }

    #[inline(always)]
    pub(in crate::bvh) fn is_leaf(&self) -> bool {
        self.count() == 1
    }

    #[inline(always)]
    pub(super) fn planes(&self) -> &Planes {
        &self.0
    }

    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S) -> f32x8<S> {
        f32x8::load_array_ref(simd, &self.0)
    }

    #[inline(always)]
    pub(super) fn stored<S: Simd>(lanes: f32x8<S>) -> Self {
        Self(lanes.to_array())
    }

    #[inline(always)]
    pub(super) fn union(&self, other: &Self) -> Planes {
        union(&self.0, &other.0)
    }

    #[inline(always)]
    pub(in crate::bvh) fn half_area(&self) -> f32 {
        half_area(&self.0)
    }

    #[inline(always)]
    pub(in crate::bvh) fn aabb(&self) -> Aabb {
        let [x, y, z, _, nx, ny, nz, _] = self.0;
        Aabb { lo: Vec3::new(x, y, z), hi: Vec3::new(0.0 - nx, 0.0 - ny, 0.0 - nz) }
    }

    #[inline]
    pub(super) fn lo(&self) -> Vec3A {
        Vec3A::from_slice(&self.0)
    }

    #[inline]
    pub(super) fn hi(&self) -> Vec3A {
        Vec3A::ZERO - Vec3A::from_slice(&self.0[4..])
    }

    /// Returns the center.
    #[inline]
    pub(super) fn centroid(&self) -> Vec3A {
        self.lo() * 0.5 + self.hi() * 0.5
    }

    /// Returns the box multiplied by this factor; coordinates beyond [`REACH`] are moved there.
    fn scaled(&self, factor: f64) -> Self {
        let scale = |x: f32| (f64::from(x) * factor).clamp(-REACH, REACH) as f32 + 0.0;
        Self::over(&self.0.map(scale), self.first(), self.count())
    }

    /// Returns the node with this number of primitives.
    pub(in crate::bvh) fn holding(&self, count: u32) -> Self {
        Self::over(&self.0, self.first(), count)
    }

    /// Returns whether this is the absent node.
    #[inline]
    pub(in crate::bvh) fn is_none(&self) -> bool {
        self.count() == 0
    }

    /// Returns whether box and count are equal.
    #[inline]
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self.count() == other.count() && self.0[..3] == other.0[..3] && self.0[4..7] == other.0[4..7]
    }

    /// Returns whether the box has no point, because it is empty or has a NaN.
    fn is_empty(&self) -> bool {
        !(0..3).all(|axis| self.0[axis] <= -self.0[axis + 4])
    }
}

#[inline(always)]
pub(super) fn union(a: &Planes, b: &Planes) -> Planes {
    std::array::from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
}

#[inline(always)]
pub(super) fn half_area(planes: &Planes) -> f32 {
    let (x, y, z) = (planes[0] + planes[4], planes[1] + planes[5], planes[2] + planes[6]);
    (x + y) * z + x * y
}

/// Returns all primitives, or those that can be hit.
pub(super) fn items<P: Primitives + ?Sized>(primitives: &P, degenerate: Degenerate) -> Result<Vec<Record>, BuildError> {
    let n = match primitives.count() {
        0 => return Err(BuildError::Empty),
        n if n > Node::MAX_INDEX as usize => return Err(BuildError::TooManyTriangles(n)),
        n => n,
    };
    let is_wanted = |i| degenerate == Degenerate::Kept || primitives.can_be_hit(i);
    let item = |i| if is_wanted(i) { Record::item(&primitives.aabb(i), i as u32) } else { Record::NONE };
    let mut items = room(n)?;
    threads::map_into(&mut items, 0..n, CHUNK, item);
    if degenerate == Degenerate::LeftOut {
        items.retain(|item| !item.is_none());
    }
    // A tree has at least one leaf, even if nothing can be hit.
    if items.is_empty() {
        items.push(Record::item(&primitives.aabb(0), 0));
    }
    // A NaN would invalidate the boxes of other items, an empty box the splits.
    let empty = |items: &[Record]| items.iter().find(|item| item.is_empty()).map(Record::first);
    match threads::reduce(&items, CHUNK, empty, Option::or).flatten() {
        Some(prim) => Err(BuildError::NoBox(prim)),
        None => Ok(items),
    }
}

/// Scales boxes into a space of moderate size if necessary, and returns whether it did. `[BUILD-4]` Areas of huge boxes
/// overflow, areas of tiny boxes are 0, and an infinite box has no center.
pub(in crate::bvh) fn scale(items: &mut [Record]) -> bool {
    let reach_of = |items: &[Record]| items.iter().fold([0.0; 2], |all, item| wider(all, item.reach()));
    let [reach, finite] = threads::reduce(items, CHUNK, reach_of, wider).unwrap_or_default();
    let is_usual = finite == reach && (finite == 0.0 || (SMALL..=LARGE).contains(&finite));
    if !is_usual {
        let factor = if finite > 0.0 { power_of_two(-exponent_of(finite.into())) } else { 1.0 };
        threads::update(items, CHUNK, |item| *item = item.scaled(factor));
    }
    !is_usual
}

/// The end of infinite boxes in such a space, in which no other coordinate is beyond 2.
const REACH: f64 = 4.0;

/// Coordinates between which no area overflows, and few vanish.
const SMALL: f32 = power_of_two(-40) as f32;
const LARGE: f32 = power_of_two(40) as f32;

fn wider(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

impl Record {
    /// Returns the greatest absolute coordinate, and the greatest finite one.
    fn reach(&self) -> [f32; 2] {
        let mut reach = [0.0_f32; 2];
        for axis in [0, 1, 2, 4, 5, 6] {
            let x = self.0[axis].abs();
            reach = wider(reach, [x, if x < f32::INFINITY { x } else { 0.0 }]);
        }
        reach
    }
}

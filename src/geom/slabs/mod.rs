//! Slab tests: whether a ray, up to its current end, meets a box.
//!
//! If the test rejects a box, all triangles in it are skipped. So it must not reject a box that the exact, closed
//! interval of the ray touches. [`Plain`] does not guarantee this and leaks; [`TwoSided`] guarantees it for most rays;
//! [`Directed`] for every [`Ray`]. Derivations: spec/exactness.md, `[BOX-1]` to `[BOX-7]`.
//!
//! All forms are monotone under nesting: no ray enters an inner box before a box around it. And `one` is `pair` of a
//! box and itself, so they agree in every bit.

#[cfg(any(test, feature = "internals"))]
mod centred;
pub(in crate::geom) mod directed;
mod doubled;
mod enclosed;
mod entered;
mod entrance;
mod framed;
mod slabs64;

#[cfg(any(test, feature = "internals"))]
pub use centred::{Centred, PADDING, Plain, TwoSided};
pub use directed::{Directed, STEPS};
pub use enclosed::EnclosedSlabs;
pub(crate) use entered::Approach;
pub(in crate::geom) use entered::{Entered, entry};
pub(in crate::geom) use entrance::{FromEntrance, entered_if};
pub(in crate::geom) use framed::Framed;
pub use slabs64::{STRICT_STEPS, Slabs64};

use doubled::Doubled;

use std::fmt::Debug;

use glam::{Vec4, Vec4Swizzles};

use super::{Aabb, Ray, Region, Vector};

/// Greatest magnitude of a coordinate for which no difference overflows.
pub(in crate::geom) const MAX_COORDINATE: f32 = f32::from_bits((127 + 126) << 23);

/// A slab test, prepared for a ray.
pub trait Slabs: Copy + Debug {
    /// Positions and directions of the rays.
    type Vector: Vector;

    /// Prepares a ray. `region` must contain all boxes of the tests.
    fn new(ray: &Ray<Self::Vector>, region: &Region) -> Self;

    /// Returns the distance at which the ray, up to `tmax`, enters a box; `None` if it misses the box.
    #[inline]
    fn one(&self, aabb: &Aabb, tmax: Real<Self>) -> Option<Real<Self>> {
        let Intervals { hit: [hit, _], near: [near, _], .. } = self.pair(&aabb.planes_twice(), tmax);
        hit.then_some(near)
    }

    /// Tests two boxes at once.
    ///
    /// `planes` has for each axis lo and hi of the first box, then lo and hi of the second (Aila & Laine 2009).
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: Real<Self>) -> Intervals<Real<Self>>;
}

/// The parts of a ray in two boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intervals<R> {
    /// Whether each box is hit.
    pub hit: [bool; 2],
    /// Distances of the entries; meaningless for missed boxes. No hit in the box is before.
    pub near: [R; 2],
    /// Distances of the exits, or of the ray's end; meaningless for missed boxes. No hit in the box is beyond.
    pub far: [R; 2],
}

impl Intervals<f32> {
    /// Converts the result of [`near_and_far`]: a box is hit if its exit is not before its entry.
    #[inline(always)]
    fn of_lanes([near, far]: [Vec4; 2]) -> Self {
        let hit = near.cmple(far.yxwz()).bitmask();
        Self { hit: [hit & 1 != 0, hit & 4 != 0], near: [near.x, near.z], far: [far.y, far.w] }
    }
}

/// Near and far of a box that is missed.
const MISSED: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

/// The type of a slab test's numbers.
pub type Real<B> = <<B as Slabs>::Vector as Vector>::Real;

/// Returns entries (even lanes) and exits (odd lanes) for two boxes, from `tmin` to `tmax`; each plane's distance is
/// `(plane - origin) * inverse`.
///
/// A plane through the origin of a ray that runs along it gives 0 times infinity, a NaN. The order of operands drops
/// it: then the plane does not bound the ray.
#[inline(always)]
fn near_and_far(planes: &[[f32; 4]; 3], origin: &[Vec4; 3], inverse: &[Vec4; 3], tmin: f32, tmax: f32) -> [Vec4; 2] {
    let (mut near, mut far) = (Vec4::splat(tmin), Vec4::splat(tmax));
    for axis in 0..3 {
        let t = (Vec4::from_array(planes[axis]) - origin[axis]) * inverse[axis];
        let other = t.yxwz();
        // In the even lanes `t` is that of lo and `other` that of hi; there only `near` is used, in the odd lanes only
        // `far`.
        near = greater(lesser(other, t), near);
        far = lesser(greater(other, t), far);
    }
    [near, far]
}

/// Returns the lesser number in each lane; that of `b` if either is a NaN.
///
/// This is the behaviour of SSE's instruction, and of `Vec4::min` on targets with SSE; on other targets `Vec4::min`
/// leaves NaN unspecified. If it is written with comparisons only, LLVM merges the four operations of an axis into
/// slower ones.
#[inline(always)]
fn lesser(a: Vec4, b: Vec4) -> Vec4 {
    if cfg!(all(target_arch = "x86_64", target_feature = "sse2")) { a.min(b) } else { Vec4::select(a.cmplt(b), a, b) }
}

/// Returns the greater number in each lane; that of `b` if either is a NaN.
#[inline(always)]
fn greater(a: Vec4, b: Vec4) -> Vec4 {
    if cfg!(all(target_arch = "x86_64", target_feature = "sse2")) { a.max(b) } else { Vec4::select(a.cmpgt(b), a, b) }
}

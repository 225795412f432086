//! Slab tests: whether a ray, up to its current end, meets a box.
//!
//! A box is skipped if the test says so, and then all triangles in it are. So what counts is that no box is skipped
//! which the exact, closed interval of the ray touches. [`Plain`] does not promise it and leaks; [`TwoSided`] does for
//! most rays; [`Directed`] does for every ray that [`Ray`] admits. Derivations: spec/exactness.md, `[BOX-1]` to
//! `[BOX-7]`.
//!
//! All forms are monotone under nesting: of two boxes, one in the other, the inner is not entered before the outer,
//! for any ray. And `one` is `pair` of a box and itself, so that both agree in every bit.

mod afar;
mod centred;
pub(in crate::geom) mod directed;
mod doubled;
mod enclosed;
mod entered;
mod entrance;
mod framed;
mod slabs64;

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

/// What a slab test keeps of a ray.
pub trait Slabs: Copy + Debug {
    /// Positions and directions of the rays.
    type Vector: Vector;

    /// Prepares a ray. `region` must hold all boxes that it is asked about.
    fn new(ray: &Ray<Self::Vector>, region: &Region) -> Self;

    /// Where the ray, up to `tmax`, enters a box; `None` if it misses the box.
    #[inline]
    fn one(&self, aabb: &Aabb, tmax: Real<Self>) -> Option<Real<Self>> {
        let Intervals { hit: [hit, _], near: [near, _], .. } = self.pair(&aabb.planes_twice(), tmax);
        hit.then_some(near)
    }

    /// Two boxes at once.
    ///
    /// `planes` holds for each axis lo and hi of the first box, then lo and hi of the second (Aila & Laine 2009).
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: Real<Self>) -> Intervals<Real<Self>>;
}

/// The parts of a ray in two boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intervals<R> {
    /// Which box is hit.
    pub hit: [bool; 2],
    /// Where each is entered; meaningless where missed. Nothing in the box is hit before.
    pub near: [R; 2],
    /// Where each is left, or the ray ends; meaningless where missed. Nothing in the box is hit beyond.
    pub far: [R; 2],
}

impl Intervals<f32> {
    /// From what [`near_and_far`] gives: a box is hit if it is not left before it is entered.
    #[inline(always)]
    fn of_lanes([near, far]: [Vec4; 2]) -> Self {
        let hit = near.cmple(far.yxwz()).bitmask();
        Self { hit: [hit & 1 != 0, hit & 4 != 0], near: [near.x, near.z], far: [far.y, far.w] }
    }
}

/// Near and far of a box that is missed.
const MISSED: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

/// The numbers that a slab test calculates with.
pub type Real<B> = <<B as Slabs>::Vector as Vector>::Real;

/// Where two boxes are entered (even lanes) and left (odd lanes), from `tmin` to `tmax`, each plane's distance being
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
        // In the even lanes `t` is of lo and `other` of hi; there only `near` is used, in the odd lanes only `far`.
        near = greater(lesser(other, t), near);
        far = lesser(greater(other, t), far);
    }
    [near, far]
}

/// The lesser number in each lane; that of `b` if either is a NaN.
///
/// This is what SSE's instruction does, and so `Vec4::min` where it stands for that; elsewhere `Vec4::min` leaves open
/// what becomes of a NaN. Written with comparisons only, LLVM merges the four operations of an axis into slower ones.
#[inline(always)]
fn lesser(a: Vec4, b: Vec4) -> Vec4 {
    if cfg!(all(target_arch = "x86_64", target_feature = "sse2")) { a.min(b) } else { Vec4::select(a.cmplt(b), a, b) }
}

/// The greater number in each lane; that of `b` if either is a NaN.
#[inline(always)]
fn greater(a: Vec4, b: Vec4) -> Vec4 {
    if cfg!(all(target_arch = "x86_64", target_feature = "sse2")) { a.max(b) } else { Vec4::select(a.cmpgt(b), a, b) }
}

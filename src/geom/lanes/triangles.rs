//! The filter of four triangles: it rejects triangles that are certainly missed, or certainly beyond the best hit.

use std::ops::{Add, Mul, Sub};

use fearless_simd::{Simd, SimdBase as _, SimdMask as _, f32x4};
use glam::Vec3;

use super::{Block, FourLanes, Precision};
use crate::geom::frame::power_of_two;
use crate::geom::kernel::{EDGE, MAX_COORDINATE};
use crate::geom::{EnclosedRay, Interval, Ray, Real as _, Region};

/// Minimum of edges, and of distances from the origin, in the error bounds, 2^-40; it covers all errors of underflow
/// too. `[LANES-3]`
pub const MIN_EDGE: f32 = f32::from_bits((127 - 40) << 23);

/// Error bound of the determinant: times u D E E. It also covers the roundings of the comparison, so it is more than
/// the kernel's. `[LANES-4]`
pub const DETERMINANT: u32 = 40;

/// Error bound of the distance times the determinant: times u C E E, including the roundings of the comparison.
/// `[LANES-4]`
pub const DISTANCE: u32 = 44;

pub(super) const CONSTANTS: [f32; 3] = [EDGE as f32, DETERMINANT as f32, DISTANCE as f32];

/// Error bound of edge functions if the error of the components of the direction is ε: times ε E (2 C + E). This bound
/// and the next two have an eighth to spare. `[LANES-5]`
pub const OFF_EDGE: f32 = 4.5;

/// Error bound of edge functions if the error of the components of the origin is ω: as if 2 C were greater by this
/// times ω. `[LANES-5]`
pub const OFF_REACH: f32 = 9.0 / (EDGE as f32 * UNIT);

/// Error bound of the determinant, times ε E E, and of the distance times the determinant, times ω E E. `[LANES-5]`
pub const OFF: f32 = 4.5;

/// The greatest ε, for a direction of length 1, for which the filter is used.
const MAX_TURN: f64 = power_of_two(-10);

/// Lengths of a direction (its greatest component) for which single precision is used: 2^-20 to 2^20.
const LENGTHS: [f32; 2] = [f32::from_bits((127 - 20) << 23), f32::from_bits((127 + 20) << 23)];

/// Half of the distance from 1 to the next float.
const UNIT: f32 = f32::EPSILON / 2.0;

/// A ray, prepared for four triangles at once.
///
/// It only rejects. The exact test decides the survivors; see [`LazyExact`](super::LazyExact).
#[derive(Clone, Copy, Debug)]
pub struct TriangleRay<S: Simd, V: Precision = Vec3> {
    pub(super) origin: [V::Lanes<S>; 3],
    pub(super) direction: [V::Lanes<S>; 3],
    /// Bound of an edge function's error, over E (2 C + E). This bound and the next two are infinite if the filter is
    /// not used.
    pub(super) edge: V::Lanes<S>,
    /// Bound of the determinant's error, over E E.
    pub(super) det: V::Lanes<S>,
    /// Bound of the error of the distance times the determinant, over E E.
    pub(super) t: V::Lanes<S>,
    /// 2 C: C is the greatest component of the vector from a corner to the origin, for all triangles of the scene.
    pub(super) twice_c: V::Lanes<S>,
}

/// The determinants of a ray and four triangles, in the order of EXACT-4.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found<F> {
    pub(super) det: F,
    /// The least and the greatest edge function.
    pub(super) edges: [F; 2],
    pub(super) t: F,
}

impl<S: Simd> TriangleRay<S> {
    /// Prepares a ray. `region` must contain all triangles of the tests.
    #[inline(always)]
    pub fn new(simd: S, ray: &Ray, region: &Region) -> Self {
        Self::with_constants(simd, [ray.origin(), ray.direction()], region, CONSTANTS)
    }

    /// Prepares a ray that is known within bounds. It rejects triangles that all rays within them miss, or meet beyond.
    /// `[LANES-5]`
    #[inline(always)]
    pub fn enclosed(simd: S, ray: &EnclosedRay, region: &Region) -> Self {
        Self::enclosed_with(simd, ray, region, [OFF_EDGE, OFF_REACH, OFF])
    }

    /// Prepares a ray with other constants than [`OFF_EDGE`], [`OFF_REACH`] and [`OFF`]; for tests of these constants.
    #[inline(always)]
    pub(super) fn enclosed_with(simd: S, ray: &EnclosedRay, region: &Region, [edge, reach, off]: [f32; 3]) -> Self {
        let ((origin, moved), (direction, turned)) = (nearest(&ray.origin), nearest(&ray.direction));
        let middle = [origin, direction];
        let exact = Self::with_constants(simd, middle, region, CONSTANTS);
        exact.around(simd, ray, middle, [moved, turned], [edge, reach, off])
    }

    /// Calls [`new`](Self::new) with other constants than [`EDGE`], [`DETERMINANT`] and [`DISTANCE`]; for tests of
    /// these constants.
    #[inline(always)]
    #[allow(clippy::manual_range_contains, clippy::needless_bitwise_bool, reason = "without branches")]
    pub(super) fn with_constants(
        simd: S,
        [origin, direction]: [Vec3; 2],
        region: &Region,
        [edge, det, t]: [f32; 3],
    ) -> Self {
        let (far, d) = (origin.abs().max_element(), direction.abs().max_element());
        let reach = upward(region.reach());
        // Rounding keeps the order, so this is not below any rounded component.
        let c = (far + reach).max(MIN_EDGE);
        let is_usual = (LENGTHS[0] <= d) & (d <= LENGTHS[1]) & (far <= MAX_COORDINATE) & (reach <= MAX_COORDINATE);
        let unit = if is_usual { UNIT } else { f32::INFINITY };
        Self {
            origin: splat(simd, origin),
            direction: splat(simd, direction),
            edge: f32x4::splat(simd, edge * unit * d),
            det: f32x4::splat(simd, det * unit * d),
            t: f32x4::splat(simd, t * unit * c),
            twice_c: f32x4::splat(simd, 2.0 * c),
        }
    }
}

impl<S: Simd, V: Precision> TriangleRay<S, V> {
    /// Prepares the filter for all rays around `middle`, with errors of at most `off` in components of origin and
    /// direction. `[LANES-5]`
    #[inline(always)]
    pub(super) fn around(
        self,
        simd: S,
        ray: &EnclosedRay,
        middle: [V; 2],
        off: [V::Real; 2],
        [of_edge, of_reach, of_volume]: [V::Real; 3],
    ) -> Self {
        let [origin, direction] = middle.map(V::widen);
        let is_usual = origin.is_finite()
            && direction.is_finite()
            && off[0].into() <= V::MOST_OFF
            && off[1].into() <= MAX_TURN * direction.abs().max_element();
        let [moved, turned] = if is_usual { off } else { [V::Real::INFINITY; 2] };
        let [moved, turned] = [V::Lanes::splat(simd, moved), V::Lanes::splat(simd, turned)];
        // The filter for hits beyond the limit needs the distance from the ray's origin.
        let is_from_start = ray.start == Interval::exact(0.0);
        let from_start = if is_from_start { moved * of_volume } else { V::Lanes::splat(simd, V::Real::INFINITY) };
        Self {
            edge: self.edge + turned * of_edge,
            det: self.det + turned * of_volume,
            t: self.t + from_start,
            twice_c: self.twice_c + moved * of_reach,
            ..self
        }
    }

    /// Returns the lanes that may hold a hit at or before `best`, which is not negative: all except those that are
    /// certainly missed `[LANES-3]` and those that are certainly beyond `[LANES-4]`. Lanes without a triangle are among
    /// them.
    #[inline(always)]
    pub fn survivors(&self, simd: S, block: &Block<V>, best: V::Real) -> u32 {
        self.left(simd, block, best, &self.found(simd, block))
    }

    #[inline(always)]
    pub(super) fn found(&self, simd: S, block: &Block<V>) -> Found<V::Lanes<S>> {
        let [v0, v1, v2] = &block.corners;
        let (v0, v1, v2) = (load(simd, v0), load(simd, v1), load(simd, v2));
        let (e1, e2, s) = (minus(&v1, &v0), minus(&v2, &v0), minus(&self.origin, &v0));
        let (p, q) = (cross(&self.direction, &e2), cross(&s, &e1));
        let (det, u, v, t) = (dot(&e1, &p), dot(&s, &p), dot(&self.direction, &q), dot(&e2, &q));
        let w = (det - u) - v;
        Found { det, edges: [u.min(v).min(w), u.max(v).max(w)], t }
    }

    /// Returns the survivors, by their determinants.
    #[inline(always)]
    pub(super) fn left(&self, simd: S, block: &Block<V>, best: V::Real, found: &Found<V::Lanes<S>>) -> u32 {
        let Found { det, edges: [least, most], t } = *found;
        let edge: V::Lanes<S> = row(simd, &block.edges);
        let delta = (self.edge * edge) * (self.twice_c + edge);
        let is_missed = least.simd_lt(-delta) & most.simd_gt(delta);

        let square = edge * edge;
        let is_beyond = (t.turned(det) - self.t * square).simd_gt((det.abs() + self.det * square) * best);
        // Comparisons with NaN are false, and so are those with the infinite bounds of rays outside the range.
        !((is_missed | is_beyond).to_bitmask() as u32) & 15
    }
}

#[inline(always)]
fn splat<S: Simd>(simd: S, v: Vec3) -> [f32x4<S>; 3] {
    [f32x4::splat(simd, v.x), f32x4::splat(simd, v.y), f32x4::splat(simd, v.z)]
}

#[inline(always)]
fn row<S: Simd, R, F: FourLanes<S, R>>(simd: S, row: &[R; 4]) -> F {
    F::load_array_ref(simd, row)
}

#[inline(always)]
fn load<S: Simd, R, F: FourLanes<S, R>>(simd: S, [x, y, z]: &[[R; 4]; 3]) -> [F; 3] {
    [row(simd, x), row(simd, y), row(simd, z)]
}

#[inline(always)]
pub(super) fn minus<F: Copy + Sub<Output = F>>(a: &[F; 3], b: &[F; 3]) -> [F; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Without fused multiply-adds, so all levels have the same results.
#[inline(always)]
fn cross<F: Copy + Sub<Output = F> + Mul<Output = F>>(a: &[F; 3], b: &[F; 3]) -> [F; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<F: Copy + Add<Output = F> + Mul<Output = F>>(a: &[F; 3], b: &[F; 3]) -> F {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}

/// Returns the floats nearest to the middles of bounds, and the greatest distance of a number from them; infinite or
/// NaN if a bound is.
#[inline(always)]
fn nearest(bounds: &[Interval; 3]) -> (Vec3, f32) {
    let (middles, radius) = Interval::middles(bounds);
    let nearest = middles.as_vec3();
    // The difference is exact; the spare part of the constants covers the rounding of the sum.
    (nearest, upward(radius + (middles - nearest.as_dvec3()).abs().max_element()))
}

/// Rounded up.
#[inline(always)]
fn upward(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}

#[cfg(test)]
mod tests;

//! Blocks of four triangles.

use fearless_simd::{Simd, SimdBase, SimdMask, f32x4};
use glam::Vec3;

use super::triangles::minus;
use super::{MIN_EDGE, Precision};
use crate::geom::frame::power_of_two;
use crate::geom::{Real as _, Triangle};

/// Up to four triangles, one in each lane: 176 bytes in single precision, 336 in double.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub struct Block<V: Precision = Vec3> {
    /// For each corner and each axis, the coordinates in the four lanes.
    pub corners: [[[V::Real; 4]; 3]; 3],
    /// The greatest component of the two edges from the first corner, rounded, and not below
    /// [`MIN_EDGE`](Precision::MIN_EDGE).
    pub edges: [V::Real; 4],
    /// Indices in the mesh; [`NONE`](Block::NONE) in a lane without a triangle.
    pub prims: [u32; 4],
}

/// Limits below this count as this.
const LEAST: f64 = power_of_two(-50);

/// Room for the rounding errors of squares.
const ROOM: f64 = 1.0 + power_of_two(-18);

impl Block {
    /// The index of a lane without a triangle. No mesh has this index.
    pub const NONE: u32 = u32::MAX;

    /// Creates a block of four triangles, without their indices, in a few instructions: to filter triangles that are
    /// not in blocks.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, triangles: [&Triangle; 4]) -> Self {
        // Array by array: `map` is a separate function, which is not inlined here.
        let (v0, v1, v2) =
            (transposed(simd, triangles, 0), transposed(simd, triangles, 1), transposed(simd, triangles, 2));
        let longest = greatest(&minus(&v1, &v0)).max(greatest(&minus(&v2, &v0))).max(f32x4::splat(simd, MIN_EDGE));
        Self { corners: [arrays(v0), arrays(v1), arrays(v2)], edges: longest.into(), prims: [Self::NONE; 4] }
    }
}

impl<V: Precision> Block<V> {
    /// A block without triangles: corners at the origin. The filter does not reject these lanes, so callers drop them
    /// by the number of triangles.
    pub const EMPTY: Self =
        Self { corners: [[[V::Real::ZERO; 4]; 3]; 3], edges: [V::MIN_EDGE; 4], prims: [Block::NONE; 4] };

    /// Puts a triangle in a lane, 0 to 3.
    #[inline]
    pub fn set(&mut self, lane: usize, triangle: &Triangle<V>, prim: u32) {
        for (rows, corner) in self.corners.iter_mut().zip(triangle.0) {
            for (row, x) in rows.iter_mut().zip(corner.components()) {
                row[lane & 3] = x;
            }
        }
        self.edges[lane & 3] = V::longest(triangle);
        self.prims[lane & 3] = prim;
    }

    /// Returns the lanes except those with a triangle that is certainly beyond `limit`: the box of its corners is.
    /// `[NEAR-1]`
    #[inline(always)]
    pub(crate) fn near<S: Simd>(&self, simd: S, point: V, limit: V::Real) -> u32 {
        let all = |x: V::Real| V::Lanes::<S>::splat(simd, x);
        let point = point.components();
        let [x, y, z] = [0, 1, 2].map(
            #[inline(always)]
            |axis: usize| {
                let corner = |i: usize| V::Lanes::<S>::load_array_ref(simd, &self.corners[i][axis]);
                let (a, b, c, p) = (corner(0), corner(1), corner(2), all(point[axis]));
                (a.min(b).min(c) - p).max(p - a.max(b).max(c)).max(all(V::Real::ZERO))
            },
        );
        // Below `LEAST` squares underflow. If they overflow, no lane is omitted.
        let limit = all(limit).max(all(V::Real::rounded(LEAST)));
        let most = limit * limit * all(V::Real::rounded(ROOM));
        ((x * x + y * y) + z * z).simd_le(most).to_bitmask() as u32
    }

    #[inline(always)]
    fn corner(&self, corner: usize, lane: usize) -> V {
        let [x, y, z] = &self.corners[corner];
        V::from_components([x[lane & 3], y[lane & 3], z[lane & 3]])
    }

    /// Returns the triangle in a lane, 0 to 3.
    #[inline(always)]
    pub fn triangle(&self, lane: usize) -> Triangle<V> {
        Triangle([self.corner(0, lane), self.corner(1, lane), self.corner(2, lane)])
    }
}

/// Returns for one corner and each axis the coordinates of four triangles.
#[inline(always)]
fn transposed<S: Simd>(simd: S, triangles: [&Triangle; 4], corner: usize) -> [f32x4<S>; 3] {
    let row = |Triangle([v0, v1, v2]): &Triangle| {
        // Four consecutive numbers, which is one load.
        let row = match corner {
            0 => [v0.x, v0.y, v0.z, v1.x],
            1 => [v1.x, v1.y, v1.z, v2.x],
            _ => [v1.z, v2.x, v2.y, v2.z],
        };
        f32x4::load_array(simd, row)
    };
    let [a, b, c, d] = triangles;
    let (a, b, c, d) = (row(a), row(b), row(c), row(d));
    let (first, second) = (a.zip_low(c), b.zip_low(d));
    let (third, fourth) = (a.zip_high(c), b.zip_high(d));
    let rows = [first.zip_low(second), first.zip_high(second), third.zip_low(fourth), third.zip_high(fourth)];
    match corner {
        2 => [rows[1], rows[2], rows[3]],
        _ => [rows[0], rows[1], rows[2]],
    }
}

/// Returns the greatest component in each lane.
#[inline(always)]
fn greatest<S: Simd>([x, y, z]: &[f32x4<S>; 3]) -> f32x4<S> {
    x.abs().max(y.abs()).max(z.abs())
}

#[inline(always)]
fn arrays<S: Simd>([x, y, z]: [f32x4<S>; 3]) -> [[f32; 4]; 3] {
    [x.into(), y.into(), z.into()]
}

/// Returns the greatest component of the edges from the first corner, as the filter computes it. `[LANES-3]`
pub(super) fn longest(&Triangle([v0, v1, v2]): &Triangle) -> f32 {
    (v1 - v0).abs().max((v2 - v0).abs()).max_element().max(MIN_EDGE)
}

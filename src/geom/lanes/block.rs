//! Four triangles, side by side.

use glam::Vec3;

use super::MIN_EDGE;
use crate::geom::Triangle;

/// Up to four triangles, one in each lane: 176 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub struct Block {
    /// Of each corner, for each axis, the coordinates in the four lanes.
    pub corners: [[[f32; 4]; 3]; 3],
    /// The greatest component of the two edges from the first corner, rounded, and not below [`MIN_EDGE`].
    pub edges: [f32; 4],
    /// Indices in the mesh; [`NONE`](Self::NONE) in a lane without a triangle.
    pub prims: [u32; 4],
}

impl Block {
    /// The index of a lane without a triangle. No mesh has so many.
    pub const NONE: u32 = u32::MAX;

    /// Without triangles: corners at the origin. The filter does not reject these lanes, so whoever asks it drops them
    /// by the number of triangles.
    pub const EMPTY: Self = Self { corners: [[[0.0; 4]; 3]; 3], edges: [MIN_EDGE; 4], prims: [Self::NONE; 4] };

    /// Puts a triangle in a lane, 0 to 3.
    #[inline]
    pub fn set(&mut self, lane: usize, triangle: &Triangle, prim: u32) {
        for (rows, corner) in self.corners.iter_mut().zip(triangle.0) {
            for (row, x) in rows.iter_mut().zip(corner.to_array()) {
                row[lane & 3] = x;
            }
        }
        self.edges[lane & 3] = longest(triangle);
        self.prims[lane & 3] = prim;
    }

    #[inline(always)]
    fn corner(&self, corner: usize, lane: usize) -> Vec3 {
        let [x, y, z] = &self.corners[corner];
        Vec3::new(x[lane & 3], y[lane & 3], z[lane & 3])
    }

    /// The triangle in a lane, 0 to 3.
    #[inline(always)]
    pub fn triangle(&self, lane: usize) -> Triangle {
        Triangle([self.corner(0, lane), self.corner(1, lane), self.corner(2, lane)])
    }
}

/// The greatest component of the edges from the first corner, as the filter computes them. `[LANES-3]`
fn longest(&Triangle([v0, v1, v2]): &Triangle) -> f32 {
    (v1 - v0).abs().max((v2 - v0).abs()).max_element().max(MIN_EDGE)
}

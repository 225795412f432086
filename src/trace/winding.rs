//! The winding number of any mesh, closed or open.
//!
//! # Idea
//!
//! The winding number of a surface S about a point q is the solid angle that S spans as seen from q, over 4π. The
//! number of times that S covers a direction changes only across the border of S, by 1. The fan of triangles from the
//! direction -e to all edges of the border has the same border, and does not cover e. So the two numbers differ by a
//! constant, the number of signed crossings of the ray from q along e:
//!
//! ```text
//! winding(q) = crossings(q, e) + 1/(4π) · sum of solid_angle(-e, a - q, b - q) over the edges (a, b) of the border
//! ```
//!
//! The crossings are exact, so a mesh without a border has exact integers. The sum needs one arc tangent for each edge
//! of the border (Van Oosterom & Strackee 1983, "The solid angle of a plane triangle"), for any number of triangles.
//! [`Boundary`] keeps the border as a hierarchy, so that distant edges need fewer. `[WINDING-1]`

use glam::DVec3;

use super::{Boundary, MeshQueries};
use crate::geom::{Mesh, Ray, RayError, Real as _, Vector, fan};

/// The winding numbers of a mesh: the number of times that its surface winds around a point.
///
/// In a closed mesh whose faces are counterclockwise seen from outside, the number is 1 inside and 0 outside. A hole
/// changes it by the hole's fraction of the view. For a point on the surface it is the number of one side.
///
/// ```
/// use stackless_bvh::geom::Mesh;
/// use stackless_bvh::glam::DVec3;
/// use stackless_bvh::trace::{Boundary, Tracer, Winding};
///
/// // A tetrahedron without one of its faces, from a point that sees all four under one angle.
/// let corners = vec![DVec3::ONE, DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::new(-1.0, -1.0, 1.0)];
/// let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3]])?;
/// let tracer = Tracer::of(&mesh)?;
/// let boundary = Boundary::of(&mesh);
/// let number = Winding::new(&tracer, &mesh, &boundary).number(DVec3::ZERO)?;
/// assert!((number - 0.75).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Winding<'t, T, V: Vector> {
    tracer: &'t T,
    vertices: &'t [V],
    boundary: &'t Boundary,
    tolerance: f64,
}

/// Greatest error of an edge of the border that is not computed again with more digits.
const CLOSE: f64 = 1e-12;

/// Greatest rounding error of a number, if one of the directions allows it. `[WINDING-2]`
const TOLERANCE: f64 = 1e-9;

/// Directions of rays, tried after the one that leaves the mesh soonest. The first are fast, but often meet edges of
/// boxes; the last rarely meet an edge.
const DIRECTIONS: [[i8; 3]; 12] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [-1, 0, 0],
    [0, -1, 0],
    [0, 0, -1],
    [53, 31, 17],
    [-17, 59, 37],
    [29, -19, 61],
    [-41, -23, -67],
    [71, -47, -13],
    [-43, 11, -73],
];

impl<'t, T: MeshQueries<V>, V: Vector> Winding<'t, T, V> {
    /// Prepares the winding numbers of a mesh; `tracer` and `boundary` must be those of the mesh.
    pub fn new(tracer: &'t T, mesh: &'t Mesh<V>, boundary: &'t Boundary) -> Self {
        Self { tracer, vertices: mesh.vertices(), boundary, tolerance: 1e-6 }
    }

    /// Sets the bound of the error, 1e-6 by default. A smaller bound takes longer; the least bound is 1e-9.
    #[must_use]
    pub const fn with_tolerance(&self, tolerance: f64) -> Self {
        Self { tolerance, ..*self }
    }

    /// Returns the winding number of a point: without an error for a mesh without a border.
    ///
    /// Otherwise its error is below the [tolerance](Self::with_tolerance), unless the point is on an edge of the border, or
    /// closer to it than about 1e-20 of its length. There the number itself jumps. `[WINDING-2]` `[WINDING-3]`
    ///
    /// # Errors
    /// [`RayError`] for a point that is not finite.
    pub fn number(&self, point: V) -> Result<f64, RayError> {
        let (ray, fan) = self.ray_and_fan(point)?;
        Ok(f64::from(self.tracer.winding(&ray)) + fan)
    }

    /// Returns whether the number is above 1/2; `None` if the point is on a triangle with an area.
    pub(super) fn is_inside(&self, point: V) -> Result<Option<bool>, RayError> {
        let (ray, fan) = self.ray_and_fan(point)?;
        let number = self.tracer.crossings_off_surface(&ray, true).map(|winding| f64::from(winding) + fan);
        if self.tolerance > TOLERANCE && number.is_some_and(|number| (number - 0.5).abs() <= self.tolerance) {
            return self.with_tolerance(TOLERANCE).is_inside(point);
        }
        Ok(number.map(|number| number > 0.5))
    }

    /// Returns a ray from a point, and the contribution of the fan from its opposite.
    fn ray_and_fan(&self, point: V) -> Result<(Ray<V>, f64), RayError> {
        let fan = |e: [i8; 3]| self.fan(point.widen(), DVec3::from(e.map(f64::from)));
        let (_, exit) = self.boundary.exit(point.widen());
        let mut best = (fan(exit), exit);
        for e in &DIRECTIONS {
            if best.0.error <= TOLERANCE {
                break;
            }
            let next = fan(*e);
            if next.error < best.0.error {
                best = (next, *e);
            }
        }
        let (fan, e) = best;
        Ok((along(point, e)?, fan.number))
    }

    /// Computes the fan from the opposite of the direction `e`, as seen from a point.
    fn fan(&self, point: DVec3, e: DVec3) -> Fan {
        let (mut fan, unit) = (Fan { number: 0.0, error: 0.0 }, e.normalize());
        let far = self.boundary.tree(self.vertices).fan(point, unit, self.tolerance - TOLERANCE, |ends| {
            let mut share = fan::share(point, ends, unit);
            if share[1] > CLOSE {
                share = fan::fine_share(point, ends, e).unwrap_or(share);
            }
            fan.number += share[0];
            fan.error += share[1];
        });
        Fan { number: fan.number + far, ..fan }
    }
}

/// Returns the ray from a point in a direction.
pub(super) fn along<V: Vector>(point: V, direction: [i8; 3]) -> Result<Ray<V>, RayError> {
    Ray::new(point, vector(direction))
}

pub(super) fn vector<V: Vector>(direction: [i8; 3]) -> V {
    V::from_components(direction.map(|x| V::Real::rounded(x.into())))
}

/// The fan of triangles from a direction to a border.
#[derive(Clone, Copy)]
struct Fan {
    /// Its part of the winding number.
    number: f64,
    /// Bound of its rounding error.
    error: f64,
}

#[cfg(test)]
mod tests;

//! The winding number of any mesh, closed or not.
//!
//! # Idea
//!
//! The winding number of a surface S about a point q is the solid angle that S spans as seen from q, over 4π. The
//! number of times that S covers a direction changes only across the border of S, by 1. The fan of triangles from the
//! direction -e to all edges of the border has the same border, and does not cover e. So the two differ by a constant,
//! the number of signed crossings of the ray from q along e:
//!
//! ```text
//! winding(q) = crossings(q, e) + 1/(4π) · sum of solid_angle(-e, a - q, b - q) over the edges (a, b) of the border
//! ```
//!
//! The crossings are exact, so a mesh without a border has exact integers. The sum takes one arc tangent for each edge
//! of the border (Van Oosterom & Strackee 1983, "The solid angle of a plane triangle"), however many triangles there
//! are: a hierarchy of dipoles (Barill et al. 2018, "Fast winding numbers for soups and clouds") approximates all
//! triangles instead. `[WINDING-1]`

use std::f64::consts::PI;

use glam::DVec3;

use super::{Border, Boundary, MeshQueries};
use crate::geom::{Mesh, Ray, RayError, Real as _, Vector};

/// The winding numbers of a mesh: about how often its surface winds around a point.
///
/// In a closed mesh whose faces are seen counterclockwise from outside it is 1 inside and 0 outside. A hole changes it
/// by the part of the view that the hole takes up. Of a point on the surface it is that of one side.
///
/// ```
/// use glam::DVec3;
/// use stackless_bvh::geom::Mesh;
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
    borders: &'t [Border],
}

/// The error that a number may have where one of the directions allows it. `[WINDING-2]`
const TOLERANCE: f64 = 1e-9;

/// Directions of rays, which are tried one after the other. The first are fast, and meet the edges of boxes; the last
/// meet what no one draws.
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
    /// The winding numbers of a mesh; `tracer` and `boundary` must be made of it.
    pub fn new(tracer: &'t T, mesh: &'t Mesh<V>, boundary: &'t Boundary) -> Self {
        Self { tracer, vertices: mesh.vertices(), borders: &boundary.borders }
    }

    /// The winding number of a point: without an error for a mesh without a border.
    ///
    /// Otherwise its error is below 1e-9, unless the point is next to an edge of the border: so near that it sees the
    /// ends of the edge under 180 degrees, within some 1e-5. There the number itself jumps. `[WINDING-2]`
    ///
    /// # Errors
    /// [`RayError`] for a point that is not finite.
    pub fn number(&self, point: V) -> Result<f64, RayError> {
        let fan = |e: [i8; 3]| self.fan(point.widen(), DVec3::from(e.map(f64::from)).normalize());
        let mut best = (fan(DIRECTIONS[0]), DIRECTIONS[0]);
        for e in &DIRECTIONS[1..] {
            if best.0.error <= TOLERANCE {
                break;
            }
            let next = fan(*e);
            if next.error < best.0.error {
                best = (next, *e);
            }
        }
        let (fan, e) = best;
        let direction = V::from_components(e.map(|x| V::Real::rounded(x.into())));
        Ok(f64::from(self.tracer.winding(&Ray::new(point, direction)?)) + fan.number)
    }

    /// The fan from the opposite of the direction `e`, as seen from a point.
    fn fan(&self, point: DVec3, e: DVec3) -> Fan {
        let mut fan = Fan { number: 0.0, error: 0.0 };
        for &Border { ends, faces } in self.borders {
            let ends = ends.map(|end| direction(point, self.vertices[end as usize].widen()));
            let [Some(a), Some(b)] = ends else { continue };
            // Twice the tangent of half the angle is the quotient of these.
            let top = -e.dot(a.cross(b));
            let bottom = 1.0 - e.dot(a) + a.dot(b) - e.dot(b);
            fan.number += f64::from(faces) * top.atan2(bottom) / (2.0 * PI);
            fan.error += f64::from(faces) * ROUNDED / top.hypot(bottom).max(f64::MIN_POSITIVE);
            // The ray may be on the other side of the edge than the sum.
            if bottom < 0.0 && top.abs() <= PI * ROUNDED {
                fan.error = f64::INFINITY;
            }
        }
        fan
    }
}

/// The fan of triangles from a direction to a border.
#[derive(Clone, Copy)]
struct Fan {
    /// Its part of the winding number.
    number: f64,
    /// The most that rounding may have changed that.
    error: f64,
}

/// What rounding changes the parts of the quotient by, over π. `[WINDING-2]`
const ROUNDED: f64 = 32.0 * f64::EPSILON;

/// The vector of length 1 from one point to another, however far away; `None` if they are one point.
fn direction(from: DVec3, to: DVec3) -> Option<DVec3> {
    let whole = to - from;
    let way = if whole.is_finite() { whole } else { to * 0.5 - from * 0.5 };
    let most = way.abs().max_element();
    (most > 0.0).then(|| (way / most).normalize())
}

#[cfg(test)]
mod tests;

//! Solids whose interior is determined in integers: tetrahedra that overlap, touch and repeat, with T-junctions.

use std::fmt::Debug;

use stackless_bvh::bvh::{WideBvh, WideError};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::{Mesh, MeshError, Precision, RayError, Real as _};
use stackless_bvh::trace::{Boundary, Location, Rule, Solid, SolidError, Tracer, Winding};

use crate::trees::nearest;

/// A point of a grid.
type Point = [i64; 3];

/// Some tetrahedra and points, with the scale and offset of their grid.
#[derive(Clone, Debug)]
pub struct Solids {
    tetrahedra: Vec<[Point; 4]>,
    faces: Vec<[Point; 3]>,
    points: Vec<Point>,
    /// Coordinates are multiples of two to this power.
    exponent: i32,
    /// Added to all coordinates, in multiples of 4096.
    shift: i64,
}

/// A wrong answer about a solid.
#[derive(Debug, thiserror::Error)]
pub enum SolidFault {
    /// The coordinates are not a valid mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The hierarchy cannot be built.
    #[error(transparent)]
    Build(#[from] WideError),
    /// The library rejects the solid.
    #[error(transparent)]
    Refused(#[from] SolidError),
    /// The library rejects a point.
    #[error(transparent)]
    Point(#[from] RayError),
    /// An answer differs from integer arithmetic.
    #[error("{what} of {point:?}: found {found}, expected {expected}")]
    Answer {
        /// The name of the query.
        what: &'static str,
        /// The point, on the grid.
        point: Point,
        /// The answer.
        found: String,
        /// The right answer.
        expected: String,
    },
}

/// Corners lie on multiples of this, so midpoints of edges are on the grid.
const STEP: i64 = 4;

impl Solids {
    /// Draws up to `most` tetrahedra and an equal number of points. At least one tetrahedron has a volume.
    pub fn draw(source: &mut impl Source, most: u64) -> Self {
        let mut tetrahedra: Vec<[Point; 4]> = Vec::new();
        for _ in 0..=source.below(most) {
            let corners = match tetrahedra.last() {
                // Repeats a corner, an edge, a face or all of the previous one.
                Some(&last) if source.coin() => {
                    let kept = source.below(5) as usize;
                    [0, 1, 2, 3].map(|i| if i < kept { last[i] } else { corner(source) })
                }
                _ => [(); 4].map(|()| corner(source)),
            };
            if volume(&corners) != 0 {
                tetrahedra.push(corners);
            }
        }
        if tetrahedra.is_empty() {
            tetrahedra.push([[0, 0, 0], [STEP, 0, 0], [0, STEP, 0], [0, 0, STEP]]);
        }
        let mut faces = Vec::new();
        for [a, b, c, d] in &tetrahedra {
            for face in [[a, c, b], [a, b, d], [a, d, c], [b, c, d]] {
                let [a, b, c] = face.map(|corner| *corner);
                match source.below(4) {
                    0 => {
                        // A T-junction, unless the other face is also split there.
                        let middle = [0, 1, 2].map(|axis| i64::midpoint(a[axis], b[axis]));
                        faces.extend([[a, middle, c], [middle, b, c]]);
                    }
                    1 => faces.push([c, a, b]),
                    _ => faces.push([a, b, c]),
                }
            }
        }
        let points = (0..=source.below(most)).map(|_| point(source, &tetrahedra, &faces)).collect();
        let exponent = [0, 0, -20, 18, 40][source.below(5) as usize];
        Self { tetrahedra, faces, points, exponent, shift: [0, 0, 1, -3][source.below(4) as usize] }
    }

    /// Checks all rules, the winding number and the signed distance in a precision. Returns the numbers of points
    /// inside, on the surface and outside, by parity. `[CLOSED-1]` `[CLOSED-2]` `[WINDING-1]` `[NEAR-1]`
    ///
    /// # Errors
    /// The first [`SolidFault`].
    pub fn check<V: Precision>(&self) -> Result<[usize; 3], SolidFault> {
        let mesh = self.mesh::<V>()?;
        let (tracer, boundary) = (Tracer::of(&mesh)?, Boundary::of(&mesh));
        let mut counts = [0; 3];
        for &point in &self.points {
            counts[self.check_point(point, &mesh, &tracer, &boundary)? as usize] += 1;
        }
        Ok(counts)
    }

    fn check_point<V: Precision>(
        &self,
        point: Point,
        mesh: &Mesh<V>,
        tracer: &Tracer<WideBvh<8, V>, V>,
        boundary: &Boundary,
    ) -> Result<Location, SolidFault> {
        let at = self.place::<V>(point);
        let Around { covering, number, is_on_surface } = self.around(point);
        let distance = nearest(mesh, at, V::Real::INFINITY, 1).first().map_or(f64::INFINITY, |&(distance, _)| distance);
        let locate = |is_inside| match (is_on_surface, is_inside) {
            (true, _) => Location::Surface,
            (false, true) => Location::Inside,
            (false, false) => Location::Outside,
        };
        for rule in Rule::ALL {
            let solid = Solid::new(tracer, mesh, boundary, rule)?;
            let location = locate(match rule {
                Rule::Parity => covering % 2 == 1,
                Rule::Nonzero => number != 0,
                Rule::Winding => number > 0,
            });
            expect(rule.name(), point, solid.locate(at)?, location)?;
            let signed = if location == Location::Inside { -distance } else { distance };
            expect("signed distance", point, solid.signed_distance(at)?.into(), signed)?;
        }
        if !is_on_surface {
            expect("winding number", point, Winding::new(tracer, mesh, boundary).number(at)?, f64::from(number))?;
        }
        Ok(locate(covering % 2 == 1))
    }

    fn mesh<V: Precision>(&self) -> Result<Mesh<V>, MeshError> {
        let vertices = self.faces.as_flattened().iter().map(|&corner| self.place(corner)).collect();
        let triangles = (0..self.faces.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]);
        Mesh::new(vertices, triangles.collect())
    }

    /// Converts a grid point to space. Its few bits need no rounding.
    fn place<V: Precision>(&self, point: Point) -> V {
        let scale = f64::from(self.exponent).exp2();
        V::from_components(point.map(|x| V::Real::rounded((x + 4096 * self.shift) as f64 * scale)))
    }

    fn around(&self, point: Point) -> Around {
        let mut around = Around { covering: 0, number: 0, is_on_surface: false };
        for corners in &self.tetrahedra {
            match side(corners, point) {
                Location::Inside => {
                    around.covering += 1;
                    around.number += volume(corners).signum() as i32;
                }
                Location::Surface => around.is_on_surface = true,
                Location::Outside => {}
            }
        }
        around
    }
}

/// The position of a point relative to all tetrahedra.
struct Around {
    /// Number of tetrahedra that contain the point in their interior.
    covering: u32,
    /// The winding number.
    number: i32,
    /// Whether the point is on the surface of a tetrahedron.
    is_on_surface: bool,
}

fn expect<T: PartialEq + Debug>(what: &'static str, point: Point, found: T, expected: T) -> Result<(), SolidFault> {
    if found == expected {
        return Ok(());
    }
    let [found, expected] = [found, expected].map(|answer| format!("{answer:?}"));
    Err(SolidFault::Answer { what, point, found, expected })
}

fn corner(source: &mut impl Source) -> Point {
    [(); 3].map(|()| STEP * (source.below(9) as i64 - 4))
}

/// Draws a grid point, often in the interior, on a face, on the line of an edge, or at a corner.
fn point(source: &mut impl Source, tetrahedra: &[[Point; 4]], faces: &[[Point; 3]]) -> Point {
    let [a, b, c] = faces[source.below(faces.len() as u64) as usize];
    let along = |a: Point, b: Point, parts: i64| [0, 1, 2].map(|axis| a[axis] + parts * (b[axis] - a[axis]) / STEP);
    match source.below(6) {
        0 => a,
        // On the line of an edge, possibly beyond its ends.
        1 => along(a, b, source.below(9) as i64 - 2),
        // In the plane of a face.
        2 => along(along(a, b, source.below(5) as i64), c, [0, 2, 4][source.below(3) as usize]),
        // Close to the middle of a tetrahedron.
        3 | 4 => {
            let corners = tetrahedra[source.below(tetrahedra.len() as u64) as usize];
            [0, 1, 2].map(|axis| corners.iter().map(|p| p[axis]).sum::<i64>() / 4 + source.below(3) as i64)
        }
        _ => [(); 3].map(|()| source.below(41) as i64 - 20),
    }
}

/// Returns six times the volume of a tetrahedron; positive if its faces are counterclockwise from outside.
fn volume([a, b, c, d]: &[Point; 4]) -> i64 {
    let [u, v, w] = [b, c, d].map(|p| [0, 1, 2].map(|axis| p[axis] - a[axis]));
    let minor = |i: usize, j: usize| v[i] * w[j] - v[j] * w[i];
    u[0] * minor(1, 2) + u[1] * minor(2, 0) + u[2] * minor(0, 1)
}

/// Locates a point by the volumes that it spans with the faces.
fn side(corners: &[Point; 4], point: Point) -> Location {
    let sign = volume(corners).signum();
    let sides = [0, 1, 2, 3].map(|i| {
        let mut with = *corners;
        with[i] = point;
        sign * volume(&with).signum()
    });
    match sides.into_iter().min() {
        Some(1) => Location::Inside,
        Some(0) => Location::Surface,
        _ => Location::Outside,
    }
}

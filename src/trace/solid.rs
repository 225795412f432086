//! Inside and outside: classification of points by the solid that a closed mesh bounds.

use super::winding::along;
use super::{Boundary, MeshQueries, OpenEdge, Winding};
use crate::geom::{Ball, Mesh, RayError, Real as _, Vector};

/// Rules that define the inside by crossings of a closed mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rule {
    /// Points with an odd number of crossings are inside. The mesh must be closed; overlapping parts cancel out.
    #[default]
    Parity,
    /// Points with a winding number other than 0 are inside. The mesh must be closed and oriented; overlapping parts
    /// unite.
    Nonzero,
    /// Points with a [winding number](Winding) above 1/2 are inside, for any mesh. For a mesh with holes, this is a
    /// good estimate.
    Winding,
}

impl Rule {
    /// All rules.
    pub const ALL: [Self; 3] = [Self::Parity, Self::Nonzero, Self::Winding];

    /// Returns its name: `parity`, `nonzero` or `winding`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parity => "parity",
            Self::Nonzero => "nonzero",
            Self::Winding => "winding",
        }
    }
}

/// The location of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// In the solid.
    Inside,
    /// On a triangle that has an area, exactly.
    Surface,
    /// Neither inside nor on the surface.
    Outside,
}

/// Errors of [`Solid::new`]: the rule does not fit the mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SolidError {
    /// The mesh is open.
    #[error("the mesh is open: {count} edges are covered an odd number of times{}; rule `winding` fits", named(*.first))]
    Open {
        /// Number of open edges.
        count: usize,
        /// An open edge of the first face with one.
        first: Option<OpenEdge>,
    },
    /// The mesh is closed, but its faces do not have a common orientation.
    #[error(
        "the mesh is not oriented: faces run through {0} edges more often in one direction than in the other; rule `parity` fits"
    )]
    Unoriented(usize),
}

/// The solid that a mesh bounds, with point queries; they are exact for closed meshes.
///
/// ```
/// use stackless_bvh::generate::stress;
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::trace::{Boundary, Location, Rule, Solid, Tracer};
///
/// let mesh = stress::icosphere(2, 1.0, Vec3::ZERO)?;
/// let (tracer, boundary) = (Tracer::of(&mesh)?, Boundary::of(&mesh));
/// let solid = Solid::new(&tracer, &mesh, &boundary, Rule::Parity)?;
/// assert_eq!(solid.locate(Vec3::splat(0.1))?, Location::Inside);
/// assert_eq!(solid.locate(mesh.vertices()[0])?, Location::Surface);
/// assert_eq!(solid.locate(Vec3::splat(0.9))?, Location::Outside);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Solid<'t, T, V: Vector> {
    tracer: &'t T,
    boundary: &'t Boundary,
    rule: Rule,
    winding: Winding<'t, T, V>,
}

impl<'t, T: MeshQueries<V>, V: Vector> Solid<'t, T, V> {
    /// Creates the solid of a mesh by a rule; `tracer` and `boundary` must be those of the mesh.
    ///
    /// # Errors
    /// [`SolidError`] if the rule does not fit.
    pub fn new(tracer: &'t T, mesh: &'t Mesh<V>, boundary: &'t Boundary, rule: Rule) -> Result<Self, SolidError> {
        if rule != Rule::Winding && !boundary.is_closed() {
            return Err(SolidError::Open { count: boundary.open, first: boundary.first });
        }
        if rule == Rule::Nonzero && !boundary.is_oriented() {
            return Err(SolidError::Unoriented(boundary.unpaired));
        }
        Ok(Self { tracer, boundary, rule, winding: Winding::new(tracer, mesh, boundary) })
    }

    /// Locates a point, exactly. `[CLOSED-2]`
    ///
    /// # Errors
    /// [`RayError`] for a point that is not finite.
    pub fn locate(&self, point: V) -> Result<Location, RayError> {
        let (length, exit) = self.boundary.exit(point.widen());
        // It leaves the bounds soonest: for a closed mesh all rays give one answer.
        let ray = along(point, exit)?;
        let crossings = |signed| if length < 0.0 { Some(0) } else { self.tracer.crossings_off_surface(&ray, signed) };
        let is_inside = match self.rule {
            Rule::Parity => crossings(false).map(|count| count % 2 == 1),
            Rule::Nonzero => crossings(true).map(|winding| winding != 0),
            Rule::Winding => self.winding.is_inside(point)?,
        };
        Ok(match is_inside {
            None => Location::Surface,
            Some(true) => Location::Inside,
            Some(false) => Location::Outside,
        })
    }

    /// Computes the signed distance of a point from the mesh: the float nearest to the exact distance, negative inside.
    /// It is also 0 on triangles without area, and infinite if there are no triangles. `[NEAR-1]` `[CLOSED-2]`
    ///
    /// ```
    /// use stackless_bvh::geom::Mesh;
    /// use stackless_bvh::glam::DVec3;
    /// use stackless_bvh::trace::{Boundary, Rule, Solid, Tracer};
    ///
    /// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let mesh = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
    /// let (tracer, boundary) = (Tracer::of(&mesh)?, Boundary::of(&mesh));
    /// let solid = Solid::new(&tracer, &mesh, &boundary, Rule::Parity)?;
    /// let distance = |x, y, z| solid.signed_distance(DVec3::new(x, y, z));
    /// assert_eq!([distance(0.125, 0.25, 0.25)?, distance(0.5, 0.0, 0.0)?, distance(0.0, 0.0, -2.0)?], [-0.125, 0.0, 2.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RayError`] for a point that is not finite.
    pub fn signed_distance(&self, point: V) -> Result<V::Real, RayError> {
        // `signed` refuses the points that cannot be the center of a ball.
        let near = Ball::around(point).ok().and_then(|ball| self.tracer.nearest(&ball));
        self.signed(point, near.map_or(V::Real::INFINITY, |near| near.distance))
    }

    /// Applies the sign to the distance of a point from the mesh: negative inside. `[CLOSED-2]`
    ///
    /// # Errors
    /// [`RayError`] for a point that is not finite.
    pub fn signed(&self, point: V, distance: V::Real) -> Result<V::Real, RayError> {
        // Points on the surface have the distance 0.
        let is_inside = distance > V::Real::ZERO && self.locate(point)? == Location::Inside;
        Ok(if is_inside { V::Real::rounded(-distance.into()) } else { distance })
    }
}

fn named(edge: Option<OpenEdge>) -> String {
    edge.map_or_else(String::new, |OpenEdge { face, ends: [from, to], .. }| {
        format!(", first that of faces[{face}] from vertex {from} to vertex {to}")
    })
}

#[cfg(test)]
mod tests;

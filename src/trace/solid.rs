//! Inside and outside: which points are in the solid that a closed mesh bounds.

use super::{Boundary, MeshQueries, OpenEdge, RayQueries, Winding};
use crate::geom::{Mesh, Ray, RayError, Real as _, Vector};

/// How crossings of a closed mesh tell inside from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rule {
    /// Points with an odd number of crossings are inside. The mesh must be closed; overlapping parts cancel out.
    #[default]
    Parity,
    /// Points with a winding number other than 0 are inside. The mesh must be closed and oriented; overlapping parts
    /// unite.
    Nonzero,
    /// Points with a [winding number](Winding) above 1/2 are inside, whatever the mesh. Where it has holes, this is a
    /// good guess.
    Winding,
}

/// Where a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// In the solid.
    Inside,
    /// On a triangle that has an area, exactly.
    Surface,
    /// Elsewhere.
    Outside,
}

/// Why a rule does not fit a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SolidError {
    /// The mesh has an end.
    #[error("the mesh is open: {count} edges are covered an odd number of times{}; rule `winding` fits", named(*.first))]
    Open {
        /// How many edges are open.
        count: usize,
        /// An open edge of the first face that has one.
        first: Option<OpenEdge>,
    },
    /// The mesh is closed, but its faces do not have one orientation.
    #[error(
        "the mesh is not oriented: faces run through {0} edges more often in one direction than in the other; rule `parity` fits"
    )]
    Unoriented(usize),
}

/// The solid that a mesh bounds, and answers about points: exact ones of closed meshes.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::generate::stress;
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
    rule: Rule,
    winding: Winding<'t, T, V>,
}

impl<'t, T: RayQueries<Ray<V>> + MeshQueries<V>, V: Vector> Solid<'t, T, V> {
    /// The solid of a mesh by a rule; `tracer` and `boundary` must be made of the mesh.
    ///
    /// # Errors
    /// [`SolidError`] where the rule does not fit.
    pub fn new(tracer: &'t T, mesh: &'t Mesh<V>, boundary: &'t Boundary, rule: Rule) -> Result<Self, SolidError> {
        if rule != Rule::Winding && !boundary.is_closed() {
            return Err(SolidError::Open { count: boundary.open, first: boundary.first });
        }
        if rule == Rule::Nonzero && !boundary.is_oriented() {
            return Err(SolidError::Unoriented(boundary.unpaired));
        }
        Ok(Self { tracer, rule, winding: Winding::new(tracer, mesh, boundary) })
    }

    /// Says where a point is, exactly. `[CLOSED-2]`
    ///
    /// # Errors
    /// [`RayError`] for a point that is not finite.
    pub fn locate(&self, point: V) -> Result<Location, RayError> {
        let (zero, one) = (V::Real::ZERO, V::Real::ONE);
        let axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]].map(V::from_components);
        // The plane of a triangle with an area is not parallel to all three axes, so one of these rays of length 0 hits
        // it.
        for axis in axes {
            if self.tracer.any(&Ray::within(point, axis, zero, zero)?) {
                return Ok(Location::Surface);
            }
        }
        let ray = Ray::new(point, axes[0])?;
        let is_inside = match self.rule {
            Rule::Parity => self.tracer.crossings(&ray) % 2 == 1,
            Rule::Nonzero => self.tracer.winding(&ray) != 0,
            Rule::Winding => self.winding.number(point)? > 0.5,
        };
        Ok(if is_inside { Location::Inside } else { Location::Outside })
    }
}

fn named(edge: Option<OpenEdge>) -> String {
    edge.map_or_else(String::new, |OpenEdge { face, ends: [from, to], .. }| {
        format!(", first that of faces[{face}] from vertex {from} to vertex {to}")
    })
}

#[cfg(test)]
mod tests;

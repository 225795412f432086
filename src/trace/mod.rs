//! Ray queries as visitors: what a traversal asks at each node to find the closest hit, or any.
//!
//! [`Closest`] and [`Any`] test both children at their parent, so the root's own box is not tested. [`ClosestByNode`]
//! and [`AnyByNode`] test a node's own box at its visit, for the traversals that are made that way. The answer to a
//! closest-hit query is the same, bit for bit, for every tree over the same mesh, every order and every traversal;
//! see [`Triangle`] for why. Of an any-hit query, only whether there is a hit is.

mod bounce;
mod query;

pub use bounce::bounce;
pub use query::{Any, AnyByNode, Closest, ClosestByNode, Counted, NodeSearch, Search};

use crate::geom::{Ray, RaySlabs, Triangle};
use crate::scene::Mesh;

/// Where a ray meets a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// Weight of the triangle's second corner.
    pub u: f32,
    /// Weight of the triangle's third corner.
    pub v: f32,
}

impl Hit {
    /// Whether this is less in the order (t, primitive).
    #[inline]
    pub fn is_before(&self, other: &Self) -> bool {
        self.t < other.t || self.t == other.t && self.prim < other.prim
    }
}

/// The closest hit by testing all triangles, in time linear in their number: the truth for the tests.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{geom::Ray, scene::Mesh, trace};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let ray = Ray::new(Vec3::new(0.25, 0.5, -2.0), Vec3::Z, 0.0, f32::INFINITY)?;
/// let hit = trace::brute_force(&mesh, &ray).ok_or("missed")?;
/// assert_eq!((hit.prim, hit.t, hit.u, hit.v), (0, 2.0, 0.25, 0.5));
/// # Ok(())
/// # }
/// ```
pub fn brute_force(mesh: &Mesh, ray: &Ray) -> Option<Hit> {
    let slabs = RaySlabs::new(ray);
    let hits = (0..mesh.triangles().len()).filter_map(|i| {
        let crate::geom::Hit { t, u, v } = Triangle(mesh.triangle(i)).intersect(ray, &slabs)?;
        Some(Hit { prim: i as u32, t, u, v })
    });
    hits.reduce(|best, hit| if hit.is_before(&best) { hit } else { best })
}

#[cfg(test)]
mod tests;

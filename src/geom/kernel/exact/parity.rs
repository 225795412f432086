//! The triangles that a ray crosses when crossings are counted.
//!
//! A closed triangle is met at its edges and corners too, so no ray slips between two triangles. But a ray through an
//! edge meets both triangles there, and a ray that touches a surface meets two triangles and crosses none. Here the
//! ray's origin is moved, by (ε, ε², ε³) with an ε that is positive and smaller than any number. Then the ray meets no
//! edge and no corner, and each crossing is that of one triangle. (Edelsbrunner & Mücke 1990, "Simulation of
//! simplicity".)
//!
//! The edge function of the edge from X to Y, relative to the origin, is d . (Y x X). If the origin moves by m, it
//! becomes d . ((Y - m) x (X - m)) = d . (Y x X) + m . ((Y - X) x d), exactly. So if it is 0, its sign is that of the
//! first component of (Y - X) x d that is not 0. From Y to X both have the opposite sign: the two triangles at an edge
//! decide consistently. If all components are 0, the edge is parallel to the ray; then the determinant is 0, and the
//! moved ray misses. The determinant does not change, and the distance changes by less than any number. `[PARITY-1]`

use std::cmp::Ordering;

use glam::DVec3;

use super::filter::Determinants;
use super::predicates::{edge, sign};
use super::{Exact, Exact64};
use crate::geom::{Kernel, Triangle};

/// A triangle test that can count crossings.
pub trait Parity: Kernel<Shape = Triangle<<Self as Kernel>::Vector>> {
    /// Computes [`Exact::crosses`], in either precision. `[PARITY-1]`
    fn is_crossing(&self, shape: &Self::Shape) -> bool;

    /// Returns the side of a triangle from which a ray that crosses it comes. It is 1 from behind, where the ray leaves
    /// the solid of a mesh with faces counterclockwise from outside, and -1 from the front. For a triangle that is
    /// parallel to the ray, it is 0.
    fn sense(&self, shape: &Self::Shape) -> i32;
}

impl Parity for Exact {
    #[inline]
    fn is_crossing(&self, shape: &Triangle) -> bool {
        self.crosses(shape)
    }

    fn sense(&self, shape: &Triangle) -> i32 {
        sense(&shape.widen(), self.direction, true)
    }
}

impl Parity for Exact64 {
    fn is_crossing(&self, shape: &Triangle<DVec3>) -> bool {
        self.crosses(shape)
    }

    fn sense(&self, shape: &Triangle<DVec3>) -> i32 {
        self.sense(shape)
    }
}

/// Returns the sign of d . n, for the normal n.
pub(super) fn sense(&[a, b, c]: &[DVec3; 3], d: DVec3, has_room: bool) -> i32 {
    sign(d, [a, b], [a, c], has_room) as i32
}

impl Exact {
    /// Returns whether the ray crosses the triangle within its interval, ends included, by the rule that counts each
    /// crossing of a closed mesh once: at an edge or corner, for one of the triangles there. `[PARITY-1]`
    ///
    /// It holds for some of the triangles that [`distance`](super::Kernel::distance) finds, and for no other triangles.
    /// The number of triangles of a closed mesh that a ray without end crosses is odd if the mesh winds around its
    /// origin an odd number of times, as it does around a point inside; unless the origin is on the mesh.
    ///
    /// ```
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::internals::geom::kernel::{Exact, Kernel};
    /// use stackless_bvh::geom::{Aabb, Ray, Region, Triangle};
    ///
    /// // A square of two triangles, and a ray through the diagonal.
    /// let [a, b, c, d] = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    /// let ray = Ray::new(Vec3::new(0.5, 0.5, -1.0), Vec3::Z)?;
    /// let exact = Exact::new(&ray, &Region::of(&Aabb::of(&[a, b, c, d])));
    /// let square = [Triangle([a, b, c]), Triangle([a, c, d])];
    /// assert_eq!(square.map(|triangle| exact.blocks(&triangle)), [true, true]);
    /// assert_eq!(square.iter().filter(|triangle| exact.crosses(triangle)).count(), 1);
    /// # Ok::<(), stackless_bvh::geom::RayError>(())
    /// ```
    #[inline]
    pub fn crosses(&self, shape: &Triangle) -> bool {
        let corners = shape.widen();
        let found = Determinants::of(&corners, self.origin, self.direction);
        if found.is_miss(&self.errors) {
            false
        } else if found.is_hit(&self.errors) {
            self.blocks(shape)
        } else {
            is_crossed_by_line(&corners, self.origin, self.direction, true) && self.blocks(shape)
        }
    }
}

/// Returns whether the moved line meets the triangle: whether all edge functions have one sign. It uses twice the
/// digits if they have room.
#[cold]
#[inline(never)]
pub(super) fn is_crossed_by_line(&[a, b, c]: &[DVec3; 3], o: DVec3, d: DVec3, has_room: bool) -> bool {
    let first = side([b, c], o, d, has_room);
    first.is_ne() && [[c, a], [a, b]].into_iter().all(|edge| side(edge, o, d, has_room) == first)
}

/// Returns the sign of an edge function for the moved origin; 0 if the edge is parallel to the direction.
fn side([from, to]: [DVec3; 2], o: DVec3, d: DVec3, has_room: bool) -> Ordering {
    let moved = |axis: DVec3| sign(axis, [from, to], [DVec3::ZERO, d], has_room);
    [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .fold(edge(d, o, from, to, has_room), |side, axis| side.then_with(|| moved(axis)))
}

#[cfg(test)]
mod tests;

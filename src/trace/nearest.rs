//! The nearest point of a mesh.

use glam::Vec3;

use super::query::BoxQuery;
use crate::bvh::Bvh;
use crate::geom::{Aabb, Measure, Triangle};
use crate::order::{Descent, Flow, Repeatable, Side, Visitor};
use crate::tree::{Node, Topology};

/// The point of a mesh that is nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// The float nearest to the exact distance.
    pub distance: f32,
    /// Where on the triangle, to about the precision of floats.
    pub point: Vec3,
}

/// A search for the nearest point of a mesh within a radius, exact: the triangle of the least distance, rounded to the
/// nearest float, and of equal ones that of the least index. `[NEAR-1]`
///
/// It is no ray query, yet runs in the same traversals: they know no geometry. Degenerate triangles are not part of the
/// mesh, as they are not for rays.
#[derive(Clone, Debug)]
pub struct NearestPoint<'a> {
    bvh: &'a Bvh,
    measure: Measure,
    /// Distance of the best triangle, or the radius.
    limit: f32,
    /// The best triangle, and where it is in the hierarchy.
    found: Option<(u32, usize)>,
}

/// Why numbers are not a point and a radius.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NearError {
    /// A coordinate is NaN or infinite.
    #[error("point {0} is not finite")]
    Point(Vec3),
    /// The radius is negative or NaN.
    #[error("radius {0} is negative or not a number")]
    Radius(f32),
}

impl<'a> NearestPoint<'a> {
    /// Prepares a search. The radius may be infinite.
    ///
    /// # Errors
    /// What [`NearError`] lists.
    pub fn new(bvh: &'a Bvh, point: Vec3, radius: f32) -> Result<Self, NearError> {
        if !point.is_finite() {
            return Err(NearError::Point(point));
        }
        if radius.is_nan() || radius < 0.0 {
            return Err(NearError::Radius(radius));
        }
        Ok(Self { bvh, measure: Measure::new(point, radius), limit: radius, found: None })
    }

    /// What is nearest, after the traversal.
    pub fn near(&self) -> Option<Near> {
        let (prim, place) = self.found?;
        let point = self.measure.nearest(&self.bvh.triangles()[place].shape);
        Some(Near { prim, distance: self.limit, point })
    }

    fn is_better(&self, distance: f32, prim: u32, triangle: &Triangle) -> bool {
        let is_better = match self.found {
            Some((best, _)) => (distance, prim) < (self.limit, best),
            None => true,
        };
        // A hierarchy has a triangle even if all of the mesh are degenerate.
        is_better && !triangle.is_degenerate()
    }
}

impl Visitor for NearestPoint<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let record = self.bvh.node(node.index());
        // Rounding keeps the order, so what is in the box is at least at its rounded distance.
        let [left, right] = [Side::Left, Side::Right].map(|side| self.measure.to_box(&record.child_box(side)) as f32);
        Descent::new(left <= self.limit, right <= self.limit, right < left)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let range = self.bvh.leaf_range(node);
        for (place, held) in range.clone().zip(&self.bvh.triangles()[range]) {
            if let Some(distance) = self.measure.distance(&held.shape, self.limit)
                && self.is_better(distance, held.prim, &held.shape)
            {
                (self.limit, self.found) = (distance, Some((held.prim, place)));
            }
        }
        Flow::Continue
    }
}

impl Repeatable for NearestPoint<'_> {}

impl BoxQuery for NearestPoint<'_> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.measure.to_box(aabb) as f32 <= self.limit
    }

    fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}

//! The nearest point of a mesh, and the nearest several triangles.

mod several;

pub use several::NearestPoints;

use glam::Vec3;

use super::query::BoxQuery;
use crate::bvh::Bvh;
use crate::geom::{Aabb, Ball, Measure};
use crate::order::{Descent, Flow, Pruned, Repeatable, Side, Visitor};
use crate::tree::{Node, Topology};

/// The point of a mesh that is nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// The float nearest to the exact distance.
    pub distance: f32,
    /// Where on the triangle: the exact nearest point, each coordinate rounded once, to the nearest float. A zero is
    /// positive. `[NEAR-3]`
    pub point: Vec3,
}

/// A search for the nearest point of a mesh within a radius, exact: the triangle of the least distance, rounded to the
/// nearest float, and of equal ones that of the least index. `[NEAR-1]`
///
/// It is no ray query, yet runs in the same traversals: they know no geometry. Degenerate triangles are not part of the
/// mesh, as they are not for rays.
#[derive(Clone, Debug)]
pub struct NearestPoint<'a> {
    around: Around<'a>,
    /// The best triangle, and where it is in the hierarchy. Its distance is the limit.
    found: Option<(u32, usize)>,
}

impl<'a> NearestPoint<'a> {
    /// Prepares a search.
    pub fn new(bvh: &'a Bvh, ball: &Ball) -> Self {
        Self { around: Around::new(bvh, ball), found: None }
    }

    /// What is nearest, after the traversal.
    pub fn near(&self) -> Option<Near> {
        let (prim, place) = self.found?;
        Some(self.around.near(prim, self.around.limit, place))
    }
}

impl Visitor for NearestPoint<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.around.descend(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let found = &mut self.found;
        self.around.meet(node, |limit, (distance, prim, place)| {
            if found.is_none_or(|(best, _)| (distance, prim) < (limit, best)) {
                *found = Some((prim, place));
                return distance;
            }
            limit
        });
        Flow::Continue
    }
}

impl Pruned for NearestPoint<'_> {}

impl Repeatable for NearestPoint<'_> {}

impl BoxQuery for NearestPoint<'_> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.around.touches(aabb)
    }

    fn slot(&self, node: Node) -> usize {
        self.around.bvh.slot(node)
    }
}

/// A ball around a point that shrinks as nearer triangles are found.
#[derive(Clone, Debug)]
struct Around<'a> {
    bvh: &'a Bvh,
    measure: Measure,
    /// What is farther away does not matter any more.
    limit: f32,
}

impl<'a> Around<'a> {
    fn new(bvh: &'a Bvh, ball: &Ball) -> Self {
        Self { bvh, measure: Measure::new(ball.center(), ball.radius()), limit: ball.radius() }
    }

    fn descend(&self, node: Node) -> Descent {
        let record = self.bvh.node(node.index());
        // Rounding keeps the order, so what is in the box is at least at its rounded distance.
        let [left, right] = [Side::Left, Side::Right].map(|side| self.measure.to_box(&record.child_box(side)) as f32);
        Descent::new(left <= self.limit, right <= self.limit, right < left)
    }

    fn touches(&self, aabb: &Aabb) -> bool {
        self.measure.to_box(aabb) as f32 <= self.limit
    }

    /// Shows the triangles of a leaf within the limit: the limit and, of each, distance, index and place in the
    /// hierarchy. The answer is the new limit.
    fn meet(&mut self, leaf: Node, mut found: impl FnMut(f32, (f32, u32, usize)) -> f32) {
        let range = self.bvh.leaf_range(leaf);
        for (place, held) in range.clone().zip(&self.bvh.triangles()[range]) {
            if let Some(distance) = self.measure.distance(&held.shape, self.limit)
                && distance <= self.limit
                // A hierarchy has a triangle even if all of the mesh are degenerate.
                && !held.shape.is_degenerate()
            {
                self.limit = found(self.limit, (distance, held.prim, place));
            }
        }
    }

    fn near(&self, prim: u32, distance: f32, place: usize) -> Near {
        Near { prim, distance, point: self.measure.nearest(&self.bvh.triangles()[place].shape) }
    }
}

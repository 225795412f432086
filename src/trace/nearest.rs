//! The nearest point of a mesh, and the nearest several triangles.

mod several;

pub use several::NearestPoints;

use glam::Vec3;

use super::held::Held;
use super::query::BoxQuery;
use crate::bvh::Bvh;
use crate::geom::{Aabb, Ball, Measure, Triangle};
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
pub struct NearestPoint<'a, H = Bvh> {
    pub(super) around: Around<'a, H>,
    /// The best triangle, and where it is in the hierarchy. Its distance is the limit.
    found: Option<(u32, usize)>,
}

impl<'a, H: Held<Triangle>> NearestPoint<'a, H> {
    /// Prepares a search.
    pub fn new(bvh: &'a H, ball: &Ball) -> Self {
        Self { around: Around::new(bvh, ball), found: None }
    }

    /// What is nearest, after the traversal.
    pub fn near(&self) -> Option<Near> {
        let (prim, place) = self.found?;
        Some(self.around.near(prim, self.around.limit, place))
    }

    pub(super) fn meet(&mut self, leaf: Node) {
        let Self { around, found } = self;
        around.meet(leaf, |limit, (distance, prim, place)| {
            if found.is_none_or(|(best, _)| (distance, prim) < (limit, best)) {
                *found = Some((prim, place));
                return distance;
            }
            limit
        });
    }
}

impl Visitor for NearestPoint<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.around.descend(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.meet(node);
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
pub(super) struct Around<'a, H> {
    pub(super) bvh: &'a H,
    measure: Measure,
    /// What is farther away does not matter any more.
    pub(super) limit: f32,
}

impl<'a, H: Held<Triangle>> Around<'a, H> {
    fn new(bvh: &'a H, ball: &Ball) -> Self {
        Self { bvh, measure: Measure::new(ball.center(), ball.radius()), limit: ball.radius() }
    }

    /// The point.
    pub(super) fn point(&self) -> Vec3 {
        self.measure.point()
    }

    /// At most the distance of what is in a box: rounding keeps the order.
    fn to_box(&self, aabb: &Aabb) -> f32 {
        self.measure.to_box(aabb) as f32
    }

    /// Shows the triangles of a leaf within the limit: the limit and, of each, distance, index and place in the
    /// hierarchy. The answer is the new limit.
    fn meet(&mut self, leaf: Node, mut found: impl FnMut(f32, (f32, u32, usize)) -> f32) {
        let Self { bvh, measure, limit } = self;
        bvh.for_each(leaf, |place, shape, prim| {
            // Its box is measured faster.
            if measure.to_box(&shape.aabb()) as f32 <= *limit
                && let Some(distance) = measure.distance(shape, *limit)
                && distance <= *limit
                // A hierarchy has a triangle even if all of the mesh are degenerate.
                && !shape.is_degenerate()
            {
                *limit = found(*limit, (distance, prim, place));
            }
        });
    }

    fn near(&self, prim: u32, distance: f32, place: usize) -> Near {
        Near { prim, distance, point: self.measure.nearest(&self.bvh.shape(place)) }
    }
}

impl Around<'_, Bvh> {
    fn descend(&self, node: Node) -> Descent {
        let record = self.bvh.node(node.index());
        let [left, right] = [Side::Left, Side::Right].map(|side| self.to_box(&record.child_box(side)));
        Descent::new(left <= self.limit, right <= self.limit, right < left)
    }

    fn touches(&self, aabb: &Aabb) -> bool {
        self.to_box(aabb) <= self.limit
    }
}

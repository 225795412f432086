//! The nearest point of a mesh, and the k nearest triangles.

mod several;

pub use several::NearestPoints;

use glam::Vec3;

use super::leaf_primitives::NearTriangles;
use super::query::binary_query;
use crate::bvh::{Bvh, BvhNode};
use crate::geom::{Aabb, Ball, Measure, Real, Triangle, Vector};
use crate::order::{Descent, Repeatable, Side};
use crate::tree::{Node, Topology};

/// The point of a mesh nearest to a query point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near<V: Vector = Vec3> {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// The float nearest to the exact distance.
    pub distance: V::Real,
    /// The exact nearest point on the triangle, each coordinate rounded once to the nearest float. A zero is positive.
    /// `[NEAR-3]`
    pub point: V,
}

/// A search for the nearest point of a mesh within a radius, exact: the triangle of the least distance, rounded to the
/// nearest float, and of equal distances that of the least index. `[NEAR-1]`
///
/// It runs in the same traversals as ray queries, because they are independent of geometry. Degenerate triangles, which
/// rays miss, are segments and points here, unless the hierarchy [omits them](crate::bvh::Degenerate). Meshes in double
/// precision have points and distances in double precision.
#[derive(Clone, Debug)]
pub struct NearestPoint<'a, H = Bvh, V: Vector = Vec3> {
    pub(super) around: Around<'a, H, V>,
    best: Option<Best>,
}

/// The nearest triangle so far.
#[derive(Clone, Copy, Debug)]
struct Best {
    prim: u32,
    /// Its place in the hierarchy.
    place: usize,
    /// A lower bound of its distance while that is open. Then its distance is less than that of any other triangle, and
    /// at most the limit. Most triangles are replaced before their digits are computed.
    open: Option<f64>,
}

impl<'a, V: Vector, H: NearTriangles<V>> NearestPoint<'a, H, V> {
    /// Prepares a search.
    pub fn new(bvh: &'a H, ball: &Ball<V>) -> Self {
        Self { around: Around::new(bvh, ball), best: None }
    }

    /// Returns the nearest point, after the traversal.
    pub fn near(&self) -> Option<Near<V>> {
        let Best { prim, place, open } = self.best?;
        if open.is_none() {
            return Some(self.around.near(prim, self.around.limit.distance, place));
        }
        let (distance, point) = self.around.measure.distance_and_nearest(&self.around.bvh.shape(place));
        Some(Near { prim, distance, point })
    }

    pub(super) fn meet(&mut self, leaf: Node) {
        let Around { bvh, measure, limit } = &self.around;
        bvh.for_each_near(leaf, measure.point(), limit.distance, |place, shape, prim| {
            if let Some(bounds) = self.around.bounds(shape, prim) {
                self.compare(bounds, shape, Best { prim, place, open: None });
            }
            self.around.limit.distance
        });
    }

    fn compare(&mut self, bounds: [f64; 2], shape: &Triangle<V>, new: Best) {
        let most = V::Real::rounded(bounds[1]);
        // False for a NaN.
        if !self.best.and_then(|best| best.open).is_none_or(|open| most < V::Real::rounded(open)) {
            self.settle();
        }
        let Around { measure, limit, .. } = &mut self.around;
        let certain = measure.certain(bounds.map(|bound| [bound, 0.0]));
        if certain.is_none() && most < limit.distance {
            *limit = Limit { distance: most, prim: u32::MAX };
            self.best = Some(Best { open: Some(bounds[0]), ..new });
            return;
        }
        let Some(distance) = certain.or_else(|| measure.settle(shape, bounds[1], limit.end(new.prim))) else { return };
        let near = Limit { distance, prim: new.prim };
        if near < *limit {
            *limit = near;
            self.best = Some(new);
        }
    }

    /// Finds the distance of the best triangle, if it is open.
    fn settle(&mut self) {
        let Around { bvh, measure, limit } = &mut self.around;
        if let Some(Best { prim, place, open: open @ Some(_) }) = &mut self.best
            && let Some(distance) = measure.distance(&bvh.shape(*place), limit.distance)
        {
            (*limit, *open) = (Limit { distance, prim: *prim }, None);
        }
    }
}

binary_query!([V: Vector] NearestPoint<'_, Bvh<Triangle<V>>, V>, around.descend);

impl<V: Vector> Repeatable for NearestPoint<'_, Bvh<Triangle<V>>, V> {}

/// A ball around a point. It shrinks as nearer triangles are found.
#[derive(Clone, Debug)]
pub(super) struct Around<'a, H, V: Vector = Vec3> {
    pub(super) bvh: &'a H,
    measure: Measure<V>,
    pub(super) limit: Limit<V::Real>,
}

/// Triangles after the limit, by distance and then by index, are irrelevant.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Limit<R> {
    pub(super) distance: R,
    /// Greater than any index while the distance is the radius, or open.
    prim: u32,
}

impl<R: Real> Limit<R> {
    /// Returns the greatest distance of a triangle that does not come after it.
    fn end(&self, prim: u32) -> R {
        if prim > self.prim { self.distance.next_down() } else { self.distance }
    }
}

impl<'a, V: Vector, H: NearTriangles<V>> Around<'a, H, V> {
    fn new(bvh: &'a H, ball: &Ball<V>) -> Self {
        let measure = Measure::within(bvh.region().frame(), ball.center(), ball.radius());
        Self { bvh, measure, limit: Limit { distance: ball.radius(), prim: u32::MAX } }
    }

    /// Returns the measure of distances from the point.
    pub(super) fn measure(&self) -> &Measure<V> {
        &self.measure
    }

    /// Returns the distance beyond which boxes are irrelevant, in the units of their frame.
    pub(super) fn end(&self) -> f32 {
        self.measure.in_frame(self.limit.distance)
    }

    /// Returns a lower bound of the distance of points in a box: rounding keeps the order.
    pub(super) fn to_box(&self, aabb: &Aabb) -> V::Real {
        V::Real::rounded(self.measure.to_box(aabb))
    }

    /// Returns whether a measured distance with this relative error may be equal to the limit.
    pub(super) fn is_about_limit(&self, distance: V::Real, off: f64) -> bool {
        // Measured distances are never infinite.
        let [distance, limit, most] = [distance, self.limit.distance, V::Real::INFINITY.next_down()].map(Into::into);
        distance >= limit.min(most) * (1.0 - off)
    }

    /// Returns whether a child whose box has this distance contains no relevant triangle. `[NEAR-6]`
    pub(super) fn is_settled(&self, near: V::Real, child: Node) -> bool {
        let Limit { distance, prim } = self.limit;
        near > distance || near == distance && prim < u32::MAX && self.bvh.least_below(child) > prim
    }

    /// Returns bounds of the distance of a triangle that may come before the limit.
    #[inline]
    fn bounds(&self, shape: &Triangle<V>, prim: u32) -> Option<[f64; 2]> {
        self.measure.bounds(shape, self.limit.end(prim))
    }

    /// Calls `found` for the triangles of a leaf that come before the limit, each with its place in the hierarchy.
    /// `found` returns the new limit, if there is one.
    fn meet(&mut self, leaf: Node, mut found: impl FnMut(Limit<V::Real>, usize) -> Option<Limit<V::Real>>) {
        let Self { bvh, measure, limit } = self;
        bvh.for_each_near(leaf, measure.point(), limit.distance, |place, shape, prim| {
            if let Some(distance) = measure.near_distance(shape, limit.end(prim))
                && let near = (Limit { distance, prim })
                && near < *limit
            {
                *limit = found(near, place).unwrap_or(*limit);
            }
            limit.distance
        });
    }

    fn near(&self, prim: u32, distance: V::Real, place: usize) -> Near<V> {
        Near { prim, distance, point: self.measure.nearest(&self.bvh.shape(place)) }
    }
}

/// Relative error bound of distances of boxes in double precision, with a large margin.
const OFF: f64 = 32.0 * f64::EPSILON;

impl<V: Vector> Around<'_, Bvh<Triangle<V>>, V> {
    fn descend(&self, node: Node) -> Descent {
        let record = self.bvh.node(node.index());
        let [left, right] = [Side::Left, Side::Right].map(|side| self.to_box(&record.child_box(side)));
        let [near, far] = if right < left { [right, left] } else { [left, right] };
        let (limit, is_tie) = (self.limit.distance, near > V::Real::ZERO && far.into() * (1.0 - OFF) <= near.into());
        if near <= limit && (is_tie || self.is_about_limit(near, OFF)) {
            return self.descend_by_digits(record, [left, right], is_tie);
        }
        Descent::new(left <= limit, right <= limit, right < left)
    }

    /// Decides by the last digits of the distances; of equal distances the child of the least index comes first.
    /// `[NEAR-8]`
    #[cold]
    fn descend_by_digits(&self, record: &BvhNode, rough: [V::Real; 2], is_tie: bool) -> Descent {
        let near = [Side::Left, Side::Right].map(|side| self.measure.to_box_by_digits(&record.child_box(side)));
        // The order does not depend on the limit.
        let order = if is_tie { near } else { rough };
        let least = || record.children.map(|child| self.bvh.least_below(child));
        let is_right_first = order[1] < order[0] || order[1] == order[0] && is_tie && least()[1] < least()[0];
        let [mut left, mut right] = rough.map(|near| near <= self.limit.distance);
        let [left_settled, right_settled] = [0, 1].map(|i| self.is_settled(near[i], record.children[i]));
        // The first child is not dropped alone (LAINE-1).
        if if is_right_first { left_settled } else { right_settled } {
            (left, right) = (left && !left_settled, right && !right_settled);
        }
        Descent::new(left, right, is_right_first)
    }

    fn touches(&self, aabb: &Aabb) -> bool {
        self.to_box(aabb) <= self.limit.distance
    }

    fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}

//! Exact test whether boxes cover a triangle.

use crate::geom::truth::{Number, RBig};
use crate::geom::{Aabb, Frame, Triangle, Vector};

/// Returns whether the union of these closed boxes, in a frame, contains the closed triangle; exact.
pub(super) fn hold<V: Vector>(frame: &Frame, boxes: &[Aabb], triangle: &Triangle<V>) -> bool {
    surely_hold(frame, boxes, triangle) || covers(frame, boxes, triangle)
}

/// Decides easy cases, which are nearly all after a build: false if undecided.
///
/// Each box in turn is subtracted from boxes that contain the parts of the triangle which are not yet covered.
fn surely_hold<V: Vector>(frame: &Frame, boxes: &[Aabb], triangle: &Triangle<V>) -> bool {
    let mut pending = vec![(frame.aabb(triangle), boxes)];
    while let Some((mut around, boxes)) = pending.pop() {
        let Some((aabb, boxes)) = boxes.split_first() else { return false };
        for (axis, is_upper) in SIDES {
            let (plane, sticks_out) = if is_upper {
                (aabb.hi[axis], aabb.hi[axis] < around.hi[axis])
            } else {
                (aabb.lo[axis], around.lo[axis] < aabb.lo[axis])
            };
            if sticks_out {
                let (mut outside, mut inside) = (around, around);
                let (outer, inner) =
                    if is_upper { (&mut outside.lo, &mut inside.hi) } else { (&mut outside.hi, &mut inside.lo) };
                outer[axis] = if is_upper { outer[axis].max(plane) } else { outer[axis].min(plane) };
                inner[axis] = plane;
                let has_points = |aabb: &Aabb| aabb.lo.cmple(aabb.hi).all();
                pending.extend(Some(frame.part(triangle, &outside)).filter(has_points).map(|outside| (outside, boxes)));
                around = frame.part(triangle, &inside);
                if !has_points(&around) {
                    break;
                }
            }
        }
    }
    true
}

/// The sides of a box: axis, and whether it is the upper one.
const SIDES: [(usize, bool); 6] = [(0, false), (0, true), (1, false), (1, true), (2, false), (2, true)];

/// Decides by rational arithmetic.
///
/// Each box in turn is subtracted: the rest of a polygon beyond the first plane of the box, beyond the second within
/// the first, and so on, consists of polygons. Boxes are closed, so the uncovered part of a triangle is open in it.
/// This part is empty or has the same dimension as the triangle (less than two if the triangle is degenerate).
/// Therefore polygons of lower dimension are dropped, and borders need no special case.
fn covers<V: Vector>(frame: &Frame, boxes: &[Aabb], triangle: &Triangle<V>) -> bool {
    let Some(corners) = triangle.0.iter().map(|v| frame.exact(v.widen())).collect() else { return false };
    let mut pending = vec![(Polygon { corners }, boxes.to_vec())];
    while let Some((polygon, mut boxes)) = pending.pop() {
        let around = polygon.bounds();
        boxes.retain(|aabb| (0..3).all(|k| around.0[k] <= aabb.hi[k].into() && f64::from(aabb.lo[k]) <= around.1[k]));
        let Some(aabb) = boxes.pop() else { return false };
        let mut within = Some(polygon);
        for (axis, is_upper) in SIDES {
            let plane = if is_upper { aabb.hi[axis] } else { aabb.lo[axis] };
            // An infinite plane cuts nothing off.
            let Ok(plane) = RBig::try_from(plane) else { continue };
            let Some(polygon) = within.take() else { break };
            let (outside, inside) = polygon.cut(axis, is_upper, &plane);
            pending.extend(outside.map(|outside| (outside, boxes.clone())));
            within = inside;
        }
    }
    true
}

type Point = [RBig; 3];

/// Convex, of the same dimension as the triangle.
struct Polygon {
    corners: Vec<Point>,
}

impl Polygon {
    /// Returns the least and greatest coordinates, rounded to nearest. Rounding keeps the order, so parts that are
    /// disjoint after it are disjoint.
    fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corner in &self.corners {
            for (axis, x) in corner.iter().enumerate() {
                let x = f64::nearest(x);
                lo[axis] = lo[axis].min(x);
                hi[axis] = hi[axis].max(x);
            }
        }
        (lo, hi)
    }

    /// Returns the parts beyond and before a plane across an axis, if they have the same dimension. If the polygon is
    /// in the plane, no part is beyond.
    fn cut(self, axis: usize, is_upper: bool, plane: &RBig) -> (Option<Self>, Option<Self>) {
        let beyond = |corner: &Point| if is_upper { &corner[axis] - plane } else { plane - &corner[axis] };
        let heights: Vec<_> = self.corners.iter().map(beyond).collect();
        if heights.iter().all(|height| *height <= RBig::ZERO) {
            return (None, Some(self));
        }
        if heights.iter().all(|height| *height >= RBig::ZERO) {
            return (Some(self), None);
        }
        let (mut outside, mut inside) = (Vec::new(), Vec::new());
        let next = |i: usize| (i + 1) % self.corners.len();
        for (i, (corner, height)) in self.corners.iter().zip(&heights).enumerate() {
            if *height >= RBig::ZERO {
                outside.push(corner.clone());
            }
            if *height <= RBig::ZERO {
                inside.push(corner.clone());
            }
            let (other, other_height) = (&self.corners[next(i)], &heights[next(i)]);
            if (*height < RBig::ZERO && *other_height > RBig::ZERO)
                || (*height > RBig::ZERO && *other_height < RBig::ZERO)
            {
                let t = height / (height - other_height);
                let crossing: Point = std::array::from_fn(|k| &corner[k] + (&other[k] - &corner[k]) * &t);
                outside.push(crossing.clone());
                inside.push(crossing);
            }
        }
        (Some(Self { corners: outside }), Some(Self { corners: inside }))
    }
}

#[cfg(test)]
mod tests;

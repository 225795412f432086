//! The nearest point of a triangle, by intervals.
//!
//! Seen from corner `a`, with edges `b`, `c` and the query point `s`, the nearest point is one of seven: a corner, the
//! foot on an edge, or the foot on the plane. Each has a certificate, some products that are not negative, and the one
//! whose certificate holds is the nearest. Where intervals leave a certificate open, its point is taken as well: all
//! are in the box of those points, and so is the nearest one. `[NEAR-3]`

use glam::Vec3;

use crate::geom::{Interval, Triangle};

type Vector = [Interval; 3];

/// For each coordinate what holds that of the nearest point. `None` where the triangle may have no area.
pub(super) fn enclose(triangle: &Triangle, point: Vec3) -> Option<[[f64; 2]; 3]> {
    let [a, corner_b, corner_c, p] = [triangle.0[0], triangle.0[1], triangle.0[2], point].map(exact);
    let [b, c, s] = [corner_b, corner_c, p].map(|x| minus(x, a));
    let (bb, bc, cc) = (dot(b, b), dot(b, c), dot(c, c));
    let normal = cross(b, c);
    let area = dot(normal, normal);
    if area.ends()[0] <= 0.0 {
        return None;
    }
    // Along the edges from `a`, `b` and `c`, as they are in Ericson 2005, 5.1.5.
    let (d1, d2) = (dot(b, s), dot(c, s));
    let (d3, d4) = (d1 - bb, d2 - bc);
    let (d5, d6) = (d1 - bc, d2 - cc);
    let (of_b, of_c) = (cc * d1 - bc * d2, bb * d2 - bc * d1);
    let of_a = area - of_b - of_c;
    let mut all = Hull([[f64::INFINITY, f64::NEG_INFINITY]; 3]);
    let (from_b, from_c) = (d4 - d3, d5 - d6);
    // Corners.
    all.add_if([-d1, -d2], || a);
    all.add_if([d3, -from_b], || corner_b);
    all.add_if([d6, -from_c], || corner_c);
    // Edges.
    all.add_if([-of_c, d1, -d3], || along(a, b, share(d1, bb)));
    all.add_if([-of_b, d2, -d6], || along(a, c, share(d2, cc)));
    all.add_if([-of_a, from_b, from_c], || along(corner_b, minus(c, b), share(from_b, from_b + from_c)));
    // The plane.
    all.add_if([of_a, of_b, of_c], || along(along(a, b, share(of_b, area)), c, share(of_c, area)));
    Some(all.0)
}

/// The least box of points.
struct Hull([[f64; 2]; 3]);

impl Hull {
    /// With a point, unless one of its conditions, numbers that are not negative, is known to fail.
    #[inline]
    fn add_if<const N: usize>(&mut self, conditions: [Interval; N], point: impl FnOnce() -> Vector) {
        if conditions.iter().all(|condition| condition.ends()[1] >= 0.0) {
            for (all, coordinate) in self.0.iter_mut().zip(point()) {
                let [lo, hi] = coordinate.ends();
                *all = [all[0].min(lo), all[1].max(hi)];
            }
        }
    }
}

/// A quotient that is known to be from 0 to 1.
#[inline]
fn share(part: Interval, whole: Interval) -> Interval {
    let ([part_lo, part_hi], [whole_lo, whole_hi]) = (part.ends(), whole.ends());
    if whole_lo <= 0.0 {
        return Interval::between([0.0, 1.0]);
    }
    let (lo, hi) = ((part_lo.max(0.0) / whole_hi).next_down(), (part_hi / whole_lo).next_up());
    Interval::between([lo.max(0.0), hi.min(1.0)])
}

#[inline]
fn along(start: Vector, edge: Vector, share: Interval) -> Vector {
    std::array::from_fn(|k| start[k] + edge[k] * share)
}

fn exact(v: Vec3) -> Vector {
    v.to_array().map(|x| Interval::exact(x.into()))
}

#[inline]
fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

#[inline]
fn dot(a: Vector, b: Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn cross(a: Vector, b: Vector) -> Vector {
    let component = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [component(1, 2), component(2, 0), component(0, 1)]
}

//! The nearest point of a triangle, by numbers within bounds.
//!
//! Seen from corner `a`, with edges `b`, `c` and the query point `s`, the nearest point is one of seven: a corner, the
//! foot on an edge, or the foot on the plane. Each has a certificate, some products that are not negative, and the one
//! whose certificate holds is the nearest. Where bounds leave a certificate open, its point is taken as well: all
//! are in the box of those points, and so is the nearest one. A triangle without area has no plane: the certificates of
//! its corners, and of the edges with a length, are enough. `[NEAR-3]`

use glam::DVec3;

use super::enclosure::Enclosure;
use crate::geom::kernel::is_degenerate;

type Vector<E> = [E; 3];

/// What holds the nearest point of a triangle. `None` where bounds leave open whether it has an area, and it has one, or
/// where a number is not taken.
pub(super) fn enclose<E: Enclosure>(corners: &[DVec3; 3], point: DVec3) -> Option<Vector<E>> {
    let &[a, b, c] = corners;
    let has_length = [a != b, a != c, b != c];
    let [a, corner_b, corner_c, p] = [exact::<E>(a)?, exact(b)?, exact(c)?, exact(point)?];
    let [b, c, s] = [corner_b, corner_c, p].map(|x| minus(x, a));
    let (bb, bc, cc) = (dot(b, b), dot(b, c), dot(c, c));
    let normal = cross(b, c);
    let area = dot(normal, normal);
    let has_area = area.is_positive();
    if !has_area && !is_degenerate(corners) {
        return None;
    }
    // Along the edges from `a`, `b` and `c`, as they are in Ericson 2005, 5.1.5.
    let (d1, d2) = (dot(b, s), dot(c, s));
    let (d3, d4) = (d1 - bb, d2 - bc);
    let (d5, d6) = (d1 - bc, d2 - cc);
    let (of_b, of_c) = (cc * d1 - bc * d2, bb * d2 - bc * d1);
    let of_a = area - of_b - of_c;
    let mut all = Hull(None);
    let (from_b, from_c) = (d4 - d3, d5 - d6);
    // Corners.
    all.add_if(true, [-d1, -d2], || a);
    all.add_if(true, [d3, -from_b], || corner_b);
    all.add_if(true, [d6, -from_c], || corner_c);
    // Edges.
    all.add_if(has_length[0], [-of_c, d1, -d3], || along(a, b, d1.share(bb)));
    all.add_if(has_length[1], [-of_b, d2, -d6], || along(a, c, d2.share(cc)));
    let from_b_to_c = || along(corner_b, minus(c, b), from_b.share(from_b + from_c));
    all.add_if(has_length[2], [-of_a, from_b, from_c], from_b_to_c);
    // The plane.
    all.add_if(has_area, [of_a, of_b, of_c], || along(along(a, b, of_b.share(area)), c, of_c.share(area)));
    all.0
}

/// What holds the squares of the distances of a point.
pub(super) fn square<E: Enclosure>(place: Vector<E>, point: DVec3) -> Option<E> {
    let way = minus(place, exact(point)?);
    Some(dot(way, way))
}

/// The least box of points.
struct Hull<E>(Option<Vector<E>>);

impl<E: Enclosure> Hull<E> {
    /// With a point, if there is one, unless one of its conditions, numbers that are not negative, is known to fail.
    #[inline]
    fn add_if<const N: usize>(&mut self, is_one: bool, conditions: [E; N], point: impl FnOnce() -> Vector<E>) {
        if is_one && !conditions.into_iter().any(Enclosure::is_negative) {
            let point = point();
            self.0 = Some(self.0.map_or(point, |all| std::array::from_fn(|k| all[k].hull(point[k]))));
        }
    }
}

#[inline]
fn along<E: Enclosure>(start: Vector<E>, edge: Vector<E>, share: E) -> Vector<E> {
    std::array::from_fn(|k| start[k] + edge[k] * share)
}

fn exact<E: Enclosure>(v: DVec3) -> Option<Vector<E>> {
    Some([E::of(v.x)?, E::of(v.y)?, E::of(v.z)?])
}

#[inline]
fn minus<E: Enclosure>(a: Vector<E>, b: Vector<E>) -> Vector<E> {
    std::array::from_fn(|k| a[k] - b[k])
}

#[inline]
fn dot<E: Enclosure>(a: Vector<E>, b: Vector<E>) -> E {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn cross<E: Enclosure>(a: Vector<E>, b: Vector<E>) -> Vector<E> {
    let component = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [component(1, 2), component(2, 0), component(0, 1)]
}

#[cfg(test)]
mod tests;

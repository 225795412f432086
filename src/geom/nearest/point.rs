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
use crate::geom::truth::Place;

type Vector<E> = [E; 3];

/// What holds the nearest point of a triangle. `None` where bounds leave open whether it has an area, and it has one, or
/// where a number is not taken.
pub(super) fn enclose<E: Enclosure>(corners: &[DVec3; 3], point: DVec3) -> Option<Vector<E>> {
    let mut all = Hull(None);
    candidates(corners, point, &mut all)?;
    all.0
}

/// Bounds the weights of the second and the third corner in the nearest point, and finds the part of the triangle that has
/// it. `None` also where the bounds do not decide the part.
///
/// On the border of two parts both certificates hold. So a single certificate that may hold decides the part.
/// `[NEAR-9]`
pub(super) fn weigh<E: Enclosure>(corners: &[DVec3; 3], point: DVec3) -> Option<([E; 2], Place)> {
    let mut only = Only(None, 0);
    candidates(corners, point, &mut only)?;
    let Only(found, count) = only;
    found.filter(|_| count == 1)
}

/// Gets the candidates for the nearest point: all whose certificates may hold.
trait Candidates<E> {
    fn add(&mut self, part: Place, weights: impl FnOnce() -> [E; 2], point: impl FnOnce() -> Vector<E>);

    /// Adds one unless one of its conditions, numbers that are not negative, is known to fail.
    #[inline]
    fn add_if<const N: usize>(
        &mut self,
        is_one: bool,
        conditions: [E; N],
        part: Place,
        weights: impl FnOnce() -> [E; 2],
        point: impl FnOnce() -> Vector<E>,
    ) where
        E: Enclosure,
    {
        if is_one && !conditions.into_iter().any(Enclosure::is_negative) {
            self.add(part, weights, point);
        }
    }
}

#[inline]
fn candidates<E: Enclosure>(corners: &[DVec3; 3], point: DVec3, all: &mut impl Candidates<E>) -> Option<()> {
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
    let (from_b, from_c) = (d4 - d3, d5 - d6);
    let [zero, one] = [E::of(0.0)?, E::of(1.0)?];
    let vertex = Place::Vertex;
    all.add_if(true, [-d1, -d2], vertex, || [zero, zero], || a);
    all.add_if(true, [d3, -from_b], vertex, || [one, zero], || corner_b);
    all.add_if(true, [d6, -from_c], vertex, || [zero, one], || corner_c);
    let edge = Place::Edge;
    let share = || d1.share(bb);
    all.add_if(has_length[0], [-of_c, d1, -d3], edge, || [share(), zero], || along(a, b, share()));
    let share = || d2.share(cc);
    all.add_if(has_length[1], [-of_b, d2, -d6], edge, || [zero, share()], || along(a, c, share()));
    let share = || from_b.share(from_b + from_c);
    let weights = || [from_c.share(from_b + from_c), share()];
    all.add_if(has_length[2], [-of_a, from_b, from_c], edge, weights, || along(corner_b, minus(c, b), share()));
    let weights = || [of_b.share(area), of_c.share(area)];
    let point = || along(along(a, b, of_b.share(area)), c, of_c.share(area));
    all.add_if(has_area, [of_a, of_b, of_c], Place::Interior, weights, point);
    Some(())
}

/// What holds the squares of the distances of a point.
pub(super) fn square<E: Enclosure>(place: Vector<E>, point: DVec3) -> Option<E> {
    Some(square_length(minus(place, exact(point)?)))
}

pub(super) fn square_length<E: Enclosure>(way: Vector<E>) -> E {
    dot(way, way)
}

/// Bounds the cross product of two edges, whose length is twice the area.
pub(super) fn normal<E: Enclosure>(&[a, b, c]: &[DVec3; 3]) -> Option<Vector<E>> {
    let [a, b, c] = [exact::<E>(a)?, exact(b)?, exact(c)?];
    Some(cross(minus(b, a), minus(c, a)))
}

/// The least box of points.
struct Hull<E>(Option<Vector<E>>);

impl<E: Enclosure> Candidates<E> for Hull<E> {
    #[inline]
    fn add(&mut self, _: Place, _: impl FnOnce() -> [E; 2], point: impl FnOnce() -> Vector<E>) {
        let point = point();
        self.0 = Some(self.0.map_or(point, |all| std::array::from_fn(|k| all[k].hull(point[k]))));
    }
}

/// The last candidate, and how many there are.
struct Only<E>(Option<([E; 2], Place)>, u32);

impl<E: Enclosure> Candidates<E> for Only<E> {
    fn add(&mut self, part: Place, weights: impl FnOnce() -> [E; 2], _: impl FnOnce() -> Vector<E>) {
        *self = Self(Some((weights(), part)), self.1 + 1);
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
pub(super) mod tests;

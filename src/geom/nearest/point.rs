//! The nearest point of a triangle, by numbers within bounds.
//!
//! Relative to corner `a`, with edges `b`, `c` and the query point `s`, the nearest point is one of seven: a corner,
//! the foot on an edge, or the foot on the plane. Each has a certificate, some products that are not negative, and the
//! one whose certificate holds is the nearest. If bounds leave a certificate open, its point is also included: the box
//! contains all those points, and so the nearest one. A triangle without area has no plane: the certificates of its
//! corners, and of the edges with a length, suffice. `[NEAR-3]`
//!
//! Doubles decide nearly all certificates. Then twice the digits compute one foot, and not seven.

use glam::DVec3;

use super::enclosure::Enclosure;
use super::rough::Rough;
use crate::geom::fine::Fine;
use crate::geom::kernel::is_degenerate;
use crate::geom::truth::Place;

type Vector<E> = [E; 3];

/// A part of a triangle, by the indices of its corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    Vertex(usize),
    Edge([usize; 2]),
    Interior,
}

/// The parts that may have the nearest point of a triangle: at least one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts([bool; 7]);

impl Part {
    const ALL: [Self; 7] = [
        Self::Vertex(0),
        Self::Vertex(1),
        Self::Vertex(2),
        Self::Edge([0, 1]),
        Self::Edge([0, 2]),
        Self::Edge([1, 2]),
        Self::Interior,
    ];

    pub(super) const fn place(self) -> Place {
        match self {
            Self::Vertex(_) => Place::Vertex,
            Self::Edge(_) => Place::Edge,
            Self::Interior => Place::Interior,
        }
    }

    /// Bounds the weights of the second and the third corner in the foot on this part. `None` if a number is out of
    /// range.
    pub(super) fn weights<E: Enclosure>(self, corners: &[DVec3; 3], point: DVec3) -> Option<[E; 2]> {
        let mut weights = [E::of(0.0)?; 3];
        match self {
            Self::Vertex(corner) => weights[corner] = E::of(1.0)?,
            Self::Edge([from, to]) => {
                weights[to] = share([corners[from], corners[to]], point)?;
                if from > 0 {
                    weights[from] = share([corners[to], corners[from]], point)?;
                }
            }
            Self::Interior => {
                let seen = Seen::<E>::from(corners, point)?;
                weights[1..].copy_from_slice(&seen.heights().map(|height| height.share(seen.area)));
            }
        }
        let [_, u, v] = weights;
        Some([u, v])
    }

    /// Returns the distance of the foot on a plane across an axis; many parts have such a plane. The distance may be in
    /// the middle between two floats, where only an exact number determines the rounding.
    pub(super) fn height(self, &[a, b, c]: &[DVec3; 3], point: DVec3) -> Option<Fine> {
        let axis = (0..3).find(|&k| a[k] == b[k] && a[k] == c[k]).filter(|_| self == Self::Interior)?;
        let way = <Fine as Enclosure>::of(point[axis])? - <Fine as Enclosure>::of(a[axis])?;
        Some(if way.middle() < 0.0 { -way } else { way })
    }

    /// Returns bounds of the foot on this part. `None` if a number is out of range.
    pub(super) fn foot<E: Enclosure>(self, corners: &[DVec3; 3], point: DVec3) -> Option<Vector<E>> {
        match self {
            Self::Vertex(corner) => exact(corners[corner]),
            Self::Edge(edge) => {
                let ends = edge.map(|corner| corners[corner]);
                let [from, to] = [exact::<E>(ends[0])?, exact(ends[1])?];
                Some(along(from, minus(to, from), share(ends, point)?))
            }
            Self::Interior => {
                let ([u, v], a) = (self.weights(corners, point)?, exact::<E>(corners[0])?);
                let [b, c] = [minus(exact(corners[1])?, a), minus(exact(corners[2])?, a)];
                Some(along(along(a, b, u), c, v))
            }
        }
    }
}

impl Parts {
    /// Returns the parts whose certificates may hold. `None` if bounds leave open whether the triangle has an area, and
    /// it has one, or if a number is out of range.
    #[inline]
    pub(super) fn certified<E: Enclosure>(corners: &[DVec3; 3], point: DVec3) -> Option<Self> {
        let seen = Seen::<E>::from(corners, point)?;
        let has_area = seen.area.is_positive();
        if !has_area && !is_degenerate(corners) {
            return None;
        }
        let Seen { bb, bc, cc, d1, d2, area } = seen;
        // Along the edges from `a`, `b` and `c`, as in Ericson 2005, 5.1.5.
        let ((d3, d4), (d5, d6)) = ((d1 - bb, d2 - bc), (d1 - bc, d2 - cc));
        let [of_b, of_c] = seen.heights();
        let of_a = area - of_b - of_c;
        let (from_b, from_c) = (d4 - d3, d5 - d6);
        let [a, b, c] = corners;
        // A certificate holds if none of its numbers is negative.
        let certificates = [
            (true, [-d1, -d2, -d2]),
            (true, [d3, -from_b, -from_b]),
            (true, [d6, -from_c, -from_c]),
            (a != b, [-of_c, d1, -d3]),
            (a != c, [-of_b, d2, -d6]),
            (b != c, [-of_a, from_b, from_c]),
            (has_area, [of_a, of_b, of_c]),
        ];
        Some(Self(certificates.map(|(is_part, numbers)| is_part && !numbers.into_iter().any(Enclosure::is_negative))))
    }

    /// Returns the parts whose certificates may hold: by doubles if they leave one part, otherwise by twice the digits.
    pub(super) fn decided(corners: &[DVec3; 3], point: DVec3) -> Option<Self> {
        let by_doubles = Self::certified::<Rough>(corners, point);
        by_doubles.filter(|parts| parts.only().is_some()).or_else(|| Self::certified::<Fine>(corners, point))
    }

    /// Returns the part, if there is only one. On the border of two parts two certificates hold, so a single part has
    /// the nearest point. `[NEAR-9]`
    pub(super) fn only(self) -> Option<Part> {
        let mut parts = self.iter();
        parts.next().filter(|_| parts.next().is_none())
    }

    /// Returns bounds of the nearest point.
    pub(super) fn foot<E: Enclosure>(self, corners: &[DVec3; 3], point: DVec3) -> Option<Vector<E>> {
        let mut feet = self.iter().map(|part| part.foot::<E>(corners, point));
        let first = feet.next()??;
        feet.try_fold(first, |all, foot| foot.map(|foot| [0, 1, 2].map(|k| all[k].hull(foot[k]))))
    }

    fn iter(self) -> impl Iterator<Item = Part> {
        Part::ALL.into_iter().zip(self.0).filter_map(|(part, is_one)| is_one.then_some(part))
    }
}

/// Products of the edges `b` and `c` and of the vector to the query point, from the first corner.
struct Seen<E> {
    bb: E,
    bc: E,
    cc: E,
    d1: E,
    d2: E,
    /// The square of twice the area.
    area: E,
}

impl<E: Enclosure> Seen<E> {
    #[inline]
    fn from(&[a, b, c]: &[DVec3; 3], point: DVec3) -> Option<Self> {
        let a = exact(a)?;
        let [b, c, s] = [minus(exact(b)?, a), minus(exact(c)?, a), minus(exact(point)?, a)];
        let area = square_length(cross(b, c));
        Some(Self { bb: dot(b, b), bc: dot(b, c), cc: dot(c, c), d1: dot(b, s), d2: dot(c, s), area })
    }

    /// Returns the weights of the second and of the third corner in the foot on the plane, times the area.
    #[inline]
    fn heights(&self) -> [E; 2] {
        let &Self { bb, bc, cc, d1, d2, .. } = self;
        [cc * d1 - bc * d2, bb * d2 - bc * d1]
    }
}

/// Returns the weight of the second end in the foot on an edge.
fn share<E: Enclosure>([from, to]: [DVec3; 2], point: DVec3) -> Option<E> {
    let from: Vector<E> = exact(from)?;
    let (edge, way) = (minus(exact(to)?, from), minus(exact(point)?, from));
    Some(dot(edge, way).share(dot(edge, edge)))
}

/// Returns bounds of the squared distance of a point.
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

//! The stages in double precision for a ray that is known within bounds.

use std::cmp::Ordering;

use glam::DVec3;

use super::filter::{Determinants, Errors, USUAL, has_usual_edges};
use super::order::Crossing;
use super::{fine, is_within, placed, predicates, quotient};
use crate::geom::{EnclosedRay, Interval, Real, Region, Triangle, Vector};

/// A certain result for a ray within bounds and a triangle: it holds for each such ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Certainty<T> {
    /// The triangle is missed, or met outside the interval or beyond the limit.
    Miss,
    /// The triangle is hit, with this answer.
    Hit(T),
    /// The bounds are too wide: the true ray must decide, or more digits.
    Open,
}

impl<T> Certainty<T> {
    /// Returns the answer; `settle` decides if this is open.
    #[inline]
    pub(super) fn or_else(self, settle: impl FnOnce() -> Option<T>) -> Option<T> {
        match self {
            Self::Miss => None,
            Self::Hit(answer) => Some(answer),
            Self::Open => settle(),
        }
    }
}

/// The first two stages of [`Exact`](super::Exact) for a ray that is known within bounds: the ray in the center, with
/// error bounds that also hold for the other rays. Triangles are in single precision, or with `f64` in double
/// precision. For doubles, bounds of a distance or weight rarely round to one number, unless the ray is known exactly.
/// `[INST-5]`
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::internals::geom::kernel::{Certainty, EnclosedTest};
/// use stackless_bvh::geom::{AffineMap, Ray, Region, Triangle};
/// use stackless_bvh::internals::geom::EnclosedRay;
///
/// let third = AffineMap::new([[3.0, 0.0, 0.0, 0.0], [0.0, 3.0, 0.0, 0.0], [0.0, 0.0, 3.0, 0.0]])?;
/// let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
/// let at = |x| -> Result<_, Box<dyn std::error::Error>> {
///     let ray = third.pull_back(&EnclosedRay::exact(&Ray::within(Vec3::new(x, 0.5, -7.0), Vec3::Z, 0.0, 9.0)?));
///     Ok(EnclosedTest::new(&ray, [0.0, 9.0], &Region::of(&triangle.aabb())).distance(&triangle, 9.0))
/// };
/// assert_eq!((at(0.5)?, at(4.0)?), (Certainty::Hit(7.0), Certainty::Miss));
/// // Possibly through an edge.
/// assert_eq!(at(0.0)?, Certainty::Open);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct EnclosedTest<R: Real = f32> {
    origin: DVec3,
    direction: DVec3,
    /// Error bounds of the components of origin and direction.
    off: [f64; 2],
    /// The distance of the origin.
    start: Interval,
    interval: [R; 2],
    /// Bounds for all triangles of the object.
    errors: Errors,
    is_usual: bool,
    /// Whether the ray is known exactly, so that exact sums may decide the cases that bounds leave open.
    is_exact: bool,
}

impl<R: Real> EnclosedTest<R> {
    /// Prepares a ray with `interval` from tmin to tmax. `region` must contain all triangles of the tests.
    pub fn new(ray: &EnclosedRay, interval: [R; 2], region: &Region) -> Self {
        let ((origin, moved), (direction, turned)) =
            (Interval::middles(&ray.origin), Interval::middles(&ray.direction));
        let off = [moved, turned];
        let sizes = [direction.abs().max_element(), region.distance(origin), region.size()];
        let can_filter = origin.is_finite()
            && direction.is_finite()
            && sizes.iter().all(|size| USUAL.contains(size))
            && off.iter().all(|off| off <= USUAL.end());
        let start = ray.start;
        let is_exact = origin.is_finite() && direction.is_finite() && off == [0.0; 2] && start == Interval::exact(0.0);
        let errors = Errors::within(off, sizes);
        Self { origin, direction, off, start, interval, errors, is_usual: can_filter, is_exact }
    }

    /// Computes [`Kernel::distance`](crate::geom::Kernel::distance), if it is certain.
    #[inline]
    pub fn distance<V: Vector<Real = R>>(&self, shape: &Triangle<V>, limit: R) -> Certainty<R> {
        self.decide(shape, |ends| placed(ends, self.interval, limit))
    }

    /// Computes [`Kernel::blocks`](crate::geom::Kernel::blocks), if it is certain.
    #[inline]
    pub fn blocks<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Certainty<()> {
        self.decide(shape, |ends| match is_within(ends, self.interval) {
            Some(true) => Certainty::Hit(()),
            Some(false) => Certainty::Miss,
            None => Certainty::Open,
        })
    }

    /// Computes [`Kernel::weights`](crate::geom::Kernel::weights), if they are certain.
    pub fn weights<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Option<[R; 2]> {
        let crossing = self.crossing(shape);
        if let Some((found, errors)) = &crossing {
            let [[u, u_end], [v, v_end]] = found.weights(errors).map(|ends| ends.map(R::rounded));
            if u == u_end && v == v_end {
                return Some([u, v]);
            }
        }
        let corners = self.exact_corners(shape)?;
        crossing
            .and_then(|_| fine::weights(&corners, self.origin, self.direction))
            .or_else(|| Some(quotient::weights(&corners, self.origin, self.direction)))
    }

    /// Decides the cases that bounds leave open, by more digits, and by exact sums if the ray is known exactly. Returns
    /// the distance, if it is within the closed interval.
    pub fn settle<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Certainty<R> {
        let Some(corners) = self.exact_corners(shape) else { return Certainty::Open };
        let (o, d) = (self.origin, self.direction);
        if self.crossing(shape).is_some() {
            let placed = fine::FineDeterminants::new(&corners, o, d).placed(self.interval);
            if placed != Certainty::Open {
                return placed;
            }
        }
        if predicates::is_flat_at_sight(&corners, d) || !predicates::is_inside(&corners, o, d, self.is_usual) {
            return Certainty::Miss;
        }
        quotient::distance(&corners, o, d, self.interval).map_or(Certainty::Miss, Certainty::Hit)
    }

    /// Compares the distances of two triangles that the ray is known to meet, each in the space of its test. It decides
    /// if the rays are known exactly or the bounds are disjoint. `[EXACT-13]`
    pub(crate) fn compare<V: Vector<Real = R>>(
        &self,
        shape: &Triangle<V>,
        (test, other): (&Self, &Triangle<V>),
    ) -> Option<Ordering> {
        if let (Some(corners), Some(others)) = (self.exact_corners(shape), test.exact_corners(other)) {
            return Some(self.exact_crossing(&corners).compare(&test.exact_crossing(&others)));
        }
        let ([near, far], [other_near, other_far]) = (self.span(shape)?, test.span(other)?);
        if far < other_near {
            Some(Ordering::Less)
        } else if other_far < near {
            Some(Ordering::Greater)
        } else {
            None
        }
    }

    fn exact_crossing<'a>(&self, corners: &'a [DVec3; 3]) -> Crossing<'a> {
        let has_room = self.is_usual && has_usual_edges(corners);
        Crossing { corners, o: self.origin, d: self.direction, has_room }
    }

    /// Returns bounds of the distance to a triangle that the ray certainly crosses, at any distance. `[SECOND-3]`
    pub(crate) fn span<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Option<[f64; 2]> {
        self.crossing(shape).map(|(found, errors)| self.after_start(found.distance(&errors)))
    }

    /// Returns bounds of a distance, from those of the distance from the moved origin. `[INST-7]`
    #[inline(always)]
    fn after_start(&self, ends: [f64; 2]) -> [f64; 2] {
        if self.start == Interval::exact(0.0) { ends } else { (Interval::between(ends) + self.start).ends() }
    }

    /// Decides with the bounds for the object, and then with those for the triangle.
    #[inline(always)]
    fn decide<V: Vector<Real = R>, T>(
        &self,
        shape: &Triangle<V>,
        place: impl Fn([R; 2]) -> Certainty<T>,
    ) -> Certainty<T> {
        let place = |ends| place(self.after_start(ends).map(R::rounded));
        let found = Determinants::of(&shape.widen(), self.origin, self.direction);
        match decide(&found, &self.errors, &place) {
            _ if !self.is_usual => Certainty::Open,
            Certainty::Open => self.decide_again(shape, place),
            certain => certain,
        }
    }

    #[cold]
    #[inline(never)]
    fn decide_again<V: Vector<Real = R>, T>(
        &self,
        shape: &Triangle<V>,
        place: impl Fn([f64; 2]) -> Certainty<T>,
    ) -> Certainty<T> {
        self.stage(shape).map_or(Certainty::Open, |(found, errors)| decide(&found, &errors, &place))
    }

    /// Decides with the bounds for this triangle, if they hold.
    fn stage<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Option<(Determinants, Errors)> {
        let (corners, o, d) = (shape.widen(), self.origin, self.direction);
        (self.is_usual && has_usual_edges(&corners))
            .then(|| (Determinants::of(&corners, o, d), Errors::of_triangle_within(self.off, &corners, o, d)))
    }

    /// Decides with the bounds for a triangle that the ray certainly crosses.
    fn crossing<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Option<(Determinants, Errors)> {
        self.stage(shape).filter(|(found, errors)| found.is_hit(errors))
    }

    /// Returns the corners, if the ray is known exactly.
    fn exact_corners<V: Vector<Real = R>>(&self, shape: &Triangle<V>) -> Option<[DVec3; 3]> {
        self.is_exact.then(|| shape.widen())
    }
}

/// Decides with these errors. For a line that certainly meets the triangle, `place` decides from the bounds of its
/// distance.
#[inline(always)]
pub(super) fn decide<T>(
    found: &Determinants,
    errors: &Errors,
    place: &impl Fn([f64; 2]) -> Certainty<T>,
) -> Certainty<T> {
    if found.is_miss(errors) {
        Certainty::Miss
    } else if found.is_hit(errors) {
        place(found.distance(errors))
    } else {
        Certainty::Open
    }
}

#[cfg(test)]
mod tests;

//! The location of the nearest point on a triangle: weights of the corners, and the part of the triangle.

use glam::DVec3;

use super::point::{self, Part, Parts};
use super::{Enclosure, Fine, RBig, Real, Rough, Triangle, Vector, truth};
use crate::geom::truth::{Number as _, Place};

/// The location on a triangle of the point nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot<R = f32> {
    /// The part of the triangle, exactly, independent of the rounding of the weights.
    pub place: Place,
    /// Weights of the second and the third corner, each the float nearest to the exact one.
    pub weights: [R; 2],
}

impl<R: Real> Foot<R> {
    /// Finds the nearest point of a triangle exactly, and rounds its weights once. `None` if a coordinate is not finite.
    /// `[NEAR-9]`
    ///
    /// A triangle without area has several weights at some points. Then it is one of them.
    ///
    /// ```
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::internals::geom::truth::Place;
    /// use stackless_bvh::geom::Triangle;
    /// use stackless_bvh::internals::geom::Foot;
    ///
    /// let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    /// let foot = |x, y| Foot::of(&triangle, Vec3::new(x, y, 3.0));
    /// assert_eq!(foot(0.25, 0.5), Some(Foot { place: Place::Interior, weights: [0.25, 0.5] }));
    /// assert_eq!(foot(1.0, 1.0), Some(Foot { place: Place::Edge, weights: [0.5, 0.5] }));
    /// assert_eq!(foot(2.0, 0.5), Some(Foot { place: Place::Vertex, weights: [1.0, 0.0] }));
    /// ```
    pub fn of<V: Vector<Real = R>>(triangle: &Triangle<V>, point: V) -> Option<Self> {
        let (corners, wide) = (triangle.widen(), point.widen());
        if corners.iter().chain([&wide]).any(|v| !v.is_finite()) {
            return None;
        }
        let part = Parts::decided(&corners, wide).and_then(Parts::only);
        let by_doubles = || rounded::<Rough, R>(part?, &corners, wide);
        let by_more_digits = || rounded::<Fine, R>(part?, &corners, wide);
        by_doubles().or_else(by_more_digits).or_else(|| exact(triangle, point))
    }
}

fn rounded<E: Enclosure, R: Real>(part: Part, corners: &[DVec3; 3], point: DVec3) -> Option<Foot<R>> {
    let [u, v] = part.weights::<E>(corners, point)?;
    Some(Foot { place: part.place(), weights: [R::between(u.bounds())?, R::between(v.bounds())?] })
}

#[cold]
#[inline(never)]
fn exact<V: Vector>(triangle: &Triangle<V>, point: V) -> Option<Foot<V::Real>> {
    let weights = truth::nearest_weights(triangle.0.map(V::components), point.components())?;
    let place = match weights.iter().filter(|&weight| *weight == RBig::ZERO).count() {
        0 => Place::Interior,
        1 => Place::Edge,
        _ => Place::Vertex,
    };
    let [_, u, v] = weights;
    Some(Foot { place, weights: [u, v].map(|weight| V::Real::nearest(&weight)) })
}

/// Returns the unit normal of a triangle, if twice the digits decide it.
pub(in crate::geom) fn unit_normal<R: Real>(corners: &[DVec3; 3]) -> Option<[R; 3]> {
    let normal = point::normal::<Fine>(corners)?;
    let length = Some(point::square_length(normal)).filter(|square| square.is_positive())?.root()?;
    let component = |x: Fine| match x.sign() {
        Some(0.0) => Some(R::ZERO),
        _ => R::between(x.over(length)?.bounds()),
    };
    let [x, y, z] = normal.map(component);
    Some([x?, y?, z?])
}

#[cfg(test)]
mod tests;

//! The stages in double precision for a ray that is known within bounds.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::filter::{Determinants, Errors};
use super::{is_certain, is_within, predicates, quotient};
use crate::geom::{EnclosedRay, Region, Triangle, Vector};

/// What is certain about a ray within bounds and a triangle, whatever ray it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Certainty<T> {
    /// The triangle is missed, or met outside of the interval or beyond the limit.
    Miss,
    /// It is hit, and this is the answer.
    Hit(T),
    /// The bounds are too wide: the true ray must be asked.
    Open,
}

/// The first two stages of [`Exact`](super::Exact) for a ray that is known within bounds: the ray in the middle, with
/// error bounds that hold for the others too. `[INST-5]`
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::geom::kernel::{EnclosedTest, Certainty};
/// use stackless_bvh::geom::{AffineMap, EnclosedRay, Ray, Region, Triangle};
///
/// let third = AffineMap::new([[3.0, 0.0, 0.0, 0.0], [0.0, 3.0, 0.0, 0.0], [0.0, 0.0, 3.0, 0.0]])?;
/// let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
/// let at = |x| -> Result<_, Box<dyn std::error::Error>> {
///     let ray = third.pull_back(&EnclosedRay::exact(&Ray::within(Vec3::new(x, 0.5, -7.0), Vec3::Z, 0.0, 9.0)?));
///     Ok(EnclosedTest::new(&ray, [0.0, 9.0], &Region::of(&triangle.aabb())).distance(&triangle, 9.0))
/// };
/// assert_eq!((at(0.5)?, at(4.0)?), (Certainty::Hit(7.0), Certainty::Miss));
/// // Through an edge, perhaps.
/// assert_eq!(at(0.0)?, Certainty::Open);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct EnclosedTest {
    origin: DVec3,
    direction: DVec3,
    /// How far the components of the true origin and direction may be from these.
    off: [f64; 2],
    interval: [f32; 2],
    /// For all triangles of the object.
    errors: Errors,
    is_usual: bool,
    /// Whether exact sums can tell what bounds do not.
    is_exact: bool,
}

/// Greatest components of directions for which nothing that under- or overflows matters, and the end of it for origins.
const USUAL: RangeInclusive<f64> = f64::from_bits((1023 - 200) << 52)..=f64::from_bits((1023 + 200) << 52);

impl EnclosedTest {
    /// Prepares a ray with `interval` from tmin to tmax. `region` must hold all triangles that it is asked about.
    pub fn new(ray: &EnclosedRay, interval: [f32; 2], region: &Region) -> Self {
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v.map(|x| x.middle_and_radius()));
        let middle = |v: [[f64; 2]; 3]| DVec3::from(v.map(|[middle, _]| middle));
        let off = [origin, direction].map(|v| v.iter().fold(0.0, |most: f64, &[_, x]| if x > most { x } else { most }));
        let (origin, direction) = (middle(origin), middle(direction));
        let [far, long] = [origin, direction].map(|v| v.abs().max_element());
        let is_usual = origin.is_finite()
            && direction.is_finite()
            && far <= *USUAL.end()
            && USUAL.contains(&long)
            && off.iter().all(|off| off <= USUAL.end())
            && region.reach().is_finite();
        let errors = Errors::of_scene_within(off, far, long, region);
        let components = [origin, direction].map(|v| v.to_array());
        let can_sum = |x: &f64| *x == 0.0 || USUAL.contains(&x.abs());
        let is_exact = is_usual && off == [0.0; 2] && components.as_flattened().iter().all(can_sum);
        Self { origin, direction, off, interval, errors, is_usual, is_exact }
    }

    /// [`Kernel::distance`](crate::geom::Kernel::distance), where it is certain.
    #[inline]
    pub fn distance(&self, shape: &Triangle, limit: f32) -> Certainty<f32> {
        let [tmin, _] = self.interval;
        self.decide(shape, |[near, far]| {
            if is_certain([near, far], self.interval) {
                Certainty::Hit(near)
            } else if far < tmin || limit < near {
                Certainty::Miss
            } else {
                Certainty::Open
            }
        })
    }

    /// [`Kernel::blocks`](crate::geom::Kernel::blocks), where it is certain.
    #[inline]
    pub fn blocks(&self, shape: &Triangle) -> Certainty<()> {
        self.decide(shape, |ends| match is_within(ends, self.interval) {
            Some(true) => Certainty::Hit(()),
            Some(false) => Certainty::Miss,
            None => Certainty::Open,
        })
    }

    /// [`Kernel::weights`](crate::geom::Kernel::weights), where they are certain.
    pub fn weights(&self, shape: &Triangle) -> Option<[f32; 2]> {
        let (found, errors) = self.stage(shape);
        let [[u, u_end], [v, v_end]] = found.weights(&errors).map(|ends| ends.map(|x| x as f32));
        if self.is_usual && found.is_hit(&errors) && u == u_end && v == v_end {
            return Some([u, v]);
        }
        self.is_exact.then(|| quotient::weights_of_doubles(&shape.widen(), self.origin, self.direction))
    }

    /// What bounds leave open, told by exact sums where the ray is known exactly: the distance, if that is within the
    /// closed interval.
    pub fn settle(&self, shape: &Triangle) -> Certainty<f32> {
        if !self.is_exact {
            return Certainty::Open;
        }
        let (corners, o, d) = (shape.widen(), self.origin, self.direction);
        if !predicates::is_inside(&corners, o, d) {
            return Certainty::Miss;
        }
        quotient::distance_of_doubles(&corners, o, d, self.interval).map_or(Certainty::Miss, Certainty::Hit)
    }

    /// Bounds of the distance to a triangle that the ray certainly crosses, at whatever distance. `[SECOND-3]`
    pub(crate) fn span(&self, shape: &Triangle) -> Option<[f64; 2]> {
        let (found, errors) = self.stage(shape);
        (self.is_usual && found.is_hit(&errors)).then(|| found.distance(&errors))
    }

    /// Asks with the bounds for the object, and again with those for the triangle.
    #[inline(always)]
    fn decide<T>(&self, shape: &Triangle, place: impl Fn([f32; 2]) -> Certainty<T>) -> Certainty<T> {
        let found = Determinants::of(&shape.widen(), self.origin, self.direction);
        match decide(&found, &self.errors, &place) {
            _ if !self.is_usual => Certainty::Open,
            Certainty::Open => self.decide_again(shape, place),
            certain => certain,
        }
    }

    #[cold]
    #[inline(never)]
    fn decide_again<T>(&self, shape: &Triangle, place: impl Fn([f32; 2]) -> Certainty<T>) -> Certainty<T> {
        let (found, errors) = self.stage(shape);
        decide(&found, &errors, &place)
    }

    /// With the bounds for this triangle.
    fn stage(&self, shape: &Triangle) -> (Determinants, Errors) {
        let (corners, o, d) = (shape.0.map(Vector::widen), self.origin, self.direction);
        (Determinants::of(&corners, o, d), Errors::of_triangle_within(self.off, &corners, o, d))
    }
}

#[inline(always)]
fn decide<T>(found: &Determinants, errors: &Errors, place: &impl Fn([f32; 2]) -> Certainty<T>) -> Certainty<T> {
    if found.is_miss(errors) {
        Certainty::Miss
    } else if found.is_hit(errors) {
        place(found.distance(errors).map(|t| t as f32))
    } else {
        Certainty::Open
    }
}

#[cfg(test)]
mod tests;

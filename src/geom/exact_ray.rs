//! Rays between exactly known points, for example from the hit of another ray.

use std::array;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use glam::Vec3;

use super::affine::{fine_images, images};
use super::kernel::{Certainty, EnclosedTest, FineDeterminants};
use super::truth::{Meeting, Point, RBig, Relaxed, crosses_integers, meet_integers};
use super::{
    AffineMap, EnclosedRay, Interval, Ray, RayError, Real, Region, Triangle, Vector, check_environment, meet_image,
};

/// An exactly known point: a point of floats, or the unrounded intersection of a ray and a triangle. Floats are of
/// single precision, or with [`DVec3`](glam::DVec3) of double precision. `[SECOND-1]`
///
/// It has bounds in double precision, which decide nearly all tests, and the data to compute the rational point if
/// bounds do not decide. A copy is cheap.
///
/// ```
/// use stackless_bvh::geom::{Ends, ExactPoint, Ray, Triangle};
/// use stackless_bvh::glam::Vec3;
///
/// let triangle = Triangle([Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0]);
/// let ray = Ray::new(Vec3::new(1.0, 1.0, -7.0), Vec3::new(0.1, 0.2, 3.0))?;
/// let point = ExactPoint::met(&ray, &triangle).ok_or("a miss")?;
/// // The point is exactly on the triangle, so an open ray from it does not meet the triangle again.
/// assert!(ExactPoint::met(point.ray(Vec3::X + Vec3::Z, f32::INFINITY, Ends::Open)?, &triangle).is_none());
/// // A closed ray includes the point.
/// assert!(ExactPoint::met(point.ray(Vec3::X + Vec3::Z, f32::INFINITY, Ends::Closed)?, &triangle).is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ExactPoint<V: Vector = Vec3>(Place<V>);

#[derive(Clone, Debug)]
enum Place<V: Vector> {
    Floats(V),
    Met(Arc<Met<V>>),
}

/// The intersection of a ray and a triangle.
#[derive(Debug)]
struct Met<V: Vector> {
    bounds: [Interval; 3],
    surface: Surface<V>,
    /// `None` once the point is computed: otherwise a path would keep all its rays.
    ray: Option<ExactRay<V>>,
    point: OnceLock<[RBig; 3]>,
    /// Number of points that must be computed before this one.
    generation: u32,
}

/// A triangle, and the maps that place it, innermost first.
#[derive(Clone, Debug, PartialEq)]
struct Surface<V: Vector> {
    triangle: Triangle<V>,
    maps: Vec<AffineMap<V::Real>>,
}

/// A borrowed triangle, and the maps that place it, innermost first.
pub(crate) type Image<'a, V> = (&'a Triangle<V>, &'a [AffineMap<<V as Vector>::Real>]);

/// Greatest number of consecutive points of a path that are known by bounds only. The next point is computed.
/// `[SECOND-4]`
const GENERATIONS: u32 = 8;

/// A ray whose line is known exactly: `origin + t direction`, for `t` from 0 to its end. `[SECOND-1]`
///
/// A [`Ray`] converts to it. See [`ExactPoint`] for rays that start on a surface.
#[derive(Clone, Debug)]
pub struct ExactRay<V: Vector = Vec3> {
    origin: ExactPoint<V>,
    way: Way<V>,
    interval: [V::Real; 2],
    ends: Ends,
}

#[derive(Clone, Debug)]
enum Way<V: Vector> {
    Along(V),
    Toward(ExactPoint<V>),
}

/// Whether the ray includes its ends. `[SECOND-2]`
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ends {
    /// Excluded: `0 < t < tmax`. The ray does not hit triangles at its origin: neither the triangle that it leaves, nor
    /// its neighbours, nor other triangles that touch it.
    Open,
    /// Included: `0 <= t <= tmax`. The ray hits all triangles that contain the origin, except those whose planes
    /// contain the ray.
    Closed,
}

impl<V: Vector> ExactPoint<V> {
    /// Creates a point of floats.
    ///
    /// # Errors
    /// [`RayError::Origin`] if it is not finite, and [`RayError::Environment`].
    pub fn new(point: V) -> Result<Self, RayError> {
        check_environment()?;
        if point.is_finite() { Ok(Self(Place::Floats(point))) } else { Err(RayError::Origin(point.widen())) }
    }

    /// Intersects a ray and a triangle; `None` for a miss.
    pub fn met(ray: impl Into<ExactRay<V>>, triangle: &Triangle<V>) -> Option<Self> {
        let ray = ray.into();
        let test = EnclosedTest::new(&ray.enclosed(), ray.interval(), &Region::of(&triangle.aabb()));
        let t = test.span(triangle);
        if t.is_some_and(|t| ray.holds(t)) {
            return Some(Self::of(ray, triangle, Vec::new(), t));
        }
        ray.meet(triangle, &[]).map(|_| Self::of(ray, triangle, Vec::new(), None))
    }

    /// Returns the point of a known intersection with the image of a triangle under maps, and bounds of the distance,
    /// if there are any. The first map is applied first.
    pub(crate) fn of(
        ray: ExactRay<V>,
        triangle: &Triangle<V>,
        maps: Vec<AffineMap<V::Real>>,
        t: Option<[f64; 2]>,
    ) -> Self {
        let surface = Surface { triangle: *triangle, maps };
        let generation = 1 + ray.generation();
        let (point, ray, bounds) = match t {
            Some([near, far]) if generation < GENERATIONS => {
                let (line, t) = (ray.enclosed(), Interval::between([near.next_down(), far.next_up()]));
                (OnceLock::new(), Some(ray), array::from_fn(|k| line.origin[k] + t * line.direction[k]))
            }
            _ => {
                let point = ray.point(&surface);
                let bounds = point.each_ref().map(|x| Interval::around(x.as_relaxed()));
                (OnceLock::from(point), None, bounds)
            }
        };
        let generation = if ray.is_some() { generation } else { 0 };
        Self(Place::Met(Arc::new(Met { bounds, surface, ray, point, generation })))
    }

    /// Creates a ray from this point. `tmax` is in units of the length of its direction, and may be infinite.
    ///
    /// # Errors
    /// [`RayError`], for direction and interval.
    pub fn ray(&self, direction: V, tmax: V::Real, ends: Ends) -> Result<ExactRay<V>, RayError> {
        // Origins are finite.
        Ray::within(V::from_components([V::Real::ZERO; 3]), direction, V::Real::ZERO, tmax)?;
        Ok(ExactRay { origin: self.clone(), way: Way::Along(direction), interval: [V::Real::ZERO, tmax], ends })
    }

    /// Creates the ray from this point to another point, at which `t` is 1. If the ends are open, an any-hit query
    /// tests whether one point is visible from the other.
    ///
    /// # Errors
    /// [`RayError::ZeroDirection`] if they are the same point, and [`RayError::Environment`].
    pub fn toward(&self, target: &Self, ends: Ends) -> Result<ExactRay<V>, RayError> {
        check_environment()?;
        let apart = |a: Interval, b: Interval| a.ends()[1] < b.ends()[0] || b.ends()[1] < a.ends()[0];
        let (from, to) = (self.bounds(), target.bounds());
        if !(0..3).any(|k| apart(from[k], to[k])) && self.rational() == target.rational() {
            return Err(RayError::ZeroDirection);
        }
        let interval = [V::Real::ZERO, V::Real::ONE];
        Ok(ExactRay { origin: self.clone(), way: Way::Toward(target.clone()), interval, ends })
    }

    /// Returns bounds of each coordinate.
    pub fn bounds(&self) -> [Interval; 3] {
        match &self.0 {
            Place::Floats(point) => point.widen().to_array().map(Interval::exact),
            Place::Met(met) => met.bounds,
        }
    }

    /// Returns the point as rational numbers. The first call takes some microseconds, more for points of long paths.
    pub fn rational(&self) -> Cow<'_, [RBig; 3]> {
        match &self.0 {
            Place::Floats(point) => Cow::Owned(rational(*point)),
            Place::Met(met) => Cow::Borrowed(met.point.get_or_init(|| {
                // Either the point or its ray is present.
                met.ray.as_ref().map(|ray| ray.point(&met.surface)).unwrap_or_default()
            })),
        }
    }

    fn generation(&self) -> u32 {
        match &self.0 {
            Place::Floats(_) => 0,
            Place::Met(met) => met.generation,
        }
    }
}

impl<V: Vector> ExactRay<V> {
    /// Returns the origin.
    pub const fn origin(&self) -> &ExactPoint<V> {
        &self.origin
    }

    /// Returns the least and the greatest `t`.
    pub const fn interval(&self) -> [V::Real; 2] {
        self.interval
    }

    /// Returns whether the ray includes its ends.
    pub const fn ends(&self) -> Ends {
        self.ends
    }

    /// Returns bounds of its line. `[SECOND-3]`
    pub fn enclosed(&self) -> EnclosedRay {
        let origin = self.origin.bounds();
        let direction = match &self.way {
            Way::Along(direction) => direction.widen().to_array().map(Interval::exact),
            Way::Toward(target) => {
                let target = target.bounds();
                array::from_fn(|k| target[k] - origin[k])
            }
        };
        EnclosedRay::new(origin, direction)
    }

    /// Intersects the ray's line and the image of a triangle under maps, in rational arithmetic; the first map is
    /// applied first. The result is a hit if it is within the ray's ends. `[SECOND-2]`
    pub fn meet(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Option<Point> {
        if self.leaves(triangle, || maps) {
            return None;
        }
        let point = self.cross(triangle, maps).within(self.interval)?;
        let is_end = |end: V::Real| RBig::try_from(end.into()).is_ok_and(|end| end == point.t);
        (self.ends == Ends::Closed || !self.interval.into_iter().any(is_end)).then_some(point)
    }

    /// Returns whether the ray starts on this image of a triangle and excludes its origin: then its line meets the
    /// triangle at the origin or not at all. `maps` is called only if the triangle is the same.
    pub(crate) fn leaves<M: AsRef<[AffineMap<V::Real>]>>(
        &self,
        triangle: &Triangle<V>,
        maps: impl FnOnce() -> M,
    ) -> bool {
        self.ends == Ends::Open
            && matches!(&self.origin.0, Place::Met(met)
                if met.surface.triangle == *triangle && met.surface.maps == maps().as_ref())
    }

    /// Returns the distance to the image of a triangle, by twice the digits of a double: if these decide the hit, and
    /// the distance is not at an end. `[INST-5]`
    pub(crate) fn fine_distance(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Certainty<V::Real> {
        let Some([o, d]) = self.floats() else { return Certainty::Open };
        let (images, o) = (fine_images(triangle.0, maps), o.widen());
        let found = FineDeterminants::within_range(&images, o, d.widen());
        found.map_or(Certainty::Open, |found| found.met(&images, o, self.interval))
    }

    /// Returns the weights of the second and the third corner of a triangle that the ray is known to meet, by twice the
    /// digits of a double.
    pub(crate) fn fine_weights(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Option<[V::Real; 2]> {
        let [o, d] = self.floats()?.map(Vector::widen);
        FineDeterminants::within_range(&fine_images(triangle.0, maps), o, d)?.weights()
    }

    /// Compares the distances to the images of two triangles that the ray is known to meet, each under its maps.
    /// `[EXACT-13]`
    pub(crate) fn compare(&self, images: [Image<'_, V>; 2]) -> Ordering {
        let by_digits = || {
            let [o, d] = self.floats()?.map(Vector::widen);
            let fine =
                |(shape, maps): (&Triangle<V>, _)| FineDeterminants::within_range(&fine_images(shape.0, maps), o, d);
            let [one, other] = images.map(fine);
            one?.compare_distance(&other?)
        };
        by_digits().unwrap_or_else(|| {
            let [one, other] = images.map(|(shape, maps)| match self.cross(shape, maps) {
                Meeting::Hit(point) => Some(point.t),
                Meeting::Miss | Meeting::Coplanar => None,
            });
            one.cmp(&other)
        })
    }

    /// Returns origin and direction, if both consist of floats.
    const fn floats(&self) -> Option<[V; 2]> {
        match (&self.origin.0, &self.way) {
            (Place::Floats(origin), Way::Along(direction)) => Some([*origin, *direction]),
            _ => None,
        }
    }

    /// Intersects the line and the image of a triangle.
    fn cross(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Meeting {
        if let Some([origin, direction]) = self.floats() {
            return meet_image(triangle.0, maps, origin, direction);
        }
        meet_integers(self.integers(triangle, maps))
    }

    /// Returns whether the line passes through the interior of the image of a triangle after its origin is moved as by
    /// PARITY-1, in the outermost space. `[INST-8]`
    pub(crate) fn crosses(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> bool {
        crosses_integers(&self.integers(triangle, maps))
    }

    /// Returns the corners of the image of a triangle, origin and direction, all times one number.
    fn integers(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> [[IBig; 3]; 5] {
        let (([o, d], over), (corners, unit)) = (self.whole_line(), images(triangle.0, maps));
        let [o, d] = [o, d].map(|v| v.map(|x| x << unit));
        let [v0, v1, v2] = corners.map(|corner| corner.map(|x| x * &over));
        [v0, v1, v2, o, d]
    }

    /// Returns the ray in the space of an object under maps, from its entry into a region there, in rational
    /// arithmetic. The last map is the outermost. `None` if the ray misses the region. `[INST-7]`
    pub(crate) fn approach(&self, maps: &[AffineMap<V::Real>], region: &Region) -> Option<EnclosedRay> {
        let line = maps.iter().rev().fold(self.whole_line(), |line, map| map.pull_back_exactly(line));
        let (line, over) = line;
        let over_common = |x: IBig| Relaxed::from_parts_signed(x, over.clone());
        EnclosedRay::of_line(&line.map(|v| v.map(over_common)), region)
    }

    /// Returns origin and direction, as integers over the second number.
    fn whole_line(&self) -> ([[IBig; 3]; 2], IBig) {
        let line = self.line();
        let over = line.as_flattened().iter().fold(UBig::ONE, |over, x| {
            let common = (&over).gcd(x.denominator());
            over * (x.denominator() / common)
        });
        let integer = |x: &RBig| x.numerator() * IBig::from(&over / x.denominator());
        (line.each_ref().map(|v| v.each_ref().map(integer)), over.into())
    }

    /// Returns the point at which the ray meets a triangle; it must exist.
    fn point(&self, Surface { triangle, maps }: &Surface<V>) -> [RBig; 3] {
        let t = match self.cross(triangle, maps) {
            Meeting::Hit(point) => point.t,
            Meeting::Miss | Meeting::Coplanar => RBig::ZERO,
        };
        let [origin, direction] = self.line();
        array::from_fn(|k| &origin[k] + &t * &direction[k])
    }

    /// Returns origin and direction.
    fn line(&self) -> [[RBig; 3]; 2] {
        let origin = self.origin.rational().into_owned();
        let direction = match &self.way {
            Way::Along(direction) => rational(*direction),
            Way::Toward(target) => {
                let target = target.rational();
                array::from_fn(|k| &target[k] - &origin[k])
            }
        };
        [origin, direction]
    }

    /// Returns whether all distances within bounds are certainly in the ray's interval.
    fn holds(&self, [near, far]: [f64; 2]) -> bool {
        let [tmin, tmax]: [f64; 2] = self.interval.map(Into::into);
        tmin < near && far < tmax
    }

    fn generation(&self) -> u32 {
        let target = if let Way::Toward(target) = &self.way { target.generation() } else { 0 };
        self.origin.generation().max(target)
    }
}

/// Converts a finite vector to rational numbers.
fn rational<V: Vector>(v: V) -> [RBig; 3] {
    v.widen().to_array().map(|x| RBig::try_from(x).unwrap_or_default())
}

impl<V: Vector> From<&Ray<V>> for ExactRay<V> {
    fn from(ray: &Ray<V>) -> Self {
        let (origin, way) = (ExactPoint(Place::Floats(ray.origin())), Way::Along(ray.direction()));
        Self { origin, way, interval: [ray.tmin(), ray.tmax()], ends: Ends::Closed }
    }
}

impl<V: Vector> From<&Self> for ExactRay<V> {
    fn from(ray: &Self) -> Self {
        ray.clone()
    }
}

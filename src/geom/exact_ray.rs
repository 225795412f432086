//! Rays between points that are known exactly, though they are no floats: from where another ray has hit, or to it.

use std::array;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use glam::Vec3;

use super::affine::{fine_images, images};
use super::kernel::{Certainty, EnclosedTest, FineDeterminants};
use super::truth::{Meeting, Point, RBig, Relaxed, meet_integers};
use super::{
    AffineMap, EnclosedRay, Interval, Ray, RayError, Real, Region, Triangle, Vector, check_environment, meet_image,
};

/// A point of space that is known exactly: one of floats, or where a ray meets a triangle, which is not rounded. Floats
/// are of single precision, or with [`DVec3`](glam::DVec3) of double. `[SECOND-1]`
///
/// It is made of bounds in double precision, which decide nearly everything, and of what is needed to compute the
/// rational point when bounds do not decide. A copy is cheap.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::geom::{Ends, ExactPoint, Ray, Triangle};
///
/// let triangle = Triangle([Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0]);
/// let ray = Ray::new(Vec3::new(1.0, 1.0, -7.0), Vec3::new(0.1, 0.2, 3.0))?;
/// let point = ExactPoint::met(&ray, &triangle).ok_or("a miss")?;
/// // It is on the triangle exactly, so a ray from it does not meet the triangle again.
/// assert!(ExactPoint::met(point.ray(Vec3::X + Vec3::Z, f32::INFINITY, Ends::Open)?, &triangle).is_none());
/// // Unless the point itself counts.
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

/// Where a ray meets a triangle.
#[derive(Debug)]
struct Met<V: Vector> {
    bounds: [Interval; 3],
    surface: Surface<V>,
    /// `None` if the point is known: a path would keep all its rays.
    ray: Option<ExactRay<V>>,
    point: OnceLock<[RBig; 3]>,
    /// How many points have to be computed before this one.
    generation: u32,
}

/// A triangle, and the maps that place it, from the innermost on.
#[derive(Clone, Debug, PartialEq)]
struct Surface<V: Vector> {
    triangle: Triangle<V>,
    maps: Vec<AffineMap<V::Real>>,
}

/// A triangle, and the maps that place it, likewise.
pub(crate) type Image<'a, V> = (&'a Triangle<V>, &'a [AffineMap<<V as Vector>::Real>]);

/// So many points of a path may be known by bounds only, one after the other. Then one is computed. `[SECOND-4]`
const GENERATIONS: u32 = 8;

/// A ray whose line is known exactly: `origin + t direction`, for `t` from 0 to its end. `[SECOND-1]`
///
/// A [`Ray`] is one, too. See [`ExactPoint`] for those that begin on a surface.
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

/// Whether the ends of a ray belong to it. `[SECOND-2]`
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ends {
    /// They do not: `0 < t < tmax`. What contains the origin is not hit there, neither the triangle that the ray leaves,
    /// nor its neighbours, nor others that touch it.
    Open,
    /// They do: `0 <= t <= tmax`. All triangles that contain the origin are hit, but for those in whose planes the ray
    /// runs.
    Closed,
}

impl<V: Vector> ExactPoint<V> {
    /// A point of floats.
    ///
    /// # Errors
    /// [`RayError::Origin`] if it is not finite, and [`RayError::Environment`].
    pub fn new(point: V) -> Result<Self, RayError> {
        check_environment()?;
        if point.is_finite() { Ok(Self(Place::Floats(point))) } else { Err(RayError::Origin(point.widen())) }
    }

    /// Where a ray meets a triangle; `None` for a miss.
    pub fn met(ray: impl Into<ExactRay<V>>, triangle: &Triangle<V>) -> Option<Self> {
        let ray = ray.into();
        let test = EnclosedTest::new(&ray.enclosed(), ray.interval(), &Region::of(&triangle.aabb()));
        let t = test.span(triangle);
        if t.is_some_and(|t| ray.holds(t)) {
            return Some(Self::of(ray, triangle, Vec::new(), t));
        }
        ray.meet(triangle, &[]).map(|_| Self::of(ray, triangle, Vec::new(), None))
    }

    /// The point at which a ray is known to meet the image of a triangle under maps, the first of which is applied
    /// first, and bounds of the distance, if there are any.
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

    /// A ray from here, up to a distance in lengths of its direction, which may be infinite.
    ///
    /// # Errors
    /// What [`RayError`] lists of direction and interval.
    pub fn ray(&self, direction: V, tmax: V::Real, ends: Ends) -> Result<ExactRay<V>, RayError> {
        // Origins are finite.
        Ray::within(V::from_components([V::Real::ZERO; 3]), direction, V::Real::ZERO, tmax)?;
        Ok(ExactRay { origin: self.clone(), way: Way::Along(direction), interval: [V::Real::ZERO, tmax], ends })
    }

    /// The ray from here to another point, at which `t` is 1. Where the ends are open, it asks whether one point can be
    /// seen from the other.
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

    /// Bounds of each coordinate.
    pub fn bounds(&self) -> [Interval; 3] {
        match &self.0 {
            Place::Floats(point) => point.widen().to_array().map(Interval::exact),
            Place::Met(met) => met.bounds,
        }
    }

    /// The point itself. The first call takes some microseconds, more for points of long paths.
    pub fn rational(&self) -> Cow<'_, [RBig; 3]> {
        match &self.0 {
            Place::Floats(point) => Cow::Owned(rational(*point)),
            Place::Met(met) => Cow::Borrowed(met.point.get_or_init(|| {
                // One of both is there.
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
    /// Where it begins.
    pub const fn origin(&self) -> &ExactPoint<V> {
        &self.origin
    }

    /// The least and the greatest `t`.
    pub const fn interval(&self) -> [V::Real; 2] {
        self.interval
    }

    /// Whether these belong to it.
    pub const fn ends(&self) -> Ends {
        self.ends
    }

    /// Bounds of its line. `[SECOND-3]`
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

    /// Where it meets the image of a triangle under maps, the first of which is applied first, in rational arithmetic:
    /// a hit if this is within its ends. `[SECOND-2]`
    pub fn meet(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Option<Point> {
        if self.leaves(triangle, || maps) {
            return None;
        }
        let point = self.cross(triangle, maps).within(self.interval)?;
        let is_end = |end: V::Real| RBig::try_from(end.into()).is_ok_and(|end| end == point.t);
        (self.ends == Ends::Closed || !self.interval.into_iter().any(is_end)).then_some(point)
    }

    /// Whether it begins on this image of a triangle, and its origin does not count: its line meets what contains the
    /// origin there or nowhere. The maps are asked for where the triangle is the same.
    pub(crate) fn leaves<M: AsRef<[AffineMap<V::Real>]>>(
        &self,
        triangle: &Triangle<V>,
        maps: impl FnOnce() -> M,
    ) -> bool {
        self.ends == Ends::Open
            && matches!(&self.origin.0, Place::Met(met)
                if met.surface.triangle == *triangle && met.surface.maps == maps().as_ref())
    }

    /// Distance to the image of a triangle, by twice the digits of a double: where these tell whether it is met, and the
    /// distance is not at an end. `[INST-5]`
    pub(crate) fn fine_distance(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Certainty<V::Real> {
        let Some([o, d]) = self.floats() else { return Certainty::Open };
        let (images, o) = (fine_images(triangle.0, maps), o.widen());
        let found = FineDeterminants::within_range(&images, o, d.widen());
        found.map_or(Certainty::Open, |found| found.met(&images, o, self.interval))
    }

    /// The weights of the second and the third corner of a triangle that it is known to meet, likewise.
    pub(crate) fn fine_weights(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Option<[V::Real; 2]> {
        let [o, d] = self.floats()?.map(Vector::widen);
        FineDeterminants::within_range(&fine_images(triangle.0, maps), o, d)?.weights()
    }

    /// Compares the distances to the images of two triangles, each under its maps, which it is known to meet.
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

    /// Origin and direction, if both are of floats.
    const fn floats(&self) -> Option<[V; 2]> {
        match (&self.origin.0, &self.way) {
            (Place::Floats(origin), Way::Along(direction)) => Some([*origin, *direction]),
            _ => None,
        }
    }

    /// Where its line meets the image of a triangle.
    fn cross(&self, triangle: &Triangle<V>, maps: &[AffineMap<V::Real>]) -> Meeting {
        if let Some([origin, direction]) = self.floats() {
            return meet_image(triangle.0, maps, origin, direction);
        }
        let (([o, d], over), (corners, unit)) = (self.whole_line(), images(triangle.0, maps));
        let [o, d] = [o, d].map(|v| v.map(|x| x << unit));
        let [v0, v1, v2] = corners.map(|corner| corner.map(|x| x * &over));
        meet_integers([v0, v1, v2, o, d])
    }

    /// The ray in the space of an object under maps, the last of which is the outermost, from where it enters a region there,
    /// in rational arithmetic. `None` if it misses the region. `[INST-7]`
    pub(crate) fn approach(&self, maps: &[AffineMap<V::Real>], region: &Region) -> Option<EnclosedRay> {
        let line = maps.iter().rev().fold(self.whole_line(), |line, map| map.pull_back_exactly(line));
        let (line, over) = line;
        let over_common = |x: IBig| Relaxed::from_parts_signed(x, over.clone());
        EnclosedRay::of_line(&line.map(|v| v.map(over_common)), region)
    }

    /// Origin and direction, as integers over the second number.
    fn whole_line(&self) -> ([[IBig; 3]; 2], IBig) {
        let line = self.line();
        let over = line.as_flattened().iter().fold(UBig::ONE, |over, x| {
            let common = (&over).gcd(x.denominator());
            over * (x.denominator() / common)
        });
        let integer = |x: &RBig| x.numerator() * IBig::from(&over / x.denominator());
        (line.each_ref().map(|v| v.each_ref().map(integer)), over.into())
    }

    /// The point at which it meets a triangle; known to exist.
    fn point(&self, Surface { triangle, maps }: &Surface<V>) -> [RBig; 3] {
        let t = match self.cross(triangle, maps) {
            Meeting::Hit(point) => point.t,
            Meeting::Miss | Meeting::Coplanar => RBig::ZERO,
        };
        let [origin, direction] = self.line();
        array::from_fn(|k| &origin[k] + &t * &direction[k])
    }

    /// Origin and direction.
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

    /// Whether all distances within bounds are certainly its own.
    fn holds(&self, [near, far]: [f64; 2]) -> bool {
        let [tmin, tmax]: [f64; 2] = self.interval.map(Into::into);
        tmin < near && far < tmax
    }

    fn generation(&self) -> u32 {
        let target = if let Way::Toward(target) = &self.way { target.generation() } else { 0 };
        self.origin.generation().max(target)
    }
}

/// The same; it is finite.
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

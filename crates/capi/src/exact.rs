//! Rays that start at exact points, without `unsafe`.

use rayon::ThreadPool;
use rayon::prelude::*;
use stackless_bvh::geom::{Ends, ExactPoint, ExactRay as CheckedRay, Precision, RayError, Triangle};
use stackless_bvh::trace::{Hit as Found, InstanceFilter, InstanceHit, InstanceTracer, RayQueries as _};

use crate::error::{Element, Fault};
use crate::filters::OneFilter;
use crate::memory::{PIECE, room};
use crate::queries::{Rays, Real, checked, hit, is_parallel};
use crate::scene::{Scene, shared};
use crate::types::Hit;

/// An exact point: of floats, or of a hit. Any number of threads may use it at the same time.
#[derive(Debug)]
pub struct Point<V: Precision>(ExactPoint<V>);

/// A ray that starts at an exact point, such as the point of a hit.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ExactRay<R, V: Precision> {
    /// The start point.
    pub origin: *const Point<V>,
    /// The end point, at t = 1. If null, the ray has the direction and the end below.
    pub target: *const Point<V>,
    /// Finite and nonzero.
    pub direction: [R; 3],
    /// The maximum distance of a hit, at least 0. May be infinite.
    pub tmax: R,
    /// Whether the ends belong to the ray. If not, hits have 0 < t < tmax: the ray does not hit the face that it
    /// leaves, nor any other face that contains the origin.
    pub is_closed: bool,
}

/// An exact ray of the caller, with checked references instead of pointers, and its filter, which skips an `S` and
/// accepts hits `H`.
#[derive(Debug)]
pub(crate) struct Way<'a, V: Precision, S, H> {
    pub(crate) origin: &'a Point<V>,
    pub(crate) target: Option<&'a Point<V>>,
    pub(crate) direction: [Real<V>; 3],
    pub(crate) tmax: Real<V>,
    pub(crate) is_closed: bool,
    pub(crate) filter: Option<OneFilter<ExactRay<Real<V>, V>, S, H>>,
    /// The name in errors.
    pub(crate) element: Element,
}

/// Hits, with the points that were requested.
pub(crate) type Answers<V, H> = Vec<(H, Option<Point<V>>)>;

/// A scene or instances, for exact rays.
pub(crate) trait Exact<V: Precision>: Sync {
    /// A face that a filter skips.
    type Skip: Copy + Sync;

    /// A hit in the format of C.
    type Hit: Copy + Send;

    fn tracer(&self) -> Result<&InstanceTracer<V>, Fault>;

    fn pool(&self) -> Option<&ThreadPool>;

    /// Converts a hit, or none.
    fn hit(found: Option<&InstanceHit<Real<V>>>) -> Self::Hit;

    /// Returns whether a filter neither masks nor skips a face.
    fn sees<Y>(&self, filter: &OneFilter<Y, Self::Skip, Self::Hit>, path: &[u32], face: u32) -> bool;

    /// The closest hits, with their points on request.
    fn exact_closest(
        &self,
        ways: &[Way<'_, V, Self::Skip, Self::Hit>],
        with_points: bool,
        flags: u32,
    ) -> Result<Answers<V, Self::Hit>, Fault> {
        let tracer = self.tracer()?;
        each(ways, self.pool(), flags, |way| {
            let ray = way.ray()?;
            let found = match &way.filter {
                None if with_points => tracer.closest_and_point(ray).map(|(found, point)| (found, Some(point))),
                None => tracer.closest(&ray).map(|found| (found, None)),
                Some(filter) => self.ask(filter, |filter| {
                    let found = tracer.filtered(filter).closest_and_point(ray);
                    found.map(|(found, point)| (found, with_points.then_some(point)))
                }),
            };
            let (found, point) = found.map_or((None, None), |(found, point)| (Some(found), point));
            Ok((Self::hit(found.as_ref()), point.map(Point)))
        })
    }

    fn exact_any(&self, ways: &[Way<'_, V, Self::Skip, Self::Hit>], flags: u32) -> Result<Vec<bool>, Fault> {
        let tracer = self.tracer()?;
        each(ways, self.pool(), flags, |way| {
            let ray = way.ray()?;
            Ok(match &way.filter {
                None => tracer.any(&ray),
                Some(filter) => self.ask(filter, |filter| tracer.filtered(filter).any(&ray)),
            })
        })
    }

    /// Runs a query with a filter.
    fn ask<Y, A>(
        &self,
        filter: &OneFilter<Y, Self::Skip, Self::Hit>,
        query: impl FnOnce(InstanceFilter<'_, Real<V>>) -> A,
    ) -> A {
        let is_seen = |path: &[u32], face: u32| self.sees(filter, path, face);
        filter.ask_instances(&is_seen, |found| Self::hit(Some(found)), query)
    }
}

/// Queries need no lock.
const _: () = {
    const fn is_shared<T: Sync + Send>() {}
    is_shared::<Point<glam::DVec3>>();
};

impl<V: Precision> Point<V> {
    pub(crate) fn new(point: [Real<V>; 3], element: Element) -> Result<Self, Fault> {
        let point = ExactPoint::new(V::from_components(point));
        point.map(Self).map_err(|error| Fault::of_point(error, element))
    }
}

impl<V: Precision> Scene<V> {
    /// The point at which a ray meets a face.
    pub(crate) fn point_of_hit(&self, ray: &Rays<'_, V>, face: u32) -> Result<Point<V>, Fault> {
        let (ray, faces) = (checked::<V>(ray, 0)?, self.mesh().triangles().len());
        if face as usize >= faces {
            return Err(Fault::argument(format!("face: {face}, expected one of {faces} faces")));
        }
        let point = ExactPoint::met(&ray, &Triangle(self.mesh().triangle(face as usize)));
        point.map(Point).ok_or_else(|| Fault::argument(format!("face: the ray does not hit face {face}")))
    }
}

impl<V: Precision> Exact<V> for Scene<V> {
    type Skip = u32;

    type Hit = Hit<Real<V>>;

    fn tracer(&self) -> Result<&InstanceTracer<V>, Fault> {
        self.exact_tracer()
    }

    fn pool(&self) -> Option<&ThreadPool> {
        self.pool()
    }

    fn hit(found: Option<&InstanceHit<Real<V>>>) -> Self::Hit {
        hit::<V>(found.map(|&InstanceHit { prim, t, u, v, .. }| Found { prim, t, u, v }))
    }

    fn sees<Y>(&self, filter: &OneFilter<Y, u32, Self::Hit>, _: &[u32], face: u32) -> bool {
        filter.sees(self.masks(), face) && filter.skip != Some(face)
    }
}

/// Answers all rays, or returns the error of the first ray that fails.
fn each<Y: Sync, A: Send>(
    ways: &[Y],
    pool: Option<&ThreadPool>,
    flags: u32,
    answer: impl Fn(&Y) -> Result<A, Fault> + Sync,
) -> Result<Vec<A>, Fault> {
    let mut answers = room(ways.len())?;
    if is_parallel(flags)? {
        shared(pool, || ways.par_iter().with_max_len(PIECE).map(&answer).collect_into_vec(&mut answers));
    } else {
        answers.extend(ways.iter().map(answer));
    }
    answers.into_iter().collect()
}

impl<V: Precision, S, H> Way<'_, V, S, H> {
    fn ray(&self) -> Result<CheckedRay<V>, Fault> {
        let Self { origin: Point(origin), target, direction, tmax, is_closed, element, .. } = *self;
        let ends = if is_closed { Ends::Closed } else { Ends::Open };
        let ray = match target {
            Some(Point(target)) => origin.toward(target, ends),
            None => origin.ray(V::from_components(direction), tmax, ends),
        };
        ray.map_err(|error| match error {
            RayError::ZeroDirection if target.is_some() => {
                Fault::argument(format!("{element}.target: the point is the origin, expected another one"))
            }
            error => Fault::of_ray(error, element),
        })
    }
}

//! Rays that start at exact points, without `unsafe`.

use stackless_bvh::geom::lanes::Precision;
use stackless_bvh::geom::{Ends, ExactPoint, ExactRay, RayError, Triangle};
use stackless_bvh::trace::{Hit as Found, InstanceHit, RayQueries as _};

use crate::error::Fault;
use crate::memory::Element;
use crate::queries::{Rays, Real, checked, hit};
use crate::scene::Scene;
use crate::types::Hit;

/// An exact point: of floats, or of a hit. Any number of threads may use it at the same time.
#[derive(Debug)]
pub struct Point<V: Precision>(ExactPoint<V>);

/// An exact ray of the caller, with checked references instead of pointers.
#[derive(Debug)]
pub(crate) struct Way<'a, V: Precision> {
    pub(crate) origin: &'a Point<V>,
    pub(crate) target: Option<&'a Point<V>>,
    pub(crate) direction: [Real<V>; 3],
    pub(crate) tmax: Real<V>,
    pub(crate) is_closed: bool,
}

type HitAndPoint<V> = (Hit<Real<V>>, Option<Point<V>>);

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

    /// The closest hit, with its point on request.
    pub(crate) fn exact_closest1(&self, way: &Way<'_, V>, with_point: bool) -> Result<HitAndPoint<V>, Fault> {
        let (ray, tracer) = (way.ray()?, self.exact_tracer()?);
        let (found, point) = if with_point {
            tracer.closest_and_point(ray).map(|(found, point)| (found, Point(point))).unzip()
        } else {
            (tracer.closest(&ray), None)
        };
        let found = found.map(|InstanceHit { prim, t, u, v, .. }| Found { prim, t, u, v });
        Ok((hit::<V>(found), point))
    }

    pub(crate) fn exact_any1(&self, way: &Way<'_, V>) -> Result<bool, Fault> {
        Ok(self.exact_tracer()?.any(&way.ray()?))
    }
}

impl<V: Precision> Way<'_, V> {
    fn ray(&self) -> Result<ExactRay<V>, Fault> {
        let Self { origin: Point(origin), target, direction, tmax, is_closed } = *self;
        let ends = if is_closed { Ends::Closed } else { Ends::Open };
        let ray = match target {
            Some(Point(target)) => origin.toward(target, ends),
            None => origin.ray(V::from_components(direction), tmax, ends),
        };
        ray.map_err(|error| match error {
            RayError::ZeroDirection if target.is_some() => {
                Fault::argument("ray.target: the point is the origin, expected another one")
            }
            error => Fault::of_ray(error, Element::of("ray")),
        })
    }
}

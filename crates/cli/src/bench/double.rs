//! The default traversal in double precision, with the rays and triangles of single precision: unchanged, and in places
//! that single precision cannot represent.

use clap::builder::{PossibleValue, TypedValueParser};
use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{Builder, WideBvh};
use stackless_bvh::geom::{Aabb, Mesh, Ray};
use stackless_bvh::internals::trace::Accuracy;
use stackless_bvh::trace::Tracer;
use stackless_bvh::wide::Topology as _;

use super::wide::Manner;
use super::{Contestant, timed};
use crate::build;
use crate::input::{self, Scene};
use crate::judge::{Answer, Query};

/// The place of a scene. Except for [`AS_IT_IS`](Place::AS_IT_IS), the scene is first scaled to an extent of about 1.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Place {
    name: &'static str,
    scale: f64,
    /// Translation, in units of the scale.
    shift: f64,
    /// Added to the smallest component of each direction.
    tilt: f64,
}

const PLACES: [Place; 6] = [
    Place::AS_IT_IS,
    Place { name: "f64 at 6.4e6", scale: 1.0, shift: 6.4e6, tilt: 0.0 },
    Place { name: "f64 at 1e9", scale: 1.0, shift: 1e9, tilt: 0.0 },
    Place { name: "f64 by 1e-50", scale: 1e-50, shift: 0.0, tilt: 0.0 },
    Place { name: "f64 by 1e50", scale: 1e50, shift: 0.0, tilt: 0.0 },
    Place { name: "f64 with 1e-130", scale: 1.0, shift: 0.0, tilt: 1e-130 },
];

impl Place {
    /// Without rounding, the answers equal those in single precision.
    pub(super) const AS_IT_IS: Self = Self { name: "wide-record-f64", scale: 1.0, shift: 0.0, tilt: 0.0 };
}

/// The names of all places.
pub(super) const NAMES: &str = "f64,6.4e6,1e9,1e-50,1e50,1e-130";

/// Reads a place by its name.
pub(super) fn place() -> impl TypedValueParser<Value = Place> {
    let names = NAMES.split(',').map(PossibleValue::new).zip(PLACES);
    input::listed(names.collect())
}

/// Builds the default traversal in double precision, for these places.
pub(super) fn build(
    scene: &Scene,
    build: Builder,
    places: &[Place],
    manner: Manner,
) -> Result<Vec<Box<dyn Contestant>>, Box<dyn std::error::Error>> {
    let Aabb { lo, hi } = Aabb::of(scene.mesh.vertices());
    let extent = f64::from((hi - lo).max_element());
    let mut built = Vec::<Box<dyn Contestant>>::new();
    for &place in places {
        let space = if place == Place::AS_IT_IS || extent == 0.0 {
            Space { place, middle: DVec3::ZERO, unit: 1.0 }
        } else {
            Space { place, middle: (lo.as_dvec3() + hi.as_dvec3()) * 0.5, unit: 1.0 / extent }
        };
        let vertices = scene.mesh.vertices().iter().map(|&v| space.point(v)).collect();
        let mesh = Mesh::new(vertices, scene.mesh.triangles().to_vec())?;
        let (bvh, build_seconds) = timed(|| build::options(build).build_wide(&mesh))?;
        let tracer = Tracer::new(bvh).with_level(manner.level);
        built.push(Box::new(Double {
            space,
            build,
            tracer,
            build_seconds,
            rays: Vec::new(),
            found: Vec::new(),
            manner,
        }));
    }
    Ok(built)
}

struct Space {
    place: Place,
    middle: DVec3,
    unit: f64,
}

impl Space {
    fn point(&self, v: Vec3) -> DVec3 {
        let Place { scale, shift, .. } = self.place;
        ((v.as_dvec3() - self.middle) * self.unit + DVec3::new(1.0, -0.7, 0.3) * shift) * scale
    }

    fn ray(&self, ray: &Ray) -> Option<Ray<DVec3>> {
        let Place { scale, tilt, .. } = self.place;
        let mut d = ray.direction().as_dvec3() * (self.unit * scale);
        if tilt != 0.0 {
            d[ray.direction().abs().min_position()] = tilt;
        }
        Ray::within(self.point(ray.origin()), d, ray.tmin().into(), ray.tmax().into()).ok()
    }
}

struct Double {
    space: Space,
    build: Builder,
    tracer: Tracer<WideBvh<8, DVec3>, DVec3>,
    build_seconds: f64,
    /// The prepared rays.
    rays: Vec<Ray<DVec3>>,
    /// Buffer for answers.
    found: Vec<Option<(u32, f64)>>,
    manner: Manner,
}

impl Contestant for Double {
    fn method(&self) -> &'static str {
        self.space.place.name
    }

    fn build(&self) -> Option<Builder> {
        Some(self.build)
    }

    /// `None`, because answers are not compared bit by bit: distances are rounded twice, or the rays differ.
    fn accuracy(&self) -> Option<Accuracy> {
        None
    }

    fn tests(&self) -> &'static str {
        Accuracy::Exact.name()
    }

    fn is_judged(&self) -> bool {
        self.space.place == Place::AS_IT_IS
    }

    fn take(&mut self, rays: &[Ray]) {
        // An invalid direction becomes an arbitrary one, so that the number of rays is unchanged.
        let other = Ray::new(DVec3::ZERO, DVec3::X);
        let taken = rays.iter().filter_map(|ray| self.space.ray(ray).or(other.as_ref().ok().copied()));
        self.rays = taken.collect();
        self.found = vec![None; rays.len()];
    }

    fn trace(&mut self, query: Query, rays: &[Ray], first: usize, answers: &mut [Answer]) {
        let found = &mut self.found[..rays.len()];
        self.manner.trace(&self.tracer, query, &self.rays[first..first + rays.len()], found);
        for (answer, &found) in answers.iter_mut().zip(&*found) {
            *answer = found.map(|(prim, t)| (prim, t as f32));
        }
    }

    fn nodes(&mut self, query: Query, _: &[Ray]) -> Option<u64> {
        match query {
            Query::Closest => {
                let counters = self.tracer.count_closest(&self.rays);
                Some(counters.nodes + counters.leaves)
            }
            Query::Any => None,
        }
    }

    fn state_bytes(&self) -> Option<usize> {
        Some(self.tracer.method().state_bytes::<8>(self.tracer.bvh().levels() as usize))
    }

    fn build_seconds(&self) -> f64 {
        self.build_seconds
    }
}

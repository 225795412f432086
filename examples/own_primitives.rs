//! Rays through spheres: a hierarchy of custom shapes with bounds, and a custom test.
//!
//! `cargo run --release --example own_primitives`

use stackless_bvh::bvh::{Bounded, Bvh};
use stackless_bvh::geom::{Aabb, Kernel, Ray, Region};
use stackless_bvh::glam::Vec3;
use stackless_bvh::trace::BinaryTracer;
use stackless_bvh::traverse::Method;
use stackless_bvh::tree::Topology;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Sphere {
    center: Vec3,
    radius: f32,
}

impl Bounded for Sphere {
    fn aabb(&self) -> Aabb {
        // One float further on each side, so rounding cannot make the box too small.
        let [lo, hi] = [self.center - self.radius, self.center + self.radius];
        Aabb { lo: lo.map(f32::next_down), hi: hi.map(f32::next_up) }
    }
}

/// A ray that hits spheres from outside.
#[derive(Clone, Copy, Debug)]
struct SphereTest(Ray);

impl Kernel for SphereTest {
    type Vector = Vec3;
    type Shape = Sphere;
    type Filter = ();

    fn new(ray: &Ray, _: &Region) -> Self {
        Self(*ray)
    }

    fn distance(&self, sphere: &Sphere, tmax: f32) -> Option<f32> {
        let Self(ray) = self;
        let (direction, radius) = (ray.direction().as_dvec3(), f64::from(sphere.radius));
        let to_center = sphere.center.as_dvec3() - ray.origin().as_dvec3();
        let along = direction.dot(to_center) / direction.length_squared();
        let miss = (to_center - direction * along).length_squared();
        // NaN if the ray misses: every comparison with it is false.
        let t = (along - ((radius * radius - miss) / direction.length_squared()).sqrt()) as f32;
        (ray.tmin() <= t && t <= tmax).then_some(t)
    }

    /// Returns the position of the hit on the shape. Spheres have no corners, hence no weights.
    fn weights(&self, _: &Sphere) -> [f32; 2] {
        [0.0; 2]
    }
}

/// Traces one ray along a row of spheres on a grid.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let place = |i: u32| Vec3::new((i % 100) as f32, (i / 100) as f32, 0.0);
    let spheres: Vec<_> = (0..10_000).map(|i| Sphere { center: place(i), radius: 0.3 }).collect();
    let bvh = Bvh::build(&spheres[..])?;
    let tracer = BinaryTracer::<_, SphereTest>::with_tests(&bvh, Method::default())?;

    let ray = Ray::new(Vec3::new(-5.0, 42.0, 0.0), Vec3::X)?;
    let hit = tracer.closest_distance(&ray);
    println!("{} spheres, depth {}: {hit:?}", spheres.len(), bvh.depth());
    assert_eq!(hit, Some((4200, 4.7)));
    Ok(())
}

//! Secondary rays from hits.

use glam::Vec3;

use super::{Closest, Hit};
use crate::bvh::Bvh;
use crate::generate::Rng;
use crate::geom::{Mesh, Ray};
use crate::traverse::{Stack, traverse};

/// Returns for each ray that hits a ray from just before its hit, in a random direction away from the surface: a
/// diffuse reflection. `bvh` must be over `mesh`.
pub fn bounce(mesh: &Mesh, bvh: &Bvh, rays: &[Ray], seed: u64) -> Vec<Ray> {
    let mut memory = Vec::new();
    let hits = rays.iter().map(|ray| {
        let mut search = Closest::new(bvh, ray);
        traverse(Stack::new(bvh, &mut memory), &mut search, &mut ());
        search.hit()
    });
    reflect_each(mesh, rays, hits, seed)
}

/// Returns the rays of [`bounce`] for given closest hits.
pub fn reflect_each(mesh: &Mesh, rays: &[Ray], hits: impl IntoIterator<Item = Option<Hit>>, seed: u64) -> Vec<Ray> {
    let mut rng = Rng::new(seed);
    rays.iter().zip(hits).filter_map(|(ray, hit)| reflect(mesh, ray, &hit?, &mut rng)).collect()
}

/// Returns the ray of [`bounce`] from a hit of one ray; `None` if the triangle is too small to have a normal.
pub fn reflect(mesh: &Mesh, ray: &Ray, hit: &Hit, rng: &mut Rng) -> Option<Ray> {
    let [a, b, c] = mesh.triangle(hit.prim as usize);
    let normal = (b - a).cross(c - a).try_normalize()?;
    let outside = if normal.dot(ray.direction()) > 0.0 { -normal } else { normal };
    // Added to the normal, a point of the unit sphere gives the cosine distribution.
    let direction = outside + unit_vector(rng);
    let origin = ray.origin() + ray.direction() * (hit.t * (1.0 - 1e-4));
    Ray::new(origin, direction).ok()
}

/// Returns a ray from its origin up to this length, in world units; `None` if that is not a number.
pub fn cut(ray: &Ray, length: f32) -> Option<Ray> {
    let tmax = length / ray.direction().length();
    Ray::within(ray.origin(), ray.direction(), 0.0, tmax).ok()
}

fn unit_vector(rng: &mut Rng) -> Vec3 {
    loop {
        let bits = rng.bits();
        let component = |shift: u32| (bits >> shift & 0xf_ffff) as f32 / 524_288.0 - 1.0;
        let v = Vec3::new(component(0), component(20), component(40));
        if (1e-3..=1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

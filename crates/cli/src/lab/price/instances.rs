//! Rays through instances.

use glam::Vec3;
use stackless_bvh::bvh::{BuildOptions, Bvh, SahOptions, WideBvh};
use stackless_bvh::generate::{procedural, stress};
use stackless_bvh::geom::{AffineMap, Ray};
use stackless_bvh::trace::{Assembly, Instance, InstanceTracer, Object, RayQueries};
use stackless_bvh::traverse::Method;

use super::scenes::{along_axes_from_afar, apply, sphere, turn};
use super::{Made, QUERIES, queries};

/// Rays at vertices of a sphere in `deep` nested instances.
pub(super) fn instances(deep: usize, affine: AffineMap) -> Made {
    let mesh = stress::icosphere(3, 1.0, Vec3::ZERO)?;
    let mut assembly = Assembly::new();
    let mut object: Object = assembly.add_mesh(Bvh::sah(&mesh, SahOptions::default())?);
    for _ in 0..deep {
        object = assembly.add_group(vec![Instance { object, affine }], &BuildOptions::default())?;
    }
    let image = |v: Vec3| (0..deep).fold(v, |v, _| apply(&affine, v));
    let middle = image(Vec3::ZERO);
    let hard = mesh
        .vertices()
        .iter()
        .take(QUERIES)
        .filter_map(|&v| {
            let o = middle + Vec3::new(0.5, 0.25, 4.0);
            Ray::new(o, image(v) - o).ok()
        })
        .collect();
    let ordinary = procedural::rays(&mesh, 1, QUERIES)
        .iter()
        .filter_map(|ray| Ray::new(ray.origin() + middle, ray.direction()).ok())
        .collect();
    closest_in(&assembly, object, hard, ordinary)
}

/// Rays at a rotated sphere.
pub(super) fn from_afar_into_instance(is_wide: bool) -> Made {
    let (mesh, mut assembly) = (sphere()?, Assembly::new());
    let bvh = Bvh::sah(&mesh, SahOptions::default())?;
    let object = if is_wide { assembly.add_wide(WideBvh::of(&bvh)?) } else { assembly.add_mesh(bvh) };
    let instances = vec![Instance { object, affine: turn(0.8, 0.6)? }];
    let object = assembly.add_group(instances, &BuildOptions::default())?;
    closest_in(&assembly, object, along_axes_from_afar(), procedural::rays(&mesh, 1, QUERIES))
}

fn closest_in(assembly: &Assembly, object: Object, hard: Vec<Ray>, ordinary: Vec<Ray>) -> Made {
    Ok(queries(
        InstanceTracer::new(assembly, object, Method::default())?,
        hard,
        ordinary,
        |tracer, ray: &Ray| usize::from(tracer.closest(ray).is_some()),
        |tracer, ray| Some(tracer.count_closest(std::slice::from_ref(ray)).into()),
    ))
}

//! Rays in double precision, by every traversal of binary trees, against rational arithmetic.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{BuildError, Bvh};
use stackless_bvh::geom::kernel::Exact64;
use stackless_bvh::geom::slabs::Wide;
use stackless_bvh::geom::{Mesh, MeshError, Ray};
use stackless_bvh::trace::{BinaryTracer, Truth};
use stackless_bvh::traverse::{Method, Unfit};

use crate::stress::{Errors, Findings};

/// Why nothing could be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DoubleError {
    /// The moved triangles are not a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// There is no hierarchy over them.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The traversal is not for that hierarchy.
    #[error("{0}: {1}")]
    Unfit(Method, Unfit),
}

/// Traces rays through a mesh in double precision, all moved by `by`, by each of `methods` that is for any tree: closest
/// hit and any hit. The truth is that of the moved mesh. `[EXACT-7]`
///
/// # Errors
/// What [`DoubleError`] lists.
pub fn check_doubles(mesh: &Mesh, rays: &[Ray], by: DVec3, methods: &[Method]) -> Result<Errors, DoubleError> {
    let moved = |v: Vec3| v.as_dvec3() + by;
    let mesh = Mesh::new(mesh.vertices().iter().copied().map(moved).collect(), mesh.triangles().to_vec())?;
    let ray = |ray: &Ray| {
        let [tmin, tmax] = [ray.tmin(), ray.tmax()].map(f64::from);
        Ray::within(moved(ray.origin()), ray.direction().as_dvec3(), tmin, tmax).ok()
    };
    let rays: Vec<_> = rays.iter().filter_map(ray).collect();
    let truth = Truth::new(&mesh);
    let truth: Vec<_> = rays.iter().map(|ray| truth.closest(ray).map(|hit| hit.rounded())).collect();
    let (bvh, mut found) = (Bvh::build(&mesh)?, Findings::new(&truth));
    for &method in methods.iter().filter(|&&method| method != Method::Complete) {
        let tracer = BinaryTracer::<_, Exact64, Wide>::with_tests(&bvh, method);
        let tracer = tracer.map_err(|unfit| DoubleError::Unfit(method, unfit))?;
        let (closest, any) = (tracer.closest_each(&rays), tracer.any_each(&rays));
        for (i, closest) in closest.into_iter().enumerate() {
            found.see(i, any[i], closest);
        }
    }
    Ok(found.errors())
}

//! The hits of a ray one by one, for transparent surfaces. None is missed or repeated, even if many have equal
//! distances.
//!
//! `cargo run --release --example next_hits`

use stackless_bvh::generate::procedural;
use stackless_bvh::geom::Ray;
use stackless_bvh::glam::Vec3;
use stackless_bvh::trace::{MeshQueries, RayQueries, Tracer};

/// Computes the light that passes through a soup of triangles, each of which transmits nine tenths.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = procedural::soup(1, 2000);
    let tracer = Tracer::of(&mesh)?;
    let ray = Ray::new(Vec3::new(0.5, 0.5, -1.0), Vec3::Z)?;

    let (mut light, mut passed) = (1.0, Vec::new());
    let mut hit = tracer.closest(&ray);
    while let Some(found) = hit.filter(|_| light > 0.1) {
        light *= 0.9;
        passed.push(found.prim);
        hit = tracer.next(&ray, (found.t, found.prim));
    }
    println!("{light:.3} of the light is left after {} triangles: {passed:?}", passed.len());

    // The sequence of next hits equals a single search for all hits.
    let all = tracer.all(&ray).into_iter().map(|hit| hit.prim);
    assert!(all.take(passed.len()).eq(passed));
    Ok(())
}

//! The nearest triangles to a point, with the traversals for rays.
//!
//! `cargo run --release --example nearest_point`

use stackless_bvh::generate::procedural;
use stackless_bvh::geom::Ball;
use stackless_bvh::glam::Vec3;
use stackless_bvh::trace::{MeshQueries, Tracer};

/// Computes the distance from the corner of a cube to the soup in it.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = procedural::soup(1, 2000);
    let tracer = Tracer::of(&mesh)?;
    let ball = Ball::around(Vec3::ZERO)?;

    let nearest = tracer.nearest(&ball).ok_or("there are triangles")?;
    println!("the nearest: {nearest:?}");
    let five = tracer.nearest_k(&ball, 5);
    for near in &five {
        println!("  {near:?}");
    }
    assert_eq!((five.len(), five[0]), (5, nearest));
    assert!(tracer.nearest(&Ball::new(Vec3::splat(-10.0), 1.0)?).is_none(), "nothing within the radius");
    Ok(())
}

//! A forest of one tree: 400 placed copies share a hierarchy, and 100 copies of that forest share another one.
//!
//! A hit names the path of instances and the triangle. It is exact: that of the images of the corners.
//!
//! `cargo run --release --example instances`

use stackless_bvh::bvh::{BuildOptions, WideBvh};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{AffineMap, Ray};
use stackless_bvh::glam::Vec3;
use stackless_bvh::trace::{Assembly, Instance, InstanceTracer, Object, RayQueries};
use stackless_bvh::traverse::Method;

/// Places copies of an object in a square, with a distance between them.
fn square(object: Object, side: u8, distance: f32) -> Result<Vec<Instance>, Box<dyn std::error::Error>> {
    let at = |i: u8| f32::from(i) * distance;
    let place = |x, y| {
        let affine = AffineMap::translation(Vec3::new(at(x), at(y), 0.0))?;
        Ok(Instance { object, affine })
    };
    (0..side).flat_map(|x| (0..side).map(move |y| (x, y))).map(|(x, y)| place(x, y)).collect()
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tree = procedural::soup(1, 500);
    let mut assembly = Assembly::new();
    let object = assembly.add_wide(WideBvh::build(&tree)?);
    let forest = assembly.add_group(square(object, 20, 2.0)?, &BuildOptions::default())?;
    let land = assembly.add_group(square(forest, 10, 40.0)?, &BuildOptions::default())?;
    let tracer = InstanceTracer::new(&assembly, land, Method::default())?;

    // From above, onto the first triangle of each tree in a row. All sums of these numbers are exact.
    let corners = tree.triangles()[0].map(|vertex| tree.vertices()[vertex as usize]);
    let middle = ((corners[0] + corners[1] + corners[2]) * 1024.0 / 3.0).round() / 1024.0;
    let ray = |i: u8| Ray::new(Vec3::new(middle.x + 2.0 * f32::from(i), middle.y, 10.0), Vec3::NEG_Z);
    let rays = (0..200).map(ray).collect::<Result<Vec<_>, _>>()?;
    let hits = tracer.closest_each(&rays);
    let first = hits[0].as_ref().ok_or("the ray misses the tree")?;
    println!("forest {}, tree {}, triangle {}: distance {}", first.path[0], first.path[1], first.prim, first.t);

    // Each ray meets the same triangle of its tree.
    for (i, hit) in hits.iter().enumerate() {
        let hit = hit.as_ref().ok_or("the ray misses its tree")?;
        let [forest, tree] = [hit.path[0], hit.path[1]].map(|index| index as usize);
        assert_eq!((20 * (forest / 10) + tree / 20, hit.prim, hit.t), (i, first.prim, first.t));
    }
    Ok(())
}

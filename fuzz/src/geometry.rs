//! Targets of the geometric tests, compared with rational arithmetic.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{BuildOptions, Builder, SahOptions, SpatialOptions};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::{Aabb, Mesh, Precision, Ray, Triangle, Vector};
use stackless_bvh::internals::geom::kernel::{Exact, Exact64, ExactFromSingle};
use stackless_bvh::internals::geom::slabs::{Directed, EnclosedSlabs, Plain, Slabs64, TwoSided};
use stackless_check::{Solids, check_degenerate, check_distance, check_nearest, check_slabs, check_triangle};

use super::draw::Draw;
use super::right;

/// Checks the exact triangle tests, in single and in double precision. `[EXACT-1]` `[EXACT-7]`
pub(crate) fn triangle(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    if draw.coin() {
        let triangle = Triangle([(); 3].map(|()| draw.point_64()));
        right(check_degenerate(&triangle), format_args!("{triangle:?}"));
        if let Some(ray) = draw.ray_64(triangle.0) {
            right(check_triangle::<Exact64, _>(&triangle, &ray), format_args!("{triangle:?} {ray:?}"));
        }
        return;
    }
    let triangle = Triangle([(); 3].map(|()| draw.point()));
    right(check_degenerate(&triangle), format_args!("{triangle:?}"));
    if let Some(ray) = draw.ray(&[triangle.0]) {
        right(check_triangle::<Exact, _>(&triangle, &ray), format_args!("{triangle:?} {ray:?}"));
        right(check_triangle::<ExactFromSingle, _>(&triangle, &ray), format_args!("from single: {triangle:?} {ray:?}"));
    }
}

/// Checks all box tests. `[BOX-2]` `[BOX-3]` `[BOX-6]` `[INST-4]`
pub(crate) fn slabs(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let points = [(); 4].map(|()| draw.point());
    let (a, b) = (Aabb::of(&points[..2]), Aabb::of(&points[2..]));
    // At points of a face of the box, or of a diagonal.
    let (flat, diagonal) = ([a.lo, a.hi, a.lo.with_x(a.hi.x)], [a.lo, a.lo, a.hi]);
    if draw.coin() {
        let corners = flat.map(Vector::widen);
        if let Some(ray) = draw.ray_64(corners) {
            right(check_slabs::<Slabs64>(&ray, &a, &b, true), format_args!("{ray:?} {a:?} {b:?}"));
        }
        return;
    }
    let Some(ray) = draw.ray(&[flat, diagonal]) else { return };
    let about = |form: &str| format!("{form}: {ray:?} {a:?} {b:?}");
    right(check_slabs::<Plain>(&ray, &a, &b, false), about("plain"));
    right(check_slabs::<TwoSided>(&ray, &a, &b, false), about("two-sided"));
    right(check_slabs::<Directed>(&ray, &a, &b, true), about("directed"));
    right(check_slabs::<EnclosedSlabs>(&ray, &a, &b, true), about("enclosed"));
    let [o, d] = [ray.origin(), ray.direction()].map(Vector::widen);
    if let Ok(ray) = Ray::within(o, d, f64::from(ray.tmin()), f64::from(ray.tmax())) {
        right(check_slabs::<Slabs64>(&ray, &a, &b, true), about("wide"));
    }
}

/// Checks distances and nearest points of triangles, and the nearest triangles of a mesh, in single and in double
/// precision. `[NEAR-1]` `[NEAR-2]` `[NEAR-3]`
pub(crate) fn nearest(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let (k, radius) = (draw.below(6) as usize, if draw.coin() { draw.float().abs() } else { f32::INFINITY });
    let point = draw.point();
    let Some(mesh) = draw.mesh(9) else { return };
    all_near(&mesh, point, radius, k);
    // Numbers of the mesh, and new ones.
    let mut wider = |point: Vec3| if draw.coin() { point.widen() } else { draw.point_64() };
    let (vertices, point) = (mesh.vertices().iter().map(|&vertex| wider(vertex)).collect(), wider(point));
    let radius = if draw.coin() { draw.double().abs() } else { f64::INFINITY };
    let Ok(mesh) = Mesh::new(vertices, mesh.triangles().to_vec()) else { return };
    all_near(&mesh, point, radius, k);
}

/// Checks points inside, outside and on tetrahedra, compared with integers. `[CLOSED-2]` `[WINDING-1]`
pub(crate) fn solids(bytes: &[u8]) {
    let solids = Solids::draw(&mut Draw::new(bytes), 5);
    right(solids.check::<Vec3>(), format_args!("{solids:?}"));
    right(solids.check::<DVec3>(), format_args!("{solids:?}"));
}

fn all_near<V: Precision>(mesh: &Mesh<V>, point: V, radius: V::Real, k: usize) {
    let sah = SahOptions { max_leaf: 1, ..SahOptions::default() };
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    for prim in 0..mesh.triangles().len() {
        let triangle = Triangle(mesh.triangle(prim));
        right(check_distance(&triangle, point), format_args!("{triangle:?} {point:?}"));
    }
    for builder in [Builder::Standard, Builder::Spatial] {
        let options = BuildOptions { builder, sah, spatial, ..BuildOptions::default() };
        let bvh = right(options.build(mesh), "a tree without limits");
        right(
            check_nearest(&bvh, mesh, point, radius, k),
            format_args!("{builder}: {mesh:?} {point:?} {radius:?} {k}"),
        );
    }
}

use glam::Vec3;

use super::*;
use crate::bvh::{BuildOptions, Builder, SahOptions, SpatialOptions};
use crate::generate::{procedural, stress};
use crate::geom::{Aabb, Mesh};
use crate::trace::truth::{TrueHit, Truth};
use crate::traverse::{Stack, traverse};

/// Returns trees. In the last one triangles are in several leaves.
fn trees(mesh: &Mesh) -> [Bvh; 3] {
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    let options = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() };
    let cut = options.build(mesh);
    [Bvh::median(mesh, 2), Bvh::sah(mesh, SahOptions::default()), cut].map(|bvh| bvh.expect("a tree"))
}

fn count(bvh: &Bvh, ray: &Ray) -> u32 {
    let mut crossings = Crossings::new(bvh, ray);
    traverse(Stack::new(bvh, &mut Vec::new()), &mut crossings, &mut ());
    assert_eq!(crossings.is_odd(), crossings.count() % 2 == 1);
    crossings.count()
}

/// Returns rays from outside the box: at corners, at points of edges, and along axes through corners.
fn from_outside(mesh: &Mesh) -> Vec<Ray> {
    let Aabb { lo, hi } = Aabb::of(mesh.vertices());
    let middle = lo * 0.5 + hi * 0.5;
    let size = hi - middle;
    let ray = |i: usize| {
        let [a, b, _] = mesh.triangle(i % mesh.triangles().len());
        let aim = if i.is_multiple_of(2) { a } else { a * 0.5 + b * 0.5 };
        let axis = i / 2 % 3;
        let mut origin = [middle, aim, aim * 0.5 + middle * 0.5][i % 5 % 3];
        origin[axis] =
            if i.is_multiple_of(7) { middle[axis] + 1.5 * size[axis] } else { middle[axis] - 2.0 * size[axis] };
        let is_outside = origin[axis] < lo[axis] || hi[axis] < origin[axis];
        Ray::new(origin, aim - origin).ok().filter(|_| is_outside)
    };
    (0..2000).filter_map(ray).collect()
}

#[test]
fn closed_meshes_are_crossed_an_odd_number_of_times_from_inside_and_an_even_one_from_outside() {
    let mut cases = 0;
    for case in stress::cases(1500).filter(|case| case.closed) {
        cases += 1;
        let outside = from_outside(&case.mesh);
        assert!(outside.len() > 1000, "{}: {}", case.name, outside.len());
        for bvh in trees(&case.mesh) {
            for ray in &case.rays {
                assert_eq!(count(&bvh, ray) % 2, 1, "{}: {ray:?}", case.name);
            }
            let mut crossed = 0;
            for ray in &outside {
                let count = count(&bvh, ray);
                assert_eq!(count % 2, 0, "{}: {ray:?}", case.name);
                crossed += usize::from(count > 0);
            }
            assert!(5 * crossed > outside.len(), "{}: {crossed}", case.name);
        }
    }
    assert!(cases >= 20, "{cases}");
}

#[test]
fn a_crossing_is_a_hit_and_off_edges_a_hit_is_a_crossing() {
    let mesh = procedural::soup(4, 300);
    let [bvh, ..] = trees(&mesh);
    let mut total = 0;
    for ray in procedural::rays(&mesh, 5, 3000) {
        let hits = all(&bvh, &ray);
        let inside = hits.iter().filter(|hit| hit.u > 0.0 && hit.v > 0.0 && hit.u + hit.v < 0.999).count();
        let count = count(&bvh, &ray) as usize;
        assert!(inside <= count && count <= hits.len(), "{ray:?}");
        total += count;
    }
    assert!(total > 500, "{total}");
}

fn all(bvh: &Bvh, ray: &Ray) -> Vec<Hit> {
    let mut hits = AllHits::new(bvh, ray);
    traverse(Stack::new(bvh, &mut Vec::new()), &mut hits, &mut ());
    hits.into_hits()
}

fn all_are_true(mesh: &Mesh, rays: &[Ray]) -> usize {
    let (truth, trees) = (Truth::new(mesh), trees(mesh));
    let mut hits = 0;
    for ray in rays {
        let expected: Vec<_> = truth.all(ray).iter().map(TrueHit::rounded).collect();
        hits += expected.len();
        for bvh in &trees {
            assert_eq!(all(bvh, ray), expected, "{ray:?}");
        }
    }
    hits
}

#[test]
fn all_hits_are_those_of_rational_arithmetic() {
    for seed in 0..6 {
        let mesh = procedural::soup(seed, 1 + 200 * seed as usize);
        let hits = all_are_true(&mesh, &procedural::rays(&mesh, seed, 600));
        assert!(hits > 50, "{hits}");
    }
    for name in ["cube", "duplicates", "shells", "spindle", "torus"] {
        if let Some(case) = stress::case(name, 300) {
            assert!(all_are_true(&case.mesh, &case.rays) >= 300, "{name}");
        }
    }
}

#[test]
fn equal_distances_are_in_the_order_of_the_mesh() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let mesh = Mesh::new(corners, vec![[0, 1, 2]; 100]).expect("a mesh");
    let ray = Ray::within(Vec3::new(0.25, 0.25, -1.0), Vec3::Z, 0.0, 1.0).expect("a ray");
    for bvh in trees(&mesh) {
        assert!(all(&bvh, &ray).iter().map(|hit| hit.prim).eq(0..100));
    }
}

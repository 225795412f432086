use std::sync::Arc;

use glam::Vec3;

use super::*;
use crate::bvh::SahOptions;
use crate::generate::{procedural, stress};
use crate::geom::truth::{round_root, square_distance};
use crate::geom::{Ball, BallError};
use crate::trace::truth::TrueHit;
use crate::trace::{Near, truth};

fn meshes() -> Vec<(Mesh, Vec<Ray>)> {
    let made = [procedural::soup(1, 60), procedural::strands(2, 4), procedural::soup(3, 1)];
    let mut scenes: Vec<_> = made.into_iter().map(|mesh| (procedural::rays(&mesh, 4, 60), mesh)).collect();
    let doubled =
        Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z], vec![[0, 1, 2], [2, 1, 0], [0, 1, 3], [1, 0, 2]]);
    let doubled = doubled.expect("a mesh");
    scenes.push((procedural::rays(&doubled, 5, 200), doubled));
    scenes.into_iter().map(|(rays, mesh)| (mesh, rays)).collect()
}

fn trees(mesh: &Mesh) -> [Bvh; 2] {
    [Bvh::sah(mesh, SahOptions::default()), Bvh::median(mesh, 1)].map(|bvh| bvh.expect("a tree"))
}

/// Returns a tracer for each traversal that supports a tree.
fn tracers(bvh: &Bvh) -> Vec<BinaryTracer<&Bvh>> {
    Method::ALL.iter().filter_map(|&method| BinaryTracer::with_method(bvh, method).ok()).collect()
}

#[test]
fn every_traversal_answers_every_ray_query_with_the_truth() {
    for (mesh, rays) in meshes() {
        for bvh in trees(&mesh) {
            let tracers = tracers(&bvh);
            assert!(tracers.len() >= Method::ALL.len() - 1);
            for ray in &rays {
                let truth: Vec<_> = truth::brute_force(&mesh, ray).iter().map(TrueHit::rounded).collect();
                for tracer in &tracers {
                    assert_eq!(tracer.closest(ray), truth.first().copied(), "{tracer:?} {ray:?}");
                    assert_eq!(tracer.any(ray), !truth.is_empty(), "{tracer:?} {ray:?}");
                    assert_eq!(tracer.all(ray), truth, "{tracer:?} {ray:?}");
                    let after = |hit: &Hit| tracer.next(ray, (hit.t, hit.prim));
                    let walked: Vec<_> = std::iter::successors(tracer.closest(ray), after).take(200).collect();
                    assert_eq!(walked, truth, "{tracer:?} {ray:?}");
                }
            }
        }
    }
}

#[test]
fn hits_are_walked_through_on_hard_rays() {
    for case in stress::cases(6) {
        let bvh = Bvh::sah(&case.mesh, SahOptions::default()).expect("a tree");
        let tracer = BinaryTracer::new(&bvh);
        for ray in &case.rays {
            let all: Vec<_> = tracer.all(ray);
            let after = |hit: &Hit| tracer.next(ray, (hit.t, hit.prim));
            let walked: Vec<_> = std::iter::successors(tracer.closest(ray), after).take(all.len() + 1).collect();
            assert_eq!(walked, all, "{}: {ray:?}", case.name);
        }
    }
}

#[test]
fn slices_and_threads_give_the_same() {
    let mesh = procedural::soup(8, 300);
    let (tracer, rays) = (BinaryTracer::of(&mesh).expect("a tree"), procedural::rays(&mesh, 9, 3000));
    macro_rules! same {
        ($items:expr, $one:expr, $each:ident, $parallel:ident) => {
            let one: Vec<_> = $items.iter().map($one).collect();
            assert!(one == tracer.$each($items) && one.iter().any(|answer| *answer != one[0]));
            assert!(Ok(one) == tracer.$parallel($items));
        };
    }
    same!(&rays, |ray| tracer.closest(ray), closest_each, closest_parallel);
    same!(&rays, |ray| tracer.any(ray), any_each, any_parallel);
    same!(&rays, |ray| tracer.any_hit(ray), any_hit_each, any_hit_parallel);
    same!(&rays, |ray| tracer.all(ray), all_each, all_parallel);
    let balls: Vec<_> = rays.iter().map(|ray| Ball::new(ray.origin(), 0.1).expect("a ball")).collect();
    same!(&balls, |ball| tracer.nearest(ball), nearest_each, nearest_parallel);
    assert!(tracer.closest_each(&[]).is_empty() && tracer.closest_parallel(&[]) == Ok(Vec::new()));
}

/// A tracer in a struct, without a lifetime.
struct Scene {
    tracer: BinaryTracer,
    shared: BinaryTracer<Arc<Bvh>>,
}

#[test]
fn a_tracer_owns_borrows_or_shares() {
    let mesh = procedural::soup(8, 100);
    let bvh = Arc::new(Bvh::build(&mesh).expect("a tree"));
    let scene = Scene { tracer: BinaryTracer::new(Bvh::clone(&bvh)), shared: BinaryTracer::new(Arc::clone(&bvh)) };
    let rays = procedural::rays(&mesh, 9, 400);
    let expected = BinaryTracer::new(&*bvh).closest_each(&rays);
    assert!(expected.iter().flatten().count() > 40);
    let sent = std::thread::spawn(move || [scene.tracer.closest_each(&rays), scene.shared.closest_each(&rays)]);
    assert!(sent.join().is_ok_and(|found| found.iter().all(|found| *found == expected)));
}

#[test]
fn the_nearest_point_is_the_truth() {
    for (mesh, rays) in meshes() {
        // Random points, corners, and midpoints of edges.
        let on = mesh.triangles().iter().take(10).flat_map(|&[a, b, _]| {
            let [a, b] = [a, b].map(|corner| mesh.vertices()[corner as usize]);
            [a, (a + b) * 0.5]
        });
        let points: Vec<_> = rays.iter().step_by(6).map(Ray::origin).chain(on).collect();
        let size = mesh.vertices().iter().fold(0f32, |size, corner| size.max(corner.length()));
        for bvh in trees(&mesh) {
            for &point in &points {
                let distance = |prim: usize| {
                    let square = square_distance(mesh.triangle(prim).map(|corner| corner.to_array()), point.to_array());
                    round_root::<f32>(&square.expect("finite"))
                };
                let truth = (0..mesh.triangles().len())
                    .filter(|&prim| !crate::geom::Triangle(mesh.triangle(prim)).is_degenerate())
                    .map(|prim| (distance(prim), prim as u32))
                    .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                for tracer in tracers(&bvh) {
                    for radius in [f32::INFINITY, size * 0.1] {
                        let near = tracer.nearest(&Ball::new(point, radius).expect("a point and a radius"));
                        let truth = truth.filter(|&(distance, _)| distance <= radius);
                        assert_eq!(near.map(|near| (near.distance, near.prim)), truth, "{tracer:?} {point}");
                        if let Some(Near { point: found, distance, .. }) = near {
                            assert!(((found - point).length() - distance).abs() <= 1e-5 * size, "{tracer:?} {point}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_at_once() {
    let bvh = Bvh::sah(&procedural::soup(1, 100), SahOptions::default()).expect("a tree");
    let refused = BinaryTracer::with_method(&bvh, Method::Complete);
    assert!(matches!(refused, Err(Unsupported::NotComplete(_))));
    let tracer = BinaryTracer::new(&bvh);
    assert_eq!((tracer.method(), tracer.word()), (Method::default(), WordName::U32));
    assert_eq!(Ball::new(Vec3::ZERO, -1.0), Err(BallError::Radius(-1.0)));
    assert!(matches!(Ball::new(Vec3::NAN, 1.0), Err(BallError::Center(_))));
}

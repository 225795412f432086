use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::bvh::{BuildOptions, Builder, Bvh, SpatialOptions, WideBvh};
use crate::generate::draw::Draw;
use crate::geom::Mesh;
use crate::trace::truth::{TrueHit, Truth};
use crate::trace::{BinaryTracer, Tracer};
use crate::traverse::Method;
use crate::wide;

/// Returns triangles in several leaves, each three times, so all hits are ties.
fn scene() -> (Mesh, Bvh, Vec<Ray>) {
    let mut draw = Draw::new(1);
    let vertices = (0..300).map(|_| draw.ints(16)).collect();
    let faces: Vec<_> = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = Mesh::new(vertices, faces.repeat(3)).expect("a mesh");
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    let options = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() };
    let bvh = options.build(&mesh).expect("a tree");
    assert!(bvh.duplicates() > 0);
    let rays = (0..200).filter_map(|_| Ray::new(draw.ints(16), draw.ints(16)).ok()).collect();
    (mesh, bvh, rays)
}

/// [FILTER-1]
#[test]
fn accepted_hits_are_those_of_the_truth_by_every_traversal() {
    let (mesh, bvh, rays) = scene();
    let wide = WideBvh::of(&bvh).expect("a wide tree");
    let count = mesh.triangles().len() as u32 / 3;
    // The last copy, except of some triangles, and hits on one half of each triangle.
    let accepts_triangle = |prim: u32| prim >= count && !prim.is_multiple_of(5);
    let accepts_hit = |hit: &Hit| hit.u > hit.v;
    let filter = Filter::ALL.triangles(&accepts_triangle).hits(&accepts_hit);
    let truth = Truth::new(&mesh);
    let is_accepted = |hit: &Hit| accepts_triangle(hit.prim) && accepts_hit(hit);
    let all = |ray| truth.all(ray).iter().map(TrueHit::rounded).filter(is_accepted).collect::<Vec<_>>();
    let expected: Vec<_> = rays.iter().map(all).collect();
    assert!(expected.iter().filter(|hits| hits.len() > 2).count() > 20);
    let compare = |tracer: &dyn RayQueries<Ray, Hit = Hit>, name: &dyn fmt::Display| {
        let firsts: Vec<_> = expected.iter().map(|hits| hits.first().copied()).collect();
        assert_eq!(tracer.closest_each(&rays), firsts, "{name}");
        assert_eq!(tracer.all_each(&rays), expected, "{name}");
        for (ray, expected) in rays.iter().zip(&expected) {
            let any = tracer.any_hit(ray);
            assert_eq!((any.is_some(), tracer.any(ray)), (!expected.is_empty(), !expected.is_empty()), "{name}");
            assert!(any.is_none_or(|hit| expected.contains(&hit)), "{name} {any:?}");
        }
    };
    for method in Method::ALL {
        if let Ok(tracer) = BinaryTracer::with_method(&bvh, method) {
            compare(&tracer.filtered(filter), &method);
        }
    }
    for method in wide::Method::ALL {
        compare(&Tracer::with_method(&wide, method).expect("a tracer").filtered(filter), &method);
    }
}

/// An any-hit query ends at the first accepted hit. In closest-hit queries the filter is called for few hits, and for
/// none behind the best.
#[test]
fn filters_are_called_for_few_hits() {
    let (_, bvh, rays) = scene();
    let (wide, binary) = (Tracer::new(WideBvh::of(&bvh).expect("a wide tree")), BinaryTracer::new(&bvh));
    let hits: usize = rays.iter().map(|ray| wide.all(ray).len()).sum();
    let any = rays.iter().filter(|ray| wide.any(ray)).count();
    let calls = AtomicUsize::new(0);
    let accepts = |_: &Hit| calls.fetch_add(1, Ordering::Relaxed) < usize::MAX;
    let filter = Filter::ALL.hits(&accepts);
    for tracer in [&wide.filtered(filter) as &dyn RayQueries<Ray, Hit = Hit>, &binary.filtered(filter)] {
        tracer.any_each(&rays);
        assert_eq!(calls.swap(0, Ordering::Relaxed), any);
        tracer.closest_each(&rays);
        let called = calls.swap(0, Ordering::Relaxed);
        assert!(called >= any && 2 * called < hits, "{called} of {hits}");
    }
    assert_eq!(wide.filtered(Filter::ALL).closest_each(&rays), wide.closest_each(&rays));
}

//! Filters of instances, compared with the accepted ones of all hits. `[FILTER-1]`

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::Builder;
use stackless_bvh::generate::Rng;
use stackless_bvh::geom::Vector;
use stackless_bvh::trace::{InstanceFilter, InstanceHit, InstanceTracer, RayQueries};
use stackless_bvh::traverse::Method;
use stackless_check::{InstanceOracle, check_answer};

use super::scenes::{self, Kind};
use super::{assembly, hierarchies, rays, wide};

/// A filter as a function of hits.
type Accepts<'a, V> = &'a dyn Fn(&InstanceHit<<V as Vector>::Real>) -> bool;

/// By triangle, by hit, by triangle and hit: every query over binary and wide meshes. `[INST-6]`
fn accepted_hits_are_those_of_rational_arithmetic<V: Kind>() {
    let (mut accepted, mut behind, mut ties) = (0, 0, 0);
    for (seed, scene) in scenes::all::<V>().iter().enumerate() {
        let (flat, mut rng) = (InstanceOracle::new(&scene.shapes), Rng::new(2000 + seed as u64));
        let tracers = [
            (hierarchies(scene, Builder::Spatial, 2), Method::Hashed),
            (wide(scene, Builder::Standard, 1), Method::Stack),
        ];
        let tracers = tracers.map(|(built, method)| {
            let (assembly, root) = assembly(&built, scene);
            InstanceTracer::new(&assembly, root, method).expect("any tree")
        });
        let by_triangle = |path: &[u32], prim: u32| !(path.iter().sum::<u32>() + prim).is_multiple_of(3);
        let by_hit = |hit: &InstanceHit<V::Real>| hit.u <= hit.v;
        for ray in rays(&flat, &mut rng, 100) {
            let all = flat.all(&ray);
            let is_first = |hit: &InstanceHit<V::Real>| Some(hit) == all.first();
            let by_order = |hit: &InstanceHit<V::Real>| !is_first(hit);
            let filters: [(_, Accepts<'_, V>); 4] = [
                (InstanceFilter::ALL.triangles(&by_triangle), &|hit| by_triangle(&hit.path, hit.prim)),
                (InstanceFilter::ALL.hits(&by_hit), &by_hit),
                (InstanceFilter::ALL.hits(&by_order), &by_order),
                (InstanceFilter::ALL.triangles(&by_triangle).hits(&by_hit), &|hit| {
                    by_triangle(&hit.path, hit.prim) && by_hit(hit)
                }),
            ];
            for (filter, accepts) in filters {
                let expected: Vec<_> = all.iter().filter(|hit| accepts(hit)).cloned().collect();
                accepted += expected.len();
                behind += usize::from(expected.first().is_some_and(|hit| !is_first(hit)));
                ties += usize::from(matches!(expected.as_slice(), [a, b, ..] if a.t == b.t));
                for tracer in &tracers {
                    check_answer(&tracer.filtered(filter), &expected, &ray)
                        .unwrap_or_else(|fault| panic!("{}, {filter:?}, {ray:?}: {fault}", scene.name));
                }
            }
            for tracer in &tracers {
                assert_eq!(tracer.filtered(InstanceFilter::ALL).all(&ray), all);
                let is_mesh = |hit: &InstanceHit<_>| tracer.object(&hit.path).is_some();
                assert!(all.iter().all(is_mesh) && tracer.object(&[u32::MAX]).is_none());
            }
        }
    }
    assert!(accepted > 10_000 && behind > 2000 && ties > 500, "{accepted} {behind} {ties}");
}

#[test]
fn accepted_hits_are_those_of_rational_arithmetic_in_single() {
    accepted_hits_are_those_of_rational_arithmetic::<Vec3>();
}

#[test]
fn accepted_hits_are_those_of_rational_arithmetic_in_double() {
    accepted_hits_are_those_of_rational_arithmetic::<DVec3>();
}

/// A query for any hit calls the filter of hits until it accepts one, and a query for the closest hit for none behind
/// the best one.
#[test]
fn filters_are_called_for_few_hits() {
    let scene = &scenes::all::<Vec3>()[0];
    let (flat, mut rng, calls) = (InstanceOracle::new(&scene.shapes), Rng::new(9), AtomicUsize::new(0));
    let (assembly, root) = assembly(&wide(scene, Builder::Standard, 1), scene);
    let tracer = InstanceTracer::new(&assembly, root, Method::default()).expect("any tree");
    let accepts = |_: &InstanceHit| calls.fetch_add(1, Ordering::Relaxed) < usize::MAX;
    let filtered = tracer.filtered(InstanceFilter::ALL.hits(&accepts));
    let rays = rays(&flat, &mut rng, 300);
    let hits: usize = rays.iter().map(|ray| flat.all(ray).len()).sum();
    let any = filtered.any_each(&rays).into_iter().filter(|&hit| hit).count();
    assert_eq!(calls.swap(0, Ordering::Relaxed), any);
    assert_eq!(filtered.closest_each(&rays), tracer.closest_each(&rays));
    let called = calls.swap(0, Ordering::Relaxed);
    assert!(called >= any && called < hits, "{called} of {hits}");
}

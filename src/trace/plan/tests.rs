use glam::Vec3;

use super::*;
use crate::bvh::{Builder, SahOptions, SpatialOptions};
use crate::generate::procedural;
use crate::geom::{Mesh, Ray};
use crate::trace::{BinaryTracer, RayQueries};

fn scenes() -> Vec<(Mesh, Vec<Ray>)> {
    let meshes = [procedural::soup(1, 80), procedural::strands(2, 5), with_flat_triangles(&procedural::soup(3, 9))];
    meshes.map(|mesh| (procedural::rays(&mesh, 4, 60), mesh)).map(|(rays, mesh)| (mesh, rays)).into()
}

/// Adds three triangles that no ray hits.
pub(crate) fn with_flat_triangles(mesh: &Mesh) -> Mesh {
    let first = mesh.triangles()[0];
    let triangles = mesh.triangles().iter().copied().chain([[first[0], first[0], first[1]]; 3]).collect();
    Mesh::new(mesh.vertices().to_vec(), triangles).expect("a mesh")
}

/// Returns a tree for rays.
fn lean(mesh: &Mesh) -> Bvh {
    BuildOptions { degenerate: Degenerate::LeftOut, ..BuildOptions::default() }.build(mesh).expect("a tree")
}

#[test]
fn no_decision_changes_an_answer() {
    for (mesh, rays) in scenes() {
        let bvh = lean(&mesh);
        for method in Method::ALL.into_iter().filter(|&method| method != Method::Complete) {
            let lean = Plan::new(&bvh, method, QueryKind::Any);
            let each = Part::ALL.map(|part| lean.clone().with(part));
            let plans = [lean.clone(), lean.with_everything()].into_iter().chain(each);
            let answers = plans.map(|plan| {
                let tracer = BinaryTracer::planned(&bvh, method, &plan).expect("a tracer");
                let answer = |ray| {
                    let (closest, any) = (tracer.closest(ray), tracer.any(ray));
                    assert_eq!(tracer.closest_distance(ray), closest.map(|hit| (hit.prim, hit.t)));
                    assert_eq!((tracer.any_hit(ray).is_some(), closest.is_some()), (any, any));
                    (closest, tracer.all(ray))
                };
                rays.iter().map(answer).collect::<Vec<_>>()
            });
            let answers: Vec<_> = answers.collect();
            assert!(answers.iter().all(|other| *other == answers[0]), "{method}");
        }
    }
}

#[test]
fn degenerate_triangles_are_left_out_without_a_trace() {
    let (mesh, rays) = scenes().remove(2);
    let kept = &mesh.triangles()[..mesh.triangles().len() - 3];
    let without = Mesh::new(mesh.vertices().to_vec(), kept.to_vec()).expect("a mesh");
    let [with, without] = [&mesh, &without].map(lean);
    assert!(Plan::new(&with, Method::Hashed, QueryKind::Any).skips(Part::Degenerate));
    assert!(!Plan::new(&without, Method::Hashed, QueryKind::Any).skips(Part::Degenerate));
    for ray in &rays {
        assert_eq!(BinaryTracer::new(&with).all(ray), BinaryTracer::new(&without).all(ray));
    }
}

/// Returns the cost with and without a part, in figures that must differ.
fn done(part: Part, bvh: &Bvh, mesh: &Mesh, rays: &[Ray]) -> [u64; 2] {
    let method = if part == Part::Hash { Method::Afra } else { Method::Hashed };
    let lean = Plan::new(bvh, method, if part == Part::SecondTrail { QueryKind::Distance } else { QueryKind::Any });
    assert!(lean.skips(part), "{part:?}");
    [lean.clone(), lean.with(part)].map(|plan| {
        let tracer = BinaryTracer::planned(bvh, method, &plan).expect("a tracer");
        match part {
            Part::LongKeys => tracer.word() as u64,
            Part::Hash | Part::OwnBoxes => tracer.bytes() as u64,
            Part::SecondTrail => tracer.count_closest(rays).inner,
            Part::Weights => u64::from(tracer.with_weights),
            Part::Degenerate => {
                let bvh = plan.options(BuildOptions::default()).build(mesh).expect("a tree");
                assert!(rays.iter().all(|ray| BinaryTracer::new(&bvh).all(ray) == tracer.all(ray)));
                bvh.triangles().len() as u64
            }
            Part::Repeats => u64::from(tracer.sweep(&rays[0]).watches()),
            Part::ExactTests | Part::Entries => unreachable!("wide hierarchies"),
        }
    })
}

#[test]
fn each_decision_changes_what_is_done() {
    let mesh = with_flat_triangles(&procedural::soup(5, 500));
    let (bvh, rays) = (lean(&mesh), procedural::rays(&mesh, 4, 600));
    for part in Plan::new(&bvh, Method::Hashed, QueryKind::Any).decisions().iter().map(|decision| decision.part) {
        let [without, with] = done(part, &bvh, &mesh, &rays);
        // The second trail saves visits. Every other part costs work or memory.
        let ok = if part == Part::SecondTrail { without > with } else { without < with };
        assert!(ok, "{part:?}: {without}, {with}");
    }
    let by_node = Plan::new(&bvh, Method::Skip, QueryKind::Hit);
    assert!(!by_node.skips(Part::OwnBoxes) && !by_node.skips(Part::Weights) && by_node.skips(Part::Repeats));
    // If hits end nothing, nothing is stored for pruning.
    for (ask, method) in
        [(QueryKind::All, Method::Hashed), (QueryKind::Any, Method::Hashed), (QueryKind::Hit, Method::HashedDisjoint)]
    {
        let plan = Plan::new(&bvh, Method::HashedDisjoint, ask);
        let tracer = BinaryTracer::planned(&bvh, Method::HashedDisjoint, &plan).expect("a tracer");
        assert_eq!((tracer.method(), plan.skips(Part::SecondTrail)), (method, ask != QueryKind::Hit));
    }
}

/// Returns long triangles, which spatial splits divide.
pub(crate) fn diagonals() -> Mesh {
    let corner = |i: u32| Vec3::new((i % 5) as f32, (i / 5 % 5) as f32, (i / 25) as f32);
    let vertices = (0..150).flat_map(|i| [corner(i), corner(i) + Vec3::X * 0.3, corner(i) + Vec3::ONE * 5.0]).collect();
    Mesh::new(vertices, (0..150).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh")
}

#[test]
fn a_plan_of_another_hierarchy_changes_no_answer() {
    let mesh = diagonals();
    let spatial = SpatialOptions { extra_percent: 300, overlap: 0.0 };
    let in_parts = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() };
    let [plain, in_parts] = [BuildOptions::default(), in_parts].map(|options| options.build(&mesh).expect("a tree"));
    assert!(in_parts.duplicates() > 20);
    let rays = procedural::rays(&mesh, 4, 200);
    for method in [Method::HashedDisjoint, Method::StackT0, Method::Skip] {
        for ask in [QueryKind::Any, QueryKind::Hit, QueryKind::All] {
            let plan = Plan::new(&plain, method, ask);
            let planned = BinaryTracer::planned(&in_parts, method, &plan).expect("a tracer");
            let own = BinaryTracer::new(&plain);
            assert_eq!(planned.closest_each(&rays), own.closest_each(&rays), "{method}");
            assert_eq!(planned.all_each(&rays), own.all_each(&rays), "{method}");
            assert_eq!(planned.any_each(&rays), own.any_each(&rays), "{method}");
        }
    }
}

#[test]
fn counts_are_those_of_the_visits() {
    for (mesh, rays) in scenes() {
        let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
        for any in [false, true] {
            let count = |method| BinaryTracer::with_method(&bvh, method).expect("a tracer");
            let count = |method| if any { count(method).count_any(&rays) } else { count(method).count_closest(&rays) };
            let [stack, hashed, skip] = [Method::Stack, Method::Hashed, Method::Skip].map(count);
            assert_eq!(stack.rays, rays.len() as u64);
            assert_eq!((stack.inner, stack.leaves, stack.triangles), (hashed.inner, hashed.leaves, hashed.triangles));
            assert_eq!(stack.boxes, 2 * stack.inner);
            assert!(
                stack.sums <= stack.fallbacks && stack.fallbacks <= stack.triangles && stack.leaves <= stack.triangles
            );
            // Only traversals with key and trail count backtracks. Each postponed node is visited, unless the query
            // ends.
            assert_eq!(stack.backtracks.total(), 0);
            assert!(any || 0 < hashed.backtracks.total() && hashed.backtracks.total() < hashed.inner);
            assert!(skip.inner <= skip.boxes && skip.leaves <= skip.triangles);
        }
    }
}

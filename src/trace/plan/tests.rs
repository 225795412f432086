use super::*;
use crate::bvh::SahOptions;
use crate::generate::procedural;
use crate::geom::Mesh;
use crate::geom::Ray;
use crate::geom::kernel::Exact;
use crate::geom::slabs::Directed;
use crate::trace::Tracer;

fn scenes() -> Vec<(Mesh, Vec<Ray>)> {
    let flat = |mesh: Mesh| {
        let first = mesh.triangles()[0];
        let triangles = mesh.triangles().iter().copied().chain([[first[0], first[0], first[1]]; 3]).collect();
        Mesh::new(mesh.vertices().to_vec(), triangles).expect("a mesh")
    };
    let meshes = [procedural::soup(1, 80), procedural::strands(2, 5), flat(procedural::soup(3, 9))];
    meshes.map(|mesh| (procedural::rays(&mesh, 4, 60), mesh)).map(|(rays, mesh)| (mesh, rays)).into()
}

#[test]
fn no_decision_changes_an_answer() {
    for (mesh, rays) in scenes() {
        let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
        for method in Method::ALL.into_iter().filter(|&method| method != Method::Complete) {
            let lean = Plan::new(&bvh, method, Ask::Any);
            let each = Part::ALL.map(|part| lean.clone().with(part));
            let plans = [lean.clone(), lean.with_everything()].into_iter().chain(each);
            let answers = plans.map(|plan| {
                let tracer = Tracer::<Exact, Directed>::planned(&bvh, &plan).expect("a tracer");
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
    let [with, without] = [&mesh, &without].map(|mesh| Bvh::sah(mesh, SahOptions::default()).expect("a tree"));
    assert!(Plan::new(&with, Method::Hashed, Ask::Any).skips(Part::Degenerate));
    assert!(!Plan::new(&without, Method::Hashed, Ask::Any).skips(Part::Degenerate));
    for ray in &rays {
        assert_eq!(Tracer::new(&with).all(ray), Tracer::new(&without).all(ray));
    }
}

#[test]
fn what_is_left_out_saves_memory() {
    let bvh = Bvh::sah(&procedural::soup(5, 500), SahOptions::default()).expect("a tree");
    let lean = Plan::new(&bvh, Method::Hashed, Ask::Any);
    let bytes = |plan: &Plan| Tracer::<Exact, Directed>::planned(&bvh, plan).expect("a tracer").bytes();
    for part in [Part::OtherTables, Part::OwnBoxes] {
        assert!(bytes(&lean) < bytes(&lean.clone().with(part)), "{part:?}");
    }
    assert_eq!((lean.word(), lean.clone().with(Part::LongKeys).word()), (WordName::U32, WordName::U128));
    let by_node = Plan::new(&bvh, Method::Skip, Ask::Hit);
    assert!(!by_node.skips(Part::OwnBoxes) && !by_node.skips(Part::Weights) && by_node.skips(Part::Repeats));
}

#[test]
fn counts_are_those_of_the_visits() {
    for (mesh, rays) in scenes() {
        let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
        for any in [false, true] {
            let count =
                |method| Tracer::<Exact, Directed>::with_method(&bvh, method).expect("a tracer").count(&rays, any);
            let [stack, hashed, skip] = [Method::Stack, Method::Hashed, Method::Skip].map(count);
            assert_eq!(stack.rays, rays.len() as u64);
            assert_eq!((stack.inner, stack.leaves, stack.triangles), (hashed.inner, hashed.leaves, hashed.triangles));
            assert_eq!(stack.boxes, 2 * stack.inner);
            assert!(
                stack.sums <= stack.fallbacks && stack.fallbacks <= stack.triangles && stack.leaves <= stack.triangles
            );
            // Only traversals with key and trail can tell; each postponed node is come back to, unless the query ends.
            assert_eq!(stack.backtracks.total(), 0);
            assert!(any || 0 < hashed.backtracks.total() && hashed.backtracks.total() < hashed.inner);
            assert!(skip.inner <= skip.boxes && skip.leaves <= skip.triangles);
        }
    }
}

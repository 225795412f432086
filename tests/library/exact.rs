//! The exact level: the answers equal rational arithmetic for every tree, order and traversal.

use glam::Vec3;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::generate::{procedural, stress};
use stackless_bvh::geom::{Kernel, Mesh, Ray, Triangle, Vector};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::geom::kernel::{Exact, Exact64};
use stackless_bvh::internals::geom::slabs::{Directed, Slabs64};
use stackless_bvh::internals::trace::{Accuracy, Closest, ClosestByNode, KernelName, SlabsName, Truth};
use stackless_bvh::oracle;
use stackless_bvh::order::{ByNode, LeftOrder, SignOrder};
use stackless_bvh::trace::Hit;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{CaseOptions, Plan, SceneTree, Stress, check_boxes, check_scene};

/// [BOX-2]
#[test]
fn no_touched_box_is_skipped() {
    let tally = check_boxes(1, 0..300_000, &|_| ());
    let [plain, two_sided, directed] = tally.skipped;
    assert!(tally.rays > 200_000 && tally.touched > tally.rays / 4, "{tally:?}");
    assert_eq!(directed, 0, "{tally:?}");
    // The plain form skips touched boxes; the two-sided form only outside its preconditions.
    assert!(plain > 1000 && two_sided < plain, "{tally:?}");
}

/// [EXACT-1] [CONF-2]
#[test]
fn the_stress_suite_finds_no_error_of_the_exact_kernels() {
    let methods = [Method::Stack, Method::Sparse, Method::Hashed, Method::Skip];
    let mut others = 0;
    for case in stress::cases(48) {
        let stress = Stress::new(&case).expect("a case can be built");
        for kernel in [KernelName::Exact, KernelName::ExactFromSingle] {
            let errors = stress.run((kernel, SlabsName::Directed), &methods).expect("a depth that u64 carries");
            assert!(errors.is_none(), "{}: {kernel}: {errors:?}", case.name);
        }
        for level in [Accuracy::Fast, Accuracy::Watertight, Accuracy::Precise] {
            let errors = stress.run(level.tests(), &[Method::Stack]).expect("a depth that u64 carries");
            others += u32::from(!errors.is_none());
        }
        if case.closed {
            assert!(stress.truth().iter().all(Option::is_some), "{}: a closed mesh cannot be left", case.name);
        }
    }
    assert!(others > 300, "the suite is hard for the others: {others}");
}

fn bits(hit: Option<Hit>) -> Option<[u32; 4]> {
    hit.map(|Hit { prim, t, u, v }| [prim, t.to_bits(), u.to_bits(), v.to_bits()])
}

/// Returns all answers of one tree, in three orders.
fn answers(bvh: &Bvh, ray: &Ray) -> [Option<[u32; 4]>; 3] {
    let boxes = bvh.own_boxes();
    let mut nearer_first = Closest::new(bvh, ray);
    oracle::traverse(bvh, &mut nearer_first, &mut ());
    let mut left_first = ByNode { test: ClosestByNode::new(bvh, &boxes, ray), order: LeftOrder };
    oracle::traverse(bvh, &mut left_first, &mut ());
    // The farther child first.
    let order = SignOrder { axes: bvh.axes(), octant: !ray.octant() & 7 };
    let mut farther_first = ByNode { test: ClosestByNode::new(bvh, &boxes, ray), order };
    oracle::traverse(bvh, &mut farther_first, &mut ());
    [nearer_first.hit(), left_first.test.hit(), farther_first.test.hit()].map(bits)
}

/// All builders, leaf sizes and orders agree bit for bit, and with the exact answers. (For traversals and threads:
/// `stackless check`.) `[DET-1]` [CONF-2]
#[test]
fn the_answer_does_not_depend_on_tree_and_order() {
    let sphere = stress::icosphere(3, 1.0, Vec3::splat(1000.0)).expect("a mesh");
    // Every triangle twice, at different indices: ties.
    let soup = procedural::soup(7, 300);
    let doubled = soup.triangles().iter().rev().chain(soup.triangles()).copied().collect();
    let doubled = Mesh::new(soup.vertices().to_vec(), doubled).expect("a mesh");
    for mesh in [sphere, doubled, procedural::strands(2, 12)] {
        let mut trees = Vec::new();
        for leaf in [1, 2, 4, 9] {
            trees.push(Bvh::median(&mesh, leaf).expect("a tree"));
            trees.push(Bvh::sah(&mesh, SahOptions { max_leaf: leaf, depth_limit: 60 }).expect("a tree"));
        }
        let truth = Truth::new(&mesh);
        let mut hits = 0;
        for ray in stress::aimed(&mesh, 5, 400).into_iter().chain(procedural::rays(&mesh, 6, 400)) {
            let expected = bits(truth.closest(&ray).map(|hit| hit.rounded()));
            hits += u32::from(expected.is_some());
            for bvh in &trees {
                assert_eq!(answers(bvh, &ray), [expected; 3], "{ray:?}");
            }
        }
        assert!((100..750).contains(&hits), "{hits} of 800 rays hit");
    }
}

/// A hierarchy cannot be damaged through the public interface, but it can belong to another mesh.
#[test]
fn a_hierarchy_that_does_not_hold_the_mesh() {
    let mesh = procedural::soup(3, 400);
    let rays = procedural::rays(&mesh, 1, 300);
    other_meshes_are_seen::<Exact, Directed, _>(&mesh, &rays, |vertex| vertex * 1.001);

    let far = |v: Vec3| v.as_dvec3() + 6.4e6;
    let vertices = mesh.vertices().iter().map(|&vertex| far(vertex)).collect();
    let moved = Mesh::new(vertices, mesh.triangles().to_vec()).unwrap();
    let ray = |ray: &Ray| Ray::new(far(ray.origin()), ray.direction().as_dvec3()).unwrap();
    let rays: Vec<_> = rays.iter().map(ray).collect();
    other_meshes_are_seen::<Exact64, Slabs64, _>(&moved, &rays, |vertex| vertex + 0.001);
}

fn other_meshes_are_seen<K, B, V>(mesh: &Mesh<V>, rays: &[Ray<V>], away: impl Fn(V) -> V)
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let plan = Plan {
        trees: 0,
        seed: 1,
        options: CaseOptions::default(),
        methods: vec![Method::Stack, Method::Hashed],
        words: vec![WordName::U64],
    };
    let truth = Truth::new(mesh);
    let check = |held: &Mesh<V>| {
        let bvh = Bvh::sah(held, SahOptions::default()).unwrap();
        check_scene::<K, B, V>(&plan, &SceneTree::new(&truth, &bvh), rays, &|_| ())
    };
    let (tally, found) = check(mesh);
    assert_eq!((tally.disagreements(), found.is_none()), (0, true));

    let without = |lost: usize| {
        let kept = mesh.triangles().iter().enumerate().filter(|&(prim, _)| prim != lost).map(|(_, &corners)| corners);
        Mesh::new(mesh.vertices().to_vec(), kept.collect()).unwrap()
    };
    let moved = mesh.vertices().iter().map(|&vertex| away(vertex)).collect();
    let mut turned = mesh.triangles().to_vec();
    turned.rotate_left(1);
    for held in [
        without(0),
        without(7),
        Mesh::new(moved, mesh.triangles().to_vec()).unwrap(),
        Mesh::new(mesh.vertices().to_vec(), turned).unwrap(),
    ] {
        let (tally, found) = check(&held);
        assert!(tally.oracle_faults > 0);
        assert_eq!(tally.disagreements(), tally.oracle_faults);
        let found = found.unwrap();
        assert_eq!(found.method, None);
        assert_ne!(found.expected.hit, found.found.hit);
    }
}

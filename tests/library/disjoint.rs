//! The second trail loses no hit, and what it needs for that.

use glam::Vec3;
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions, SpatialOptions};
use stackless_bvh::event::Trace;
use stackless_bvh::generate::{Cell, Family, Kind, Rng, Search, Source, Tape, procedural};
use stackless_bvh::geom::Mesh;
use stackless_bvh::oracle;
use stackless_bvh::order::{Flow, Pruning};
use stackless_bvh::trace::{Any, Ask, BinaryTracer, Closest, NodeSearch, Part, Plan, Truth};
use stackless_bvh::traverse::{Method, Tables, Unfit};
use stackless_check::Case;
use stackless_check::planted::{self, Planted};

/// In how many of 4,000 cases a search that prunes loses a hit, in which first, and how many visits it saves in all.
pub(crate) fn lost(pruning: &Planted) -> (usize, Option<u64>, usize) {
    let (mut lost, mut saved) = (Vec::new(), 0);
    for seed in 0..4000 {
        let mut rng = Rng::new(seed);
        let kind = if seed % 2 == 0 { Kind::Intervals } else { Kind::Clipped };
        let tree = Family::ALL[(seed / 2) as usize % Family::ALL.len()].tree(&mut rng, 16);
        let case = Case { any: false, ..Case::with_tree(tree, kind, &mut rng) };
        // Few distances, so that many are equal.
        let coarse = |distance: u32| distance >> 15;
        let cells = case.tape.cells().iter().map(|cell| Cell {
            enter: coarse(cell.enter),
            exit: cell.exit.map(coarse),
            hit: cell.hit.map(coarse),
            ..*cell
        });
        let tape = Tape::from_cells(&case.tree, cells.collect()).expect("a tape");
        let case = Case { tape, ..case };
        let search = || Search::new(&case.tree, &case.tape, false);
        let (mut whole, mut all) = (search(), Trace::default());
        oracle::traverse(&case.tree, &mut whole, &mut all);
        let (mut pruned, mut some) = (search(), 0);
        pruning.run(&case, &mut pruned, |_| {
            some += 1;
            Flow::Continue
        });
        if whole.outcome.hit != pruned.outcome.hit {
            lost.push(seed);
        }
        saved += all.nodes().len().saturating_sub(some);
    }
    (lost.len(), lost.first().copied(), saved)
}

fn named(name: &str, bugs: Vec<Planted>) -> Planted {
    bugs.into_iter().find(|bug| bug.name() == name).unwrap_or_else(|| panic!("no bug is named {name}"))
}

/// [ORACLE-3] [DISJOINT-1]
#[test]
fn nothing_is_lost_and_something_is_saved() {
    let (lost, _, saved) = lost(&named("second trail: None", planted::controls()));
    assert_eq!(lost, 0);
    assert!(saved > 1000, "{saved}");
}

/// [ORDER-2] [ORDER-3] [DISJOINT-4]
#[test]
fn what_the_marks_need() {
    for bug in planted::marks().into_iter().chain([named("FoundBeyondEnd", planted::all())]) {
        let (lost, ..) = lost(&bug);
        assert!(lost > 10, "{bug:?}: {lost}");
    }
}

/// Long, thin triangles across each other: their boxes say little, those of their parts more.
fn diagonals() -> Mesh {
    let mut rng = Rng::new(8);
    let mut point = || Vec3::from([0; 3].map(|_| rng.below(1000) as f32));
    let vertices: Vec<_> = (0..150)
        .flat_map(|_| {
            let from = point();
            [from, point(), from + Vec3::ONE * 5.0]
        })
        .collect();
    let count = vertices.len() as u32 / 3;
    Mesh::new(vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh")
}

fn in_parts(mesh: &Mesh) -> Bvh {
    let spatial = SpatialOptions { extra_percent: 300, overlap: 0.0 };
    let options = BuildOptions { builder: Builder::Spatial, spatial, ..BuildOptions::default() };
    let bvh = options.build(mesh).expect("a tree");
    assert!(bvh.duplicates() > 20, "{}", bvh.duplicates());
    bvh
}

/// [DISJOINT-5]
#[test]
fn searches_without_order_are_refused() {
    let mesh = diagonals();
    let rays = procedural::rays(&mesh, 1, 20);
    let (bvh, split) = (Bvh::sah(&mesh, SahOptions::default()).expect("a tree"), in_parts(&mesh));
    for method in Method::ALL.into_iter().filter(|method| method.test().pruning() != Pruning::Never) {
        let run = |bvh: &Bvh, any| {
            let tables = Tables::new(bvh, bvh.axes(), &[method], 0);
            let mut memory = Vec::new();
            let ray = &rays[0];
            if any {
                let mut search = NodeSearch::over(Any::new(bvh, ray), &[]);
                tables.run::<u64, _>(method, 0, &mut memory, &mut search, &mut ())
            } else {
                let mut search = NodeSearch::over(Closest::new(bvh, ray), &[]);
                tables.run::<u64, _>(method, 0, &mut memory, &mut search, &mut ())
            }
        };
        assert_eq!(run(&bvh, false), Ok(()), "{method}");
        // The order is not that along the ray.
        assert_eq!(run(&bvh, true), Err(Unfit::Unordered), "{method}");
        // Hits may lie outside the leaves' boxes, and the boxes are not there. Distances need none.
        let expected = if method == Method::StackT0 { Ok(()) } else { Err(Unfit::Unordered) };
        assert_eq!(run(&split, false), expected, "{method}");
    }
}

/// [DISJOINT-4] [SPLIT-1]
#[test]
fn rays_through_triangles_in_parts() {
    let mesh = diagonals();
    let truth = Truth::new(&mesh);
    let rays = procedural::rays(&mesh, 5, 3000);
    let bvh = in_parts(&mesh);
    for method in [Method::HashedDisjoint, Method::UncleDisjoint, Method::StackT0] {
        let plan = Plan::new(&bvh, method, Ask::Hit);
        assert_eq!(plan.skips(Part::OwnBoxes), method == Method::StackT0);
        let tracer = BinaryTracer::planned(&bvh, &plan).expect("a tracer");
        for ray in &rays {
            assert_eq!(tracer.closest(ray), truth.closest(ray).map(|hit| hit.rounded()), "{method} {ray:?}");
        }
        let without = BinaryTracer::with_method(&bvh, method.without_pruning()).expect("a tracer");
        let [pruned, whole] = [&tracer, &without].map(|tracer| {
            let counters = tracer.count_closest(&rays);
            counters.inner + counters.leaves
        });
        assert!(pruned < whole, "{method}: {pruned} of {whole}");
    }
}

//! The second trail loses no hit, if its requirements are met.

use glam::Vec3;
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions, SpatialOptions};
use stackless_bvh::event::{Recorder, Trace};
use stackless_bvh::generate::{Cell, Family, Kind, Rng, Search, Source, Tape, procedural};
use stackless_bvh::geom::Mesh;
use stackless_bvh::internals::trace::{Any, Closest, NodeSearch, Truth};
use stackless_bvh::oracle;
use stackless_bvh::order::{Descent, Flow, NodeTest, Pruned, Pruning, Visitor};
use stackless_bvh::trace::{BinaryTracer, Part, Plan, QueryKind, RayQueries};
use stackless_bvh::traverse::{Method, Tables, Unsupported};
use stackless_bvh::tree::{Node, Topology, Tree};
use stackless_check::Case;

/// The marks of a search for a pruning traversal.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Marks {
    /// The required marks.
    Right,
    /// Intervals that touch are marked as disjoint.
    Touching,
    /// The far child comes first, but children are marked as if the near one did.
    FarFirst,
    /// *Found* is reported for every best hit, even beyond its leaf's end.
    BeyondEnd,
}

/// A search with such marks.
struct Marked<'a, 't> {
    case: &'a Case,
    search: &'a mut Search<'t, Tree>,
    marks: Marks,
}

impl Visitor for Marked<'_, '_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        Visitor::leaf(self.search, node)
    }
}

impl NodeTest for Marked<'_, '_> {
    fn accept(&mut self, node: Node) -> bool {
        self.search.accept(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        NodeTest::leaf(self.search, node)
    }
}

impl Pruned for Marked<'_, '_> {
    fn allows(&self, pruning: Pruning) -> bool {
        self.search.allows(pruning)
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        let descent = self.search.inner_marked(node);
        let Case { tree, tape, .. } = self.case;
        let [near, far] = [descent.first(), descent.first().other()].map(|side| tree.child(node, side));
        let starts = tape.cells()[tree.slot(far)].enter;
        match (self.marks, tape.cells()[tree.slot(near)].exit) {
            (Marks::Touching, exit) => descent.disjoint_if(exit.is_some_and(|exit| exit <= starts)),
            (Marks::FarFirst, exit) if descent.postpones() => {
                Descent::both(descent.first().other()).disjoint_if(exit.is_some_and(|exit| exit < starts))
            }
            _ => descent,
        }
    }

    fn found_at(&self, leaf: Node) -> bool {
        match self.marks {
            Marks::BeyondEnd => self.search.outcome.hit.is_some_and(|(_, slot)| slot == self.case.tree.slot(leaf)),
            _ => self.search.found_at(leaf),
        }
    }
}

/// Runs a traversal with a second trail over a case.
///
/// # Errors
/// [`Unsupported`], if the tree is too deep.
pub(crate) fn traverse(
    case: &Case,
    search: &mut Search<'_, Tree>,
    marks: Marks,
    recorder: &mut impl Recorder,
) -> Result<(), Unsupported> {
    let method = Method::HashedDisjoint;
    let tables = Tables::new(&case.tree, case.tape.axes(), &[method], 0);
    tables.run::<u64, _>(method, 0, &mut Vec::new(), &mut Marked { case, search, marks }, recorder)
}

/// Returns the number of cases, out of 4,000, that lose a hit, and the total number of saved visits.
fn lost(marks: Marks) -> (usize, usize) {
    let (mut lost, mut saved) = (0, 0);
    for seed in 0..4000 {
        let mut rng = Rng::new(seed);
        let kind = if seed % 2 == 0 { Kind::Intervals } else { Kind::Clipped };
        let tree = Family::ALL[(seed / 2) as usize % Family::ALL.len()].tree(&mut rng, 16);
        let case = Case { any: false, ..Case::with_tree(tree, kind, &mut rng) };
        // Few distinct distances, so ties are frequent.
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
        let (mut pruned, mut some) = (search(), Trace::default());
        traverse(&case, &mut pruned, marks, &mut some).expect("a shallow tree");
        lost += usize::from(whole.outcome.hit != pruned.outcome.hit);
        saved += all.nodes().len().saturating_sub(some.nodes().len());
    }
    (lost, saved)
}

/// [ORACLE-3] [DISJOINT-1]
#[test]
fn nothing_is_lost_and_something_is_saved() {
    let (lost, saved) = lost(Marks::Right);
    assert_eq!(lost, 0);
    assert!(saved > 1000, "{saved}");
}

/// [ORDER-2] [ORDER-3] [DISJOINT-4]
#[test]
fn what_the_marks_need() {
    for marks in [Marks::Touching, Marks::FarFirst, Marks::BeyondEnd] {
        let (lost, _) = lost(marks);
        assert!(lost > 10, "{marks:?}: {lost}");
    }
}

/// Returns long, thin triangles across each other. Bounds of their parts are much tighter than their own.
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
        // The order is not the order along the ray.
        assert_eq!(run(&bvh, true), Err(Unsupported::Unordered), "{method}");
        // Hits may be outside the leaves' boxes. Pruning by distance does not need the boxes.
        let expected = if method == Method::StackT0 { Ok(()) } else { Err(Unsupported::Unordered) };
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
        let plan = Plan::new(&bvh, method, QueryKind::Hit);
        assert_eq!(plan.skips(Part::OwnBoxes), method == Method::StackT0);
        let tracer = BinaryTracer::planned(&bvh, method, &plan).expect("a tracer");
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

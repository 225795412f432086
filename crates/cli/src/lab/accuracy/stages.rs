//! The stages of the exact test.

use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::{Kernel, Ray};
use stackless_bvh::internals::geom::kernel::{Exact, Stage};
use stackless_bvh::internals::trace::Closest;
use stackless_bvh::order::{Descent, Flow, Visitor};
use stackless_bvh::traverse::{Stack, traverse};
use stackless_bvh::tree::Node;

/// Number of triangle tests of closest-hit queries, and of rays, that needed each stage.
pub(super) struct Stages {
    pub(super) scene: String,
    pub(super) set: &'static str,
    pub(super) tests: Reached,
    pub(super) rays: Reached,
}

/// The total number, and the numbers that reached each stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Reached {
    pub(super) all: u64,
    pub(super) triangle: u64,
    pub(super) sums: u64,
}

impl Stages {
    pub(super) fn count(scene: &str, set: &'static str, tree: &Bvh, rays: &[Ray]) -> Self {
        let count = |memory: &mut Vec<Node>, ray: &Ray| {
            let kernel = Exact::new(ray, tree.region());
            let mut search = Staged { search: Closest::new(tree, ray), tree, kernel, reached: Reached::default() };
            traverse(Stack::new(tree, memory), &mut search, &mut ());
            let Reached { triangle, sums, .. } = search.reached;
            [search.reached, Reached { all: 1, triangle: triangle.min(1), sums: sums.min(1) }]
        };
        let both = rays.par_iter().with_min_len(256).map_init(Vec::new, count);
        let [tests, rays] = both.reduce(Default::default, |[a, b], [c, d]| [a.plus(c), b.plus(d)]);
        Self { scene: scene.to_owned(), set, tests, rays }
    }
}

impl Reached {
    fn plus(self, other: Self) -> Self {
        Self { all: self.all + other.all, triangle: self.triangle + other.triangle, sums: self.sums + other.sums }
    }

    fn add(&mut self, stage: Stage) {
        self.all += 1;
        self.triangle += u64::from(stage >= Stage::Triangle);
        self.sums += u64::from(stage >= Stage::Sums);
    }
}

/// A query that counts the stages of its triangle tests.
struct Staged<'a> {
    search: Closest<'a>,
    tree: &'a Bvh,
    kernel: Exact,
    reached: Reached,
}

impl Visitor for Staged<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        for held in self.tree.leaf_triangles(node) {
            self.reached.add(self.kernel.stage(&held.shape));
        }
        self.search.leaf(node)
    }
}

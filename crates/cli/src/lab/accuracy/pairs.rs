//! The pairs of tests, each with its searches.

use glam::Vec3;
use stackless_bvh::bvh::{BuildError, Bvh, SahOptions};
use stackless_bvh::geom::{Aabb, Kernel, Mesh, Ray};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::trace::{
    Accuracy, KernelBvhs, KernelName, KernelShape, NodeSearch, Search, SlabsName, WithTests, with_tests,
};
use stackless_bvh::order::{ByNode, LeftOrder};
use stackless_bvh::traverse::{Stack, traverse};
use stackless_bvh::tree::Node;

use crate::judge::{Answer, Query};

/// A triangle test with a box test.
pub(super) struct Pair {
    pub(super) kernel: KernelName,
    pub(super) slabs: SlabsName,
    closest: Searches,
    any: Searches,
}

/// The searches of a query with the tests of a pair.
struct Searches {
    trace: fn(&Trees, &[Ray], &mut Vec<Node>) -> u64,
    answer: fn(&Trees, &Ray, &mut Vec<Node>) -> Answer,
    answers: fn(&Trees, &Ray, &mut Vec<Node>) -> [Answer; 3],
}

/// The baseline of the times.
pub(super) const BASELINE: (KernelName, SlabsName) = (KernelName::Moller32, SlabsName::Plain);

impl Pair {
    /// All pairs.
    pub(super) fn all() -> Vec<Self> {
        let pairs = KernelName::ALL.into_iter().flat_map(|kernel| SlabsName::ALL.map(|slabs| (kernel, slabs)));
        pairs.map(|tests| with_tests(tests, MakePair(tests))).collect()
    }

    fn searches(&self, query: Query) -> &Searches {
        match query {
            Query::Closest => &self.closest,
            Query::Any => &self.any,
        }
    }

    /// Traces rays over the tree by surface area, and returns a checksum of their hits.
    pub(super) fn trace(&self, query: Query, trees: &Trees, rays: &[Ray], memory: &mut Vec<Node>) -> u64 {
        (self.searches(query).trace)(trees, rays, memory)
    }

    /// The answer over the tree by surface area, nearer child first.
    pub(super) fn answer(&self, query: Query, trees: &Trees, ray: &Ray, memory: &mut Vec<Node>) -> Answer {
        (self.searches(query).answer)(trees, ray, memory)
    }

    /// [`answer`](Self::answer), then the answer with the left child first, then the answer over the tree by medians.
    pub(super) fn answers(&self, query: Query, trees: &Trees, ray: &Ray, memory: &mut Vec<Node>) -> [Answer; 3] {
        (self.searches(query).answers)(trees, ray, memory)
    }

    /// Whether this pair is the baseline of the ratios.
    pub(super) fn is_baseline(&self) -> bool {
        (self.kernel, self.slabs) == BASELINE
    }

    /// Whether every answer must be true.
    pub(super) fn is_exact(&self) -> bool {
        Self::promises((self.kernel, self.slabs))
    }

    /// Whether every answer with these tests must be true.
    pub(super) fn promises((kernel, slabs): (KernelName, SlabsName)) -> bool {
        matches!(kernel, KernelName::Exact | KernelName::ExactFromSingle) && slabs == SlabsName::Directed
    }

    /// The level of accuracy of this pair.
    pub(super) fn level(&self) -> Option<Accuracy> {
        Accuracy::ALL.into_iter().find(|level| level.tests() == (self.kernel, self.slabs))
    }
}

struct MakePair((KernelName, SlabsName));

impl WithTests for MakePair {
    type Output = Pair;

    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>>(self) -> Pair {
        let (kernel, slabs) = self.0;
        Pair { kernel, slabs, closest: Searches::new::<K, B, false>(), any: Searches::new::<K, B, true>() }
    }
}

impl Searches {
    fn new<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>, const ANY: bool>() -> Self {
        Self { trace: trace::<K, B, ANY>, answer: answer::<K, B, ANY>, answers: answers::<K, B, ANY> }
    }
}

/// The trees over a mesh, in the formats of all kernels.
pub(super) struct Trees {
    area: KernelBvhs,
    median: KernelBvhs,
    /// Own boxes of the tree by surface area.
    boxes: Vec<Aabb>,
}

impl Trees {
    pub(super) fn new(mesh: &Mesh) -> Result<Self, BuildError> {
        let (area, median) = (Bvh::sah(mesh, SahOptions::default())?, Bvh::median(mesh, 4)?);
        let boxes = area.own_boxes();
        Ok(Self { area: KernelBvhs::new(area), median: KernelBvhs::new(median), boxes })
    }

    /// The tree by surface area.
    pub(super) fn by_area(&self) -> &Bvh {
        self.area.corners()
    }
}

#[inline(never)]
fn trace<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>, const ANY: bool>(
    trees: &Trees,
    rays: &[Ray],
    memory: &mut Vec<Node>,
) -> u64 {
    let tree = trees.area.of::<K::Shape>();
    let mut sum = 0_u64;
    for ray in rays {
        let mut search = Search::<K, B, ANY>::new(tree, ray);
        traverse(Stack::new(tree, memory), &mut search, &mut ());
        if let Some((prim, t)) = search.found() {
            sum = sum.wrapping_add(u64::from(t.to_bits()) << 32 | u64::from(prim));
        }
    }
    sum
}

fn answer<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>, const ANY: bool>(
    trees: &Trees,
    ray: &Ray,
    memory: &mut Vec<Node>,
) -> Answer {
    nearer_first::<K, B, ANY>(&trees.area, ray, memory)
}

fn answers<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>, const ANY: bool>(
    trees: &Trees,
    ray: &Ray,
    memory: &mut Vec<Node>,
) -> [Answer; 3] {
    let tree = trees.area.of::<K::Shape>();
    let test = NodeSearch::<K, B, ANY>::new(tree, &trees.boxes, ray);
    let mut left_first = ByNode { test, order: LeftOrder };
    traverse(Stack::new(tree, memory), &mut left_first, &mut ());
    [
        nearer_first::<K, B, ANY>(&trees.area, ray, memory),
        left_first.test.found(),
        nearer_first::<K, B, ANY>(&trees.median, ray, memory),
    ]
}

fn nearer_first<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>, const ANY: bool>(
    forms: &KernelBvhs,
    ray: &Ray,
    memory: &mut Vec<Node>,
) -> Answer {
    let tree = forms.of::<K::Shape>();
    let mut search = Search::<K, B, ANY>::new(tree, ray);
    traverse(Stack::new(tree, memory), &mut search, &mut ());
    search.found()
}

//! Costs of rays, by traversal.

use stackless_bvh::bvh::{Bvh, BvhTree};
use stackless_bvh::geom::{Aabb, Ray};
use stackless_bvh::internals::event::Source;
use stackless_bvh::internals::trace::{AnyByNode, ClosestByNode, Query};
use stackless_bvh::internals::traverse::{Need, WithWord, with_word};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::Pruned;
use stackless_bvh::trace::BinaryTracer;
use stackless_bvh::traverse::{Method, Tables, Unsupported};
use stackless_bvh::tree::Implicit;
use stackless_check::{Reads, Steps, Watched};

/// The counted operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Heat {
    /// Visited nodes.
    Nodes,
    /// Box tests.
    Boxes,
    /// Triangle tests.
    Triangles,
    /// Visited postponed nodes.
    Postponed,
    /// Reads of records to find postponed nodes, at least one each: the cost of climbing.
    Backtrack,
    /// Lookups in the perfect hash.
    Hash,
    /// Triangle tests that the error bounds for the whole scene leave undecided.
    Fallback,
}

impl Heat {
    pub(super) const fn unit(self) -> &'static str {
        match self {
            Self::Nodes => "nodes",
            Self::Boxes => "box tests",
            Self::Triangles => "triangle tests",
            Self::Postponed => "postponed nodes",
            Self::Backtrack => "backtracking steps",
            Self::Hash => "lookups",
            Self::Fallback => "fallbacks",
        }
    }
}

/// Counts the cost of rays.
pub(super) struct Costs<'a> {
    heat: Heat,
    any: bool,
    tracer: BinaryTracer<&'a Bvh>,
    /// For costs that the tracer's own counters do not include.
    steps: Option<Box<Walks<'a>>>,
}

/// The data of traversals whose reads are counted.
struct Walks<'a> {
    bvh: &'a Bvh,
    tables: Tables<'a, BvhTree>,
    boxes: Vec<Aabb>,
}

impl<'a> Costs<'a> {
    pub(super) fn new(bvh: &'a Bvh, method: Method, heat: Heat, any: bool) -> Result<Self, Unsupported> {
        let needs_steps = match heat {
            Heat::Nodes | Heat::Boxes | Heat::Triangles | Heat::Fallback => false,
            Heat::Postponed | Heat::Backtrack => true,
            // Each of its backtracks is a lookup.
            Heat::Hash => method.needs() == Need::AllKeys,
        };
        let steps = needs_steps.then(|| Box::new(Walks::new(bvh, method)));
        Ok(Self { heat, any, tracer: BinaryTracer::with_method(bvh, method)?, steps })
    }

    /// The cost of a ray.
    pub(super) fn of(&self, ray: &Ray) -> u64 {
        if let Some(walks) = &self.steps {
            let [backtracks, steps] = walks.count(&self.tracer, ray, self.any);
            return if self.heat == Heat::Backtrack { steps } else { backtracks };
        }
        let ray = std::slice::from_ref(ray);
        let counters = if self.any { self.tracer.count_any(ray) } else { self.tracer.count_closest(ray) };
        match self.heat {
            Heat::Nodes => counters.inner + counters.leaves,
            Heat::Boxes => counters.boxes,
            Heat::Triangles => counters.triangles,
            Heat::Fallback => counters.fallbacks,
            Heat::Postponed | Heat::Backtrack | Heat::Hash => counters.backtracks.by(Source::Hash),
        }
    }
}

impl<'a> Walks<'a> {
    fn new(bvh: &'a Bvh, method: Method) -> Self {
        Self { bvh, tables: Tables::new(bvh.tree(), bvh.axes(), &[method], Implicit::LIMIT), boxes: bvh.own_boxes() }
    }

    /// Number of backtracks and of their steps.
    fn count(&self, tracer: &BinaryTracer<&Bvh>, ray: &Ray, any: bool) -> [u64; 2] {
        let (bvh, boxes) = (self.bvh, &*self.boxes);
        let query: &mut dyn Query =
            if any { &mut AnyByNode::new(bvh, boxes, ray) } else { &mut ClosestByNode::new(bvh, boxes, ray) };
        // A query that does not allow pruning runs without pruning, as in the tracer.
        let method = tracer.method();
        let method = if query.allows(method.test().pruning()) { method } else { method.without_pruning() };
        let reads = Reads::default();
        let mut steps = Steps::new(bvh.tree(), &reads);
        let run = Run { tables: &self.tables, method, octant: ray.octant(), query, reads: &reads, steps: &mut steps };
        let ran = with_word(tracer.word(), run);
        debug_assert_eq!(ran, Ok(()), "checked when the tracer was made");
        [steps.backtracks(), steps.steps()]
    }
}

struct Run<'r, 'a, 'q> {
    tables: &'r Tables<'a, BvhTree>,
    method: Method,
    octant: u8,
    query: &'q mut dyn Query,
    reads: &'r Reads,
    steps: &'r mut Steps<'q, BvhTree>,
}

impl WithWord for Run<'_, '_, '_> {
    type Output = Result<(), Unsupported>;

    fn call<W: KeyWord>(self) -> Result<(), Unsupported> {
        let Self { tables, method, octant, mut query, reads, steps } = self;
        let linked = tables.tree();
        let watched = Watched { tree: &linked, watch: |node| reads.count(node) };
        tables.run_over::<W, _, _>(&watched, method, octant, &mut Vec::new(), &mut query, steps)
    }
}

//! The benefits of a small state: fewer visits after a hit, from hit to hit, and along paths.

use rayon::prelude::*;
use serde::Serialize;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::Rng;
use stackless_bvh::geom::{Kernel, Mesh, Ray};
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::internals::geom::slabs::Directed;
use stackless_bvh::internals::trace::{Any, Counters, reflect};
use stackless_bvh::order::{Descent, Flow, Visitor};
use stackless_bvh::trace::{BinaryTracer, Continuation, Place, Plan, QueryKind};
use stackless_bvh::traverse::{Method, Stack, Unsupported, traverse};
use stackless_bvh::tree::Node;

use crate::output::{Table, table};

/// The mean cost of a ray.
#[derive(Serialize)]
pub(super) struct Row {
    query: &'static str,
    way: &'static str,
    /// Visited nodes.
    nodes: f64,
    boxes: f64,
    triangles: f64,
}

/// A ray from the hit of a previous ray, with the place of that hit.
type Step = (Ray, Place);

/// Counts for primary rays, and for rays from their hits.
pub(super) fn measure(mesh: &Mesh, bvh: &Bvh, primary: &[Ray], seed: u64) -> Result<Vec<Row>, Unsupported> {
    let tracer = |method| BinaryTracer::planned(bvh, method, &Plan::new(bvh, method, QueryKind::Distance));
    let tracers = [
        ("nothing is pruned", tracer(Method::Hashed)?),
        ("disjoint intervals", tracer(Method::HashedDisjoint)?),
        ("stored distances", tracer(Method::StackT0)?),
    ];
    let continuation = Continuation::new(&tracers[0].1)?;
    let steps: Vec<Step> = primary
        .par_iter()
        .enumerate()
        .filter_map(|(i, ray)| step(mesh, &continuation, ray, seed.wrapping_add(i as u64)))
        .collect();
    let diffuse: Vec<_> = steps.iter().map(|&(ray, _)| ray).collect();

    let mut rows = Vec::new();
    for (query, rays) in [("closest, primary", primary), ("closest, diffuse", &diffuse)] {
        for (way, tracer) in &tracers {
            rows.push(Row::of(query, way, &tracer.count_closest(rays)));
        }
    }
    for (query, any) in [("closest, diffuse", false), ("any, diffuse", true)] {
        for (way, goes_on) in [("from the root", false), ("from the last hit", true)] {
            let count = |(ray, place): &Step| {
                let from = goes_on.then_some(*place);
                if any { continuation.count_any(ray, from) } else { continuation.count_closest(ray, from) }
            };
            let sum = steps.par_iter().map(count).reduce(Counters::default, |a, b| a.merge(&b));
            rows.push(Row::of(query, way, &sum));
        }
    }
    rows.extend(one_by_one(bvh, primary));
    Ok(rows)
}

/// A diffuse ray from the hit of `ray`.
fn step(mesh: &Mesh, continuation: &Continuation<'_, &Bvh, Exact, Directed>, ray: &Ray, seed: u64) -> Option<Step> {
    let (hit, place) = continuation.closest(ray, None)?;
    Some((reflect(mesh, ray, &hit, &mut Rng::new(seed))?, place))
}

/// Finds all hits of each ray one by one, either from the root each time, or resuming the search.
fn one_by_one(bvh: &Bvh, rays: &[Ray]) -> [Row; 2] {
    let count = |ray: &Ray| {
        let mut search = OneByOne::new(bvh, ray);
        traverse(Stack::new(bvh, &mut Vec::new()), &mut search, &mut ());
        // The last search finds no further hit.
        let again = search.again.merge(&search.so_far);
        [search.so_far, again]
    };
    let sums = rays.par_iter().map(count).reduce(Default::default, |[a, b], [c, d]| [a.merge(&c), b.merge(&d)]);
    let [resumed, again] = sums.map(|sum| Counters { rays: rays.len() as u64, ..sum });
    let query = "hits one by one, primary";
    [Row::of(query, "from the root again", &again), Row::of(query, "resumed", &resumed)]
}

struct OneByOne<'a> {
    bvh: &'a Bvh,
    search: Any<'a>,
    kernel: Exact,
    end: f32,
    so_far: Counters,
    /// The cost of searches from the root for each hit.
    again: Counters,
}

impl<'a> OneByOne<'a> {
    fn new(bvh: &'a Bvh, ray: &Ray) -> Self {
        let (search, kernel) = (Any::new(bvh, ray), Exact::new(ray, bvh.region()));
        Self { bvh, search, kernel, end: ray.tmax(), so_far: Counters::default(), again: Counters::default() }
    }
}

impl Visitor for OneByOne<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.so_far.inner += 1;
        self.so_far.boxes += 2;
        self.search.inner(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.so_far.leaves += 1;
        for held in self.bvh.leaf_triangles(node) {
            self.so_far.triangles += 1;
            if self.kernel.distance(&held.shape, self.end).is_some() {
                self.again = std::mem::take(&mut self.again).merge(&self.so_far);
            }
        }
        Flow::Continue
    }
}

impl Row {
    fn of(query: &'static str, way: &'static str, counters: &Counters) -> Self {
        let a_ray = |count: u64| count as f64 / counters.rays.max(1) as f64;
        Self {
            query,
            way,
            nodes: a_ray(counters.inner + counters.leaves),
            boxes: a_ray(counters.boxes),
            triangles: a_ray(counters.triangles),
        }
    }
}

pub(super) fn to_table(rows: &[Row]) -> Table {
    let cells = |row: &Row| {
        let numbers = [row.nodes, row.boxes, row.triangles].map(|number| format!("{number:.2}"));
        [row.query, row.way].map(str::to_owned).into_iter().chain(numbers).collect()
    };
    let header = ["per ray", "method", "nodes", "box tests", "triangle tests"];
    table(&header, 2, rows.iter().map(cells).collect())
}

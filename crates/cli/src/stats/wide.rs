//! The hierarchy of eight children, used by `trace` and `render`.

use std::borrow::Cow;
use std::error::Error;

use serde::Serialize;
use stackless_bvh::bvh::{Builder, WideBvh};
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::geom::lanes::Block;
use stackless_bvh::internals::trace::WideCounters;
use stackless_bvh::trace::{Choice, Need, Part, Plan, QueryKind, Tracer};
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Method, Topology};

use super::timed;
use crate::build;
use crate::input::Scene;
use crate::output::{Table, grouped, table};
use crate::savings::{self, Answers, Setup};

/// Number of rays with which a plan is measured.
const PLAN_RAYS: usize = 4096;

#[derive(Serialize)]
pub(super) struct WideStats {
    /// The builder.
    build: String,
    nodes: usize,
    /// Mean number of children of inner nodes.
    children: f64,
    /// Mean number of triangles in leaves.
    leaf_triangles: f64,
    /// Level of the deepest inner node.
    levels: u32,
    bytes: usize,
    bytes_per_triangle: f64,
    /// On all threads.
    build_seconds: f64,
    traversals: Vec<Row>,
    choice: ChoiceStats,
    /// The plan of the default tracer.
    plan: Vec<savings::Row>,
}

/// The default tracer, and alternatives.
#[derive(Serialize)]
struct ChoiceStats {
    tracer: &'static str,
    method: &'static str,
    reasons: Vec<&'static str>,
    /// Need, tracer and reason.
    otherwise: Vec<[&'static str; 3]>,
}

#[derive(Serialize)]
struct Row {
    method: &'static str,
    state_bytes: usize,
    /// Bytes of the tables that the traversal needs.
    table_bytes: usize,
    table_seconds: f64,
    /// Visited inner nodes, for the closest hit of a camera ray.
    nodes_per_ray: f64,
    leaves_per_ray: f64,
    triangles_per_ray: f64,
}

/// Measures the closest hits of `rays`.
pub(super) fn measure(scene: &Scene, rays: &[Ray]) -> Result<WideStats, Box<dyn Error>> {
    let choice = Choice::for_needs(&[]);
    let build = Builder::default();
    let (wide, build_seconds) = timed(|| build::wide(build, scene));
    let wide = wide?;
    let mut traversals = Vec::new();
    for method in Method::ALL {
        let (tracer, table_seconds) = timed(|| Tracer::with_method(&wide, method));
        let tracer = tracer?;
        let WideCounters { nodes, leaves, triangles, .. } = tracer.count_closest(rays);
        let per_ray = |count: u64| count as f64 / rays.len().max(1) as f64;
        traversals.push(Row {
            method: method.name(),
            state_bytes: method.state_bytes::<8>(wide.levels() as usize),
            table_bytes: tracer.bytes(),
            table_seconds,
            nodes_per_ray: per_ray(nodes),
            leaves_per_ray: per_ray(leaves),
            triangles_per_ray: per_ray(triangles),
        });
    }
    let nodes = wide.nodes();
    let children: u32 = (0..nodes.len()).map(|node| wide.children(Node::inner(node as u32)).count_ones()).sum();
    let leaves: u32 = nodes.iter().map(|node| node.leaves().count_ones()).sum();
    let references =
        wide.blocks().iter().flat_map(|block| block.prims).filter(|&prim| prim != Block::NONE).count() as f64;
    let plan = plan(&wide, build, scene, rays)?;
    Ok(WideStats {
        build: build.to_string(),
        nodes: nodes.len(),
        children: f64::from(children) / nodes.len() as f64,
        leaf_triangles: references / f64::from(leaves.max(1)),
        levels: wide.levels(),
        bytes: wide.bytes(),
        bytes_per_triangle: wide.bytes() as f64 / scene.mesh.triangles().len() as f64,
        build_seconds,
        traversals,
        plan,
        choice: ChoiceStats {
            tracer: choice.tracer(),
            method: choice.method(),
            reasons: choice.reasons(),
            otherwise: Need::ALL.map(|need| [need.name(), Choice::for_needs(&[need]).tracer(), need.reason()]).into(),
        },
    })
}

/// Measures the decisions of the default tracer, with each omitted part restored. Fails if answers differ.
fn plan(wide: &WideBvh, build: Builder, scene: &Scene, rays: &[Ray]) -> Result<Vec<savings::Row>, Box<dyn Error>> {
    let rays = &rays[..rays.len().min(PLAN_RAYS)];
    let mut rows = Vec::new();
    for ask in [QueryKind::Any, QueryKind::Distance, QueryKind::All] {
        let setup = |plan: &Plan| {
            let bvh = match [Part::Degenerate, Part::ExactTests, Part::Entries].map(|part| plan.restores(part)) {
                [true, ..] => Cow::Owned(plan.on(plan.options(build::options(build)).build_wide(&scene.mesh)?)),
                [false, false, false] => Cow::Borrowed(wide),
                [false, ..] => Cow::Owned(plan.on(wide.clone())),
            };
            let bytes = bvh.bytes();
            let tracer: Tracer<Cow<'_, WideBvh>> = Tracer::new(bvh).planned(plan);
            let bytes = bytes + tracer.bytes();
            let answers = move |rays: &[Ray]| {
                Answers::of(&tracer, ask, rays, |rays, found| tracer.closest_distances(rays, found))
            };
            Ok(Setup { bytes, answers: Box::new(answers) })
        };
        rows.extend(savings::measure(ask, rays, &Tracer::new(wide).plan(ask), setup)?);
    }
    Ok(rows)
}

impl WideStats {
    pub(super) fn line(&self) -> String {
        format!(
            "eight children: {} inner nodes of {:.1}, leaves of {:.1} triangles, {} levels, {} bytes ({:.1} a triangle); {} in {:.1} ms",
            grouped(self.nodes as u64),
            self.children,
            self.leaf_triangles,
            self.levels + 1,
            grouped(self.bytes as u64),
            self.bytes_per_triangle,
            self.build,
            self.build_seconds * 1e3
        )
    }

    /// The default tracer, with the reasons.
    pub(super) fn choice(&self) -> String {
        let ChoiceStats { tracer, method, reasons, .. } = &self.choice;
        format!("default: {tracer} by {method} over {}. {}", self.build, reasons.join(" "))
    }

    /// The parts that the default tracer omits.
    pub(super) fn omitted(&self) -> String {
        format!("omitted, with the time that it saves for a ray: {}", savings::to_line(&self.plan))
    }

    /// The decisions of the default tracer.
    pub(super) fn plan(&self) -> Table {
        savings::to_table(&self.plan)
    }

    /// The cases in which another tracer is better.
    pub(super) fn otherwise(&self) -> Table {
        let rows = self.choice.otherwise.iter().map(|row| row.map(str::to_owned).into()).collect();
        table(&["need", "tracer", "reason"], 3, rows)
    }

    pub(super) fn to_table(&self) -> Table {
        let row = |row: &Row| {
            let mut cells = vec![row.method.to_owned()];
            cells.extend([row.state_bytes, row.table_bytes].map(|bytes| grouped(bytes as u64)));
            cells.push(format!("{:.2}", row.table_seconds * 1e3));
            cells.extend([row.nodes_per_ray, row.leaves_per_ray, row.triangles_per_ray].map(|n| format!("{n:.2}")));
            cells
        };
        let header = [
            "of eight children",
            "bytes of state",
            "of tables",
            "ms",
            "nodes a ray",
            "leaves a ray",
            "triangles a ray",
        ];
        table(&header, 1, self.traversals.iter().map(row).collect())
    }
}

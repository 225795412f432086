//! The parts that a scene does not need, and the savings of omitting them.

use std::hint::black_box;

use serde::Serialize;
use stackless_bvh::bvh::{BuildOptions, Bvh};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::bounce;
use stackless_bvh::trace::{BinaryTracer, Part, PartialHit, Plan, QueryKind};
use stackless_bvh::traverse::{Method, Unsupported};

use crate::output::{Table, grouped, table};
use crate::turns::{median_ratio, take_turns};

/// A decision of the plan for a kind of query.
#[derive(Serialize)]
pub(super) struct Row {
    query: &'static str,
    part: &'static str,
    skipped: bool,
    reason: String,
    /// Bytes of the part.
    saved_bytes: Option<usize>,
    /// For an omitted part: the time including the part, relative to the time without it.
    time_ratio: Option<f64>,
}

const CHUNK: usize = 2048;
const ROUNDS: usize = 5;

/// Measures the decisions for any-hit and closest-hit queries by `hashed`, one by one and together. Fails if answers
/// differ.
pub(super) fn measure(mesh: &Mesh, bvh: &Bvh, rays: &[Ray]) -> Result<Vec<Row>, Box<dyn std::error::Error>> {
    let bounced = bounce(mesh, bvh, rays, 1);
    let mut rows = Vec::new();
    for (query, ask, rays) in [("any hit", QueryKind::Any, &*bounced), ("closest hit", QueryKind::Distance, rays)] {
        let lean = Plan::new(bvh, Method::Hashed, ask);
        // These queries never check for repeats, so that part has no cost.
        let is_measured = |part: &Part| lean.skips(*part) && *part != Part::Repeats;
        let parts: Vec<_> = Part::ALL.into_iter().filter(is_measured).collect();
        let plans = parts.iter().map(|&part| lean.clone().with(part));
        let plans: Vec<_> = [lean.clone()].into_iter().chain(plans).chain([lean.clone().with_everything()]).collect();
        let with_degenerate = lean.clone().with(Part::Degenerate).options(BuildOptions::default()).build(mesh)?;
        let setups = plans.iter().map(|plan| {
            let whole = !plan.skips(Part::Degenerate) && lean.skips(Part::Degenerate);
            Setup::new(plan, if whole { &with_degenerate } else { bvh })
        });
        let setups: Vec<_> = setups.collect::<Result<_, _>>()?;
        if let Some(i) = (1..setups.len()).find(|&i| setups[i].answers(rays) != setups[0].answers(rays)) {
            let what = parts.get(i - 1).map_or("everything", |part| part.name());
            return Err(format!("{query}: answers with {what} differ from answers without {what}").into());
        }
        let times = take_turns(setups.len(), rays.len(), CHUNK, ROUNDS, query, |i, chunk| {
            black_box(setups[i].answers(&rays[chunk]));
        });
        let saved = |i: usize| {
            let ratio = median_ratio(&times.by_round(i), &times.by_round(0));
            (Some(setups[i].bytes.saturating_sub(setups[0].bytes)), Some(ratio))
        };
        for decision in lean.decisions() {
            let at = parts.iter().position(|&part| part == decision.part);
            let (saved_bytes, time_ratio) = at.map_or((None, None), |i| saved(i + 1));
            let (part, skipped, reason) = (decision.part.name(), decision.skipped, decision.reason.clone());
            rows.push(Row { query, part, skipped, reason, saved_bytes, time_ratio });
        }
        let (saved_bytes, time_ratio) = saved(setups.len() - 1);
        let reason = format!("{} bytes are needed in addition to the tree", grouped(setups[0].tracer.bytes() as u64));
        rows.push(Row { query, part: "everything above", skipped: true, reason, saved_bytes, time_ratio });
    }
    Ok(rows)
}

pub(super) fn to_table(rows: &[Row]) -> Table {
    let cells = |row: &Row| {
        let saved = row.saved_bytes.map_or_else(|| "-".to_owned(), |bytes| grouped(bytes as u64));
        let ratio = row.time_ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{ratio:.3}"));
        let choice = if row.skipped { "omitted" } else { "needed" };
        let names = [row.query, row.part, choice, &row.reason].map(str::to_owned);
        names.into_iter().chain([saved, ratio]).collect()
    };
    let header = ["query", "part", "plan", "reason", "bytes saved", "time with it"];
    table(&header, 4, rows.iter().map(cells).collect())
}

/// A tracer by a plan.
struct Setup<'a> {
    tracer: BinaryTracer<&'a Bvh>,
    /// Whether the query returns the triangle.
    names_triangle: bool,
    /// Bytes of hierarchy and tables.
    bytes: usize,
}

impl<'a> Setup<'a> {
    fn new(plan: &Plan, bvh: &'a Bvh) -> Result<Self, Unsupported> {
        let tracer = BinaryTracer::planned(bvh, plan)?;
        let bytes = bvh.bytes() + tracer.bytes();
        Ok(Self { tracer, names_triangle: plan.ask() != QueryKind::Any, bytes })
    }

    /// The requested part of each answer.
    fn answers(&self, rays: &[Ray]) -> Vec<Option<(u32, f32)>> {
        let asked =
            |asked: PartialHit| if self.names_triangle { (asked.prim, asked.t.unwrap_or_default()) } else { (0, 0.0) };
        self.tracer.partial_hits_each(rays).into_iter().map(|found| black_box(found).map(asked)).collect()
    }
}

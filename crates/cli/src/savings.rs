//! The parts that a scene does not need, and the savings of omitting them.

use std::error::Error;
use std::hint::black_box;

use serde::Serialize;
use stackless_bvh::geom::Ray;
use stackless_bvh::trace::{Hit, Part, Plan, QueryKind, RayQueries};

use crate::output::{Table, grouped, table};
use crate::turns::{median, median_ratio, take_turns};

/// A decision of a plan for a kind of query.
#[derive(Serialize)]
pub(crate) struct Row {
    query: &'static str,
    part: &'static str,
    skipped: bool,
    reason: String,
    /// Bytes of the part.
    saved_bytes: Option<usize>,
    /// For an omitted part: the time including the part, relative to the time without it.
    time_ratio: Option<f64>,
    /// The difference of these times, for a ray.
    saved_nanoseconds: Option<f64>,
}

/// Triangle and distance of a hit.
type Found = Option<(u32, f32)>;

/// Answers rays.
type Run<'a> = dyn Fn(&[Ray]) -> Answers + 'a;

/// A tracer by a plan.
pub(crate) struct Setup<'a> {
    /// Bytes of hierarchy and tables.
    pub(crate) bytes: usize,
    pub(crate) answers: Box<Run<'a>>,
}

/// The requested part of each answer.
#[derive(PartialEq)]
pub(crate) enum Answers {
    Any(Vec<bool>),
    Distances(Vec<Found>),
    All(Vec<Vec<Hit>>),
}

impl Answers {
    pub(crate) fn of<T: RayQueries<Ray, Hit = Hit>>(
        tracer: &T,
        ask: QueryKind,
        rays: &[Ray],
        distances: impl FnOnce(&[Ray], &mut [Found]),
    ) -> Self {
        match ask {
            QueryKind::Any => Self::Any(tracer.any_each(rays)),
            QueryKind::All => Self::All(tracer.all_each(rays)),
            QueryKind::Distance | QueryKind::Hit => {
                let mut found = vec![None; rays.len()];
                distances(rays, &mut found);
                Self::Distances(found)
            }
        }
    }
}

/// The row of all omitted parts.
const EVERYTHING: &str = "everything above";

const CHUNK: usize = 2048;
const ROUNDS: usize = 5;

/// Measures the decisions for a kind of query, one by one and together. Fails if answers differ.
pub(crate) fn measure<'a>(
    ask: QueryKind,
    rays: &[Ray],
    lean: &Plan,
    setup: impl Fn(&Plan) -> Result<Setup<'a>, Box<dyn Error>>,
) -> Result<Vec<Row>, Box<dyn Error>> {
    let query = match ask {
        QueryKind::Any => "any hit",
        QueryKind::Distance | QueryKind::Hit => "closest hit",
        QueryKind::All => "all hits",
    };
    // Queries for one hit never check for repeats, so that part has no cost.
    let is_measured = |part: &Part| lean.skips(*part) && (*part != Part::Repeats || ask == QueryKind::All);
    let parts: Vec<_> = Part::ALL.into_iter().filter(is_measured).collect();
    let plans = parts.iter().map(|&part| lean.clone().with(part));
    let plans = [lean.clone()].into_iter().chain(plans).chain([lean.clone().with_everything()]);
    let setups: Vec<_> = plans.map(|plan| setup(&plan)).collect::<Result<_, _>>()?;
    let answers = (setups[0].answers)(rays);
    if let Some(i) = (1..setups.len()).find(|&i| (setups[i].answers)(rays) != answers) {
        let what = parts.get(i - 1).map_or("everything", |part| part.name());
        return Err(format!("{query}: answers with {what} differ from answers without {what}").into());
    }
    let times = take_turns(setups.len(), rays.len(), CHUNK, ROUNDS, query, |i, chunk| {
        black_box((setups[i].answers)(&rays[chunk]));
    });
    let row = |part, skipped, reason, at: Option<usize>| {
        let saved = at.map(|i| {
            let [with, without] = [times.by_round(i), times.by_round(0)];
            let difference = median(with.iter().zip(&without).map(|(with, without)| with - without).collect());
            (median_ratio(&with, &without), difference * 1e9 / rays.len().max(1) as f64)
        });
        // Without rays there is no time.
        let saved = saved.filter(|(ratio, _)| ratio.is_finite());
        let saved_bytes = at.map(|i| setups[i].bytes.saturating_sub(setups[0].bytes));
        let (time_ratio, saved_nanoseconds) = saved.unzip();
        Row { query, part, skipped, reason, saved_bytes, time_ratio, saved_nanoseconds }
    };
    let decided = lean.decisions().iter().map(|decision| {
        let at = parts.iter().position(|&part| part == decision.part).map(|i| i + 1);
        row(decision.part.name(), decision.skipped, decision.reason.clone(), at)
    });
    let reason = format!("{} bytes are needed", grouped(setups[0].bytes as u64));
    let everything = row(EVERYTHING, true, reason, Some(setups.len() - 1));
    Ok(decided.chain([everything]).collect())
}

pub(crate) fn to_table(rows: &[Row]) -> Table {
    let cells = |row: &Row| {
        let number = |number: Option<f64>, digits| number.map_or("-".to_owned(), |x| format!("{x:.digits$}"));
        let saved = row.saved_bytes.map_or_else(|| "-".to_owned(), |bytes| grouped(bytes as u64));
        let choice = if row.skipped { "omitted" } else { "needed" };
        let names = [row.query, row.part, choice, &row.reason].map(str::to_owned);
        names.into_iter().chain([saved, number(row.saved_nanoseconds, 1), number(row.time_ratio, 3)]).collect()
    };
    let header = ["query", "part", "plan", "reason", "bytes saved", "ns a ray saved", "time with it"];
    table(&header, 4, rows.iter().map(cells).collect())
}

/// The omitted parts of each kind of query, with the time of a ray that each saves.
pub(crate) fn to_line(rows: &[Row]) -> String {
    let of_query = |rows: &[Row]| {
        let omitted = rows.iter().filter(|row| row.skipped && row.part != EVERYTHING);
        let saved = omitted.filter_map(|row| Some(format!("{} {:.1} ns", row.part, row.saved_nanoseconds?)));
        format!("{}: {}", rows[0].query, saved.collect::<Vec<_>>().join(", "))
    };
    rows.chunk_by(|row, next| row.query == next.query).map(of_query).collect::<Vec<_>>().join("; ")
}

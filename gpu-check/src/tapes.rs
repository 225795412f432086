//! Decision tapes: every kernel, without floats, event by event, against the oracle.

mod batch;
mod events;

pub use batch::{Batch, Case, cases};
pub use events::{Difference, Expected, RECORDED};

use crate::kernel::{Kernel, Record, Shape, TAPE_SEARCH};
use crate::launch::{Buffers, compile, params};
use crate::{Checks, Gpu, GpuError};

/// What became of one kernel.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Name of the kernel.
    pub name: String,
    /// Searches that were compared.
    pub compared: usize,
    /// Searches over trees that are too deep for its words, which it is not given.
    pub too_deep: usize,
    /// Searches with another trace or another outcome.
    pub mismatches: usize,
    /// The first of them.
    pub first: Option<Difference>,
}

/// Changes the text of a kernel before it is compiled: how bugs are planted.
pub type Edit<'a> = &'a dyn Fn(String) -> String;

/// Leaves it as it is.
pub fn unchanged(text: String) -> String {
    text
}

/// Runs a kernel over all searches of a batch that it can carry, and compares.
///
/// # Errors
/// [`GpuError`].
pub fn compare(gpu: &Gpu, batch: &Batch, kernel: &Kernel, edit: Edit<'_>) -> Result<Report, GpuError> {
    let limit = kernel.depth_limit().unwrap_or(u32::MAX);
    let searches: Vec<usize> = (0..batch.searches()).filter(|&i| batch.depth(i) <= limit).collect();
    let mut report = Report {
        name: kernel.full_name(),
        compared: searches.len(),
        too_deep: batch.searches() - searches.len(),
        ..Report::default()
    };
    let results = run(gpu, batch, kernel, &searches, Record::Hash, edit)?.0;
    for (&search, result) in searches.iter().zip(results.chunks_exact(8)) {
        let expected = batch.expected(search, kernel);
        if expected.agrees(result, kernel) {
            continue;
        }
        report.mismatches += 1;
        if report.first.is_none() {
            let (result, events) = run(gpu, batch, kernel, &[search], Record::Events, edit)?;
            report.first = Some(expected.difference(batch, search, &result, &events));
        }
    }
    Ok(report)
}

/// The results of these searches, 8 words each, and the recorded events.
fn run(
    gpu: &Gpu,
    batch: &Batch,
    kernel: &Kernel,
    searches: &[usize],
    record: Record,
    edit: Edit<'_>,
) -> Result<(Vec<u32>, Vec<u32>), GpuError> {
    let depth = searches.iter().map(|&i| batch.depth(i)).max().unwrap_or(0);
    let shape = Shape { depth, subgroups: gpu.has_subgroups() };
    let source = edit(kernel.source(shape, TAPE_SEARCH, record));
    let pipeline = compile(gpu, kernel, depth, &source, Checks::All)?;
    let tasks = gpu.buffer("searches", &batch.task_words(kernel, searches))?;
    let count = searches.len() as u32;
    let results = gpu.buffer("results", &vec![u32::MAX; 8 * searches.len()])?;
    let event_words = if record == Record::Events { 1 + RECORDED * batch.most_visits(searches) } else { 4 };
    let work = gpu.zeros("work", event_words)?;
    let params = params(gpu, count)?;
    let [nodes, leaves] = batch.records(kernel.links());
    let [displacements, cells] = batch.tables(kernel.table());
    let buffers =
        Buffers { nodes, leaves, displacements, cells, tasks: &tasks, results: &results, params: &params, work: &work };
    gpu.run(&[buffers.pass(kernel, &pipeline, count)])?;
    Ok((gpu.read(&results, 8 * searches.len())?, gpu.read(&work, event_words)?))
}

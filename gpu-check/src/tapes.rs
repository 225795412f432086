//! Decision tapes: compares every kernel with the oracle event by event, without floats.

mod batch;
mod events;
pub mod wide;

pub use batch::{Batch, Case, cases};
pub use events::{Difference, Expected, RECORDED};

use stackless_bvh::tree::Node;

use crate::kernel::{Kernel, Record, Shape};
use crate::launch::{Buffers, compile, params};
use crate::{Checks, Gpu, GpuError};

/// Searches on the device, and their expected events.
pub trait Searches {
    /// Number of searches.
    fn searches(&self) -> usize;

    /// Depth of the tree of a search; for a wide tree, levels.
    fn depth(&self, search: usize) -> u32;

    /// The description of a search, sufficient to generate it again.
    fn describe(&self, search: usize) -> String;

    /// The node at an address of a kernel.
    fn node_at(&self, search: usize, address: u32) -> Option<Node>;

    /// Number of nodes of the tree of a search, the maximum number of visits.
    fn nodes(&self, search: usize) -> usize;

    /// The expected events and outcome of a search.
    fn expected(&self, search: usize, kernel: &Kernel) -> Expected;

    /// Nodes, leaves, displacements and cells, in the format of a kernel.
    fn buffers(&self, kernel: &Kernel) -> [&wgpu::Buffer; 4];

    /// The parameters of each search, 16 words.
    fn task_words(&self, kernel: &Kernel, searches: &[usize]) -> Vec<u32>;
}

/// The results of one kernel.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Name of the kernel.
    pub name: String,
    /// Number of compared searches.
    pub compared: usize,
    /// Number of omitted searches, over trees that are too deep for its words.
    pub too_deep: usize,
    /// Visits of the searches without a mismatch.
    pub visits: usize,
    /// Number of searches with a wrong trace or outcome.
    pub mismatches: usize,
    /// The first mismatch.
    pub first: Option<Difference>,
}

/// Edits the text of a kernel before it is compiled, to plant bugs.
pub type Edit<'a> = &'a dyn Fn(String) -> String;

/// Returns the text unchanged.
pub fn unchanged(text: String) -> String {
    text
}

/// Runs a kernel over all supported searches of a batch, and compares the results.
///
/// # Errors
/// [`GpuError`].
pub fn compare(gpu: &Gpu, batch: &impl Searches, kernel: &Kernel, edit: Edit<'_>) -> Result<Report, GpuError> {
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
            report.visits += result[3] as usize;
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
    batch: &impl Searches,
    kernel: &Kernel,
    searches: &[usize],
    record: Record,
    edit: Edit<'_>,
) -> Result<(Vec<u32>, Vec<u32>), GpuError> {
    let depth = searches.iter().map(|&i| batch.depth(i)).max().unwrap_or(0);
    let shape = Shape { depth, subgroups: gpu.has_subgroups() };
    let source = edit(kernel.source(shape, kernel.tape_search(), record));
    let pipeline = compile(gpu, kernel, depth, &source, Checks::All)?;
    let tasks = gpu.buffer("searches", &batch.task_words(kernel, searches))?;
    let count = searches.len() as u32;
    let results = gpu.buffer("results", &vec![u32::MAX; 8 * searches.len()])?;
    // Some additional visits show traversals that visit too many nodes.
    let most_visits = searches.iter().map(|&i| batch.nodes(i)).max().unwrap_or(0) + 16;
    let event_words = if record == Record::Events { 1 + RECORDED * most_visits } else { 4 };
    let work = gpu.zeros("work", event_words)?;
    let params = params(gpu, count)?;
    let [nodes, leaves, displacements, cells] = batch.buffers(kernel);
    let buffers =
        Buffers { nodes, leaves, displacements, cells, tasks: &tasks, results: &results, params: &params, work: &work };
    gpu.run(&[buffers.pass(kernel, &pipeline, count)])?;
    Ok((gpu.read(&results, 8 * searches.len())?, gpu.read(&work, event_words)?))
}

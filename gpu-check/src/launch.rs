//! One launch of a traversal kernel: its eight buffers and its work groups.

use wgpu::Buffer;

use crate::kernel::{Driver, Kernel, WORKGROUP};
use crate::{Access, Checks, Gpu, GpuError, Pass, Pipeline};

/// Bindings of traversal kernels: nodes, leaves, displacements, cells, tasks, results, parameters, work.
pub const BINDINGS: [Access; 8] = [
    Access::Read,
    Access::Read,
    Access::Read,
    Access::Read,
    Access::Read,
    Access::Write,
    Access::Uniform,
    Access::Write,
];

/// Compiles a kernel for trees of this depth.
///
/// # Errors
/// [`GpuError::Limit`] if a work group has too little memory for its stacks, and the errors of [`Gpu::compile`].
pub fn compile(gpu: &Gpu, kernel: &Kernel, depth: u32, source: &str, checks: Checks) -> Result<Pipeline, GpuError> {
    let (needed, limit) = (kernel.workgroup_bytes(depth), gpu.workgroup_bytes());
    if needed > limit {
        let what = format!("{}: bytes of a work group", kernel.full_name());
        return Err(GpuError::Limit { what, needed: needed.into(), limit: limit.into() });
    }
    gpu.compile(&kernel.full_name(), source, &BINDINGS, checks)
}

/// Maximum number of work groups of persistent kernels.
const PERSISTENT_GROUPS: u32 = 1024;

/// The buffers of a launch, in the order of the bindings.
#[derive(Debug)]
pub struct Buffers<'a> {
    /// Inner nodes.
    pub nodes: &'a Buffer,
    /// Leaves.
    pub leaves: &'a Buffer,
    /// Displacement tables.
    pub displacements: &'a Buffer,
    /// Hash tables.
    pub cells: &'a Buffer,
    /// Cases or rays.
    pub tasks: &'a Buffer,
    /// The results.
    pub results: &'a Buffer,
    /// Parameters from [`params`].
    pub params: &'a Buffer,
    /// The queue of persistent kernels, counters, or recorded events.
    pub work: &'a Buffer,
}

impl<'a> Buffers<'a> {
    /// The pass of a kernel over this number of tasks.
    pub fn pass(&self, kernel: &Kernel, pipeline: &'a Pipeline, tasks: u32) -> Pass<'a> {
        let [x, y] = groups(tasks);
        let groups = if kernel.driver == Driver::Persistent { [(x * y).min(PERSISTENT_GROUPS), 1] } else { [x, y] };
        let buffers = vec![
            self.nodes,
            self.leaves,
            self.displacements,
            self.cells,
            self.tasks,
            self.results,
            self.params,
            self.work,
        ];
        Pass { pipeline, buffers, groups, clear: Vec::new() }
    }
}

/// Work groups for this number of invocations, in rows, because the number along one axis is limited.
pub fn groups(invocations: u32) -> [u32; 2] {
    const ROW: u32 = 1 << 15;
    let groups = invocations.div_ceil(WORKGROUP).max(1);
    [groups.min(ROW), groups.div_ceil(ROW)]
}

/// Maximum number of steps of a recorded traversal: more than any terminating traversal needs in trees of 200 nodes and
/// depth 95.
const MOST_STEPS: u32 = 1 << 15;

/// The parameters of a launch: number of tasks, invocations in a row, and maximum number of steps.
///
/// # Errors
/// The errors of [`Gpu::uniform`].
pub fn params(gpu: &Gpu, tasks: u32) -> Result<Buffer, GpuError> {
    gpu.uniform(&[tasks, groups(tasks)[0] * WORKGROUP, MOST_STEPS, 0])
}

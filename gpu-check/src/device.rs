//! The device: selection, submission, waiting, and errors.

mod open;

use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use crate::GpuError;

/// The time limit of one submission. Longer submissions are treated as hanging.
pub const PATIENCE: Duration = Duration::from_mins(2);

/// A device with its queue.
#[derive(Debug)]
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    lost: Arc<OnceLock<String>>,
    uncaptured: Arc<Mutex<Vec<String>>>,
    patience: Duration,
}

/// How a kernel uses a binding, by its number in the one bind group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// A storage buffer that is only read.
    Read,
    /// A storage buffer that is read and written.
    Write,
    /// A uniform buffer.
    Uniform,
}

/// A compiled kernel, with the layout of its bind group.
#[derive(Debug)]
pub struct Pipeline {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

/// A kernel with its buffers and the number of its work groups.
#[derive(Debug)]
pub struct Pass<'a> {
    /// The kernel.
    pub pipeline: &'a Pipeline,
    /// Its buffers, in the order of the bindings.
    pub buffers: Vec<&'a wgpu::Buffer>,
    /// Work groups along x and y.
    pub groups: [u32; 2],
    /// Buffers that are cleared before.
    pub clear: Vec<&'a wgpu::Buffer>,
}

/// The run-time checks of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Checks {
    /// All checks of wgpu.
    All,
    /// No checks, for measurements: arrays in private memory would pay for checks that buffers do not need.
    None,
}

impl Gpu {
    /// Returns the device's name, backend and driver, in one line.
    pub fn name(&self) -> String {
        open::name(&self.info)
    }

    /// Returns whether the device is emulated on the CPU.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Sets the time limit of waiting for the device.
    #[must_use]
    pub fn with_patience(mut self, patience: Duration) -> Self {
        self.patience = patience;
        self
    }

    /// Returns whether lanes can vote.
    pub fn has_subgroups(&self) -> bool {
        self.device.features().contains(wgpu::Features::SUBGROUP)
    }

    /// Returns the memory of a work group in bytes.
    pub fn workgroup_bytes(&self) -> u32 {
        self.device.limits().max_compute_workgroup_storage_size
    }

    /// Loses the device, as a driver may do spontaneously. Every later call fails.
    pub fn lose(&self) {
        self.device.destroy();
    }

    /// Creates a storage buffer with these words.
    ///
    /// # Errors
    /// [`GpuError::Limit`] before anything is allocated, [`GpuError::Refused`] without memory.
    pub fn buffer(&self, what: &str, words: &[u32]) -> Result<wgpu::Buffer, GpuError> {
        let buffer = self.zeros(what, words.len())?;
        self.write(&buffer, words)?;
        Ok(buffer)
    }

    /// Creates a storage buffer of zero words.
    ///
    /// # Errors
    /// The errors of [`buffer`](Self::buffer).
    pub fn zeros(&self, what: &str, words: usize) -> Result<wgpu::Buffer, GpuError> {
        self.check_size(what, words)?;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        self.raw(what, words, usage)
    }

    /// Creates a uniform buffer of a multiple of four words.
    ///
    /// # Errors
    /// The errors of [`buffer`](Self::buffer).
    pub fn uniform(&self, words: &[u32]) -> Result<wgpu::Buffer, GpuError> {
        let buffer = self.raw("params", words.len(), wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST)?;
        self.write(&buffer, words)?;
        Ok(buffer)
    }

    /// Writes words to the start of a buffer.
    ///
    /// # Errors
    /// [`GpuError::Refused`] if they do not fit.
    pub fn write(&self, buffer: &wgpu::Buffer, words: &[u32]) -> Result<(), GpuError> {
        self.guarded("write", || self.queue.write_buffer(buffer, 0, bytemuck::cast_slice(words)))
    }

    /// Compiles a kernel: the entry point `main`, with bindings 0, 1 and so on as listed.
    ///
    /// # Errors
    /// [`GpuError::Limit`] for too many storage buffers, [`GpuError::Refused`] for source that is no kernel.
    pub fn compile(&self, what: &str, source: &str, bindings: &[Access], checks: Checks) -> Result<Pipeline, GpuError> {
        let storage = bindings.iter().filter(|&&access| access != Access::Uniform).count() as u64;
        let limit = u64::from(self.device.limits().max_storage_buffers_per_shader_stage);
        if storage > limit {
            return Err(GpuError::Limit { what: format!("{what}: storage buffers"), needed: storage, limit });
        }
        self.guarded(what, || {
            let module = self.module(what, source, checks);
            let entries: Vec<_> =
                bindings.iter().zip(0..).map(|(&access, binding)| layout_entry(binding, access)).collect();
            let layout = self
                .device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(what), entries: &entries });
            let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(what),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(what),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some("main"),
                // Each lane writes its part of the work group's memory before reading it.
                compilation_options: wgpu::PipelineCompilationOptions {
                    zero_initialize_workgroup_memory: false,
                    ..Default::default()
                },
                cache: None,
            });
            Pipeline { pipeline, layout }
        })
    }

    #[allow(unsafe_code, reason = "wgpu has no safe way to measure a kernel without its run-time checks")]
    fn module(&self, what: &str, source: &str, checks: Checks) -> wgpu::ShaderModule {
        let descriptor =
            wgpu::ShaderModuleDescriptor { label: Some(what), source: wgpu::ShaderSource::Wgsl(source.into()) };
        match checks {
            Checks::All => self.device.create_shader_module(descriptor),
            // SAFETY: kernels index buffers by addresses of a validated tree and arrays by less than its depth, and end
            // because the trail does. The same source has been run with checks, with the same results.
            Checks::None => unsafe {
                self.device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked())
            },
        }
    }

    /// Runs passes one after another, and waits until they are done.
    ///
    /// # Errors
    /// [`GpuError::Refused`], [`GpuError::Lost`], [`GpuError::Timeout`].
    pub fn run(&self, passes: &[Pass<'_>]) -> Result<(), GpuError> {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.guarded("passes", || {
            for pass in passes {
                self.encode(&mut encoder, pass, None);
            }
        })?;
        self.submit(encoder)
    }

    /// Measures the nanoseconds of each pass on the device.
    ///
    /// # Errors
    /// The errors of [`run`](Self::run), and [`GpuError::Feature`] if the device has no clock.
    pub fn time(&self, passes: &[Pass<'_>]) -> Result<Vec<f64>, GpuError> {
        if !self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Err(GpuError::Feature("timestamp queries"));
        }
        let count = 2 * passes.len() as u32;
        let queries = self.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("times"),
            ty: wgpu::QueryType::Timestamp,
            count,
        });
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let ticks = self.raw("ticks", 2 * count as usize, usage)?;
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.guarded("timed passes", || {
            for (pass, at) in passes.iter().zip(0..) {
                self.encode(&mut encoder, pass, Some((&queries, 2 * at)));
            }
            encoder.resolve_query_set(&queries, 0..count, &ticks, 0);
        })?;
        self.submit(encoder)?;
        let words = self.read(&ticks, 2 * count as usize)?;
        let ticks: Vec<u64> = words.chunks(2).map(|w| u64::from(w[0]) | u64::from(w[1]) << 32).collect();
        let period = f64::from(self.queue.get_timestamp_period());
        Ok(ticks.chunks(2).map(|t| t[1].wrapping_sub(t[0]) as f64 * period).collect())
    }

    /// Reads the first words of a buffer.
    ///
    /// # Errors
    /// The errors of [`run`](Self::run).
    pub fn read(&self, buffer: &wgpu::Buffer, words: usize) -> Result<Vec<u32>, GpuError> {
        self.run_and_read(&[], [(buffer, words)]).map(|[read]| read)
    }

    /// Runs passes and reads the first words of buffers, in one submission.
    ///
    /// # Errors
    /// The errors of [`run`](Self::run).
    pub fn run_and_read<const N: usize>(
        &self,
        passes: &[Pass<'_>],
        wanted: [(&wgpu::Buffer, usize); N],
    ) -> Result<[Vec<u32>; N], GpuError> {
        let words = wanted.iter().map(|&(_, words)| words).sum();
        let copy = self.raw("copy", words, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)?;
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.guarded("passes", || {
            for pass in passes {
                self.encode(&mut encoder, pass, None);
            }
            let mut at = 0;
            for (buffer, words) in wanted {
                let bytes = 4 * words as u64;
                encoder.copy_buffer_to_buffer(buffer, 0, &copy, at, bytes);
                at += bytes;
            }
        })?;
        self.submit(encoder)?;
        let answer = Arc::new(OnceLock::new());
        let told = answer.clone();
        copy.slice(..).map_async(wgpu::MapMode::Read, move |result| {
            let _ = told.set(result);
        });
        self.wait()?;
        match answer.get() {
            Some(Ok(())) => {}
            Some(Err(error)) => return Err(self.refused("read", error.to_string())),
            None => return Err(self.refused("read", "no answer".to_owned())),
        }
        let view = copy.slice(..).get_mapped_range().map_err(|error| self.refused("read", error.to_string()))?;
        let mut rest: Vec<u32> = bytemuck::pod_collect_to_vec(&view);
        Ok(wanted.map(|(_, words)| rest.drain(..words.min(rest.len())).collect()))
    }

    fn raw(&self, what: &str, words: usize, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, GpuError> {
        let size = 4 * words.max(4) as u64;
        let descriptor = wgpu::BufferDescriptor { label: Some(what), size, usage, mapped_at_creation: false };
        self.guarded(what, || self.device.create_buffer(&descriptor))
    }

    fn check_size(&self, what: &str, words: usize) -> Result<(), GpuError> {
        let (needed, limits) = (4 * words as u64, self.device.limits());
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if needed > limit { Err(GpuError::Limit { what: format!("{what}: bytes"), needed, limit }) } else { Ok(()) }
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass<'_>, times: Option<(&wgpu::QuerySet, u32)>) {
        let entries: Vec<_> = pass
            .buffers
            .iter()
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bind_group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pass.pipeline.layout,
            entries: &entries,
        });
        let timestamp_writes = times.map(|(query_set, first)| wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        });
        for buffer in &pass.clear {
            encoder.clear_buffer(buffer, 0, None);
        }
        let descriptor = wgpu::ComputePassDescriptor { label: None, timestamp_writes };
        let mut compute = encoder.begin_compute_pass(&descriptor);
        compute.set_pipeline(&pass.pipeline.pipeline);
        compute.set_bind_group(0, &bind_group, &[]);
        compute.dispatch_workgroups(pass.groups[0], pass.groups[1], 1);
    }

    fn submit(&self, encoder: wgpu::CommandEncoder) -> Result<(), GpuError> {
        self.guarded("submission", || self.queue.submit([encoder.finish()]))?;
        self.wait()
    }

    fn wait(&self) -> Result<(), GpuError> {
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(self.patience) };
        match self.device.poll(wait) {
            Ok(_) => self.check_health(),
            Err(wgpu::PollError::Timeout) => Err(GpuError::Timeout(self.patience)),
            Err(error) => Err(self.refused("wait", error.to_string())),
        }
    }

    /// Runs calls of wgpu, and returns the first error that they cause.
    fn guarded<T>(&self, what: &str, calls: impl FnOnce() -> T) -> Result<T, GpuError> {
        let filters = [wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let result = calls();
        let errors = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop()));
        let first = errors.collect::<Vec<_>>().into_iter().next();
        match first {
            Some(error) => Err(self.refused(what, error.to_string())),
            None => self.check_health().map(|()| result),
        }
    }

    /// Returns an error; for a lost device, that it is lost.
    fn refused(&self, what: &str, message: String) -> GpuError {
        // The callback that reports it runs while polling.
        let _ = self.device.poll(wgpu::PollType::Poll);
        match self.lost.get() {
            Some(reason) => GpuError::Lost(reason.clone()),
            None => GpuError::Refused { what: what.to_owned(), message },
        }
    }

    fn check_health(&self) -> Result<(), GpuError> {
        if let Some(reason) = self.lost.get() {
            return Err(GpuError::Lost(reason.clone()));
        }
        let first = self.uncaptured.lock().ok().and_then(|errors| errors.first().cloned());
        first.map_or(Ok(()), |message| Err(self.refused("device", message)))
    }
}

fn layout_entry(binding: u32, access: Access) -> wgpu::BindGroupLayoutEntry {
    let ty = match access {
        Access::Read => wgpu::BufferBindingType::Storage { read_only: true },
        Access::Write => wgpu::BufferBindingType::Storage { read_only: false },
        Access::Uniform => wgpu::BufferBindingType::Uniform,
    };
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None }
}

//! Measurement: kernels run interleaved, each in its own pass with timestamps, and ratios are from one run.

use std::fmt;

use rayon::prelude::*;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::reflect_each;
use stackless_bvh::trace::{BinaryTracer, RayQueries};

use crate::kernel::{Kernel, SLOTS, Traversal, Wide};
use crate::launch::{self, Buffers, params};
use crate::model::{Found, Visited, through};
use crate::probe::Arithmetic;
use crate::scene::{Eight, Placed, Query, Scene, hierarchy, rays_words};
use crate::statistics::{deviation, median, ratio};
use crate::{Checks, Gpu, GpuError, made};

/// The size of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Rays of a set.
    pub rays: usize,
    /// Views of the camera.
    pub views: u64,
    /// Warm-up passes per kernel, which are not counted.
    pub warm_up: usize,
    /// Measured passes per kernel.
    pub passes: usize,
    /// Run-time checks of the kernels.
    pub checks: Checks,
}

/// A set of rays and the kind of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rays {
    /// From the camera: the closest hit.
    Primary,
    /// From the hits of the camera's rays: the closest hit.
    Diffuse,
    /// From the hits of the camera's rays: any hit.
    DiffuseAny,
}

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// The scene.
    pub scene: String,
    /// The rays.
    pub rays: Rays,
    /// The view.
    pub view: u64,
    /// The kernel.
    pub kernel: String,
    /// Number of rays.
    pub count: usize,
    /// Median nanoseconds of a pass.
    pub nanoseconds: f64,
    /// Median absolute deviation.
    pub deviation: f64,
    /// Speed relative to the best stack kernel of the cell: median of paired ratios, and its interval.
    pub to_best: [f64; 3],
    /// Speed relative to the best of while-while, speculative and persistent: median of paired ratios, and its
    /// interval.
    pub to_paper: [f64; 3],
    /// Speed relative to the best stack kernel with an equal number of children.
    pub to_own: f64,
    /// Whether this repeats the first kernel. Its difference is noise.
    pub is_noise: bool,
}

impl Rays {
    /// All sets, as in Table 2 of Binder & Keller 2016.
    pub const ALL: [Self; 3] = [Self::Primary, Self::DiffuseAny, Self::Diffuse];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Diffuse => "diffuse",
            Self::DiffuseAny => "diffuse-any",
        }
    }

    const fn is_any(self) -> bool {
        matches!(self, Self::DiffuseAny)
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, rays, view, kernel, count, nanoseconds, deviation, .. } = self;
        let speed = *count as f64 * 1e3 / nanoseconds;
        let name = if self.is_noise { format!("{kernel} again") } else { kernel.clone() };
        let ([best, low, high], to_own) = (self.to_best, self.to_own);
        write!(f, "{scene},{},{view},{name},{count},{nanoseconds:.0},{deviation:.0},{speed:.3},", rays.name())?;
        write!(f, "{best:.4},{low:.4},{high:.4},{:.4},{to_own:.4}", self.to_paper[0])
    }
}

/// The columns of [`Row`].
pub const HEADER: &str = "scene,rays,view,kernel,count,median ns,deviation ns,Mrays/s,\
                          to best stack,low 95 %,high 95 %,to paper's stack,to stack of as many children";

/// The memory traffic of a ray, from counts of an equal search on the CPU.
#[derive(Clone, Copy, Debug)]
pub struct Traffic {
    /// Children per node: 2 or 8.
    pub children: usize,
    /// Inner nodes visited.
    pub nodes: f64,
    /// Triangles tested.
    pub triangles: f64,
    /// Leaves visited.
    pub leaves: f64,
}

impl Traffic {
    /// Returns the bytes of nodes, triangles, terminators, ray and hit. Lookups add 4 or 8 bytes each, in sectors of
    /// 32.
    pub fn bytes(&self) -> f64 {
        // With eight children, ancestors are not counted: a backtrack reads one of them.
        let node = if self.children == 2 { 64.0 } else { 96.0 };
        node * self.nodes + 48.0 * self.triangles + 16.0 * self.leaves + 64.0
    }
}

/// The maximum number of rays whose visits are counted, evenly spread. The device would wait while the CPU counts
/// millions.
const COUNTED: usize = 65_536;

/// Measures all kernels on one scene. `say` receives each line, and the traffic of each set of rays.
///
/// # Errors
/// [`GpuError`]; [`GpuError::Data`], with the names of the kernels, if their hits differ.
pub fn bench(
    gpu: &Gpu,
    arithmetic: &Arithmetic,
    (name, mesh, bvh): (&str, &Mesh, &Bvh),
    setting: Setting,
    say: &mut dyn FnMut(Result<&Row, Traffic>),
) -> Result<(), GpuError> {
    let scene = Scene::new(gpu, bvh)?.with_eight(gpu, hierarchy(mesh)?)?;
    let tracer = BinaryTracer::new(bvh);
    for view in 0..setting.views {
        let primary = made::view(mesh, setting.rays, view + 1);
        let diffuse = reflect_each(mesh, &primary, tracer.closest_parallel(&primary)?, view + 1);
        for kind in Rays::ALL {
            let rays = if kind == Rays::Primary { &primary } else { &diffuse };
            if rays.is_empty() {
                continue;
            }
            let counted: Vec<Ray> = rays.iter().step_by(rays.len().div_ceil(COUNTED)).copied().collect();
            let counters = if kind.is_any() { tracer.count_any(&counted) } else { tracer.count_closest(&counted) };
            let each = |count: u64| count as f64 / counted.len() as f64;
            let (nodes, triangles, leaves) = (each(counters.inner), each(counters.triangles), each(counters.leaves));
            say(Err(Traffic { children: 2, nodes, triangles, leaves }));
            if let Some(eight) = scene.eight() {
                say(Err(traffic(*arithmetic, eight, &counted, kind.is_any())));
            }
            let query = Query::single(arithmetic, rays, kind.is_any())?;
            let cell = Cell::new(gpu, &scene, query, rays, setting)?;
            for row in cell.rows(name, kind, view, rays.len()) {
                say(Ok(&row));
            }
        }
    }
    Ok(())
}

/// Counts the traffic of these rays with nodes of eight children.
fn traffic(arithmetic: Arithmetic, eight: &Eight, rays: &[Ray], any: bool) -> Traffic {
    let add = |a: [usize; 3], b: [usize; 3]| [0, 1, 2].map(|i| a[i] + b[i]);
    let visited = rays.par_iter().map(|ray| {
        let Visited { nodes, triangles, leaves } = through(&arithmetic, eight, ray, any).1;
        [nodes, triangles, leaves]
    });
    let [nodes, triangles, leaves] = visited.reduce(|| [0; 3], add).map(|count| count as f64 / rays.len() as f64);
    Traffic { children: SLOTS, nodes, triangles, leaves }
}

/// Times of all kernels with one set of rays: by kernel, then by pass. The last kernel repeats the first one.
struct Cell {
    kernels: Vec<Kernel>,
    times: Vec<Vec<f64>>,
}

impl Cell {
    fn new(gpu: &Gpu, scene: &Scene, query: Query<'_>, rays: &[Ray], setting: Setting) -> Result<Self, GpuError> {
        let mut kernels = kernels(gpu, scene);
        kernels.push(kernels[0]);
        let placed = kernels.iter().map(|kernel| scene.placed(kernel)).collect::<Result<Vec<_>, _>>()?;
        let compile = |(kernel, placed): (&Kernel, &Placed<'_>)| {
            launch::compile(gpu, kernel, placed.depth, &placed.source(gpu, kernel, query), setting.checks)
        };
        let pipelines = kernels.iter().zip(&placed).map(compile).collect::<Result<Vec<_>, _>>()?;
        let count = rays.len() as u32;
        let tasks = gpu.buffer("rays", &rays_words(rays)?)?;
        let (work, params) = (gpu.zeros("work", 4)?, params(gpu, count)?);
        let results = kernels.iter().map(|_| gpu.zeros("hits", 4 * rays.len())).collect::<Result<Vec<_>, _>>()?;
        let passes: Vec<_> = (0..kernels.len())
            .map(|i| {
                let [nodes, leaves, displacements, cells] = placed[i].buffers;
                let (tasks, results, params, work) = (&tasks, &results[i], &params, &work);
                let buffers = Buffers { nodes, leaves, displacements, cells, tasks, results, params, work };
                let mut pass = buffers.pass(&kernels[i], &pipelines[i], count);
                // Hits of the previous pass must not remain.
                pass.clear = vec![results, work];
                pass
            })
            .collect();
        let mut times = vec![Vec::new(); kernels.len()];
        for round in 0..setting.warm_up + setting.passes {
            let nanoseconds = gpu.time(&passes)?;
            if round >= setting.warm_up {
                times.iter_mut().zip(nanoseconds).for_each(|(times, time)| times.push(time));
            }
        }
        // From the first kernel of two children, and of eight.
        let mut first: [Option<Vec<Found>>; 2] = [None, None];
        for (kernel, results) in kernels.iter().zip(&results).filter(|(kernel, _)| kernel.keeps_order()) {
            let words = gpu.read(results, 4 * rays.len())?;
            let found: Vec<Found> = words.as_chunks().0.iter().map(|&words| Found::of_words(words)).collect();
            let own = usize::from(kernel.is_wide());
            // With another order, any-hit queries may find another hit.
            let is_same = |a: &Found, b: &Found| {
                if first[own].is_none() && query.any { a.is_hit() == b.is_hit() } else { a == b }
            };
            let differ = first[own]
                .as_ref()
                .or(first[0].as_ref())
                .map_or(0, |first| first.iter().zip(&found).filter(|(a, b)| !is_same(a, b)).count());
            // Kernels that prune, or have another order, may miss hits only by rounding, close to the end of a box.
            let allowed = if is_pruning(kernel) || first[own].is_none() { rays.len() / 1000 } else { 0 };
            if differ > allowed {
                return Err(GpuError::Data(format!("{}: {differ} hits are not those of stack", kernel.full_name())));
            }
            first[own].get_or_insert(found);
        }
        Ok(Self { kernels, times })
    }

    fn rows(&self, scene: &str, rays: Rays, view: u64, count: usize) -> Vec<Row> {
        let last = self.kernels.len() - 1;
        let best = |of: &dyn Fn(&Kernel) -> bool| {
            let candidates = (0..last).filter(|&i| of(&self.kernels[i]));
            candidates.min_by(|&a, &b| median(&self.times[a]).total_cmp(&median(&self.times[b]))).unwrap_or(0)
        };
        let (stack, paper) = (best(&is_stack), best(&is_of_paper));
        let wide_stack = best(&|kernel| kernel.traversal == Traversal::Wide(Wide::Stack));
        let own = |kernel: &Kernel| if kernel.is_wide() { wide_stack } else { stack };
        (0..=last)
            .map(|i| Row {
                scene: scene.to_owned(),
                rays,
                view,
                kernel: self.kernels[i].full_name(),
                count,
                nanoseconds: median(&self.times[i]),
                deviation: deviation(&self.times[i]),
                to_best: ratio(&self.times[stack], &self.times[i]),
                to_paper: ratio(&self.times[paper], &self.times[i]),
                to_own: ratio(&self.times[own(&self.kernels[i])], &self.times[i])[0],
                is_noise: i == last,
            })
            .collect()
    }
}

/// Returns the kernels for a scene, with words as narrow as the depth allows, as in the paper.
fn kernels(gpu: &Gpu, scene: &Scene) -> Vec<Kernel> {
    let words = Kernel::words_for(scene.depth());
    let mut kernels = Kernel::all(1);
    if words > 1 {
        kernels.retain(|kernel| !kernel.has_words());
        kernels.extend(Kernel::all(words));
    }
    kernels.extend(Kernel::wide());
    let fits = |kernel: &Kernel| kernel.workgroup_bytes(scene.depth()) <= gpu.workgroup_bytes();
    kernels.retain(|kernel| scene.placed(kernel).is_ok() && fits(kernel));
    kernels.dedup_by_key(|kernel| kernel.name);
    kernels
}

fn is_pruning(kernel: &Kernel) -> bool {
    matches!(kernel.traversal, Traversal::StackT0 | Traversal::HashedDisjoint)
}

/// Returns whether it is a stack kernel of two children, including short stacks. Ratios are relative to the best of
/// them.
fn is_stack(kernel: &Kernel) -> bool {
    let is_short = matches!(kernel.traversal, Traversal::Laine(short) if short > 0);
    is_short || matches!(kernel.traversal, Traversal::Stack | Traversal::StackWorkgroup | Traversal::StackT0)
}

/// Returns whether it is a baseline of Binder & Keller: while-while, speculative, persistent.
fn is_of_paper(kernel: &Kernel) -> bool {
    kernel.traversal == Traversal::Stack
}

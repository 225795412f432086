//! Perfect hash tables, built on the device and certified on the CPU.

use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing, certify};
use stackless_bvh::internals::hash::AddressBounds;
use stackless_bvh::tree::{Keys, Node, Topology};

use crate::launch::groups;
use crate::layout::halves;
use crate::tapes::{Edit, unchanged};
use crate::{Access, Checks, Gpu, GpuError, Pass, Pipeline};

/// A certified table, with the cost of its construction.
#[derive(Debug)]
pub struct Built {
    /// The table.
    pub hash: PerfectHash,
    /// Nanoseconds on the device, if it has a clock.
    pub nanoseconds: Option<f64>,
    /// Number of tried sizes.
    pub attempts: u32,
}

/// A key and the entry of its node.
type Keyed = (u64, u32);

/// Maximum number of times that H grows by an eighth. `[HASH-2]`
const GROWTHS: u32 = 16;

/// Builds one table with a new [`Builder`].
///
/// # Errors
/// The errors of [`Builder::build`].
pub fn build(gpu: &Gpu, tree: &impl Topology, options: Options) -> Result<Built, GpuError> {
    Builder::new(gpu, &unchanged)?.build(tree, options)
}

/// The passes that build tables.
#[derive(Debug)]
pub struct Builder<'g> {
    gpu: &'g Gpu,
    stages: [Pipeline; 4],
}

/// Displacements and cells from the device, with the cost of their construction.
#[derive(Debug)]
pub struct Made {
    /// Displacements, and the entries of keys that are alone in their buckets.
    pub displacements: Vec<u32>,
    /// Entries; 0 in empty cells.
    pub cells: Vec<u32>,
    direct: u32,
    nanoseconds: Option<f64>,
    attempts: u32,
}

impl<'g> Builder<'g> {
    /// Compiles the passes, with an edited text.
    ///
    /// # Errors
    /// Errors of the device.
    pub fn new(gpu: &'g Gpu, edit: Edit<'_>) -> Result<Self, GpuError> {
        let stage = |stage: u32| {
            let parts = [
                &format!("const STAGE = {stage}u;\n"),
                include_str!("../wgsl/wide.wgsl"),
                include_str!("../wgsl/table.wgsl"),
                include_str!("../wgsl/remainder.wgsl"),
                include_str!("../wgsl/hash_build.wgsl"),
            ];
            let mut bindings = vec![Access::Read];
            bindings.extend([Access::Write; 7]);
            bindings.push(Access::Uniform);
            gpu.compile("hash", &edit(parts.concat()), &bindings, Checks::All)
        };
        Ok(Self { gpu, stages: [stage(0)?, stage(1)?, stage(2)?, stage(3)?] })
    }

    /// Builds the table of a tree of up to 63 edges, and certifies it.
    ///
    /// # Errors
    /// [`GpuError::Data`] if the plain function has no displacements (only the CPU builds seeded tables), or if the
    /// table is wrong.
    pub fn build(&self, tree: &impl Topology, options: Options) -> Result<Built, GpuError> {
        let made = self.make(tree, options, None)?;
        let Some(made) = made else {
            return Err(GpuError::Data("no displacements: the plain function does not work for these keys".to_owned()));
        };
        let (nanoseconds, attempts) = (made.nanoseconds, made.attempts);
        let hash = checked(tree, options, keyed(tree, options.key_set).len() as u32, made)?;
        Ok(Built { hash, nanoseconds, attempts })
    }

    /// Builds the tables of a tree of up to 63 edges, with the sizes D and H if they are given. Returns `None` if no
    /// displacements exist or were found.
    ///
    /// # Errors
    /// Errors of the device; [`GpuError::Data`] for keys that are too long, and for invalid sizes.
    pub fn make(
        &self,
        tree: &impl Topology,
        options: Options,
        sizes: Option<[u32; 2]>,
    ) -> Result<Option<Made>, GpuError> {
        if tree.depth() > 63 {
            return Err(GpuError::Data(format!("a tree of {} edges has keys beyond 64 bits", tree.depth())));
        }
        let keys = keyed(tree, options.key_set);
        let count = match options.sizing {
            Sizing::Printed => tree.node_count(),
            _ => keys.len(),
        } as u64;
        let displacements = match (sizes, options.sizing) {
            (Some([displacements, _]), _) => displacements.into(),
            (None, Sizing::Tight) => nearest_power(2 * keys.len() as u64),
            _ => 1 << (count.max(3) - 1).ilog2().saturating_sub(1),
        };
        if !displacements.is_power_of_two() {
            return Err(GpuError::Data(format!("{displacements} displacements are no power of two")));
        }
        let grouped = Grouped::new(self, &keys, displacements)?;
        let mut cells = match (sizes, options.sizing) {
            (Some([_, cells]), _) => cells.into(),
            (None, Sizing::Tight) => 2 * u64::from(grouped.shared) + 1,
            _ => 2 * count + 1,
        };
        for attempts in 1..=GROWTHS {
            if let Some(made) = grouped.place(self, cells)? {
                return Ok(Some(Made { attempts, ..made }));
            }
            if options.sizing != Sizing::Tight || sizes.is_some() {
                break;
            }
            cells = 2 * (cells * 9 / 16 + 1) + 1;
        }
        Ok(None)
    }
}

/// The keys of a set with their entries, from a walk over the tree.
fn keyed(tree: &impl Topology, key_set: KeySet) -> Vec<Keyed> {
    let (hashed, keys) = (key_set.slots(tree), Keys::of(tree));
    let mut keyed = Vec::new();
    let mut pending = vec![tree.root()];
    while let Some(node) = pending.pop() {
        let slot = tree.slot(node);
        if hashed[slot] {
            keyed.push((keys.key::<u64>(slot), entry(node)));
        }
        if !node.is_leaf() {
            pending.extend(tree.children(node));
        }
    }
    keyed
}

/// The entry of a node. `[HASH-5]`
pub const fn entry(node: Node) -> u32 {
    let index = node.index() as u32;
    if node.is_leaf() { !index } else { 1 << 31 | index }
}

/// The nearest power of two, by ratio.
fn nearest_power(count: u64) -> u64 {
    let power = count.next_power_of_two();
    if power > 1 && count * count < power * power / 2 { power / 2 } else { power }
}

/// Keys in their buckets, on the device.
struct Grouped {
    keys: wgpu::Buffer,
    counts: wgpu::Buffer,
    starts: wgpu::Buffer,
    fills: wgpu::Buffer,
    order: wgpu::Buffer,
    displacements: wgpu::Buffer,
    key_count: u32,
    size: u32,
    shared: u32,
    largest: u32,
    nanoseconds: Option<f64>,
}

impl Grouped {
    fn new(Builder { gpu, stages }: &Builder<'_>, keys: &[Keyed], size: u64) -> Result<Self, GpuError> {
        let size = u32::try_from(size).map_err(|_| GpuError::Data("too many keys".to_owned()))?;
        let words: Vec<u32> = keys.iter().flat_map(|&(key, word)| [key as u32, (key >> 32) as u32, word, 0]).collect();
        let zeros = |what: &str| gpu.zeros(what, size as usize);
        let mut grouped = Self {
            keys: gpu.buffer("keys", &words)?,
            counts: zeros("counts")?,
            starts: zeros("starts")?,
            fills: zeros("fills")?,
            order: gpu.zeros("order", keys.len())?,
            displacements: zeros("displacements")?,
            key_count: keys.len() as u32,
            size,
            shared: 0,
            largest: 0,
            nanoseconds: None,
        };
        let (cells, totals) = (gpu.zeros("cells", 1)?, gpu.zeros("totals", 4)?);
        let (by_key, by_bucket) = (grouped.params(gpu, grouped.key_count, 0, 1)?, grouped.params(gpu, size, 0, 1)?);
        let passes = stages
            .iter()
            .zip([&by_key, &by_bucket, &by_key])
            .map(|(pipeline, (params, count))| grouped.pass(pipeline, &cells, &totals, params, *count));
        let nanoseconds = run(gpu, &passes.collect::<Vec<_>>())?;
        let found = gpu.read(&totals, 3)?;
        (grouped.shared, grouped.largest, grouped.nanoseconds) = (found[0], found[2], nanoseconds);
        Ok(grouped)
    }

    /// Builds the tables with `size` cells. Returns `None` if some bucket has no displacement.
    fn place(&self, Builder { gpu, stages }: &Builder<'_>, size: u64) -> Result<Option<Made>, GpuError> {
        let size = u32::try_from(size).ok().filter(|size| (1..=1 << 31).contains(size));
        let Some(size) = size else {
            return Err(GpuError::Data("cells are not between 1 and 2^31".to_owned()));
        };
        let (cells, totals) = (gpu.zeros("cells", size as usize)?, gpu.zeros("totals", 4)?);
        let batches = (2..=self.largest).rev().map(|count| self.params(gpu, self.size, count, size));
        let batches = batches.collect::<Result<Vec<_>, _>>()?;
        let passes = batches.iter().map(|(params, count)| self.pass(&stages[3], &cells, &totals, params, *count));
        let nanoseconds = run(gpu, &passes.collect::<Vec<_>>())?;
        if gpu.read(&totals, 2)?[1] > 0 {
            return Ok(None);
        }
        Ok(Some(Made {
            displacements: gpu.read(&self.displacements, self.size as usize)?,
            cells: gpu.read(&cells, size as usize)?,
            // Keys that are alone in their buckets.
            direct: self.key_count - self.shared,
            nanoseconds: nanoseconds.zip(self.nanoseconds).map(|(a, b)| a + b),
            attempts: 1,
        }))
    }

    fn params(&self, gpu: &Gpu, invocations: u32, batch: u32, cells: u32) -> Result<(wgpu::Buffer, u32), GpuError> {
        let row = groups(invocations)[0] * crate::kernel::WORKGROUP;
        let [low, high] = halves(u64::MAX / u64::from(cells));
        Ok((gpu.uniform(&[invocations, row, batch, self.size - 1, cells, low, high, 0])?, invocations))
    }

    fn pass<'a>(
        &'a self,
        pipeline: &'a Pipeline,
        cells: &'a wgpu::Buffer,
        totals: &'a wgpu::Buffer,
        params: &'a wgpu::Buffer,
        invocations: u32,
    ) -> Pass<'a> {
        let Self { keys, counts, starts, fills, order, displacements, .. } = self;
        let buffers = vec![keys, counts, starts, fills, order, displacements, cells, totals, params];
        Pass { pipeline, buffers, groups: groups(invocations), clear: Vec::new() }
    }
}

/// Runs passes, and returns their time if the device has a clock.
fn run(gpu: &Gpu, passes: &[Pass<'_>]) -> Result<Option<f64>, GpuError> {
    if passes.is_empty() {
        return Ok(Some(0.0));
    }
    match gpu.time(passes) {
        Ok(times) => Ok(Some(times.iter().sum())),
        Err(GpuError::Feature(_)) => gpu.run(passes).map(|()| None),
        Err(error) => Err(error),
    }
}

/// The library's table with these words, if it is correct.
fn checked(
    tree: &impl Topology,
    options: Options,
    keys: u32,
    Made { displacements, cells, direct, .. }: Made,
) -> Result<PerfectHash, GpuError> {
    let (set, reach) = match options.key_set {
        KeySet::All => (0, [0, 0]),
        KeySet::Paper => (1, [0, 0]),
        KeySet::Exact(reach) => (2, [reach.of(false), reach.of(true)]),
    };
    let sizing = Sizing::ALL.iter().position(|&of| of == options.sizing).unwrap_or(0) as u32;
    let narrow = u32::from(tree.depth() < 32);
    let sizes = [keys, direct, displacements.len() as u32, cells.len() as u32];
    let header = [1, set, reach[0], reach[1], sizing, narrow].into_iter().chain(sizes).chain([0; 2 + 2]);
    // The fold seed of long keys, which do not occur.
    let header = header.chain([0; 2]);
    let mut bytes = b"SBVHHASH".to_vec();
    bytes.extend(header.chain(displacements).chain(cells).flat_map(u32::to_le_bytes));
    let wrong = |error: &dyn std::fmt::Display| GpuError::Data(format!("a wrong table: {error}"));
    let hash = PerfectHash::from_bytes(&bytes, AddressBounds::of(tree)).map_err(|error| wrong(&error))?;
    certify(&hash, tree, options.key_set).map_err(|error| wrong(&error))?;
    Ok(hash)
}

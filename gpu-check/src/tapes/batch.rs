//! Trees and tapes as buffers.

use rayon::prelude::*;
use stackless_bvh::generate::{Family, Kind, Rng, Source as _, Tape};
use stackless_bvh::tree::{Keys, Node, Topology as _, Tree};

use super::events::References;
use super::{Expected, Searches};
use crate::kernel::{Kernel, Links, Table, tape_fill};
use crate::launch::{groups, params};
use crate::layout::{Addresses, HashTables, Records, TableHead, halves};
use crate::{Access, Checks, Gpu, GpuError, Pass};

/// A tree and a tape.
#[derive(Debug)]
pub struct Case {
    /// The tree.
    pub tree: Tree,
    /// The generator: the name of a family, or `far`.
    pub shape: &'static str,
    /// The tape's kind.
    pub kind: Kind,
    /// The tape's seed.
    pub seed: u64,
    /// The library's tape.
    pub tape: Tape,
}

/// Cases on the device, each with a closest-hit and an any-hit search.
#[derive(Debug)]
pub struct Batch {
    cases: Vec<Placed>,
    /// By kind of link: nodes and leaves.
    records: [[wgpu::Buffer; 2]; 2],
    /// Printed and tight: displacements and cells.
    tables: [[wgpu::Buffer; 2]; 2],
}

#[derive(Debug)]
struct Placed {
    case: Case,
    addresses: Addresses,
    heads: [TableHead; 2],
    references: References,
}

/// Depths near the limits of words.
const EDGES: [u32; 9] = [30, 31, 32, 33, 62, 63, 64, 94, 95];

/// Generates `count` cases: alternating families, of all sizes up to 96 leaves. Every eighth case is a chain with a
/// depth near the limit of a word. In half of the chains, backtracks span the whole length.
pub fn cases(count: usize, seed: u64) -> Vec<Case> {
    (0..count)
        .map(|i| {
            let mut rng = Rng::new(seed ^ (i as u64) << 20);
            let depth = EDGES[i / 16 % EDGES.len()];
            let (shape, tree, kind) = match i % 16 {
                15 => ("far", far_chain(&mut rng, depth), Kind::Alternating),
                7 => (Family::Comb.name(), Family::Comb.tree(&mut rng, depth + 1), Kind::ALL[i / 16 % Kind::ALL.len()]),
                turn => {
                    let family = Family::ALL[turn % Family::ALL.len()];
                    let most = 4_u64 << rng.below(6);
                    let leaves = 1 + rng.below(most.min(96)) as u32;
                    (family.name(), family.tree(&mut rng, leaves), Kind::ALL[i / 2 % Kind::ALL.len()])
                }
            };
            let seed = rng.bits();
            let tape = Tape::hashed(seed, &tree, kind);
            Case { tree, shape, kind, seed, tape }
        })
        .collect()
}

/// A chain for the alternating tape, which takes left and right first alternately. The leaf comes before the rest of
/// the chain. So the rest is entered with postponed nodes only at the root and at one other level.
fn far_chain(rng: &mut Rng, depth: u32) -> Tree {
    let other = rng.below(u64::from(depth)) as u32;
    let mut children = Vec::with_capacity(2 * depth as usize + 1);
    for level in 0..depth {
        let next = 2 * level + 1;
        let right_first = level % 2 == 1;
        let chain_first = level == 0 || level == other;
        let chain_is_right = right_first == chain_first;
        let (chain, leaf) = (next, next + 1);
        children.push(Some(if chain_is_right { [leaf, chain] } else { [chain, leaf] }));
        if level > 0 {
            children.push(None);
        }
    }
    children.extend([None, None]);
    Tree::new(&children).unwrap_or_else(|_| Family::Comb.tree(rng, depth + 1))
}

impl Batch {
    /// Uploads cases, and lets the device write their tapes.
    ///
    /// # Errors
    /// [`GpuError`].
    pub fn new(gpu: &Gpu, cases: Vec<Case>) -> Result<Self, GpuError> {
        let mut tables = [HashTables::default(), HashTables::default()];
        let mut placed = Vec::with_capacity(cases.len());
        // The first record is unused: its address marks an empty register.
        let (mut next, mut next_leaf) = (1, 0);
        for case in cases {
            let addresses;
            (addresses, next, next_leaf) = Addresses::of(&case.tree, next, next_leaf, |_| 2);
            let [printed, tight] = &mut tables;
            let refused = |error: stackless_bvh::hash::BuildError| GpuError::Data(error.to_string());
            let heads = [
                printed.add(&case.tree, &addresses, Table::Printed).map_err(refused)?,
                tight.add(&case.tree, &addresses, Table::Tight).map_err(refused)?,
            ];
            placed.push((case, addresses, heads));
        }
        let fill = Fill::new(gpu, &placed)?;
        let upload = |kind| fill.records(gpu, &placed, kind, next, next_leaf);
        let records = [upload(Links::Uncles)?, upload(Links::Parents)?];
        let [printed, tight] = tables;
        let both = |t: HashTables| {
            Ok::<_, GpuError>([gpu.buffer("displacements", &t.displacements)?, gpu.buffer("cells", &t.cells)?])
        };
        let tables = [both(printed)?, both(tight)?];
        let cases = placed
            .into_par_iter()
            .map(|(case, addresses, heads)| {
                let references = References::of(&case);
                Placed { case, addresses, heads, references }
            })
            .collect();
        Ok(Self { cases, records, tables })
    }

    /// The case of a search. Each case has two searches: closest hit, then any hit.
    pub fn case(&self, search: usize) -> &Case {
        &self.cases[search / 2].case
    }
}

impl Searches for Batch {
    fn searches(&self) -> usize {
        2 * self.cases.len()
    }

    fn depth(&self, search: usize) -> u32 {
        self.case(search).tree.depth()
    }

    fn describe(&self, search: usize) -> String {
        let Case { tree, shape, kind, seed, .. } = self.case(search);
        let query = if search % 2 == 1 { "any hit" } else { "closest hit" };
        format!("{shape} of {} nodes, {} deep, tape {kind} of seed {seed}, {query}", tree.node_count(), tree.depth())
    }

    fn node_at(&self, search: usize, address: u32) -> Option<Node> {
        let placed = &self.cases[search / 2];
        let tree = &placed.case.tree;
        (0..tree.node_count() as u32)
            .filter_map(|i| tree.node(i))
            .find(|&node| placed.addresses.at(tree, node) == address)
    }

    fn nodes(&self, search: usize) -> usize {
        self.case(search).tree.node_count()
    }

    fn expected(&self, search: usize, kernel: &Kernel) -> Expected {
        let placed = &self.cases[search / 2];
        let address = |node: Node| placed.addresses.at(&placed.case.tree, node);
        Expected::new(&placed.case.tree, &placed.references, search % 2 == 1, kernel, address)
    }

    fn buffers(&self, kernel: &Kernel) -> [&wgpu::Buffer; 4] {
        let [nodes, leaves] = &self.records[usize::from(kernel.links() == Links::Parents)];
        let [displacements, cells] = &self.tables[usize::from(kernel.table() == Some(Table::Tight))];
        [nodes, leaves, displacements, cells]
    }

    fn task_words(&self, kernel: &Kernel, searches: &[usize]) -> Vec<u32> {
        let mut words = Vec::with_capacity(16 * searches.len());
        for &search in searches {
            let Placed { case, addresses, heads, .. } = &self.cases[search / 2];
            let head = &heads[usize::from(kernel.table() == Some(Table::Tight))];
            words.extend(head.words(addresses.at(&case.tree, case.tree.root()), (search % 2) as u32));
        }
        words
    }
}

/// The pass that writes tapes into records.
struct Fill {
    pipeline: crate::Pipeline,
    jobs: wgpu::Buffer,
    params: wgpu::Buffer,
    count: u32,
}

impl Fill {
    fn new(gpu: &Gpu, placed: &[(Case, Addresses, [TableHead; 2])]) -> Result<Self, GpuError> {
        let access = [Access::Write, Access::Write, Access::Read, Access::Uniform];
        let pipeline = gpu.compile("tapes", &tape_fill(), &access, Checks::All)?;
        let mut jobs = Vec::new();
        for (Case { tree, kind, seed, .. }, addresses, _) in placed {
            let keys = Keys::of(tree);
            for node in (0..tree.node_count() as u32).filter_map(|i| tree.node(i)).filter(|node| !node.is_leaf()) {
                let slot = tree.slot(node);
                let (depth, key) = (keys.depth(slot), keys.key::<u128>(slot));
                let path = key ^ 1 << depth;
                let kind = Kind::ALL.iter().position(|of| of == kind).unwrap_or(0) as u32;
                jobs.extend([
                    addresses.at(tree, node),
                    depth,
                    path as u32,
                    (path >> 32) as u32,
                    (path >> 64) as u32,
                    kind,
                ]);
                jobs.extend(halves(*seed));
            }
        }
        let count = (jobs.len() / 8) as u32;
        Ok(Self { pipeline, jobs: gpu.buffer("jobs", &jobs)?, params: params(gpu, count)?, count })
    }

    fn records(
        &self,
        gpu: &Gpu,
        placed: &[(Case, Addresses, [TableHead; 2])],
        kind: Links,
        inner: u32,
        pieces: u32,
    ) -> Result<[wgpu::Buffer; 2], GpuError> {
        let mut records = Records::with_room(inner, pieces);
        for (Case { tree, .. }, addresses, _) in placed {
            records.add_tree(tree, addresses, kind);
        }
        let buffers = [gpu.buffer("nodes", &records.nodes)?, gpu.buffer("leaves", &records.leaves)?];
        if self.count > 0 {
            let pass = Pass {
                pipeline: &self.pipeline,
                buffers: vec![&buffers[0], &buffers[1], &self.jobs, &self.params],
                groups: groups(self.count),
                clear: Vec::new(),
            };
            gpu.run(&[pass])?;
        }
        Ok(buffers)
    }
}

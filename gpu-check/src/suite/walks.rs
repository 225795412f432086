//! Level `trace`: a traversal of a tree with a script or cells, one invocation for each case.

use std::collections::HashMap;

use serde_json::{Value, json};

use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::key::Grow;
use stackless_bvh::tree::{Keys, Node, Topology as _, Tree};
use stackless_suite::{Answer, Ask, WalkError};

use super::{Device, hex};
use crate::kernel::{Kernel, Record, Shape, TAPE_SEARCH};
use crate::launch::{BINDINGS, Buffers, params};
use crate::layout::{Addresses, HashTables, NOWHERE, Records, TableHead};
use crate::tapes::RECORDED;
use crate::{GpuError, Pipeline};

/// A traversal that records its events.
#[derive(Debug)]
pub(super) struct Walks {
    pipeline: Pipeline,
    results: wgpu::Buffer,
    params: wgpu::Buffer,
    unread: wgpu::Buffer,
}

/// The record of a visit.
type Visit = [u32; RECORDED];

impl Walks {
    pub(super) fn new(device: &Device<'_>) -> Result<Self, GpuError> {
        let Device { gpu, kernel, depth, .. } = device;
        let shape = Shape { depth: *depth, subgroups: gpu.has_subgroups() };
        let source = kernel.source(shape, TAPE_SEARCH, Record::Events);
        let pipeline = device.compile(&kernel.full_name(), &source, &BINDINGS)?;
        let (results, params) = (gpu.zeros("results", 8)?, params(gpu, 1)?);
        Ok(Self { pipeline, results, params, unread: gpu.zeros("no table", 4)? })
    }

    pub(super) fn answer(&self, device: &Device<'_>, ask: &Ask) -> Result<Option<Answer>, GpuError> {
        let Ask::Trace(walk) = ask else { return Ok(None) };
        let case = match walk.case() {
            Ok(case) => case,
            Err(WalkError::Tree(_)) => return Ok(Some(Answer::Reject("not-a-tree".to_owned()))),
            Err(WalkError::Search) => return Ok(None),
        };
        if case.tree.depth() > device.depth {
            return Ok(Some(Answer::Reject("too-deep".to_owned())));
        }
        let Some((case, distances)) = in_ranks(case) else { return Ok(None) };
        let (addresses, inner, pieces) = Addresses::of(&case.tree, 1, 0, |_| 2);
        let (visits, outcome) = self.run(device, &case, &addresses, [inner, pieces])?;
        let names = Names::of(&case.tree, &addresses);
        let mut fields = vec![("events", json!(names.events(&device.kernel, &visits, outcome[3])))];
        if walk.cells.is_some() {
            let hit = json!({ "t": distances.get(outcome[0] as usize), "node": outcome[1] });
            fields.push(("hit", if outcome[2] == 1 { hit } else { Value::Null }));
        }
        if device.kernel.has_trail() {
            fields.push(("trails", visits.iter().map(|visit| hex(word(visit, 5))).collect()));
        }
        if device.kernel.has_register() {
            fields.push(("registers", visits.iter().map(|visit| names.register(visit[8])).collect()));
        }
        Ok(Some(Answer::Result(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())))
    }

    /// Runs a case. Returns the records, and the first words of the result: the hit, and the number of visits.
    fn run(
        &self,
        Device { gpu, kernel, .. }: &Device<'_>,
        case: &stackless_check::Case,
        addresses: &Addresses,
        [inner, pieces]: [u32; 2],
    ) -> Result<(Vec<Visit>, [u32; 4]), GpuError> {
        let stackless_check::Case { tree, tape, any, .. } = case;
        let mut records = Records::with_room(inner, pieces);
        records.add_tree(tree, addresses, kernel.links());
        records.add_cells(tree, addresses, tape);
        let mut tables = HashTables::default();
        let head = match kernel.table() {
            Some(table) => tables.add(tree, addresses, table).map_err(|error| GpuError::Data(error.to_string()))?,
            None => TableHead::NONE,
        };
        let [nodes, leaves] = [gpu.buffer("nodes", &records.nodes)?, gpu.buffer("leaves", &records.leaves)?];
        let uploaded = match kernel.table() {
            Some(_) => Some([gpu.buffer("displacements", &tables.displacements)?, gpu.buffer("cells", &tables.cells)?]),
            None => None,
        };
        let [displacements, cells] = uploaded.as_ref().map_or([&self.unread; 2], <[_; 2]>::each_ref);
        let tasks = gpu.buffer("tasks", &head.words(addresses.at(tree, tree.root()), u32::from(*any)))?;
        // A traversal visits each node at most once. The space for one more visit reveals errors.
        let most = tree.node_count() + 1;
        // The first word is the queue of persistent kernels.
        let work = gpu.zeros("work", 1 + RECORDED * most)?;
        let (results, params) = (&self.results, &self.params);
        let buffers = Buffers {
            nodes: &nodes,
            leaves: &leaves,
            displacements,
            cells,
            tasks: &tasks,
            results,
            params,
            work: &work,
        };
        let mut pass = buffers.pass(kernel, &self.pipeline, 1);
        pass.clear = vec![results];
        let [words, recorded] = gpu.run_and_read(&[pass], [(results, 8), (&work, 1 + RECORDED * most)])?;
        let visits = recorded[1..].as_chunks().0.iter().take(words[3] as usize).copied().collect();
        Ok((visits, [words[0], words[1], words[2], words[3]]))
    }
}

/// Replaces distances by their ranks, and returns the case and the distances. The maximum number means no hit on the
/// device. A search only compares distances.
fn in_ranks(case: stackless_check::Case) -> Option<(stackless_check::Case, Vec<u32>)> {
    let cells = case.tape.cells();
    let mut distances: Vec<u32> = vec![0];
    distances.extend(cells.iter().flat_map(|cell| [Some(cell.enter), cell.exit, cell.hit]).flatten());
    distances.sort_unstable();
    distances.dedup();
    let rank = |distance: u32| distances.partition_point(|&other| other < distance) as u32;
    let ranked =
        |cell: &Cell| Cell { enter: rank(cell.enter), exit: cell.exit.map(rank), hit: cell.hit.map(rank), ..*cell };
    let tape = Tape::from_cells(&case.tree, cells.iter().map(ranked).collect())?;
    Some((stackless_check::Case { tape, ..case }, distances))
}

/// The names of nodes: keys, by address.
struct Names<'t> {
    tree: &'t Tree,
    keys: Keys,
    nodes: HashMap<u32, Node>,
}

impl<'t> Names<'t> {
    fn of(tree: &'t Tree, addresses: &Addresses) -> Self {
        let nodes = (0..tree.node_count() as u32).filter_map(|i| tree.node(i));
        let nodes = nodes.map(|node| (addresses.at(tree, node), node)).collect();
        Self { tree, keys: Keys::of(tree), nodes }
    }

    /// Keys and levels are those of the kernel, if it has them.
    fn events(&self, kernel: &Kernel, visits: &[Visit], count: u32) -> Vec<String> {
        let mut events = Vec::new();
        let mut before = None;
        for visit in visits {
            let node = self.nodes.get(&visit[0]).copied();
            let levels = if kernel.has_levels() { visit[1].checked_sub(1) } else { self.levels(before, node) };
            let mut key = self.key(visit[0]);
            if kernel.has_keys() {
                let Value::String(said) = hex(word(visit, 2)) else { continue };
                if said != key {
                    key = format!("{said} (at {key})");
                }
            }
            events.extend(levels.map(|levels| format!("backtrack {key} {levels}")));
            let is_leaf = node.is_none_or(Node::is_leaf);
            events.push(format!("{} {key}", if is_leaf { "leaf" } else { "enter" }));
            before = node;
        }
        // A traversal with more visits than nodes does not terminate.
        if count as usize <= visits.len() {
            events.push("end".to_owned());
        }
        events
    }

    /// Levels of the backtrack between two visits; `None` for a descent.
    fn levels(&self, before: Option<Node>, node: Option<Node>) -> Option<u32> {
        let before = before
            .filter(|&before| before.is_leaf() || node.is_some_and(|node| !self.tree.children(before).contains(&node)));
        let depth = |node: Node| self.keys.depth(self.tree.slot(node));
        Some(depth(before?).saturating_sub(depth(node?)))
    }

    fn key(&self, address: u32) -> String {
        let Some(&node) = self.nodes.get(&address) else { return format!("? {address:x}") };
        stackless_suite::hex(&self.keys.key::<Grow>(self.tree.slot(node)))
    }

    fn register(&self, address: u32) -> Value {
        if address == NOWHERE { Value::Null } else { json!(self.key(address)) }
    }
}

/// Three words of a visit, combined.
fn word(visit: &Visit, at: usize) -> u128 {
    u128::from(visit[at]) | u128::from(visit[at + 1]) << 32 | u128::from(visit[at + 2]) << 64
}

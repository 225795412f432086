//! Wide trees and the decisions of their searches, as buffers.

use rayon::prelude::*;
use stackless_bvh::event::Trace;
use stackless_bvh::generate::{Rng, Source as _, WideSearch, WideTape, wide_shape, wide_tree};
use stackless_bvh::order::Flow;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Search, Tables, Topology as _, Tree, Unsupported, Wanted, child_key, oracle};

use super::events::{Place, events};
use super::{Expected, Searches};
use crate::kernel::{Kernel, SLOTS};
use crate::layout::{HashTables, TableHead};
use crate::{Gpu, GpuError};

/// Children of every node; none of a leaf.
type Shape = Vec<Option<Vec<u32>>>;

/// A wide tree and a tape.
#[derive(Clone, Debug)]
pub struct WideCase {
    /// The tree.
    pub tree: Tree<SLOTS>,
    /// The generator.
    pub shape: &'static str,
    /// The seed of tree and tape.
    pub seed: u64,
    /// The answers of a search.
    pub tape: WideTape<SLOTS>,
}

/// Cases on the device, each searched in the order of ranks, and leaves first.
#[derive(Debug)]
pub struct WideBatch {
    cases: Vec<Placed>,
    /// Nodes, leaves, displacements and cells.
    buffers: [wgpu::Buffer; 4],
}

#[derive(Debug)]
struct Placed {
    case: WideCase,
    /// By the number of a node.
    places: Vec<Spot>,
    head: TableHead,
    is_changing: bool,
    /// Sorted, then leaves first.
    references: [Reference; 2],
}

/// The place of a node in its tree and in the buffers.
#[derive(Clone, Copy, Debug)]
struct Spot {
    address: u32,
    level: u32,
    parent: Option<Node>,
    /// The low 64 bits of the key. `[WIDE-9]`
    key: u64,
}

/// The visits of the oracle, and the outcome.
#[derive(Debug)]
struct Reference {
    nodes: Vec<Node>,
    end: u32,
}

/// Levels at the limits of words, and their neighbours.
const EDGES: [u32; 16] = [3, 4, 5, 7, 8, 9, 15, 16, 17, 20, 21, 22, 30, 31, 32, 33];

/// Numbers of distances of tapes: all equal, a few, many, and all that a rank can represent.
const DISTANCES: [u32; 5] = [1, 3, 12, 60, 1 << 29];

/// Pieces of 16 bytes of an inner node.
const PIECES: usize = 8;

/// Generates `count` cases: trees of nodes with up to 2, 4 and 8 children, with and without nodes of one child, and
/// full trees. Every fourth case is a chain with a depth near the limit of a word; in half of the chains, backtracks
/// span the whole length. From several tapes, each case gets the tape with the most visits.
pub fn cases(count: usize, seed: u64) -> Vec<WideCase> {
    (0..count)
        .into_par_iter()
        .filter_map(|i| {
            let seed = seed ^ (i as u64) << 20;
            let mut rng = Rng::new(seed);
            let levels = EDGES[i / 8 % EDGES.len()];
            let most = 2 + rng.below(95) as u32;
            let leaves = 1 + rng.below(u64::from(most)) as u32;
            let (shape, children) = match i % 8 {
                0 => ("pairs", wide_shape::<2>(&mut rng, leaves, leaves / 4)),
                1 => ("up to four", wide_shape::<4>(&mut rng, leaves, leaves / 4)),
                2 => ("many single", wide_shape::<8>(&mut rng, leaves / 2, leaves)),
                3 => ("chain", chain(&mut rng, levels, |rng, _| rng.below(SLOTS as u64) as usize)),
                4 => ("full", full(1 + i / 8 % 20)),
                7 => ("far", far(&mut rng, levels)),
                _ => ("up to eight", wide_shape::<8>(&mut rng, leaves, 0)),
            };
            let tree = wide_tree(&children);
            // With few distinct distances, many children are unwanted, so searches would not reach the end of a chain.
            let is_chain = i % 4 == 3;
            let distances = if is_chain { &DISTANCES[3..] } else { &DISTANCES };
            let case = |_| {
                let tape = WideTape::draw(&mut rng, &tree, distances[i / 3 % distances.len()]);
                let tape = stopping(&mut rng, &tree, tape);
                WideCase { tree: tree.clone(), shape, seed, tape }
            };
            let draws = if is_chain { 8 } else { 2 };
            (0..draws).map(case).max_by_key(|case| case.reference::<true>().nodes.len())
        })
        .collect()
}

/// One tape in four ends the search at a leaf.
fn stopping(rng: &mut Rng, tree: &Tree<SLOTS>, tape: WideTape<SLOTS>) -> WideTape<SLOTS> {
    let leaves: Vec<Node> = tree.nodes().filter(|node| node.is_leaf()).collect();
    if leaves.is_empty() || rng.below(4) > 0 {
        return tape;
    }
    tape.stopping_at(leaves[rng.below(leaves.len() as u64) as usize])
}

/// A chain of nodes with one child, except for the root and one other node.
fn far(rng: &mut Rng, levels: u32) -> Shape {
    let other = 1 + rng.below(u64::from(levels)) as u32;
    chain(
        rng,
        levels,
        |rng, level| {
            if level == 0 || level == other { 1 + rng.below(SLOTS as u64 - 1) as usize } else { 0 }
        },
    )
}

/// A chain whose inner nodes reach this level. `leaves` returns the number of leaves next to the next node.
fn chain(rng: &mut Rng, levels: u32, leaves: impl Fn(&mut Rng, u32) -> usize) -> Shape {
    let mut nodes: Shape = vec![None];
    let mut last = 0;
    for level in 0..=levels {
        let (first, count) = (nodes.len(), 1 + leaves(rng, level));
        nodes.extend(vec![None; count]);
        nodes[last] = Some((first as u32..(first + count) as u32).collect());
        last = first + rng.below(count as u64) as usize;
    }
    nodes
}

/// A tree with `inner` inner nodes, all of them full.
fn full(inner: usize) -> Shape {
    let children = |node: usize| ((SLOTS * node + 1) as u32..=(SLOTS * (node + 1)) as u32).collect();
    let mut nodes: Shape = (0..inner).map(|node| Some(children(node))).collect();
    nodes.resize(SLOTS * inner + 1, None);
    nodes
}

impl WideCase {
    fn reference<const SORTED: bool>(&self) -> Reference {
        let (mut search, mut trace) = (WideSearch::<SLOTS, SORTED>::new(&self.tape), Trace::default());
        oracle::traverse(&self.tree, &mut search, &mut trace);
        Reference { nodes: trace.nodes().to_vec(), end: search.end() }
    }

    /// The children of each node that are ever wanted, the ranks, and whether the wanted children depend on previous
    /// leaves.
    fn wanted(&self) -> (Vec<Wanted<[u32; SLOTS]>>, bool) {
        let none = Wanted { set: 0, ranks: [0; SLOTS] };
        let (mut wanted, mut is_changing) = (vec![none; self.tree.node_count()], false);
        // Each child is wanted with probability 1/2, so 64 trials find all wanted children.
        for leaves in 0..64 {
            let mut search = WideSearch::<SLOTS, false>::new(&self.tape);
            // The root is not a leaf, so this call only counts leaves.
            (0..leaves).for_each(|_| _ = search.leaf(self.tree.root()));
            for node in self.tree.nodes().filter(|node| !node.is_leaf()) {
                let Wanted { set, ranks } = search.ask(node);
                let known = &mut wanted[node.index()];
                is_changing |= leaves > 0 && set != known.set;
                *known = Wanted { set: known.set | set, ranks };
            }
        }
        (wanted, is_changing)
    }

    /// The place of each node, given the numbers of the next inner node and leaf.
    fn places(&self, next: &mut usize, next_leaf: &mut usize) -> Vec<Spot> {
        let root = Spot { address: 0, level: 0, parent: None, key: 1 };
        let mut places = vec![root; self.tree.node_count()];
        let mut open = vec![self.tree.root()];
        while let Some(node) = open.pop() {
            let spot = &mut places[node.index()];
            if node.is_leaf() {
                spot.address = !(*next_leaf as u32);
                *next_leaf += 1;
                continue;
            }
            spot.address = (PIECES * *next) as u32;
            *next += 1;
            let Spot { level, key, .. } = *spot;
            for slot in slots(self.tree.children(node)) {
                let child = self.tree.child(node, slot);
                let key = child_key::<SLOTS, u64>(key, slot.into());
                places[child.index()] = Spot { address: 0, level: level + 1, parent: Some(node), key };
                open.push(child);
            }
        }
        places
    }
}

fn slots(set: u32) -> impl Iterator<Item = u32> {
    (0..SLOTS as u32).filter(move |slot| set >> slot & 1 == 1)
}

impl WideBatch {
    /// Uploads cases.
    ///
    /// # Errors
    /// [`GpuError`].
    pub fn new(gpu: &Gpu, cases: Vec<WideCase>) -> Result<Self, GpuError> {
        // The first record is unused.
        let (mut nodes, mut leaves, mut tables) = (vec![0; 4 * PIECES], Vec::new(), HashTables::default());
        let (mut next, mut next_leaf) = (1, 0);
        let mut placed = Vec::with_capacity(cases.len());
        for case in cases {
            let places = case.places(&mut next, &mut next_leaf);
            nodes.resize(4 * PIECES * next, 0);
            leaves.resize(4 * next_leaf, 0);
            let (wanted, is_changing) = case.wanted();
            for node in case.tree.nodes() {
                if node.is_leaf() {
                    let at = 4 * !places[node.index()].address as usize;
                    leaves[at..at + 4].copy_from_slice(&case.leaf(node));
                } else {
                    let at = 4 * places[node.index()].address as usize;
                    nodes[at..at + 4 * PIECES].copy_from_slice(&case.record(node, wanted[node.index()], &places));
                }
            }
            let head = match Tables::new(&case.tree).hash() {
                Ok(hash) => tables.add_hash(hash, |node| places[node.index()].address),
                Err(Unsupported::TooDeep(_)) => TableHead::NONE,
                Err(unfit) => return Err(GpuError::Data(unfit.to_string())),
            };
            placed.push((case, places, head, is_changing));
        }
        let buffers = [
            gpu.buffer("nodes", &nodes)?,
            gpu.buffer("leaves", &leaves)?,
            gpu.buffer("displacements", &tables.displacements)?,
            gpu.buffer("cells", &tables.cells)?,
        ];
        let cases = placed.into_par_iter().map(|(case, places, head, is_changing)| {
            let references = [case.reference::<true>(), case.reference::<false>()];
            Placed { case, places, head, is_changing, references }
        });
        Ok(Self { cases: cases.collect(), buffers })
    }

    /// The case of a search.
    pub fn case(&self, search: usize) -> &WideCase {
        &self.cases[search / 2].case
    }

    /// Number of nodes that the oracle visits in a search.
    pub fn visits(&self, search: usize) -> usize {
        self.reference(search).nodes.len()
    }

    fn reference(&self, search: usize) -> &Reference {
        &self.cases[search / 2].references[search % 2]
    }
}

impl WideCase {
    /// A leaf in the format of kernels.
    fn leaf(&self, leaf: Node) -> [u32; 4] {
        let mut search = WideSearch::<SLOTS, true>::new(&self.tape);
        let stops = search.leaf(leaf) == Flow::Stop;
        [search.end(), u32::from(stops), leaf.index() as u32, 0]
    }

    /// An inner node in the format of kernels.
    fn record(&self, node: Node, Wanted { set, ranks }: Wanted<[u32; SLOTS]>, places: &[Spot]) -> [u32; 4 * PIECES] {
        let mut words = [0; 4 * PIECES];
        let address = |node: Node| places[node.index()].address;
        for slot in slots(self.tree.children(node)) {
            words[slot as usize] = address(self.tree.child(node, slot));
        }
        for up in 1..=SLOTS {
            words[SLOTS + up - 1] = address(self.tree.ancestor(node, up as u32));
        }
        words[2 * SLOTS..3 * SLOTS].copy_from_slice(&ranks);
        words[3 * SLOTS..3 * SLOTS + 2].copy_from_slice(&[set, node.index() as u32]);
        words
    }
}

impl Searches for WideBatch {
    fn searches(&self) -> usize {
        2 * self.cases.len()
    }

    fn depth(&self, search: usize) -> u32 {
        self.case(search).tree.levels()
    }

    fn describe(&self, search: usize) -> String {
        let WideCase { tree, shape, seed, .. } = self.case(search);
        let order = if search % 2 == 1 { "leaves first" } else { "by rank" };
        format!("wide {shape} of {} nodes, {} levels, seed {seed}, {order}", tree.node_count(), tree.levels())
    }

    fn node_at(&self, search: usize, address: u32) -> Option<Node> {
        let Placed { case, places, .. } = &self.cases[search / 2];
        case.tree.nodes().find(|node| places[node.index()].address == address)
    }

    fn nodes(&self, search: usize) -> usize {
        self.case(search).tree.node_count()
    }

    fn expected(&self, search: usize, kernel: &Kernel) -> Expected {
        let Placed { places, .. } = &self.cases[search / 2];
        let Reference { nodes, end } = self.reference(search);
        let is_child = |parent: Node, node: Node| places[node.index()].parent == Some(parent);
        let place = |node: Node| {
            let Spot { address, level, parent, .. } = places[node.index()];
            // Kernels have the key of the parent.
            let key = parent.map_or(0, |parent| places[parent.index()].key);
            Place { address, depth: level, key: key.into() }
        };
        let leaves = nodes.iter().filter(|node| node.is_leaf()).count();
        Expected::of_wide(events(nodes, kernel, is_child, place), (*end, leaves))
    }

    fn buffers(&self, _: &Kernel) -> [&wgpu::Buffer; 4] {
        self.buffers.each_ref()
    }

    fn task_words(&self, _: &Kernel, searches: &[usize]) -> Vec<u32> {
        let words = searches.iter().flat_map(|&search| {
            let Placed { case, places, head, is_changing, .. } = &self.cases[search / 2];
            let root = places[case.tree.root().index()].address;
            head.words(root, u32::from(search % 2 == 0) | u32::from(*is_changing) << 1)
        });
        words.collect()
    }
}

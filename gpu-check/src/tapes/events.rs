//! The expected events of kernels, from the oracle.

use std::{array, fmt};

use stackless_bvh::event::Trace;
use stackless_bvh::generate::{Outcome, Search};
use stackless_bvh::oracle;
use stackless_bvh::order::Pruning;
use stackless_bvh::traverse::{Laine, Method, Test, traverse};
use stackless_bvh::tree::{Keys, Node, Topology as _, Tree};

use super::{Case, Searches};
use crate::kernel::Kernel;

/// Number of words that `record_events.wgsl` writes for a visit: the words of an event, trail and register.
pub const RECORDED: usize = 9;

/// Number of words of an event: address, one more than the levels of a backtrack, key.
const WORDS: usize = 5;

/// The reference traversals of kernels, with different traces.
const REFERENCES: [Method; 7] = [
    Method::Stack,
    Method::HashedDisjoint,
    Method::StackT0,
    Method::Laine0,
    Method::Laine1,
    Method::Laine4,
    Method::Laine8,
];

/// Traces and outcomes of a case, by reference and query.
#[derive(Debug)]
pub(super) struct References {
    keys: Keys,
    found: Vec<[(Trace, Outcome); 2]>,
}

impl References {
    pub(super) fn of(case: &Case) -> Self {
        let found = REFERENCES.map(|method| [false, true].map(|any| reference(case, method, any))).into();
        Self { keys: Keys::of(&case.tree), found }
    }
}

fn reference(Case { tree, tape, .. }: &Case, method: Method, any: bool) -> (Trace, Outcome) {
    let (mut search, mut trace) = (Search::new(tree, tape, any), Trace::default());
    match method {
        // After a restart, decisions may be narrower, so these traversals have separate traces (D-16). The growing word
        // has no highest bit, and 127 edges are enough here.
        Method::Laine0 => drop(Laine::<0, u128, _>::new(tree).map(|c| traverse(c, &mut search, &mut trace))),
        Method::Laine1 => drop(Laine::<1, u128, _>::new(tree).map(|c| traverse(c, &mut search, &mut trace))),
        Method::Laine4 => drop(Laine::<4, u128, _>::new(tree).map(|c| traverse(c, &mut search, &mut trace))),
        Method::Laine8 => drop(Laine::<8, u128, _>::new(tree).map(|c| traverse(c, &mut search, &mut trace))),
        _ => {
            let pruning = match method.test() {
                Test::Disjoint => Pruning::Disjoint,
                Test::Distance => Pruning::Distance,
                _ => Pruning::Never,
            };
            oracle::traverse_pruned(tree, tree.root(), pruning, &mut search, &mut trace);
        }
    }
    (trace, search.outcome)
}

/// The expected records and outcome of a kernel.
#[derive(Clone, Debug)]
pub struct Expected {
    events: Vec<[u32; WORDS]>,
    outcome: Option<(u32, usize)>,
    /// The name of the outcome.
    named: &'static str,
    any: bool,
}

impl Expected {
    pub(super) fn new(
        tree: &Tree,
        references: &References,
        any: bool,
        kernel: &Kernel,
        address: impl Fn(Node) -> u32,
    ) -> Self {
        // Traversals that do not prune or restart have the trace of the stack.
        let at = REFERENCES.iter().position(|&of| Some(of) == kernel.method()).unwrap_or(0);
        let (trace, outcome) = &references.found[at][usize::from(any)];
        let keys = &references.keys;
        let place = |node: Node| {
            let slot = tree.slot(node);
            Place { address: address(node), depth: keys.depth(slot), key: keys.key(slot) }
        };
        let is_child = |parent, node| tree.children(parent).contains(&node);
        let events = events(trace.nodes(), kernel, is_child, place);
        Self { events, outcome: outcome.hit, named: "hit (distance, slot)", any }
    }

    /// The expected outcome of a search through a wide tree: its end, and the number of visited leaves.
    pub(super) const fn of_wide(events: Vec<[u32; WORDS]>, outcome: (u32, usize)) -> Self {
        Self { events, outcome: Some(outcome), named: "(end, leaves)", any: false }
    }

    /// Whether these 8 words are the result of a correct kernel: the hit, and the number and the hash of the events.
    pub(super) fn agrees(&self, result: &[u32], kernel: &Kernel) -> bool {
        let is_hit_right = if kernel.keeps_order() { self.has_hit(result) } else { self.may_have_hit(result) };
        is_hit_right
            && (!kernel.keeps_order()
                || (result[3] as usize == self.events.len() && [result[4], result[5]] == hash(&self.events)))
    }

    fn has_hit(&self, result: &[u32]) -> bool {
        match self.outcome {
            Some((t, slot)) => (result[0], result[1] as usize, result[2]) == (t, slot, 1),
            None => result[2] == 0,
        }
    }

    /// In another order, any-hit searches may find another hit first.
    fn may_have_hit(&self, result: &[u32]) -> bool {
        if self.any { (result[2] == 1) == self.outcome.is_some() } else { self.has_hit(result) }
    }

    /// The first difference between recorded and expected events.
    pub(super) fn difference(
        &self,
        batch: &impl Searches,
        search: usize,
        result: &[u32],
        recorded: &[u32],
    ) -> Difference {
        // The first word is the queue of persistent kernels.
        let (recorded, _) = recorded.get(1..).unwrap_or_default().as_chunks::<RECORDED>();
        let visits = recorded.iter().take(result[3] as usize);
        let recorded: Vec<[u32; WORDS]> = visits.map(|words| array::from_fn(|i| words[i])).collect();
        let at = self.events.iter().zip(&recorded).position(|(a, b)| a != b);
        let at = at.unwrap_or(self.events.len().min(recorded.len()));
        let show =
            |events: &[[u32; WORDS]]| events.get(at).map_or("nothing".to_owned(), |event| show(batch, search, event));
        Difference {
            search: batch.describe(search),
            visit: at,
            expected: show(&self.events),
            recorded: show(&recorded),
            named: self.named,
            outcome: format!("{:?}", self.outcome),
            outcome_recorded: format!("{:?}", (result[2] == 1).then_some((result[0], result[1]))),
        }
    }
}

fn show(batch: &impl Searches, search: usize, &[address, levels, key, key1, key2]: &[u32; WORDS]) -> String {
    let node = batch.node_at(search, address).map_or(format!("address {address:#x}"), |node| format!("{node:?}"));
    let key = u128::from(key) | u128::from(key1) << 32 | u128::from(key2) << 64;
    let back = if levels > 0 { format!("backtrack {} to ", levels - 1) } else { String::new() };
    let key = if key > 0 { format!(" with key {key:b}") } else { String::new() };
    format!("{back}{node}{key}")
}

/// The first event that differs between a kernel and its reference, and the outcomes.
#[derive(Clone, Debug)]
pub struct Difference {
    search: String,
    visit: usize,
    expected: String,
    recorded: String,
    named: &'static str,
    outcome: String,
    outcome_recorded: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { search, visit, expected, recorded, named, outcome, outcome_recorded } = self;
        writeln!(f, "{search}")?;
        writeln!(f, "  visit {visit}: expected {expected}, recorded {recorded}")?;
        write!(f, "  {named}: expected {outcome}, found {outcome_recorded}")
    }
}

/// The place of a node.
pub(super) struct Place {
    /// Its address in a kernel.
    pub(super) address: u32,
    /// Edges from the root.
    pub(super) depth: u32,
    /// The kernel's key at the node, if it has keys.
    pub(super) key: u128,
}

/// The expected record of these visits.
pub(super) fn events(
    nodes: &[Node],
    kernel: &Kernel,
    is_child: impl Fn(Node, Node) -> bool,
    place: impl Fn(Node) -> Place,
) -> Vec<[u32; WORDS]> {
    let mut before: Option<Node> = None;
    let event = |&node: &Node| {
        let Place { address, depth, key } = place(node);
        let back = before.filter(|&before| before.is_leaf() || !is_child(before, node));
        before = Some(node);
        let levels = back.map_or(0, |before| place(before).depth - depth + 1);
        let key = if kernel.has_keys() { key } else { 0 };
        let levels = if kernel.has_levels() { levels } else { 0 };
        [address, levels, key as u32, (key >> 32) as u32, (key >> 64) as u32]
    };
    nodes.iter().map(event).collect()
}

/// Computes the hash of `record_hash.wgsl`.
fn hash(events: &[[u32; WORDS]]) -> [u32; 2] {
    let mut hash = [0_u32; 2];
    for &word in events.iter().flatten() {
        let a = (hash[0] ^ word).wrapping_mul(0x9e37_79b1);
        let b = hash[1].wrapping_add(word).wrapping_mul(0x85eb_ca77);
        hash = [a ^ a >> 15, b ^ b >> 13];
    }
    hash
}

//! A traversal step by step, as a page for the browser.
//!
//! [`record`] runs a traversal over a [`Case`] and keeps what can be seen at each visit: the words of its state, the
//! register, what the record of the node names, what the search decides, and where the next node comes from. It is
//! observed: links and tables are read through wrappers that take notes. Each recording is compared with the oracle's,
//! and the nodes that the oracle has postponed stand beside the words that are to say the same. [`page()`] puts
//! recordings into one HTML file, whose script only draws.

#![forbid(unsafe_code)]

mod clauses;
mod error;
mod judge;
mod lookup;
mod observe;
mod ray;
mod text;
pub mod wide;

pub use error::ExplainError;
pub use lookup::{Entry, HashLookup, Table};
pub use ray::of_ray;

use std::collections::BTreeMap;

use serde::Serialize;

use clauses::Clause;
use judge::Judge;
use observe::Log;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::traverse::Method;
use stackless_bvh::tree::{Keys, Node, Topology, Tree};
use stackless_check::Case;

/// Most nodes of a tree that is put on a page.
pub const MOST_NODES: usize = 2000;

/// Deepest tree, in edges, that is put on a page: all traversals carry it in words of 128 bits.
pub const DEEPEST: u32 = 126;

/// Traversals that a page has if none are named, the one it opens with first.
pub const USUAL: [Method; 9] = [
    Method::Hashed,
    Method::HashOnly,
    Method::Uncle,
    Method::Afra,
    Method::Sparse,
    Method::ImplicitA,
    Method::Laine1,
    Method::Hapala,
    Method::Stack,
];

/// One traversal of a case, visit by visit. Nodes are given by slot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recording {
    /// Name of the traversal.
    pub method: &'static str,
    /// How it works, in a sentence.
    pub about: &'static str,
    /// The clause that defines it.
    pub clause: &'static str,
    /// Bytes of its state in words of 32 bits.
    pub state_bytes: usize,
    /// What the record of a node names besides its children; empty if the traversal needs nothing.
    pub links: Vec<&'static str>,
    /// The hash table, where it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// The visits.
    pub steps: Vec<Step>,
}

/// One visit, and the way to the next. Words are in binary, without leading zeros.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// The node.
    pub node: u32,
    /// It has been visited before, and is passed again on the way down from the root.
    #[serde(skip_serializing_if = "is_false")]
    pub restart: bool,
    /// The node's key, where the traversal carries it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// The trail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trail: Option<String>,
    /// Barringer & Akenine-Möller's counter, with a leading one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counter: Option<String>,
    /// The second trail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub disjoint: Option<String>,
    /// Of a wide tree: the pending sets of all levels, where they are kept one by one and are no trail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sets: Option<String>,
    /// Of a wide tree: what else is kept of each level, from the root's on, by name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rows: Vec<(&'static str, Vec<String>)>,
    /// What the register holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub register: Option<u32>,
    /// What the record of the node names: one for each of [`Recording::links`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links: Vec<Option<u32>>,
    /// The oracle's postponed nodes; the last one comes next.
    pub stack: Vec<u32>,
    /// Those of them that are beyond the end of the search by now, and will not be visited.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beyond: Vec<u32>,
    /// At an inner node, what the search decides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decision: Option<String>,
    /// The wanted children, the first one first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub wanted: Vec<u32>,
    /// Something better than before is found in this leaf.
    #[serde(skip_serializing_if = "is_false")]
    pub hit: bool,
    /// Where it goes from here; `None` at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<Next>,
    /// What happens here, in words.
    pub text: String,
    /// The clauses by which it happens.
    pub clauses: Vec<&'static str>,
}

/// The way to the next node.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Next {
    /// The node.
    pub node: u32,
    /// Backtracking: how many levels up the ancestor is whose sibling is next.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub levels: Option<u32>,
    /// Where its address comes from.
    pub by: By,
    /// The lookup, where a perfect hash was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lookup: Option<HashLookup>,
    /// Nodes whose records were read on the way, this one not counted.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<u32>,
}

/// Where the address of the next node comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum By {
    /// The node's own record names it: a child.
    Child,
    /// Of a wide tree: the record of the parent, where the traversal still is.
    Parent,
    /// Of a wide tree: the record of an ancestor, which the record of the parent names.
    Ancestor,
    /// The register.
    Register,
    /// The record names it as the uncle.
    Uncle,
    /// The record names it as the grand uncle.
    GrandUncle,
    /// Records of other nodes, along which the traversal climbs.
    Climb,
    /// The perfect hash.
    Table,
    /// Arithmetic, or a table that compares keys.
    Key,
    /// A stack.
    Stack,
    /// A skip pointer.
    Skip,
    /// None yet: the traversal starts again at the root.
    Restart,
}

/// What a page is made of.
#[derive(Serialize)]
struct Page<'a> {
    title: &'a str,
    /// Children of each node.
    children: Vec<Option<Vec<u32>>>,
    /// Keys of the nodes in binary, and their names.
    keys: Vec<String>,
    names: Vec<String>,
    /// Bits of a key for each level, and of a trail.
    #[serde(rename = "keyBits")]
    key_bits: u32,
    #[serde(rename = "trailBits")]
    trail_bits: u32,
    /// Base of the names.
    base: u32,
    methods: Vec<Recording>,
    /// Traversals that do not run on this case, each with the reason.
    left_out: Vec<String>,
    /// The clauses that the recordings name, by id.
    clauses: BTreeMap<&'static str, Clause>,
}

const TEMPLATE: &str = include_str!("page.html");

/// The page of a case: one HTML file that needs nothing else. It opens with the first of the traversals.
///
/// Traversals that do not run on this case are left out, and the page says why.
///
/// ```
/// use stackless_explain as explain;
/// use stackless_bvh::traverse::Method;
///
/// let html = explain::page("an example", &explain::example(), &[Method::Hashed, Method::Stack])?;
/// assert!(html.starts_with("<!doctype html>"));
/// # Ok::<(), explain::ExplainError>(())
/// ```
///
/// # Errors
/// [`ExplainError`], if the tree is too large, a traversal differs from its oracle, or none runs.
pub fn page(title: &str, case: &Case, methods: &[Method]) -> Result<String, ExplainError> {
    let (methods, left_out) = recordings(methods, |method| record(case, method))?;
    let keys = Keys::of(&case.tree);
    let keys: Vec<u128> = (0..case.size()).map(|slot| keys.key(slot)).collect();
    let page = Page {
        title,
        children: case.tree.to_children().into_iter().map(|pair| pair.map(Vec::from)).collect(),
        keys: keys.iter().map(|key| format!("{key:b}")).collect(),
        names: keys.iter().map(u128::to_string).collect(),
        key_bits: 1,
        trail_bits: 1,
        base: 10,
        clauses: clauses::named(&methods),
        methods,
        left_out,
    };
    page.to_html()
}

impl Page<'_> {
    fn to_html(&self) -> Result<String, ExplainError> {
        // No text can end the element in which it stands.
        let data = serde_json::to_string(self)?.replace('<', "\\u003c");
        Ok(TEMPLATE.replace("{{data}}", &data))
    }
}

/// The recordings of the traversals that run, and why the others do not.
fn recordings<M: Copy>(
    methods: &[M],
    record: impl Fn(M) -> Result<Recording, ExplainError>,
) -> Result<(Vec<Recording>, Vec<String>), ExplainError> {
    let (mut recordings, mut left_out, mut why) = (Vec::new(), Vec::new(), ExplainError::NoMethod);
    for &method in methods {
        match record(method) {
            Ok(recording) => recordings.push(recording),
            Err(error) if error.is_of_method() => {
                left_out.push(error.to_string());
                why = error;
            }
            Err(error) => return Err(error),
        }
    }
    if recordings.is_empty() { Err(why) } else { Ok((recordings, left_out)) }
}

/// Runs a traversal over a case, in words of 128 bits, and compares each visit with the oracle's. `[TRAVERSE-1]`
///
/// # Errors
/// [`ExplainError`].
pub fn record(case: &Case, method: Method) -> Result<Recording, ExplainError> {
    let depth = case.tree.depth();
    refuse_large(case.size(), depth, DEEPEST)?;
    if method.restarts() && !case.is_static() {
        return Err(ExplainError::Changing { method });
    }
    let log = Log::default();
    let table = observe::run(case, method, &log)?;
    let steps = log.into_steps();
    let judge = Judge::new(case, method);
    let stacks = judge.compare(&steps)?;
    let (about, clause) = (method.help(), method.clause());
    let visits = (0..steps.len()).map(|visit| judge.step(&steps, visit, &stacks[visit])).collect();
    let links = observe::link_names(method).to_vec();
    let state_bytes = method.state_bytes::<u32>(depth);
    Ok(Recording { method: method.name(), about, clause, state_bytes, links, table, steps: visits })
}

/// Refuses what cannot be drawn.
const fn refuse_large(nodes: usize, depth: u32, limit: u32) -> Result<(), ExplainError> {
    if nodes > MOST_NODES {
        return Err(ExplainError::TooLarge { nodes });
    }
    if depth > limit {
        return Err(ExplainError::TooDeep { depth, limit });
    }
    Ok(())
}

/// The example of Binder & Keller's Fig. 2: from the node with key 10110 = 22, with the trail 1000, backtracking goes
/// to key 11 = 3. `[TRAIL-4]`
///
/// The tree is that of spec/traversal.md. Node 11 takes its right child first, so that the register is spent on 22 and
/// the address of 3 has to come from the table.
pub fn example() -> Case {
    let inner = [(0, [1, 2]), (1, [3, 4]), (2, [5, 6]), (4, [7, 8]), (6, [9, 10]), (8, [11, 12])];
    let mut children = [None; 13];
    for (node, pair) in inner {
        children[node] = Some(pair);
    }
    let tree = Tree::from_generated(&children);
    let mut cells = vec![Cell::default(); children.len()];
    // Keys 4 and 10 are missed; 3 and 11 take the right child first, also where children are ordered by sign.
    for node in [3, 7] {
        cells[node].miss = true;
    }
    for node in [2, 8] {
        (cells[node].right_first, cells[node].axis) = (true, 1);
    }
    let tape = Tape::from_cells(&tree, cells).unwrap_or_default();
    Case { tree, tape, any: false, octant: 2 }
}

/// A node as pages name it.
fn slot(tree: &Tree, node: Node) -> u32 {
    tree.slot(node) as u32
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_false(value: &bool) -> bool {
    !value
}

#[cfg(test)]
mod tests;

//! Step-by-step pages of traversals, for browsers.
//!
//! [`record`] runs a traversal over a [`Case`] and stores the observations of each visit: the words of its state, the
//! register, the links of the node, the decision of the search, and the source of the next node's address. The
//! traversal itself is unmodified: wrappers of links and tables record their use. Each recording is compared with the
//! oracle's, and the page shows the oracle's postponed nodes next to the words that encode them. [`page()`] puts
//! recordings into one HTML file, whose script only draws.

#![forbid(unsafe_code)]

mod clauses;
mod error;
mod judge;
mod lookup;
mod observe;
mod plain;
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

/// The maximum number of nodes of a tree on a page.
pub const MOST_NODES: usize = 2000;

/// The greatest depth of a tree on a page, in edges. All traversals support it with 128-bit words.
pub const DEEPEST: u32 = 126;

/// The default traversals of a page, in their order.
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
    /// A description in one sentence.
    pub about: &'static str,
    /// The clause that defines it.
    pub clause: &'static str,
    /// Bytes of its state in words of 32 bits.
    pub state_bytes: usize,
    /// The links in the record of a node, in addition to its children; empty if the traversal needs none.
    pub links: Vec<&'static str>,
    /// The hash table, if the traversal has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// The visits.
    pub steps: Vec<Step>,
}

/// One visit and the step to the next. Words are in binary, without leading zeros.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// The node.
    pub node: u32,
    /// The visit is a repetition, on the way down after a restart.
    #[serde(skip_serializing_if = "is_false")]
    pub restart: bool,
    /// The node's key, if it is part of the state.
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
    /// In wide trees: the pending sets of all levels, if they are stored one by one instead of as a trail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sets: Option<String>,
    /// In wide trees: other values stored per level, from the root's on, by name.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rows: Vec<(&'static str, Vec<String>)>,
    /// The node in the register.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub register: Option<u32>,
    /// The linked nodes: one for each of [`Recording::links`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links: Vec<Option<u32>>,
    /// The oracle's postponed nodes. The last one is visited next.
    pub stack: Vec<u32>,
    /// The postponed nodes that are now beyond the end of the search, and will not be visited.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beyond: Vec<u32>,
    /// The decision of the search, at an inner node.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decision: Option<String>,
    /// The wanted children, the first one first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub wanted: Vec<u32>,
    /// The search finds a better hit in this leaf.
    #[serde(skip_serializing_if = "is_false")]
    pub hit: bool,
    /// The step to the next node; `None` at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<Next>,
    /// A description of the visit.
    pub text: String,
    /// The clauses that apply.
    pub clauses: Vec<&'static str>,
}

/// The step to the next node.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Next {
    /// The node.
    pub node: u32,
    /// For a backtrack: the level of the ancestor whose sibling is next.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub levels: Option<u32>,
    /// The source of its address.
    pub by: By,
    /// The lookup in the perfect hash, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lookup: Option<HashLookup>,
    /// The other nodes whose records were read during the step.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub way: Vec<u32>,
}

/// The source of the next node's address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum By {
    /// The node's own record, for a child.
    Child,
    /// In wide trees: the record of the parent, where the traversal still is.
    Parent,
    /// In wide trees: the record of an ancestor, which is a link of the parent.
    Ancestor,
    /// The register.
    Register,
    /// The link to the uncle.
    Uncle,
    /// The link to the grand uncle.
    GrandUncle,
    /// The records of other nodes on a climb.
    Climb,
    /// The perfect hash.
    Table,
    /// Arithmetic, or a table that compares keys.
    Key,
    /// A stack.
    Stack,
    /// A skip pointer.
    Skip,
    /// No address: the traversal starts again at the root.
    Restart,
}

/// Recorded traversals of a tree: as a page for the browser, or as text.
#[derive(Clone, Debug, Serialize)]
pub struct Page {
    title: String,
    /// Children of each node.
    children: Vec<Option<Vec<u32>>>,
    /// Keys of the nodes in binary, and their names.
    keys: Vec<String>,
    names: Vec<String>,
    /// Bits per level of a key and of a trail.
    #[serde(rename = "keyBits")]
    key_bits: u32,
    #[serde(rename = "trailBits")]
    trail_bits: u32,
    /// The base of the names.
    base: u32,
    methods: Vec<Recording>,
    /// The omitted traversals, each with the reason.
    left_out: Vec<String>,
    /// The cited clauses, by id.
    clauses: BTreeMap<&'static str, Clause>,
}

const TEMPLATE: &str = include_str!("page.html");

/// Records traversals of a case. The page opens with the first of them.
///
/// Traversals that do not support this case are omitted, and the page lists the reasons.
///
/// ```
/// use stackless_explain as explain;
/// use stackless_bvh::traverse::Method;
///
/// let page = explain::page("an example", &explain::example(), &[Method::Hashed, Method::Stack])?;
/// assert!(page.to_html()?.starts_with("<!doctype html>"));
/// assert!(page.tree().starts_with("1\n  2\n    4 leaf\n"));
/// assert!(page.traversals().contains("\n   5  22  key 10110, trail 1000, "));
/// # Ok::<(), explain::ExplainError>(())
/// ```
///
/// # Errors
/// [`ExplainError`], if the tree is too large, a traversal differs from its oracle, or none runs.
pub fn page(title: &str, case: &Case, methods: &[Method]) -> Result<Page, ExplainError> {
    let (methods, left_out) = recordings(methods, |method| record(case, method))?;
    let keys = Keys::of(&case.tree);
    let keys: Vec<u128> = (0..case.size()).map(|slot| keys.key(slot)).collect();
    Ok(Page {
        title: title.to_owned(),
        children: case.tree.to_children().into_iter().map(|pair| pair.map(Vec::from)).collect(),
        keys: keys.iter().map(|key| format!("{key:b}")).collect(),
        names: keys.iter().map(u128::to_string).collect(),
        key_bits: 1,
        trail_bits: 1,
        base: 10,
        clauses: clauses::named(&methods),
        methods,
        left_out,
    })
}

impl Page {
    /// Returns the number of nodes of the tree.
    pub fn nodes(&self) -> usize {
        self.children.len()
    }

    /// Returns one self-contained HTML file.
    ///
    /// # Errors
    /// [`ExplainError::Json`].
    pub fn to_html(&self) -> Result<String, ExplainError> {
        // Escaped, so that no text can close its element.
        let data = serde_json::to_string(self)?.replace('<', "\\u003c");
        Ok(TEMPLATE.replace("{{data}}", &data))
    }
}

/// Returns the recordings of the supported traversals, and the reasons for omitting the unsupported ones.
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

/// Runs a traversal over a case with 128-bit words, and compares each visit with the oracle's. `[TRAVERSE-1]`
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

/// Rejects trees that are too large or too deep to draw.
const fn refuse_large(nodes: usize, depth: u32, limit: u32) -> Result<(), ExplainError> {
    if nodes > MOST_NODES {
        return Err(ExplainError::TooLarge { nodes });
    }
    if depth > limit {
        return Err(ExplainError::TooDeep { depth, limit });
    }
    Ok(())
}

/// Returns the example of Binder & Keller's Fig. 2: from the node with key 10110 = 22 and the trail 1000, backtracking
/// goes to key 11 = 3. `[TRAIL-4]`
///
/// The tree is that of spec/traversal.md. Node 11 takes its right child first, so the register is used up for 22, and
/// the address of 3 has to come from the table.
pub fn example() -> Case {
    let inner = [(0, [1, 2]), (1, [3, 4]), (2, [5, 6]), (4, [7, 8]), (6, [9, 10]), (8, [11, 12])];
    let mut children = [None; 13];
    for (node, pair) in inner {
        children[node] = Some(pair);
    }
    let tree = Tree::from_generated(&children);
    let mut cells = vec![Cell::default(); children.len()];
    // Keys 4 and 10 are missed. Keys 3 and 11 take the right child first, also in the order by sign.
    for node in [3, 7] {
        cells[node].miss = true;
    }
    for node in [2, 8] {
        (cells[node].right_first, cells[node].axis) = (true, 1);
    }
    let tape = Tape::from_cells(&tree, cells).unwrap_or_default();
    Case { tree, tape, any: false, octant: 2 }
}

/// Returns the number of a node on pages.
fn slot(tree: &Tree, node: Node) -> u32 {
    tree.slot(node) as u32
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_false(value: &bool) -> bool {
    !value
}

#[cfg(test)]
mod tests;

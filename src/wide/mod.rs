//! Wide trees: up to 2, 4 or 8 children per node, traversed without a stack.
//!
//! A traversal of a wide tree keeps, for each level above the node, the *set* of children that are still pending. The
//! deepest non-empty set determines the number of levels to climb: constant-time backtracking by keys (Binder & Keller
//! 2016), for more than two children. The ancestor there is found by parents (Áfra & Szirmay-Kalos 2014), by references
//! in the node's record, or by a perfect hash. spec/wide.md has the clauses; trees of two children are the case A = 2.
//!
//! As in [`traverse`](mod@crate::traverse), there is one loop ([`traverse()`]), one table of traversals ([`Method`]),
//! one oracle, and no geometry.
//!
//! ```
//! use stackless_bvh::event::Trace;
//! use stackless_bvh::order::Flow;
//! use stackless_bvh::tree::Node;
//! use stackless_bvh::wide::{Method, Search, Tables, Topology, Tree, Wanted};
//!
//! /// Wants all children, those in high slots first.
//! struct FromTheRight<'t>(&'t Tree<4>);
//! impl Search<4> for FromTheRight<'_> {
//!     type Ranks = [u32; 4];
//!     fn ask(&mut self, node: Node) -> Wanted<[u32; 4]> {
//!         let ranks = std::array::from_fn(|slot| (3 - slot as u32) << 2 | slot as u32);
//!         Wanted { set: self.0.children(node), ranks }
//!     }
//!     fn leaf(&mut self, _: Node) -> Flow {
//!         Flow::Continue
//!     }
//!     fn end(&self) -> u32 {
//!         u32::MAX
//!     }
//! }
//!
//! // Node 0 has the children 1, 2 and 3. Node 2 has the children 4 and 5.
//! let tree = Tree::<4>::new(&[Some(&[1, 2, 3]), None, Some(&[4, 5]), None, None, None])?;
//! let tables = Tables::new(&tree);
//! let mut trace = Trace::default();
//! Method::Hashed.run(&tree, &tables, &mut FromTheRight(&tree), &mut trace)?;
//! assert_eq!(trace.nodes().iter().map(|node| node.index()).collect::<Vec<_>>(), [0, 3, 2, 5, 4, 1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod keys;
mod links;
pub mod oracle;
mod pending;
pub(crate) mod pending_store;
mod restart;
mod search;
mod stack;
pub(crate) mod table;
mod tree;

pub use keys::{ancestor_key, child_key, key_level};
pub use links::{Hashed, Link, Parents, Recorded};
pub use pending::Pending;
pub(crate) use pending_store::StateView;
pub use pending_store::{PendingStore, Trail, back, leave};
pub use restart::Restart;
pub use search::{RankedChild, Ranks, Search, Wanted, is_beyond};
pub use stack::{Memory, Stack};
pub(crate) use table::{Context, Scratch, Supply};
pub use table::{Method, Tables, Unsupported};
pub use tree::{Topology, Tree, TreeError};

use core::ops::ControlFlow;

use crate::event::{Recorder, State};
use crate::order::Flow;
use crate::tree::Node;

/// The state of one traversal of a wide tree.
///
/// It holds no tree: callers pass the same tree every time. So tree and search access the same nodes, and each node is
/// resolved once.
pub trait Cursor<const A: usize> {
    /// Whether the cursor starts again from the root, and passes nodes that it has visited.
    const RESTARTS: bool = false;

    /// Returns to the root, for the next search.
    fn reset(&mut self, tree: &impl Topology<A>);

    /// Returns the inner node for the next query of the search.
    fn node(&self) -> Node;

    /// Chooses the next child after a query of [`node`](Self::node): the first child that the search wants; after a
    /// repeated query, the first pending one. If the search wants none, it is the [next](Self::next) pending child.
    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>;

    /// Returns the next pending child.
    fn next<T: Topology<A>, S: Search<A>>(&mut self, tree: &T, search: &mut S) -> Next;

    /// Descends to the last returned inner node.
    fn enter(&mut self, node: Node);

    /// Called when the [end](Search::end) has decreased.
    fn shortened(&mut self) {}

    /// Returns whether [`node`](Self::node) has been visited before.
    fn is_restarting(&self) -> bool {
        false
    }

    /// Returns the stored state of a node. The node is `up` levels above the parent of the last returned child, or
    /// above the node [entered](Self::enter) since; 0 is that node itself. `None` if the state is not stored by levels.
    /// For display and comparison.
    fn words(&self, _up: u32) -> Option<StateView> {
        None
    }

    /// Returns the key of [`node`](Self::node), if the cursor has it.
    fn key(&self) -> Option<u64> {
        None
    }
}

/// The next action of a cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Visit a child.
    Child(Node),
    /// Query the search about its [node](Cursor::node) again.
    Ask,
    /// No node is left.
    End,
}

impl From<Option<Node>> for Next {
    #[inline(always)]
    fn from(child: Option<Node>) -> Self {
        child.map_or(Self::End, Self::Child)
    }
}

/// Runs a traversal to its end, in the loop that all algorithms share. `[WIDE-7]`
#[inline(always)]
pub fn traverse<const A: usize, T, C, S>(tree: &T, mut cursor: C, search: &mut S, recorder: &mut impl Recorder)
where
    T: Topology<A>,
    C: Cursor<A>,
    S: Search<A>,
{
    if visit(recorder, cursor.node()) == Flow::Stop {
        return;
    }
    loop {
        let wanted = search.ask(cursor.node());
        if !advance(tree, &mut cursor, wanted, search, recorder) {
            return;
        }
    }
}

/// Runs one iteration of the loop: from the answer about a node to the next node to query. Returns `false` at the end.
///
/// Callers that interleave several rays query one ray while the nodes of the other rays are being loaded.
#[inline(always)]
pub fn advance<const A: usize, T, C, S>(
    tree: &T,
    cursor: &mut C,
    mut wanted: Wanted<S::Ranks>,
    search: &mut S,
    recorder: &mut impl Recorder,
) -> bool
where
    T: Topology<A>,
    C: Cursor<A>,
    S: Search<A>,
{
    if !S::SORTED {
        // [WIDE-6]
        let node = cursor.node();
        let leaves = wanted.set & tree.leaves(node);
        wanted.set ^= leaves;
        let mut left = if cursor.is_restarting() { 0 } else { leaves };
        while left != 0 {
            let leaf = tree.child(node, left.trailing_zeros());
            left &= left - 1;
            if visit(recorder, leaf) == Flow::Stop || search.leaf(leaf) == Flow::Stop {
                return false;
            }
        }
    }
    let mut arrived = {
        let next = cursor.choose(tree, wanted, search);
        arrive(cursor, next, recorder)
    };
    loop {
        let leaf = match arrived {
            ControlFlow::Continue(leaf) => leaf,
            ControlFlow::Break(goes_on) => return goes_on,
        };
        let end = search.end();
        if search.leaf(leaf) == Flow::Stop {
            return false;
        }
        if search.end() < end {
            cursor.shortened();
        }
        let next = cursor.next(tree, search);
        arrived = arrive(cursor, next, recorder);
    }
}

/// Enters the next node if it is an inner node, which ends the iteration. Otherwise the iteration continues with a
/// leaf.
///
/// It is also called before the loop over leaves: so most iterations, which go directly to an inner node, never start
/// that loop.
#[inline(always)]
fn arrive<const A: usize, C: Cursor<A>>(
    cursor: &mut C,
    next: Next,
    recorder: &mut impl Recorder,
) -> ControlFlow<bool, Node> {
    let node = match next {
        Next::Child(node) => node,
        Next::Ask => return ControlFlow::Break(true),
        Next::End => return ControlFlow::Break(false),
    };
    if !(C::RESTARTS && cursor.is_restarting()) && visit(recorder, node) == Flow::Stop {
        return ControlFlow::Break(false);
    }
    if node.is_leaf() {
        return ControlFlow::Continue(node);
    }
    cursor.enter(node);
    ControlFlow::Break(true)
}

#[inline(always)]
fn visit(recorder: &mut impl Recorder, node: Node) -> Flow {
    recorder.visit(node, || State::<u64>::of(node))
}

//! The traversals: one loop, and one file for each way to find the next node.
//!
//! A [`Cursor`] is the state of one traversal. The loop of [`traverse`] visits the cursor's node, and tells it to
//! descend or to backtrack; nothing else drives any algorithm of this crate. Geometry lives in the [`Visitor`],
//! topology in the [`Topology`](crate::tree::Topology), and what an algorithm needs beyond the children in the tables
//! that its constructor asks for. A constructor refuses a tree that is too deep for its word before the first step.

mod afra;
mod by_key;
mod complete;
mod glassner;
mod hapala;
mod hash_only;
mod hashed;
mod implicit_a;
mod implicit_b;
mod laine;
mod layout;
mod left_first;
mod marks;
mod method;
mod pause;
mod pruning_stack;
mod register;
mod skip;
mod sparse;
mod split;
mod stack;
mod states;
mod supply;
mod table;
mod tables;
mod uncle;
mod unsupported;
mod word;

pub use afra::Afra;
pub use by_key::ByKey;
pub use complete::{Complete, NotComplete};
pub use glassner::Glassner;
pub use hapala::Hapala;
pub use hash_only::HashOnly;
pub use hashed::Hashed;
pub use implicit_a::{ImplicitA, ImplicitA1};
pub use implicit_b::{ImplicitB, ImplicitB1};
pub use laine::Laine;
pub use layout::Layout;
pub use left_first::LeftFirst;
pub use marks::{Disjoint, Marks};
pub use method::{Need, Test};
pub use pause::{
    ByTable, ByWalk, Incomplete, KeyOnly, KeyTrail, Locate, Next, NoSuchKey, Pause, Paused, resume, revisit,
};
pub use pruning_stack::PruningStack;
pub use skip::{Skip, Skips};
pub use sparse::Sparse;
pub use split::{Cuts, Piece, PieceTable, Split};
pub use stack::Stack;
pub use states::{StateError, States};
pub use supply::{Context, PausingContext, Supply};
pub use table::Method;
#[cfg(feature = "rays")]
pub(crate) use tables::Run;
pub use tables::{AuxTables, FromTables, LinkedTree, Tables, VerifiedTables, WithCursor};
pub use uncle::Uncle;
pub use unsupported::Unsupported;
pub use word::{WithWord, WordName, with_word};

use crate::event::{Recorder, State};
use crate::key::KeyWord;
use crate::order::{Descent, Flow, Pruned, Unpruned, Visitor};
use crate::tree::Node;

/// The state of one traversal, on its way through a tree.
pub trait Cursor {
    /// The word of its key and trail.
    type Word: KeyWord;

    /// Whether the cursor starts again from the root and then asks the visitor about nodes it has asked about before.
    ///
    /// The answers may have become narrower in between (a shorter ray), never wider.
    const RESTARTS: bool = false;

    /// Whether it leaves out postponed nodes that are disjoint from what is found. Then descents are marked, and it is
    /// for searches that [allow](Pruned::allows) it.
    const PRUNES: bool = false;

    /// Whether it keeps the distances of postponed nodes.
    const KEEPS_DISTANCES: bool = false;

    /// The node about to be visited.
    fn node(&self) -> Node;

    /// The state, as far as the traversal has one.
    fn state(&self) -> State<Self::Word> {
        State::of(self.node())
    }

    /// Moves to the first wanted child of the current inner node and postpones the other, if both are wanted.
    ///
    /// `descent` wants at least one child. `false` if there is nowhere to go after all (only where
    /// [`RESTARTS`](Self::RESTARTS)): then backtrack.
    fn descend(&mut self, descent: Descent) -> bool;

    /// Moves to the most recently postponed node. `false` if none is left: the traversal is done.
    fn backtrack(&mut self) -> bool;

    /// At a leaf where something was found: forgets all postponed nodes whose descents were marked as disjoint.
    fn prune(&mut self) {}

    /// After a descent that has postponed a node: where that begins ([`Pruned::postponed`]).
    fn keep_distance(&mut self, _: u32) {}

    /// Before backtracking: forgets the most recently postponed nodes that begin beyond the end ([`Pruned::end`]).
    fn drop_beyond(&mut self, _: u32) {}
}

impl<C: Cursor> Cursor for &mut C {
    type Word = C::Word;
    const RESTARTS: bool = C::RESTARTS;
    const PRUNES: bool = C::PRUNES;
    const KEEPS_DISTANCES: bool = C::KEEPS_DISTANCES;

    #[inline]
    fn node(&self) -> Node {
        (**self).node()
    }

    fn state(&self) -> State<C::Word> {
        (**self).state()
    }

    #[inline]
    fn descend(&mut self, descent: Descent) -> bool {
        (**self).descend(descent)
    }

    #[inline]
    fn backtrack(&mut self) -> bool {
        (**self).backtrack()
    }

    #[inline]
    fn prune(&mut self) {
        (**self).prune();
    }

    #[inline]
    fn keep_distance(&mut self, distance: u32) {
        (**self).keep_distance(distance);
    }

    #[inline]
    fn drop_beyond(&mut self, end: u32) {
        (**self).drop_beyond(end);
    }
}

/// Runs a traversal that leaves nothing out to its end. One that prunes does not compile: it asks more of a search
/// ([`traverse_pruned`]).
///
/// Returns what [`traverse_pruned`] returns.
#[inline]
pub fn traverse<C: Cursor>(cursor: C, visitor: &mut impl Visitor, recorder: &mut impl Recorder) -> Option<Next> {
    const { assert!(!C::PRUNES && !C::KEEPS_DISTANCES, "a traversal that prunes asks more: traverse_pruned") };
    traverse_pruned(cursor, &mut Unpruned(visitor), recorder)
}

/// Runs a traversal to its end: the loop that all algorithms share. `[TRAVERSE-1]`
///
/// Where the recorder or the visitor stops it, the answer is what comes next, for a traversal that is to go on later
/// ([`Pause`]; a cursor that is passed by `&mut` has its state). Otherwise `None`.
#[inline]
pub fn traverse_pruned<C: Cursor>(
    mut cursor: C,
    search: &mut impl Pruned,
    recorder: &mut impl Recorder,
) -> Option<Next> {
    loop {
        let node = cursor.node();
        let flow = if C::RESTARTS && cursor.state().is_restarting {
            recorder.revisit(node, || cursor.state())
        } else {
            recorder.visit(node, || cursor.state())
        };
        if flow == Flow::Stop {
            return Some(Next::Visit);
        }
        let descended = if node.is_leaf() {
            let flow = search.leaf(node);
            if C::PRUNES && search.found_at(node) {
                cursor.prune();
            }
            if flow == Flow::Stop {
                return Some(Next::Backtrack);
            }
            false
        } else {
            let descent = if C::PRUNES { search.inner_marked(node) } else { search.inner(node) };
            let descended = !descent.is_neither() && cursor.descend(descent);
            if C::KEEPS_DISTANCES && descent.postpones() {
                cursor.keep_distance(search.postponed(node, descent));
            }
            descended
        };
        if !descended {
            if C::KEEPS_DISTANCES {
                cursor.drop_beyond(search.end());
            }
            if !cursor.backtrack() {
                return None;
            }
        }
    }
}

//! The traversals: one loop, and one file for each algorithm that finds the next node.
//!
//! A [`Cursor`] is the state of one traversal. The loop of [`traverse`] visits the cursor's node, and calls the cursor
//! to descend or to backtrack; it drives all algorithms of this crate. Geometry is in the [`Visitor`], topology in the
//! [`Topology`](crate::tree::Topology). The tables that an algorithm needs in addition to the children are arguments of
//! its constructor. A constructor refuses a tree that is too deep for its word before the first step.

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
pub(crate) mod layout;
mod left_first;
mod marks;
pub(crate) mod method;
pub(crate) mod pause;
mod pruning_stack;
mod register;
mod skip;
mod sparse;
pub(crate) mod split;
mod stack;
mod states;
pub(crate) mod supply;
mod table;
pub(crate) mod tables;
mod uncle;
mod unsupported;
pub(crate) mod word;

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
pub(crate) use layout::Layout;
pub use left_first::LeftFirst;
pub use marks::{Disjoint, Marks};
pub(crate) use method::Need;
pub use method::Test;
pub(crate) use pause::ByWalk;
pub use pause::{Incomplete, KeyOnly, KeyTrail, Next, NoSuchKey, Pause, Paused, resume, revisit};
pub use pruning_stack::PruningStack;
pub use skip::{Skip, Skips};
pub use sparse::Sparse;
pub use split::{Cuts, Split};
pub use stack::Stack;
pub use states::{StateError, States};
pub(crate) use supply::{Context, PausingContext, Supply};
pub use table::Method;
#[cfg(feature = "rays")]
pub(crate) use tables::Run;
pub use tables::Tables;
pub(crate) use tables::{AuxTables, WithCursor};
pub use uncle::Uncle;
pub use unsupported::Unsupported;
pub use word::WordName;
pub(crate) use word::{WithWord, with_word};

use crate::event::{Recorder, State};
use crate::key::KeyWord;
use crate::order::{Descent, Flow, Pruned, Unpruned, Visitor};
use crate::tree::Node;

/// The state of one traversal of a tree.
pub trait Cursor {
    /// The word of its key and trail.
    type Word: KeyWord;

    /// Whether the cursor starts again from the root and then repeats queries of the visitor.
    ///
    /// The answers may have become narrower in between (a shorter ray), never wider.
    const RESTARTS: bool = false;

    /// Whether it skips postponed nodes that are disjoint from the found candidate. Then descents are marked, and it is
    /// for searches that [allow](Pruned::allows) it.
    const PRUNES: bool = false;

    /// Whether it stores the distances of postponed nodes.
    const KEEPS_DISTANCES: bool = false;

    /// Returns the node about to be visited.
    fn node(&self) -> Node;

    /// Returns the state, as far as the traversal has one.
    fn state(&self) -> State<Self::Word> {
        State::of(self.node())
    }

    /// Moves to the first wanted child of the current inner node and postpones the other, if both are wanted.
    ///
    /// `descent` wants at least one child. Returns `false` if there is no child to enter after all (only with
    /// [`RESTARTS`](Self::RESTARTS)): then backtrack.
    fn descend(&mut self, descent: Descent) -> bool;

    /// Moves to the most recently postponed node. Returns `false` if none is left: the traversal is done.
    fn backtrack(&mut self) -> bool;

    /// Drops all postponed nodes whose descents were marked as disjoint. Called at a leaf where something was found.
    fn prune(&mut self) {}

    /// Stores the distance of a postponed node ([`Pruned::postponed`]). Called after the descent that postponed it.
    fn keep_distance(&mut self, _: u32) {}

    /// Drops the most recently postponed nodes that begin beyond the end ([`Pruned::end`]). Called before backtracking.
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

/// Runs a traversal without pruning to its end. A traversal that prunes does not compile: it requires more of a search
/// ([`traverse_pruned`]).
///
/// Returns what [`traverse_pruned`] returns.
#[inline]
pub fn traverse<C: Cursor>(cursor: C, visitor: &mut impl Visitor, recorder: &mut impl Recorder) -> Option<Next> {
    const { assert!(!C::PRUNES && !C::KEEPS_DISTANCES, "a traversal that prunes asks more: traverse_pruned") };
    traverse_pruned(cursor, &mut Unpruned(visitor), recorder)
}

/// Runs a traversal to its end, in the loop that all algorithms share. `[TRAVERSE-1]`
///
/// If the recorder or the visitor stops it, returns the next action of the traversal, for a later resumption
/// ([`Pause`]; a cursor that is passed by `&mut` has its state). Otherwise returns `None`.
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

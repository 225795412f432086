//! The traversals: one loop, and one file for each way to find the next node.
//!
//! A [`Cursor`] is the state of one traversal. The loop of [`traverse`] visits the cursor's node, and tells it to
//! descend or to backtrack; nothing else drives any algorithm of this crate. Geometry lives in the
//! [`Visitor`], topology in the [`Topology`](crate::tree::Topology), and what an algorithm needs beyond the children in
//! the tables that its constructor asks for. A constructor refuses a tree that is too deep for its word before the first step.

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
mod left_first;
mod method;
mod register;
mod run;
mod skip;
mod sparse;
mod split;
mod stack;
mod uncle;
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
pub use left_first::LeftFirst;
pub use method::{Method, Test};
pub use run::{Tables, Unfit};
pub use skip::{Skip, Skips};
pub use sparse::Sparse;
pub use split::{Cuts, Piece, PieceTable, Split};
pub use stack::Stack;
pub use uncle::Uncle;
pub use word::{WithWord, WordName, with_word};

use crate::event::{Recorder, State};
use crate::order::{Descent, Flow, Visitor};

/// The state of one traversal, on its way through a tree.
pub trait Cursor: State {
    /// Whether the cursor starts again from the root and then asks the visitor about nodes it has asked about before.
    ///
    /// The answers may have become narrower in between (a shorter ray), never wider.
    const RESTARTS: bool = false;

    /// Moves to the first wanted child of the current inner node and postpones the other, if both are wanted.
    ///
    /// `descent` wants at least one child. `false` if there is nowhere to go after all (only where
    /// [`RESTARTS`](Self::RESTARTS)): then backtrack.
    fn descend(&mut self, descent: Descent) -> bool;

    /// Moves to the most recently postponed node. `false` if none is left: the traversal is done.
    fn backtrack(&mut self) -> bool;
}

/// Runs a traversal to its end: the loop that all algorithms share. `[TRAVERSE-1]`
#[inline]
pub fn traverse(mut cursor: impl Cursor, visitor: &mut impl Visitor, recorder: &mut impl Recorder) {
    loop {
        if recorder.visit(&cursor) == Flow::Stop {
            return;
        }
        let node = cursor.node();
        let descended = if node.is_leaf() {
            if visitor.leaf(node) == Flow::Stop {
                return;
            }
            false
        } else {
            let descent = visitor.inner(node);
            !descent.is_neither() && cursor.descend(descent)
        };
        if !descended && !cursor.backtrack() {
            return;
        }
    }
}

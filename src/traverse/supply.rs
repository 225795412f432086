//! The interface between the table of traversals and its callers.

use core::borrow::BorrowMut;

use alloc::vec::Vec;

use super::{Cursor, Pause, Skips, Unsupported};
use crate::hash::Lookup;
use crate::order::FixedOrder;
use crate::tree::{Node, Topology};

/// The sources of cursors in words `W`: a tree and its tables. A missing table is [`Unsupported::NoTable`].
pub trait Supply<'t, W> {
    /// The tree, with the links that the traversal follows.
    type Tree: Topology + 't;
    /// Memory for a stack.
    type Memory: BorrowMut<Vec<Node>>;
    /// A perfect hash.
    type Hash: Lookup<W>;
    /// An implicit layout, or its substitute.
    type Layout: Lookup<W>;
    /// The addresses of a complete tree.
    type Complete: Lookup<W>;
    /// A table with chains.
    type Chains: Lookup<W>;
    /// The order of children by the sign of the direction.
    type BySign: FixedOrder + Copy;

    /// Returns the tree.
    fn tree(&self) -> &'t Self::Tree;

    /// Returns the memory, empty or not.
    fn memory(self) -> Self::Memory;

    /// Returns the order by sign.
    fn by_sign(&self) -> Self::BySign;

    /// The keys that records do not reach. `[HASH-3]`
    ///
    /// # Errors
    /// [`Unsupported::NoTable`].
    fn reached_keys(&self) -> Result<Self::Hash, Unsupported>;

    /// The keys of all nodes.
    ///
    /// # Errors
    /// [`Unsupported::NoTable`].
    fn all_keys(&self) -> Result<Self::Hash, Unsupported>;

    /// The layout.
    ///
    /// # Errors
    /// [`Unsupported::NoTable`].
    fn layout(&self) -> Result<Self::Layout, Unsupported>;

    /// The addresses of a complete tree.
    ///
    /// # Errors
    /// [`Unsupported::NoTable`], [`Unsupported::NotComplete`].
    fn complete(&self) -> Result<Self::Complete, Unsupported>;

    /// The table with chains.
    ///
    /// # Errors
    /// [`Unsupported::NoTable`].
    fn chains(&self) -> Result<Self::Chains, Unsupported>;

    /// Skip pointers, left before right.
    ///
    /// # Errors
    /// [`Unsupported::NoTable`].
    fn skips(&self) -> Result<&'t Skips, Unsupported>;

    /// Skip pointers in the order by sign.
    ///
    /// # Errors
    /// [`Unsupported::NoTable`].
    fn skips_by_sign(&self) -> Result<&'t Skips, Unsupported>;
}

/// A generic function of a traversal that is selected at run time: [`Method::dispatch`](super::Method::dispatch).
///
/// It receives the constructor of the cursor, not the cursor. So it can make many cursors, each from its own source.
pub trait Context<'t, W>: Sized {
    /// The source of cursors.
    type From: Supply<'t, W>;
    /// The result.
    type Output;

    /// Calls the function with a traversal that decides on both children at their parent.
    ///
    /// # Errors
    /// Those of `start`.
    fn by_parent<C: Cursor>(
        self,
        start: impl Fn(Self::From) -> Result<C, Unsupported>,
    ) -> Result<Self::Output, Unsupported>;

    /// Calls the function with a traversal that tests each node at its visit, in a fixed order.
    ///
    /// # Errors
    /// Those of `start`.
    fn by_node<C: Cursor, O: FixedOrder>(
        self,
        start: impl Fn(Self::From) -> Result<(C, O), Unsupported>,
    ) -> Result<Self::Output, Unsupported>;
}

/// A generic function of a traversal that can be paused: [`Method::dispatch_pausing`](super::Method::dispatch_pausing).
pub trait PausingContext<'t, W>: Sized {
    /// The source of cursors.
    type From: Supply<'t, W>;
    /// The result.
    type Output;

    /// Calls the function.
    ///
    /// # Errors
    /// Those of `start`.
    fn pausing<C: Pause<Word = W>>(
        self,
        start: impl Fn(Self::From) -> Result<C, Unsupported>,
    ) -> Result<Self::Output, Unsupported>;
}

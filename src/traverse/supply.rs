//! What the table of traversals asks for, and what it hands out.

use core::borrow::BorrowMut;

use alloc::vec::Vec;

use super::{Cursor, Pause, Skips, Unsupported};
use crate::hash::Lookup;
use crate::order::FixedOrder;
use crate::tree::{Node, Topology};

/// What cursors in words `W` are made from: a tree, and what is beside it. What was not made is [`Unsupported::NoTable`].
pub trait Supply<'t, W> {
    /// The tree, with the links that the traversal follows.
    type Tree: Topology + 't;
    /// Memory for a stack.
    type Memory: BorrowMut<Vec<Node>>;
    /// A perfect hash.
    type Hash: Lookup<W>;
    /// An implicit layout, or what stands for it.
    type Layout: Lookup<W>;
    /// The addresses of a complete tree.
    type Complete: Lookup<W>;
    /// A table with chains.
    type Chains: Lookup<W>;
    /// The order of children by the sign of the direction.
    type BySign: FixedOrder + Copy;

    /// The tree.
    fn tree(&self) -> &'t Self::Tree;

    /// The memory, empty or not.
    fn memory(self) -> Self::Memory;

    /// The order by sign.
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

/// Something to do with a traversal that is chosen when the program runs:
/// [`Method::dispatch`](super::Method::dispatch).
///
/// It gets what makes the cursor, and not the cursor: so it can make many, and each from what it likes.
pub trait Context<'t, W>: Sized {
    /// What cursors are made from.
    type From: Supply<'t, W>;
    /// What comes out.
    type Output;

    /// Does it with a traversal that decides on both children at their parent.
    ///
    /// # Errors
    /// Those of `start`.
    fn by_parent<C: Cursor>(
        self,
        start: impl Fn(Self::From) -> Result<C, Unsupported>,
    ) -> Result<Self::Output, Unsupported>;

    /// Does it with a traversal that tests each node at its visit, in an order that is fixed.
    ///
    /// # Errors
    /// Those of `start`.
    fn by_node<C: Cursor, O: FixedOrder>(
        self,
        start: impl Fn(Self::From) -> Result<(C, O), Unsupported>,
    ) -> Result<Self::Output, Unsupported>;
}

/// Something to do with a traversal that can be put aside:
/// [`Method::dispatch_pausing`](super::Method::dispatch_pausing).
pub trait PausingContext<'t, W>: Sized {
    /// What cursors are made from.
    type From: Supply<'t, W>;
    /// What comes out.
    type Output;

    /// Does it.
    ///
    /// # Errors
    /// Those of `start`.
    fn pausing<C: Pause<Word = W>>(
        self,
        start: impl Fn(Self::From) -> Result<C, Unsupported>,
    ) -> Result<Self::Output, Unsupported>;
}

//! A tree with the tables of some traversals, which are selected by name.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::ops::{Deref, Range};

use super::{
    Complete, Context, Cursor, Glassner, Layout, Method, Need, NotComplete, Pause, PausingContext, Skips, Supply,
    Unsupported, WordName, traverse, traverse_pruned,
};
use crate::event::Recorder;
use crate::hash::{KeySet, Lookup, Options, PerfectHash, Sizing, Verified};
use crate::key::{Grow, KeyWord};
use crate::order::{self, ByNode, FixedOrder, NodeTest, Pruned, SignOrder};
use crate::tree::{ImplicitCells, Keys, Linked, Links, Node, Reach, Recorded, Topology};

/// A tree with the tables that a selection of traversals needs; `H` is the lookup in perfect hashes.
#[derive(Debug)]
pub struct Tables<'t, T, H = PerfectHash> {
    tree: &'t T,
    axes: &'t [u8],
    beside: Held<'t, AuxTables<H>>,
}

/// Tables with every lookup in a perfect hash verified.
pub type VerifiedTables<'t, T> = Tables<'t, T, Verified<'t, T, PerfectHash, Arc<Keys>>>;

/// A tree with the links that its traversals follow.
pub type LinkedTree<'s, T> = Linked<'s, T, 2, 2, &'s Links>;

/// The tables alone, for callers that keep the tree elsewhere.
#[derive(Debug)]
pub struct AuxTables<H = PerfectHash> {
    /// The links that the tree's own records do not have.
    links: Links,
    reached_keys: Option<H>,
    all_keys: Option<H>,
    layout: Option<Layout>,
    complete: Option<Result<Complete, NotComplete>>,
    chains: Option<Glassner>,
    skips: Option<Skips>,
    /// Skip pointers of the octants from this one on.
    first_octant: u8,
    skips_by_sign: Vec<Skips>,
}

/// An owned or borrowed value.
#[derive(Debug)]
enum Held<'t, X> {
    Own(X),
    Lent(&'t X),
}

impl<X> Deref for Held<'_, X> {
    type Target = X;

    #[inline]
    fn deref(&self) -> &X {
        match self {
            Self::Own(x) => x,
            Self::Lent(x) => x,
        }
    }
}

impl AuxTables {
    /// Builds the tables of `methods`. `axes` is for [`SignOrder`].
    ///
    /// Trees of up to `implicit_depth` edges get the implicit layout; in deeper trees the implicit traversals look up
    /// their addresses in the plain map.
    pub fn new(tree: &impl Topology, axes: &[u8], methods: &[Method], implicit_depth: u32) -> Self {
        Self::for_octants(tree, axes, methods, implicit_depth, 0..8)
    }

    /// Builds the tables for searches in some octants: in other octants, a traversal with a table for each octant is
    /// unsupported.
    pub fn for_octants(
        tree: &impl Topology,
        axes: &[u8],
        methods: &[Method],
        implicit_depth: u32,
        octants: Range<u8>,
    ) -> Self {
        let needs = |need| methods.iter().any(|method| method.needs() == need);
        let first_octant = octants.start;
        let octants = if needs(Need::SkipsBySign) { octants } else { 0..0 };
        let links: Vec<Recorded> = methods.iter().map(|method| method.wants_recorded()).collect();
        let perfect = |key_set| PerfectHash::build(tree, Options { key_set, sizing: Sizing::Tight }).ok();
        Self {
            links: Links::of(tree, &links),
            // The tight sizing, with the remedy if the plain function fails.
            reached_keys: needs(Need::ReachedKeys).then(|| perfect(KeySet::Exact(Reach::ALGORITHM_1))).flatten(),
            all_keys: needs(Need::AllKeys).then(|| perfect(KeySet::All)).flatten(),
            layout: needs(Need::Layout).then(|| Layout::of(tree, implicit_depth)),
            complete: needs(Need::Complete).then(|| Complete::of(tree)),
            chains: needs(Need::Chains).then(|| Glassner::of(tree)),
            skips: needs(Need::Skips).then(|| Skips::of(tree, &order::LeftOrder)),
            first_octant,
            skips_by_sign: octants.map(|octant| Skips::of(tree, &SignOrder { axes, octant })).collect(),
        }
    }

    /// Returns the memory of all tables, in bytes.
    pub fn bytes(&self) -> usize {
        let hashes = [&self.reached_keys, &self.all_keys];
        let complete = self.complete.as_ref().and_then(|complete| complete.as_ref().ok());
        hashes.map(|hash| hash.as_ref().map_or(0, |hash| hash.header().bytes())).iter().sum::<usize>()
            + self.links.bytes()
            + self.layout.as_ref().map_or(0, Layout::bytes)
            + complete.map_or(0, Complete::bytes)
            + self.chains.as_ref().map_or(0, Glassner::bytes)
            + self.skips.iter().chain(&self.skips_by_sign).map(Skips::bytes).sum::<usize>()
    }

    /// Returns these tables with another lookup in perfect hashes.
    #[must_use]
    pub fn looked_up_by<H>(self, by: impl Fn(PerfectHash) -> H) -> AuxTables<H> {
        let Self { links, reached_keys, all_keys, layout, complete, chains, skips, first_octant, skips_by_sign } = self;
        let [reached_keys, all_keys] = [reached_keys, all_keys].map(|hash| hash.map(&by));
        AuxTables { links, reached_keys, all_keys, layout, complete, chains, skips, first_octant, skips_by_sign }
    }
}

impl<'t, T: Topology> Tables<'t, T> {
    /// Builds a tree with the tables of `methods`. Trees of up to `implicit_depth` edges get the implicit layout.
    pub fn new(tree: &'t T, axes: &'t [u8], methods: &[Method], implicit_depth: u32) -> Self {
        Self::with(tree, axes, AuxTables::new(tree, axes, methods, implicit_depth))
    }

    /// Combines a tree with borrowed tables.
    #[inline]
    pub const fn lent(tree: &'t T, axes: &'t [u8], beside: &'t AuxTables) -> Self {
        Self { tree, axes, beside: Held::Lent(beside) }
    }
}

impl<'t, T: Topology> VerifiedTables<'t, T> {
    /// Combines a tree with its tables; the tree's keys verify every lookup in a perfect hash.
    pub fn verified(tree: &'t T, axes: &'t [u8], beside: AuxTables, keys: Arc<Keys>) -> Self {
        Self::with(tree, axes, beside.looked_up_by(|hash| Verified::new(hash, tree, Arc::clone(&keys))))
    }

    /// Returns the number of lookups so far that did not find the node with the key.
    pub fn misses(&self) -> usize {
        self.beside.reached_keys.iter().chain(&self.beside.all_keys).map(Verified::misses).sum()
    }
}

impl<'t, T: Topology, H> Tables<'t, T, H> {
    /// Combines a tree with its tables.
    pub const fn with(tree: &'t T, axes: &'t [u8], beside: AuxTables<H>) -> Self {
        Self { tree, axes, beside: Held::Own(beside) }
    }

    /// Returns the tree, with the links that these traversals follow.
    #[inline]
    pub fn tree(&self) -> LinkedTree<'_, T> {
        Linked::over(self.tree, &self.beside.links)
    }

    /// Runs one search. `memory` is the stack's, reused between searches; `octant` has the signs of the direction, for
    /// the traversals that order children by them.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    #[inline]
    pub fn run<W: KeyWord, S: Pruned + NodeTest>(
        &self,
        method: Method,
        octant: u8,
        memory: &mut Vec<Node>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unsupported>
    where
        H: Lookup<W>,
    {
        self.run_over::<W, _, S>(&self.tree(), method, octant, memory, search, recorder)
    }

    /// Runs one search over another, equivalent view of the tree: one that observes the reads.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    #[inline]
    pub fn run_over<W: KeyWord, X: Topology, S: Pruned + NodeTest>(
        &self,
        tree: &X,
        method: Method,
        octant: u8,
        memory: &mut Vec<Node>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unsupported>
    where
        H: Lookup<W>,
    {
        if !search.allows(method.test().pruning()) {
            return Err(Unsupported::Unordered);
        }
        method.dispatch::<W, _>(Run { from: self.over(tree, octant, memory), search, recorder })
    }

    /// Calls [`run`](Self::run) in a word that is known only at run time.
    ///
    /// A search of type `&mut dyn` shares one body with all other searches, so traversals are not compiled for each of
    /// them.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    pub fn run_in<S: Pruned + NodeTest>(
        &self,
        word: WordName,
        method: Method,
        octant: u8,
        memory: &mut Vec<Node>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unsupported>
    where
        H: Lookup<u32> + Lookup<u64> + Lookup<u128> + Lookup<Grow>,
    {
        match word {
            WordName::U32 => self.run::<u32, S>(method, octant, memory, search, recorder),
            WordName::U64 => self.run::<u64, S>(method, octant, memory, search, recorder),
            WordName::U128 => self.run::<u128, S>(method, octant, memory, search, recorder),
            WordName::Grow => self.run::<Grow, S>(method, octant, memory, search, recorder),
        }
    }

    /// Creates the cursor of a traversal that [can be paused](Method::can_pause).
    ///
    /// # Errors
    /// [`Unsupported`].
    #[inline]
    pub fn with_cursor<W: KeyWord, F: WithCursor<W>>(&self, method: Method, f: F) -> Result<F::Output, Unsupported>
    where
        H: Lookup<W>,
    {
        method.dispatch_pausing::<W, _>(Call { from: self.over(&self.tree(), 0, &mut Vec::new()), f })
    }

    /// Returns the source of cursors.
    pub fn over<'s, X>(
        &'s self,
        tree: &'s X,
        octant: u8,
        memory: &'s mut Vec<Node>,
    ) -> FromTables<'s, X, H, &'s Layout> {
        let layout = self.beside.layout.as_ref();
        FromTables { beside: &self.beside, axes: self.axes, tree, layout, octant, memory }
    }

    /// Returns whether the tree's own records have the links of a traversal, and its layout is implicit: then
    /// [`directly`](Self::directly) needs no tables.
    #[inline]
    pub fn are_direct(&self, method: Method) -> bool {
        self.tree.names(method.wants_recorded()) && !matches!(self.beside.layout, Some(Layout::Map(_)))
    }

    /// Returns the source of cursors over the tree itself, without a choice of links and addresses at each read.
    #[inline]
    pub fn directly<'s>(&'s self, octant: u8, memory: &'s mut Vec<Node>) -> FromTables<'s, T, H, ImplicitCells<'s>> {
        let layout = match &self.beside.layout {
            Some(Layout::Implicit(layout)) => Some(layout.cells()),
            _ => None,
        };
        FromTables { beside: &self.beside, axes: self.axes, tree: self.tree, layout, octant, memory }
    }
}

/// A generic function of a cursor whose type is known only at run time.
pub trait WithCursor<W> {
    /// The result.
    type Output;

    /// Calls the function with a cursor at the root.
    fn call(self, cursor: impl Pause<Word = W>) -> Self::Output;
}

/// Tables, and the inputs that change with each search.
#[derive(Debug)]
pub struct FromTables<'s, X, H, L> {
    beside: &'s AuxTables<H>,
    layout: Option<L>,
    axes: &'s [u8],
    tree: &'s X,
    octant: u8,
    memory: &'s mut Vec<Node>,
}

impl<'s, W: KeyWord, X: Topology, H: Lookup<W>, L: Lookup<W> + Copy> Supply<'s, W> for FromTables<'s, X, H, L> {
    type Tree = X;
    type Memory = &'s mut Vec<Node>;
    type Hash = &'s H;
    type Layout = L;
    type Complete = &'s Complete;
    type Chains = &'s Glassner;
    type BySign = SignOrder<'s>;

    #[inline]
    fn tree(&self) -> &'s X {
        self.tree
    }

    #[inline]
    fn memory(self) -> &'s mut Vec<Node> {
        self.memory
    }

    #[inline]
    fn by_sign(&self) -> SignOrder<'s> {
        SignOrder { axes: self.axes, octant: self.octant }
    }

    #[inline]
    fn reached_keys(&self) -> Result<&'s H, Unsupported> {
        self.beside.reached_keys.as_ref().ok_or(Unsupported::NoTable)
    }

    #[inline]
    fn all_keys(&self) -> Result<&'s H, Unsupported> {
        self.beside.all_keys.as_ref().ok_or(Unsupported::NoTable)
    }

    #[inline]
    fn layout(&self) -> Result<L, Unsupported> {
        self.layout.ok_or(Unsupported::NoTable)
    }

    #[inline]
    fn complete(&self) -> Result<&'s Complete, Unsupported> {
        Ok(self.beside.complete.as_ref().ok_or(Unsupported::NoTable)?.as_ref().map_err(|&error| error)?)
    }

    #[inline]
    fn chains(&self) -> Result<&'s Glassner, Unsupported> {
        self.beside.chains.as_ref().ok_or(Unsupported::NoTable)
    }

    #[inline]
    fn skips(&self) -> Result<&'s Skips, Unsupported> {
        self.beside.skips.as_ref().ok_or(Unsupported::NoTable)
    }

    #[inline]
    fn skips_by_sign(&self) -> Result<&'s Skips, Unsupported> {
        let number = self.octant.checked_sub(self.beside.first_octant).ok_or(Unsupported::NoTable)?;
        self.beside.skips_by_sign.get(usize::from(number)).ok_or(Unsupported::NoTable)
    }
}

/// A run to the end of a search.
pub(crate) struct Run<'a, F, S, R> {
    pub(crate) from: F,
    pub(crate) search: &'a mut S,
    pub(crate) recorder: &'a mut R,
}

impl<'s, W: KeyWord, F: Supply<'s, W>, S: Pruned + NodeTest, R: Recorder> Context<'s, W> for Run<'_, F, S, R> {
    type From = F;
    type Output = ();

    #[inline]
    fn by_parent<C: Cursor>(self, start: impl Fn(F) -> Result<C, Unsupported>) -> Result<(), Unsupported> {
        traverse_pruned(start(self.from)?, self.search, self.recorder);
        Ok(())
    }

    #[inline]
    fn by_node<C: Cursor, O: FixedOrder>(
        self,
        start: impl Fn(F) -> Result<(C, O), Unsupported>,
    ) -> Result<(), Unsupported> {
        let (cursor, order) = start(self.from)?;
        traverse(cursor, &mut ByNode { test: self.search, order }, self.recorder);
        Ok(())
    }
}

struct Call<F, X> {
    from: F,
    f: X,
}

impl<'s, W: KeyWord, F: Supply<'s, W>, X: WithCursor<W>> PausingContext<'s, W> for Call<F, X> {
    type From = F;
    type Output = X::Output;

    #[inline]
    fn pausing<C: Pause<Word = W>>(
        self,
        start: impl Fn(F) -> Result<C, Unsupported>,
    ) -> Result<X::Output, Unsupported> {
        Ok(self.f.call(start(self.from)?))
    }
}

#[cfg(test)]
mod tests;

//! Running a traversal by its name.

use alloc::vec::Vec;
use core::borrow::Borrow;
use core::fmt;
use core::sync::atomic::{AtomicUsize, Ordering};

use super::{
    ByKey, Complete, Glassner, Hapala, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine, LeftFirst, Method, Next,
    NotComplete, Pause, PruningStack, Skip, Skips, Stack, WithCursor, WordName, traverse,
};
use crate::event::Recorder;
use crate::hash::{KeyMap, KeySet, Lookup, Options, PerfectHash, Sizing};
use crate::key::{Grow, KeyWord, TooDeep};
use crate::order::{self, ByNode, NodeTest, SignOrder, Visitor};
use crate::tree::{Implicit, Keys, Node, ParentLinks, Parents, RecordedParents, RecordedUncles, Topology, Uncles};

/// A tree with the tables that a choice of traversals needs beside it: its own, or those of somebody else
/// ([`over`](Self::over)).
#[derive(Debug)]
pub struct Tables<'t, T, O = Beside> {
    pub(super) tree: &'t T,
    axes: &'t [u8],
    beside: O,
}

/// The tables alone, for who has the tree elsewhere.
#[derive(Debug)]
pub struct Beside {
    pub(super) parents: Option<Parents>,
    pub(super) uncles: Option<Uncles>,
    /// The keys that `hashed` looks up.
    pub(super) hash: Option<PerfectHash>,
    /// All keys, for `hash-only`.
    pub(super) full_hash: Option<PerfectHash>,
    /// Where tables are to be verified: the keys of all nodes, and the lookups that went wrong.
    pub(super) keys: Option<Keys>,
    pub(super) misses: AtomicUsize,
    /// All keys, in place of an implicit layout.
    all_keys: Option<KeyMap>,
    implicit: Option<Implicit>,
    complete: Option<Result<Complete, NotComplete>>,
    glassner: Option<Glassner>,
    skips: Option<Skips>,
    octant_skips: Vec<Skips>,
}

/// Why a traversal does not run on a tree. `[CONF-3]` `[DISJOINT-5]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfit {
    /// The tree is too deep for the word.
    TooDeep(TooDeep),
    /// The traversal is for complete trees.
    NotComplete(NotComplete),
    /// The traversal does not exist for this word.
    NoSuchWord {
        /// Name of the word.
        word: &'static str,
    },
    /// The tables were not made for this traversal.
    NoTable,
    /// The traversal's state cannot be put aside.
    NoPause,
    /// The traversal leaves out what lies behind a hit, and the search does not [allow](Visitor::allows) that: it does not
    /// take children in the order of distance, or does not say which are disjoint.
    Unordered,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooDeep(error) => error.fmt(f),
            Self::NotComplete(error) => error.fmt(f),
            Self::NoSuchWord { word } => write!(f, "not made for the word {word}"),
            Self::NoTable => f.write_str("its tables were not built"),
            Self::NoPause => f.write_str("its state cannot be put aside"),
            Self::Unordered => f.write_str("it prunes, and the search is not ordered by distance"),
        }
    }
}

impl core::error::Error for Unfit {}

impl From<TooDeep> for Unfit {
    fn from(error: TooDeep) -> Self {
        Self::TooDeep(error)
    }
}

impl From<NotComplete> for Unfit {
    fn from(error: NotComplete) -> Self {
        Self::NotComplete(error)
    }
}

impl<'t, T: Topology> Tables<'t, T> {
    /// Makes what `methods` need. `axes` is for [`SignOrder`].
    ///
    /// Trees of up to `implicit_depth` edges get the implicit layout; in deeper ones the implicit traversals look
    /// their addresses up in the plain map.
    pub fn new(tree: &'t T, axes: &'t [u8], methods: &[Method], implicit_depth: u32) -> Self {
        Self { tree, axes, beside: Beside::new(tree, axes, methods, implicit_depth) }
    }

    /// The same, with every lookup in a perfect hash verified: [`misses`](Self::misses) counts those that did not find
    /// the node with the key.
    #[must_use]
    pub fn verified(mut self) -> Self {
        self.beside.keys = Some(Keys::of(self.tree));
        self
    }
}

impl Beside {
    /// As [`Tables::new`].
    pub fn new<T: Topology>(tree: &T, axes: &[u8], methods: &[Method], implicit_depth: u32) -> Self {
        use Method as M;
        let needs = |users: &[M]| methods.iter().any(|method| users.contains(&method.without_pruning()));
        let implicit_users = [M::LeftFirst, M::ImplicitA, M::ImplicitA1, M::ImplicitB, M::ImplicitB1];
        let wants_implicit = needs(&implicit_users) && tree.depth() <= implicit_depth;
        let implicit = wants_implicit.then(|| Implicit::of(tree).ok()).flatten();
        let wants_all_keys = needs(&implicit_users) && implicit.is_none();
        let octants = if needs(&[M::SkipOctant]) { 0..8 } else { 0..0 };
        Self {
            parents: (needs(&[M::Sparse, M::Afra, M::Hapala]) && RecordedParents::of(tree).is_none())
                .then(|| Parents::of(tree)),
            uncles: (needs(&[M::Uncle, M::Hashed]) && RecordedUncles::of(tree).is_none()).then(|| Uncles::of(tree)),
            hash: needs(&[M::Hashed]).then(|| perfect(tree, KeySet::Exact(<Uncles>::REACH))).flatten(),
            full_hash: needs(&[M::HashOnly]).then(|| perfect(tree, KeySet::All)).flatten(),
            keys: None,
            misses: AtomicUsize::new(0),
            all_keys: wants_all_keys.then(|| KeyMap::of(tree)),
            implicit,
            complete: needs(&[M::Complete]).then(|| Complete::of(tree)),
            glassner: needs(&[M::Glassner]).then(|| Glassner::of(tree)),
            skips: needs(&[M::Skip]).then(|| Skips::of(tree, &order::LeftFirst)),
            octant_skips: octants.map(|octant| Skips::of(tree, &SignOrder { axes, octant })).collect(),
        }
    }

    /// Memory of all tables, in bytes, without those that only verify.
    pub fn bytes(&self) -> usize {
        let hashes = [&self.hash, &self.full_hash].map(|hash| hash.as_ref().map_or(0, |hash| hash.header().bytes()));
        let complete = self.complete.as_ref().and_then(|complete| complete.as_ref().ok());
        hashes.iter().sum::<usize>()
            + self.parents.as_ref().map_or(0, Parents::bytes)
            + self.uncles.as_ref().map_or(0, Uncles::bytes)
            + self.all_keys.as_ref().map_or(0, KeyMap::bytes)
            + self.implicit.as_ref().map_or(0, Implicit::bytes)
            + complete.map_or(0, Complete::bytes)
            + self.glassner.as_ref().map_or(0, Glassner::bytes)
            + self.skips.iter().chain(&self.octant_skips).map(Skips::bytes).sum::<usize>()
    }
}

impl<'t, T: Topology, O: Borrow<Beside>> Tables<'t, T, O> {
    /// A tree with tables that were made for it.
    #[inline]
    pub fn over(tree: &'t T, axes: &'t [u8], beside: O) -> Self {
        Self { tree, axes, beside }
    }

    /// The tables.
    #[inline]
    pub fn beside(&self) -> &Beside {
        self.beside.borrow()
    }

    /// Memory of all tables, in bytes, without those that only verify.
    pub fn bytes(&self) -> usize {
        self.beside().bytes()
    }

    /// Number of lookups that went wrong so far, if they are verified.
    pub fn misses(&self) -> usize {
        self.beside().misses.load(Ordering::Relaxed)
    }

    /// Runs one search. `memory` is the stack's, kept between searches; `octant` gives the signs of the direction,
    /// for the traversals that order children by it.
    ///
    /// # Errors
    /// [`Unfit`], before the first step.
    #[inline]
    pub fn run<W: KeyWord, S: Visitor + NodeTest>(
        &self,
        method: Method,
        octant: u8,
        memory: &mut Vec<Node>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unfit> {
        let tree = self.tree;
        if !method.exists_for::<W>() {
            return Err(Unfit::NoSuchWord { word: W::NAME });
        }
        if !search.allows(method.test().pruning()) {
            return Err(Unfit::Unordered);
        }
        let by_sign = SignOrder { axes: self.axes, octant };
        let _: Option<Next> = match method {
            Method::Stack => traverse(Stack::new(tree, memory), search, recorder),
            Method::StackDisjoint => traverse(PruningStack::<T, false>::new(tree, memory), search, recorder),
            Method::StackT0 => traverse(PruningStack::<T, true>::new(tree, memory), search, recorder),
            Method::LeftFirst | Method::ImplicitA | Method::ImplicitA1 | Method::ImplicitB | Method::ImplicitB1 => {
                match &self.beside().implicit {
                    Some(layout) => self.run_implicit::<W, S>(method, layout, search, recorder)?,
                    None => {
                        self.run_implicit::<W, S>(method, table(self.beside().all_keys.as_ref())?, search, recorder)?
                    }
                }
            }
            Method::Hapala => match RecordedParents::of(tree) {
                Some(parents) => self.run_hapala(parents, by_sign, search, recorder),
                None => self.run_hapala(table(self.beside().parents.as_ref())?, by_sign, search, recorder),
            },
            Method::Laine0 => traverse(Laine::<0, W, T>::new(tree)?, search, recorder),
            Method::Laine1 => traverse(Laine::<1, W, T>::new(tree)?, search, recorder),
            Method::Laine2 => traverse(Laine::<2, W, T>::new(tree)?, search, recorder),
            Method::Laine4 => traverse(Laine::<4, W, T>::new(tree)?, search, recorder),
            Method::Laine8 => traverse(Laine::<8, W, T>::new(tree)?, search, recorder),
            Method::Skip => {
                let mut search = ByNode { test: search, order: order::LeftFirst };
                traverse(Skip::new(tree, table(self.beside().skips.as_ref())?, order::LeftFirst), &mut search, recorder)
            }
            Method::SkipOctant => {
                let skips = self.beside().octant_skips.get(usize::from(octant)).ok_or(Unfit::NoTable)?;
                let mut search = ByNode { test: search, order: by_sign };
                traverse(Skip::new(tree, skips, by_sign), &mut search, recorder)
            }
            Method::Complete => {
                let complete = table(self.beside().complete.as_ref())?.as_ref().map_err(|&error| error)?;
                traverse(ByKey::<W, _>::new(tree, complete)?, search, recorder)
            }
            Method::Glassner => {
                traverse(ByKey::<W, _>::new(tree, table(self.beside().glassner.as_ref())?)?, search, recorder)
            }
            _ => self.with_cursor::<W, _>(method, Run { search, recorder })?,
        };
        Ok(())
    }

    /// [`run`](Self::run) in a word that is known only when the program runs.
    ///
    /// A search of type `&mut dyn` shares one body with all others, so that not all traversals are compiled for each of them.
    ///
    /// # Errors
    /// [`Unfit`], before the first step.
    pub fn run_in<S: Visitor + NodeTest>(
        &self,
        word: WordName,
        method: Method,
        octant: u8,
        memory: &mut Vec<Node>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unfit> {
        match word {
            WordName::U32 => self.run::<u32, S>(method, octant, memory, search, recorder),
            WordName::U64 => self.run::<u64, S>(method, octant, memory, search, recorder),
            WordName::U128 => self.run::<u128, S>(method, octant, memory, search, recorder),
            WordName::Grow => self.run::<Grow, S>(method, octant, memory, search, recorder),
        }
    }

    #[inline]
    fn run_hapala<S: NodeTest>(
        &self,
        parents: impl ParentLinks<T>,
        by_sign: SignOrder<'_>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Option<Next> {
        let mut search = ByNode { test: search, order: by_sign };
        traverse(Hapala::new(self.tree, parents, by_sign), &mut search, recorder)
    }

    #[inline]
    fn run_implicit<W: KeyWord, S: Visitor + NodeTest>(
        &self,
        method: Method,
        layout: impl Lookup<W>,
        search: &mut S,
        recorder: &mut impl Recorder,
    ) -> Result<Option<Next>, Unfit> {
        let tree = self.tree;
        Ok(match method {
            Method::ImplicitA => traverse(ImplicitA::new(tree, layout)?, search, recorder),
            Method::ImplicitA1 => traverse(ImplicitA1::new(tree, layout)?, search, recorder),
            Method::ImplicitB => traverse(ImplicitB::new(tree, layout)?, search, recorder),
            Method::ImplicitB1 => traverse(ImplicitB1::new(tree, layout)?, search, recorder),
            _ => {
                let mut search = ByNode { test: search, order: order::LeftFirst };
                traverse(LeftFirst::new(tree, layout)?, &mut search, recorder)
            }
        })
    }
}

/// Runs to the end.
struct Run<'a, S, R> {
    search: &'a mut S,
    recorder: &'a mut R,
}

impl<W, S: Visitor, R: Recorder> WithCursor<W> for Run<'_, S, R> {
    type Output = Option<Next>;

    #[inline]
    fn call(self, cursor: impl Pause<Word = W>) -> Option<Next> {
        traverse(cursor, self.search, self.recorder)
    }
}

/// The table that traversals use: the tight sizing, with the remedy where the plain function fails.
fn perfect(tree: &impl Topology, key_set: KeySet) -> Option<PerfectHash> {
    PerfectHash::build(tree, Options { key_set, sizing: Sizing::Tight }).ok()
}

pub(super) fn table<X>(table: Option<&X>) -> Result<&X, Unfit> {
    table.ok_or(Unfit::NoTable)
}

#[cfg(test)]
mod tests;

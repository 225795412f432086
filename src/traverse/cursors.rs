//! The traversals whose state can be put aside, by name.

use core::borrow::Borrow;
use core::sync::atomic::Ordering;

use super::run::table;
use super::{Afra, Beside, Disjoint, HashOnly, Hashed, Method, Pause, Sparse, Tables, Uncle, Unfit};
use crate::hash::{Lookup, Verified};
use crate::key::KeyWord;
use crate::tree::{ParentLinks, RecordedParents, RecordedUncles, Topology, UncleLinks};

/// Something to do with a cursor whose type is known only when the program runs.
pub trait WithCursor<W> {
    /// What comes out.
    type Output;

    /// Does it with a cursor at the root.
    fn call(self, cursor: impl Pause<Word = W>) -> Self::Output;
}

impl<T: Topology, O: Borrow<Beside>> Tables<'_, T, O> {
    /// Makes the cursor of a traversal that [can be put aside](Method::can_pause).
    ///
    /// # Errors
    /// [`Unfit`].
    #[inline]
    pub fn with_cursor<W: KeyWord, F: WithCursor<W>>(&self, method: Method, f: F) -> Result<F::Output, Unfit> {
        match method.without_pruning() {
            Method::Sparse | Method::Afra => match RecordedParents::of(self.tree) {
                Some(parents) => self.climbing(method, parents, f),
                None => self.climbing(method, table(self.beside().parents.as_ref())?, f),
            },
            Method::Uncle => match RecordedUncles::of(self.tree) {
                Some(uncles) => self.by_uncles(method, uncles, f),
                None => self.by_uncles(method, table(self.beside().uncles.as_ref())?, f),
            },
            Method::HashOnly | Method::Hashed => {
                let hash = if method == Method::HashOnly { &self.beside().full_hash } else { &self.beside().hash };
                let hash = table(hash.as_ref())?;
                let Some(keys) = &self.beside().keys else { return self.by_hash(method, hash, f) };
                let verified = Verified::new(hash, self.tree, keys);
                let output = self.by_hash(method, &verified, f)?;
                self.beside().misses.fetch_add(verified.misses(), Ordering::Relaxed);
                Ok(output)
            }
            _ => Err(Unfit::NoPause),
        }
    }

    #[inline]
    fn climbing<W: KeyWord, F: WithCursor<W>>(
        &self,
        method: Method,
        parents: impl ParentLinks<T>,
        f: F,
    ) -> Result<F::Output, Unfit> {
        Ok(match method {
            Method::Sparse => f.call(Sparse::<W, T, _>::new(self.tree, parents)?),
            Method::SparseDisjoint => f.call(Sparse::<W, T, _, Disjoint<W>>::new(self.tree, parents)?),
            Method::Afra => f.call(Afra::<W, T, _>::new(self.tree, parents)?),
            _ => f.call(Afra::<W, T, _, Disjoint<W>>::new(self.tree, parents)?),
        })
    }

    #[inline]
    fn by_uncles<W: KeyWord, F: WithCursor<W>>(
        &self,
        method: Method,
        uncles: impl UncleLinks<T>,
        f: F,
    ) -> Result<F::Output, Unfit> {
        Ok(match method {
            Method::Uncle => f.call(Uncle::<W, T, _>::new(self.tree, uncles)?),
            _ => f.call(Uncle::<W, T, _, Disjoint<W>>::new(self.tree, uncles)?),
        })
    }

    #[inline]
    fn by_hash<W: KeyWord, F: WithCursor<W>>(
        &self,
        method: Method,
        hash: impl Lookup<W>,
        f: F,
    ) -> Result<F::Output, Unfit> {
        if method == Method::HashOnly {
            return Ok(f.call(HashOnly::<W, T, _>::new(self.tree, hash)?));
        }
        match RecordedUncles::of(self.tree) {
            Some(uncles) => self.by_hash_and_uncles(method, uncles, hash, f),
            None => self.by_hash_and_uncles(method, table(self.beside().uncles.as_ref())?, hash, f),
        }
    }

    #[inline]
    fn by_hash_and_uncles<W: KeyWord, F: WithCursor<W>>(
        &self,
        method: Method,
        uncles: impl UncleLinks<T>,
        hash: impl Lookup<W>,
        f: F,
    ) -> Result<F::Output, Unfit> {
        Ok(match method {
            Method::Hashed => f.call(Hashed::<W, T, _, _>::new(self.tree, uncles, hash)?),
            _ => f.call(Hashed::<W, T, _, _, Disjoint<W>>::new(self.tree, uncles, hash)?),
        })
    }
}

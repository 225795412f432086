//! The traversals whose state can be put aside, by name.

use core::sync::atomic::Ordering;

use super::run::table;
use super::{Afra, Disjoint, HashOnly, Hashed, Method, Pause, Sparse, Tables, Uncle, Unfit};
use crate::hash::{Lookup, Verified};
use crate::key::KeyWord;
use crate::tree::Topology;

/// Something to do with a cursor whose type is known only when the program runs.
pub trait WithCursor<W> {
    /// What comes out.
    type Output;

    /// Does it with a cursor at the root.
    fn call(self, cursor: impl Pause<Word = W>) -> Self::Output;
}

impl<T: Topology> Tables<'_, T> {
    /// Makes the cursor of a traversal that [can be put aside](Method::can_pause).
    ///
    /// # Errors
    /// [`Unfit`].
    #[inline]
    pub fn with_cursor<W: KeyWord, F: WithCursor<W>>(&self, method: Method, f: F) -> Result<F::Output, Unfit> {
        let tree = &self.tree;
        Ok(match method {
            Method::Sparse => f.call(Sparse::<W, _>::new(tree)?),
            Method::SparseDisjoint => f.call(Sparse::<W, _, Disjoint<W>>::new(tree)?),
            Method::Afra => f.call(Afra::<W, _>::new(tree)?),
            Method::AfraDisjoint => f.call(Afra::<W, _, Disjoint<W>>::new(tree)?),
            Method::Uncle => f.call(Uncle::<W, _>::new(tree)?),
            Method::UncleDisjoint => f.call(Uncle::<W, _, Disjoint<W>>::new(tree)?),
            Method::HashOnly | Method::Hashed | Method::HashedDisjoint => {
                let hash = if method == Method::HashOnly { &self.full_hash } else { &self.hash };
                let hash = table(hash.as_ref())?;
                let Some(keys) = &self.keys else { return self.by_hash(method, hash, f) };
                let verified = Verified::new(hash, tree, keys);
                let output = self.by_hash(method, &verified, f)?;
                self.misses.fetch_add(verified.misses(), Ordering::Relaxed);
                output
            }
            _ => return Err(Unfit::NoPause),
        })
    }

    #[inline]
    fn by_hash<W: KeyWord, F: WithCursor<W>>(
        &self,
        method: Method,
        hash: impl Lookup<W>,
        f: F,
    ) -> Result<F::Output, Unfit> {
        let tree = &self.tree;
        Ok(match method {
            Method::HashOnly => f.call(HashOnly::<W, _, _>::new(tree, hash)?),
            Method::Hashed => f.call(Hashed::<W, _, _>::new(tree, hash)?),
            _ => f.call(Hashed::<W, _, _, Disjoint<W>>::new(tree, hash)?),
        })
    }
}

//! A cache of one answer.

/// The shape of the last query, and its answer: coincident shapes share it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Once<S, A>(Option<(S, A)>);

impl<S: Copy + PartialEq, A: Copy> Once<S, A> {
    /// No query so far.
    pub(crate) const NEVER: Self = Self(None);

    /// Creates an empty cache as [`NEVER`](Self::NEVER), without a copy of an absent answer.
    #[inline(always)]
    pub(crate) fn never() -> Self {
        Self(None)
    }

    #[inline]
    pub(crate) fn answer(&mut self, shape: &S, ask: impl FnOnce(&S) -> A) -> A {
        match &self.0 {
            Some((last, answer)) if last == shape => *answer,
            _ => self.0.insert((*shape, ask(shape))).1,
        }
    }
}

//! What was asked last, and its answer.

/// The shape that was asked last, and its answer: shapes that coincide have one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Once<S, A>(Option<(S, A)>);

impl<S: Copy + PartialEq, A: Copy> Once<S, A> {
    /// Nothing was asked.
    pub(crate) const NEVER: Self = Self(None);

    /// The same, without a copy of all that is not there.
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

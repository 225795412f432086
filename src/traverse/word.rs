//! The key words by name.

use crate::key::{Grow, KeyWord};
use crate::name::named;

/// A key word, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names are those of the types")]
pub enum WordName {
    U32,
    U64,
    U128,
    Grow,
}

impl WordName {
    /// All words that traversals are run with, narrowest first.
    pub const ALL: [Self; 4] = [Self::U32, Self::U64, Self::U128, Self::Grow];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::U32 => u32::NAME,
            Self::U64 => u64::NAME,
            Self::U128 => u128::NAME,
            Self::Grow => Grow::NAME,
        }
    }

    /// Returns the narrowest word that carries this depth, in edges, in every traversal.
    pub const fn narrowest(depth: u32) -> Self {
        match depth {
            0..=30 => Self::U32,
            31..=62 => Self::U64,
            63..=126 => Self::U128,
            _ => Self::Grow,
        }
    }
}

named!(WordName);

/// A generic function of a word that is known only at run time.
pub trait WithWord {
    /// The result.
    type Output;

    /// Calls the function with the word `W`.
    fn call<W: KeyWord>(self) -> Self::Output;
}

/// Calls a function with the type of a named word.
pub fn with_word<F: WithWord>(word: WordName, f: F) -> F::Output {
    match word {
        WordName::U32 => f.call::<u32>(),
        WordName::U64 => f.call::<u64>(),
        WordName::U128 => f.call::<u128>(),
        WordName::Grow => f.call::<Grow>(),
    }
}

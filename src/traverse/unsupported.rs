//! Errors of traversals that do not support a tree.

use core::fmt;

use super::NotComplete;
use crate::key::TooDeep;
use crate::tree::{Recorded, Topology};

/// The reason why a traversal does not support a tree. `[CONF-3]` `[DISJOINT-5]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsupported {
    /// The tree is too deep for the word.
    TooDeep(TooDeep),
    /// The traversal is for complete trees.
    NotComplete(NotComplete),
    /// The traversal does not exist for this word.
    NoSuchWord {
        /// Name of the word.
        word: &'static str,
    },
    /// The tree does not have these links, in its records or in [tables](crate::tree::Linked).
    NoLinks(Recorded),
    /// The tables do not include those of this traversal.
    NoTable,
    /// The traversal cannot be paused.
    NoPause,
    /// The traversal skips nodes behind a hit, and the search does not [allow](crate::order::Pruned::allows) this: it
    /// does not take children in the order of distance, or does not mark disjoint children.
    Unordered,
}

impl Unsupported {
    /// Checks links for constructors of cursors.
    pub(super) fn unless_linked(tree: &impl Topology, wanted: Recorded) -> Result<(), Self> {
        if tree.names(wanted) { Ok(()) } else { Err(Self::NoLinks(wanted)) }
    }
}

impl fmt::Display for Unsupported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooDeep(error) => error.fmt(f),
            Self::NotComplete(error) => error.fmt(f),
            Self::NoSuchWord { word } => write!(f, "not made for the word {word}"),
            Self::NoLinks(Recorded::ParentSibling) => f.write_str("the tree names no parents and siblings"),
            Self::NoLinks(_) => f.write_str("the tree names no uncles and grand uncles"),
            Self::NoTable => f.write_str("its tables were not built"),
            Self::NoPause => f.write_str("its state cannot be put aside"),
            Self::Unordered => f.write_str("it prunes, and the search is not ordered by distance"),
        }
    }
}

impl core::error::Error for Unsupported {}

impl From<TooDeep> for Unsupported {
    fn from(error: TooDeep) -> Self {
        Self::TooDeep(error)
    }
}

impl From<NotComplete> for Unsupported {
    fn from(error: NotComplete) -> Self {
        Self::NotComplete(error)
    }
}

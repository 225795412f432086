//! Why a traversal does not run on a tree.

use core::fmt;

use super::NotComplete;
use crate::key::TooDeep;
use crate::tree::{Recorded, Topology};

/// Why a traversal does not run on a tree. `[CONF-3]` `[DISJOINT-5]`
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
    /// The tree does not name these nodes, in its records or [beside them](crate::tree::Linked).
    NoLinks(Recorded),
    /// The tables were not made for this traversal.
    NoTable,
    /// The traversal's state cannot be put aside.
    NoPause,
    /// The traversal leaves out what lies behind a hit, and the search does not [allow](crate::order::Pruned::allows)
    /// that: it does not take children in the order of distance, or does not say which are disjoint.
    Unordered,
}

impl Unsupported {
    /// For constructors of cursors that follow links.
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

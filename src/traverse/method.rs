//! The traversals by name.

use super::WordName;
use crate::key::{Grow, KeyWord};
use crate::name::named;
use crate::tree::Recorded;

/// A traversal, by the name that code, command line, suite and tables share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each is documented where it is implemented")]
pub enum Method {
    Stack,
    LeftFirst,
    ImplicitA,
    ImplicitA1,
    ImplicitB,
    ImplicitB1,
    Sparse,
    Hapala,
    Laine0,
    Laine1,
    Laine2,
    Laine4,
    Laine8,
    Afra,
    Uncle,
    HashOnly,
    Hashed,
    Skip,
    SkipOctant,
    Complete,
    Glassner,
}

/// What a traversal tests at a visit, and in which order it takes the children: which oracle it is held to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// Both children at their parent's visit, in any order.
    Children,
    /// The node itself at its visit; left before right.
    NodeLeftFirst,
    /// The node itself at its visit; the near child by the sign of the ray's direction first.
    NodeBySign,
}

impl Method {
    /// All traversals, in the order of the tables.
    pub const ALL: [Self; 21] = [
        Self::Stack,
        Self::LeftFirst,
        Self::ImplicitA,
        Self::ImplicitA1,
        Self::ImplicitB,
        Self::ImplicitB1,
        Self::Sparse,
        Self::Hapala,
        Self::Laine0,
        Self::Laine1,
        Self::Laine2,
        Self::Laine4,
        Self::Laine8,
        Self::Afra,
        Self::Uncle,
        Self::HashOnly,
        Self::Hashed,
        Self::Skip,
        Self::SkipOctant,
        Self::Complete,
        Self::Glassner,
    ];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stack => "stack",
            Self::LeftFirst => "left-first",
            Self::ImplicitA => "implicit-a",
            Self::ImplicitA1 => "implicit-a1",
            Self::ImplicitB => "implicit-b",
            Self::ImplicitB1 => "implicit-b1",
            Self::Sparse => "sparse",
            Self::Hapala => "hapala",
            Self::Laine0 => "laine-0",
            Self::Laine1 => "laine-1",
            Self::Laine2 => "laine-2",
            Self::Laine4 => "laine-4",
            Self::Laine8 => "laine-8",
            Self::Afra => "afra",
            Self::Uncle => "uncle",
            Self::HashOnly => "hash-only",
            Self::Hashed => "hashed",
            Self::Skip => "skip",
            Self::SkipOctant => "skip-octant",
            Self::Complete => "complete",
            Self::Glassner => "glassner",
        }
    }

    /// What it tests.
    pub const fn test(self) -> Test {
        match self {
            Self::LeftFirst | Self::Skip => Test::NodeLeftFirst,
            Self::Hapala | Self::SkipOctant => Test::NodeBySign,
            _ => Test::Children,
        }
    }

    /// What it wants the records to name besides the children, not to need a table beside the tree.
    pub const fn wants_recorded(self) -> Recorded {
        match self {
            Self::Sparse | Self::Afra | Self::Hapala => Recorded::ParentSibling,
            Self::Uncle | Self::Hashed => Recorded::Uncles,
            _ => Recorded::Nothing,
        }
    }

    /// Whether it asks the visitor again on the way down from the root, so that its trace is the oracle's only
    /// where the answers do not change.
    pub const fn restarts(self) -> bool {
        self.short_stack().is_some()
    }

    /// Number of nodes in Laine's short stack.
    const fn short_stack(self) -> Option<usize> {
        match self {
            Self::Laine0 => Some(0),
            Self::Laine1 => Some(1),
            Self::Laine2 => Some(2),
            Self::Laine4 => Some(4),
            Self::Laine8 => Some(8),
            _ => None,
        }
    }

    /// Whether its state has words, and so comes in several widths. The others are run once.
    pub const fn has_words(self) -> bool {
        !matches!(self, Self::Stack | Self::Hapala | Self::Skip | Self::SkipOctant)
    }

    /// Whether it exists for this word. Laine's trail is aligned to a highest bit, which a growing word has not.
    pub fn exists_for<W: KeyWord>(self) -> bool {
        W::WIDTH.is_some() || !self.restarts()
    }

    /// [`state_bytes`](Self::state_bytes) for a word that is known only when the program runs.
    pub fn state_bytes_in(self, word: WordName, depth: u32) -> usize {
        match word {
            WordName::U32 => self.state_bytes::<u32>(depth),
            WordName::U64 => self.state_bytes::<u64>(depth),
            WordName::U128 => self.state_bytes::<u128>(depth),
            WordName::Grow => self.state_bytes::<Grow>(depth),
        }
    }

    /// Bytes of its state for one ray in a tree of this depth, as Barringer & Akenine-Möller count: 4 for each
    /// variable, one word for each key, trail, counter or mask, and a head for a stack.
    pub fn state_bytes<W: KeyWord>(self, depth: u32) -> usize {
        const NODE: usize = 4;
        let word = W::bytes(depth);
        match self {
            Self::Stack => NODE + 4 + NODE * depth as usize,
            Self::LeftFirst | Self::ImplicitA1 | Self::ImplicitB1 | Self::Complete => 2 * word,
            Self::ImplicitA | Self::ImplicitB => 3 * word,
            Self::Sparse | Self::Afra => NODE + word,
            Self::Hapala => NODE + 4,
            Self::Uncle => 2 * NODE + word,
            Self::Hashed => 2 * NODE + 2 * word,
            Self::Skip | Self::SkipOctant => NODE,
            Self::HashOnly | Self::Glassner => NODE + 2 * word,
            Self::Laine0 | Self::Laine1 | Self::Laine2 | Self::Laine4 | Self::Laine8 => {
                let short = self.short_stack().unwrap_or(0);
                // Besides the nodes the short stack has a head and a length.
                NODE + 3 * word + NODE * short + if short > 0 { 8 } else { 0 }
            }
        }
    }
}

named!(Method);

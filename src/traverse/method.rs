//! The traversals by name.

use super::WordName;
use crate::key::{Grow, KeyWord};
use crate::name::named;
use crate::order::Pruning;
use crate::tree::Recorded;

/// A traversal, by the name that code, command line, suite and tables share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each is documented where it is implemented")]
pub enum Method {
    Stack,
    StackDisjoint,
    StackT0,
    LeftFirst,
    ImplicitA,
    ImplicitA1,
    ImplicitB,
    ImplicitB1,
    Sparse,
    SparseDisjoint,
    Hapala,
    Laine0,
    Laine1,
    Laine2,
    Laine4,
    Laine8,
    #[default]
    Afra,
    AfraDisjoint,
    Uncle,
    UncleDisjoint,
    HashOnly,
    Hashed,
    HashedDisjoint,
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
    /// The same; postponed nodes that are disjoint from what is found are left out. `[ORACLE-2]`
    Disjoint,
    /// The same; postponed nodes that begin beyond the end of the search are left out. `[ORACLE-3]`
    Distance,
    /// The node itself at its visit; left before right.
    NodeLeftFirst,
    /// The node itself at its visit; the near child by the sign of the ray's direction first.
    NodeBySign,
}

impl Test {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Children, Self::Disjoint, Self::Distance, Self::NodeLeftFirst, Self::NodeBySign];

    /// Which postponed nodes are not visited.
    pub const fn pruning(self) -> Pruning {
        match self {
            Self::Disjoint => Pruning::Disjoint,
            Self::Distance => Pruning::Distance,
            _ => Pruning::Never,
        }
    }
}

impl Method {
    /// All traversals, in the order of the tables.
    pub const ALL: [Self; 27] = [
        Self::Stack,
        Self::StackDisjoint,
        Self::StackT0,
        Self::LeftFirst,
        Self::ImplicitA,
        Self::ImplicitA1,
        Self::ImplicitB,
        Self::ImplicitB1,
        Self::Sparse,
        Self::SparseDisjoint,
        Self::Hapala,
        Self::Laine0,
        Self::Laine1,
        Self::Laine2,
        Self::Laine4,
        Self::Laine8,
        Self::Afra,
        Self::AfraDisjoint,
        Self::Uncle,
        Self::UncleDisjoint,
        Self::HashOnly,
        Self::Hashed,
        Self::HashedDisjoint,
        Self::Skip,
        Self::SkipOctant,
        Self::Complete,
        Self::Glassner,
    ];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stack => "stack",
            Self::StackDisjoint => "stack-disjoint",
            Self::StackT0 => "stack-t0",
            Self::LeftFirst => "left-first",
            Self::ImplicitA => "implicit-a",
            Self::ImplicitA1 => "implicit-a1",
            Self::ImplicitB => "implicit-b",
            Self::ImplicitB1 => "implicit-b1",
            Self::Sparse => "sparse",
            Self::SparseDisjoint => "sparse-disjoint",
            Self::Hapala => "hapala",
            Self::Laine0 => "laine-0",
            Self::Laine1 => "laine-1",
            Self::Laine2 => "laine-2",
            Self::Laine4 => "laine-4",
            Self::Laine8 => "laine-8",
            Self::Afra => "afra",
            Self::AfraDisjoint => "afra-disjoint",
            Self::Uncle => "uncle",
            Self::UncleDisjoint => "uncle-disjoint",
            Self::HashOnly => "hash-only",
            Self::Hashed => "hashed",
            Self::HashedDisjoint => "hashed-disjoint",
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
            Self::StackT0 => Test::Distance,
            Self::StackDisjoint
            | Self::SparseDisjoint
            | Self::AfraDisjoint
            | Self::UncleDisjoint
            | Self::HashedDisjoint => Test::Disjoint,
            _ => Test::Children,
        }
    }

    /// What it wants the records to name besides the children, not to need a table beside the tree.
    pub const fn wants_recorded(self) -> Recorded {
        match self.without_pruning() {
            Self::Sparse | Self::Afra | Self::Hapala => Recorded::ParentSibling,
            Self::Uncle | Self::Hashed => Recorded::Uncles,
            _ => Recorded::Nothing,
        }
    }

    /// Whether its state is of constant size and can be put aside ([`Pause`](super::Pause)).
    pub const fn can_pause(self) -> bool {
        matches!(self.without_pruning(), Self::Sparse | Self::Afra | Self::Uncle | Self::HashOnly | Self::Hashed)
    }

    /// The same traversal, with no postponed nodes left out: for searches that are not ordered.
    #[must_use]
    pub const fn without_pruning(self) -> Self {
        match self {
            Self::StackDisjoint | Self::StackT0 => Self::Stack,
            Self::SparseDisjoint => Self::Sparse,
            Self::AfraDisjoint => Self::Afra,
            Self::UncleDisjoint => Self::Uncle,
            Self::HashedDisjoint => Self::Hashed,
            other => other,
        }
    }

    /// The same traversal with a second trail, where that exists.
    pub const fn with_second_trail(self) -> Option<Self> {
        match self {
            Self::Sparse => Some(Self::SparseDisjoint),
            Self::Afra => Some(Self::AfraDisjoint),
            Self::Uncle => Some(Self::UncleDisjoint),
            Self::Hashed => Some(Self::HashedDisjoint),
            _ => None,
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
        !matches!(self.without_pruning(), Self::Stack | Self::Hapala | Self::Skip | Self::SkipOctant)
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
    /// variable, one word for each key, trail, counter or mask, and a head for a stack. `[STATE-1]`
    pub fn state_bytes<W: KeyWord>(self, depth: u32) -> usize {
        const NODE: usize = 4;
        let word = W::bytes(depth);
        match self {
            Self::Stack => NODE + 4 + NODE * depth as usize,
            Self::StackDisjoint | Self::StackT0 => NODE + 4 + 2 * NODE * depth as usize,
            Self::LeftFirst | Self::ImplicitA1 | Self::ImplicitB1 | Self::Complete => 2 * word,
            Self::ImplicitA | Self::ImplicitB => 3 * word,
            Self::Sparse | Self::Afra => NODE + word,
            Self::Hapala => NODE + 4,
            Self::Uncle => 2 * NODE + word,
            Self::Hashed | Self::UncleDisjoint => 2 * NODE + 2 * word,
            Self::HashedDisjoint => 2 * NODE + 3 * word,
            Self::Skip | Self::SkipOctant => NODE,
            Self::HashOnly | Self::Glassner | Self::SparseDisjoint | Self::AfraDisjoint => NODE + 2 * word,
            Self::Laine0 | Self::Laine1 | Self::Laine2 | Self::Laine4 | Self::Laine8 => {
                let short = self.short_stack().unwrap_or(0);
                // Besides the nodes the short stack has a head and a length.
                NODE + 3 * word + NODE * short + if short > 0 { 8 } else { 0 }
            }
        }
    }
}

named!(Method);

//! Kernels for wide trees: nodes of up to eight children.

use stackless_bvh::internals::wide::Ranked;
use stackless_bvh::wide::{PendingStore, Trail};

use super::{Driver, Kernel, Traversal};

/// Slots of a node.
pub const SLOTS: usize = 8;

/// The method of finding the next node of a wide tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wide {
    /// A stack in private memory. `[WSTACK-1]`
    Stack,
    /// A trail of pending sets, by parents. `[WTRAIL-1]`
    Trail,
    /// Two ranks for each level, by the ancestors in the record. `[WRECORD-1]`
    Record,
    /// Two ranks for each level, by a perfect hash of keys. `[WHASHED-1]`
    Hashed,
}

impl Kernel {
    /// All kernels for wide trees.
    pub fn wide() -> Vec<Self> {
        let kernel = |name, wide, words| {
            let (traversal, driver) = (Traversal::Wide(wide), Driver::Single);
            Self { name, traversal, driver, words }
        };
        let mut all = vec![kernel("wide-stack", Wide::Stack, 1)];
        all.extend([1, 2, 4].map(|words| kernel("wide-trail", Wide::Trail, words)));
        all.extend([kernel("wide-record", Wide::Record, 1), kernel("wide-hashed", Wide::Hashed, 2)]);
        all
    }
}

impl Wide {
    /// Whether its words limit the levels of trees.
    pub(super) const fn has_words(self) -> bool {
        !matches!(self, Self::Stack)
    }

    /// Whether its events have the levels of backtracks.
    pub(super) const fn has_levels(self) -> bool {
        !matches!(self, Self::Stack)
    }

    /// Maximum number of levels of inner nodes, as in the library. `[WIDE-14]`
    pub(super) const fn level_limit(self, words: u32) -> Option<u32> {
        match (self, words) {
            (Self::Stack, _) => None,
            (Self::Trail, 1) => Some(<Trail<u32> as PendingStore<SLOTS>>::LEVELS),
            (Self::Trail, 2) => Some(<Trail<u64> as PendingStore<SLOTS>>::LEVELS),
            (Self::Trail, _) => Some(<Trail<u128> as PendingStore<SLOTS>>::LEVELS),
            (Self::Record, _) => Some(<Ranked as PendingStore<SLOTS>>::LEVELS),
            // Three bits per level, below the first bit.
            (Self::Hashed, _) => Some((32 * words - 1) / SLOTS.trailing_zeros()),
        }
    }

    /// The parts of its text, without words and tables of keys.
    pub(super) fn parts(self) -> Vec<&'static str> {
        let mut parts = vec![include_str!("../../wgsl/eight/record.wgsl"), include_str!("../../wgsl/eight/loop.wgsl")];
        if self != Self::Hashed {
            // Tables of keys already include it.
            parts.push(include_str!("../../wgsl/wide.wgsl"));
        }
        if self == Self::Stack {
            parts.push(include_str!("../../wgsl/eight/cursor_stack.wgsl"));
            return parts;
        }
        parts.push(include_str!("../../wgsl/eight/cursor_pending.wgsl"));
        parts.push(match self {
            Self::Trail => include_str!("../../wgsl/eight/kept_trail.wgsl"),
            _ => include_str!("../../wgsl/eight/kept_ranks.wgsl"),
        });
        parts.extend(match self {
            Self::Hashed => [include_str!("../../wgsl/table.wgsl"), include_str!("../../wgsl/eight/link_hash.wgsl")],
            Self::Trail => {
                [include_str!("../../wgsl/eight/link_none.wgsl"), include_str!("../../wgsl/eight/link_parents.wgsl")]
            }
            _ => [include_str!("../../wgsl/eight/link_none.wgsl"), include_str!("../../wgsl/eight/link_record.wgsl")],
        });
        parts
    }
}

/// Stack entries for a tree of this number of levels: all children of a node, and all but one child of each ancestor.
pub(super) const fn stack_entries(levels: u32) -> u32 {
    (SLOTS as u32 - 1) * (levels + 1) + 1
}

/// Number of levels with kept ranks: a power of two, because levels are masked.
pub(super) fn kept_levels(levels: u32) -> u32 {
    levels.clamp(4, <Ranked as PendingStore<SLOTS>>::LEVELS).next_power_of_two()
}

/// The search of a decision tape, through wide trees.
pub(super) const WIDE_TAPE_SEARCH: &str =
    concat!(include_str!("../../wgsl/head.wgsl"), include_str!("../../wgsl/eight/search_tape.wgsl"));

/// The search of a ray, through wide trees.
pub(super) const WIDE_RAY_SEARCH: &str = concat!(
    include_str!("../../wgsl/arithmetic.wgsl"),
    include_str!("../../wgsl/ray.wgsl"),
    include_str!("../../wgsl/eight/search_ray.wgsl")
);

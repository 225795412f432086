//! One step of the machine that Rocq proves, written from `spec/rocq` with operators of `u128`, without the library
//! code under test.
//!
//! Numbers in Rocq are unbounded. Here they have 128 bits, which suffice for a step within the depth of the word.
//!
//! Covers `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]` `[REGISTER-2]` `[TRAIL-3]` `[TRAIL-4]` `[TRAIL-6]` `[UNCLE-1]`.

use stackless_bvh::order::Side;
use stackless_bvh::tree::Node;

use super::ladder::Ladder;
use crate::bits::Full;

/// `marked_state` of `Disjoint.v` with the register of `hashed_state` in `Register.v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The node.
    pub node: Node,
    /// Its depth.
    pub depth: u32,
    /// Its key.
    pub key: u128,
    /// The trail.
    pub trail: u128,
    /// The second trail.
    pub marks: u128,
    /// The most recently postponed node, if it is in the register.
    pub register: Option<Node>,
}

/// The answer of a visit: the child to enter, whether the other child is postponed, whether it is marked.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// The first child.
    pub first: Side,
    /// `Both` if true, otherwise `Only`.
    pub both: bool,
    /// The mark.
    pub mark: bool,
}

impl Machine {
    /// `ctz` of the trail: levels up to the ancestor whose sibling comes next.
    pub fn levels(&self) -> u32 {
        self.trail.trailing_zeros()
    }

    /// `next` of `Register.v`.
    pub fn next<W: Full, const UI: u32, const UL: u32>(&self, ladder: &Ladder<W, UI, UL>) -> Node {
        ladder.sibling_of_ancestor(self.levels())
    }

    /// `fill` of `Register.v`, at a node whose record has this number of uncles.
    pub fn filled<W: Full, const UI: u32, const UL: u32>(
        &self,
        ladder: &Ladder<W, UI, UL>,
        reach: u32,
    ) -> Option<Node> {
        let is_named = self.trail != 0 && self.trail.is_multiple_of(2) && self.levels() <= reach;
        if self.register.is_none() && is_named { Some(self.next(ladder)) } else { self.register }
    }

    /// `hashed_descend`, and `pdescend` of the second trail. Its `keep`, on which no theorem depends, is the library's:
    /// on the way into one child, the register is filled if the record of a child need not have the next node.
    #[must_use]
    pub fn descend<W: Full, const UI: u32, const UL: u32>(self, ladder: &Ladder<W, UI, UL>, wanted: Wanted) -> Self {
        let Wanted { first, both, mark } = wanted;
        let keep = self.levels() >= UI.min(UL);
        Self {
            node: ladder.child_at(first),
            depth: self.depth + 1,
            key: 2 * self.key + u128::from(first == Side::Right),
            trail: 2 * self.trail + u128::from(both),
            marks: 2 * self.marks + u128::from(mark),
            register: match both {
                true if first == Side::Right => Some(ladder.child_at(Side::Left)),
                true => Some(ladder.child_at(Side::Right)),
                false if keep => self.filled(ladder, UI),
                false => self.register,
            },
        }
    }

    /// `trail_backtrack`, and `pback` of the second trail. The register is cleared.
    pub fn backtrack<W: Full, const UI: u32, const UL: u32>(self, ladder: &Ladder<W, UI, UL>) -> Option<Self> {
        let levels = self.levels();
        (self.trail != 0).then(|| Self {
            node: self.next(ladder),
            depth: self.depth - levels,
            key: self.key >> levels ^ 1,
            trail: self.trail >> levels ^ 1,
            marks: self.marks >> levels,
            register: None,
        })
    }

    /// `pprune`, and `prune_register` of `DisjointHashed.v`.
    #[must_use]
    pub fn prune(self) -> Self {
        let trail = self.trail & !self.marks;
        let is_other = trail == 0 || trail.trailing_zeros() != self.levels();
        Self { trail, register: if is_other { None } else { self.register }, ..self }
    }

    /// `combined_index` of `Sparse.v`: the level's start and J's counter.
    pub fn counter(&self) -> u128 {
        let start = 1_u128 << self.depth;
        start + ((start - 1) ^ self.trail)
    }
}

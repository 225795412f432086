//! The reference for visits of a search through a wide tree: a recursion over child indices, with a list of the pending
//! slots of each level.

use crate::ask::{Best, WideWalk};
use crate::bits::Bits;

/// The state at a visit, before it.
#[derive(Clone, Debug)]
pub(super) struct Visit {
    pub(super) node: u32,
    pub(super) key: Bits,
    pub(super) trail: Bits,
    /// End and best hit, before the visit and after it.
    pub(super) before: (u32, Option<Best>),
    pub(super) after: (u32, Option<Best>),
    /// Number of events before the visit, including a backtrack to it.
    pub(super) events: usize,
}

/// A node of the path.
#[derive(Debug)]
struct Level {
    /// The slot of the child on the path.
    slot: u32,
    /// The pending slots, the next one first.
    pending: Vec<u32>,
}

/// A run of the reference.
#[derive(Debug)]
pub(super) struct Reference<'a> {
    walk: &'a WideWalk,
    path: Vec<Level>,
    /// Levels from the root to the last visited node.
    level: usize,
    end: u32,
    pub(super) best: Option<Best>,
    pub(super) events: Vec<String>,
    pub(super) visits: Vec<Visit>,
    /// Number of pending children that were beyond the end when they came next.
    pub(super) skipped: usize,
}

/// Whether the search has been stopped.
type Stopped = bool;

impl<'a> Reference<'a> {
    /// Runs a search from the root to its end.
    pub(super) fn run(walk: &'a WideWalk) -> Self {
        let end = walk.end.unwrap_or(u32::MAX);
        let (events, visits) = (Vec::new(), Vec::new());
        let mut reference = Self { walk, path: Vec::new(), level: 0, end, best: None, events, visits, skipped: 0 };
        let _: Stopped = reference.visit(0);
        reference.events.push("end".to_owned());
        reference
    }

    fn visit(&mut self, node: u32) -> Stopped {
        let (key, trail, seen) = (self.key(), self.trail(), self.visits.len());
        self.level = self.path.len();
        let (before, events) = ((self.end, self.best), self.events.len());
        let children = self.walk.children[node as usize].as_ref();
        self.events.push(format!("{} {}", if children.is_some() { "enter" } else { "leaf" }, key.hex()));
        self.visits.push(Visit { node, key, trail, before, after: before, events });
        let Some(children) = children else {
            let stopped = self.leaf(node);
            self.visits[seen].after = (self.end, self.best);
            return stopped;
        };
        self.path.push(Level { slot: 0, pending: self.wanted(node) });
        let mut stopped = false;
        while let Some(slot) = self.next_slot().filter(|_| !stopped) {
            if self.is_beyond(self.rank(node, slot)) {
                self.skipped += 1;
                continue;
            }
            // The first child is visited directly after its parent.
            if self.visits.len() > seen + 1 {
                let up = self.level - self.path.len();
                self.events.push(format!("backtrack {} {up}", self.key().hex()));
            }
            stopped = self.visit(children[slot as usize]);
        }
        self.path.pop();
        stopped
    }

    /// Removes the next slot and makes it the slot on the path.
    fn next_slot(&mut self) -> Option<u32> {
        let level = self.path.last_mut()?;
        if level.pending.is_empty() {
            return None;
        }
        level.slot = level.pending.remove(0);
        Some(level.slot)
    }

    fn rank(&self, node: u32, slot: u32) -> Option<u32> {
        self.walk.ranks[node as usize].as_ref().and_then(|ranks| ranks[slot as usize])
    }

    /// `[WIDE-3]`
    fn is_beyond(&self, rank: Option<u32>) -> bool {
        self.is_sorted() && rank.is_some_and(|rank| rank - rank % self.walk.slots > self.end)
    }

    fn is_sorted(&self) -> bool {
        self.walk.sorted != Some(false)
    }

    /// Returns the slots of the wanted children in their order. `[WIDE-5]` `[WIDE-6]`
    fn wanted(&self, node: u32) -> Vec<u32> {
        let children = self.walk.children[node as usize].iter().flatten();
        let mut wanted: Vec<(u32, u32)> = (0..)
            .zip(children)
            .filter_map(|(slot, &child)| {
                let rank = self.rank(node, slot)?;
                let is_inner = self.walk.children[child as usize].is_some();
                let place = if self.is_sorted() { rank } else { u32::from(is_inner) };
                (!self.is_beyond(Some(rank))).then_some((place, slot))
            })
            .collect();
        wanted.sort_unstable();
        wanted.into_iter().map(|(_, slot)| slot).collect()
    }

    fn leaf(&mut self, node: u32) -> Stopped {
        let hit = self.walk.hits.as_ref().and_then(|hits| hits[node as usize]).filter(|&t| t <= self.end);
        let Some(t) = hit else { return false };
        let hit = Best { t, node };
        self.end = t;
        if self.best.is_none_or(|best| hit < best) {
            self.best = Some(hit);
        }
        self.walk.any == Some(true)
    }

    /// `[WIDE-9]`
    fn key(&self) -> Bits {
        let bits = self.walk.slots.trailing_zeros();
        let of = |level: &Level| (0..bits).rev().map(|bit| level.slot >> bit & 1 == 1).collect::<Vec<_>>();
        Bits([vec![true], self.path.iter().flat_map(of).collect()].concat())
    }

    /// `[WIDE-10]`
    fn trail(&self) -> Bits {
        let of =
            |level: &Level| (0..self.walk.slots).rev().map(|slot| level.pending.contains(&slot)).collect::<Vec<_>>();
        let trail: Vec<bool> = self.path.iter().flat_map(of).collect();
        Bits(if trail.is_empty() { vec![false] } else { trail })
    }
}

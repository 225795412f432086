//! Vaidyanathan et al. 2019: a restart trail, and a short stack.

use super::pending_store::StateView;
use super::search::{Ranks, Search, Wanted, is_beyond};
use super::tree::Topology;
use super::tree::slot_bits;
use super::{Cursor, Next};
use crate::key::TooDeep;
use crate::tree::Node;

/// Stores for each level the number of the last returned child, and the last postponed children, at most 8. A child
/// that this short stack has lost is found by a restart at the root. `[WRESTART-1]`
#[derive(Debug)]
pub struct Restart {
    node: Node,
    /// Level of `node`, while the search descends again from the root.
    at: u32,
    /// The deepest level on the path.
    level: u32,
    /// For each level on the path the number of the last returned child, in the order of ranks; the current level's is
    /// lowest. The highest bit means that no other child comes after it.
    done: u128,
    step: Step,
    stack: Short,
}

/// The step that reached `node`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// A first descent.
    Down,
    /// A restart: the root.
    Again,
    /// A repeated descent, below the root.
    Along,
}

impl Restart {
    /// Starts at the root, with a short stack of this many entries, at most 8.
    ///
    /// # Errors
    /// [`TooDeep`] if the tree has more levels than numbers fit in 128 bits.
    pub fn new<const A: usize>(tree: &impl Topology<A>, short: usize) -> Result<Self, TooDeep> {
        let (levels, limit) = (tree.levels(), u128::BITS / number_bits::<A>() - 1);
        if levels > limit {
            return Err(TooDeep { depth: levels, limit, word: "a number for each level in 128 bits" });
        }
        let stack = Short { entries: [Entry::NONE; Short::MOST], size: short.min(Short::MOST), top: 0, count: 0 };
        Ok(Self { node: tree.root(), at: 0, level: 0, done: 0, step: Step::Down, stack })
    }

    /// Returns the number of the last returned child, `up` levels above the current one.
    const fn number<const A: usize>(&self, up: u32) -> usize {
        (self.done >> (up * number_bits::<A>())) as usize & (A - 1)
    }

    /// Returns the child with this number among the wanted ones, and postpones those after it.
    fn take<const A: usize, S: Search<A>>(
        &mut self,
        tree: &impl Topology<A>,
        wanted: Wanted<S::Ranks>,
        number: usize,
    ) -> Option<Node> {
        let sorted = Sorted::<A>::of::<S>(wanted);
        let last = sorted.count.checked_sub(1).filter(|&last| number <= last)?;
        for i in (number + 1..=last).rev() {
            let (rank, level) = (sorted.ranks[i], self.level);
            let node = tree.child(self.node, rank & (A as u32 - 1));
            self.stack.push(Entry { level, rank, node, is_last: i == last });
        }
        self.name::<A>(number, number == last);
        Some(tree.child(self.node, sorted.ranks[number] & (A as u32 - 1)))
    }

    const fn name<const A: usize>(&mut self, number: usize, is_last: bool) {
        self.done = (self.done >> number_bits::<A>() << number_bits::<A>()) | number as u128;
        if is_last {
            self.finish::<A>();
        }
    }

    /// Marks that no other child of the current level comes.
    const fn finish<const A: usize>(&mut self) {
        self.done |= A as u128;
    }

    /// Climbs to this level.
    const fn up_to<const A: usize>(&mut self, level: u32) {
        self.done >>= (self.level - level) * number_bits::<A>();
        self.level = level;
    }

    /// Returns the next child of the deepest level that has one: from the short stack, or the root, for a restart.
    fn back<const A: usize, S: Search<A>>(&mut self, tree: &impl Topology<A>, search: &S) -> Option<Node> {
        self.step = Step::Down;
        loop {
            while self.done & A as u128 != 0 {
                let above = self.level.checked_sub(1)?;
                self.up_to::<A>(above);
            }
            let Some(entry) = self.stack.pop() else {
                (self.step, self.at) = (Step::Again, 0);
                return Some(tree.root());
            };
            if entry.level > self.level {
                // The entry of a finished level: it was beyond.
            } else if S::SORTED && is_beyond::<A>(entry.rank, search.end()) {
                self.finish::<A>();
            } else {
                self.name::<A>(self.number::<A>(0) + 1, entry.is_last);
                return Some(entry.node);
            }
        }
    }
}

/// Returns the bits of a number, and of the mark of the last child.
const fn number_bits<const A: usize>() -> u32 {
    slot_bits::<A>() + 1
}

impl<const A: usize> Cursor<A> for Restart {
    const RESTARTS: bool = true;

    fn reset(&mut self, tree: &impl Topology<A>) {
        (self.node, self.at, self.level, self.done, self.step) = (tree.root(), 0, 0, 0, Step::Down);
        self.stack.count = 0;
    }

    fn node(&self) -> Node {
        self.node
    }

    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>,
    {
        if self.step != Step::Down && self.at < self.level {
            let sorted = Sorted::<A>::of::<S>(wanted);
            let number = self.number::<A>(self.level - self.at);
            if number < sorted.count {
                self.step = Step::Along;
                return Next::Child(tree.child(self.node, sorted.ranks[number] & (A as u32 - 1)));
            }
            // The child on the path is now beyond, with all nodes below it and after it.
            self.up_to::<A>(self.at);
            self.finish::<A>();
            return self.next(tree, search);
        }
        let number = if self.step == Step::Down { 0 } else { self.number::<A>(0) + 1 };
        self.step = Step::Down;
        if let Some(child) = self.take::<A, S>(tree, wanted, number) {
            return Next::Child(child);
        }
        self.finish::<A>();
        self.next(tree, search)
    }

    fn next<T: Topology<A>, S: Search<A>>(&mut self, tree: &T, search: &mut S) -> Next {
        self.back(tree, search).into()
    }

    fn enter(&mut self, node: Node) {
        self.node = node;
        match self.step {
            Step::Again => {}
            Step::Along => self.at += 1,
            Step::Down => {
                self.level += 1;
                self.done <<= number_bits::<A>();
            }
        }
    }

    fn is_restarting(&self) -> bool {
        self.step != Step::Down
    }

    fn words(&self, up: u32) -> Option<StateView> {
        let below = if Cursor::<A>::is_restarting(self) { self.level - self.at } else { 0 };
        let is_last = self.done >> ((up + below) * number_bits::<A>()) & A as u128 != 0;
        Some(StateView::Number { number: self.number::<A>(up + below) as u32, is_last })
    }
}

/// The wanted children in their order.
struct Sorted<const A: usize> {
    ranks: [u32; A],
    count: usize,
}

impl<const A: usize> Sorted<A> {
    fn of<S: Search<A>>(Wanted { mut set, ranks }: Wanted<S::Ranks>) -> Self {
        let mut sorted = Self { ranks: [u32::MAX; A], count: 0 };
        while set != 0 {
            let slot = set.trailing_zeros();
            set &= set - 1;
            sorted.ranks[sorted.count] = if S::SORTED { ranks.rank(slot) } else { slot };
            sorted.count += 1;
        }
        sorted.ranks.sort_unstable();
        sorted
    }
}

/// A postponed child.
#[derive(Clone, Copy, Debug)]
struct Entry {
    /// The level of its parent.
    level: u32,
    rank: u32,
    node: Node,
    /// Whether it is the last of its siblings.
    is_last: bool,
}

impl Entry {
    const NONE: Self = Self { level: 0, rank: 0, node: Node::inner(0), is_last: false };
}

/// The last entries of a stack.
#[derive(Debug)]
struct Short {
    entries: [Entry; Short::MOST],
    /// Capacity.
    size: usize,
    /// The place of the next entry.
    top: usize,
    count: usize,
}

impl Short {
    const MOST: usize = 8;

    fn push(&mut self, entry: Entry) {
        if self.size > 0 {
            self.entries[self.top] = entry;
            self.top = (self.top + 1) % self.size;
            self.count = (self.count + 1).min(self.size);
        }
    }

    fn pop(&mut self) -> Option<Entry> {
        self.count = self.count.checked_sub(1)?;
        self.top = (self.top + self.size - 1) % self.size;
        Some(self.entries[self.top])
    }
}

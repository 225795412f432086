//! Wide trees, and searches through them.

use alloc::vec;
use alloc::vec::Vec;

use super::Source;
use crate::hash::mix;
use crate::order::Flow;
use crate::tree::Node;
use crate::wide::{Search, Topology, Tree, Wanted, is_beyond};

/// Returns the children of every node of a wide tree with this many leaves, for [`Tree::new`]; `chain` is the number of
/// inner nodes with one child.
pub fn wide_shape<const A: usize>(source: &mut impl Source, leaves: u32, chain: u32) -> Vec<Option<Vec<u32>>> {
    let mut nodes: Vec<Option<Vec<u32>>> = vec![None];
    let mut chain = chain;
    // Inner nodes without children so far, with the number of leaves below them.
    let mut open = vec![(0, leaves.max(1))];
    while let Some((node, leaves)) = open.pop() {
        let is_link = leaves > 1 && chain > 0 && source.coin();
        chain -= u32::from(is_link);
        let is_single = leaves == 1 || is_link;
        let count = if is_single { 1 } else { 2 + source.below(u64::from(leaves.min(A as u32)) - 1) as u32 };
        let mut left = leaves;
        let mut children = Vec::new();
        for others in (0..count).rev() {
            let below = if others == 0 { left } else { 1 + source.below(u64::from(left - others)) as u32 };
            left -= below;
            let child = nodes.len() as u32;
            nodes.push(None);
            children.push(child);
            let is_inner = below > 1 || chain > 0 && source.coin();
            if is_inner {
                chain -= u32::from(below == 1);
                open.push((child as usize, below));
            }
        }
        nodes[node] = Some(children);
    }
    nodes
}

/// Builds the wide tree of a generator, whose output is always a tree. If it were not, the result would be an empty
/// tree, which the generators' tests would detect.
pub fn wide_tree<const A: usize>(children: &[Option<Vec<u32>>]) -> Tree<A> {
    let lists: Vec<Option<&[u32]>> = children.iter().map(Option::as_deref).collect();
    let tree = Tree::new(&lists);
    debug_assert!(tree.is_ok(), "{tree:?}");
    tree.unwrap_or_default()
}

/// The answers of a search about every node of a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WideTape<const A: usize> {
    cells: Vec<WideCell<A>>,
    /// [`Self::MONOTONE`] and so on.
    kind: u8,
}

/// The entry of a node in a tape. `[WIDE-2]` `[WIDE-3]`
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WideAnswer {
    /// Whether its parent wants it.
    pub is_wanted: bool,
    /// The start of its box: a multiple of A.
    pub begin: u32,
    /// For a leaf: the new end of the search, if the previous end is greater.
    pub end: Option<u32>,
}

/// The answer about one node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct WideCell<const A: usize> {
    set: u32,
    ranks: [u32; A],
    /// For a leaf: the new end, if the previous end is greater.
    end: u32,
    stops: bool,
}

impl<const A: usize> WideTape<A> {
    /// Ranks do not decrease on the way down.
    const MONOTONE: u8 = 1;
    /// The wanted children depend on the number of visited leaves.
    const CHANGING: u8 = 2;

    /// Draws the answers: ranks and ends below `distances`.
    pub fn draw(source: &mut impl Source, tree: &Tree<A>, distances: u32) -> Self {
        let low = A as u32;
        let kind = source.below(4) as u8;
        let mut answers = vec![WideAnswer::default(); tree.node_count()];
        let mut order = vec![tree.root()];
        while let Some(node) = order.pop() {
            if node.is_leaf() {
                let end = source.below(u64::from(distances) + 1) as u32;
                answers[node.index()].end = end.checked_sub(1).map(|end| end * low);
                continue;
            }
            let children = tree.children(node);
            for slot in (0..low).filter(|slot| children >> slot & 1 == 1) {
                let child = tree.child(node, slot);
                let drawn = source.below(u64::from(distances) + 1) as u32;
                let above = if kind & Self::MONOTONE != 0 { answers[node.index()].begin } else { 0 };
                let begin = above.max(drawn.saturating_sub(1) * low);
                answers[child.index()] = WideAnswer { is_wanted: drawn > 0, begin, end: None };
                order.push(child);
            }
        }
        Self { kind, ..Self::of(tree, &answers) }
    }

    /// Creates the tape with these constant answers. A node without an answer wants no child.
    pub fn of(tree: &Tree<A>, answers: &[WideAnswer]) -> Self {
        let answer = |node: Node| answers.get(node.index()).copied().unwrap_or_default();
        let cell = |node: Node| {
            let mut cell = WideCell { set: 0, ranks: [0; A], end: answer(node).end.unwrap_or(u32::MAX), stops: false };
            let children = if node.is_leaf() { 0 } else { tree.children(node) };
            for slot in (0..A as u32).filter(|slot| children >> slot & 1 == 1) {
                let WideAnswer { is_wanted, begin, .. } = answer(tree.child(node, slot));
                cell.set |= u32::from(is_wanted) << slot;
                cell.ranks[slot as usize] = begin & !(A as u32 - 1) | slot;
            }
            cell
        };
        let is_monotone = |parent: Node| {
            let children = if parent.is_leaf() { 0 } else { tree.children(parent) };
            let mut slots = (0..A as u32).filter(|slot| children >> slot & 1 == 1);
            slots.all(|slot| answer(parent).begin <= answer(tree.child(parent, slot)).begin)
        };
        let kind = if tree.nodes().all(is_monotone) { Self::MONOTONE } else { 0 };
        Self { cells: tree.nodes().map(cell).collect(), kind }
    }

    /// Returns this tape with an end of the search at a leaf.
    #[must_use]
    pub fn stopping_at(mut self, leaf: Node) -> Self {
        self.cells[leaf.index()].stops = true;
        self
    }

    /// Returns whether ranks do not decrease on the way down: traversals that restart require this. `[WRESTART-1]`
    pub const fn is_monotone(&self) -> bool {
        self.kind & Self::MONOTONE != 0
    }
}

/// The search of a tape. `SORTED` is [`Search::SORTED`].
#[derive(Clone, Debug)]
pub struct WideSearch<'t, const A: usize, const SORTED: bool> {
    tape: &'t WideTape<A>,
    end: u32,
    /// The wanted children of each node at its first query.
    wanted: Vec<Option<u32>>,
    leaves: u64,
    asked: u64,
}

impl<'t, const A: usize, const SORTED: bool> WideSearch<'t, A, SORTED> {
    /// Starts a search.
    pub fn new(tape: &'t WideTape<A>) -> Self {
        Self { tape, end: u32::MAX, wanted: vec![None; tape.cells.len()], leaves: 0, asked: 0 }
    }

    /// Returns the number of queries.
    pub const fn asked(&self) -> u64 {
        self.asked
    }

    fn first(&self, node: Node) -> u32 {
        let cell = &self.tape.cells[node.index()];
        // With the rank, so not all tapes have the same answer about the root before the first leaf.
        let of_node = node.index() as u64 | u64::from(cell.ranks[0]) << 32;
        let seen = mix(mix(self.leaves + 1) ^ of_node) as u32;
        if self.tape.kind & WideTape::<A>::CHANGING == 0 { cell.set } else { cell.set & seen }
    }
}

impl<const A: usize, const SORTED: bool> Search<A> for WideSearch<'_, A, SORTED> {
    const SORTED: bool = SORTED;
    type Ranks = [u32; A];

    fn ask(&mut self, node: Node) -> Wanted<[u32; A]> {
        self.asked += 1;
        let ranks = self.tape.cells[node.index()].ranks;
        let within = (0..A).filter(|&slot| !is_beyond::<A>(ranks[slot], self.end)).fold(0, |set, slot| set | 1 << slot);
        let set = match self.wanted[node.index()] {
            Some(set) => set & within,
            None => self.first(node) & if SORTED { within } else { u32::MAX },
        };
        self.wanted[node.index()].get_or_insert(set);
        Wanted { set, ranks }
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        self.leaves += 1;
        let cell = &self.tape.cells[leaf.index()];
        if SORTED {
            self.end = self.end.min(cell.end);
        }
        if cell.stops { Flow::Stop } else { Flow::Continue }
    }

    fn end(&self) -> u32 {
        self.end
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::generate::Rng;

    /// The wanted children of the root before any leaf, and after several leaves, by tapes whose answers change.
    #[test]
    fn answers_change() {
        let tree: Tree<4> = wide_tree(&[Some(vec![1, 2, 3, 4]), None, None, None, None]);
        let mut rng = Rng::new(1);
        let tapes: Vec<_> = (0..400).map(|_| WideTape::draw(&mut rng, &tree, 1000)).collect();
        let changing = tapes.iter().filter(|tape| tape.kind & WideTape::<4>::CHANGING != 0);
        let after = |leaves| -> HashSet<u32> {
            let search = |tape| WideSearch::<4, false> { leaves, ..WideSearch::new(tape) };
            changing.clone().map(|tape| search(tape).ask(tree.root()).set).collect()
        };
        assert_eq!((after(0).len(), after(1).len()), (16, 16));
        let differ = changing.clone().filter(|tape| {
            let set = |leaves| WideSearch::<4, false> { leaves, ..WideSearch::new(tape) }.ask(tree.root()).set;
            set(0) != set(1)
        });
        assert!(2 * differ.count() > changing.count());
    }
}

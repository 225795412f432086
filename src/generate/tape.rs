//! Decision tapes: the decisions of a search at each node, without geometry and without floats.
//!
//! A tape is a small scene: each node is entered at an integer distance, or missed, and a leaf may be hit at a
//! distance. A [`Search`] over it is a closest-hit or any-hit query, in the form that tests children at their parent
//! and in the form that tests nodes at their visit. A hit shortens the search, so later decisions change.

use alloc::vec;
use alloc::vec::Vec;

use super::{Rng, Source};
use crate::hash::mix;
use crate::name::named;
use crate::order::{Descent, Flow, NodeTest, Pruned, Pruning, Repeatable, Visitor};
use crate::tree::{Node, Topology, for_each_parent};

/// A kind of tape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Every child is missed or wanted, and preferred or not, at random.
    Random,
    /// Every node is wanted.
    AllHit,
    /// Every child is missed.
    NoneHit,
    /// Exactly one child of each node is wanted.
    OnlyOne,
    /// Every node is wanted; left and right come first on alternate levels.
    Alternating,
    /// Nodes have distances, the nearer child comes first, hits shorten the search.
    Shrinking,
    /// Nodes have intervals, each within its parent's; leaves are hit within their intervals. The child that begins
    /// first comes first, hits shorten the search.
    Intervals,
    /// As `Intervals`, but leaves may be hit beyond the ends of their intervals: leaves that hold parts of triangles.
    Clipped,
    /// One of the five decisions for each reached node, and no hits: the kind for enumerations. Sign order under the
    /// octant 2 (binary 010) is the tape's own order.
    Script,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 9] = [
        Self::Random,
        Self::AllHit,
        Self::NoneHit,
        Self::OnlyOne,
        Self::Alternating,
        Self::Shrinking,
        Self::Intervals,
        Self::Clipped,
        Self::Script,
    ];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::AllHit => "all-hit",
            Self::NoneHit => "none-hit",
            Self::OnlyOne => "only-one",
            Self::Alternating => "alternating",
            Self::Shrinking => "shrinking",
            Self::Intervals => "intervals",
            Self::Clipped => "clipped",
            Self::Script => "script",
        }
    }
}

named!(Kind);

/// The entry of one node in a tape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Cell {
    /// The node is missed: no node below it is visited.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_default"))]
    pub miss: bool,
    /// Distance of the entry, at least its parent's; the root may also be entered late.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_default"))]
    pub enter: u32,
    /// Distance of the exit, at most its parent's; `None` is beyond all other distances.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_default"))]
    pub exit: Option<u32>,
    /// For an inner node: the right child comes first if both are entered at the same distance.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_default"))]
    pub right_first: bool,
    /// For an inner node: the axis (0, 1, 2) whose sign orders its children, for traversals of fixed order.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_default"))]
    pub axis: u8,
    /// For a leaf that is not missed: distance of the hit, at least that of its entry. It may be beyond the exit, if a
    /// leaf holds a part of a triangle and the rest of the triangle is hit.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_default"))]
    pub hit: Option<u32>,
}

/// Whether a file omits the field.
#[cfg(feature = "serde")]
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Cell {
    fn ends(&self) -> u32 {
        self.exit.unwrap_or(u32::MAX)
    }
}

/// A decision tape for one tree: a [`Cell`] for each node, by slot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tape {
    cells: Vec<Cell>,
    axes: Vec<u8>,
}

impl Tape {
    /// Draws a tape, one cell after the other, parents before children, left before right.
    pub fn draw(source: &mut impl Source, tree: &impl Topology, kind: Kind) -> Self {
        Self::fill(tree, |_| (), |(), _| (), |(), parent, depth| draw_inner(source, kind, parent, depth))
    }

    /// Returns the tape of a seed: the cells of a node's children are a function of the seed and the node's key alone,
    /// so any language can build the same tape.
    ///
    /// The generator for node `k` is `SplitMix64` seeded with `h(k)`: `h(1) = mix(seed)` and `h(2k + b) = mix(h(k) ^ (b +
    /// 1))`.
    pub fn hashed(seed: u64, tree: &impl Topology, kind: Kind) -> Self {
        Self::fill(
            tree,
            |_| mix(seed),
            |hash, right| mix(hash ^ (u64::from(right) + 1)),
            |hash, parent, depth| draw_inner(&mut Rng::new(hash), kind, parent, depth),
        )
    }

    /// Creates a tape with these cells, by slot.
    ///
    /// `None` if there is not one for each node, a child is entered before its parent or left after it, a leaf is hit
    /// or a node left before it is entered, or an axis is not 0, 1 or 2. The root may be missed or entered late: only
    /// searches that test nodes at their visit use this.
    pub fn from_cells(tree: &impl Topology, cells: Vec<Cell>) -> Option<Self> {
        if cells.len() != tree.node_count() {
            return None;
        }
        let mut pending = vec![tree.root()];
        while let Some(node) = pending.pop() {
            let cell = cells[tree.slot(node)];
            if cell.ends() < cell.enter {
                return None;
            }
            if node.is_leaf() {
                if cell.hit.is_some_and(|hit| hit < cell.enter) {
                    return None;
                }
                continue;
            }
            let children = tree.children(node);
            let juts_out = |child: Cell| child.enter < cell.enter || child.ends() > cell.ends();
            if cell.axis > 2 || children.iter().any(|&child| juts_out(cells[tree.slot(child)])) {
                return None;
            }
            pending.extend(children);
        }
        Some(Self::new(tree, cells))
    }

    /// Returns the cells, by slot.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Returns the axes, by index of the inner node, for [`SignOrder`](crate::order::SignOrder).
    pub fn axes(&self) -> &[u8] {
        &self.axes
    }

    fn new(tree: &impl Topology, cells: Vec<Cell>) -> Self {
        let mut axes = vec![0; cells.len()];
        for_each_parent(tree, |node, _| axes[node.index()] = cells[tree.slot(node)].axis);
        Self { cells, axes }
    }

    /// Walks down with a state for each node, `child` of its parent's, and draws the cells of each pair of children.
    fn fill<T: Topology, S: Copy>(
        tree: &T,
        root: impl FnOnce(&T) -> S,
        child: impl Fn(S, bool) -> S,
        mut inner: impl FnMut(S, &mut Cell, u32) -> [Cell; 2],
    ) -> Self {
        let mut cells = vec![Cell::default(); tree.node_count()];
        let mut pending = vec![(tree.root(), root(tree), 0)];
        while let Some((node, state, depth)) = pending.pop() {
            if node.is_leaf() {
                continue;
            }
            let children = tree.children(node);
            let cell = &mut cells[tree.slot(node)];
            // No node below a missed node is visited, so nothing is drawn there: the simplest valid cells.
            let drawn =
                if cell.miss { [Cell { miss: true, ..interval_of(cell) }; 2] } else { inner(state, cell, depth) };
            for (i, cell) in drawn.into_iter().enumerate() {
                let hit = cell.hit.filter(|_| children[i].is_leaf());
                cells[tree.slot(children[i])] = Cell { hit, ..cell };
            }
            pending.push((children[1], child(state, true), depth + 1));
            pending.push((children[0], child(state, false), depth + 1));
        }
        Self::new(tree, cells)
    }
}

/// Draws order and axis of an inner node, and the cells of its two children.
fn draw_inner(source: &mut impl Source, kind: Kind, node: &mut Cell, depth: u32) -> [Cell; 2] {
    let mut children = [interval_of(node); 2];
    if kind == Kind::Script {
        let decision = source.below(5);
        (children[0].miss, children[1].miss) = (matches!(decision, 0 | 2), matches!(decision, 0 | 1));
        node.right_first = decision == 4;
        node.axis = u8::from(node.right_first);
        return children;
    }
    node.right_first = match kind {
        Kind::Alternating => depth % 2 == 1,
        Kind::NoneHit => false,
        _ => source.coin(),
    };
    node.axis = source.below(3) as u8;
    match kind {
        Kind::AllHit | Kind::Alternating | Kind::Script => {}
        Kind::Random => children.iter_mut().for_each(|child| child.miss = source.below(4) == 1),
        Kind::NoneHit => children.iter_mut().for_each(|child| child.miss = true),
        Kind::OnlyOne => children[usize::from(source.coin())].miss = true,
        Kind::Shrinking => {
            for child in &mut children {
                child.enter += source.below(8) as u32;
                child.miss = source.below(8) == 1;
                let distance = source.below(64) as u32;
                child.hit = source.coin().then_some(child.enter + distance);
            }
        }
        Kind::Intervals | Kind::Clipped => {
            let exit = node.exit.unwrap_or(ROOT_EXIT);
            for child in &mut children {
                // Two intervals within the parent's, more often disjoint than not.
                let length = u64::from(exit - child.enter);
                let [a, b] = [(); 2].map(|()| source.below(length + 1) as u32);
                (child.exit, child.enter) = (Some(child.enter + a.max(b)), child.enter + a.min(b));
                child.miss = source.below(8) == 1;
                let reach = if kind == Kind::Clipped { exit } else { child.ends() };
                let distance = source.below(u64::from(reach - child.enter) + 1) as u32;
                child.hit = source.coin().then_some(child.enter + distance);
            }
        }
    }
    // Tapes without distances still have leaves that end an any-hit search.
    if !matches!(kind, Kind::Shrinking | Kind::Intervals | Kind::Clipped) {
        for child in &mut children {
            child.hit = (source.below(8) == 1).then_some(u32::MAX - 1);
        }
    }
    children
}

/// The exit of the children's parent, where that is the root, which has none.
const ROOT_EXIT: u32 = 1 << 20;

/// A cell that is entered and left where `cell` is.
fn interval_of(cell: &Cell) -> Cell {
    Cell { enter: cell.enter, exit: cell.exit, ..Cell::default() }
}

/// The result of a search, in an order-free form, and its cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// Distance and slot of the closest hit, the smaller slot if distances are equal; for an any-hit search the first
    /// hit.
    pub hit: Option<(u32, usize)>,
    /// Queried inner nodes.
    pub inner_visits: u64,
    /// Visited leaves.
    pub leaf_visits: u64,
}

/// A query over a tape.
#[derive(Clone, Debug)]
pub struct Search<'a, T> {
    tree: &'a T,
    tape: &'a Tape,
    any: bool,
    /// The result so far.
    pub outcome: Outcome,
}

impl<'a, T: Topology> Search<'a, T> {
    /// Creates a closest-hit query, or an any-hit query, which stops at its first hit.
    pub fn new(tree: &'a T, tape: &'a Tape, any: bool) -> Self {
        Self { tree, tape, any, outcome: Outcome::default() }
    }

    #[inline]
    fn cell(&self, node: Node) -> &Cell {
        &self.tape.cells[self.tree.slot(node)]
    }

    /// Tests a node: not missed, and not entered behind the closest hit. Without a branch, which would be
    /// unpredictable.
    #[inline]
    fn is_wanted(&self, cell: &Cell) -> bool {
        !cell.miss & (cell.enter <= self.outcome.hit.map_or(u32::MAX, |(t, _)| t))
    }

    #[inline]
    fn look_into(&mut self, leaf: Node) -> Flow {
        let slot = self.tree.slot(leaf);
        let cell = &self.tape.cells[slot];
        if let Some(t) = cell.hit.filter(|_| !cell.miss)
            && self.outcome.hit.is_none_or(|best| (t, slot) < best)
        {
            self.outcome.hit = Some((t, slot));
            if self.any {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }
}

impl<T: Topology> Visitor for Search<'_, T> {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        self.outcome.inner_visits += 1;
        let [left, right] = self.tree.children(node).map(|child| self.cell(child));
        let right_first = (right.enter < left.enter) | ((left.enter == right.enter) & self.cell(node).right_first);
        Descent::new(self.is_wanted(left), self.is_wanted(right), right_first)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.outcome.leaf_visits += 1;
        self.look_into(node)
    }
}

impl<T: Topology> Pruned for Search<'_, T> {
    fn allows(&self, _: Pruning) -> bool {
        true
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        let descent = self.inner(node);
        let [first, second] =
            [descent.first(), descent.first().other()].map(|side| self.cell(self.tree.child(node, side)));
        descent.disjoint_if(first.ends() < second.enter)
    }

    /// A hit beyond its leaf may come after hits in other leaves.
    fn found_at(&self, leaf: Node) -> bool {
        let slot = self.tree.slot(leaf);
        self.outcome.hit.is_some_and(|(t, best)| best == slot && t <= self.tape.cells[slot].ends())
    }

    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        self.cell(self.tree.child(node, descent.first().other())).enter
    }

    fn end(&self) -> u32 {
        self.outcome.hit.map_or(u32::MAX, |(t, _)| t)
    }
}

impl<T: Topology> Repeatable for Search<'_, T> {}

impl<T: Topology> NodeTest for Search<'_, T> {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        self.outcome.inner_visits += 1;
        self.is_wanted(self.cell(node))
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.outcome.leaf_visits += 1;
        if self.is_wanted(self.cell(node)) { self.look_into(node) } else { Flow::Continue }
    }
}

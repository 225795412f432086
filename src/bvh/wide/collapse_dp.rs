//! The dynamic programme that selects the descendants of a node that become its children.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use fearless_simd::{Level, Select, Simd, SimdBase, f32x8, u32x8};

use super::{CUT, WideOptions};
use crate::bvh::BuildError;
use crate::bvh::build::{Draft, Record, room};
use crate::geom::lanes::{levels, vectorize};
use crate::threads;

/// The cheapest forests below each node of a tree, by the number of their roots. `[BUILD-6]`
///
/// Ylitie, Karras & Laine 2017, section 4. For a node and each i from 1 to A, this is the cheapest forest of at most i
/// roots. With one root, it is a leaf, or an inner node over the forest of at most A roots below the two children
/// together. With more roots, it is one with fewer roots, or forests below the left child and the right child.
pub(super) struct CollapseDp<'a, const A: usize> {
    pub(super) draft: &'a Draft,
    options: WideOptions,
    level: Level,
    /// A [`Decision`] for each pair of children. Each thread writes separate ones.
    decisions: Vec<AtomicU64>,
}

/// Numbers of roots below the left child: first, for the forest below an inner node, or 0 if a leaf is cheaper; then
/// for the node's forests of at most 2 to A roots, or 0 if one with fewer roots is equally cheap.
type Decision = [u8; 8];

/// Costs of the forests of at most 1 to 8 roots.
type Costs = [f32; 8];

/// Index in a [`Decision`] of the entry for an inner node.
const INNER: usize = 0;

impl<'a, const A: usize> CollapseDp<'a, A> {
    pub(super) fn of(draft: &'a Draft, options: &WideOptions) -> Result<Self, BuildError> {
        let mut decisions = room(draft.nodes.len() / 2)?;
        decisions.resize_with(draft.nodes.len() / 2, AtomicU64::default);
        let collapse_dp = Self { draft, options: *options, level: levels()[0].1, decisions };
        // All threads process the subtrees that are small. Then comes the part above them.
        let (mut above, mut short, mut pending) = (Vec::new(), Vec::new(), vec![0]);
        while let Some(place) = pending.pop() {
            let node = draft.node(place);
            above.push(place);
            if node.count() > CUT {
                pending.extend([node.first() + 1, node.first()]);
            } else {
                short.push(place);
            }
        }
        let costs = threads::map_with(
            0..short.len(),
            1,
            Memory::default,
            |memory, i| vectorize!(collapse_dp.level, simd => collapse_dp.solve(simd, short[i], memory)),
        );
        let mut costs = costs.into_iter();
        let mut memory = Memory { order: above, ..Memory::default() };
        vectorize!(collapse_dp.level, simd => collapse_dp.fold(simd, &mut memory, |node| {
            if node.count() > CUT { None } else { costs.next_back() }
        }));
        Ok(collapse_dp)
    }

    #[inline(always)]
    fn solve<S: Simd>(&self, simd: S, root: u32, memory: &mut Memory) -> Costs {
        memory.order.clear();
        memory.pending.push(root);
        while let Some(place) = memory.pending.pop() {
            memory.order.push(place);
            let node = self.draft.node(place);
            if node.count() > 2 {
                memory.pending.extend([node.first() + 1, node.first()]);
            }
        }
        self.fold(simd, memory, |node| match node.count() {
            1 => Some([node.half_area() * self.options.block_cost; 8]),
            2 => Some(self.pair(node)),
            _ => None,
        })
    }

    /// Computes the costs of the first node from all nodes, parents before children, left before right; `known` has the
    /// costs of nodes without children.
    #[inline(always)]
    fn fold<S: Simd>(&self, simd: S, memory: &mut Memory, mut known: impl FnMut(&Record) -> Option<Costs>) -> Costs {
        memory.known.clear();
        for &place in memory.order.iter().rev() {
            let node = self.draft.node(place);
            let costs = known(node).unwrap_or_else(
                #[inline(always)]
                || {
                    // The left child comes last.
                    let (left, right) = (memory.known.pop(), memory.known.pop());
                    self.over(simd, node, &left.unwrap_or_default(), &right.unwrap_or_default())
                },
            );
            memory.known.push(costs);
        }
        memory.known.pop().unwrap_or_default()
    }

    /// Over two triangles.
    #[inline(always)]
    fn pair(&self, node: &Record) -> Costs {
        let [left, right] = self.draft.children(node).map(Record::half_area);
        let WideOptions { node_cost, block_cost, max_leaf } = self.options;
        let area = node.half_area();
        let (as_leaf, apart) = (area * block_cost, (left + right) * block_cost);
        let as_node = area * node_cost + apart;
        let is_leaf = max_leaf >= 2 && as_leaf <= as_node;
        let one = if is_leaf { as_leaf } else { as_node };
        let is_apart = apart < one;
        let mut costs = [if is_apart { apart } else { one }; 8];
        costs[0] = one;
        self.decide(node, [u8::from(!is_leaf), u8::from(is_apart), 0, 0, 0, 0, 0, 0]);
        costs
    }

    #[inline(always)]
    fn over<S: Simd>(&self, simd: S, node: &Record, left: &Costs, right: &Costs) -> Costs {
        let (best, lefts) = divided::<S, A>(simd, left, right);
        let WideOptions { node_cost, block_cost, max_leaf } = self.options;
        let (area, count) = (node.half_area(), node.count());
        let as_node = best[A - 1] + area * node_cost;
        let as_leaf = area * block_cost * count.div_ceil(4) as f32;
        // A huge box may cost infinitely much as a node too.
        let is_leaf = count <= max_leaf && as_leaf < f32::INFINITY && as_leaf <= as_node;
        let one = f32x8::splat(simd, if is_leaf { as_leaf } else { as_node });
        // With one root, with two in two forests, and so on; then the least of each and all before it.
        let none = f32x8::splat(simd, f32::INFINITY);
        let apart = one.slide::<7>(best.slide::<1>(none));
        let costs = apart.min(none.slide::<7>(apart));
        let costs = costs.min(none.slide::<6>(costs));
        let costs = costs.min(none.slide::<4>(costs));
        let is_less = apart.simd_lt(none.slide::<7>(costs));
        let mut decision = is_less.select(lefts, u32x8::splat(simd, 0)).to_array();
        // The first entry is for the node alone, which is not divided: it has the forest below the node instead.
        decision[0] = if is_leaf { 0 } else { lefts[A - 1] };
        self.decide(node, decision.map(|k| k as u8));
        costs.to_array()
    }

    #[inline(always)]
    fn decide(&self, node: &Record, decision: Decision) {
        self.decisions[node.first() as usize / 2].store(u64::from_le_bytes(decision), Relaxed);
    }

    #[inline(always)]
    fn decision(&self, node: &Record) -> Decision {
        self.decisions[node.first() as usize / 2].load(Relaxed).to_le_bytes()
    }

    /// Returns whether this becomes a leaf, if it is a root.
    #[inline(always)]
    pub(super) fn is_leaf(&self, place: u32) -> bool {
        let node = self.draft.node(place);
        node.is_leaf() || self.decision(node)[INNER] == 0
    }

    /// Returns the children of an inner node, from left to right, and their number.
    #[inline(always)]
    pub(super) fn children(&self, place: u32) -> ([u32; A], usize) {
        let mut children = [place; A];
        if self.is_leaf(place) {
            // Only for the root.
            return (children, 1);
        }
        let node = self.draft.node(place);
        let (first, left) = (node.first(), self.decision(node)[INNER]);
        // Nodes, and the greatest number of roots below each.
        let mut pending = [(0, 0_u8); A];
        (pending[0], pending[1]) = ((first + 1, A as u8 - left), (first, left));
        let (mut open, mut made) = (2, 0);
        while open > 0 {
            open -= 1;
            let (place, mut roots) = pending[open % A];
            let node = self.draft.node(place);
            if roots > 1 && !node.is_leaf() {
                let decision = self.decision(node);
                while roots > 1 && decision[roots as usize - 1] == 0 {
                    roots -= 1;
                }
                if roots > 1 {
                    let left = decision[roots as usize - 1];
                    pending[open % A] = (node.first() + 1, roots - left);
                    pending[(open + 1) % A] = (node.first(), left);
                    open += 2;
                    continue;
                }
            }
            children[made % A] = place;
            made += 1;
        }
        (children, made)
    }
}

/// Memory that a thread reuses for each subtree.
#[derive(Default)]
struct Memory {
    order: Vec<u32>,
    pending: Vec<u32>,
    known: Vec<Costs>,
}

/// Returns for at most i + 1 roots, with at least one on each side: the least cost, and the number of roots on the
/// left.
#[inline(always)]
fn divided<S: Simd, const A: usize>(simd: S, left: &Costs, right: &Costs) -> (f32x8<S>, u32x8<S>) {
    let none = f32x8::splat(simd, f32::INFINITY);
    let right = f32x8::load_array_ref(simd, right);
    // In registers: a load after stores of several of its lanes waits for them.
    let others = [
        none.slide::<7>(right),
        none.slide::<6>(right),
        none.slide::<5>(right),
        none.slide::<4>(right),
        none.slide::<3>(right),
        none.slide::<2>(right),
        none.slide::<1>(right),
    ];
    let (mut best, mut lefts) = (none, u32x8::splat(simd, 1));
    for k in 1..A {
        let cost = others[k - 1] + left[k - 1];
        let is_less = cost.simd_lt(best);
        best = is_less.select(cost, best);
        lefts = is_less.select(u32x8::splat(simd, k as u32), lefts);
    }
    (best, lefts)
}

#[cfg(test)]
mod tests;

//! The dynamic programme: which descendants a node takes over.

use super::draft::{Draft, DraftNode};
use super::{CUT, WideOptions};
use crate::threads;

/// The cheapest forests below each node of a binary tree, by the number of their roots.
///
/// Ylitie, Karras & Laine 2017, section 4. Of a node and i from 1 to A, the forest of at most i roots that cost least:
/// with one root, a leaf, or an inner node over the forest of at most A below the two children together; with more, one
/// with fewer roots, or forests below the left child and the right one.
pub(super) struct Programme<const A: usize> {
    forests: Vec<Forests<A>>,
}

#[derive(Clone, Copy)]
struct Forests<const A: usize> {
    /// Of the forest of at most i + 1 roots.
    cost: [f32; A],
    /// Levels of inner nodes in it.
    levels: [u16; A],
    /// How many of its roots are below the left child. [`SAME`] where one with fewer roots is as cheap.
    left: [u8; A],
    /// How many of the roots of an inner node's forest are below the left child.
    inner: u8,
    is_leaf: bool,
}

const SAME: u8 = 0;

impl<const A: usize> Programme<A> {
    pub(super) fn of(draft: &Draft, options: &WideOptions) -> Self {
        let mut forests = vec![Forests::NONE; draft.nodes.len()];
        // All descendants of a node are one range: the short ones are for all threads. Then comes what is above them.
        let (mut above, mut short) = (vec![0], Vec::new());
        let mut open = vec![(1, &mut forests[1..])];
        while let Some((from, below)) = open.pop() {
            if below.len() <= CUT {
                short.push((from, below));
                continue;
            }
            above.extend([from, from + 1]);
            let (_, below) = below.split_at_mut(2);
            let middle = draft.nodes[from + 1].children.map_or(below.len(), |[left, _]| left as usize - from - 2);
            let (of_left, of_right) = below.split_at_mut(middle);
            open.extend([(from + 2, of_left), (from + 2 + middle, of_right)]);
        }
        threads::update(&mut short, 1, |(from, below)| {
            for place in (0..below.len()).rev() {
                below[place] = Forests::of(&draft.nodes[*from + place], options, |child| &below[child - *from]);
            }
        });
        drop(short);
        for place in above.into_iter().rev() {
            forests[place] = Forests::of(&draft.nodes[place], options, |child| &forests[child]);
        }
        Self { forests }
    }

    /// Whether this becomes a leaf, where it is a root.
    pub(super) fn is_leaf(&self, place: u32) -> bool {
        self.forests[place as usize].is_leaf
    }

    /// How many levels of inner nodes there are from this one on, it included, where it is a root.
    pub(super) fn levels(&self, place: u32) -> u32 {
        self.forests[place as usize].levels[0].into()
    }

    /// The children of an inner node, from left to right.
    pub(super) fn children(&self, draft: &Draft, place: u32) -> Vec<u32> {
        let mut children = Vec::with_capacity(A);
        let mut pending = Vec::with_capacity(A);
        let divide = |pending: &mut Vec<(u32, usize)>, place: u32, left: u8, roots: usize| {
            if let Some([l, r]) = draft.nodes[place as usize].children {
                pending.extend([(r, roots - usize::from(left)), (l, usize::from(left))]);
            }
        };
        divide(&mut pending, place, self.forests[place as usize].inner, A);
        while let Some((place, mut roots)) = pending.pop() {
            let forests = &self.forests[place as usize];
            while roots > 1 && forests.left[roots - 1] == SAME {
                roots -= 1;
            }
            if roots == 1 {
                children.push(place);
            } else {
                divide(&mut pending, place, forests.left[roots - 1], roots);
            }
        }
        children
    }
}

impl<const A: usize> Forests<A> {
    const NONE: Self = Self { cost: [0.0; A], levels: [0; A], left: [SAME; A], inner: 1, is_leaf: true };

    /// Those of a node, where those of its children are known.
    fn of<'f>(node: &DraftNode, options: &WideOptions, known: impl Fn(usize) -> &'f Self) -> Self {
        let area = node.aabb.half_area();
        let as_leaf = area * options.block_cost * node.count.div_ceil(4) as f32;
        let Some([left, right]) = node.children else { return Self { cost: [as_leaf; A], ..Self::NONE } };
        let as_leaf = if node.count <= options.max_leaf { as_leaf } else { f32::INFINITY };
        Self::over(known(left as usize), known(right as usize), as_leaf, area * options.node_cost)
    }

    fn over(left: &Self, right: &Self, as_leaf: f32, as_node: f32) -> Self {
        let mut made = Self { is_leaf: false, ..Self::NONE };
        // Of at most i + 1 roots below both children, at least one below each.
        let divided = |roots: usize| {
            let mut best = (f32::INFINITY, 1);
            for k in 1..roots {
                let cost = left.cost[k - 1] + right.cost[roots - k - 1];
                if cost < best.0 {
                    best = (cost, k);
                }
            }
            let (cost, k) = best;
            (cost, k as u8, left.levels[k - 1].max(right.levels[roots - k - 1]))
        };
        let (below, inner, levels) = divided(A);
        made.inner = inner;
        // What is too large for a leaf costs infinitely much as one; what is huge may do so as a node too.
        made.is_leaf = as_leaf < f32::INFINITY && as_leaf <= below + as_node;
        made.cost[0] = if made.is_leaf { as_leaf } else { below + as_node };
        made.levels[0] = if made.is_leaf { 0 } else { levels.saturating_add(1) };
        for roots in 2..=A {
            let (cost, k, levels) = divided(roots);
            let fewer = roots - 2;
            (made.cost[roots - 1], made.left[roots - 1], made.levels[roots - 1]) =
                if cost < made.cost[fewer] { (cost, k, levels) } else { (made.cost[fewer], SAME, made.levels[fewer]) };
        }
        made
    }
}

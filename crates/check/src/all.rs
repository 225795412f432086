//! Enumeration of all small trees under all decisions.

use super::Case;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::tree::Tree;

/// Enumerates every tree of up to a number of leaves, under every script of decisions. Each case occurs once and has a
/// number, so a check can be split into ranges. A reached inner node enters none of its children, one of them, or both
/// in either order. Unreached nodes decide nothing.
///
/// The enumeration uses no symmetry. Omitting mirror images would halve the work, but could hide a bug that treats left
/// and right differently. Replacing each unreached subtree by a leaf would save three cases in ten, but the keys of
/// these subtrees are in the hash tables.
///
/// ```
/// use stackless_check::AllCases;
///
/// let all = AllCases::up_to(6);
/// // 1, 5, 34, 273, 2,430 and 23,154 of 1 to 6 leaves.
/// assert_eq!(all.count(), 25_897);
/// assert_eq!(all.case(0).size(), 1);
/// assert_eq!(all.case(25_896).size(), 11);
/// ```
#[derive(Clone, Debug)]
pub struct AllCases {
    /// Number of shapes, by number of leaves.
    shapes: Vec<u64>,
    /// Number of shapes with decisions, by number of leaves.
    scripts: Vec<u64>,
}

/// The decision at an inner node.
#[derive(Clone, Copy)]
struct Decision {
    /// Whether the children are entered.
    enters: [bool; 2],
    right_first: bool,
}

const DECISIONS: [Decision; 5] = [
    Decision { enters: [false, false], right_first: false },
    Decision { enters: [true, false], right_first: false },
    Decision { enters: [false, true], right_first: false },
    Decision { enters: [true, true], right_first: false },
    Decision { enters: [true, true], right_first: true },
];

/// The children and cells of the nodes built so far.
#[derive(Default)]
struct Growing {
    children: Vec<Option<[u32; 2]>>,
    cells: Vec<Cell>,
}

impl AllCases {
    /// The maximum number of leaves. The numbers of all its cases are below 2^64.
    pub const LEAVES: u32 = 18;

    /// In this octant the sign order equals the order of the scripts.
    const OCTANT: u8 = 2;

    /// Enumerates all cases of up to `leaves` leaves, [`LEAVES`](Self::LEAVES) at most.
    pub fn up_to(leaves: u32) -> Self {
        let (mut shapes, mut scripts) = (vec![0, 1], vec![0, 1]);
        for n in 2..=leaves.min(Self::LEAVES) as usize {
            let of_shapes = (1..n).map(|i| shapes[i] * shapes[n - i]).sum();
            let ways = |i| DECISIONS.map(|decision| ways(&shapes, &scripts, [i, n - i], decision));
            let of_scripts = (1..n).flat_map(ways).map(|[left, right]| left * right).sum();
            shapes.push(of_shapes);
            scripts.push(of_scripts);
        }
        Self { shapes, scripts }
    }

    /// Returns the number of cases.
    pub fn count(&self) -> u64 {
        self.scripts.iter().sum()
    }

    /// Returns the case with a number below [`count`](Self::count). For greater numbers it returns the last case.
    pub fn case(&self, number: u64) -> Case {
        let mut rest = number.min(self.count() - 1);
        let mut leaves = 1;
        while rest >= self.scripts[leaves] {
            rest -= self.scripts[leaves];
            leaves += 1;
        }
        let mut growing = Growing { children: vec![None], cells: vec![Cell::default()] };
        self.grow(&mut growing, 0, leaves, true, rest);
        let Growing { children, cells } = growing;
        let tree = Tree::from_generated(&children);
        let tape = Tape::from_cells(&tree, cells).unwrap_or_default();
        Case { tree, tape, any: false, octant: Self::OCTANT }
    }

    /// Grows the subtree with a number below a node, which is reached or not.
    fn grow(&self, growing: &mut Growing, node: usize, leaves: usize, is_reached: bool, mut rest: u64) {
        let decisions = if is_reached { &DECISIONS[..] } else { &DECISIONS[..1] };
        for left in 1..leaves {
            let sizes = [left, leaves - left];
            for &decision in decisions {
                let [of_left, of_right] = ways(&self.shapes, &self.scripts, sizes, decision);
                if rest >= of_left * of_right {
                    rest -= of_left * of_right;
                    continue;
                }
                let first = growing.children.len();
                growing.children[node] = Some([first as u32, first as u32 + 1]);
                growing.cells[node].right_first = decision.right_first;
                growing.cells[node].axis = u8::from(decision.right_first);
                growing.children.extend([None, None]);
                growing
                    .cells
                    .extend(decision.enters.map(|enters| Cell { miss: is_reached && !enters, ..Cell::default() }));
                let numbers = [rest / of_right, rest % of_right];
                for side in 0..2 {
                    self.grow(growing, first + side, sizes[side], decision.enters[side], numbers[side]);
                }
                return;
            }
        }
    }
}

/// Counts the left and the right subtrees with these numbers of leaves, below a node with this decision.
fn ways(shapes: &[u64], scripts: &[u64], sizes: [usize; 2], decision: Decision) -> [u64; 2] {
    [0, 1].map(|side| if decision.enters[side] { scripts[sizes[side]] } else { shapes[sizes[side]] })
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::fmt::Write as _;

    use super::*;
    use stackless_bvh::generate::{Exhaustive, Kind, Source, shape};
    use stackless_bvh::tree::Topology;

    /// Describes a case: its shape from the root, and the decisions of the reached inner nodes.
    fn described(case: &Case) -> String {
        let (mut text, mut pending) = (String::new(), vec![(case.tree.root(), true)]);
        while let Some((node, is_reached)) = pending.pop() {
            if node.is_leaf() {
                text.push('.');
                continue;
            }
            let (cells, children) = (case.tape.cells(), case.tree.children(node));
            let enters = children.map(|child| is_reached && !cells[child.index()].miss);
            let Cell { right_first, axis, .. } = cells[node.index()];
            let order = is_reached.then_some((right_first, axis));
            write!(text, "{enters:?}{order:?}").unwrap();
            pending.extend([1, 0].map(|side| (children[side], enters[side])));
        }
        text
    }

    #[test]
    fn they_are_those_of_the_enumeration() {
        let (all, mut seen, mut enumerated) = (AllCases::up_to(5), HashSet::new(), HashSet::new());
        for number in 0..all.count() {
            assert!(seen.insert(described(&all.case(number))), "{number}");
        }
        let mut source = Exhaustive::new();
        while source.next_case() {
            let leaves = 1 + source.below(5) as u32;
            let tree = Tree::from_generated(&shape(&mut source, leaves));
            let tape = Tape::draw(&mut source, &tree, Kind::Script);
            assert!(enumerated.insert(described(&Case { tree, tape, any: false, octant: AllCases::OCTANT })));
        }
        assert_eq!(seen, enumerated);
    }

    #[test]
    fn they_are_as_many_as_the_formula_says() {
        assert_eq!(AllCases::up_to(9).scripts, [0, 1, 5, 34, 273, 2430, 23_154, 231_300, 2_391_241, 25_369_574]);
        assert_eq!(AllCases::up_to(9).shapes, [0, 1, 1, 2, 5, 14, 42, 132, 429, 1430]);
        // The counts do not overflow, and any number has a case.
        let most = AllCases::up_to(u32::MAX);
        assert_eq!(most.scripts.len() as u32, AllCases::LEAVES + 1);
        assert_eq!(most.case(u64::MAX).size() as u32, 2 * AllCases::LEAVES - 1);
    }
}

//! All small trees under all decisions, by number.

use super::Case;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::tree::Tree;

/// Every tree of up to so many leaves, under every script of decisions: each case once, and each found by its number, so
/// that any part of them can be checked. An inner node that is reached decides for none of its children, for one, or for
/// both in either order. What is not reached decides nothing.
///
/// No symmetry is used. To leave out mirror images would halve the work, but a mistake that treats left and right unlike
/// each other might show in the other half only. To take a leaf for each subtree that is not reached would leave out three
/// cases in ten, but their keys are in the tables of the hashes.
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
    /// Shapes with so many leaves.
    shapes: Vec<u64>,
    /// Shapes with so many leaves, with decisions.
    scripts: Vec<u64>,
}

/// What an inner node decides.
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

/// Children and cells of the nodes that are there already.
#[derive(Default)]
struct Growing {
    children: Vec<Option<[u32; 2]>>,
    cells: Vec<Cell>,
}

impl AllCases {
    /// Most leaves: the numbers of all cases are below 2^64.
    pub const LEAVES: u32 = 18;

    /// The sign order of this octant is that of the scripts.
    const OCTANT: u8 = 2;

    /// All cases of up to so many leaves, and of [`LEAVES`](Self::LEAVES) at most.
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

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.scripts.iter().sum()
    }

    /// The case of a number below [`count`](Self::count); of a greater one the last.
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

    /// Puts the subtree of a number under a node, which is reached or not.
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

/// The numbers of left and of right subtrees with so many leaves, below a node with this decision.
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

    /// What a case is: the shape from the root on, and what the inner nodes that are reached decide.
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
        // No overflow, and any number has a case.
        let most = AllCases::up_to(u32::MAX);
        assert_eq!(most.scripts.len() as u32, AllCases::LEAVES + 1);
        assert_eq!(most.case(u64::MAX).size() as u32, 2 * AllCases::LEAVES - 1);
    }
}

//! One case: a tree, a tape and a query.

use stackless_bvh::generate::{Cell, Family, Kind, Rng, Source, Tape, shape};
use stackless_bvh::hash::mix;
use stackless_bvh::tree::{Topology, Tree};

/// The input of every traversal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// The tree.
    pub tree: Tree,
    /// The decisions of the search.
    pub tape: Tape,
    /// An any-hit query, which stops at the first hit.
    pub any: bool,
    /// Signs of the direction, one bit per axis, for fixed-order traversals.
    pub octant: u8,
}

/// Limits of random cases. `None` means random.
#[derive(Clone, Copy, Debug, Default)]
pub struct CaseOptions {
    /// Family of the trees.
    pub family: Option<Family>,
    /// Depth of the tree. Combs have this depth. Other trees have one leaf more than it, which bounds their depth.
    pub depth: Option<u32>,
}

impl Case {
    /// Most leaves of a random tree, which then has 63 nodes.
    pub const LEAVES: u32 = 32;

    /// Generates the case of a seed, equal on every machine.
    ///
    /// # Panics
    /// None: every generator makes a tree.
    pub fn random(seed: u64, options: CaseOptions) -> Self {
        let mut rng = Rng::new(seed);
        let families = Family::ALL;
        let drawn = families[rng.below(families.len() as u64) as usize];
        let leaves = match options.depth {
            Some(depth) => depth.saturating_add(1),
            None => 1 + rng.below(u64::from(Self::LEAVES)) as u32,
        };
        let tree = options.family.unwrap_or(drawn).tree(&mut rng, leaves);
        Self::with_tree(tree, Kind::ALL[rng.below(Kind::ALL.len() as u64) as usize], &mut rng)
    }

    /// Draws a case of at most `leaves` leaves from the choices of a source, as fuzzers and shrinking tests do.
    pub fn draw(source: &mut impl Source, leaves: u32) -> Self {
        let leaves = 1 + source.below(u64::from(leaves)) as u32;
        let tree = Tree::from_generated(&shape(source, leaves));
        let kind = Kind::ALL[source.below(Kind::ALL.len() as u64) as usize];
        let tape = Tape::draw(source, &tree, kind);
        Self { tree, tape, any: source.coin(), octant: source.below(8) as u8 }
    }

    /// Draws a comb of `depth` edges. The search descends to its end and returns in few, long climbs.
    ///
    /// Few of the leaves next to the path are entered; the fraction varies between cases. Some lie behind everything
    /// below them, so a hit below drops them. Random tapes rarely lead this deep.
    pub fn chain(source: &mut impl Source, depth: u32) -> Self {
        let tree = Family::Comb.tree(source, depth.saturating_add(1));
        let one_in = [2, 4, 16, 64][source.below(4) as usize];
        let mut cells = vec![Cell { miss: true, ..Cell::default() }; tree.node_count()];
        let (mut node, mut cell) = (tree.root(), Cell { exit: Some(1 << 20), ..Cell::default() });
        while !node.is_leaf() {
            let [left, right] = tree.children(node);
            let goes_right = left.is_leaf() && (!right.is_leaf() || source.coin());
            let (next, beside) = if goes_right { (right, left) } else { (left, right) };
            let end = cell.exit.unwrap_or(0);
            let mut below = Cell { exit: Some(end), ..Cell::default() };
            let mut other = Cell { miss: source.below(one_in) != 0, ..below };
            if !other.miss && source.coin() {
                // The last two steps of the interval belong to the leaf, behind the rest.
                (below.exit, other.enter) = (Some(end - 2), end - 1);
            }
            let distance = source.below(u64::from(end - other.enter) + 1) as u32;
            other.hit = source.coin().then_some(other.enter + distance);
            (cell.right_first, cell.axis) = (source.coin(), source.below(3) as u8);
            cells[tree.slot(node)] = cell;
            cells[tree.slot(beside)] = other;
            (node, cell) = (next, below);
        }
        let distance = source.below(u64::from(cell.exit.unwrap_or(0)) + 1) as u32;
        cell.hit = source.coin().then_some(distance);
        cells[tree.slot(node)] = cell;
        let tape = Tape::from_cells(&tree, cells).unwrap_or_default();
        Self { tree, tape, any: false, octant: source.below(8) as u8 }
    }

    /// Builds a case for a given tree, with a drawn tape.
    pub fn with_tree(tree: Tree, kind: Kind, rng: &mut Rng) -> Self {
        let tape = Tape::hashed(mix(rng.bits()), &tree, kind);
        Self { tree, tape, any: rng.below(4) == 1, octant: rng.below(8) as u8 }
    }

    /// Returns whether the answers at a node do not depend on the time of the visit: no hit that can shorten the search
    /// comes before the entry of any node.
    pub fn is_static(&self) -> bool {
        let nearest_hit = self.tape.cells().iter().filter_map(|cell| cell.hit).min();
        let farthest = self.tape.cells().iter().map(|cell| cell.enter).max();
        self.any || nearest_hit.is_none() || farthest <= nearest_hit
    }

    /// Returns the number of nodes.
    pub fn size(&self) -> usize {
        self.tree.node_count()
    }
}

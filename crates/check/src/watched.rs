//! Counts of backtracking steps (Binder & Keller 2016, Fig. 1).

use std::cell::Cell;

use stackless_bvh::event::{Recorder, State};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::Flow;
use stackless_bvh::tree::{Node, Reach, Recorded, Topology};

/// A tree that reports each node whose links are read.
#[derive(Clone, Copy, Debug)]
pub struct Watched<'t, T, F> {
    /// The tree, which has links.
    pub tree: &'t T,
    /// Receives each node whose links are read.
    pub watch: F,
}

impl<T: Topology, F: Fn(Node)> Topology for Watched<'_, T, F> {
    const REACH: Reach = T::REACH;

    stackless_bvh::topology_of!(tree);

    fn names(&self, what: Recorded) -> bool {
        self.tree.names(what)
    }

    fn parent(&self, node: Node) -> Node {
        (self.watch)(node);
        self.tree.parent(node)
    }

    fn sibling(&self, node: Node) -> Node {
        (self.watch)(node);
        self.tree.sibling(node)
    }

    fn uncles(&self, node: Node) -> [Node; 3] {
        (self.watch)(node);
        self.tree.uncles(node)
    }
}

/// Number of records read since the last visit, counted by a [`Watched`] tree.
#[derive(Debug, Default)]
pub struct Reads {
    count: Cell<u64>,
    last: Cell<Option<Node>>,
}

impl Reads {
    /// Counts a record, unless it was also the last one read.
    pub fn count(&self, node: Node) {
        if self.last.replace(Some(node)) != Some(node) {
            self.count.set(self.count.get() + 1);
        }
    }

    fn take(&self) -> u64 {
        self.last.take();
        self.count.take()
    }
}

/// Counts backtracks and their steps, from the record of one node to that of the next. A step is counted if the address
/// comes from a register, a stack, a table or the node's own record. Each further record on a climb, or on the path
/// down after a restart, counts one more.
///
/// ```
/// use stackless_bvh::order::{Descent, Flow, Side, Visitor};
/// use stackless_bvh::traverse::{Afra, traverse};
/// use stackless_bvh::tree::{Linked, Node, Tree};
/// use stackless_check::{Reads, Steps, Watched};
///
/// struct LeftFirst;
/// impl Visitor for LeftFirst {
///     fn inner(&mut self, _: Node) -> Descent {
///         Descent::both(Side::Left)
///     }
///     fn leaf(&mut self, _: Node) -> Flow {
///         Flow::Continue
///     }
/// }
///
/// let tree = Tree::new(&[Some([1, 2]), Some([3, 4]), None, None, None])?;
/// let (linked, reads) = (Linked::parents(&tree), Reads::default());
/// let watched = Watched { tree: &linked, watch: |node| reads.count(node) };
/// let mut steps = Steps::new(&tree, &reads);
/// traverse(Afra::<u32, _>::new(&watched)?, &mut LeftFirst, &mut steps);
/// // From key 4 to its sibling, and from key 5 to key 3: to the parent, and to its sibling.
/// assert_eq!(steps.backtracks(), 2);
/// assert!(steps.steps() >= 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Steps<'a, T> {
    tree: &'a T,
    reads: &'a Reads,
    last: Option<Node>,
    backtracks: u64,
    taken: u64,
}

impl<'a, T: Topology> Steps<'a, T> {
    /// Counts for one traversal of a tree. The tree's links, if any, report to `reads`.
    pub fn new(tree: &'a T, reads: &'a Reads) -> Self {
        Self { tree, reads, last: None, backtracks: 0, taken: 0 }
    }

    /// Returns the number of visited postponed nodes.
    pub fn backtracks(&self) -> u64 {
        self.backtracks
    }

    /// Returns the number of steps for all backtracks.
    pub fn steps(&self) -> u64 {
        self.taken
    }
}

impl<T: Topology> Recorder for Steps<'_, T> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let reads = self.reads.take();
        if state().is_restarting {
            self.taken += 1;
            return Flow::Continue;
        }
        if let Some(last) = self.last.replace(node)
            && (last.is_leaf() || !self.tree.children(last).contains(&node))
        {
            self.backtracks += 1;
            self.taken += reads.max(1);
        }
        Flow::Continue
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stackless_bvh::generate::{Family, Kind, Rng, Search, Tape};
    use stackless_bvh::hash::KeyMap;
    use stackless_bvh::internals::event::Backtracks;
    use stackless_bvh::traverse::{Afra, HashOnly, Sparse, Stack, Uncle, traverse};
    use stackless_bvh::tree::Linked;

    /// For a distance of `d` levels, parents need `d + 1` steps. Uncles need one step per two levels, unless the
    /// register has the address. Other traversals need one step.
    #[test]
    fn steps_are_those_of_the_distances() {
        let mut rng = Rng::new(7);
        let mut climbs = 0;
        for kind in Kind::ALL {
            for family in Family::ALL {
                let tree = family.tree(&mut rng, 50);
                let tape = Tape::draw(&mut rng, &tree, kind);
                let (linked, reads) = (Linked::both(&tree), Reads::default());
                let watched = Watched { tree: &linked, watch: |node| reads.count(node) };
                let search = || Search::new(&tree, &tape, false);
                let steps = || Steps::new(&tree, &reads);
                let mut distances = Backtracks::new(Reach::ALGORITHM_1);
                let keys = KeyMap::of(&tree);
                traverse(HashOnly::<u64, _, _>::new(&tree, &keys).unwrap(), &mut search(), &mut distances);
                let (mut least, mut along_uncles, mut along_parents) = (0, 0, 0);
                for (d, count) in (0_u64..).zip(distances.distances()) {
                    least += count;
                    along_uncles += count * d.div_ceil(2).max(1);
                    along_parents += count * (d + 1);
                }

                let mut by_stack = steps();
                traverse(Stack::new(&tree, &mut Vec::new()), &mut search(), &mut by_stack);
                assert_eq!((by_stack.backtracks(), by_stack.steps()), (least, least));

                let mut by_afra = steps();
                traverse(Afra::<u64, _>::new(&watched).unwrap(), &mut search(), &mut by_afra);
                assert_eq!((by_afra.backtracks(), by_afra.steps()), (least, along_parents));

                let mut by_sparse = steps();
                traverse(Sparse::<u64, _>::new(&watched).unwrap(), &mut search(), &mut by_sparse);
                assert_eq!((by_sparse.backtracks(), by_sparse.steps()), (least, along_parents));

                let mut by_uncles = steps();
                traverse(Uncle::<u64, _>::new(&watched).unwrap(), &mut search(), &mut by_uncles);
                assert_eq!(by_uncles.backtracks(), least);
                assert!((least..=along_uncles).contains(&by_uncles.steps()));
                climbs += by_uncles.steps() - least;
            }
        }
        assert!(climbs > 10, "{climbs}");
    }
}

//! Laine 2010: a trail of level bits, restarts from the root, and a short stack of the latest postponed nodes.

use super::Cursor;
use crate::event::State;
use crate::key::{KeyWord, TooDeep};
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// The restart trail with a short stack of `K` nodes (0, 1, 2, 4, 8 in Barringer & Akenine-Möller's measurements).
/// `[LAINE-1]`
///
/// Each level has one bit of the trail, the root's level the highest. A bit is 0 while the first child's subtree is
/// being visited and the second is postponed. It is 1 during the second child's visit, or if only one child was wanted.
/// A backtrack adds 1 at the current level: the carry runs to the deepest level with a postponed node, the pop level.
/// If the short stack has lost that node, the traversal starts again at the root and follows the trail, with repeated
/// queries of the visitor.
///
/// The ray may have become shorter in between: at the pop level a node that wanted two children may want one, the
/// first, which is done. Then there is no child to enter, and the trail is advanced again.
#[derive(Debug)]
pub struct Laine<'t, const K: usize, W, T> {
    tree: &'t T,
    node: Node,
    trail: W,
    /// The highest bit, the level of the root: set by the last carry.
    top: W,
    /// The bit of the node's level.
    level: W,
    /// The bit of the level at which the last backtrack changed sides; 0 before the first.
    pop_level: W,
    short: ShortStack<K>,
}

impl<'t, const K: usize, W: KeyWord, T: Topology> Laine<'t, K, W, T> {
    /// Starts at the root. Words that grow have no top bit, and are refused.
    ///
    /// # Errors
    /// [`TooDeep`] for trees deeper than the bits of the word, less one.
    #[inline]
    pub fn new(tree: &'t T) -> Result<Self, TooDeep> {
        let Some(level) = W::highest() else {
            return Err(TooDeep { depth: tree.depth(), limit: 0, word: W::NAME });
        };
        W::carries(tree.depth(), 1)?;
        let short = ShortStack { nodes: [tree.root(); K], head: 0, len: 0 };
        let (trail, pop_level) = (W::zero(), W::zero());
        Ok(Self { tree, node: tree.root(), trail, top: level.clone(), level, pop_level, short })
    }

    /// Returns whether the trail has a 1 at this level.
    #[inline]
    fn is_set(&self, level: &W) -> bool {
        !self.trail.clone().and(level).is_zero()
    }
}

impl<const K: usize, W: KeyWord, T: Topology> Cursor for Laine<'_, K, W, T> {
    type Word = W;
    const RESTARTS: bool = true;

    #[inline]
    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<W> {
        // Level bits are single: the trailing zeros compare them.
        let is_above = self.level.trailing_zeros() > self.pop_level.trailing_zeros();
        State { is_restarting: is_above && !self.pop_level.is_zero(), ..State::of(self.node) }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
        let level = self.level.clone().shr1();
        let side = if descent.postpones() {
            if self.is_set(&level) {
                first.other()
            } else {
                self.short.push(self.tree.child(self.node, first.other()));
                first
            }
        } else if level == self.pop_level {
            return false;
        } else {
            self.trail = core::mem::take(&mut self.trail).or(&level);
            first
        };
        self.node = self.tree.child(self.node, side);
        self.level = level;
        true
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        // Clears the bits below the level, which belong to the completed path, and adds 1 at the level.
        let above = W::zero().wrapping_sub(&self.level);
        self.trail = core::mem::take(&mut self.trail).and(&above).wrapping_add(&self.level);
        self.pop_level = self.trail.clone().and(&W::zero().wrapping_sub(&self.trail));
        if self.is_set(&self.top) {
            return false;
        }
        if let Some(node) = self.short.pop() {
            self.node = node;
            self.level = self.pop_level.clone();
        } else {
            self.node = self.tree.root();
            self.level = self.top.clone();
        }
        true
    }
}

/// The latest `K` pushed nodes; older ones are lost.
#[derive(Debug)]
struct ShortStack<const K: usize> {
    nodes: [Node; K],
    /// The place of the next pushed node.
    head: usize,
    len: usize,
}

impl<const K: usize> ShortStack<K> {
    #[inline(always)]
    fn push(&mut self, node: Node) {
        if K > 0 {
            self.nodes[self.head] = node;
            self.head = (self.head + 1) % K;
            self.len = (self.len + 1).min(K);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Node> {
        self.len = self.len.checked_sub(1)?;
        self.head = (self.head + K - 1) % K;
        Some(self.nodes[self.head])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Cell, Search, Tape};
    use crate::traverse::traverse;
    use crate::tree::Tree;

    #[test]
    fn a_child_that_is_culled_at_the_pop_level_is_not_replaced_by_its_sibling() {
        // The hit in the first leaf, at 1, culls the second, which is entered at 5: the restart finds one wanted child
        // instead of two, and that one is done.
        let tree = Tree::new(&[Some([1, 2]), None, None]).unwrap();
        let first = Cell { hit: Some(1), ..Cell::default() };
        let second = Cell { enter: 5, hit: Some(6), ..Cell::default() };
        let tape = Tape::from_cells(&tree, alloc::vec![Cell::default(), first, second]).unwrap();
        let mut search = Search::new(&tree, &tape, false);
        traverse(Laine::<0, u32, _>::new(&tree).unwrap(), &mut search, &mut ());
        assert_eq!((search.outcome.hit, search.outcome.leaf_visits), (Some((1, 1)), 1));
        // A short stack returns the node without a repeated query.
        let mut search = Search::new(&tree, &tape, false);
        traverse(Laine::<1, u32, _>::new(&tree).unwrap(), &mut search, &mut ());
        assert_eq!((search.outcome.hit, search.outcome.leaf_visits), (Some((1, 1)), 2));
    }
}

//! Observable events of a traversal: the visited nodes, in order.
//!
//! The oracle and every traversal pass their [`State`] to a [`Recorder`] at each visit. A [`Trace`] keeps the visited
//! nodes; its [`events`](Trace::events) are the sequence of (key, enter | leaf | backtrack n | end) by which
//! implementations are compared. With `()` as the recorder, nothing is recorded and recording has no cost.

pub(crate) mod backtracks;

pub(crate) use backtracks::Backtracks;

use alloc::vec::Vec;

use crate::key::KeyWord;
use crate::order::Flow;
use crate::tree::{Keys, Node, Topology};

/// The state of a traversal at a visit, in words of one type. Absent parts are `None`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State<W> {
    /// The node about to be visited.
    pub node: Node,
    /// The node's key, if the traversal has or implies one.
    pub key: Option<W>,
    /// The bit trail, if the traversal has one.
    pub trail: Option<W>,
    /// Barringer & Akenine-Möller's `levelStart + levelIndex`, if the traversal has them: a leading one, and the
    /// complement of the trail.
    pub counter: Option<W>,
    /// The second trail, if the traversal has one: 1 where a node's siblings were marked as disjoint.
    pub disjoint: Option<W>,
    /// The most recently postponed node, if a register holds it.
    pub register: Option<Node>,
    /// Whether the node was visited before, and a restart passes it again on the way down from the root.
    pub is_restarting: bool,
}

impl<W> State<W> {
    /// Creates the state of a traversal with only a node.
    pub const fn of(node: Node) -> Self {
        Self { node, key: None, trail: None, counter: None, disjoint: None, register: None, is_restarting: false }
    }

    /// Converts the words; parts for which `f` returns `None` are omitted.
    pub fn map<X>(self, f: impl Fn(W) -> Option<X>) -> State<X> {
        let Self { node, key, trail, counter, disjoint, register, is_restarting } = self;
        let [key, trail, counter, disjoint] = [key, trail, counter, disjoint].map(|word| word.and_then(&f));
        State { node, key, trail, counter, disjoint, register, is_restarting }
    }
}

/// An observer of a traversal.
pub trait Recorder {
    /// Called before each visit; [`Flow::Stop`] ends the traversal there. The state is computed only if the recorder
    /// calls `state`.
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow;

    /// Called instead of `visit` when a restart passes a node again on the way down from the root.
    #[inline]
    fn revisit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        self.visit(node, state)
    }
}

impl Recorder for () {
    #[inline]
    fn visit<W: KeyWord>(&mut self, _: Node, _: impl FnOnce() -> State<W>) -> Flow {
        Flow::Continue
    }
}

/// The nodes that a traversal visited, without the repeated visits of restarts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    nodes: Vec<Node>,
}

impl Trace {
    /// Returns the visited nodes, in order.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Clears the trace and keeps its memory.
    pub fn clear(&mut self) {
        self.nodes.clear();
    }

    /// The trace as events, with keys in a word that must carry the tree's depth.
    ///
    /// ```
    /// use stackless_bvh::event::{Event, Trace};
    /// use stackless_bvh::oracle;
    /// use stackless_bvh::order::{Descent, Flow, Side, Visitor};
    /// use stackless_bvh::tree::{Keys, Node, Tree};
    ///
    /// struct RightFirst;
    /// impl Visitor for RightFirst {
    ///     fn inner(&mut self, _: Node) -> Descent {
    ///         Descent::both(Side::Right)
    ///     }
    ///     fn leaf(&mut self, _: Node) -> Flow {
    ///         Flow::Continue
    ///     }
    /// }
    ///
    /// let tree = Tree::new(&[Some([1, 2]), None, None])?;
    /// let mut trace = Trace::default();
    /// oracle::traverse(&tree, &mut RightFirst, &mut trace);
    /// let events: Vec<_> = trace.events::<u32>(&tree, &Keys::of(&tree)).collect();
    /// assert_eq!(events, [Event::Enter(1), Event::Leaf(3), Event::Backtrack(2, 0), Event::Leaf(2), Event::End]);
    /// # Ok::<(), stackless_bvh::tree::TreeError>(())
    /// ```
    pub fn events<'a, W: KeyWord>(
        &'a self,
        tree: &'a impl Topology,
        keys: &'a Keys,
    ) -> impl Iterator<Item = Event<W>> + 'a {
        let depth = |node: Node| keys.depth(tree.slot(node));
        let visits = self.nodes.iter().enumerate().flat_map(move |(i, &node)| {
            let before = i.checked_sub(1).map(|i| self.nodes[i]);
            let descended = before.is_none_or(|before| !before.is_leaf() && tree.children(before).contains(&node));
            let key: W = keys.key(tree.slot(node));
            let back = (!descended)
                .then(|| Event::Backtrack(key.clone(), before.map_or(0, |before| depth(before) - depth(node))));
            let visit = if node.is_leaf() { Event::Leaf(key) } else { Event::Enter(key) };
            back.into_iter().chain([visit])
        });
        visits.chain([Event::End])
    }
}

impl Recorder for Trace {
    #[inline]
    fn visit<W: KeyWord>(&mut self, node: Node, _: impl FnOnce() -> State<W>) -> Flow {
        self.nodes.push(node);
        Flow::Continue
    }

    #[inline]
    fn revisit<W: KeyWord>(&mut self, _: Node, _: impl FnOnce() -> State<W>) -> Flow {
        Flow::Continue
    }
}

/// One observable step. `[TRACE-1]`
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event<W> {
    /// An inner node is visited.
    Enter(W),
    /// A leaf is visited.
    Leaf(W),
    /// The next node is a postponed one: its key, and the number of levels up to the ancestor whose sibling it is.
    Backtrack(W, u32),
    /// No node is left, or the search stopped.
    End,
}

#[cfg(test)]
mod tests;

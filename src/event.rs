//! What can be observed of a traversal: which nodes it visits, in which order.
//!
//! The oracle and every traversal show their [`State`] to a [`Recorder`] at each visit. A [`Trace`] keeps the visited
//! nodes; its [`events`](Trace::events) are the sequence of (key, enter | leaf | backtrack n | end) on which
//! implementations are compared. With `()` as the recorder nothing is recorded and nothing is paid.

mod backtracks;

pub use backtracks::{Backtracks, Source};

use alloc::vec::Vec;

use crate::key::KeyWord;
use crate::order::Flow;
use crate::tree::{Keys, Node, Topology};

/// The state of a traversal at a visit, as far as it has one.
pub trait State {
    /// The word of its key and trail.
    type Word: KeyWord;

    /// The node about to be visited.
    fn node(&self) -> Node;

    /// The node's key, where the traversal carries or implies one.
    fn key(&self) -> Option<Self::Word> {
        None
    }

    /// The bit trail, where the traversal carries one.
    fn trail(&self) -> Option<Self::Word> {
        None
    }

    /// Barringer & Akenine-Möller's `levelStart + levelIndex`, where the traversal carries them: a leading one, and the
    /// complement of the trail.
    fn counter(&self) -> Option<Self::Word> {
        None
    }

    /// The second trail, where the traversal carries one: 1 where a node's siblings were marked as disjoint.
    fn disjoint(&self) -> Option<Self::Word> {
        None
    }

    /// The most recently postponed node, where a register holds it.
    fn register(&self) -> Option<Node> {
        None
    }

    /// Whether the node has been visited before and is only passed again on the way down from the root.
    fn is_restarting(&self) -> bool {
        false
    }
}

impl<S: State> State for &mut S {
    type Word = S::Word;

    #[inline]
    fn node(&self) -> Node {
        (**self).node()
    }

    fn key(&self) -> Option<S::Word> {
        (**self).key()
    }

    fn trail(&self) -> Option<S::Word> {
        (**self).trail()
    }

    fn counter(&self) -> Option<S::Word> {
        (**self).counter()
    }

    fn disjoint(&self) -> Option<S::Word> {
        (**self).disjoint()
    }

    fn register(&self) -> Option<Node> {
        (**self).register()
    }

    fn is_restarting(&self) -> bool {
        (**self).is_restarting()
    }
}

/// Watches a traversal.
pub trait Recorder {
    /// Called before each visit; [`Flow::Stop`] ends the traversal there.
    fn visit(&mut self, state: &impl State) -> Flow;
}

impl Recorder for () {
    #[inline]
    fn visit(&mut self, _: &impl State) -> Flow {
        Flow::Continue
    }
}

/// The nodes that a traversal visited, restarts left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    nodes: Vec<Node>,
}

impl Trace {
    /// The visited nodes, in order.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Forgets everything, keeping the memory.
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
    fn visit(&mut self, state: &impl State) -> Flow {
        if !state.is_restarting() {
            self.nodes.push(state.node());
        }
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
    /// The next node is a postponed one: its key, and how many levels up the ancestor is whose sibling it is.
    Backtrack(W, u32),
    /// Nothing is left, or the search was stopped.
    End,
}

#[cfg(test)]
mod tests;

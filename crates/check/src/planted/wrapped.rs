//! The traversals of the library, told something else than what the visitor has said, or led astray.

use stackless_bvh::event::State;
use stackless_bvh::order::{Descent, Side};
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Node, Topology, Tree};

/// What is done to a traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mutation {
    /// Nothing: the control.
    None,
    /// Far before near.
    FarFirst,
    /// The postponed child is not told of.
    FarLost,
    /// Both children are said to be wanted where one is.
    MissedWanted,
    /// On its way down again, a node that wants one child is taken for done. But the interval may have been so short
    /// from the start that it never wanted two.
    Hasty,
    /// It passes the last inner node of the array after each backtracking, and calls it a restart.
    Wandering,
    /// It goes on at the root's left child, once, as Algorithm 4 of Barringer & Akenine-Möller 2013 does, whose end is
    /// where the climb arrives at the root, if the root is not its own sibling.
    PastRoot,
}

pub(super) struct Wrapped<'t, C> {
    tree: &'t Tree,
    cursor: C,
    mutation: Mutation,
    /// Where it is, if not where the traversal is.
    astray: Option<Node>,
}

impl<'t, C> Wrapped<'t, C> {
    pub(super) fn new(tree: &'t Tree, cursor: C, mutation: Mutation) -> Self {
        Self { tree, cursor, mutation, astray: None }
    }
}

impl<C: Cursor> Cursor for Wrapped<'_, C> {
    type Word = C::Word;
    const RESTARTS: bool = true;

    fn node(&self) -> Node {
        self.astray.unwrap_or_else(|| self.cursor.node())
    }

    fn state(&self) -> State<C::Word> {
        match self.astray {
            None => self.cursor.state(),
            Some(node) => State { is_restarting: self.mutation == Mutation::Wandering, ..State::of(node) },
        }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        if self.astray.is_some() {
            return self.come_back();
        }
        let first = descent.first();
        let told = match self.mutation {
            Mutation::FarFirst if descent.postpones() => Descent::both(first.other()),
            Mutation::FarLost => Descent::only(first),
            Mutation::MissedWanted => Descent::both(first),
            Mutation::Hasty if self.cursor.state().is_restarting && !descent.postpones() => return false,
            _ => descent,
        };
        self.cursor.descend(told)
    }

    fn backtrack(&mut self) -> bool {
        if self.astray.is_some() {
            return self.come_back();
        }
        let (goes_on, root) = (self.cursor.backtrack(), self.tree.root());
        self.astray = match self.mutation {
            Mutation::Wandering if goes_on => {
                let nodes = (0..self.tree.node_count() as u32).rev().filter_map(|index| self.tree.node(index));
                nodes.into_iter().find(|node| !node.is_leaf())
            }
            Mutation::PastRoot if !goes_on && !root.is_leaf() => Some(self.tree.child(root, Side::Left)),
            _ => None,
        };
        goes_on || self.astray.is_some()
    }
}

impl<C> Wrapped<'_, C> {
    /// To where the traversal is, if that has an end to come to.
    fn come_back(&mut self) -> bool {
        if self.mutation == Mutation::Wandering {
            self.astray = None;
        }
        self.astray.is_none()
    }
}

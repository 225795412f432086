//! The interface of queries to traversals.

use crate::bvh::BvhTree;
use crate::geom::Aabb;
use crate::order::{Descent, Flow, NodeTest, Pruned, Pruning, Repeatable, Visitor};
use crate::traverse::{Method, Tables, Unsupported, WordName};
use crate::tree::Node;

/// A query that every traversal can run. `&mut dyn Query` is one type for all kinds of queries, so traversals are not
/// compiled again for each kind.
pub trait Query: Pruned + NodeTest {}

impl<Q: Pruned + NodeTest> Query for Q {}

impl Tables<'_, BvhTree> {
    /// Calls [`run_in`](Self::run_in) for any query, in the one copy of the traversals that is compiled with this
    /// crate.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    pub fn run_query(
        &self,
        word: WordName,
        method: Method,
        octant: u8,
        memory: &mut Vec<Node>,
        mut query: &mut dyn Query,
    ) -> Result<(), Unsupported> {
        self.run_in(word, method, octant, memory, &mut query, &mut ())
    }
}

/// A query that decides on both children at their parent, and can test a node's own box as well.
pub trait BoxQuery: Pruned {
    /// Returns whether a box may contain a result of the query.
    fn touches(&self, aabb: &Aabb) -> bool;

    /// Returns the [slot](crate::tree::Topology::slot) of a node.
    fn slot(&self, node: Node) -> usize;

    /// Returns whether it takes children in the order of distance and marks disjoint children.
    fn is_sorted(&self) -> bool {
        false
    }

    /// Returns whether results may lie outside a leaf's box: for parts of triangles, which are tested as a whole.
    fn is_in_parts(&self) -> bool {
        false
    }

    /// Returns whether the result lies before the end of a box.
    fn ends_in(&self, _: &Aabb) -> bool {
        false
    }
}

/// Implements a query of binary hierarchies that tests boxes by one of its fields and leaves by `meet`.
macro_rules! binary_query {
    ([$($generic:tt)*] $query:ty, $field:ident.$inner:ident $(, until $is_done:ident)?) => {
        impl<$($generic)*> $crate::order::Visitor for $query {
            #[inline]
            fn inner(&mut self, node: $crate::tree::Node) -> $crate::order::Descent {
                self.$field.$inner(node)
            }

            #[inline]
            fn leaf(&mut self, node: $crate::tree::Node) -> $crate::order::Flow {
                self.meet(node);
                $(if self.$is_done() {
                    return $crate::order::Flow::Stop;
                })?
                $crate::order::Flow::Continue
            }
        }

        impl<$($generic)*> $crate::order::Pruned for $query {}

        impl<$($generic)*> $crate::trace::BoxQuery for $query {
            fn touches(&self, aabb: &$crate::geom::Aabb) -> bool {
                self.$field.touches(aabb)
            }

            fn slot(&self, node: $crate::tree::Node) -> usize {
                self.$field.slot(node)
            }
        }
    };
}
pub(super) use binary_query;

/// A query with both node tests in one type, for traversals that are selected at run time: traversals that test a node
/// at its own visit find its box in a table.
#[derive(Clone, Debug)]
pub struct OwnBoxes<'a, Q> {
    pub(super) query: Q,
    boxes: &'a [Aabb],
}

impl<'a, Q: BoxQuery> OwnBoxes<'a, Q> {
    /// Wraps a query. `boxes` must be the tree's [`own_boxes`](crate::bvh::Bvh::own_boxes), or empty if the traversal
    /// tests no node's own box.
    #[inline]
    pub fn over(query: Q, boxes: &'a [Aabb]) -> Self {
        Self { query, boxes }
    }

    /// Returns the query, which contains the answer after the traversal.
    #[inline]
    pub fn query(&self) -> &Q {
        &self.query
    }
}

impl<Q: BoxQuery> Visitor for OwnBoxes<'_, Q> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        self.query.inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.query.leaf(node)
    }
}

impl<Q: BoxQuery> Pruned for OwnBoxes<'_, Q> {
    #[inline]
    fn allows(&self, pruning: Pruning) -> bool {
        match pruning {
            Pruning::Disjoint => self.query.is_sorted() && (!self.query.is_in_parts() || !self.boxes.is_empty()),
            other => self.query.allows(other),
        }
    }

    #[inline]
    fn inner_marked(&mut self, node: Node) -> Descent {
        self.query.inner_marked(node)
    }

    /// A result beyond the box of its leaf may come after results in other boxes. `[DISJOINT-4]`
    #[inline]
    fn found_at(&self, leaf: Node) -> bool {
        let is_inside = || self.boxes.get(self.query.slot(leaf)).is_some_and(|aabb| self.query.ends_in(aabb));
        self.query.found_at(leaf) && (!self.query.is_in_parts() || is_inside())
    }

    #[inline]
    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        self.query.postponed(node, descent)
    }

    #[inline]
    fn end(&self) -> u32 {
        self.query.end()
    }
}

impl<Q: BoxQuery> BoxQuery for OwnBoxes<'_, Q> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.query.touches(aabb)
    }

    fn slot(&self, node: Node) -> usize {
        self.query.slot(node)
    }
}

impl<Q: BoxQuery + Repeatable> Repeatable for OwnBoxes<'_, Q> {}

impl<Q: BoxQuery> NodeTest for OwnBoxes<'_, Q> {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        self.query.touches(&self.boxes[self.query.slot(node)])
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        if self.accept(node) { self.query.leaf(node) } else { Flow::Continue }
    }
}

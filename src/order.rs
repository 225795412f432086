//! What a visit decides: which children are wanted, and which of them comes first.
//!
//! A traversal knows nothing about geometry. At each inner node it asks a [`Visitor`] for a [`Descent`], once, and
//! acts on the answer; at each leaf it asks whether to go on. Ray tracing, nearest points, interval searches and
//! the decision tapes of the tests are all visitors. The answer is never asked for again on the way back
//! (Binder & Keller 2016, Section 2), except by the traversals that say so in their type
//! ([`Cursor::RESTARTS`](crate::traverse::Cursor::RESTARTS)).

pub use crate::key::Side;
use crate::tree::Node;

/// The decision at an inner node: no child is wanted, one is, or both are and one of them comes first. Where
/// traversals ask for it, both may be marked as disjoint. `[ORDER-1]`
///
/// Four bits, made and read without a branch: which children are hit is hard to predict, and a traversal that branches
/// on it more than once loses up to a third of its speed (`benches/README.md`).
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Descent(u8);

impl Descent {
    const RIGHT: u8 = 1;
    const BOTH: u8 = 2;
    const ANY: u8 = 4;
    const DISJOINT: u8 = 8;

    /// No child is wanted: backtrack.
    pub const NEITHER: Self = Self(0);

    /// One child is wanted.
    #[inline]
    pub const fn only(side: Side) -> Self {
        Self(Self::ANY | side as u8)
    }

    /// Both children are wanted; `first` is entered now, the other is postponed.
    #[inline]
    pub const fn both(first: Side) -> Self {
        Self(Self::ANY | Self::BOTH | first as u8)
    }

    /// The decision from two hits and a preference that counts only when both are hit.
    ///
    /// (As printed, Algorithm 1 of Binder & Keller enters a missed right child if `closest` was computed from missed
    /// boxes; see spec/DEPARTURES.md, D-1.)
    #[inline]
    pub const fn new(left: bool, right: bool, prefer_right: bool) -> Self {
        let (left, right, prefer_right) = (left as u8, right as u8, prefer_right as u8);
        let first = right & ((left ^ 1) | prefer_right);
        Self(((left | right) * Self::ANY) | ((left & right) * Self::BOTH) | (first * Self::RIGHT))
    }

    /// The same, with a mark where all that is below the first child comes before all that is below the second: their
    /// intervals along the ray are disjoint (Binder & Keller 2016, Section 2.3). `[ORDER-2]`
    ///
    /// What [`Pruned::inner_marked`] answers to traversals that prune.
    #[inline]
    #[must_use]
    pub const fn disjoint_if(self, disjoint: bool) -> Self {
        Self(self.0 | (disjoint as u8 * Self::DISJOINT))
    }

    /// Whether the second child is only wanted while nothing is found below the first.
    #[inline]
    pub const fn is_disjoint(self) -> bool {
        self.0 & Self::DISJOINT != 0
    }

    /// Whether no child is wanted.
    #[inline]
    pub const fn is_neither(self) -> bool {
        self.0 & Self::ANY == 0
    }

    /// The child to enter now. (Left, where none is wanted.)
    #[inline]
    pub const fn first(self) -> Side {
        Side::right_if(self.0 & Self::RIGHT != 0)
    }

    /// Whether the other child is wanted too, and postponed.
    #[inline]
    pub const fn postpones(self) -> bool {
        self.0 & Self::BOTH != 0
    }
}

impl core::fmt::Debug for Descent {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match (self.is_neither(), self.postpones()) {
            (true, _) => f.write_str("neither"),
            (false, false) => write!(f, "only {:?}", self.first()),
            (false, true) => {
                write!(f, "both, {:?} first", self.first())?;
                f.write_str(if self.is_disjoint() { ", disjoint" } else { "" })
            }
        }
    }
}

/// Whether a search goes on after a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Flow {
    /// Go on.
    Continue,
    /// End the traversal now (an any-hit query that has its hit).
    Stop,
}

/// Which postponed nodes are not visited after all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pruning {
    /// None is left out.
    Never,
    /// Those that are disjoint from their siblings, after something has been found below the sibling. `[ORACLE-2]`
    Disjoint,
    /// Those that begin beyond the end of the search by now. `[ORACLE-3]`
    Distance,
}

/// What the caller does at a node.
pub trait Visitor {
    /// Decides at an inner node.
    fn inner(&mut self, node: Node) -> Descent;

    /// Looks into a leaf.
    fn leaf(&mut self, node: Node) -> Flow;
}

/// A search of which nodes may be left out, and what traversals that prune ask of it besides. Only they ask, so whoever
/// does not prune needs none of this, and pays nothing.
///
/// Without answers of its own a search says that nothing can be left out.
pub trait Pruned: Visitor {
    /// Whether nothing is lost by leaving out nodes in this way, by what the methods below say. Traversals that prune
    /// refuse other searches.
    #[inline]
    fn allows(&self, pruning: Pruning) -> bool {
        pruning == Pruning::Never
    }

    /// [`inner`](Visitor::inner), with a [mark](Descent::disjoint_if) where all that is sought below the first child
    /// comes before all that is sought below the second. `[ORDER-2]`
    #[inline]
    fn inner_marked(&mut self, node: Node) -> Descent {
        self.inner(node)
    }

    /// Whether the best of what has been found is in this leaf, and before all that is sought below the second child
    /// of any disjoint descent that has the leaf below its first. `[ORDER-3]`
    #[inline]
    fn found_at(&self, _leaf: Node) -> bool {
        false
    }

    /// Where the child begins that this descent from `node` has postponed, in any measure that orders as the distance
    /// does (the bits of a positive float are one): what a traversal keeps that prunes by distance. It may begin
    /// later, never earlier.
    #[inline]
    fn postponed(&self, _node: Node, _descent: Descent) -> u32 {
        0
    }

    /// Where the search ends by now, in the same measure, or later: nodes that begin beyond it are not wanted any more.
    #[inline]
    fn end(&self) -> u32 {
        u32::MAX
    }
}

/// A search of which nothing is left out, for those who take one that [may be pruned](Pruned).
#[derive(Clone, Copy, Debug)]
pub struct Unpruned<V>(pub V);

impl<V: Visitor> Visitor for Unpruned<V> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        self.0.inner(node)
    }

    #[inline(always)]
    fn leaf(&mut self, node: Node) -> Flow {
        self.0.leaf(node)
    }
}

impl<V: Visitor> Pruned for Unpruned<V> {}

impl<V: Repeatable> Repeatable for Unpruned<V> {}

/// A search whose answer does not change if it is shown nodes that it did not want, or leaves that it has seen: closest
/// hit, any hit and nearest point are such, all hits are not.
///
/// Only they can be taken up again from a key alone: [`KeyOnly`](crate::traverse::KeyOnly). `[PAUSE-4]`
pub trait Repeatable: Visitor {}

/// A search that tests a node itself, at its visit, instead of its two children at the parent's.
///
/// Barringer & Akenine-Möller's Algorithm 1, skip pointers and Hapala's traversal are built for it.
pub trait NodeTest {
    /// Whether the subtree below this inner node is wanted.
    fn accept(&mut self, node: Node) -> bool;

    /// Looks into a leaf, which nobody has tested before.
    fn leaf(&mut self, node: Node) -> Flow;
}

impl<T: Visitor + ?Sized> Visitor for &mut T {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        (**self).inner(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        (**self).leaf(node)
    }
}

impl<T: Pruned + ?Sized> Pruned for &mut T {
    #[inline]
    fn allows(&self, pruning: Pruning) -> bool {
        (**self).allows(pruning)
    }

    #[inline]
    fn inner_marked(&mut self, node: Node) -> Descent {
        (**self).inner_marked(node)
    }

    #[inline]
    fn found_at(&self, leaf: Node) -> bool {
        (**self).found_at(leaf)
    }

    #[inline]
    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        (**self).postponed(node, descent)
    }

    #[inline]
    fn end(&self) -> u32 {
        (**self).end()
    }
}

impl<T: Repeatable + ?Sized> Repeatable for &mut T {}

impl<T: NodeTest + ?Sized> NodeTest for &mut T {
    #[inline]
    fn accept(&mut self, node: Node) -> bool {
        (**self).accept(node)
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        (**self).leaf(node)
    }
}

/// An order that is known before the traversal starts: the same at every visit of a node.
pub trait FixedOrder {
    /// The child of this inner node that comes first.
    fn first(&self, node: Node) -> Side;
}

/// Left before right, everywhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeftOrder;

impl FixedOrder for LeftOrder {
    #[inline]
    fn first(&self, _: Node) -> Side {
        Side::Left
    }
}

/// Near child by the sign of the ray's direction on the axis along which the node was split.
#[derive(Clone, Copy, Debug)]
pub struct SignOrder<'a> {
    /// Split axis (0, 1, 2) of each inner node, by [`Node::index`], plus [`REVERSED`](Self::REVERSED) where the left
    /// child holds the greater coordinates.
    pub axes: &'a [u8],
    /// Bit `a` is set where the direction's component `a` is negative.
    pub octant: u8,
}

impl SignOrder<'_> {
    /// Added to an axis along which the left child holds the greater coordinates.
    pub const REVERSED: u8 = 4;
}

impl FixedOrder for SignOrder<'_> {
    /// The child with the smaller coordinates comes first unless the ray runs towards them.
    #[inline]
    fn first(&self, node: Node) -> Side {
        let axis = self.axes[node.index()];
        let reversed = u8::from(axis & Self::REVERSED != 0);
        Side::right_if((self.octant >> (axis % Self::REVERSED) ^ reversed) & 1 == 1)
    }
}

/// Turns a node test and a fixed order into a visitor: accepted nodes want both children.
#[derive(Debug)]
pub struct ByNode<T, O> {
    /// The test.
    pub test: T,
    /// The order of the children.
    pub order: O,
}

impl<T: NodeTest, O: FixedOrder> Visitor for ByNode<T, O> {
    #[inline]
    fn inner(&mut self, node: Node) -> Descent {
        if self.test.accept(node) { Descent::both(self.order.first(node)) } else { Descent::NEITHER }
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.test.leaf(node)
    }
}

#[cfg(test)]
mod tests;

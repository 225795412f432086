//! What a visit decides: which children are wanted, and which of them comes first.
//!
//! A traversal knows nothing about geometry. At each inner node it asks a [`Visitor`] for a [`Descent`], once, and
//! acts on the answer; at each leaf it asks whether to go on. Ray tracing, nearest points, interval searches and
//! the decision tapes of the tests are all visitors. The answer is never asked for again on the way back
//! (Binder & Keller 2016, Section 2), except by the traversals that say so in their type
//! ([`Cursor::RESTARTS`](crate::traverse::Cursor::RESTARTS)).

pub use crate::key::Side;
use crate::tree::Node;

/// The decision at an inner node: no child is wanted, one is, or both are and one of them comes first.
///
/// Three bits, made and read without a branch: which children are hit is hard to predict, and a traversal that branches
/// on it more than once loses up to a third of its speed (`benches/README.md`).
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Descent(u8);

impl Descent {
    const RIGHT: u8 = 1;
    const BOTH: u8 = 2;
    const ANY: u8 = 4;

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
            (false, true) => write!(f, "both, {:?} first", self.first()),
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

/// What the caller does at a node.
pub trait Visitor {
    /// Decides at an inner node.
    fn inner(&mut self, node: Node) -> Descent;

    /// Looks into a leaf.
    fn leaf(&mut self, node: Node) -> Flow;
}

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
pub struct LeftFirst;

impl FixedOrder for LeftFirst {
    #[inline]
    fn first(&self, _: Node) -> Side {
        Side::Left
    }
}

/// Near child by the sign of the ray's direction on the axis along which the node was split.
#[derive(Clone, Copy, Debug)]
pub struct SignOrder<'a> {
    /// Split axis (0, 1, 2) of each inner node, by [`Node::index`], plus [`REVERSED`](Self::REVERSED) where the left child
    /// holds the greater coordinates.
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
mod tests {
    use super::*;

    #[test]
    fn decisions_from_hits() {
        use Side::{Left, Right};
        for prefer_right in [false, true] {
            assert_eq!(Descent::new(false, false, prefer_right), Descent::NEITHER);
            assert_eq!(Descent::new(true, false, prefer_right), Descent::only(Left));
            assert_eq!(Descent::new(false, true, prefer_right), Descent::only(Right));
            assert_eq!(Descent::new(true, true, prefer_right), Descent::both(Side::right_if(prefer_right)));
        }
        for side in [Left, Right] {
            let (only, both) = (Descent::only(side), Descent::both(side));
            assert_eq!((only.is_neither(), only.first(), only.postpones()), (false, side, false));
            assert_eq!((both.is_neither(), both.first(), both.postpones()), (false, side, true));
        }
        assert!(Descent::NEITHER.is_neither() && !Descent::NEITHER.postpones());
    }
}

//! What a visit decides: which children are wanted, and which of them comes first.
//!
//! A traversal knows nothing about geometry. At each inner node it asks a [`Visitor`] for a [`Descent`], once, and
//! acts on the answer; at each leaf it asks whether to go on. Ray tracing, nearest points, interval searches and
//! the decision tapes of the tests are all visitors. The answer is never asked for again on the way back
//! (Binder & Keller 2016, Section 2), except by the traversals that say so in their type
//! ([`Cursor::RESTARTS`](crate::traverse::Cursor::RESTARTS)).

use crate::tree::Node;

/// Left or right child. The numeric value is the lowest bit of the child's key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The child with key `2k`.
    Left = 0,
    /// The child with key `2k + 1`.
    Right = 1,
}

impl Side {
    /// `Right` for `true`.
    #[inline]
    pub const fn right_if(right: bool) -> Self {
        if right { Self::Right } else { Self::Left }
    }

    /// The other side.
    #[inline]
    #[must_use]
    pub const fn other(self) -> Self {
        Self::right_if(matches!(self, Self::Left))
    }

    /// Whether this is the right side.
    #[inline]
    pub const fn is_right(self) -> bool {
        matches!(self, Self::Right)
    }

    /// Position in an array of two children.
    #[inline]
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// The decision at an inner node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Descent {
    /// No child is wanted: backtrack.
    Neither,
    /// One child is wanted.
    Only(Side),
    /// Both are wanted; `first` is entered now, the other is postponed.
    Both {
        /// The child to enter now.
        first: Side,
    },
}

impl Descent {
    /// The decision from two hits and a preference that counts only when both are hit.
    ///
    /// The preference is ignored when one child is missed. (As printed, Algorithm 1 of Binder & Keller enters a
    /// missed right child if `closest` was computed from missed boxes; see `spec/DEPARTURES.md`, D-1.)
    #[inline]
    pub const fn new(left: bool, right: bool, prefer_right: bool) -> Self {
        match (left, right) {
            (false, false) => Self::Neither,
            (true, false) => Self::Only(Side::Left),
            (false, true) => Self::Only(Side::Right),
            (true, true) => Self::Both { first: Side::right_if(prefer_right) },
        }
    }

    /// The child to enter now, if any.
    #[inline]
    pub const fn first(self) -> Option<Side> {
        match self {
            Self::Neither => None,
            Self::Only(side) | Self::Both { first: side } => Some(side),
        }
    }

    /// Whether a child is postponed.
    #[inline]
    pub const fn postpones(self) -> bool {
        matches!(self, Self::Both { .. })
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

impl<T: NodeTest> NodeTest for &mut T {
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
    /// Split axis (0, 1, 2) of each inner node, by [`Node::index`].
    pub axes: &'a [u8],
    /// Bit `a` is set where the direction's component `a` is negative.
    pub octant: u8,
}

impl FixedOrder for SignOrder<'_> {
    /// The left child holds the smaller coordinates: it comes first unless the ray runs towards them.
    #[inline]
    fn first(&self, node: Node) -> Side {
        Side::right_if(self.octant >> self.axes[node.index()] & 1 == 1)
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
        if self.test.accept(node) { Descent::Both { first: self.order.first(node) } } else { Descent::Neither }
    }

    #[inline]
    fn leaf(&mut self, node: Node) -> Flow {
        self.test.leaf(node)
    }
}

//! Node keys: a leading one, then the path from the root, 0 for left and 1 for right.
//!
//! The root has key 1, the children of `k` are `2k` and `2k + 1`, the parent is `k / 2`, the sibling `k ^ 1`
//! (Binder & Keller 2016, Section 2.2 and Fig. 2). A key of `b` bits belongs to a node at depth `b - 1`, in edges,
//! so a word of `W` bits carries trees of depth `W - 1`.
//!
//! ```
//! use stackless_bvh::key;
//! assert_eq!(key::child(0b1011_u32, 0), 22); // the left child of node 11
//! assert_eq!(key::sibling(key::parent(key::parent(key::parent(22_u32)))), 3); // the example of Fig. 2
//! ```

mod grow;
mod side;
mod word;

pub use grow::Grow;
pub use side::Side;
pub(crate) use side::branched;
pub(crate) use word::PIECE;
pub use word::{KeyWord, TooDeep, Word};

/// Returns the key of the root. `[KEY-1]`
#[inline]
pub fn root<W: Word>() -> W {
    W::one()
}

/// Returns the key of a child; `right` is 0 or 1. `[KEY-2]`
#[inline]
pub fn child<W: Word>(key: W, right: W) -> W {
    key.shl1().or(&right)
}

/// Returns the key of the parent; 0 for the root. `[KEY-3]`
#[inline]
pub fn parent<W: Word>(key: W) -> W {
    key.shr1()
}

/// Returns the key of the sibling. Meaningless for the root. `[KEY-4]`
#[inline]
pub fn sibling<W: Word>(key: W) -> W {
    key.xor(&W::one())
}

/// Returns the depth, in edges, of the node with this key. `[KEY-5]`
#[inline]
pub fn depth<W: KeyWord>(key: &W) -> u32 {
    key.bit_length().saturating_sub(1)
}

/// Returns the key of the leftmost node at the depth of this key: its leading one. 0 for 0. `[KEY-6]`
pub fn level_start<W: KeyWord>(key: &W) -> W {
    match (W::highest(), W::WIDTH) {
        (Some(highest), Some(width)) if !key.is_zero() => highest.shr(width - key.bit_length()),
        _ if key.is_zero() => W::zero(),
        _ => (0..depth(key)).fold(W::one(), |start, _| start.shl1()),
    }
}

#[cfg(test)]
mod tests;

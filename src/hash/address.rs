//! Addresses of nodes in 31 bits, marked by the sign.

use crate::tree::Node;

/// Number of addresses of a kind that the tables support: indices below 2^30.
pub(super) const LIMIT: usize = 1 << 30;

const SIGN: u32 = 1 << 31;

/// Returns the word for a node: `0x80000000 + a` for the inner node `a`, `!i` (from `0xC0000000` up) for the leaf `i`.
/// The sign bit of either word is set, so they differ from displacements and empty cells. `[HASH-5]`
///
/// Binder & Keller (2016, Section 2.2.2) use these marks for direct addresses in the table of displacements; here the
/// cells hold the same words. The index must be below 2^30.
pub const fn encode(node: Node) -> u32 {
    let index = node.index() as u32;
    if node.is_leaf() { !index } else { SIGN | index }
}

/// Returns whether a word encodes a node.
#[inline(always)]
pub const fn is_address(word: u32) -> bool {
    word & SIGN != 0
}

/// Returns the node of a word: bit 30 is extended over the sign, as hardware does, and a negative number is a leaf.
#[inline(always)]
pub const fn decode(word: u32) -> Node {
    let signed = (word << 1).cast_signed() >> 1;
    // `signed` for an inner node; `!signed` with the top bit set, which marks a leaf here, for a leaf.
    Node::from_bits((signed ^ (signed >> 31 & i32::MAX)).cast_unsigned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_paper_and_come_back() {
        let last = LIMIT as u32 - 1;
        for (node, word) in [
            (Node::inner(0), 0x8000_0000),
            (Node::inner(5), 0x8000_0005),
            (Node::inner(last), 0xbfff_ffff),
            (Node::leaf(0), 0xffff_ffff),
            (Node::leaf(5), 0xffff_fffa),
            (Node::leaf(last), 0xc000_0000),
        ] {
            assert_eq!(encode(node), word);
            assert!(is_address(word));
            assert_eq!(decode(word), node);
        }
        assert!(!is_address(0) && !is_address(SIGN - 1));
    }
}

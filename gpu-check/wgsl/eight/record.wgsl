// Nodes of up to eight children [WIDE-1]: their records.
//
// An inner node is 8 pieces of 16 bytes: children by slot, the eight nearest ancestors (the root stands for those above
// it), ranks by slot, and the sets of slots that are leaves and that are wanted. A leaf is one piece.

const SLOTS = 8u;
const SLOT_MASK = 7u;
// Of a set of slots.
const SET_BITS = 8u;

// The rank of each wanted child of the node that the search was asked about last [WIDE-2].
var<private> ranks: array<u32, SLOTS>;

fn child_of(address: u32, slot: u32) -> u32 {
    return nodes[address + (slot >> 2u)][slot & 3u];
}

// 1 to 8 levels up [WIDE-15].
fn ancestor_of(address: u32, up: u32) -> u32 {
    return nodes[address + 2u + ((up - 1u) >> 2u)][(up - 1u) & 3u];
}

// The set of slots that hold a leaf.
fn leaves_of(address: u32) -> u32 {
    return nodes[address + 6u].x;
}

// The number of the slot in the lowest bits of a rank.
fn slot_of(rank: u32) -> u32 {
    return rank & SLOT_MASK;
}

// [WIDE-3]
fn is_beyond(rank: u32) -> bool {
    return (rank & ~SLOT_MASK) > end;
}

// Nodes of up to eight children [WIDE-1]: their records.
//
// An inner node is 8 pieces of 16 bytes: children by slot, the eight nearest ancestors (with the root for levels above
// it), and four pieces for the search. An empty slot holds 0.

const SLOTS = 8u;
const SLOT_MASK = 7u;
// Number of bits of a set of slots.
const SET_BITS = 8u;

// The rank of each wanted child of the last queried node [WIDE-2], in slots 0 to 3 and 4 to 7. Ranks stay in registers,
// because no rank is indexed.
var<private> low_ranks: vec4<u32>;
var<private> high_ranks: vec4<u32>;

fn rank_of(slot: u32) -> u32 {
    let four = select(low_ranks, high_ranks, (slot & 4u) != 0u);
    let two = select(four.xy, four.zw, (slot & 2u) != 0u);
    return select(two.x, two.y, (slot & 1u) != 0u);
}

fn child_of(address: u32, slot: u32) -> u32 {
    return nodes[address + (slot >> 2u)][slot & 3u];
}

// 1 to 8 levels up [WIDE-15].
fn ancestor_of(address: u32, up: u32) -> u32 {
    return nodes[address + 2u + ((up - 1u) >> 2u)][(up - 1u) & 3u];
}

// The set of slots that hold a leaf: their addresses have the sign bit.
fn leaves_of(address: u32) -> u32 {
    let sign = vec4(31u);
    return set_of((nodes[address] >> sign) == vec4(1u), (nodes[address + 1u] >> sign) == vec4(1u));
}

// The set of slots 0 to 3 and 4 to 7 with a property.
fn set_of(low: vec4<bool>, high: vec4<bool>) -> u32 {
    let bits = select(vec4(0u), vec4(1u, 2u, 4u, 8u), low) | select(vec4(0u), vec4(16u, 32u, 64u, 128u), high);
    return (bits.x | bits.y) | (bits.z | bits.w);
}

// The number of the slot in the lowest bits of a rank.
fn slot_of(rank: u32) -> u32 {
    return rank & SLOT_MASK;
}

// [WIDE-3]
fn is_beyond(rank: u32) -> bool {
    return (rank & ~SLOT_MASK) > end();
}

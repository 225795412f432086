// What all kernels share: the records of a tree, addresses, and what a visit decides.
//
// An address counts pieces of 16 bytes. An inner node has its address in `nodes`; a leaf at `o` in `leaves` is `~o`,
// with the sign bit set. 0 is the first record, the root or nothing: it is never postponed, so a register that holds 0
// is empty.

@group(0) @binding(0) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> leaves: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> displacements: array<u32>;
@group(0) @binding(3) var<storage, read> cells: array<u32>;
@group(0) @binding(4) var<storage, read> tasks: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> results: array<vec4<u32>>;
// Number of tasks, invocations in a row of work groups, and steps of a traversal at most where events are recorded.
@group(0) @binding(6) var<uniform> params: vec4<u32>;
@group(0) @binding(7) var<storage, read_write> work: array<atomic<u32>>;

// An inner node, 64 bytes: what the search wants to know of the left child, of the right one, of both; then left and
// right child and two links.
struct Record {
    left: vec4<u32>,
    right: vec4<u32>,
    both: vec4<u32>,
    children: vec2<u32>,
    links: vec2<u32>,
}

// Neither an inner node nor a leaf.
const DONE = 0x7fffffffu;
// In place of a leaf's first word: no more in this leaf; the links follow.
const TERMINATOR = 0x80000000u;
const NONE = 0xffffffffu;

// A descent, as bits: the right child comes first, both are wanted, any is, and they are disjoint.
const RIGHT = 1u;
const BOTH = 2u;
const ANY = 4u;
const DISJOINT = 8u;

// The node to visit next.
var<private> node: u32;
// Of this invocation in its work group.
var<private> lane: u32;

fn is_inner(address: u32) -> bool {
    return address < DONE;
}

fn is_leaf(address: u32) -> bool {
    return address > DONE;
}

fn fetch(address: u32) -> Record {
    let last = nodes[address + 3u];
    return Record(nodes[address], nodes[address + 1u], nodes[address + 2u], last.xy, last.zw);
}

// [ORDER-1]: the preference counts only where both are wanted.
fn descent_of(left: bool, right: bool, prefer_right: bool) -> u32 {
    let first_right = right && (!left || prefer_right);
    return select(0u, ANY, left || right) | select(0u, BOTH, left && right) | select(0u, RIGHT, first_right);
}

fn first_child(record: Record, descent: u32) -> u32 {
    return select(record.children.x, record.children.y, (descent & RIGHT) != 0u);
}

fn second_child(record: Record, descent: u32) -> u32 {
    return select(record.children.y, record.children.x, (descent & RIGHT) != 0u);
}

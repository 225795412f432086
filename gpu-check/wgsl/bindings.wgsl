// The common part of all kernels: buffers and addresses.
//
// An address counts pieces of 16 bytes. An inner node has its address in `nodes`; a leaf at `o` in `leaves` is `~o`,
// with the sign bit set. 0 is the first record: the root, or unused. It is never postponed, so a register with 0 is
// empty.

@group(0) @binding(0) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> leaves: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> displacements: array<u32>;
@group(0) @binding(3) var<storage, read> cells: array<u32>;
@group(0) @binding(4) var<storage, read> tasks: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> results: array<vec4<u32>>;
// Number of tasks, invocations in a row of work groups, and maximum number of steps of a recorded traversal.
@group(0) @binding(6) var<uniform> params: vec4<u32>;
@group(0) @binding(7) var<storage, read_write> work: array<atomic<u32>>;

// Neither an inner node nor a leaf.
const DONE = 0x7fffffffu;
// Instead of a leaf's first word: the leaf ends, and the links follow.
const TERMINATOR = 0x80000000u;
const NONE = 0xffffffffu;

// The node to visit next.
var<private> node: u32;
// The number of this invocation in its work group.
var<private> lane: u32;

fn is_inner(address: u32) -> bool {
    return address < DONE;
}

fn is_leaf(address: u32) -> bool {
    return address > DONE;
}

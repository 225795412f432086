// Nodes of two children: their records, and the decision of a visit.

// An inner node, 64 bytes: data of the search for the left child, for the right child, and for both children; then left
// and right child and two links.
struct Record {
    left: vec4<u32>,
    right: vec4<u32>,
    both: vec4<u32>,
    children: vec2<u32>,
    links: vec2<u32>,
}

// A descent, as bits: the right child comes first, both children are wanted, any child is wanted, and the children are
// disjoint.
const RIGHT = 1u;
const BOTH = 2u;
const ANY = 4u;
const DISJOINT = 8u;

fn fetch(address: u32) -> Record {
    let last = nodes[address + 3u];
    return Record(nodes[address], nodes[address + 1u], nodes[address + 2u], last.xy, last.zw);
}

// [ORDER-1]: the preference counts only if both children are wanted.
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

// Decision tapes: writes the decisions of a seed's tape into the records of inner nodes. The numbers are those of
// `generate::Tape::hashed`: the generator for the node with key k is SplitMix64 seeded with h(k), where h(1) =
// mix(seed) and h(2k + b) = mix(h(k) ^ (b + 1)). A cell is a function of the cells above it, so each invocation walks
// down from the root.

@group(0) @binding(0) var<storage, read_write> nodes: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> leaves: array<vec4<u32>>;
// For each inner node: address, depth, path below the root (96 bits, the last step lowest), kind, seed.
@group(0) @binding(2) var<storage, read> jobs: array<vec4<u32>>;
@group(0) @binding(3) var<uniform> params: vec4<u32>;

const NONE = 0xffffffffu;
const ROOT_EXIT = 1u << 20u;

const KIND_RANDOM = 0u;
const KIND_ALL_HIT = 1u;
const KIND_NONE_HIT = 2u;
const KIND_ONLY_ONE = 3u;
const KIND_ALTERNATING = 4u;
const KIND_SHRINKING = 5u;
const KIND_INTERVALS = 6u;
const KIND_CLIPPED = 7u;
const KIND_SCRIPT = 8u;

// The cell of a node: distances at which it is entered, left and, if it is a leaf, hit.
struct Cell {
    enter: u32,
    exit: u32,
    hit: u32,
    miss: bool,
}

var<private> state: vec2<u32>;

fn bits() -> vec2<u32> {
    state = wide_add(state, vec2(0x7f4a7c15u, 0x9e3779b9u));
    return wide_mix(state);
}

fn below(bound: u32) -> u32 {
    let random = bits();
    let low = wide_product(random.x, bound);
    return wide_add(wide_product(random.y, bound), vec2(low.y, 0u)).y;
}

fn coin() -> bool {
    return below(2u) == 1u;
}

// The cells of the two children of a node, and whether the right child comes first.
struct Drawn {
    children: array<Cell, 2>,
    right_first: bool,
}

fn draw(hash: vec2<u32>, kind: u32, cell: Cell, depth: u32) -> Drawn {
    state = hash;
    let plain = Cell(cell.enter, cell.exit, NONE, false);
    var drawn = Drawn(array(plain, plain), false);
    if kind == KIND_SCRIPT {
        let decision = below(5u);
        drawn.children[0].miss = decision == 0u || decision == 2u;
        drawn.children[1].miss = decision == 0u || decision == 1u;
        drawn.right_first = decision == 4u;
        return drawn;
    }
    if kind == KIND_ALTERNATING {
        drawn.right_first = (depth & 1u) == 1u;
    } else if kind != KIND_NONE_HIT {
        drawn.right_first = coin();
    }
    // An axis, for traversals of fixed order.
    below(3u);
    if kind == KIND_ONLY_ONE {
        let missed = coin();
        drawn.children[0].miss = !missed;
        drawn.children[1].miss = missed;
    }
    for (var i = 0u; i < 2u; i++) {
        var child = drawn.children[i];
        if kind == KIND_RANDOM {
            child.miss = below(4u) == 1u;
        } else if kind == KIND_NONE_HIT {
            child.miss = true;
        } else if kind == KIND_SHRINKING {
            child.enter += below(8u);
            child.miss = below(8u) == 1u;
            let distance = below(64u);
            child.hit = select(NONE, child.enter + distance, coin());
        } else if kind == KIND_INTERVALS || kind == KIND_CLIPPED {
            let exit = select(cell.exit, ROOT_EXIT, cell.exit == NONE);
            let length = exit - child.enter;
            let a = below(length + 1u);
            let b = below(length + 1u);
            child.exit = child.enter + max(a, b);
            child.enter += min(a, b);
            child.miss = below(8u) == 1u;
            let reach = select(child.exit, exit, kind == KIND_CLIPPED);
            let distance = below(reach - child.enter + 1u);
            child.hit = select(NONE, child.enter + distance, coin());
        }
        drawn.children[i] = child;
    }
    if kind != KIND_SHRINKING && kind != KIND_INTERVALS && kind != KIND_CLIPPED {
        for (var i = 0u; i < 2u; i++) {
            drawn.children[i].hit = select(NONE, NONE - 1u, below(8u) == 1u);
        }
    }
    return drawn;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let job = id.x + id.y * params.y;
    if job >= params.x {
        return;
    }
    let place = jobs[2u * job];
    let more = jobs[2u * job + 1u];
    let path = vec3(place.zw, more.x);
    let kind = more.y;
    let address = place.x;
    let depth = place.y;

    var cell = Cell(0u, NONE, NONE, false);
    var hash = wide_mix(more.zw);
    for (var level = 0u; level < depth; level++) {
        let at = depth - 1u - level;
        let right = (path[at >> 5u] >> (at & 31u)) & 1u;
        // No numbers are drawn below a missed node.
        if !cell.miss {
            var drawn = draw(hash, kind, cell, level);
            cell = drawn.children[right];
        }
        hash = wide_mix(hash ^ vec2(right + 1u, 0u));
    }
    var drawn = draw(hash, kind, cell, depth);
    if cell.miss {
        drawn = Drawn(array(cell, cell), false);
    }
    for (var i = 0u; i < 2u; i++) {
        let child = drawn.children[i];
        nodes[address + i] = vec4(child.enter, child.exit, child.hit, select(0u, 1u, child.miss));
        let link = nodes[address + 3u][i];
        if (link >> 31u) == 1u {
            let hit = select(child.hit, NONE, child.miss);
            leaves[~link] = vec4(hit, child.exit, leaves[~link].zw);
        }
    }
    nodes[address + 2u] = vec4(select(0u, 1u, drawn.right_first), 0u, 0u, 0u);
}

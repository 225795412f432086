// Construction of a perfect hash (Binder & Keller 2016, Section 2.2.2) in passes, selected by STAGE. An invocation of
// the first and the third pass has a key, an invocation of the other passes a bucket.

// Keys: 64 bits, the address for the entry, an unused word.
@group(0) @binding(0) var<storage, read> keys: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> counts: array<atomic<u32>>;
// Starts of buckets in `order`, and the numbers of keys there so far.
@group(0) @binding(2) var<storage, read_write> starts: array<u32>;
@group(0) @binding(3) var<storage, read_write> fills: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> order: array<u32>;
@group(0) @binding(5) var<storage, read_write> displacements: array<u32>;
@group(0) @binding(6) var<storage, read_write> cells: array<atomic<u32>>;
// Keys that share a bucket, buckets without a displacement, keys of the largest bucket.
@group(0) @binding(7) var<storage, read_write> totals: array<atomic<u32>>;
// Invocations, invocations in a row, keys of the buckets that are placed now, D - 1; H, and floor((2^64 - 1) / H).
@group(0) @binding(8) var<uniform> params: array<vec4<u32>, 2>;

var<private> DIRECT_MASK: u32;
var<private> TABLE_SIZE: u32;
var<private> RECIPROCAL: vec2<u32>;

fn bucket(key: u32) -> u32 {
    return keys[key].x & DIRECT_MASK;
}

fn count_key(key: u32) {
    let count = atomicAdd(&counts[bucket(key)], 1u) + 1u;
    atomicMax(&totals[2], count);
}

fn reserve(at: u32) {
    let count = atomicLoad(&counts[at]);
    if count > 1u {
        starts[at] = atomicAdd(&totals[0], count);
    }
}

fn sort_key(key: u32) {
    let at = bucket(key);
    if atomicLoad(&counts[at]) == 1u {
        displacements[at] = keys[key].z;
    } else {
        order[starts[at] + atomicAdd(&fills[at], 1u)] = key;
    }
}

// Returns whether the cell was empty. It then holds the address.
fn claim(cell: u32, address: u32) -> bool {
    var result = atomicCompareExchangeWeak(&cells[cell], 0u, address);
    // A weak exchange may fail although the cell is empty.
    while !result.exchanged && result.old_value == 0u {
        result = atomicCompareExchangeWeak(&cells[cell], 0u, address);
    }
    return result.exchanged;
}

// Claims the cells of all keys of a bucket, or no cell.
fn claim_all(start: u32, count: u32, displacement: u32) -> bool {
    var claimed = 0u;
    while claimed < count {
        let key = keys[order[start + claimed]];
        if !claim(wrap(remainder(key.xy) + displacement), key.z) {
            break;
        }
        claimed++;
    }
    if claimed == count {
        return true;
    }
    for (var i = 0u; i < claimed; i++) {
        atomicStore(&cells[wrap(remainder(keys[order[start + i]].xy) + displacement)], 0u);
    }
    return false;
}

// Places buckets of one size concurrently. The winner of a contested cell is not determined, so the tables are not
// determined, either.
fn place(at: u32) {
    if atomicLoad(&counts[at]) != params[0].z {
        return;
    }
    var is_placed = false;
    for (var displacement = 0u; displacement < TABLE_SIZE && !is_placed; displacement++) {
        if claim_all(starts[at], params[0].z, displacement) {
            displacements[at] = displacement;
            is_placed = true;
        }
    }
    if !is_placed {
        atomicAdd(&totals[1], 1u);
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x + id.y * params[0].y;
    if i >= params[0].x {
        return;
    }
    DIRECT_MASK = params[0].w;
    TABLE_SIZE = params[1].x;
    RECIPROCAL = params[1].yz;
    if STAGE == 0u {
        count_key(i);
    } else if STAGE == 1u {
        reserve(i);
    } else if STAGE == 2u {
        sort_key(i);
    } else {
        place(i);
    }
}

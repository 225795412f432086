// The search of a tape for wide trees, without floats. A task is a tree with its tape, and an order.

// Whether children are ordered by rank; otherwise leaves come first, and no child is beyond the end [WIDE-6].
var<private> is_sorted: bool;
// Whether the wanted children depend on the number of previous leaves.
var<private> is_changing: bool;

// [WIDE-3]
var<private> least_end: u32;
var<private> stopped: bool;
// Number of tested leaves.
var<private> looked: u32;

fn begin(task: u32) {
    read_head(4u * task);
    let kind = tasks[4u * task].y;
    is_sorted = (kind & 1u) == 1u;
    is_changing = (kind & 2u) == 2u;
    least_end = NONE;
    stopped = false;
    looked = 0u;
}

fn finish(task: u32) {
    results[2u * task] = vec4(least_end, looked, 1u, visits);
    results[2u * task + 1u] = vec4(record_end(), 0u, 0u);
}

fn end() -> u32 {
    return least_end;
}

// Returns the set of wanted children, and leaves their ranks in `low_ranks` and `high_ranks`. A repeated query [WIDE-4]
// returns all children, because only pending children count then, and those were wanted.
fn ask(address: u32, is_again: bool) -> u32 {
    low_ranks = nodes[address + 4u];
    high_ranks = nodes[address + 5u];
    // Wanted children, number of the node.
    let said = nodes[address + 6u];
    var wanted = said.x;
    if is_changing && !is_again {
        wanted &= wide_mix(wide_mix(vec2(looked + 1u, 0u)) ^ vec2(said.y, low_ranks.x)).x;
    }
    if is_sorted {
        for (var slot = 0u; slot < SLOTS; slot++) {
            wanted &= ~(select(0u, 1u, is_beyond(rank_of(slot))) << slot);
        }
    }
    return wanted;
}

// A leaf holds the new end, and whether the search ends.
fn look_into(offset: u32) {
    let cell = leaves[offset];
    looked += 1u;
    if is_sorted {
        least_end = min(least_end, cell.x);
    }
    stopped = cell.y == 1u;
}

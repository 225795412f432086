// The search of a decision tape: no floats. A task is a tree and a query.

// Whether any hit ends the search.
var<private> any_hit: bool;

// The closest hit, or the first: distance and slot.
var<private> found: bool;
var<private> best: vec2<u32>;
// Whether a leaf has ended the search, and whether the best hit is in the last tested leaf, within its box.
var<private> stopped: bool;
var<private> found_here: bool;

fn begin(task: u32) {
    read_head(4u * task);
    any_hit = tasks[4u * task].y == 1u;
    found = false;
    best = vec2(NONE, NONE);
    stopped = false;
    found_here = false;
}

fn finish(task: u32) {
    results[2u * task] = vec4(best, select(0u, 1u, found), visits);
    results[2u * task + 1u] = vec4(record_end(), 0u, 0u);
}

// A cell is (enter, exit, hit, missed).
fn is_wanted(cell: vec4<u32>) -> bool {
    return cell.w == 0u && (!found || cell.x <= best.x);
}

fn decide(record: Record) -> u32 {
    let left = record.left;
    let right = record.right;
    let right_first = select(right.x < left.x, record.both.x == 1u, left.x == right.x);
    let descent = descent_of(is_wanted(left), is_wanted(right), right_first);
    let first_is_right = (descent & RIGHT) != 0u;
    let first_exit = select(left.y, right.y, first_is_right);
    let second_enter = select(right.x, left.x, first_is_right);
    return descent | select(0u, DISJOINT, first_exit < second_enter);
}

// The distance at which the second child of a descent begins.
fn begins(record: Record, descent: u32) -> u32 {
    return select(record.right.x, record.left.x, (descent & RIGHT) != 0u);
}

// The current end of the search.
fn end() -> u32 {
    return best.x;
}

// Tests the leaf at an offset, and returns its links. A leaf holds (hit, exit, slot, 0), then its terminator.
fn look_into(offset: u32) -> vec3<u32> {
    let cell = leaves[offset];
    if cell.x != NONE && (!found || cell.x < best.x || (cell.x == best.x && cell.z < best.y)) {
        found = true;
        best = vec2(cell.x, cell.z);
        stopped = any_hit;
    }
    found_here = found && best.y == cell.z && best.x <= cell.y;
    return leaves[offset + 1u].yzw;
}

// [WSTACK-1]: the wanted children with their ranks, the least on top.

// (rank, address)
var<private> stack: array<vec2<u32>, STACK_SIZE>;
var<private> height: u32;

fn cursor_start(root: u32) {
    node = root;
    present = root;
    levels_back = 0u;
    height = 0u;
}

// Inserts a child among the children above `base`. Ranks decrease upwards.
fn settle(base: u32, entry: vec2<u32>) {
    var at = height;
    loop {
        if at == base || stack[at - 1u].x > entry.x {
            break;
        }
        stack[at] = stack[at - 1u];
        at -= 1u;
    }
    stack[at] = entry;
    height += 1u;
}

// The next child: the first wanted child of the present node, or the top of the stack if no child is wanted.
fn cursor_next(wanted: u32) {
    let base = height;
    var left = wanted;
    loop {
        if left == 0u {
            break;
        }
        let slot = firstTrailingBit(left);
        left &= left - 1u;
        // Without an order the slot is the rank, and no rank is beyond the end.
        settle(base, vec2(select(slot, rank_of(slot), is_sorted), child_of(present, slot)));
    }
    loop {
        if height == 0u {
            node = DONE;
            break;
        }
        height -= 1u;
        let entry = stack[height];
        if !is_beyond(entry.x) {
            node = entry.y;
            break;
        }
    }
}

fn cursor_shortened() {}

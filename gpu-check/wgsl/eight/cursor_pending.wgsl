// Without a stack: a pending set for each level [WIDE-13]. What is kept of the levels above is another text, and so is
// the way to an ancestor.

// The pending children of the present node.
var<private> pending: u32;
// Ranks of the two pending children that come next; 0 where there is none or it is not known. The least rank of a node
// is never kept, so no rank here is 0.
var<private> next_ranks: vec2<u32>;

fn cursor_start(root: u32) {
    node = root;
    present = root;
    levels_back = 0u;
    pending = 0u;
    next_ranks = vec2(0u, 0u);
    kept_clear();
    link_clear();
}

// The least rank of a set that is not empty; keeps the two after it.
fn sort(wanted: u32) -> u32 {
    var first = NONE;
    var second = NONE;
    var third = NONE;
    var left = wanted;
    loop {
        if left == 0u {
            break;
        }
        let rank = ranks[firstTrailingBit(left)];
        left &= left - 1u;
        let greater = max(first, rank);
        first = min(first, rank);
        third = min(third, max(second, greater));
        second = min(second, greater);
    }
    let count = countOneBits(wanted);
    next_ranks = vec2(select(0u, second, count > 1u), select(0u, third, count > 2u));
    return first;
}

// Names the child in a slot, and goes down if it is an inner node [WIDE-10].
fn take(slot: u32) {
    pending &= ~(1u << slot);
    node = child_of(present, slot);
    if is_inner(node) {
        kept_push();
        link_enter(slot);
        pending = 0u;
    }
}

// The next child: of those that are wanted of the present node the first, or the next pending one if there are none.
fn cursor_next(answer: u32) {
    var wanted = answer;
    if answer != 0u && !is_sorted {
        pending = answer;
    }
    loop {
        if wanted != 0u && is_sorted {
            pending = wanted;
            take(slot_of(sort(wanted)));
            break;
        }
        if pending == 0u {
            let up = kept_pop();
            if up == 0u {
                node = DONE;
                break;
            }
            present = link_ancestor(present, up);
            levels_back += up;
        }
        if !is_sorted {
            take(firstTrailingBit(pending));
            break;
        }
        if next_ranks.x != 0u {
            let rank = next_ranks.x;
            if !is_beyond(rank) {
                next_ranks = vec2(next_ranks.y, 0u);
                take(slot_of(rank));
                break;
            }
            // And so are those that come after it.
            pending = 0u;
        } else if (pending & (pending - 1u)) == 0u && !kept_is_stale() {
            take(firstTrailingBit(pending));
            break;
        } else {
            wanted = ask(present, true) & pending;
            kept_asked();
            pending = wanted;
        }
    }
}

fn cursor_shortened() {
    kept_shortened();
}

fn cursor_levels() -> u32 {
    return levels_back;
}

fn cursor_key() -> Word {
    return link_key();
}

fn cursor_trail() -> Word {
    return WORD_ZERO;
}

fn cursor_register() -> u32 {
    return 0u;
}

// Traversal without a stack: a pending set for each level [WIDE-13]. The storage of the levels above, and the path to
// an ancestor, are separate texts.

// The pending children of the present node.
var<private> pending: u32;
// Ranks of the next two pending children; 0 if there is no such child or its rank is unknown. The least rank of a node
// is never kept, so no kept rank is 0.
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

// Returns the least rank of a nonempty set, and keeps the next two ranks.
fn sort(wanted: u32) -> u32 {
    let low = select(vec4(NONE), low_ranks, (vec4(wanted) & vec4(1u, 2u, 4u, 8u)) != vec4(0u));
    let high = select(vec4(NONE), high_ranks, (vec4(wanted) & vec4(16u, 32u, 64u, 128u)) != vec4(0u));
    // Unrolled, because indexed ranks would be in memory.
    var least = with_rank(with_rank(vec3(NONE), low.x), low.y);
    least = with_rank(with_rank(least, low.z), low.w);
    least = with_rank(with_rank(least, high.x), high.y);
    least = with_rank(with_rank(least, high.z), high.w);
    let count = countOneBits(wanted);
    next_ranks = vec2(select(0u, least.y, count > 1u), select(0u, least.z, count > 2u));
    return least.x;
}

// The three least of four ranks, in order. The first three are in order.
fn with_rank(least: vec3<u32>, rank: u32) -> vec3<u32> {
    return min(least, vec3(rank, max(least.xy, vec2(rank))));
}

// Takes the child in a slot, and descends if it is an inner node [WIDE-10].
fn take(slot: u32) {
    pending &= ~(1u << slot);
    node = child_of(present, slot);
    if is_inner(node) {
        kept_push();
        link_enter(slot);
        pending = 0u;
    }
}

// The next child: the first wanted child of the present node, or the next pending child if no child is wanted.
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
            // All later children are beyond the end, too.
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

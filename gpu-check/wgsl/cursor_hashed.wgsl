// [HASHED-1]: key, trail, the register of the most recently postponed node (`latest`), uncles, perfect hash. Links are
// (uncle, grand uncle, grand grand uncle). With FILLS_AT_LOAD each load of a record fills the register, as in H
// Algorithm 1. Otherwise the register is filled on backtracks, and on a descent past the reach of a node [REGISTER-2].
// PRUNES adds a second trail [DISJOINT-1].

var<private> key: Word;
var<private> trail: Word;
var<private> disjoint: Word;
// 0 if empty.
var<private> latest: u32;
// One more than the levels of the last backtrack, 0 after a descent.
var<private> levels_back: u32;

fn cursor_start(root: u32) {
    node = root;
    key = WORD_ONE;
    trail = WORD_ZERO;
    disjoint = WORD_ZERO;
    latest = 0u;
    levels_back = 0u;
}

// Takes the lowest postponed node that a record names. `reach` masks the corresponding bits of the trail.
fn fill(links: vec3<u32>, reach: u32) {
    let pending = word_low(trail) & reach;
    var named = select(0u, links.z, (pending & 8u) != 0u);
    named = select(named, links.y, (pending & 4u) != 0u);
    named = select(named, links.x, (pending & 2u) != 0u);
    latest = select(latest, named, latest == 0u);
}

fn cursor_load(links: vec3<u32>, reach: u32) {
    if FILLS_AT_LOAD {
        fill(links, reach);
    }
}

fn cursor_descend(record: Record, descent: u32) -> bool {
    if (descent & BOTH) != 0u {
        latest = second_child(record, descent);
    } else if !FILLS_AT_LOAD {
        // Only the grand uncle leaves the reach, and only if no nearer node is postponed.
        let leaving = latest == 0u && (word_low(trail) & 7u) == 4u;
        latest = select(latest, record.links.y, leaving);
    }
    node = first_child(record, descent);
    key = word_child(key, descent & RIGHT);
    trail = word_child(trail, (descent & BOTH) >> 1u);
    if PRUNES {
        disjoint = word_child(disjoint, select(0u, 1u, (descent & DISJOINT) != 0u));
    }
    levels_back = 0u;
    return true;
}

// [TRAIL-4]
fn cursor_backtrack(links: vec3<u32>, reach: u32) {
    if word_is_zero(trail) {
        node = DONE;
    } else {
        if !FILLS_AT_LOAD {
            fill(links, reach);
        }
        let levels = word_zeros(trail);
        key = word_toggle(word_shift(key, levels));
        trail = word_toggle(word_shift(trail, levels));
        if PRUNES {
            disjoint = word_shift(disjoint, levels);
        }
        if latest != 0u {
            node = latest;
            latest = 0u;
        } else {
            node = table_node(key);
        }
        levels_back = levels + 1u;
    }
}

// [DISJOINT-2], [DISJOINT-3]: before the leaf fills the register.
fn cursor_prune() {
    let kept = word_without(trail, disjoint);
    if word_is_zero(kept) || word_zeros(kept) != word_zeros(trail) {
        latest = 0u;
    }
    trail = kept;
}

fn cursor_is_restarting() -> bool {
    return false;
}

fn cursor_levels() -> u32 {
    return levels_back;
}

fn cursor_key() -> Word {
    return key;
}

fn cursor_trail() -> Word {
    return trail;
}

fn cursor_register() -> u32 {
    return latest;
}

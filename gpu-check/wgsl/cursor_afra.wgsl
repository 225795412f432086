// [AFRA-1]: a trail, and a climb along parents, then the sibling. Links are (parent, sibling).

var<private> trail: Word;
// One more than the levels of the last backtrack, 0 after a descent.
var<private> levels_back: u32;

fn cursor_start(root: u32) {
    node = root;
    trail = WORD_ZERO;
    levels_back = 0u;
}

fn cursor_load(links: vec3<u32>, reach: u32) {}

fn cursor_descend(record: Record, descent: u32) -> bool {
    node = first_child(record, descent);
    trail = word_child(trail, (descent & BOTH) >> 1u);
    levels_back = 0u;
    return true;
}

fn cursor_backtrack(links: vec3<u32>, reach: u32) {
    if word_is_zero(trail) {
        node = DONE;
    } else {
        let levels = word_zeros(trail);
        var family = links.xy;
        for (var i = 0u; i < levels; i++) {
            family = nodes[family.x + 3u].zw;
        }
        node = family.y;
        trail = word_toggle(word_shift(trail, levels));
        levels_back = levels + 1u;
    }
}

fn cursor_prune() {}

fn cursor_is_restarting() -> bool {
    return false;
}

fn cursor_levels() -> u32 {
    return levels_back;
}

fn cursor_key() -> Word {
    return WORD_ZERO;
}

fn cursor_trail() -> Word {
    return trail;
}

fn cursor_register() -> u32 {
    return 0u;
}

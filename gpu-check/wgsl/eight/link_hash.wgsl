// [WIDE-15] (3): by its key, from a table with the keys of [WIDE-16].

const SLOT_BITS = 3u;

// The key of the present node; of the next node as soon as it is known to be an inner node [WIDE-9].
var<private> key: Word;

fn link_clear() {
    key = WORD_ONE;
}

fn link_enter(slot: u32) {
    for (var i = 0u; i < SLOT_BITS; i++) {
        key = word_child(key, (slot >> (SLOT_BITS - 1u - i)) & 1u);
    }
}

fn link_ancestor(start: u32, up: u32) -> u32 {
    key = word_shift(key, SLOT_BITS * up);
    return table_node(key);
}

// The key of the parent of the visited node; 0 at the root.
fn link_key() -> Word {
    if is_inner(node) {
        return word_shift(key, SLOT_BITS);
    }
    return key;
}

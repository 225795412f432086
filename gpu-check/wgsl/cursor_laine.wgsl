// [LAINE-1]: a trail of level bits, the highest for the root; restarts from the root, and a short stack of the SHORT
// latest postponed nodes.

var<private> laine_root: u32;
var<private> trail: Word;
// The level bit of the choice of this node.
var<private> level: Word;
// The level bit at which the last backtrack changed sides; 0 before the first backtrack.
var<private> pop_level: Word;

var<private> ring: array<u32, RING_SIZE>;
var<private> ring_head: u32;
var<private> ring_length: u32;

fn cursor_start(root: u32) {
    node = root;
    laine_root = root;
    trail = WORD_ZERO;
    level = WORD_TOP;
    pop_level = WORD_ZERO;
    ring_head = 0u;
    ring_length = 0u;
}

fn cursor_load(links: vec3<u32>, reach: u32) {}

// Returns false if the node first wanted two children and now wants one, at the level of the last pop.
fn cursor_descend(record: Record, descent: u32) -> bool {
    let below = word_half(level);
    if (descent & BOTH) != 0u {
        if word_is_zero(word_and(trail, below)) {
            if SHORT > 0u {
                ring[ring_head] = second_child(record, descent);
                ring_head = select(ring_head + 1u, 0u, ring_head + 1u >= SHORT);
                ring_length = min(ring_length + 1u, SHORT);
            }
            node = first_child(record, descent);
        } else {
            node = second_child(record, descent);
        }
    } else {
        if word_equal(below, pop_level) {
            return false;
        }
        trail = word_or(trail, below);
        node = first_child(record, descent);
    }
    level = below;
    return true;
}

fn cursor_backtrack(links: vec3<u32>, reach: u32) {
    // Clear the bits below the level, which belong to the old path, and add 1 at the level.
    trail = word_add(word_and(trail, word_negate(level)), level);
    pop_level = word_and(trail, word_negate(trail));
    if !word_is_zero(word_and(trail, WORD_TOP)) {
        node = DONE;
    } else if SHORT > 0u && ring_length > 0u {
        ring_length -= 1u;
        ring_head = select(ring_head, SHORT, ring_head == 0u) - 1u;
        node = ring[ring_head];
        level = pop_level;
    } else {
        node = laine_root;
        level = WORD_TOP;
    }
}

fn cursor_prune() {}

fn cursor_is_restarting() -> bool {
    // Level bits are single bits, so their zeros compare them.
    return !word_is_zero(pop_level) && word_zeros(level) > word_zeros(pop_level);
}

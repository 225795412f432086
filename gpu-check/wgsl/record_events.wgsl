// Records events: nine words for each visit, into `work` after the queue, while there is space.

// Visits, and steps. A traversal that restarts has more steps than visits.
var<private> visits: u32;
var<private> steps: u32;

fn record_begin() {
    visits = 0u;
    steps = 0u;
}

fn record_word(at: u32, word: u32) {
    if at < arrayLength(&work) {
        atomicStore(&work[at], word);
    }
}

fn record_visit(address: u32) {
    steps++;
    if cursor_is_restarting() {
        return;
    }
    let at = 1u + 9u * visits;
    visits++;
    let parts = word_parts(cursor_key());
    record_word(at, address);
    record_word(at + 1u, cursor_levels());
    record_word(at + 2u, parts.x);
    record_word(at + 3u, parts.y);
    record_word(at + 4u, parts.z);
    let trail_parts = word_parts(cursor_trail());
    record_word(at + 5u, trail_parts.x);
    record_word(at + 6u, trail_parts.y);
    record_word(at + 7u, trail_parts.z);
    record_word(at + 8u, cursor_register());
}

fn record_end() -> vec2<u32> {
    return vec2(0u, 0u);
}

// Ends traversals that do not terminate.
fn record_is_full() -> bool {
    return steps >= params.z;
}

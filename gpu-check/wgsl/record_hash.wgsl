// Records the hash of the events: five words for each visit, folded into two.

// Visits, and steps. A traversal that restarts has more steps than visits.
var<private> visits: u32;
var<private> steps: u32;
var<private> trace_hash: vec2<u32>;

fn record_begin() {
    visits = 0u;
    steps = 0u;
    trace_hash = vec2(0u, 0u);
}

fn record_word(word: u32) {
    let a = (trace_hash.x ^ word) * 0x9e3779b1u;
    let b = (trace_hash.y + word) * 0x85ebca77u;
    trace_hash = vec2(a ^ (a >> 15u), b ^ (b >> 13u));
}

fn record_visit(address: u32) {
    steps++;
    if cursor_is_restarting() {
        return;
    }
    visits++;
    let parts = word_parts(cursor_key());
    record_word(address);
    record_word(cursor_levels());
    record_word(parts.x);
    record_word(parts.y);
    record_word(parts.z);
}

fn record_end() -> vec2<u32> {
    return trace_hash;
}

// Ends traversals that do not terminate.
fn record_is_full() -> bool {
    return steps >= params.z;
}

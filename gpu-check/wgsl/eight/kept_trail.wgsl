// [WIDE-18]: the trail, eight bits per level, and one bit per level for changes. No shift is by 32.

// The lowest first.
var<private> trail: array<u32, TRAIL_WORDS>;
// Bit i: the end has become less since the search decided about the node i levels up.
var<private> changed: u32;

fn kept_clear() {
    for (var i = 0u; i < TRAIL_WORDS; i++) {
        trail[i] = 0u;
    }
    changed = 0u;
}

// [WIDE-10]
fn kept_push() {
    for (var i = TRAIL_WORDS - 1u; i > 0u; i--) {
        trail[i] = (trail[i] << SET_BITS) | (trail[i - 1u] >> (32u - SET_BITS));
    }
    trail[0] = (trail[0] << SET_BITS) | pending;
    changed <<= 1u;
}

// A word of the trail, 0 above the last.
fn trail_word(at: u32) -> u32 {
    return select(0u, trail[min(at, TRAIL_WORDS - 1u)], at < TRAIL_WORDS);
}

// [WIDE-11]: levels up to the deepest ancestor with pending children; 0 if there is none.
fn kept_pop() -> u32 {
    var words = 0u;
    loop {
        if words == TRAIL_WORDS || trail_word(words) != 0u {
            break;
        }
        words += 1u;
    }
    let low = trail_word(words);
    if low == 0u {
        return 0u;
    }
    let skipped = firstTrailingBit(low) / SET_BITS;
    let bits = SET_BITS * skipped;
    pending = (low >> bits) & 0xffu;
    next_ranks = vec2(0u, 0u);
    for (var i = 0u; i < TRAIL_WORDS; i++) {
        let above = trail_word(i + words + 1u) << (32u - SET_BITS - bits);
        trail[i] = ((trail_word(i + words) >> bits) >> SET_BITS) | above;
    }
    let up = 32u / SET_BITS * words + skipped + 1u;
    changed = (changed >> (up - 1u)) >> 1u;
    return up;
}

fn kept_shortened() {
    changed = NONE;
}

fn kept_asked() {
    changed &= ~1u;
}

fn kept_is_stale() -> bool {
    return (changed & 1u) == 1u;
}

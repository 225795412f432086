// [WIDE-17]: for each level, the pending set, the ranks of the next two children, and a bit for a nonempty set. The
// number of levels is a power of two up to 32, as small as the tree allows: each level costs time, because private
// memory is initialised to zero.

var<private> level: u32;
var<private> summary: u32;
// Four levels in a word.
var<private> kept_sets: array<u32, LEVELS / 4u>;
var<private> kept_ranks: array<vec2<u32>, LEVELS>;

fn kept_clear() {
    level = 0u;
    summary = 0u;
}

fn kept_push() {
    let at = level & (LEVELS - 1u);
    let bits = SET_BITS * (at & 3u);
    kept_sets[at >> 2u] = (kept_sets[at >> 2u] & ~(0xffu << bits)) | (pending << bits);
    kept_ranks[at] = next_ranks;
    summary |= select(0u, 1u, pending != 0u) << at;
    level += 1u;
}

// Levels up to the deepest level with pending children that may be before the end; 0 if there is none.
fn kept_pop() -> u32 {
    var up = 0u;
    loop {
        if summary == 0u {
            break;
        }
        let at = firstLeadingBit(summary);
        summary ^= 1u << at;
        // The kept rank is the least.
        if !is_beyond(kept_ranks[at].x) {
            up = level - at;
            level = at;
            break;
        }
    }
    if up != 0u {
        pending = (kept_sets[level >> 2u] >> (SET_BITS * (level & 3u))) & 0xffu;
        next_ranks = kept_ranks[level];
    }
    return up;
}

fn kept_shortened() {}

fn kept_asked() {}

// The third child is queried again, unless it is known to be the last.
fn kept_is_stale() -> bool {
    return true;
}

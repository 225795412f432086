// Keys and trails of two words, the low word first: depth 63. No shift is by 32.

alias Word = vec2<u32>;

const WORD_ZERO = vec2(0u, 0u);
const WORD_ONE = vec2(1u, 0u);
const WORD_TOP = vec2(0u, 0x80000000u);

// [KEY-2], [TRAIL-2]
fn word_child(word: Word, bit: u32) -> Word {
    return vec2((word.x << 1u) | bit, (word.y << 1u) | (word.x >> 31u));
}

fn word_is_zero(word: Word) -> bool {
    return (word.x | word.y) == 0u;
}

// For a nonzero word.
fn word_zeros(word: Word) -> u32 {
    return select(32u + firstTrailingBit(word.y), firstTrailingBit(word.x), word.x != 0u);
}

// Shifts by less than the width.
fn word_shift(word: Word, levels: u32) -> Word {
    let moved = select(word, vec2(word.y, 0u), levels >= 32u);
    let bits = levels & 31u;
    return vec2((moved.x >> bits) | ((moved.y << 1u) << (31u - bits)), moved.y >> bits);
}

fn word_toggle(word: Word) -> Word {
    return vec2(word.x ^ 1u, word.y);
}

fn word_without(word: Word, mask: Word) -> Word {
    return word & ~mask;
}

fn word_and(a: Word, b: Word) -> Word {
    return a & b;
}

fn word_or(a: Word, b: Word) -> Word {
    return a | b;
}

fn word_add(a: Word, b: Word) -> Word {
    let low = a.x + b.x;
    return vec2(low, a.y + b.y + select(0u, 1u, low < a.x));
}

fn word_negate(word: Word) -> Word {
    return vec2(0u - word.x, ~word.y + select(0u, 1u, word.x == 0u));
}

fn word_half(word: Word) -> Word {
    return vec2((word.x >> 1u) | (word.y << 31u), word.y >> 1u);
}

fn word_equal(a: Word, b: Word) -> bool {
    return all(a == b);
}

fn word_low(word: Word) -> u32 {
    return word.x;
}

fn word_parts(word: Word) -> vec3<u32> {
    return vec3(word, 0u);
}

fn word_of(parts: vec3<u32>) -> Word {
    return parts.xy;
}

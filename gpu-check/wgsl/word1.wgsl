// Keys and trails of one word: depth 31. No shift is by 32.

alias Word = u32;

const WORD_ZERO = 0u;
const WORD_ONE = 1u;
const WORD_TOP = 0x80000000u;

// [KEY-2], [TRAIL-2]
fn word_child(word: Word, bit: u32) -> Word {
    return (word << 1u) | bit;
}

fn word_is_zero(word: Word) -> bool {
    return word == 0u;
}

// For a nonzero word.
fn word_zeros(word: Word) -> u32 {
    return firstTrailingBit(word);
}

// Shifts by less than the width.
fn word_shift(word: Word, levels: u32) -> Word {
    return word >> levels;
}

fn word_toggle(word: Word) -> Word {
    return word ^ 1u;
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
    return a + b;
}

fn word_negate(word: Word) -> Word {
    return 0u - word;
}

fn word_half(word: Word) -> Word {
    return word >> 1u;
}

fn word_equal(a: Word, b: Word) -> bool {
    return a == b;
}

fn word_low(word: Word) -> u32 {
    return word;
}

fn word_parts(word: Word) -> vec3<u32> {
    return vec3(word, 0u, 0u);
}

fn word_of(parts: vec3<u32>) -> Word {
    return parts.x;
}

// Keys and trails of three words, the low word first: depth 95. No shift is by 32.

alias Word = vec3<u32>;

const WORD_ZERO = vec3(0u, 0u, 0u);
const WORD_ONE = vec3(1u, 0u, 0u);
const WORD_TOP = vec3(0u, 0u, 0x80000000u);

// [KEY-2], [TRAIL-2]
fn word_child(word: Word, bit: u32) -> Word {
    return (word << vec3(1u)) | vec3(bit, word.x >> 31u, word.y >> 31u);
}

fn word_is_zero(word: Word) -> bool {
    return (word.x | word.y | word.z) == 0u;
}

// For a nonzero word.
fn word_zeros(word: Word) -> u32 {
    let upper = select(64u + firstTrailingBit(word.z), 32u + firstTrailingBit(word.y), word.y != 0u);
    return select(upper, firstTrailingBit(word.x), word.x != 0u);
}

// Shifts by less than the width.
fn word_shift(word: Word, levels: u32) -> Word {
    var moved = select(word, vec3(word.yz, 0u), levels >= 32u);
    moved = select(moved, vec3(moved.yz, 0u), levels >= 64u);
    let bits = levels & 31u;
    let above = (vec3(moved.yz, 0u) << vec3(1u)) << vec3(31u - bits);
    return (moved >> vec3(bits)) | above;
}

fn word_toggle(word: Word) -> Word {
    return vec3(word.x ^ 1u, word.yz);
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
    let x = a.x + b.x;
    let y = a.y + b.y;
    let carry = select(0u, 1u, x < a.x);
    let next = select(0u, 1u, y < a.y) | select(0u, carry, y == NONE);
    return vec3(x, y + carry, a.z + b.z + next);
}

fn word_negate(word: Word) -> Word {
    return word_add(~word, WORD_ONE);
}

fn word_half(word: Word) -> Word {
    return (word >> vec3(1u)) | vec3(word.y << 31u, word.z << 31u, 0u);
}

fn word_equal(a: Word, b: Word) -> bool {
    return all(a == b);
}

fn word_low(word: Word) -> u32 {
    return word.x;
}

fn word_parts(word: Word) -> vec3<u32> {
    return word;
}

fn word_of(parts: vec3<u32>) -> Word {
    return parts;
}

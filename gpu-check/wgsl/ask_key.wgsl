// A question of the level `key` of the conformance suite, answered by the word functions of traversals.

// Operation, number, low and high half of two words.
@group(0) @binding(0) var<storage, read> asks: array<vec4<u32>>;
// A number, an unused word, halves of two words.
@group(0) @binding(1) var<storage, read_write> answers: array<vec4<u32>>;

const NOTHING = 0xffffffffu;

// [KEY-5]
fn depth_of(key: Word) -> u32 {
    var rest = word_half(key);
    var depth = 0u;
    while !word_is_zero(rest) {
        rest = word_half(rest);
        depth++;
    }
    return depth;
}

// [KEY-6]
fn first_of_level(depth: u32) -> Word {
    var key = WORD_ONE;
    for (var i = 0u; i < depth; i++) {
        key = word_child(key, 0u);
    }
    return key;
}

fn different(a: Word, b: Word) -> Word {
    return word_or(word_without(a, b), word_without(b, a));
}

// [TRAIL-6]: the complement below the depth.
fn complement(word: Word, depth: u32) -> Word {
    return different(word, word_add(first_of_level(depth), word_negate(WORD_ONE)));
}

// [TRAIL-3]
fn levels_of(trail: Word) -> u32 {
    if word_is_zero(trail) {
        return NOTHING;
    }
    return word_zeros(trail);
}

@compute @workgroup_size(1)
fn main() {
    let first = asks[0];
    let extra = first.y;
    let a = word_of(vec3(first.zw, 0u));
    let b = word_of(vec3(asks[1].xy, 0u));
    var said = 0u;
    var one = WORD_ZERO;
    var two = WORD_ZERO;
    switch first.x {
        case 0u: {
            one = word_child(a, extra);
        }
        case 1u: {
            one = word_half(a);
        }
        case 2u: {
            one = word_toggle(a);
        }
        case 3u: {
            one = first_of_level(depth_of(a));
        }
        case 4u: {
            said = depth_of(a);
        }
        case 5u: {
            said = levels_of(a);
        }
        case 6u: {
            said = levels_of(b);
            one = word_toggle(word_shift(a, said));
            two = word_toggle(word_shift(b, said));
        }
        case 7u: {
            one = complement(a, extra);
        }
        case 8u: {
            said = levels_of(complement(a, extra));
        }
        // [SWAP-3]
        default: {
            one = different(a, b);
        }
    }
    let first_parts = word_parts(one);
    answers[0] = vec4(said, 0u, first_parts.xy);
    answers[1] = vec4(word_parts(two).xy, 0u, 0u);
}

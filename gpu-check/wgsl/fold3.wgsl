// A key of more than 64 bits is divided into pieces of 63 bits from the root down, and folded [HASH-6].

fn word_folded(key: Word) -> vec2<u32> {
    if key.z == 0u {
        return key.xy;
    }
    // At least 65 bits: one whole piece, and the rest.
    let length = 65u + firstLeadingBit(key.z);
    let rest_bits = length - 63u;
    let first = word_shift(key, rest_bits).xy;
    // 2 to 33 bits; the highest may be in the second word.
    let mask = vec2(select((1u << (rest_bits & 31u)) - 1u, NONE, rest_bits >= 32u), select(0u, 1u, rest_bits == 33u));
    let rest = key.xy & mask;
    var folded = wide_mix(FOLD_SEED ^ first);
    folded = wide_mix(folded ^ rest);
    return wide_mix(folded ^ vec2(length, 0u));
}

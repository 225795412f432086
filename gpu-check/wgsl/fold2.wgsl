// A key of up to 64 bits is hashed without folding [HASH-6].

fn word_folded(key: Word) -> vec2<u32> {
    return key;
}

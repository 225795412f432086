// The perfect hash of keys of more than one word [HASH-1]. Only the remainder needs numbers of 64 bits.

fn table_node(key: Word) -> u32 {
    let mixed = table_mixed(key);
    let displacement = displacements[DISPLACEMENTS_AT + (mixed.x & DIRECT_MASK)];
    if is_direct(displacement) {
        return direct_address(displacement);
    }
    return cells[CELLS_AT + wrap(remainder(mixed) + displacement)];
}

// The key in 64 bits, or in 32 bits if all keys of the tree fit, after the bijection.
fn table_mixed(key: Word) -> vec2<u32> {
    let folded = word_folded(key);
    if IS_NARROW {
        return vec2(select(folded.x, mix_narrow(folded.x ^ SEED.x), IS_SEEDED), 0u);
    }
    if IS_SEEDED {
        return wide_mix(folded ^ SEED);
    }
    return folded;
}

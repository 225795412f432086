// The perfect hash of keys of one word [HASH-1].

fn table_node(key: Word) -> u32 {
    var mixed = key;
    if IS_SEEDED {
        mixed = mix_narrow(key ^ SEED.x);
    }
    let displacement = displacements[DISPLACEMENTS_AT + (mixed & DIRECT_MASK)];
    if is_direct(displacement) {
        return direct_address(displacement);
    }
    return cells[CELLS_AT + wrap(mixed % TABLE_SIZE + displacement)];
}

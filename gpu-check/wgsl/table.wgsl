// The common part of lookups, for all key words.

// The bijection of 32 bits (Wellons 2018) [HASH-7].
fn mix_narrow(word: u32) -> u32 {
    var x = word;
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    return x ^ (x >> 16u);
}

// [HASH-5]: whether an entry is an address.
fn is_direct(entry: u32) -> bool {
    return (entry >> 31u) == 1u;
}

// Bit 30 is the sign bit.
fn direct_address(entry: u32) -> u32 {
    return bitcast<u32>(bitcast<i32>(entry << 1u) >> 1u);
}

// A sum below twice the number of cells, modulo the number of cells.
fn wrap(sum: u32) -> u32 {
    return min(sum, sum - TABLE_SIZE);
}

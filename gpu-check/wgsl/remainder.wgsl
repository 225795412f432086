// Barrett's reduction by floor((2^64 - 1) / H): the quotient is right, or one too small.
fn remainder(key: vec2<u32>) -> u32 {
    return wrap(key.x - wide_multiply_high(key, RECIPROCAL) * TABLE_SIZE);
}

// Numbers of 64 bits as two words, the low one first, and the finaliser of SplitMix64 (Steele, Lea & Flood 2014).

fn wide_add(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2(low, a.y + b.y + select(0u, 1u, low < a.x));
}

// All 64 bits of the product of two words.
fn wide_product(a: u32, b: u32) -> vec2<u32> {
    let al = a & 0xffffu;
    let ah = a >> 16u;
    let bl = b & 0xffffu;
    let bh = b >> 16u;
    let low = al * bl;
    let middle = ah * bl + (low >> 16u);
    let other = al * bh + (middle & 0xffffu);
    return vec2((other << 16u) | (low & 0xffffu), ah * bh + (middle >> 16u) + (other >> 16u));
}

// Modulo 2^64.
fn wide_multiply(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = wide_product(a.x, b.x);
    return vec2(low.x, low.y + a.x * b.y + a.y * b.x);
}

// Bits 64 to 95 of the product.
fn wide_multiply_high(a: vec2<u32>, b: vec2<u32>) -> u32 {
    let low = wide_product(a.x, b.x);
    let first = wide_add(wide_product(a.x, b.y), vec2(low.y, 0u));
    let second = wide_add(wide_product(a.y, b.x), vec2(first.x, 0u));
    return wide_add(wide_product(a.y, b.y), wide_add(vec2(first.y, 0u), vec2(second.y, 0u))).x;
}

// Shifts by 1 to 31 bits.
fn wide_shift(a: vec2<u32>, bits: u32) -> vec2<u32> {
    return vec2((a.x >> bits) | (a.y << (32u - bits)), a.y >> bits);
}

fn wide_mix(word: vec2<u32>) -> vec2<u32> {
    var x = word ^ wide_shift(word, 30u);
    x = wide_multiply(x, vec2(0x1ce4e5b9u, 0xbf58476du));
    x ^= wide_shift(x, 27u);
    x = wide_multiply(x, vec2(0x133111ebu, 0x94d049bbu));
    return x ^ wide_shift(x, 31u);
}

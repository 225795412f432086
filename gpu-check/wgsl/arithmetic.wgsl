// Arithmetic that is the same on every device whose multiply-add is one or two roundings, whatever the compiler
// contracts: each product that meets a sum does so in an explicit `fma`, so nothing is left to contract. `min` and
// `max` are selects, which have one answer for zeros of either sign.

fn lesser(a: f32, b: f32) -> f32 {
    return select(b, a, a < b);
}

fn greater(a: f32, b: f32) -> f32 {
    return select(b, a, a > b);
}

fn product3(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

fn cross3(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return vec3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x)));
}

// The quotient, and +0 for 0. With REFINES, for devices that divide with an error: one step with the exact remainder,
// which a fused multiply-add gives.
fn divide(a: f32, b: f32) -> f32 {
    var quotient = a / b;
    if REFINES {
        let r = 1.0 / b;
        let q = a * r;
        quotient = fma(fma(-q, b, a), r, q);
    }
    return select(quotient, 0.0, quotient == 0.0);
}

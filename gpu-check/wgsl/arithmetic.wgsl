// Arithmetic with equal results on every device, for each kind of `fma` (one or two roundings) and every compiler. Each
// product that is added to a sum is an explicit `fma`, so nothing is left to contract. `min` and `max` are selects,
// with one result for zeros of either sign.

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

// The quotient, and +0 for 0. REFINES is for devices that divide with an error: one step with the exact remainder,
// computed by a fused multiply-add.
fn divide(a: f32, b: f32) -> f32 {
    var quotient = a / b;
    if REFINES {
        let r = 1.0 / b;
        let q = a * r;
        quotient = fma(fma(-q, b, a), r, q);
    }
    return select(quotient, 0.0, quotient == 0.0);
}

// Probes the device's arithmetic: fused multiply-add, rounded divisions, subnormal numbers.

@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> outputs: array<vec4<u32>>;
@group(0) @binding(2) var<uniform> params: vec4<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x + id.y * params.y;
    if i >= params.x {
        return;
    }
    let a = inputs[i].x;
    let b = inputs[i].y;
    let c = inputs[i].z;
    let r = 1.0 / b;
    let q = a * r;
    let refined = fma(fma(-q, b, a), r, q);
    outputs[2u * i] = bitcast<vec4<u32>>(vec4(fma(a, b, c), a * b + c, a / b, refined));
    outputs[2u * i + 1u] = bitcast<vec4<u32>>(vec4(a - c, a * b, min(a, c), select(c, a, a < c)));
}

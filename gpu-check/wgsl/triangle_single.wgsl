// The test of Möller & Trumbore 1997 in single precision.

fn begin_triangles() {}

fn test_triangle(at: u32) {
    let corner = leaves[at];
    let v0 = bitcast<vec3<f32>>(corner.xyz);
    let e1 = bitcast<vec3<f32>>(leaves[at + 1u].xyz) - v0;
    let e2 = bitcast<vec3<f32>>(leaves[at + 2u].xyz) - v0;
    let s = origin - v0;
    let p = cross3(direction, e2);
    let q = cross3(s, e1);
    let det = product3(e1, p);
    let sign = select(1.0, -1.0, det < 0.0);
    let size = det * sign;
    let u = product3(s, p) * sign;
    let v = product3(direction, q) * sign;
    let w = (size - u) - v;
    if size > 0.0 && u >= 0.0 && v >= 0.0 && w >= 0.0 {
        let t = divide(product3(e2, q), det);
        if t >= tmin && (t < best_t || (t == best_t && corner.w <= best_triangle)) {
            best_t = t;
            best_triangle = corner.w;
            best_weights = vec2(divide(u, size), divide(v, size));
            found_here = true;
            stopped = ANY_HIT;
        }
    }
}

fn finish(task: u32) {
    results[task] = vec4(best_triangle, bitcast<u32>(best_t), bitcast<vec2<u32>>(best_weights));
}

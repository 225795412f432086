// A triangle test that reports certain results, by the error bounds of [BAND-2], [BAND-3] and [BAND-4]. An uncertain
// result ends the search, and the CPU settles the ray.
//
// U is 2^-24. FLOOR is a minimum size, so that underflow does not matter. It depends on the device.

const U = 5.9604644775390625e-8;
const UNCERTAIN = 0xfffffffeu;

// Bounds of the best hit's distance; `best_t` is the upper one.
var<private> best_low: f32;
var<private> is_uncertain: bool;

fn begin_triangles() {
    best_low = END;
    is_uncertain = false;
}

fn largest(v: vec3<f32>) -> f32 {
    let a = abs(v);
    return greater(a.z, greater(a.y, a.x));
}

// With ANY_HIT, an uncertain triangle does not matter if another triangle is certainly hit.
fn doubt() {
    is_uncertain = true;
    stopped = stopped || !ANY_HIT;
}

fn test_triangle(at: u32) {
    let corner = leaves[at];
    let v0 = bitcast<vec3<f32>>(corner.xyz);
    let e1 = bitcast<vec3<f32>>(leaves[at + 1u].xyz) - v0;
    let e2 = bitcast<vec3<f32>>(leaves[at + 2u].xyz) - v0;
    let s = origin - v0;
    let p = cross3(direction, e2);
    let q = cross3(s, e1);
    let det = product3(e1, p);
    let u = product3(s, p);
    let v = product3(direction, q);
    let w = (det - u) - v;

    let reach = greater(largest(s), FLOOR);
    let edge = greater(FLOOR, greater(largest(e1), largest(e2)));
    let size = largest(direction);
    let delta = (((EDGE_FACTOR * U) * size) * edge) * (2.0 * reach + edge);
    let least = lesser(u, lesser(v, w));
    let most = greater(u, greater(v, w));
    if least < -delta && most > delta {
        return;
    }
    if !(least > delta || most < -delta) {
        doubt();
        return;
    }
    // The line meets the interior. The next step bounds the distance of the hit.
    let sign = select(1.0, -1.0, det < 0.0);
    let t_off = (((36.0 * U) * reach) * edge) * edge;
    let det_off = (((32.0 * U) * size) * edge) * edge;
    let above = product3(e2, q) * sign;
    let below = det * sign;
    if !(below > 2.0 * det_off) {
        doubt();
        return;
    }
    // The divisor is the end of the determinant on the safe side. The error of a quotient is below 16 U of the
    // quotient.
    let low = above - t_off;
    let high = above + t_off;
    let first = low / select(below + det_off, below - det_off, low < 0.0);
    let last = high / select(below - det_off, below + det_off, high < 0.0);
    let t_low = (first - (16.0 * U) * abs(first)) - FLOOR;
    let t_high = (last + (16.0 * U) * abs(last)) + FLOOR;
    let t_least = select(t_low, 0.0, low >= 0.0 && t_low < 0.0);
    if t_high < tmin || t_least > best_t {
        return;
    }
    if !(t_least >= tmin && t_high <= ray_end) {
        doubt();
        return;
    }
    if ANY_HIT {
        best_triangle = corner.w;
        stopped = true;
    } else if best_triangle == NONE || t_high < best_low {
        best_triangle = corner.w;
        best_low = t_least;
        best_t = lesser(t_high, best_t);
    } else if best_triangle != corner.w {
        doubt();
    }
    found_here = best_triangle == corner.w;
}

fn finish(task: u32) {
    let is_open = is_uncertain && !(ANY_HIT && best_triangle != NONE);
    results[task] = vec4(select(best_triangle, UNCERTAIN, is_open), 0u, 0u, 0u);
    if is_open {
        atomicStore(&work[1u + atomicAdd(&work[0], 1u)], task);
    }
}

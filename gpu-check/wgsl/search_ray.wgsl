// The search of a ray through nodes of two children. Records hold lo and hi of x and y of the left box, then of the
// right box, then of z of each box.

// Distances at which the ray enters and leaves a box, within its interval.
fn slab(lo: vec3<f32>, hi: vec3<f32>) -> vec2<f32> {
    let near_planes = (select(lo, hi, backward) - origin) * inverse_near;
    var far_planes = (select(hi, lo, backward) - origin) * inverse_far;
    if HAS_PARALLEL {
        far_planes = select(far_planes, vec3(END), parallel & (far_planes >= vec3(0.0)));
    }
    let near = greater(near_planes.z, greater(near_planes.y, greater(near_planes.x, tmin)));
    let far = lesser(far_planes.z, lesser(far_planes.y, lesser(far_planes.x, best_t)));
    return vec2(near, far);
}

// Begin of the left and of the right box of the last record.
var<private> nears: vec2<f32>;

fn decide(record: Record) -> u32 {
    let left = bitcast<vec4<f32>>(record.left);
    let right = bitcast<vec4<f32>>(record.right);
    let both = bitcast<vec4<f32>>(record.both);
    let first = slab(vec3(left.xz, both.x), vec3(left.yw, both.y));
    let second = slab(vec3(right.xz, both.z), vec3(right.yw, both.w));
    nears = vec2(first.x, second.x);
    let right_first = !ANY_HIT && second.x < first.x;
    let descent = descent_of(first.x <= first.y, second.x <= second.y, right_first);
    let apart = select(first.y < second.x, second.y < first.x, right_first);
    return descent | select(0u, DISJOINT, apart);
}

// The distance at which the second child of a descent begins.
fn begins(record: Record, descent: u32) -> u32 {
    return bitcast<u32>(select(nears.y, nears.x, (descent & RIGHT) != 0u));
}

// The search of a ray: boxes and triangles in single precision.
//
// A ray is 12 words: origin and tmin, direction and tmax, reciprocals of the direction, clamped, and nothing. Records
// hold lo and hi of x and y of the left box, of the right one, and of z of both. Triangles are three corners, with the
// index in the word after the first; leaves end with a terminator.

const END = 1e38;

var<private> origin: vec3<f32>;
var<private> direction: vec3<f32>;
var<private> tmin: f32;
var<private> ray_end: f32;
// Reciprocals moved down for near planes and up for far ones [BOX-1], and the planes that are near.
var<private> inverse_near: vec3<f32>;
var<private> inverse_far: vec3<f32>;
var<private> backward: vec3<bool>;
// Components along which the ray does not move: they bound nothing that holds the origin.
var<private> parallel: vec3<bool>;

// The closest hit so far, its triangle and weights.
var<private> best_t: f32;
var<private> best_triangle: u32;
var<private> best_weights: vec2<f32>;
var<private> stopped: bool;
var<private> found_here: bool;

fn begin(task: u32) {
    begin_scene();
    let first = bitcast<vec4<f32>>(tasks[3u * task]);
    let second = bitcast<vec4<f32>>(tasks[3u * task + 1u]);
    let inverse = tasks[3u * task + 2u].xyz;
    origin = first.xyz;
    tmin = first.w;
    direction = second.xyz;
    ray_end = second.w;
    best_t = ray_end;
    best_triangle = NONE;
    best_weights = vec2(0.0);
    // Two floats towards zero and two away from it.
    inverse_near = bitcast<vec3<f32>>(inverse - vec3(2u));
    inverse_far = bitcast<vec3<f32>>(inverse + vec3(2u));
    backward = (inverse >> vec3(31u)) == vec3(1u);
    parallel = (inverse & vec3(0x7fffffffu)) == vec3(CLAMPED_RECIPROCAL);
    stopped = false;
    found_here = false;
    begin_triangles();
}

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

// Begin of the left and of the right box, as of the last record that was decided on.
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

// Where the second child of a descent begins; the bits of positive floats are in their order.
fn begins(record: Record, descent: u32) -> u32 {
    return bitcast<u32>(select(nears.y, nears.x, (descent & RIGHT) != 0u));
}

fn end() -> u32 {
    return bitcast<u32>(best_t);
}

// Tests the triangles of the leaf at an offset, and gives its links.
fn look_into(offset: u32) -> vec3<u32> {
    var at = offset;
    found_here = false;
    loop {
        if leaves[at].x == TERMINATOR || stopped {
            break;
        }
        test_triangle(at);
        at += 3u;
    }
    return leaves[at].yzw;
}

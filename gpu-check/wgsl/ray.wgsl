// A ray, its best hit so far, and the tests of leaves, in single precision. Each search tests its own boxes.
//
// A ray is 12 words: origin and tmin, direction and tmax, clamped reciprocals of the direction, and an unused word. A
// triangle is three corners, with the index in the word after the first corner. A terminator ends a leaf.

const END = 1e38;

var<private> origin: vec3<f32>;
var<private> direction: vec3<f32>;
var<private> tmin: f32;
var<private> ray_end: f32;
// Reciprocals moved down for near planes and up for far planes [BOX-1], and the selection of near planes.
var<private> inverse_near: vec3<f32>;
var<private> inverse_far: vec3<f32>;
var<private> backward: vec3<bool>;
// Components along which the ray does not move: their planes do not bound a ray with its origin between them.
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
    // Two floats towards zero, and two away from zero.
    inverse_near = bitcast<vec3<f32>>(inverse - vec3(2u));
    inverse_far = bitcast<vec3<f32>>(inverse + vec3(2u));
    backward = (inverse >> vec3(31u)) == vec3(1u);
    parallel = (inverse & vec3(0x7fffffffu)) == vec3(CLAMPED_RECIPROCAL);
    stopped = false;
    found_here = false;
    begin_triangles();
}

// The current end of the search. Bits of nonnegative floats have the order of the floats.
fn end() -> u32 {
    return bitcast<u32>(best_t);
}

// Tests the triangles of the leaf at an offset, and returns its links.
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

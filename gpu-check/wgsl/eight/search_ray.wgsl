// The search of a ray through nodes of up to eight children.
//
// The first of a record's four pieces for the search has the least corner of all boxes, an exponent for each axis, and
// the set of children. Four words for each axis follow: lower planes of slots 0 to 3, of 4 to 7, upper planes of 0 to
// 3, of 4 to 7. A plane is a byte: the number of steps from the corner, rounded outwards.

// Any-hit searches need no order [WIDE-6].
const is_sorted = !ANY_HIT;

struct Grid {
    corner: vec3<f32>,
    step: vec3<f32>,
}

// The planes of four boxes along an axis, as distances. A byte times a power of two is exact, so a plane is rounded
// once with every kind of `fma`.
fn planes_of(word: u32, corner: f32, step: f32, from_where: f32, inverse: f32) -> vec4<f32> {
    let bytes = vec4<f32>((vec4(word) >> vec4(0u, 8u, 16u, 24u)) & vec4(0xffu));
    return (fma(bytes, vec4(step), vec4(corner)) - vec4(from_where)) * vec4(inverse);
}

// Distances at which the ray enters four boxes, by the bytes of their near planes.
fn enters(grid: Grid, near: vec3<u32>) -> vec4<f32> {
    let x = planes_of(near.x, grid.corner.x, grid.step.x, origin.x, inverse_near.x);
    let y = planes_of(near.y, grid.corner.y, grid.step.y, origin.y, inverse_near.y);
    let z = planes_of(near.z, grid.corner.z, grid.step.z, origin.z, inverse_near.z);
    var entered = vec4(tmin);
    entered = select(entered, x, x > entered);
    entered = select(entered, y, y > entered);
    return select(entered, z, z > entered);
}

// Distances at which the ray leaves four boxes, or ends.
fn exits(grid: Grid, far: vec3<u32>) -> vec4<f32> {
    var x = planes_of(far.x, grid.corner.x, grid.step.x, origin.x, inverse_far.x);
    var y = planes_of(far.y, grid.corner.y, grid.step.y, origin.y, inverse_far.y);
    var z = planes_of(far.z, grid.corner.z, grid.step.z, origin.z, inverse_far.z);
    if HAS_PARALLEL {
        x = select(x, vec4(END), vec4(parallel.x) & (x >= vec4(0.0)));
        y = select(y, vec4(END), vec4(parallel.y) & (y >= vec4(0.0)));
        z = select(z, vec4(END), vec4(parallel.z) & (z >= vec4(0.0)));
    }
    var left = vec4(best_t);
    left = select(left, x, x < left);
    left = select(left, y, y < left);
    return select(left, z, z < left);
}

// The words of an axis, with near planes first.
fn near_first(words: vec4<u32>, is_backward: bool) -> vec4<u32> {
    return select(words, words.zwxy, is_backward);
}

// Returns the set of wanted children, and leaves their ranks in `low_ranks` and `high_ranks` [WIDE-2]. A repeated query
// returns the wanted children that are not yet beyond the end [WIDE-4].
fn ask(address: u32, is_again: bool) -> u32 {
    let first = nodes[address + 4u];
    let exponents = (vec3(first.w) >> vec3(0u, 8u, 16u)) & vec3(0xffu);
    let grid = Grid(bitcast<vec3<f32>>(first.xyz), bitcast<vec3<f32>>(exponents << vec3(23u)));
    let x = near_first(nodes[address + 5u], backward.x);
    let y = near_first(nodes[address + 6u], backward.y);
    let z = near_first(nodes[address + 7u], backward.z);
    let low = enters(grid, vec3(x.x, y.x, z.x));
    let high = enters(grid, vec3(x.y, y.y, z.y));
    let is_low = low <= exits(grid, vec3(x.z, y.z, z.z));
    let is_high = high <= exits(grid, vec3(x.w, y.w, z.w));
    low_ranks = (bitcast<vec4<u32>>(low) & vec4(~SLOT_MASK)) | vec4(0u, 1u, 2u, 3u);
    high_ranks = (bitcast<vec4<u32>>(high) & vec4(~SLOT_MASK)) | vec4(4u, 5u, 6u, 7u);
    return set_of(is_low, is_high) & (first.w >> 24u);
}

// The parameters of a tree that is not compiled in: four pieces of `tasks`.

var<private> root: u32;
var<private> DIRECT_MASK: u32;
var<private> DISPLACEMENTS_AT: u32;
var<private> TABLE_SIZE: u32;
var<private> CELLS_AT: u32;
var<private> RECIPROCAL: vec2<u32>;
var<private> IS_SEEDED: bool;
var<private> IS_NARROW: bool;
var<private> SEED: vec2<u32>;
var<private> FOLD_SEED: vec2<u32>;

// The second word of the first piece belongs to the search.
fn read_head(at: u32) {
    let first = tasks[at];
    let second = tasks[at + 1u];
    let third = tasks[at + 2u];
    root = first.x;
    DIRECT_MASK = first.z;
    DISPLACEMENTS_AT = first.w;
    TABLE_SIZE = second.x;
    CELLS_AT = second.y;
    RECIPROCAL = second.zw;
    IS_SEEDED = third.x == 1u;
    IS_NARROW = third.y == 1u;
    SEED = third.zw;
    FOLD_SEED = tasks[at + 3u].xy;
}

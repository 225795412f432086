// [WIDE-15] (1): one level at a time.

fn link_ancestor(start: u32, up: u32) -> u32 {
    var at = start;
    for (var i = 0u; i < up; i++) {
        at = ancestor_of(at, 1u);
    }
    return at;
}

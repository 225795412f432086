// [WIDE-15] (1): one level at a time, at most up to the root.

fn link_ancestor(start: u32, up: u32) -> u32 {
    var at = start;
    for (var i = 0u; i < up; i++) {
        let above = ancestor_of(at, 1u);
        if above == at {
            break;
        }
        at = above;
    }
    return at;
}

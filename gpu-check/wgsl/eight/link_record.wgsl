// [WIDE-15] (2): by the ancestors in the record. The root's ancestors are the root, so a climb ends for any number of
// levels.

fn link_ancestor(start: u32, levels: u32) -> u32 {
    var at = start;
    var up = levels;
    loop {
        if up <= SLOTS {
            break;
        }
        let above = ancestor_of(at, SLOTS);
        if above == at {
            break;
        }
        at = above;
        up -= SLOTS;
    }
    return ancestor_of(at, min(up, SLOTS));
}

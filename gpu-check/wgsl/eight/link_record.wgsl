// [WIDE-15] (2): by the ancestors that the record names.

fn link_ancestor(start: u32, levels: u32) -> u32 {
    var at = start;
    var up = levels;
    loop {
        if up <= SLOTS {
            break;
        }
        at = ancestor_of(at, SLOTS);
        up -= SLOTS;
    }
    return ancestor_of(at, up);
}

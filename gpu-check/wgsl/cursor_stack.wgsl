// [STACK-1]. With KEEPS_DISTANCES the stack also has the distance at which each postponed node begins. Popped nodes
// that begin beyond the end of the search are dropped [ORACLE-3].

const ENTRY = select(1u, 2u, KEEPS_DISTANCES);

var<private> height: u32;

fn cursor_start(root: u32) {
    node = root;
    height = 0u;
}

fn cursor_load(links: vec3<u32>, reach: u32) {}

fn cursor_descend(record: Record, descent: u32) -> bool {
    node = first_child(record, descent);
    if (descent & BOTH) != 0u {
        store(height, second_child(record, descent));
        if KEEPS_DISTANCES {
            store(height + 1u, begins(record, descent));
        }
        height += ENTRY;
    }
    return true;
}

fn cursor_backtrack(links: vec3<u32>, reach: u32) {
    if KEEPS_DISTANCES {
        loop {
            if height == 0u || load(height - 1u) <= end() {
                break;
            }
            height -= ENTRY;
        }
    }
    if height == 0u {
        node = DONE;
    } else {
        height -= ENTRY;
        node = load(height);
    }
}

fn cursor_prune() {}

fn cursor_is_restarting() -> bool {
    return false;
}

// One step of any traversal: the visit of an inner node, and of a leaf. All drivers use these functions.

// Bits of the trail whose nodes are named in the record of an inner node.
const INNER_REACH = 6u;

fn visit_inner() {
    let record = fetch(node);
    let links = vec3(record.links, 0u);
    record_visit(node);
    cursor_load(links, INNER_REACH);
    let descent = decide(record);
    if (descent & ANY) == 0u || !cursor_descend(record, descent) {
        cursor_backtrack(links, INNER_REACH);
    }
    if record_is_full() {
        node = DONE;
    }
}

fn visit_leaf() {
    record_visit(node);
    let links = look_into(~node);
    if stopped {
        node = DONE;
    } else {
        if PRUNES && found_here {
            cursor_prune();
        }
        cursor_load(links, LEAF_REACH);
        cursor_backtrack(links, LEAF_REACH);
    }
    if record_is_full() {
        node = DONE;
    }
}

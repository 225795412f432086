// One step of any traversal of nodes with eight slots [WIDE-7]: the visit of an inner node, and of a leaf.

// The inner node whose children are visited.
var<private> present: u32;
// One more than the levels of the last backtrack, 0 after a descent.
var<private> levels_back: u32;

fn visit(address: u32) {
    record_visit(address);
    // A step from a leaf to the next child of its parent is a backtrack of no levels.
    levels_back = select(0u, 1u, is_leaf(address));
}

fn visit_inner() {
    visit(node);
    present = node;
    var wanted = ask(present, false);
    if !is_sorted && wanted != 0u {
        wanted = visit_leaves(wanted);
    }
    if !is_over() {
        cursor_next(wanted);
    }
}

// [WIDE-6]: visits the leaves among the wanted children. Returns the inner nodes.
fn visit_leaves(wanted: u32) -> u32 {
    let first = wanted & leaves_of(present);
    var left = first;
    loop {
        if left == 0u || is_over() {
            break;
        }
        node = child_of(present, firstTrailingBit(left));
        left &= left - 1u;
        visit(node);
        look_into(~node);
    }
    return wanted & ~first;
}

fn visit_leaf() {
    visit(node);
    let end_before = end();
    look_into(~node);
    if end() < end_before {
        cursor_shortened();
    }
    if !is_over() {
        cursor_next(0u);
    }
}

fn is_over() -> bool {
    let is = stopped || record_is_full();
    if is {
        node = DONE;
    }
    return is;
}

fn cursor_is_restarting() -> bool {
    return false;
}

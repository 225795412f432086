// Speculative while-while (Aila & Laine 2009). The first leaf is postponed, and the search for nodes continues until
// there is a second leaf, or all lanes have a leaf. Leaves are tested later, so the order of visits differs, but not
// the hits.

@compute @workgroup_size(WORKGROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) index: u32) {
    let task = id.x + id.y * params.y;
    if task >= params.x {
        return;
    }
    lane = index;
    begin(task);
    record_begin();
    cursor_start(root);
    loop {
        var held = DONE;
        loop {
            if is_leaf(node) && held == DONE {
                held = node;
                cursor_backtrack(vec3(0u), 0u);
            }
            if !is_inner(node) {
                break;
            }
            visit_inner();
            if all_lanes(held != DONE) {
                break;
            }
        }
        if held != DONE {
            look_into(~held);
        }
        if stopped {
            node = DONE;
        } else if is_leaf(node) {
            visit_leaf();
        }
        if node == DONE {
            break;
        }
    }
    finish(task);
}

// Persistent invocations with dynamic fetch (Aila & Laine 2009): an invocation that finishes a task takes the next
// task.

@compute @workgroup_size(WORKGROUP)
fn main(@builtin(local_invocation_index) index: u32) {
    lane = index;
    var task = NONE;
    node = DONE;
    loop {
        if node == DONE {
            if task != NONE {
                finish(task);
            }
            task = atomicAdd(&work[0], 1u);
            if task >= params.x {
                break;
            }
            begin(task);
            record_begin();
            cursor_start(root);
        }
        loop {
            if !is_inner(node) {
                break;
            }
            visit_inner();
        }
        if is_leaf(node) {
            visit_leaf();
        }
    }
}

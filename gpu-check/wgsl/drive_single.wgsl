// While-while (Aila & Laine 2009): one task per invocation.

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
        loop {
            if !is_inner(node) {
                break;
            }
            visit_inner();
        }
        if node == DONE {
            break;
        }
        visit_leaf();
    }
    finish(task);
}

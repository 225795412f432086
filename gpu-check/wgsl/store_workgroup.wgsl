// The stack in the memory of the work group, next to the stacks of the other lanes.

var<workgroup> stack: array<u32, STACK_SIZE * WORKGROUP>;

fn store(at: u32, word: u32) {
    stack[at * WORKGROUP + lane] = word;
}

fn load(at: u32) -> u32 {
    return stack[at * WORKGROUP + lane];
}

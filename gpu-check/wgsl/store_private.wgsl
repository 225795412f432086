// The stack in private memory.

var<private> stack: array<u32, STACK_SIZE>;

fn store(at: u32, word: u32) {
    stack[at] = word;
}

fn load(at: u32) -> u32 {
    return stack[at];
}

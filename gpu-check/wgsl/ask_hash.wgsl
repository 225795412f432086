// Questions of the level `hash` of the conformance suite, answered by the lookup functions of traversals.

@group(0) @binding(0) var<storage, read> displacements: array<u32>;
@group(0) @binding(1) var<storage, read> cells: array<u32>;
// The head of a table, then the questions: operation, number, key.
@group(0) @binding(2) var<storage, read> tasks: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> answers: array<vec2<u32>>;

const NONE = 0xffffffffu;
// Neither an inner node nor a leaf.
const DONE = 0x7fffffffu;

@compute @workgroup_size(1)
fn main(@builtin(workgroup_id) id: vec3<u32>) {
    read_head(0u);
    let question = tasks[4u + id.x];
    let key = word_of(vec3(question.zw, 0u));
    var said = vec2(0u, 0u);
    switch question.x {
        case 0u: {
            said = vec2(question.z & DIRECT_MASK, wrap(remainder(question.zw) + question.y));
        }
        case 1u: {
            said = table_mixed(key);
        }
        case 2u: {
            said.x = select(0x80000000u | question.z, ~question.z, question.y == 1u);
        }
        case 3u: {
            said = vec2(question.z, select(DONE, direct_address(question.z), is_direct(question.z)));
        }
        default: {
            said.x = table_node(key);
        }
    }
    answers[id.x] = said;
}

// A first adapter in JavaScript: stackless conform -- node spec/suite/adapters/skeleton.mjs
//
// It answers `key/u32`. To go on, add a profile to HELLO and an operation to OPERATIONS (INTERPRETING.md); for `trace/script` see
// the loop in README.md. Words are BigInt: a Number holds 53 bits.

import { createInterface } from "node:readline";

const HELLO = { protocol: 1, name: "skeleton.mjs", version: "0.1", profiles: ["key/u32"], features: [], limits: {} };

const hex = (word) => word.toString(16);
const depth = (key) => key.toString(2).length - 1; // KEY-5
const zeros = (trail) => trail.toString(2).match(/0*$/)[0].length; // TRAIL-3
const below = (bits) => (1n << BigInt(bits)) - 1n;
const levels = (trail) => ({ levels: trail === 0n ? null : zeros(trail) });

// An operation gets the fields of its input, words as BigInt, and returns the fields of the result.
const OPERATIONS = {
  child: ({ key, right }) => ({ key: hex((key << 1n) | BigInt(right)) }), // KEY-2
  parent: ({ key }) => ({ key: hex(key >> 1n) }), // KEY-3
  sibling: ({ key }) => ({ key: hex(key ^ 1n) }), // KEY-4
  "level-start": ({ key }) => ({ key: hex(1n << BigInt(depth(key))) }), // KEY-6
  depth: ({ key }) => ({ depth: depth(key) }),
  descend: ({ trail, both }) => ({ trail: hex((trail << 1n) | BigInt(both)) }), // TRAIL-2
  levels: ({ trail }) => levels(trail),
  backtrack: ({ key, trail }) => {
    const n = zeros(trail);
    const up = (word) => hex((word >> BigInt(n)) ^ 1n); // TRAIL-4
    return { levels: n, key: up(key), trail: up(trail) };
  },
  counter: ({ trail, depth }) => ({ counter: hex(trail ^ below(depth)) }), // TRAIL-6
  "counter-levels": ({ counter, depth }) => levels(counter ^ below(depth)),
  swap: ({ index, mask }) => ({ index: hex(index ^ mask) }), // SWAP-3
};

function answer({ op, ...fields }) {
  if (!(op in OPERATIONS)) return { unsupported: `no ${op} here` };
  const word = (value) => (typeof value === "string" ? BigInt(`0x${value}`) : value);
  return { result: OPERATIONS[op](Object.fromEntries(Object.entries(fields).map(([name, value]) => [name, word(value)]))) };
}

for await (const line of createInterface({ input: process.stdin })) {
  const request = JSON.parse(line);
  if (request.cmd === "bye") break;
  const reply = request.cmd === "hello" ? HELLO : { seq: request.seq, ...answer(request.input) };
  process.stdout.write(`${JSON.stringify(reply)}\n`);
}
process.stdin.destroy(); // nothing keeps the program from ending

//! Mistakes of readers of the suite, planted in the adapters. A case with the given prefix must fail.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::adapters::{Language, ask};
use super::suite_of;

/// Number of planted mistakes. Each has its own file.
static COUNT: AtomicUsize = AtomicUsize::new(0);

/// Replaces words that must occur once in the source, and runs the cases whose ids have a prefix.
fn plant(language: Language, edits: &[(&str, &str)], cases: &str) -> Option<stackless_suite::Report> {
    let mut source = language.source();
    for (from, to) in edits {
        assert_eq!(source.matches(from).count(), 1, "{from}");
        source = source.replace(from, to);
    }
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let command = language.command(&format!("planted-{number}"), &source)?;
    Some(ask(command, &suite_of(|id| id.starts_with(cases))))
}

fn is_caught(language: Language, base: &[(&str, &str)], from: &str, to: &str, cases: &str) {
    let Some(report) = plant(language, &[base, &[(from, to)]].concat(), cases) else { return };
    assert!(report.verdicts.iter().any(|verdict| verdict.outcome.is_bad()), "'{to}' is not caught by {cases}*");
}

/// A mistake, and the prefix of the cases that detect it.
type Mistake = (&'static str, &'static str, &'static str);

const C: [Mistake; 9] = [
    (
        "depth == 64 ? UINT64_MAX : ((uint64_t)1 << depth) - 1",
        "((uint64_t)1 << depth % 64) - 1",
        "key/u64/counter-ones-64",
    ),
    ("&& depth <= bits", "&& depth < bits", "key/u32/counter-levels-"),
    (
        "rank - rank % (uint32_t)slots > end",
        "(float)(rank - rank % (uint32_t)slots) > (float)end",
        "trace/wide/end-float",
    ),
    ("rank - rank % (uint32_t)slots > end", "(int)(rank - rank % (uint32_t)slots) > (int)end", "trace/wide/end-signed"),
    (
        "node->rank[slot] < node->rank[next]",
        "(float)node->rank[slot] < (float)node->rank[next]",
        "trace/wide/order-float",
    ),
    ("node->rank[slot] < node->rank[next]", "(int)node->rank[slot] < (int)node->rank[next]", "trace/wide/order-signed"),
    ("hit == NONE || hit > end", "hit == NONE || (float)hit > (float)end", "trace/wide/hit-float"),
    ("hit == NONE || hit > end", "hit == NONE || (int)hit > (int)end", "trace/wide/hit-signed"),
    ("hit < wide_nodes[best].hit ||", "(float)hit < (float)wide_nodes[best].hit ||", "trace/wide/best-float"),
];

#[test]
fn a_mistake_of_numbers_in_c_is_caught() {
    for (from, to, cases) in C {
        is_caught(Language::C, &[], from, to, cases);
    }
}

/// Other number types, and the box test in single precision.
const KEPT: [(&str, &str); 1] = [(
    "def word(number):",
    "import ctypes


def single(x):
    return ctypes.c_float(x).value


def signed(x):
    return ctypes.c_int32(x).value


def is_in_box(triangle, ray, distance):
    near, far = ray[6], ray[7]
    for axis in range(3):
        ends = [(triangle[0][axis] + edge[axis]) / 2**149 for edge in ((0, 0, 0), *triangle[1:])]
        if ray[3 + axis] != 0:
            inverse = single(1 / ray[3 + axis])
            ends = sorted(distance(end, ray[axis], inverse) for end in (min(ends), max(ends)))
            near, far = max(near, ends[0]), min(far, ends[1])
    return near <= far


def word(number):",
)];

const NUMBERS: [(&str, &str, &str); 8] = [
    ("rank - rank % self.slots > self.end", "F(rank - rank % self.slots) > F(self.end)", "trace/wide/end-"),
    (
        "self.is_beyond(self.ranks[node][slot]) else slot",
        "F(self.ranks[node][slot] - slot) > F(self.end) else slot",
        "trace/wide/kept-",
    ),
    ("key=lambda slot: self.ranks[node][slot])", "key=lambda slot: F(self.ranks[node][slot]))", "trace/wide/order-"),
    ("distance > self.end", "F(distance) > F(self.end)", "trace/wide/hit-"),
    (
        "    if self.best is None or (distance, node) < self.best:\n            self.best = (distance, node)\n        return",
        "    if self.best is None or (F(distance), node) < (F(self.best[0]), self.best[1]):\n            self.best = (distance, node)\n        return",
        "trace/wide/best-",
    ),
    ("right < left or (right == left", "F(right) < F(left) or (F(right) == F(left)", "trace/tape/"),
    ("self.enter(node) <= self.best[0]", "F(self.enter(node)) <= F(self.best[0])", "trace/tape/"),
    (
        "not None and (self.best is None or (distance, node) < self.best)",
        "not None and (self.best is None or (F(distance), node) < (F(self.best[0]), self.best[1]))",
        "trace/tape/",
    ),
];

#[test]
fn a_mistake_of_numbers_is_caught() {
    for (from, to, cases) in NUMBERS {
        for (function, name) in [("single(", "float"), ("signed(", "signed")] {
            let cases = if cases.ends_with('-') { format!("{cases}{name}") } else { cases.to_owned() };
            is_caught(Language::Python, &KEPT, from, &to.replace("F(", function), &cases);
        }
    }
}

/// Bits for levels that need no repeated query: WIDE-18. The original adapter always repeats it.
const CLEAN: [(&str, &str); 4] = [
    ("    is_visited = next == \"backtrack\"\n", "    is_visited = next == \"backtrack\"\n    clean = 0\n"),
    (
        "            elif search.leaf(node):\n                break\n",
        "            else:\n                end = search.end\n                if search.leaf(node):\n                    break\n                \
         if search.end != end:\n                    clean = 0\n",
    ),
    (
        "            slot = search.next(node_of(key), children, pending)\n",
        "            is_clean = clean >> n & 1\n            clean >>= n + 1\n            \
         if is_clean and pending & (pending - 1) == 0:\n                slot = pending.bit_length() - 1\n            \
         else:\n                pending &= search.wanted(node_of(key))\n                \
         slot = search.next(node_of(key), children, pending) if pending else None\n",
    ),
    ("pending & ~(1 << slot)  # WIDE-10\n", "pending & ~(1 << slot)  # WIDE-10\n        clean = clean << 1 | 1\n"),
];

const OF_CLEAN: [Mistake; 10] = [
    ("clean >> n & 1", "clean >> n & 1 or n >= 8", "trace/wide/dirty-10"),
    ("clean >> n & 1", "clean >> n & 1 or n >= 16", "trace/wide/dirty-18"),
    ("clean >> n & 1", "clean >> n & 1 or n >= 32", "trace/wide/dirty-34"),
    ("clean >> n & 1", "clean >> n & 1 or n >= 64", "trace/wide/dirty-66"),
    ("clean >> n & 1", "clean >> max(n - 1, 0) & 1", "trace/wide/dirty-again"),
    ("clean >> n & 1", "clean & 1", "trace/wide/dirty-again"),
    ("clean >>= n + 1", "clean >>= 0", "trace/wide/dirty-again"),
    ("clean >>= n + 1", "clean >>= n", "trace/wide/dirty-again"),
    ("if search.end != end:", "if False:", "trace/wide/dirty-10"),
    ("backtrack\"\n    clean = 0", "backtrack\"\n    clean = -1", "resume/wide/"),
];

const OF_WORDS: [Mistake; 15] = [
    ("key = key << bits | slot  # WIDE-9", "key = (key << bits | slot) % 2**128", "trace/wide/chain-8-43"),
    ("key = key << bits | slot  # WIDE-9", "key = (key << bits | slot) % 2**128", "trace/wide/chain-4-64"),
    ("key = key << bits | slot  # WIDE-9", "key = (key << bits | slot) % 2**128", "trace/wide/chain-2-128"),
    ("(key * slots + slot, child)", "((key * slots + slot) % 2**64, child)", "hash/wide-deep/"),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if key >> 31 * bits != 1 else 0)",
        "trace/wide/summary-30",
    ),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if key >> 32 * bits != 1 else 0)",
        "trace/wide/summary-31",
    ),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if bin(trail).count('1') < 32 else 0)",
        "trace/wide/stack-7",
    ),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if bin(trail).count('1') < 48 else 0)",
        "trace/wide/stack-10",
    ),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if bin(trail).count('1') < 64 else 0)",
        "trace/wide/stack-12",
    ),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if bin(trail).count('1') < 96 else 0)",
        "trace/wide/stack-16",
    ),
    (
        "pending & ~(1 << slot)  # WIDE-10",
        "(pending & ~(1 << slot) if bin(trail).count('1') < 128 else 0)",
        "trace/wide/stack-20",
    ),
    ("self.end, self.best = end, best", "self.end, self.best = end or 0xFFFFFFFF, best", "trace/wide/end-0-beyond"),
    ("distance > self.end", "distance >= self.end", "trace/wide/hit-at-end-8"),
    ("distance > self.end", "distance >= self.end", "trace/wide/hit-at-end-any"),
    (
        "distance is None or distance > self.end",
        "distance is None or distance > self.end and not self.any_hit",
        "trace/wide/hit-behind-end-any",
    ),
];

#[test]
fn a_mistake_of_wide_words_is_caught() {
    if let Some(report) = plant(Language::Python, &CLEAN, "trace/wide/") {
        assert!(report.is_conforming(), "the bits of WIDE-18 are right");
    }
    for (from, to, cases) in OF_CLEAN {
        is_caught(Language::Python, &CLEAN, from, to, cases);
    }
    // In a 64-bit set of changes of the end, the bits shifted in at the top are not set.
    let of_64 = [&CLEAN[..], &[("clean >>= n + 1", "clean = clean >> n + 1 | -1 << max(63 - n, 0)")]].concat();
    is_caught(Language::Python, &of_64, "clean = clean << 1 | 1", "clean |= 1", "trace/wide/dirty-again-34");
    for (from, to, cases) in OF_WORDS {
        is_caught(Language::Python, &[], from, to, cases);
    }
}

const INTERVAL: &str = "tmin <= hit[0] <= tmax";
const EDGES: &str = "min(u, v, w) < 0 < max(u, v, w)";
const MEET: &str = "hit = (crossed if query == \"parity\" else meet)(triangle, origin, direction)";

const OF_RAYS: [Mistake; 27] = [
    (INTERVAL, "0 <= hit[0] <= tmax", "ray/watertight/cube-ends"),
    (INTERVAL, "0 <= hit[0] <= tmax", "ray/parity/cube-ends"),
    (INTERVAL, "0 <= hit[0] <= tmax", "ray/ulp-8/ends"),
    (INTERVAL, "0 <= hit[0] <= tmax", "ray/ulp-256/ends"),
    (INTERVAL, "tmin <= hit[0]", "ray/watertight/octahedron-ends"),
    (INTERVAL, "tmin <= hit[0]", "ray/parity/octahedron-ends"),
    (INTERVAL, "tmin <= hit[0]", "ray/ulp-8/ends"),
    (INTERVAL, "hit[0] <= tmax", "ray/watertight/octahedron-behind"),
    (INTERVAL, "hit[0] <= tmax", "ray/ulp-8/ends"),
    (INTERVAL, "max(tmin, 1e-6) <= hit[0] <= tmax", "ray/ulp-256/tiny"),
    (INTERVAL, "max(tmin, 1e-6) <= hit[0] <= tmax", "ray/watertight/ball-32-ends-tiny"),
    (INTERVAL, "max(tmin, 1e-6) <= hit[0] <= tmax", "ray/parity/ball-32-ends-tiny"),
    (INTERVAL, "tmin <= hit[0] <= min(tmax, 1e10)", "ray/ulp-256/huge"),
    (INTERVAL, "tmin <= hit[0] <= min(tmax, 1e10)", "ray/watertight/ball-32-ends-huge"),
    (INTERVAL, "tmin <= hit[0] <= min(tmax, 1e10)", "ray/parity/ball-32-ends-huge"),
    (EDGES, "min(u, v, w) < 0 < max(u, v, w) or u == 0", "ray/watertight/cube-edges"),
    (EDGES, "min(u, v, w) < 0 < max(u, v, w) or v == 0", "ray/watertight/cube-edges"),
    (EDGES, "min(u, v, w) < 0 < max(u, v, w) or w == 0", "ray/watertight/cube-edges"),
    ("crossed if query == \"parity\" else meet", "meet", "ray/parity/cube-edges"),
    (
        "[whole(floats(vertex)) for",
        "[whole(floats(' '.join(it[:-1] + '0' for it in vertex.split()))) for",
        "ray/ulp-8/full",
    ),
    ("if det == 0 or min", "if abs(det) < 1e-8 * 2**447 or min", "ray/exact/triangle-2^-15"),
    (EDGES, "min(u, v, w) * 10**6 < -abs(det) and max(u, v, w) * 10**6 > abs(det)", "ray/exact/beside-edges"),
    (
        MEET,
        "hit = is_in_box(triangle, ray, lambda b, o, inv: single(single(b - o) * inv)) and meet(triangle, origin, direction)",
        "ray/exact/slab-overflow",
    ),
    (
        MEET,
        "hit = is_in_box(triangle, ray, lambda b, o, inv: single(b * inv - single(o * inv))) and meet(triangle, origin, direction)",
        "ray/exact/slab-at-end",
    ),
    (
        MEET,
        "hit = is_in_box(triangle, ray, lambda b, o, inv: single(single(b * inv) - single(o * inv))) and meet(triangle, origin, direction)",
        "ray/exact/slab-corner",
    ),
    (
        MEET,
        "hit = is_in_box(triangle, ray, lambda b, o, inv: single(single(b - o) * inv)) and meet(triangle, origin, direction)",
        "ray/exact/slab-corner",
    ),
    ("hit[0] <= tmax:", "hit[0] < tmax:", "ray/exact/slab-at-end"),
];

#[test]
fn a_mistake_of_rays_is_caught() {
    for (from, to, cases) in OF_RAYS {
        is_caught(Language::Python, &KEPT, from, to, cases);
    }
}

#!/usr/bin/env python3
"""A small implementation of the specification: stackless conform -- python3 spec/suite/adapters/traverse.py

Keys and trails are Python's whole numbers, which have any length, nodes are found in a dictionary of all keys, and rays
meet triangles in whole numbers and fractions. Nothing here is fast; all of it is exact. Python 3.8 or newer, standard
library only.
"""

import json
import math
import struct
import sys
from fractions import Fraction


class Reject(Exception):
    """The input has a fault; the argument is its code."""


def word(number):
    return format(number, "x")


def depth_of(key):
    return key.bit_length() - 1  # KEY-5


def trailing_zeros(trail):
    return (trail & -trail).bit_length() - 1  # TRAIL-3


def back(key, trail):
    """To the node that was postponed last, and the levels up to there. The trail is not 0."""
    n = trailing_zeros(trail)
    return (key >> n) ^ 1, (trail >> n) ^ 1, n  # TRAIL-4


def complement(trail, depth):
    return trail ^ ((1 << depth) - 1)  # TRAIL-6


def levels(trail):
    return {"levels": trailing_zeros(trail) if trail else None}


def backtrack(key, trail):
    key, trail, climbed = back(key, trail)
    return {"levels": climbed, "key": word(key), "trail": word(trail)}


# An operation is a function of the fields of its input, words being numbers by then. It returns the result's fields.
KEY_LEVEL = {
    "child": lambda key, right: {"key": word(2 * key + right)},  # KEY-2
    "parent": lambda key: {"key": word(key >> 1)},  # KEY-3
    "sibling": lambda key: {"key": word(key ^ 1)},  # KEY-4
    "depth": lambda key: {"depth": depth_of(key)},
    "level-start": lambda key: {"key": word(1 << depth_of(key))},  # KEY-6
    "descend": lambda trail, both: {"trail": word(2 * trail + both)},  # TRAIL-2
    "levels": levels,
    "backtrack": backtrack,
    "counter": lambda trail, depth: {"counter": word(complement(trail, depth))},
    "counter-levels": lambda counter, depth: levels(complement(counter, depth)),
    "swap": lambda index, mask: {"index": word(index ^ mask)},  # SWAP-3
}


def cell(key, displacements, cells, displacement):
    return {"bucket": key % displacements, "cell": (key % cells + displacement) % cells}  # HASH-1


def decode(word):
    if word >> 31 == 0:
        return {"displacement": word}
    leaf = word >> 30 == 3
    return {"leaf": leaf, "index": (~word if leaf else word) & 0x3FFFFFFF}  # HASH-5


def hashed_keys(children, reach):
    nodes = nodes_of(children)
    heights = {}
    for key in sorted(nodes, reverse=True):  # children before their parents
        heights[key] = 1 + max(heights[2 * key], heights[2 * key + 1]) if 2 * key in nodes else 0
    inner, leaf = reach
    needed = min(inner + 2, leaf + 1)
    return {"keys": [word(key) for key in sorted(nodes) if heights.get(key ^ 1, -1) >= needed]}  # HASH-3


def lookup(displacements, cells, keys, seed=None, bits=None):
    displacements, cells = numbers(displacements), numbers(cells)

    def found(key):
        key = key if seed is None else mixed(key, seed, bits)  # HASH-7
        entry = displacements[key % len(displacements)]
        return entry if entry >> 31 else cells[(key % len(cells) + entry) % len(cells)]

    return {"words": [word(found(key)) for key in numbers(keys)]}


def mixed(key, seed, bits):
    shifts, factors = {
        64: ((30, 27, 31), (0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 1)),
        32: ((16, 15, 16), (0x7FEB352D, 0x846CA68B, 1)),
    }[bits]
    mask = (1 << bits) - 1
    key = (key ^ seed) & mask
    for shift, factor in zip(shifts, factors):
        key = ((key ^ (key >> shift)) * factor) & mask
    return key


def folded(key, seed):
    bits = rest = key.bit_length()
    if bits <= 64:
        return key
    while rest > 0:  # pieces of 63 bits from the root down: HASH-6
        rest = max(rest - 63, 0)
        seed = mixed(key >> rest, seed, 64)
        key &= (1 << rest) - 1
    return mixed(bits, seed, 64)


def address(leaf, index):
    return ~index & 0xFFFFFFFF if leaf else 0x80000000 + index  # HASH-5


def numbers(words):
    return [int(text, 16) for text in words]


HASH_LEVEL = {
    "cell": cell,
    "mix": lambda key, seed, bits: {"key": word(mixed(key, seed, bits))},
    "fold": lambda key, seed: {"key": word(folded(key, seed))},
    "encode": lambda leaf, index: {"word": word(address(leaf, index))},
    "decode": decode,
    "hashed-keys": hashed_keys,
    "lookup": lookup,
}


def nodes_of(children):
    """The number of the node of each key. Trees only."""
    nodes, pending = {}, [(1, 0)]
    seen = set()
    while pending:
        key, node = pending.pop()
        if node in seen or node >= len(children):
            raise Reject("not-a-tree")
        seen.add(node)
        nodes[key] = node
        pending += [(2 * key + side, other) for side, other in enumerate(children[node] or ())]
    if len(seen) < len(children):
        raise Reject("not-a-tree")
    return nodes


class Script:
    """A search that does as a string says."""

    decisions = {"n": None, "l": (0, 0, 0), "r": (1, 0, 0), "L": (0, 1, 0), "R": (1, 1, 0)}

    def __init__(self, script):
        self.script = script

    def decide(self, node, pair):
        """None, or: whether the right child is next, whether the other one is postponed, whether that is marked."""
        return self.decisions[self.script[node]]

    def leaf(self, node):
        return "stop" if self.script[node] == "!" else "go on"


class Cells:
    """A search through a small scene, by the rule of the profile."""

    def __init__(self, cells, rule, any_hit, octant, best):
        self.cells, self.rule, self.any_hit, self.octant, self.best = cells, rule, any_hit, octant, best

    def enter(self, node):
        return self.cells[node].get("enter", 0)

    def is_missed(self, node):
        return self.cells[node].get("miss", False)

    def is_wanted(self, node):
        return not self.is_missed(node) and (self.best is None or self.enter(node) <= self.best[0])

    def decide(self, node, pair):
        cell = self.cells[node]
        if self.rule in ("node-left", "node-sign"):
            right = self.octant >> cell.get("axis", 0) & 1 if self.rule == "node-sign" else 0
            return (right, 1, 0) if self.is_wanted(node) else None
        left_wanted, right_wanted = map(self.is_wanted, pair)
        if not (left_wanted and right_wanted):
            return (right_wanted, 0, 0) if left_wanted or right_wanted else None
        left, right = map(self.enter, pair)
        right_first = right < left or (right == left and cell.get("right_first", False))
        first, second = (pair[1], pair[0]) if right_first else pair
        leaves = self.cells[first].get("exit")
        marked = self.rule == "disjoint" and leaves is not None and leaves < self.enter(second)
        return right_first, 1, marked

    def leaf(self, node):
        cell = self.cells[node]
        counts = self.is_wanted(node) if self.rule.startswith("node") else not self.is_missed(node)
        distance = cell.get("hit")
        if counts and distance is not None and (self.best is None or (distance, node) < self.best):
            self.best = (distance, node)
            if self.any_hit:
                return "stop"
        leaves = cell.get("exit")
        is_found = self.best is not None and self.best[1] == node and (leaves is None or self.best[0] <= leaves)
        return "found" if is_found and self.rule == "disjoint" else "go on"


def walk(children, search, key=1, trail=0, marks=0, next="visit"):
    """Traverses from a state on. All that is kept between two visits is the key, the trail and the marks."""
    nodes = nodes_of(children)
    if key not in nodes:
        raise Reject("no-such-node")
    if trail >> depth_of(key):
        raise Reject("trail")
    events, trails = [], []
    visit = next == "visit"
    while True:
        if visit:
            node = nodes[key]
            pair = children[node]
            events.append(f"{'enter' if pair else 'leaf'} {key:x}")
            trails.append(word(trail))
            decision = pair and search.decide(node, pair)
            if decision:
                right, both, marked = decision
                key, trail, marks = 2 * key + right, 2 * trail + both, 2 * marks + marked
                continue
            found = "go on" if pair else search.leaf(node)
            if found == "stop":
                break
            if found == "found":
                trail &= ~marks  # DISJOINT-2
        if trail == 0:
            break
        key, trail, climbed = back(key, trail)
        marks >>= climbed
        events.append(f"backtrack {key:x} {climbed}")
        visit = True
    return {"events": events + ["end"], "trails": trails}


def trace(rule, children, script=None, cells=None, any=False, octant=0):
    if script is not None:
        return walk(children, Script(script))
    search = Cells(cells, rule, any, octant, None)
    return with_hit(walk(children, search), search)


def resume(children, script, key, trail, next):
    return only_events(walk(children, Script(script), key, trail, 0, next))


def resume_disjoint(children, cells, key, trail, marks, next, hit=None):
    search = Cells(cells, "disjoint", False, 0, hit and (hit["t"], hit["node"]))
    return with_hit(only_events(walk(children, search, key, trail, marks, next)), search)


def resume_key(children, script, key):
    return only_events(walk(children, Script(script), key, (1 << depth_of(key)) - 1))  # PAUSE-4


def with_hit(result, search):
    return {**result, "hit": search.best and {"t": search.best[0], "node": search.best[1]}}


def only_events(result):
    return {"events": result["events"]}


WALKS = {"trace": trace, "resume": resume, "resume-disjoint": resume_disjoint, "resume-key": resume_key}


def check_wide(slots, children):
    """A root that has slots, no more children than slots, and every node the child of one: WIDE-1."""
    seen = {0}
    if not children or children[0] is None:
        raise Reject("not-a-tree")
    for node, below in enumerate(children):
        if below is None:
            continue
        if len(below) > slots or (not below and node != 0):
            raise Reject("not-a-tree")
        for child in below:
            if child >= len(children) or child in seen:
                raise Reject("not-a-tree")
            seen.add(child)
    reached, pending = 0, [0]
    while pending:  # a cycle is not reached from the root
        reached += 1
        pending += children[pending.pop()] or ()
    if reached < len(children):
        raise Reject("not-a-tree")


class Wide:
    """A search through a wide tree."""

    def __init__(self, slots, ranks, hits, best, any=False, sorted=True, end=0xFFFFFFFF):
        self.slots, self.ranks, self.hits, self.any_hit, self.in_order = slots, ranks, hits, any, sorted
        self.end, self.best = end, best

    def is_beyond(self, rank):
        return self.in_order and rank - rank % self.slots > self.end  # WIDE-3

    def wanted(self, node):
        """A bit for each slot."""
        ranks = enumerate(self.ranks[node])
        return sum(1 << slot for slot, rank in ranks if rank is not None and not self.is_beyond(rank))

    def next(self, node, children, pending):
        """The slot that comes next of those that are pending, or None if all that is left is beyond."""
        slots = [slot for slot in range(self.slots) if pending >> slot & 1]
        if not self.in_order:
            return min(slots, key=lambda slot: (children[children[node][slot]] is not None, slot))  # WIDE-6
        slot = min(slots, key=lambda slot: self.ranks[node][slot])  # WIDE-5
        return None if self.is_beyond(self.ranks[node][slot]) else slot

    def leaf(self, node):
        """Whether the search ends here."""
        distance = self.hits[node]
        if distance is None or distance > self.end:
            return False
        self.end = distance
        if self.best is None or (distance, node) < self.best:
            self.best = (distance, node)
        return self.any_hit


def walk_wide(slots, children, ranks, hits=None, key=1, trail=0, next="visit", hit=None, **search):
    """Traverses from a state on. All that is kept between two visits is the key, the trail and the end."""
    check_wide(slots, children)
    search = Wide(slots, ranks, hits or [None] * len(children), hit and (hit["t"], hit["node"]), **search)
    bits = slots.bit_length() - 1

    def node_of(key):
        node = 0
        for shift in range((key.bit_length() - 1) // bits * bits - bits, -1, -bits):
            node = children[node][key >> shift & (slots - 1)]
        return node

    events, trails = [], []
    is_visited = next == "backtrack"
    while True:
        node = node_of(key)
        pending = 0
        if not is_visited:
            events.append(f"{'leaf' if children[node] is None else 'enter'} {key:x}")
            trails.append(word(trail))
            if children[node] is not None:
                pending = search.wanted(node)
            elif search.leaf(node):
                break
        is_visited = False
        climbed = None
        slot = search.next(node, children, pending) if pending else None
        while slot is None and trail != 0:
            n = trailing_zeros(trail) // slots  # WIDE-11
            climbed = n if climbed is None else climbed + n + 1
            pending, trail = trail >> slots * n & (1 << slots) - 1, trail >> slots * (n + 1)
            key >>= bits * (n + 1)  # WIDE-9
            slot = search.next(node_of(key), children, pending)
        if slot is None:
            break
        key = key << bits | slot  # WIDE-9
        trail = trail << slots | pending & ~(1 << slot)  # WIDE-10
        if climbed is not None:
            events.append(f"backtrack {key:x} {climbed}")
    result = {"events": events + ["end"]}
    if hits is None:
        return {**result, "trails": trails}
    return with_hit(result, search)


def resume_wide(**walk):
    return {name: value for name, value in walk_wide(**walk).items() if name != "trails"}


def hashed_keys_wide(slots, children):
    keys, pending = [], [(1, 0)]
    while pending:
        key, node = pending.pop()
        below = children[node]
        inner = [(key * slots + slot, child) for slot, child in enumerate(below) if children[child] is not None]
        if inner and len(below) > 1:  # WIDE-16
            keys.append(key)
        pending += inner
    return {"keys": [word(key) for key in sorted(keys)]}


WIDE = {"trace-wide": walk_wide, "resume-wide": resume_wide, "hashed-keys-wide": hashed_keys_wide}


def ray(vertices, triangles, rays, query):
    points = [whole(floats(vertex)) for vertex in vertices]
    if any(corner >= len(points) for triangle in triangles for corner in triangle):
        raise Reject("index")
    corners = [[points[corner] for corner in triangle] for triangle in triangles]
    edges = [(a, minus(b, a), minus(c, a)) for a, b, c in corners]
    return {"hits": [shoot(edges, floats(ray), query) for ray in rays]}


def shoot(edges, ray, query):
    origin, direction, (tmin, tmax) = whole(ray[:3]), whole(ray[3:6]), ray[6:]
    if not any(direction):
        raise Reject("no-direction")
    if not 0 <= tmin <= tmax:
        raise Reject("interval")
    hits = []
    for prim, triangle in enumerate(edges):
        hit = (crossed if query == "parity" else meet)(triangle, origin, direction)
        if hit and tmin <= hit[0] <= tmax:
            hits.append((hit[0], prim, hit))
    if query == "any":
        return bool(hits)
    if query == "parity":
        return len(hits) % 2 == 1
    if not hits:
        return None
    t, prim, (_, u, v) = min(hits)  # by exact distances: EXACT-1
    return {"prim": prim, "t": f"{nearest(t):08x}", "u": f"{nearest(u):08x}", "v": f"{nearest(v):08x}"}


def meet(triangle, origin, direction):
    """Distance and weights of the point where the line crosses the closed triangle, exactly; None where it does not."""
    corner, e1, e2 = triangle
    s, p = minus(origin, corner), cross(direction, e2)
    q = cross(s, e1)
    det, u, v = dot(e1, p), dot(s, p), dot(direction, q)
    w = det - u - v
    if det == 0 or min(u, v, w) < 0 < max(u, v, w):  # EXACT-2
        return None
    return Fraction(dot(e2, q), det), Fraction(u, det), Fraction(v, det)


def crossed(triangle, origin, direction):
    """The distance at which the line crosses the triangle; None where it does not. A line that meets an edge counts as
    one beside it, for all triangles the same one, so through an edge of a closed mesh it crosses once."""
    a = minus(triangle[0], origin)
    b, c = ([x + y for x, y in zip(a, edge)] for edge in triangle[1:])
    normals = cross(a, b), cross(b, c), cross(c, a)
    det = sum(dot(direction, normal) for normal in normals)
    sides = [next((x for x in (dot(direction, normal), *normal) if x), 0) for normal in normals]
    if det == 0 or not (min(sides) > 0 or max(sides) < 0):
        return None
    return (Fraction(dot(a, normals[1]), det),)


def nearest(x):
    """The bits of the float nearest to a fraction that is not negative, ties to even; infinity beyond them all."""
    if x == 0:
        return 0
    exponent = x.numerator.bit_length() - x.denominator.bit_length()
    if x < Fraction(2) ** exponent:
        exponent -= 1
    exponent = max(exponent, -126)  # below that, floats are subnormal: they have the spacing of the least normal ones
    steps = round(x / Fraction(2) ** (exponent - 23))  # of a Fraction: ties to even
    return min(((exponent + 126) << 23) + steps, 0x7F800000)  # the leading one of the steps adds one to the exponent


def floats(text):
    return [struct.unpack(">f", bytes.fromhex(digits))[0] for digits in text.split()]


def whole(floats):
    """In units of 2^-149: every finite float is a whole number of them. Distances and weights do not depend on units."""
    if not all(map(math.isfinite, floats)):
        raise Reject("not-finite")
    ratios = [x.as_integer_ratio() for x in floats]
    return [numerator * (2**149 // denominator) for numerator, denominator in ratios]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


OPERATIONS = {**KEY_LEVEL, **HASH_LEVEL, **WALKS, **WIDE, "ray": ray}
WORDS = ("key", "trail", "marks", "counter", "index", "mask", "seed", "word")
PROFILES = {
    "key": ["u32", "u64", "u128", "wide"],
    "hash": ["function", "fold", "address", "keys", "lookup", "wide", "wide-deep"],
    "trace": ["script", "complete", "tape", "node-left", "node-sign", "disjoint", "invalid", "wide", "wide-invalid"],
    "resume": ["state", "disjoint", "key-only", "invalid", "wide"],
    "ray": ["grid", "exact", "watertight", "parity", "ulp-8", "ulp-256", "invalid"],
}
HELLO = {
    "protocol": 1,
    "name": "traverse.py",
    "version": "1.0",
    "profiles": [f"{level}/{profile}" for level, profiles in PROFILES.items() for profile in profiles],
    "features": ["trails", "changing", "weights"],
    "limits": {},
}


def answer(case):
    fields = dict(case["input"])
    operation = OPERATIONS.get(fields.pop("op"))
    if operation is None:
        return {"unsupported": "there is no such operation here"}
    for name in WORDS:
        if isinstance(fields.get(name), str):
            fields[name] = int(fields[name], 16)
    if operation is trace:  # which of the searches, only the profile says
        fields["rule"] = case["profile"]
    try:
        return {"result": operation(**fields)}
    except Reject as reject:
        return {"reject": str(reject)}


def main():
    for line in sys.stdin:
        request = json.loads(line)
        if request["cmd"] == "bye":
            break
        reply = HELLO if request["cmd"] == "hello" else {"seq": request["seq"], **answer(request)}
        print(json.dumps(reply), flush=True)


if __name__ == "__main__":
    main()

"""Compares answers with the expectations of cases. It runs no program.

`stackless conform` has its own judge. Tests compare both on the lines of hostile.json.
"""

import json
import re

KINDS = {"result": dict, "reject": str, "unsupported": str}  # of answers
FEATURES = ("trails", "counters", "registers", "changing", "weights")
NESTING = 127


class Flaw(Exception):
    """A fault of an answer."""


def shown(value):
    """Shortens text of a program, and escapes control characters."""
    text = value if isinstance(value, str) else json.dumps(value)
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text[:121])
    return text if len(text) <= 120 else text[:120] + "..."


def parse(line):
    """Parses a line as strict JSON, as the other judges do. Raises ValueError for an invalid line."""

    def pairs(fields):
        if len(dict(fields)) < len(fields):
            raise ValueError("a key stands twice")
        return dict(fields)

    def whole(text):
        return float(text) if text == "-0" or len(text) > 20 else int(text)

    def constant(text):
        raise ValueError(f"{text} is no number")

    text = line.decode("utf-8")
    try:
        value = json.loads(text, object_pairs_hook=pairs, parse_int=whole, parse_constant=constant)
        json.dumps(value, allow_nan=False, ensure_ascii=False).encode("utf-8")  # no infinity, and no half of a surrogate pair
    except RecursionError:
        raise ValueError("nested too deep") from None
    level, values = 0, [value]
    while values:
        level, values = level + 1, [inner for it in values if isinstance(it, (dict, list)) for inner in elements(it)]
    if level > NESTING:
        raise ValueError("nested too deep")
    return value


def elements(it):
    return it.values() if isinstance(it, dict) else it


def read_hello(line):
    """Parses the hello of a program (schema/hello.json). Raises ValueError for any other line."""
    hello = parse(line)
    if not isinstance(hello, dict) or not alike(hello.get("protocol"), 1) or not isinstance(hello.get("name"), str):
        raise ValueError("expected protocol 1 and a name")
    hello = {"version": "", "features": [], "limits": {}, **hello}
    names = [hello.get("profiles"), hello["features"]]
    if not all(isinstance(it, list) and all(isinstance(name, str) for name in it) for it in names):
        raise ValueError("expected lists of profiles and features")
    if not isinstance(hello["version"], str):
        raise ValueError("expected a text as version")
    unknown = [name for name in hello["features"] if name not in FEATURES]
    if unknown:
        raise ValueError(f"there is no feature '{shown(unknown[0])}'")
    check_limits(hello["limits"], ("max_depth", "wide"))
    return hello


def check_limits(limits, names):
    if not isinstance(limits, dict) or any(name not in names for name in limits):
        raise ValueError(f"limits: expected an object with {' and '.join(names)} at most")
    for name, limit in limits.items():
        if name == "wide":
            check_limits(limit, ("2", "4", "8"))
        elif type(limit) is not int or not 0 <= limit < 2**32:
            raise ValueError(f"limits: {name}: expected a whole number")


def read_reply(line, seq):
    """Parses the answer to the case with this number (schema/reply.json). Raises ValueError for any other line."""
    reply = parse(line)
    if not isinstance(reply, dict) or not alike(reply.get("seq"), seq):
        raise ValueError("no answer to this case")
    found = [kind for kind in KINDS if reply.get(kind) is not None]
    if len(found) != 1 or not isinstance(reply[found[0]], KINDS[found[0]]):
        raise ValueError("expected one of result, reject and unsupported")
    return reply


def judge(case, hello, reply):
    """Checks an answer to a case. Raises Flaw."""
    expect = {"reject": "too-deep"} if is_too_deep(case, hello) else case["expect"]
    kinds = [kind for kind in KINDS if reply.get(kind) is not None]
    if kinds == ["unsupported"]:
        raise Flaw(f"unsupported ({shown(reply['unsupported'])}), though profile and features were named")
    if "reject" in expect:
        if kinds == ["result"]:
            raise Flaw(f"answered, expected the rejection '{expect['reject']}'")
        if reply["reject"] != expect["reject"]:
            raise Flaw(f"rejected as '{shown(reply['reject'])}', expected '{expect['reject']}'")
    elif kinds == ["reject"]:
        raise Flaw(f"rejected as '{shown(reply['reject'])}', expected an answer")
    elif "near" in expect:
        judge_near(expect["near"], reply["result"])
    elif "valid" in expect:
        judge_table(case["input"], reply["result"])
    else:
        judge_result(case, hello.get("features", ()), expect["result"], reply["result"])


def same(name, expected, found):
    if isinstance(expected, list) and isinstance(found, list):
        for i in range(max(len(expected), len(found))):
            if not alike(expected[i : i + 1], found[i : i + 1]):
                a, b = [json.dumps(it[i]) if i < len(it) else "nothing" for it in (expected, found)]
                raise Flaw(f"{name}[{i}]: {shown(b)}, expected {shown(a)}")
    elif not alike(expected, found):
        raise Flaw(f"{name}: {shown(found)}, expected {shown(expected)}")


def alike(a, b):
    """Returns whether values are equal and have one type: 3.0 is not 3, and true is not 1."""
    if type(a) is not type(b):
        return False
    if isinstance(a, list):
        return len(a) == len(b) and all(map(alike, a, b))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(alike(a[name], b[name]) for name in a)
    return a == b


def judge_result(case, features, expected, found):
    known = set(expected)
    for name, value in expected.items():
        if name == "trails" and "trails" not in features:
            continue
        if name not in found:
            raise Flaw(f"no field '{name}'")
        if name == "hits":
            value, other = (plain_hits(hits, "weights" in features) for hits in (value, found[name]))
            same(name, value, other)
        else:
            same(name, value, found[name])
    if "events" in expected and "trails" in expected and "slots" not in case["input"]:
        keys = [int(event.split()[1], 16) for event in expected["events"] if event.startswith(("enter", "leaf"))]
        visits = list(zip(keys, (int(trail, 16) for trail in expected["trails"])))
        for name, judge_list in (("counters", judge_counters), ("registers", judge_registers)):
            if name in features:
                known.add(name)
                if name not in found:
                    raise Flaw(f"no field '{name}'")
                judge_list(visits, found[name])
    for name in found:
        if name not in known:
            raise Flaw(f"unknown field '{shown(name)}'")


def plain_hits(hits, weights):
    """Returns hits in the form for comparing: with unsigned zeros, and with weights only if they are compared."""
    if not isinstance(hits, list):
        return hits
    names = {"u", "v"} if not weights else set()
    return [
        {k: "00000000" if v == "80000000" else v for k, v in hit.items() if k not in names}
        if isinstance(hit, dict)
        else hit
        for hit in hits
    ]


def judge_counters(visits, found):
    same("counters", [format((1 << (key.bit_length() - 1)) * 2 - 1 - trail, "x") for key, trail in visits], found)


def judge_registers(visits, found):
    """Checks that registers are unset or the next node, and never unset while the sibling is postponed."""
    if not isinstance(found, list) or len(found) != len(visits):
        raise Flaw("registers: expected one for each visit")
    for i, ((key, trail), register) in enumerate(zip(visits, found)):
        low = (trail & -trail).bit_length() - 1
        right = format((key >> low) ^ 1, "x") if trail else None
        if register != right and (register is not None or trail & 1):
            raise Flaw(f"registers[{i}]: {shown(register)}, expected {shown(right)}")


def judge_near(near, result):
    hits = result.get("hits")
    if set(result) != {"hits"} or not isinstance(hits, list) or len(hits) != len(near["hits"]):
        raise Flaw("expected hits, one for each ray, and nothing else")
    for i, (expected, found) in enumerate(zip(near["hits"], hits)):
        if expected is None or not isinstance(found, dict):
            right = expected is None and found is None
        else:
            bits = found.get("t")
            right = any(alike(found.get("prim"), prim) for prim in expected["prims"]) and isinstance(bits, str)
            right = right and re.fullmatch("[0-9a-f]{8}", bits) is not None
            right = right and abs(int(bits, 16) - int(expected["t"], 16)) <= near["ulps"]
        if not right:
            raise Flaw(f"hits[{i}]: {shown(found)}, expected {shown(expected)} within {near['ulps']} ulp")


def levels(children):
    """Returns the level of each node, or None if the children do not form a tree with the root 0."""
    level, pending = {}, [(0, 0)]
    while pending:
        node, at = pending.pop()
        if node in level or node >= len(children):
            return None
        level[node] = at
        pending += [(child, at + 1) for child in children[node] or ()]
    return level if len(level) == len(children) else None


def is_too_deep(case, hello):
    limits, fields = hello.get("limits", {}), case["input"]
    level = (
        case["id"].startswith(("trace/", "resume/")) and "reject" not in case["expect"] and levels(fields["children"])
    )
    if not level:
        return False
    if "slots" in fields:
        limit = (limits.get("wide") or {}).get(str(fields["slots"]))
        deepest = max(at for node, at in level.items() if fields["children"][node] is not None)
    else:
        limit, deepest = limits.get("max_depth"), max(level.values())
    return limit is not None and deepest > limit


def mixed(key, seed, bits):
    shifts, factors = {
        64: ((30, 27, 31), (0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 1)),
        32: ((16, 15, 16), (0x7FEB352D, 0x846CA68B, 1)),
    }[bits]
    key = (key ^ seed) & (1 << bits) - 1
    for shift, factor in zip(shifts, factors):
        key = (key ^ key >> shift) * factor & (1 << bits) - 1
    return key


def folded(key, seed):
    rest = key.bit_length()
    if rest <= 64:
        return key
    length = rest
    while rest > 0:
        rest = max(rest - 63, 0)
        seed, key = mixed(key >> rest, seed, 64), key & (1 << rest) - 1
    return mixed(length, seed, 64)


def hashed(children, reach):
    """Returns the hashed keys with their nodes."""
    nodes, pending = {}, [(1, 0)]
    while pending:
        key, node = pending.pop()
        nodes[key] = node
        pending += [(2 * key + side, child) for side, child in enumerate(children[node] or ())]
    below = {}  # the height of the subtree of each key
    for key in sorted(nodes, reverse=True):
        below[key] = 1 + max(below[2 * key], below[2 * key + 1]) if 2 * key in nodes else 0
    if reach is None:
        return nodes
    needed = min(reach[0] + 2, reach[1] + 1)
    return {key: node for key, node in nodes.items() if below.get(key ^ 1, -1) >= needed}


def judge_table(asked, result):
    """Checks that a table leads each key of the tree to its node."""
    children, keys = asked["children"], hashed(asked["children"], asked.get("reach"))
    may_fold = max(levels(children).values()) >= 64
    for name in result:
        if name not in ("displacements", "cells", "seed", "bits") and not (name == "fold" and may_fold):
            raise Flaw(f"unknown field '{shown(name)}'")
    if "fold" not in result and any(key.bit_length() > 64 for key in keys):
        raise Flaw("no field 'fold'")
    if not all(isinstance(result.get(name), list) for name in ("displacements", "cells")):
        raise Flaw("expected lists of displacements and cells")
    try:
        displacements, cells = ([word(text, 32) for text in result[name]] for name in ("displacements", "cells"))
        fold = word(result.get("fold", "0"), 64)
        seed, bits = word(result["seed"], 64) if "seed" in result else None, result.get("bits")
    except (KeyError, TypeError, ValueError) as error:
        raise Flaw(f"the table is wrong: {shown(str(error))}") from None
    d, h = len(displacements), len(cells)
    if d == 0 or d & d - 1 or h % 2 == 0 or "sizes" in asked and asked["sizes"] != [d, h]:
        raise Flaw(f"the table is wrong: D = {d}, H = {h}")
    if (seed is None) != (bits is None) or seed is not None and (not any(alike(bits, it) for it in (32, 64)) or "sizes" in asked):
        raise Flaw("the table is wrong: seed and bits")
    for key, node in keys.items():
        key = folded(key, fold)
        key = key if seed is None else mixed(key, seed, bits)
        found = displacements[key % d]
        found = found if found >> 31 else cells[(key % h + found) % h]
        expected = 0x80000000 | node if children[node] is not None else node ^ 0xFFFFFFFF
        if found != expected:
            raise Flaw(f"the table is wrong: a key leads to {found:x}, expected {expected:x}")


def word(text, bits):
    if not re.fullmatch("0|[1-9a-f][0-9a-f]*", text) or int(text, 16) >> bits:
        raise ValueError(f"{text}: no word of {bits} bits")
    return int(text, 16)

"""A failing case as text: its tree or its mesh, and the expected and received values."""

import json
import struct

from .judge import levels, shown

MOST = 40  # lines of a tree, a mesh, or a table


def picture(case, reply):
    """Yields lines that show a case and its answer."""
    asked = case["input"]
    yield from cut(tree(asked) if asked.get("children") else mesh(asked, first_ray(case, reply)) if "rays" in asked else [])
    fields = {name: it for name, it in asked.items() if not isinstance(it, list) and name != "script"}
    yield ", ".join(f"{name} {json.dumps(it)}" for name, it in fields.items())
    expect = case["expect"]
    expected, found = expect.get("result") or expect.get("near") or expect, reply.get("result") or reply
    expected, found = ({name: it for name, it in both.items() if name != "seq"} for both in (expected, found))
    for name in dict.fromkeys([*expected, *found]):
        if name in expected and name in found and isinstance(expected[name], list) and isinstance(found[name], list):
            yield from beside(name, expected[name], found[name])
        elif name != "ulps":
            a, b = (value(it[name]) if name in it else "nothing" for it in (expected, found))
            yield f"{name}: expected {a}, received {b}"


def cut(lines):
    lines = list(lines)
    yield from (line[:110] for line in lines[:MOST])
    if len(lines) > MOST:
        yield f"... and {len(lines) - MOST} lines more"


def beside(name, expected, found):
    """Yields two lists as columns, around the first difference."""
    rows = [[value(it[i]) if i < len(it) else "nothing" for it in (expected, found)] for i in range(max(len(expected), len(found)))]
    first = next((i for i, (a, b) in enumerate(rows) if a != b), None)
    if first is None:
        return
    shown_rows = range(max(first - MOST // 4, 0), min(first + MOST // 4, len(rows)))
    width = max(len("expected"), *(len(rows[i][0]) for i in shown_rows))
    yield f"{name:>10}  {'expected':{width}}  received"
    for i in shown_rows:
        yield f"{i:>10}  {rows[i][0]:{width}}  {rows[i][1]}{'  <' if rows[i][0] != rows[i][1] else ''}"


def value(it):
    """Returns the text of a value, with floats also in decimal."""
    if isinstance(it, dict) and isinstance(it.get("t"), str):
        words = [f"{name} {number(it[name])} ({shown(it[name])})" for name in ("t", "u", "v") if isinstance(it.get(name), str)]
        return ", ".join([*(f"{name} {it[name]}" for name in ("prim", "prims") if name in it), *words])
    return shown(it)


def number(bits):
    """Returns the shortest decimal number that rounds to the float with these 8 hexadecimal digits."""
    try:
        x = struct.unpack(">f", bytes.fromhex(bits))[0]
    except (ValueError, struct.error):
        return "?"
    texts = (f"{x:.{digits}g}" for digits in range(1, 10))
    return next((text for text in texts if struct.pack(">f", min(max(float(text), -3.4028234e38), 3.4028234e38)) == struct.pack(">f", x)), str(x))


def tree(asked):
    """Yields a line for each node: its key, its number, and its part of the search."""
    children, slots = asked["children"], asked.get("slots", 2)
    if levels(children) is None:
        return (f"node {node}: {'leaf' if below is None else below}" for node, below in enumerate(children))
    lines, pending = [], [(1, 0, 0, None)]
    while pending:
        key, node, level, rank = pending.pop()
        below = children[node] or []
        words = [f"rank {rank}"] if rank is not None else []
        if asked.get("script"):
            words.append(asked["script"][node])
        if asked.get("cells"):
            words += [name if it is True else f"{name} {it}" for name, it in asked["cells"][node].items()]
        if asked.get("hits") and asked["hits"][node] is not None:
            words.append(f"hit {asked['hits'][node]}")
        lines.append(f"{'  ' * level}{key:x} node {node}: {', '.join(words) or ('leaf' if children[node] is None else 'inner')}")
        ranks = (asked["ranks"][node] if asked.get("ranks") else None) or [None] * len(below)
        rows = [(key * slots + slot, child, level + 1, ranks[slot]) for slot, child in enumerate(below)]
        pending += reversed(rows)
    return lines


def first_ray(case, reply):
    """Returns the number of the first ray with a wrong answer, or 0."""
    expect, result = case["expect"], reply.get("result")
    expected = (expect.get("result") or expect.get("near") or {}).get("hits")
    found = result.get("hits") if isinstance(result, dict) else None
    if not isinstance(expected, list) or not isinstance(found, list):
        return 0
    # Several triangles may be correct.
    alike = (lambda a, b: (a is None) == (b is None)) if "near" in expect else (lambda a, b: a == b)
    return next((i for i, (a, b) in enumerate(zip(expected, found)) if not alike(a, b)), 0)


def mesh(asked, at):
    """Yields the triangles and a ray as OBJ. The last line is the ray, with the length of its direction."""
    vertices = [[number(bits) for bits in vertex.split()] for vertex in asked["vertices"]]
    yield "# OBJ"
    yield from (f"v {' '.join(vertex)}" for vertex in vertices)
    yield from (f"f {' '.join(str(corner + 1) for corner in triangle)}" for triangle in asked["triangles"])
    if at < len(asked["rays"]):
        words = asked["rays"][at].split()
        o, d, ends = (list(map(number, it)) for it in (words[:3], words[3:6], words[6:]))
        yield f"# ray {at}: origin {' '.join(o)}, direction {' '.join(d)}, from {ends[0]} to {ends[1]}"
        yield f"# ray {at}: {asked['rays'][at]}"
        yield f"v {' '.join(o)}"
        yield f"v {' '.join(str(float(x) + float(y)) for x, y in zip(o, d))}"
        yield f"l {len(vertices) + 1} {len(vertices) + 2}"

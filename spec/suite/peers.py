#!/usr/bin/env python3
"""Writes PEERS.md: what ray tracers answer to the level `ray`, by case.

usage: peers.py STACKLESS PYTHON LIBSTACKLESS > PEERS.md

STACKLESS is the command, built with `cargo build --release --features peers`; it loads the Embree that EMBREE_LIBRARY
names, the library in the package embreex. PYTHON has embreex and open3d.
LIBSTACKLESS is the adapter crates/capi/tests/conform.cpp, compiled.
"""

import collections
import json
import pathlib
import subprocess
import sys

IMPLEMENTATIONS = {
    "exact": ["--accuracy", "exact"],
    # The last argument.
    "libstackless": None,
    "precise": ["--accuracy", "precise"],
    "watertight": ["--accuracy", "watertight"],
    "fast": ["--accuracy", "fast"],
    "embree, robust": ["--peer", "embree-robust"],
    "embree": ["--peer", "embree"],
    "bvh": ["--peer", "bvh"],
    "parry3d": ["--peer", "parry3d"],
    "obvhs, two-wide": ["--peer", "obvhs-bvh2"],
    "obvhs, eight-wide": ["--peer", "obvhs-cwbvh"],
    # Of PyPI, by adapters/tracers.py.
    "embreex, robust": "embreex-robust",
    "embreex": "embreex",
    "open3d": "open3d",
}
HERE = pathlib.Path(__file__).parent
NOT_ASKED = "not asked"
PROFILES = ("grid", "exact", "watertight", "parity", "ulp-8", "ulp-256")

TEXT = """\
# Results of ray tracers on the level `ray`

[peers.py](peers.py) writes this page. The rows `exact`, `precise`, `watertight` and `fast` are this library, with different triangle tests.
`libstackless` is its C interface, by [conform.cpp](../../crates/capi/tests/conform.cpp). The other tracers do not promise exact answers.
`embree` is Embree 4.4.0, asked through its C interface. `embreex` 4.4.0 and `open3d` 0.20.0 are packages of PyPI that contain Embree;
[adapters/tracers.py](adapters/tracers.py) asks them. `bvh`, `parry3d` and `obvhs` are crates, with the versions of
[Cargo.lock](../../Cargo.lock).

| word | meaning |
|---|---|
| wrong hit | another triangle, a hit instead of a miss, or a miss instead of a hit |
| wrong number | the right triangle, and t is not exact to the bit; for this library, which claims the feature `weights`, t, u or v |
| passed | the case has no wrong hit and no wrong number |
| refused | the implementation does not support the depth of the tree, or the interval of the rays |
| ended | the process ended without an answer |

The profiles `watertight`, `parity` and `ulp-N` require only what tracers that round can promise. `parity` needs a tracer that counts
crossings.
"""


class Rays(collections.namedtuple("Rays", "asked hits numbers none", defaults=(0, 0, ""))):
    """How many rays have another hit, or only other numbers; or why there is no answer."""

    def passes(self):
        return not (self.hits or self.numbers or self.none)

    def __str__(self):
        return "" if self.passes() or self.none == NOT_ASKED else self.none or f"{self.hits} + {self.numbers}"


def answers(command, cases):
    """What is answered to each case, and hello. Some do not survive a case: they are started again for the next."""
    said, hello = {}, None
    while len(said) < len(cases):
        asks = [
            {"cmd": "case", "seq": seq, "level": "ray", "profile": profile, "input": case["input"]}
            for seq, (profile, case) in enumerate(cases)
            if seq not in said
        ]
        lines = "".join(json.dumps(line) + "\n" for line in ({"cmd": "hello", "protocol": 1}, *asks, {"cmd": "bye"}))
        ran = subprocess.run(command, input=lines, capture_output=True, text=True, check=False)
        hello, *replies = [json.loads(line) for line in ran.stdout.splitlines()]
        said.update({reply["seq"]: reply for reply in replies})
        if len(said) < len(cases):
            said[min(set(range(len(cases))) - set(said))] = {}
    return hello, [said[seq] for seq in range(len(cases))]


def compare(expect, said, has_weights):
    """Of `near` the distance is a number, and any of its triangles right."""
    near = expect.get("near")
    expected = near["hits"] if near else expect["result"]["hits"]
    if "result" not in said:
        return Rays(len(expected), none="refused" if "unsupported" in said else "ended")
    if near:
        rays = list(zip(expected, said["result"]["hits"], strict=True))
        hits = sum((a is None) != (b is None) or a is not None and b["prim"] not in a["prims"] for a, b in rays)
        both = [(a, b) for a, b in rays if a and b and b["prim"] in a["prims"]]
        return Rays(len(expected), hits, sum(abs(int(a["t"], 16) - int(b["t"], 16)) > near["ulps"] for a, b in both))

    def triangle(hit):
        return hit["prim"] if isinstance(hit, dict) else hit

    def numbers(hit):
        if not isinstance(hit, dict):
            return hit
        # Zeros of either sign are one.
        return [hit["prim"], *(hit[name].replace("80000000", "00000000") for name in ("tuv" if has_weights else "t"))]

    rays = list(zip(expected, said["result"]["hits"], strict=True))
    hits = sum(triangle(a) != triangle(b) for a, b in rays)
    return Rays(len(expected), hits, sum(numbers(a) != numbers(b) for a, b in rays) - hits)


def group(case):
    """The column of the summary."""
    _, profile, name = case.split("/")
    part = name.split("-")[0]
    return f"`grid`: {part if part in ('inside', 'edges') else 'ends'}" if profile == "grid" else f"`{profile}`"


def command_of(args):
    if args is None:
        return [sys.argv[3]]
    if isinstance(args, str):
        return [sys.argv[2], str(HERE / "adapters/tracers.py"), args]
    return [sys.argv[1], "suite", "serve", *args]


def row(cells):
    print("|", " | ".join(str(cell) for cell in cells), "|")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    vectors = HERE / "vectors/ray"
    profiles = {profile: json.loads((vectors / f"{profile}.json").read_text()) for profile in PROFILES}
    cases = [(profile, case) for profile, file in profiles.items() for case in file["cases"]]
    found = {name: {} for name in IMPLEMENTATIONS}
    for name, args in IMPLEMENTATIONS.items():
        print(f"{name} ...", file=sys.stderr)
        hello, said = answers(command_of(args), cases)
        for (profile, case), reply in zip(cases, said, strict=True):
            rays = compare(case["expect"], reply, "weights" in hello["features"])
            is_asked = f"ray/{profile}" in hello["profiles"]
            found[name][case["id"]] = rays if is_asked else Rays(rays.asked, none=NOT_ASKED)

    ids = [case["id"] for _, case in cases]
    sizes = collections.Counter(map(group, ids))
    rays = sum(rays.asked for rays in found["exact"].values())
    print(TEXT)
    passed = (f"{name}: passed of {size}" for name, size in sizes.items())
    row(["", *passed, "refused", "ended", f"wrong hits, of {rays} rays", "wrong numbers"])
    row(["---", *("---:" for _ in range(len(sizes) + 4))])
    for name, results in found.items():
        passed = collections.Counter(group(id) for id, rays in results.items() if rays.passes())
        none = [sum(rays.none == why for rays in results.values()) for why in ("refused", "ended")]
        wrong = [sum(getattr(rays, field) for rays in results.values()) for field in ("hits", "numbers")]
        not_asked = {group(id) for id, rays in results.items() if rays.none == NOT_ASKED}
        row([name, *("" if part in not_asked else passed[part] for part in sizes), *none, *wrong])
    print("\nEach cell gives the rays with wrong hits + the rays with wrong numbers. A cell without any is empty.\n")
    row(["case", "rays", *list(found)[1:]])
    row(["---", "---:", *(":---:" for _ in list(found)[1:])])
    for id in ids:
        row([f"`{id}`", found["exact"][id].asked, *(str(results[id]) for results in list(found.values())[1:])])


if __name__ == "__main__":
    main()

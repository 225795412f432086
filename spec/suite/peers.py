#!/usr/bin/env python3
"""Writes PEERS.md: what ray tracers answer to the level `ray`, by case.

usage: peers.py STACKLESS > PEERS.md

STACKLESS is the command, built with `cargo build --release --features peers`.
"""

import collections
import json
import pathlib
import subprocess
import sys

IMPLEMENTATIONS = {
    "exact": ["--accuracy", "exact"],
    "precise": ["--accuracy", "precise"],
    "watertight": ["--accuracy", "watertight"],
    "fast": ["--accuracy", "fast"],
    "embree, robust": ["--peer", "embree-robust"],
    "embree": ["--peer", "embree"],
    "bvh": ["--peer", "bvh"],
    "parry3d": ["--peer", "parry3d"],
    "obvhs, two-wide": ["--peer", "obvhs-bvh2"],
    "obvhs, eight-wide": ["--peer", "obvhs-cwbvh"],
}

TEXT = """\
# What ray tracers answer to the level `ray`

Made by [peers.py](peers.py). The first four are this library by its tests of triangles; of the others none promises what is asked
here. Versions as in the [record of benchmarks](../../benches/records/2026-11-21-trees.md); Embree is that of Debian, which has
assertions on.

A hit is wrong if another triangle is hit, or none, or some. Numbers are wrong if only t is not exact to the bit; for the tests of
this library, which claim the feature `weights`, if t, u or v is not. A case is passed if none of its rays is answered wrongly, refused
if an implementation says so (that its trees have not so many levels), and ended if its process ends without an answer.
"""


class Rays(collections.namedtuple("Rays", "asked hits numbers none", defaults=(0, 0, ""))):
    """How many rays have another hit, or only other numbers; or why there is no answer."""

    def passes(self):
        return not (self.hits or self.numbers or self.none)

    def __str__(self):
        return "" if self.passes() else self.none or f"{self.hits} + {self.numbers}"


def answer(command, profile, case):
    """A process of its own for each case: some do not survive them."""
    ask = {"cmd": "case", "seq": 1, "level": "ray", "profile": profile, "input": case["input"]}
    lines = "".join(json.dumps(line) + "\n" for line in ({"cmd": "hello", "protocol": 1}, ask, {"cmd": "bye"}))
    ran = subprocess.run(command, input=lines, capture_output=True, text=True, check=False)
    hello, *answers = [json.loads(line) for line in ran.stdout.splitlines()]
    said = next((it for it in answers if it.get("seq") == 1), {})
    return said, "weights" in hello["features"]


def compare(expected, said, has_weights):
    if "result" not in said:
        return Rays(len(expected), none="refused" if "unsupported" in said else "ended")

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
    return f"`grid`: {name.split('-')[0]}" if profile == "grid" else "`exact`"


def row(cells):
    print("|", " | ".join(str(cell) for cell in cells), "|")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    vectors = pathlib.Path(__file__).parent / "vectors/ray"
    profiles = {profile: json.loads((vectors / f"{profile}.json").read_text()) for profile in ("grid", "exact")}
    cases = [(profile, case) for profile, file in profiles.items() for case in file["cases"]]
    found = {name: {} for name in IMPLEMENTATIONS}
    for name, args in IMPLEMENTATIONS.items():
        print(f"{name} ...", file=sys.stderr)
        for profile, case in cases:
            expected = case["expect"]["result"]["hits"]
            found[name][case["id"]] = compare(expected, *answer([sys.argv[1], "suite", "serve", *args], profile, case))

    ids = [case["id"] for _, case in cases]
    sizes = collections.Counter(map(group, ids))
    rays = sum(rays.asked for rays in found["exact"].values())
    print(TEXT)
    passed = (f"{name}: passed of {size}" for name, size in sizes.items())
    row(["", *passed, "refused", "ended", f"wrong hits, of {rays} answers", "wrong numbers"])
    row(["---", *("---:" for _ in range(len(sizes) + 4))])
    for name, results in found.items():
        passed = collections.Counter(group(id) for id, rays in results.items() if rays.passes())
        none = [sum(rays.none == why for rays in results.values()) for why in ("refused", "ended")]
        wrong = [sum(getattr(rays, field) for rays in results.values()) for field in ("hits", "numbers")]
        row([name, *(passed[part] for part in sizes), *none, *wrong])
    print("\nRays with wrong hits + rays with wrong numbers, where there are any:\n")
    row(["case", "rays", *list(found)[1:]])
    row(["---", "---:", *(":---:" for _ in list(found)[1:])])
    for id in ids:
        row([f"`{id}`", found["exact"][id].asked, *(str(results[id]) for results in list(found.values())[1:])])


if __name__ == "__main__":
    main()

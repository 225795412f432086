"""Load: threads query shared scenes for a long time while they build, refit, save and load scenes.

    python soak.py --minutes 30 --csv soak.csv

One thread records the answers first. Every later answer must have the same bits. The program fails if an answer
differs, if a thread makes no progress for `--stall` seconds, or if memory grows: after a warm-up of a tenth of the
time, the median of the last third may exceed that of the first third by `MARGIN`.
"""

import argparse
import copy
import csv
import ctypes
import faulthandler
import os
import pickle
import random
import resource
import sys
import tempfile
import threading
import time
import traceback
from collections import Counter

import numpy as np

from stackless_bvh import Instances, Scene

THREADS, RAYS = 8, 600
# In MiB, of resident and of used memory. Freed heap memory stays resident, so resident memory settles late.
MARGIN = (16, 1)
# All threads of the pool, the calling thread only, one row.
ROWS = [slice(0, RAYS), slice(100, 140), slice(7, 8)]
BUILDS = ["standard", "best", "sbvh", "bounded", "median"]
AGAIN = ["build", "save_and_load", "pickle", "copy_and_refit"]


def rule(scene):
    return "parity" if scene.is_closed else "winding"


# Queries of rays from `o` along `d`, and of the points `o + d`. Instances have the first four queries too.
QUERIES = {
    "closest": lambda s, o, d: s.closest(o, d),
    "any": lambda s, o, d: s.any(o, d, tmax=0.5),
    "all_hits": lambda s, o, d: s.all_hits(o, d),
    "count_crossings": lambda s, o, d: s.count_crossings(o, d),
    "contains": lambda s, o, d: s.contains(o + d, rule=rule(s)),
    "nearest": lambda s, o, d: s.nearest(o + d, k=3, details=True),
    "signed_distance": lambda s, o, d: s.signed_distance(o + d, rule=rule(s)),
    "winding_number": lambda s, o, d: s.winding_number(o + d),
    "segments": lambda s, o, d: s.segments(o, o + d).closest(),
    "continue_with": lambda s, o, d: s.closest(o, d).continue_with(-d).closest(),
    "toward": lambda s, o, d: s.closest(o, d).toward(o[::-1] + 3).any(),
}
# Queries that call twice: no other thread may refit the scene between the calls.
TWO_CALLS = {"continue_with", "toward"}


def surface(place, n=32):
    """A closed surface of n by n cells. Its coordinates are multiples of 1/256: exact in both precisions."""
    row, column = np.divmod(np.arange((n + 1) ** 2), n + 1)
    vertices = np.round(256 * np.stack(place(2 * np.pi * (row % n) / n, np.pi * column / n), axis=1)) / 256
    index = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (index[i : n + i, j : n + j].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return vertices, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def torus(u, v):
    away = 2 + np.cos(2 * v)
    return away * np.cos(u), away * np.sin(u), np.sin(2 * v)


def folded(u, v):
    away = 2 + 0.9 * np.sin(v) * np.cos(7 * u) * np.cos(6 * v)
    return away * np.sin(v) * np.cos(u), away * np.sin(v) * np.sin(u), away * np.cos(v)


def soup(numbers, count=800):
    corners = numbers.integers(-512, 512, (count, 1, 3)) + numbers.integers(-99, 99, (count, 3, 3))
    return corners.reshape(-1, 3) / 256, np.arange(3 * count).reshape(-1, 3)


def answer(query, scene, rays, rows):
    made = QUERIES[query](scene, rays[0][rows], rays[1][rows])
    arrays = [made] if isinstance(made, np.ndarray) else vars(made).values()
    return b"".join(array.tobytes() for array in arrays if isinstance(array, np.ndarray))


class Soak:
    def __init__(self, folder):
        numbers = np.random.default_rng(1)
        self.folder, self.stop, self.failures = folder, threading.Event(), []
        self.meshes, self.rays = {}, {}
        for shape, (vertices, faces) in {
            "torus": surface(torus), "folded": surface(folded), "soup": soup(numbers),
        }.items():  # fmt: skip
            origins = numbers.integers(-768, 768, (RAYS, 3)) / 256
            ways = numbers.integers(-768, 768, (RAYS, 3)) / 256
            # Half of the rays meet vertices at t = 1.
            ways[::2] = vertices[numbers.integers(0, len(vertices), RAYS // 2)] - origins[::2]
            for dtype in ("float32", "float64"):
                self.rays[shape, dtype] = origins.astype(dtype), ways.astype(dtype)
                for state, moved in enumerate((vertices, 1.5 * vertices + 0.25)):
                    self.meshes[shape, dtype, state] = moved.astype(dtype), faces
        self.scenes = {mesh: Scene(*arrays) for mesh, arrays in self.meshes.items()}
        self.maps = np.tile(np.eye(4, dtype=np.float32), (9, 1, 1))
        self.maps[:, :3] += numbers.uniform(-0.25, 0.25, (9, 3, 4)).astype(np.float32)
        self.scenes["instances", "float32", 0] = self.placed()
        self.rays["instances", "float32"] = self.rays["folded", "float32"]
        self.answers = {
            (mesh, query, i): answer(query, scene, self.rays[mesh[:2]], rows)
            for mesh, scene in self.scenes.items()
            for query in list(QUERIES)[: 4 if mesh[0] == "instances" else None]
            for i, rows in enumerate(ROWS)
        }
        self.cases = {mesh: [case for case in self.answers if case[0] == mesh] for mesh in self.scenes}
        # Scenes that are refitted while they are queried. A version is odd during a refit; its half is the state.
        self.moving = {mesh[:2]: copy.copy(self.scenes[mesh]) for mesh in self.meshes if mesh[2] == 0}
        self.versions, self.locks = dict.fromkeys(self.moving, 0), {mesh: threading.Lock() for mesh in self.moving}
        names = [*QUERIES, "refit", "place", *AGAIN, "refused_query", "refused_refit"]
        self.counts = [dict.fromkeys(names, 0) for _ in range(THREADS)]
        self.seen = [time.monotonic()] * THREADS

    def placed(self):
        scenes = [self.scenes[shape, "float32", 0] for shape in ("torus", "folded")]
        return Instances(scenes, np.arange(len(self.maps)) % 2, self.maps)

    def again(self, way, mesh, draw):
        """Returns the scene of a mesh, created again."""
        if way == "build":
            return Scene(*self.meshes[mesh], build=draw.choice(BUILDS))
        if way == "save_and_load":
            # Threads save to a file that other threads load.
            path = os.path.join(self.folder, "-".join(map(str, mesh)))
            self.scenes[mesh].save(path)
            return Scene.load(path)
        if way == "copy_and_refit":
            scene = copy.copy(self.scenes[(*mesh[:2], 1 - mesh[2])])
            scene.refit(self.meshes[mesh][0])
            return scene
        return pickle.loads(pickle.dumps(self.scenes[mesh]))

    def work(self, number):
        draw, count = random.Random(number), self.counts[number]
        try:
            while not self.stop.is_set():
                action = draw.choices(["query", "moving", "refit", "again"], [70, 22, 3, 5])[0]
                mesh = draw.choice(list(self.scenes))
                if action == "query":
                    self.check(draw, count, mesh, self.scenes[mesh])
                elif action == "moving":
                    self.query_moving(draw, count)
                elif action == "refit":
                    self.refit(draw, count)
                elif mesh in self.meshes:
                    way = draw.choice(AGAIN)
                    self.check(draw, count, mesh, self.again(way, mesh, draw))
                    count[way] += 1
                else:
                    self.check(draw, count, mesh, self.placed())
                    count["place"] += 1
                self.seen[number] = time.monotonic()
        except BaseException:
            self.failures.append(traceback.format_exc())
            self.stop.set()

    def check(self, draw, count, mesh, scene, states=None):
        """Compares an answer with the recorded answer for the mesh, or with those for several states of the mesh."""
        _, query, i = draw.choice([case for case in self.cases[mesh] if not states or case[1] not in TWO_CALLS])
        found = answer(query, scene, self.rays[mesh[:2]], ROWS[i])
        states = states() if states else [mesh[2]]
        count[query] += 1
        if not any(found == self.answers[(*mesh[:2], state), query, i] for state in states):
            raise AssertionError(f"WRONG ANSWER: {query}, {ROWS[i]}, of {mesh}, states {states}")

    def query_moving(self, draw, count):
        mesh = draw.choice(list(self.moving))
        before = self.versions[mesh]

        def states():
            return [before // 2 % 2] if before % 2 == 0 and self.versions[mesh] == before else [0, 1]

        try:
            self.check(draw, count, (*mesh, 0), self.moving[mesh], states)
        except RuntimeError as error:
            if str(error) != "Already mutably borrowed":
                raise
            count["refused_query"] += 1

    def refit(self, draw, count):
        mesh = draw.choice(list(self.moving))
        with self.locks[mesh]:
            self.versions[mesh] += 1
            vertices, _ = self.meshes[(*mesh, (self.versions[mesh] + 1) // 2 % 2)]
            try:
                self.moving[mesh].refit(vertices, optimize=draw.random() < 0.3)
                self.versions[mesh] += 1
                count["refit"] += 1
            except RuntimeError as error:
                if str(error) != "Already borrowed":
                    raise
                self.versions[mesh] -= 1
                count["refused_refit"] += 1


class Heap(ctypes.Structure):
    """The result of `mallinfo2` of glibc."""

    _fields_ = [(name, ctypes.c_size_t) for name in "arena 1 2 3 mapped 5 6 used 8 9".split()]


def memory():
    """Returns, in KiB, the resident memory, and the memory that is allocated and not freed."""
    with open("/proc/self/statm") as statm:
        pages = int(statm.read().split()[1])
    heap = MALLINFO()
    return pages * resource.getpagesize() // 1024, (heap.used + heap.mapped) // 1024


def growth(samples):
    """Returns, in MiB, the median of the last third less that of the first third, after the warm-up."""
    samples = samples[len(samples) // 10 :]
    third = len(samples) // 3
    return (np.median(samples[-third:], axis=0) - np.median(samples[:third], axis=0)) / 1024


MALLINFO = ctypes.CDLL(None).mallinfo2
MALLINFO.restype = Heap


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--csv", default=os.devnull, help="a line for each second: memory, and how many calls ended")
    parser.add_argument("--stall", type=float, default=60, help="seconds, more on a busy machine")
    options = parser.parse_args()
    # A thread in C detects a hang even if no Python thread can run. The recording is slow on a busy machine.
    faulthandler.dump_traceback_later(5 * options.stall, exit=True)
    with tempfile.TemporaryDirectory() as folder, open(options.csv, "w", newline="") as file:
        soak, samples, start = Soak(folder), [], time.monotonic()
        soak.seen = [start] * THREADS
        threads = [threading.Thread(target=soak.work, args=[i], daemon=True) for i in range(THREADS)]
        for thread in threads:
            thread.start()
        rows = csv.writer(file)
        rows.writerow(["seconds", "resident_kib", "used_kib", *soak.counts[0]])
        while any(thread.is_alive() for thread in threads):
            faulthandler.dump_traceback_later(options.stall + 5, exit=True)
            time.sleep(1)
            now = time.monotonic()
            if any(now - seen > options.stall for seen, thread in zip(soak.seen, threads) if thread.is_alive()):
                print(f"DEADLOCK: no progress for {options.stall:.0f} s", file=sys.stderr)
                faulthandler.dump_traceback()
                os._exit(1)
            samples.append(memory())
            total = sum(map(Counter, soak.counts), Counter())
            rows.writerow([round(now - start), *samples[-1], *(total[name] for name in soak.counts[0])])
            file.flush()
            if now - start > 60 * options.minutes:
                soak.stop.set()
        faulthandler.cancel_dump_traceback_later()
    if soak.failures:
        sys.exit("\n".join(soak.failures))
    print(*(f"{name} {total[name]:,}" for name in soak.counts[0]), sep="\n")
    if len(samples) < 60:
        print("memory: not judged in less than a minute")
        return
    for kind, grown, margin in zip(("resident", "used"), growth(samples), MARGIN):
        print(f"{kind} memory: grown by {grown:.2f} MiB")
        if grown > margin:
            sys.exit(f"MEMORY GROWS: {kind}, by {grown:.2f} MiB, expected at most {margin}")


if __name__ == "__main__":
    main()

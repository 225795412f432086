"""Compares speed and wrong answers with trimesh, embreex and Open3D, as tables in Markdown.

    python bench.py [MESH...] [--rays N] [--judged N] [--points N] [--triangles N]

Meshes are files that trimesh reads; the default is a generated sphere. --triangles first prints memory and times of a
height field with N triangles. Engines that are not installed are omitted. All engines get equal float32 numbers.
Rational arithmetic (`tests/oracle.py`) judges a sample of the answers. Times are of whole calls from NumPy to NumPy on
all threads, the best of three.
"""

from __future__ import annotations

import argparse
import resource
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import trimesh
from trimesh.ray.ray_triangle import RayMeshIntersector as Native

# Replaces this folder, so that the installed package is imported and not its source.
sys.path[0] = str(Path(__file__).parent / "tests")
import oracle  # noqa: E402

from stackless_bvh import Scene  # noqa: E402

# Engines with fewer queries, and their number of rays.
SLOW = {"trimesh native": 200}
RANDOM = np.random.default_rng(2026)


class Exact:
    """This library."""

    def __init__(self, vertices, faces, dtype=np.float32):
        self.dtype, self.scene = dtype, Scene(vertices.astype(dtype), faces)

    def closest(self, origins, directions):
        return self.scene.closest(origins.astype(self.dtype), directions.astype(self.dtype)).primitive

    def crossings(self, origins, directions):
        return self.scene.count_crossings(origins.astype(self.dtype), directions.astype(self.dtype))

    def contains(self, points):
        return self.scene.contains(points.astype(self.dtype))


class Exact64(Exact):
    """This library in double precision."""

    def __init__(self, vertices, faces):
        super().__init__(vertices, faces, np.float64)


class Trimesh:
    """An intersector of trimesh. Its crossings are the locations that it returns."""

    def __init__(self, vertices, faces, kind=Native):
        self.mesh = trimesh.Trimesh(vertices.astype(np.float64), faces, process=False)
        self.mesh.ray = kind(self.mesh)

    def closest(self, origins, directions):
        return self.mesh.ray.intersects_first(origins, directions)

    def crossings(self, origins, directions):
        _, rays, _ = self.mesh.ray.intersects_location(origins, directions)
        return np.bincount(rays, minlength=len(origins))

    def contains(self, points):
        return self.mesh.contains(points)


class Open3D:
    """Open3D's RaycastingScene, which uses Embree."""

    def __init__(self, vertices, faces):
        self.tensor = lambda array: open3d.core.Tensor(np.ascontiguousarray(array))
        self.scene = open3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(self.tensor(vertices), self.tensor(faces.astype(np.uint32)))

    def closest(self, origins, directions):
        hits = self.scene.cast_rays(self._rays(origins, directions))
        prims = hits["primitive_ids"].numpy().astype(np.int64)
        return np.where(np.isinf(hits["t_hit"].numpy()), -1, prims)

    def crossings(self, origins, directions):
        return self.scene.count_intersections(self._rays(origins, directions)).numpy()

    def contains(self, points):
        return self.scene.compute_occupancy(self.tensor(points)).numpy() > 0.5

    def _rays(self, origins, directions):
        return self.tensor(np.concatenate([origins, directions], axis=1).astype(np.float32))


ENGINES = {"exact float32": Exact, "exact float64": Exact64, "trimesh native": Trimesh}
try:
    from trimesh.ray.ray_pyembree import RayMeshIntersector as Embreex

    ENGINES["trimesh embreex"] = lambda vertices, faces: Trimesh(vertices, faces, Embreex)
except BaseException:  # The exception is wrapped, with any type.
    print("embreex is not installed", file=sys.stderr)
try:
    import open3d

    ENGINES["Open3D"] = Open3D
except (ImportError, OSError) as error:
    print(f"Open3D is not installed: {error}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--rays", type=int, default=200_000, help="rays of each kind that are timed")
    parser.add_argument("--judged", type=int, default=200, help="rays of each kind that are judged")
    parser.add_argument("--points", type=int, default=1_000_000, help="points that are asked for their inside")
    parser.add_argument("--triangles", type=int, help="measure memory with a height field of so many")
    arguments = parser.parse_args()
    if arguments.triangles:
        memory_table(arguments.triangles)
    meshes = {path.stem: loaded(path) for path in arguments.meshes}
    meshes = meshes or {"icosphere": arrays(trimesh.creation.icosphere(6))}
    print("Rays a second, in thousands; wrong answers of", arguments.judged, "and hits that are lost among them\n")
    print("| mesh | rays |", " | ".join(f"{name} | wrong, lost" for name in ENGINES), "|")
    print("|---|---|" + "---:|" * 2 * len(ENGINES))
    for name, (vertices, faces) in meshes.items():
        closest_table(name, vertices, faces, arguments.rays, arguments.judged)
    print("\nLeaks, odd crossings from outside, and wrong insides, of a closed sphere\n")
    sphere_table(arguments.points)


def closest_table(name, vertices, faces, count, judged):
    """Prints a row for each kind of rays."""
    engines = {engine: make(vertices, faces) for engine, make in ENGINES.items()}
    for kind, (origins, directions) in rays(vertices, faces, count).items():
        truth = [nearest_faces(vertices, faces, o, d) for o, d in zip(origins[:judged], directions[:judged])]
        cells = []
        for engine, asked in engines.items():
            few = slice(0, SLOW.get(engine, count))
            seconds, found = best(lambda: asked.closest(origins[few], directions[few]))
            judgements = list(zip(found.tolist(), truth))
            wrong = sum(answer not in right for answer, right in judgements)
            lost = sum(answer == -1 and answer not in right for answer, right in judgements)
            cells += [f"{len(origins[few]) / seconds / 1000:,.3g}", f"{wrong}, {lost}"]
        print(f"| {name} | {kind} |", " | ".join(cells), "|", flush=True)


def rays(vertices, faces, count):
    """Returns origins and directions in float32: across the box, and at vertices and middles of edges."""
    lo, hi = vertices.min(axis=0), vertices.max(axis=0)
    middle, size = (lo + hi) / 2, np.linalg.norm(hi - lo)
    around = RANDOM.normal(size=(count, 3))
    origins = (middle + size * around / np.linalg.norm(around, axis=1)[:, np.newaxis]).astype(np.float32)
    corners = vertices[faces[RANDOM.integers(0, len(faces), count)]]
    aims = corners[:, 0].copy()
    aims[::2] = (corners[::2, 0] + corners[::2, 1]) / np.float32(2)
    across = RANDOM.uniform(lo, hi, (count, 3)).astype(np.float32)
    # Origins on a coarse grid, so that differences of float32 are often exact and rays hit their targets.
    coarse = np.round(origins / size * 64).astype(np.float32) * np.float32(2.0 ** np.round(np.log2(size)) / 64)
    return {"across the box": (origins, across - origins), "at vertices and edges": (coarse, aims - coarse)}


def nearest_faces(vertices, faces, origin, direction):
    """Returns the faces whose exact distance rounds to the least float32, or -1. Each of them is a right answer."""
    candidates = near_misses_and_hits(vertices, faces, origin, direction)
    found = oracle.all_hits(vertices, faces[candidates], origin, direction, dtype=np.float32)
    return {int(candidates[hit[1]]) for hit in found if hit[0] == found[0][0]} or {-1}


def near_misses_and_hits(vertices, faces, origin, direction):
    """Returns all faces that may be hit, by double precision with a wide margin."""
    a, b, c = vertices[faces].astype(np.float64).transpose(1, 0, 2)
    o, d = origin.astype(np.float64), direction.astype(np.float64)
    e1, e2, s = b - a, c - a, o - a
    p, q = np.cross(d, e2), np.cross(s, e1)
    det, u, v = (e1 * p).sum(1), (s * p).sum(1), (q * d).sum(1)
    sign, sizes = np.sign(det), np.linalg.norm(d) * np.linalg.norm(s, axis=1)
    margin = 1e-9 * sizes * np.maximum(np.linalg.norm(e1, axis=1), np.linalg.norm(e2, axis=1))
    u, v, det = u * sign, v * sign, np.abs(det)
    return np.flatnonzero(((u >= -margin) & (v >= -margin) & (u + v <= det + margin)) | (det <= margin))


def sphere_table(points):
    """Counts impossible answers for a closed mesh, and wrong answers of `contains` for points far from the mesh."""
    vertices, faces = arrays(trimesh.creation.icosphere(5))
    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    aims = np.concatenate([vertices, (vertices[edges[:, 0]] + vertices[edges[:, 1]]) / np.float32(2)])
    # Float32 rounds these directions, but not enough for a ray to miss the sphere.
    inside = np.zeros_like(aims)
    inside[1::2] = RANDOM.uniform(-0.25, 0.25, (len(aims) // 2, 3)).astype(np.float32)
    outside = (-3 * aims).astype(np.float32)
    inner = np.linalg.norm(vertices[faces].mean(axis=1), axis=1).min() * 0.999
    asked, truth = sphere_points(aims, points, inner)
    print(f"| engine | leaks of {len(aims)} | odd of {len(aims)} | wrong insides | of points | seconds |")
    print("|---|---:|---:|---:|---:|---:|")
    for engine, make in ENGINES.items():
        few, made = slice(None, None, 50 if engine in SLOW else 1), make(vertices, faces)
        leaks = (made.closest(inside[few], (aims - inside)[few]) < 0).sum()
        odd = (made.crossings(outside[few], aims[few]) % 2 == 1).sum()
        seconds, found = best(lambda: made.contains(asked[few]), 1 if engine in SLOW else 3)
        of = f" of {len(aims[few])}" if engine in SLOW else ""
        wrong = (found != truth[few]).sum()
        print(f"| {engine} | {leaks}{of} | {odd}{of} | {wrong} | {len(asked[few]):,} | {seconds:.3g} |", flush=True)


def sphere_points(aims, count, inner):
    """Returns points that are certainly inside or outside the unit sphere of triangles. Half of them are on lines from
    its centre to vertices and middles of edges."""
    scale = np.where(RANDOM.random(count) < 0.5, RANDOM.uniform(0.05, 0.9, count), RANDOM.uniform(1.1, 2, count))
    lines = aims[RANDOM.integers(0, len(aims), count)] * scale[:, np.newaxis]
    anywhere = RANDOM.uniform(-1.2, 1.2, (count, 3))
    both = np.where(np.arange(count)[:, np.newaxis] % 2 == 0, lines, anywhere).astype(np.float32)
    radius = np.linalg.norm(both.astype(np.float64), axis=1)
    known = (radius < inner) | (radius > 1.001)
    return both[known], radius[known] < inner


def memory_table(triangles):
    """Measures memory and time of a large scene, before other work of this process."""
    side = int((triangles / 2) ** 0.5) + 1
    x, y = np.meshgrid(np.linspace(0, 1, side, dtype=np.float32), np.linspace(0, 1, side, dtype=np.float32))
    z = np.float32(0.05) * (np.sin(40 * x) * np.cos(30 * y)).astype(np.float32)
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(side - 1)[:, np.newaxis] * side + np.arange(side - 1)).astype(np.uint32).reshape(-1, 1)
    faces = np.concatenate([corner + np.uint32([0, 1, side]), corner + np.uint32([1, side + 1, side])])
    row = lambda what, number: print(f"| {what} | {number} |", flush=True)
    row(
        f"height field of {len(faces):,} triangles, float32: arrays",
        f"{(vertices.nbytes + faces.nbytes) / 2**20:.0f} MiB",
    )
    print("|---|---:|")
    seconds, scene = best(lambda: Scene(vertices, faces), 1)
    row("building", f"{seconds:.1f} s")
    mesh, bvh = scene._native.bytes
    row("`Scene.nbytes`: mesh and hierarchy", f"{mesh / 2**20:.0f} + {bvh / 2**20:.0f} MiB")
    row("peak of the process while building", f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10:,.0f} MiB")
    asked = rays(vertices, faces, 1_000_000)["across the box"]
    row("`closest`, rays across", f"{1000 / best(lambda: scene.closest(*asked), 1)[0]:,.0f} thousand a second")
    row("`is_closed`, the first time", f"{best(lambda: scene.is_closed, 1)[0]:.1f} s")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene"
        seconds, _ = best(lambda: scene.save(path), 1)
        row(f"`save`, {path.stat().st_size / 2**20:.0f} MiB", f"{seconds:.1f} s")
        row("`load`, with all checks", f"{best(lambda: Scene.load(path), 1)[0]:.1f} s")
    print()


def best(do, times=3):
    """Returns the least time, and the result."""
    seconds = []
    for _ in range(times):
        begin = time.perf_counter()
        found = do()
        seconds.append(time.perf_counter() - begin)
    return min(seconds), found


def loaded(path):
    return arrays(trimesh.load(path, process=False, force="mesh"))


def arrays(mesh):
    return mesh.vertices.view(np.ndarray).astype(np.float32), mesh.faces.view(np.ndarray).astype(np.int64)


if __name__ == "__main__":
    main()

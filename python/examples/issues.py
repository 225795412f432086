"""The inputs of bug reports about trimesh and Embree, and the answers of each library, as a table.

    python examples/issues.py

The files or numbers of some reports are not available. Their inputs are generated from the descriptions. A cell is the
number of wrong answers. The right answers follow from the shape, or from rational arithmetic.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import trimesh

sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[1] / "tests")]
import oracle  # noqa: E402

from bench import ENGINES  # noqa: E402

RANDOM = np.random.default_rng(1)


def float32(mesh):
    return mesh.vertices.view(np.ndarray).astype(np.float32), mesh.faces.view(np.ndarray).astype(np.int64)


def edge_middles(vertices, faces):
    ends = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    return (vertices[ends[:, 0]] + vertices[ends[:, 1]]) / np.float32(2)


def inside_on_lines():
    """Points on lines from the middle of a sphere through its vertices and middles of edges."""
    vertices, faces = float32(trimesh.creation.icosphere(4))
    aims = np.concatenate([vertices, edge_middles(vertices, faces)])
    scales = [0.3, 0.6, 0.9, 1.1, 1.5]
    points = np.concatenate([aims * np.float32(scale) for scale in scales])
    truth = np.repeat([scale < 1 for scale in scales], len(aims))
    return vertices, faces, lambda engine: (engine.contains(points) != truth).sum(), len(points)


def inside_along_the_ray():
    """Points from which trimesh's ray, in its fixed direction, goes through a vertex."""
    vertices, faces = float32(trimesh.creation.icosphere(4))
    way = np.array([0.4395064455, 0.617598629942, 0.652231566745])
    points = (vertices.astype(np.float64)[:, None] - way * np.array([0.05, 0.1, 0.3])[None, :, None]).reshape(-1, 3)
    radius = np.linalg.norm(points, axis=1)
    inner = np.linalg.norm(vertices[faces].mean(axis=1), axis=1).min() * 0.999
    known = (radius < inner) | (radius > 1.001)
    points, truth = points[known].astype(np.float32), radius[known] < inner
    return vertices, faces, lambda engine: (engine.contains(points) != truth).sum(), len(points)


def boxes():
    """From the middle of a box at the vertices of a greater one, through its own edges and vertices."""
    small = float32(trimesh.creation.box(extents=[40] * 3).subdivide_to_size(20))
    great = trimesh.creation.box(extents=[60] * 3).subdivide_to_size(20).vertices.view(np.ndarray).astype(np.float32)
    origins = np.zeros_like(great)
    return *small, lambda engine: (engine.closest(origins, great) < 0).sum(), len(great)


def crossings_of_edges():
    """How often rays from outside cross a sphere through opposite vertices: once in, once out."""
    vertices, faces = float32(trimesh.creation.icosphere(4))
    origins, ways = -3 * vertices, vertices
    return vertices, faces, lambda engine: (engine.crossings(origins, ways) != 2).sum(), len(vertices)


def backed_off():
    """From a little outside of each vertex back to it."""
    mesh = trimesh.creation.icosphere(3)
    vertices, faces = float32(mesh)
    normals = mesh.vertex_normals.astype(np.float32)
    origins = (vertices + np.float32(0.01) * normals).astype(np.float32)
    return vertices, faces, lambda engine: (engine.closest(origins, -normals) < 0).sum(), len(vertices)


def half_sphere():
    """From the middle of a sphere at all of its vertices and middles of edges."""
    vertices, faces = float32(trimesh.creation.icosphere(5))
    aims = np.concatenate([vertices, edge_middles(vertices, faces)])
    return vertices, faces, lambda engine: (engine.closest(np.zeros_like(aims), aims) < 0).sum(), len(aims)


def nested_cylinders():
    """Ten cylinders in each other; from the vertices of the fifth outwards through those of the sixth."""
    made = [trimesh.creation.cylinder(radius=r, height=10, sections=64) for r in range(1, 11)]
    vertices, faces = float32(trimesh.util.concatenate(made))
    fifth, sixth = (mesh.vertices.view(np.ndarray).astype(np.float32) for mesh in made[4:6])
    rim = np.hypot(*fifth[:, :2].T) > 1
    origins, ways = fifth[rim] * np.float32([1.05, 1.05, 0.9]), sixth[rim] - fifth[rim]
    ways[:, 2] = 0

    def wrong(engine):
        hit = engine.closest(origins, ways)
        first = np.linalg.norm(vertices[faces[hit]].mean(axis=1)[:, :2], axis=1)
        return ((hit < 0) | (first > 6.5)).sum()

    return vertices, faces, wrong, len(origins)


def slivers():
    """Skinny triangles, seen at less than a degree by rays that pass near them: what is hit, by rational arithmetic."""
    count = 2000
    base = RANDOM.uniform(-300, 300, (count, 3))
    along, aside = RANDOM.normal(size=(2, count, 3))
    along *= 10 / np.linalg.norm(along, axis=1)[:, None]
    aside *= 1 / np.linalg.norm(aside, axis=1)[:, None]
    triangles = np.stack([base, base + along, base + 0.9 * along + aside], axis=1).astype(np.float32)
    inside = triangles.mean(axis=1) + RANDOM.normal(size=(count, 3)) * 0.02
    tilt = np.cross(along, aside)
    ways = along * RANDOM.normal(size=(count, 1)) + aside * RANDOM.normal(size=(count, 1)) + tilt * 1e-3
    origins = (inside - ways * (500 / np.linalg.norm(ways, axis=1)[:, None])).astype(np.float32)
    ways = ways.astype(np.float32)
    # One triangle and one ray at a time, so that no other triangle is in the way.
    truth = np.array([oracle.all_hits(t, [(0, 1, 2)], o, d) != [] for t, o, d in zip(triangles, origins, ways)])

    def wrong(make):
        found = [
            make(t, np.array([[0, 1, 2]])).closest(o[None], d[None])[0] >= 0
            for t, o, d in zip(triangles, origins, ways)
        ]
        return (np.array(found) != truth).sum()

    return None, None, wrong, count


REPORTS = [
    ("trimesh 242, 85: `contains`, points on lines through vertices and edges", inside_on_lines),
    ("trimesh 242: `contains`, points from which trimesh's own ray meets a vertex", inside_along_the_ray),
    ("trimesh 1496: rays through edges and vertices of a box, lost", boxes),
    ("trimesh 2317, embree 188: rays through a sphere at vertices, not counted as two crossings", crossings_of_edges),
    ("trimesh 306: rays back to the vertices that they come from, lost", backed_off),
    ("embree 174: rays from inside of a sphere at vertices and edges, lost", half_sphere),
    ("embree 181: rays at vertices of nested cylinders, through the nearest one", nested_cylinders),
    ("embree 387, 423: skinny triangles seen at a slant, hit though missed or missed though hit", slivers),
]


def main():
    print("| input | answers |", " | ".join(ENGINES), "|")
    print("|---|---:|" + "---:|" * len(ENGINES))
    for title, made in REPORTS:
        vertices, faces, wrong, count = made()
        cells = [wrong(make if vertices is None else make(vertices, faces)) for make in ENGINES.values()]
        print(f"| {title} | {count:,} |", " | ".join(map(str, cells)), "|", flush=True)


if __name__ == "__main__":
    main()

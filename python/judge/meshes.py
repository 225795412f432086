"""Meshes of common kinds, and points that are hard to judge."""

from __future__ import annotations

import numpy as np
import trimesh

RANDOM = np.random.default_rng(59)
CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
BOX = np.array([corners for a, b, c, d in QUADS for corners in ([a, b, c], [a, c, d])])
# Maps integers to integers, and lines to lines, so that T-junctions stay exact.
SHEAR = np.array([[4, 1, -1], [-1, 3, 2], [2, -1, 5]])


def meshes(paths):
    """Yields kinds, vertices and faces."""
    ball, ball_faces = folded(3)
    small, small_faces = folded(2)
    small = np.round(small * 40) * 8
    singles = (np.float32, np.float64)
    for dtype in singles:
        yield "folded", ball.astype(dtype), ball_faces
    # Multiples of 8 on a grid, so that eighths of edges and quarters of faces are floats.
    coarse = np.round(ball * 40) * 8
    for dtype in singles:
        yield "folded, on a grid", coarse.astype(dtype), ball_faces
        yield "box with T-junctions", *t_junctions(dtype)
        yield "every face twice", small.astype(dtype), np.concatenate([small_faces, small_faces])
        for kind in ("overlapping boxes", "overlapping boxes, subnormal"):
            yield kind, *joined(sheared(CORNERS, dtype), sheared(CORNERS * 0.75 + 0.5, dtype))
        inner = joined((coarse, ball_faces), (np.round(small / 16) * 8, small_faces[:, ::-1]))
        inner = joined(inner, (np.round(small / 48) * 8, small_faces))
        yield "nested spheres", inner[0].astype(dtype), inner[1]
        # Float32 has steps of 1/2 there.
        yield "at 6.4e6", (ball * (1000 if dtype is np.float32 else 1) + 6.4e6).astype(dtype), ball_faces
    yield "times 1e-50", ball * 1e-50, ball_faces
    for dtype in singles:
        yield "open: one face missing", coarse.astype(dtype), ball_faces[1:]
        yield "open: box without a face", *sheared(CORNERS, dtype, BOX[1:])
        yield "open: crack of an ulp", *t_junctions(dtype, ulps=1)
        yield "open: crack of 64 ulps", *t_junctions(dtype, ulps=64)
    for path in paths:
        mesh = trimesh.load(path, process=False, force="mesh")
        for dtype in singles:
            yield path.stem, mesh.vertices.view(np.ndarray).astype(dtype), mesh.faces.view(np.ndarray).astype(np.int64)


def folded(levels):
    """A sphere with ridges, twisted about two axes until its sides overhang and meet."""
    vertices = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    faces = np.array(
        [[a, b, 4] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))] + [[1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]]
    )
    for _ in range(levels):
        vertices, faces = trimesh.remesh.subdivide(vertices, faces)
        vertices /= np.linalg.norm(vertices, axis=1, keepdims=True)
    vertices = vertices * (1 + 0.35 * np.sin(vertices @ RANDOM.normal(0, 4, (3, 3))).sum(axis=1, keepdims=True))
    for axis in (2, 0):
        x, y, z = (vertices[:, (axis + k) % 3].copy() for k in (1, 2, 0))
        angle = 1.5 * z + np.hypot(x, y)
        vertices[:, (axis + 1) % 3] = x * np.cos(angle) - y * np.sin(angle)
        vertices[:, (axis + 2) % 3] = x * np.sin(angle) + y * np.cos(angle)
    return vertices, faces


def sheared(corners, dtype, faces=BOX):
    """A skew box on the grid."""
    return (corners * 64 @ SHEAR).astype(dtype), faces


def t_junctions(dtype, ulps=0):
    """A skew box. Some faces are cut where their neighbours are not cut, exactly or nearly."""
    vertices, faces = sheared(CORNERS, dtype)
    for k, eighths in ((0, 3), (3, 4), (6, 1), (9, 6)):
        a, b, c = faces[k]
        cut = (vertices[a] * (8 - eighths) + vertices[b] * eighths) / dtype(8)
        cut += ulps * np.spacing(np.abs(cut))
        middle = len(vertices)
        vertices = np.concatenate([vertices, [cut]]).astype(dtype)
        faces = np.concatenate([faces, [[middle, b, c]]])
        faces[k] = a, middle, c
    return vertices, faces


def joined(one, other):
    return np.concatenate([one[0], other[0]]), np.concatenate([one[1], other[1] + len(one[0])])


def points(vertices, faces, count, subnormal):
    """A ninth of the points for each kind. Half of all points are moved by an ulp in some coordinates. Zeros are moved
    by the least float if `subnormal`, otherwise by an ulp of the mesh's size."""
    dtype = vertices.dtype.type
    lo, hi = vertices.min(axis=0), vertices.max(axis=0)
    margin = (hi - lo) * dtype(0.125)
    share = -(-count // 9)
    a, b, c = vertices[faces[RANDOM.integers(0, len(faces), (9, share))]].transpose(2, 0, 1, 3)
    eighth = lambda least, most: (RANDOM.integers(least, most + 1, (share, 1)) / 8).astype(dtype)
    anywhere = lambda: RANDOM.uniform(lo - margin, hi + margin, (share, 3)).astype(dtype)
    on_edge = lambda k, t: a[k] * (1 - t) + b[k] * t
    kinds = [
        anywhere(),
        a[1],
        on_edge(2, eighth(1, 7)),
        # Of faces.
        (a[3] * 2 + b[3] + c[3]) / dtype(4),
        # On the lines of edges, and in the planes of faces, beyond them.
        on_edge(4, eighth(-24, 32)),
        a[5] + (b[5] - a[5]) * eighth(-16, 16) + (c[5] - a[5]) * eighth(-16, 16),
        # In the columns of vertices, along each axis, and in those of points on edges.
        np.where(np.arange(3) == RANDOM.integers(0, 3, (share, 1)), anywhere(), a[6]),
        np.where(np.arange(3) == RANDOM.integers(0, 3, (share, 1)), anywhere(), on_edge(7, eighth(1, 7))),
        # On edges and in faces, rounded.
        a[8] + (b[8] - a[8]) * RANDOM.random((share, 1), dtype) + (c[8] - a[8]) * eighth(0, 1) * dtype(0.125),
    ]
    found = np.concatenate(kinds).astype(dtype)[RANDOM.permutation(9 * share)[:count]]
    ways = RANDOM.integers(-1, 2, found.shape)
    ulps = np.spacing(np.where((found == 0) & (not subnormal), (hi - lo).max(), np.abs(found)))
    moved = found + ways * ulps.astype(dtype)
    return np.where(RANDOM.random((count, 1)) < 0.5, found, moved).astype(dtype)

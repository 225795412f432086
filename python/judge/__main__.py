"""Judges insides, winding numbers and distances of this library and of other libraries by exact arithmetic, as tables.

    python judge [MESH...] [--points N] [--kinds WORD...] [--no-peers]

It generates a mesh of each kind, with points that are hard to judge (`meshes.py`). Floats become Python integers in
NumPy arrays. They decide which faces a ray along z crosses, and the distance of each face. Floating-point arithmetic
decides only with a wide margin. Winding numbers of open meshes are sums of all solid angles, in integers where many
digits cancel. The judge has no code of the library. It needs trimesh; `peers.py` judges Open3D, trimesh and libigl.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
import warnings
from pathlib import Path

import meshes as made
import numpy as np

from stackless_bvh import Scene

BLOCK = 256  # points that share a list of faces
BATCH = 64  # blocks judged at once
ROOT = np.frompyfunc(math.isqrt, 1, 1)
NEAR_HALF = 1e-6  # no judgement of the side of winding numbers this near to 1/2


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*", type=Path, help="more meshes, of files that trimesh reads")
    parser.add_argument("--points", type=int, default=1_000_000, help="points of each kind of mesh")
    parser.add_argument("--kinds", nargs="*", default=[""], help="only kinds of meshes that contain one of these words")
    parser.add_argument("--no-peers", action="store_true", help="judge this library only")
    arguments = parser.parse_args()
    if not arguments.no_peers:
        import peers
    else:
        peers = None
    print("| mesh | points | on it | contains | winding | signed distance | nearest | foot | undecided | seconds |")
    print("|---|" + "---:|" * 9, flush=True)
    rows, count = [], 0
    for kind, vertices, faces in made.meshes(arguments.meshes):
        if any(word in kind for word in arguments.kinds):
            points = made.points(vertices, faces, arguments.points, "subnormal" in kind)
            begin, count = time.perf_counter(), count + 1
            scene = Scene(vertices, faces)
            near = scene.nearest(points, details=True)
            truth = Truth(vertices, faces, points, near.distance)
            ours(kind, scene, points, near, truth, begin)
            if peers:
                rows += peers.judge(kind, vertices, faces, points, truth)
    if not count:
        parser.error(f"--kinds: no kind of mesh contains any of {arguments.kinds}")
    if peers:
        peers.table(rows)


def ours(kind, scene, points, near, truth, begin):
    """Returns a row: the numbers of wrong answers of this library."""
    rules = ["winding"] + ["parity"] * scene.is_closed + ["nonzero"] * scene.is_oriented
    wrong = dict.fromkeys(["contains", "winding", "signed", "nearest", "foot"], 0)
    windings = scene.winding_number(points)
    off = ~truth.on_mesh
    if scene.is_oriented:
        wrong["winding"] += wrong_of(windings != truth.winding, off, "winding", near, points)
    else:
        truth.sum_angles(scene.vertices, scene.faces, points, off)
        wrong["winding"] += wrong_of(np.abs(windings - truth.angles) > NEAR_HALF, off, "winding", near, points)
    is_rounded = truth.is_rounded(near.distance)
    wrong["nearest"] += wrong_of(~is_rounded, True, "nearest", near, points)
    wrong["nearest"] += wrong_of(near.primitive != truth.face, True, "primitive", near, points)
    for what, is_right in truth.foot(near):
        wrong["foot"] += wrong_of(~is_right, near.primitive == truth.face, what, near, points)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for rule in rules:
            inside, judged = truth.inside(rule)
            closed, opened = (scene.contains(points, boundary=flag, rule=rule) for flag in (True, False))
            wrong["contains"] += wrong_of(closed != (inside | truth.on_mesh), judged, f"{rule}, closed", near, points)
            wrong["contains"] += wrong_of(opened != (inside & off), judged, f"{rule}, open", near, points)
            signed = scene.signed_distance(points, rule=rule)
            # Far below the least float, a distance is 0 on each side.
            is_right = is_rounded & (np.abs(signed) == near.distance) & ((signed < 0) == (inside & off & (signed != 0)))
            wrong["signed"] += wrong_of(~is_right, judged, f"{rule}, signed", near, points)
    name = f"{kind}, {points.dtype}, {len(scene.faces):,} faces"
    counts = " | ".join(f"{count:,}" for count in wrong.values())
    seconds = time.perf_counter() - begin
    undecided = (~truth.inside("winding")[1]).sum()
    print(f"| {name} | {len(points):,} | {(~off).sum():,} | {counts} | {undecided} | {seconds:.0f} |", flush=True)


def wrong_of(is_wrong, judged, what, near, points):
    """Returns the number of wrong answers. Prints the first of them, and their distance from the mesh."""
    found = np.flatnonzero(is_wrong & judged)
    if len(found):
        far = near.distance[found].max()
        print(
            f"WRONG {what}: {len(found)}, first {points[found[0]].tolist()}, at most {far:.2g} from the mesh",
            file=sys.stderr,
        )
    return len(found)


class Truth:
    """The truth about each point: crossings, winding number, the square of the distance, and the least face whose
    distance rounds to a given distance."""

    def __init__(self, vertices, faces, points, distances):
        count = len(points)
        self.middles = middles(distances)
        self.bits = max(bits_of(vertices), bits_of(points))
        exact = self.exact = Triangles(whole(vertices, self.bits).T[:, faces.T].swapaxes(0, 1))
        exact_points = self.points = whole(points, self.bits).T
        rough_vertices, rough_points = of_unit_size(vertices, vertices), of_unit_size(vertices, points)
        rough = Triangles(rough_vertices.T[:, faces.T].swapaxes(0, 1))
        self.crossings, self.winding = np.zeros(count, np.int64), np.zeros(count, np.int64)
        self.face = np.full(count, len(faces))
        self.limit_bits = max(self.bits, bits_of(self.middles[1]))
        self.limit = whole(self.middles[1], self.limit_bits)
        self.square, self.over = np.empty(count, object), np.empty(count, object)
        self.angles = None
        blocks = list(halves(rough_points, np.arange(count)))
        for first in range(0, count and len(blocks), BATCH):
            some = blocks[first : first + BATCH]
            pairs = [columns(rough, rough_points, block) for block in some]
            self.cross(rough, rough_points.T, *map(np.concatenate, zip(*pairs)))
            pairs = [near_faces(rough, rough_points, block) for block in some]
            self.measure(exact, exact_points, *map(np.concatenate, zip(*pairs)))
        self.on_mesh = self.square == 0

    def cross(self, rough, rough_points, asked, faces):
        """Counts crossings of rays along z from each point, moved by (e, e², 0) for small e > 0. Integers decide
        doubtful signs."""
        signs = crossing(rough.take(faces), rough_points[:, asked], 1e-11)
        doubt = signs == 2
        signs[doubt] = crossing(self.exact.take(faces[doubt]), self.points[:, asked[doubt]], 0)
        self.crossings += np.bincount(asked, signs != 0, minlength=len(self.crossings)).astype(np.int64)
        self.winding += np.bincount(asked, signs, minlength=len(self.crossings)).astype(np.int64)

    def measure(self, exact, points, asked, faces):
        """Finds the least squares of distances, and the least faces."""
        order = np.lexsort((faces, asked))
        asked, faces = asked[order], faces[order]
        square, over = exact.take(faces).squared_distances(points[:, asked])
        starts = np.flatnonzero(np.r_[True, asked[1:] != asked[:-1]])
        ends = np.r_[starts[1:], len(asked)]
        best = starts.copy()
        for step in range(1, (ends - starts).max()):
            other = starts + step
            row = np.flatnonzero(other < ends)
            one, other = best[row], other[row]
            less = (square[other] * over[one] < square[one] * over[other]).astype(bool)
            best[row[less]] = other[less]
        rows = asked[starts]
        self.square[rows], self.over[rows] = square[best], over[best]
        high, limit = self.limit[asked] ** 2 * over, square << 2 * (self.limit_bits - self.bits) + 2
        equal = (limit < high) | (self.middles[2][asked] & (limit == high))
        np.minimum.at(self.face, asked[equal.astype(bool)], faces[equal.astype(bool)])

    def inside(self, rule):
        """Returns which points are inside, and which points are judged."""
        if rule == "parity":
            return self.crossings % 2 == 1, np.ones(len(self.crossings), bool)
        if self.angles is None or rule == "nonzero":
            return (self.winding != 0 if rule == "nonzero" else self.winding > 0), np.ones(len(self.winding), bool)
        return self.angles > 0.5, self.on_mesh | (np.abs(self.angles - 0.5) > NEAR_HALF)

    def distance(self):
        """Returns distances in double precision."""
        return (ROOT((self.square << 128) // self.over) / (1 << 64 + self.bits)).astype(float)

    def is_rounded(self, distances):
        """Returns whether each float is nearest to the exact distance."""
        return is_nearest(self.square, self.over, distances, self.bits, 2)

    def foot(self, near):
        """Yields which nearest points, weights, parts and normals are right, if the faces are."""
        triangles = self.exact.take(self.face)
        weights, over = triangles.weights(self.points)
        has_area = triangles.area != 0
        places = sum(weight * corner for weight, corner in zip(weights, triangles.corners))
        yield "point", np.all([is_nearest(x, over, f, self.bits) for x, f in zip(places, near.point.T)], axis=0)
        found = [is_nearest(weight, over, f, 0) for weight, f in zip(weights[1:], near.uv.T)]
        yield "weights", np.all(found, axis=0) | ~has_area
        yield "part", (near.place == sum(weight == 0 for weight in weights)) | ~has_area
        found = [
            (np.sign(x).astype(int) == np.sign(f)) & is_nearest(x * x, triangles.area, np.abs(f), 0, 2)
            for x, f in zip(triangles.normal, near.normal.T)
        ]
        yield "normal", np.all(found, axis=0) | ~has_area

    def sum_angles(self, vertices, faces, points, off):
        """Returns the generalised winding number of points off the mesh: the sum of all solid angles (Van Oosterom &
        Strackee 1983), over 4 pi. Angles near edges and faces, where double precision may err, use integers."""
        self.angles = np.zeros(len(points))
        rough = Triangles(vertices.astype(float).T[:, faces.T].swapaxes(0, 1))
        for rows in np.array_split(np.flatnonzero(off), max(1, len(points) * len(faces) // 200_000)):
            y, x = halves_of_angles([c[:, None] - points[rows].astype(float).T[:, :, None] for c in rough.corners])
            row, face = np.nonzero((np.abs(y) < 1e-6) & (x < 1e-6))
            corners = self.exact.take(face).corners
            exact = halves_of_angles([corner - self.points[:, rows[row]] for corner in corners])
            angles = np.arctan2(y, x)
            angles[row, face] = np.arctan2(*exact)
            self.angles[rows] = angles.sum(axis=1) / (2 * np.pi)


def halves_of_angles(corners):
    """Returns multiples of the sines and cosines of half of the solid angles of triangles, seen from 0."""
    is_exact = corners[0].dtype == object
    lengths = [dot(corner, corner) for corner in corners]
    if is_exact:
        # Lengths have 256 binary places, because many digits cancel near edges.
        corners, lengths = [corner * (1 << 256) for corner in corners], [length << 512 for length in lengths]
    (a, b, c), (la, lb, lc) = corners, map(ROOT if is_exact else np.sqrt, lengths)
    y, x = dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    size = np.abs(y) + np.abs(x) if is_exact else la * lb * lc
    return (y / size).astype(float), (x / size).astype(float)


def crossing(triangles, q, margin):
    """1 where the ray leaves through the front of the triangle, -1 through its back, 0 where it misses; 2 in doubt."""
    sign = lambda numbers: np.sign(numbers).astype(np.int64)
    up, doubt = sign(triangles.normal[2]), np.abs(triangles.normal[2]) < margin
    crossed = up != 0
    for corner, edge in zip(triangles.corners, triangles.edges):
        s = q - corner
        side = edge[0] * s[1] - edge[1] * s[0]
        doubt |= np.abs(side) < margin
        moved = np.where(edge[1] != 0, -sign(edge[1]), sign(edge[0]))
        crossed &= np.where(side != 0, sign(side), moved) == up
    height = dot(triangles.normal, q - triangles.corners[0])
    doubt |= np.abs(height) < margin
    return np.where(doubt, 2, (crossed & (sign(height) * up < 0)) * up)


class Triangles:
    """Triangles with data for distances, in floats or integers: arrays of shape (3 axes, ...)."""

    def __init__(self, corners):
        a, b, c = self.corners = corners
        self.edges = [b - a, c - b, a - c]
        self.normal = cross(self.edges[0], self.edges[1])
        self.walls = [cross(self.normal, edge) for edge in self.edges]
        self.lengths = [dot(edge, edge) for edge in self.edges]
        self.area = dot(self.normal, self.normal)

    def take(self, *index):
        index = (..., *index)
        taken = Triangles.__new__(Triangles)
        for name, value in vars(self).items():
            is_list = isinstance(value, list) or name == "corners"
            setattr(taken, name, [part[index] for part in value] if is_list else value[index])
        return taken

    def weights(self, q):
        """Returns weights of the corners in the nearest points: numerators and denominators."""
        s = [q - corner for corner in self.corners]
        # The weight of a corner is 0 on the wall of the opposite edge.
        of_face = [dot(self.walls[i], s[i]) for i in (1, 2, 0)]
        is_face = (self.area != 0) & np.all([weight >= 0 for weight in of_face], axis=0).astype(bool)
        zero, best, found = self.area * 0, None, None
        for i, (edge, length) in enumerate(zip(self.edges, self.lengths)):
            length = np.where(length == 0, 1, length)
            along = np.minimum(np.maximum(dot(edge, s[i]), 0), length)
            way = length * s[i] - along * edge
            square, over = dot(way, way), length * length
            weights = [zero, zero, zero]
            weights[i], weights[(i + 1) % 3] = length - along, along
            if best is None:
                best, found = (square, over), [*weights, length]
            else:
                less = (square * best[1] < best[0] * over).astype(bool)
                best = [np.where(less, one, other) for one, other in zip((square, over), best)]
                found = [np.where(less, one, other) for one, other in zip([*weights, length], found)]
        *weights, over = (np.where(is_face, one, other) for one, other in zip([*of_face, self.area], found))
        return weights, over

    def squared_distances(self, q):
        """Returns numerators and denominators: of the face if the foot is inside, or of an edge or corner."""
        inside, best = self.area != 0, None
        for corner, edge, wall, length in zip(self.corners, self.edges, self.walls, self.lengths):
            s = q - corner
            along, far = dot(edge, s), dot(s, s)
            is_beside = ((along > 0) & (along < length)).astype(bool)
            found = np.where(is_beside, far * length - along * along, far), np.where(is_beside, length, 1)
            inside = inside & (dot(wall, s) >= 0)
            if best is not None:
                less = (found[0] * best[1] < best[0] * found[1]).astype(bool)
                found = [np.where(less, one, other) for one, other in zip(found, best)]
            best = found
        inside = inside.astype(bool)
        height = dot(self.normal, q - self.corners[0])
        return np.where(inside, height * height, best[0]), np.where(inside, self.area, best[1])


def is_nearest(exact, over, floats, bits, power=1):
    """Returns whether each float is nearest to a number; of two nearest floats, the even one. `exact / over / 2**bits`
    is the number, or with `power=2` its square, over `4**bits`."""
    low, high, even = middles(floats)
    if power == 2:
        low = np.maximum(low, 0)
    most = max(bits_of(low), bits_of(high), bits)
    exact = exact << power * (most - bits + 1)
    low, high = (whole(end, most) ** power * over for end in (low, high))
    return (((low < exact) & (exact < high)) | (even & ((low == exact) | (high == exact)))).astype(bool)


def middles(floats):
    """Returns sums of each float and its neighbours, which are twice the midpoints, and whether the float is even."""
    kind = floats.dtype.type
    below, above = (np.nextafter(floats, kind(end)) for end in (-np.inf, np.inf))
    low, high = (floats + end.astype(np.longdouble) for end in (below, above))
    bits = np.abs(floats).view(np.uint32 if kind is np.float32 else np.uint64)
    return low, high, bits % 2 == 0


def halves(points, rows):
    """Yields blocks of neighbouring points."""
    if len(rows) <= BLOCK:
        yield rows
    else:
        axis = np.ptp(points[rows], axis=0).argmax()
        order = rows[np.argpartition(points[rows, axis], len(rows) // 2)]
        for half in (order[: len(rows) // 2], order[len(rows) // 2 :]):
            yield from halves(points, half)


def columns(rough, points, block):
    """Yields pairs of points and faces that a ray along z may cross."""
    q, margin = points[block], 1e-9
    lo, hi = (end(rough.corners, axis=0) for end in (np.min, np.max))
    meets = (hi[2] >= q[:, 2].min() - margin) & (lo[:2] <= q[:, :2].max(axis=0)[:, None] + margin).all(axis=0)
    faces = np.flatnonzero(meets & (hi[:2] >= q[:, :2].min(axis=0)[:, None] - margin).all(axis=0))
    q = q.T[:, :, None]
    pairs = ((lo[:2, None, faces] <= q[:2] + margin) & (hi[:2, None, faces] >= q[:2] - margin)).all(axis=0)
    row, face = np.nonzero(pairs & (hi[2, faces] >= q[2] - margin))
    return block[row], faces[face]


def near_faces(rough, points, block):
    """Yields pairs of points and faces that may be nearest."""
    q = points[block]
    middle = q.mean(axis=0)
    radius = np.linalg.norm(q - middle, axis=1).max()
    centres = sum(rough.corners) / 3
    far = np.linalg.norm(centres - middle[:, None], axis=0)
    sizes = np.sqrt(np.max([dot(corner - centres, corner - centres) for corner in rough.corners], axis=0))
    faces = np.flatnonzero(far - sizes <= far.min() + 2 * radius + 1e-6)
    square, over = rough.take(None, faces).squared_distances(q.T[:, :, None])
    square = square / over
    row, face = np.nonzero(square <= square.min(axis=1, keepdims=True) * (1 + 1e-6) + 1e-12)
    return block[row], faces[face]


def of_unit_size(vertices, numbers):
    """Returns numbers relative to the first vertex, divided by the size of the mesh: two roundings."""
    start = vertices[0].astype(float)
    return (numbers.astype(float) - start) / np.ptp(vertices.astype(float), axis=0).max()


def mantissas(numbers):
    """Returns odd integers, or 0, and exponents of two."""
    mantissa, exponent = np.frexp(np.asarray(numbers, np.longdouble))
    whole = np.ldexp(mantissa, 63).astype(np.int64)
    zeros = np.frexp((whole & -whole).astype(float))[1] - 1
    zeros = np.where(whole == 0, 0, zeros)
    return whole >> zeros, np.where(whole == 0, 0, exponent - 63 + zeros)


def bits_of(numbers):
    """Returns the least number of binary places for all numbers."""
    return max(0, int(-mantissas(numbers)[1].min()))


def whole(numbers, bits):
    """Returns the numbers times 2**bits."""
    mantissa, exponent = mantissas(numbers)
    return mantissa.astype(object) << (exponent + bits).astype(object)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


if __name__ == "__main__":
    main()

"""The truth about rays, points and triangles, in rational arithmetic: slow, plain, and without code of the library.

A mesh is a list of vertices and a list of faces. Each float is converted to its exact rational value.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf

import numpy as np


def vector(numbers):
    return tuple(Fraction(float(x)) for x in numbers)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def corners(vertices, face):
    return [vector(vertices[i]) for i in face]


def meet(triangle, origin, direction):
    """Returns distance and weights where a line meets a closed triangle, or None (Möller & Trumbore 1997)."""
    a, b, c = triangle
    e1, e2, s = minus(b, a), minus(c, a), minus(origin, a)
    p = cross(direction, e2)
    det = dot(e1, p)
    if det == 0:
        return None
    q = cross(s, e1)
    u, v, t = dot(s, p) / det, dot(direction, q) / det, dot(e2, q) / det
    return (t, u, v) if u >= 0 and v >= 0 and u + v <= 1 else None


def within(t, tmin, tmax):
    return t >= Fraction(float(tmin)) and (tmax == inf or t <= Fraction(float(tmax)))


def all_hits(vertices, faces, origin, direction, tmin=0.0, tmax=inf, dtype=np.float64):
    """Returns all hits (t rounded, face, t, u, v, place) in the order (t, face)."""
    origin, direction = vector(origin), vector(direction)
    found = []
    for face, indices in enumerate(faces):
        hit = meet(corners(vertices, indices), origin, direction)
        if hit is not None and within(hit[0], tmin, tmax):
            t, u, v = hit
            zeros = [u, v, 1 - u - v].count(0)
            found.append((rounded(t, dtype), face, t, u, v, zeros))
    return sorted(found, key=lambda hit: (hit[2], hit[1]))


def crossings(triangles, origin, direction):
    """Counts the triangles that an infinite ray crosses, from an origin moved by very little in a general direction.

    For coordinates that are small multiples of 1/8 and an origin that is not on the mesh.
    """
    little = Fraction(1, 2**200)
    moved = tuple(x + little**power for power, x in enumerate(vector(origin), 1))
    found = [meet(triangle, moved, vector(direction)) for triangle in triangles]
    assert all(0 not in (u, v, 1 - u - v, t) for t, u, v in filter(None, found))
    return sum(1 for hit in found if hit is not None and hit[0] > 0)


def nearest_square(triangle, point):
    """Returns the squared distance from a point to a triangle, and its nearest point. Without area, it is its edges."""
    a, b, c = triangle
    candidates = [on_segment(point, *ends) for ends in [(a, b), (b, c), (c, a)]]
    hit = meet(triangle, point, cross(minus(b, a), minus(c, a)))
    if hit is not None:
        normal = cross(minus(b, a), minus(c, a))
        candidates.append(tuple(x + hit[0] * n for x, n in zip(point, normal)))
    return min((dot(minus(x, point), minus(x, point)), x) for x in candidates)


def on_segment(point, a, b):
    along = minus(b, a)
    if not any(along):
        return a
    t = dot(minus(point, a), along) / dot(along, along)
    t = min(max(t, Fraction(0)), Fraction(1))
    return tuple(x + t * d for x, d in zip(a, along))


def has_area(triangle):
    a, b, c = triangle
    return any(cross(minus(b, a), minus(c, a)))


def rounded(x, dtype):
    """Returns the float nearest to a rational number, ties to even."""
    near = dtype(float(x))
    if dtype is np.float64 or not np.isfinite(near):
        return near
    candidates = [np.nextafter(near, dtype(-inf)), near, np.nextafter(near, dtype(inf))]
    candidates = [c for c in candidates if np.isfinite(c)]
    is_odd = lambda c: int(np.abs(c).view(np.uint32)) & 1
    return min(candidates, key=lambda c: (abs(Fraction(float(c)) - x), is_odd(c)))


def is_rounded_root(root, square):
    """Returns whether a float is the nearest one of its dtype to the root of a rational number."""
    low, high = (np.nextafter(root, type(root)(end)) for end in (-inf, inf))
    middle = lambda a: (Fraction(float(a)) + Fraction(float(root))) / 2
    return max(middle(low), Fraction(0)) ** 2 <= square <= middle(high) ** 2

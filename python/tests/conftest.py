"""Meshes that several tests use."""

import os

import numpy as np
import pytest
from hypothesis import settings

# CI builds share two slow cores, so examples have no deadline. The examples are the same in each run.
settings.register_profile("ci", deadline=None, derandomize=True, max_examples=400)
settings.register_profile("long", deadline=None, max_examples=5000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)
CUBE_FACES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]
)  # fmt: skip


@pytest.fixture(params=[np.float32, np.float64])
def dtype(request):
    return request.param


@pytest.fixture
def cube():
    return CUBE.copy(), CUBE_FACES.copy()


def octasphere(levels, dtype=np.float64):
    """A closed sphere of 8 * 4**levels faces."""
    vertices = [np.array(v, dtype=float) for v in [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                between = vertices[a] + vertices[b]
                middles[key] = len(vertices)
                vertices.append(between / np.linalg.norm(between))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return np.array(vertices).astype(dtype), np.array(faces)


def some_rays(dtype, count=200, seed=1):
    random = np.random.default_rng(seed)
    return random.uniform(-2, 2, (count, 3)).astype(dtype), random.normal(size=(count, 3)).astype(dtype)


def same(a, b):
    def equal(x, y):
        return x is y is None or np.array_equal(x, y, equal_nan=x.dtype.kind == "f")

    arrays = [{name: x for name, x in vars(it).items() if not name.startswith("_")} for it in (a, b)]
    return arrays[0].keys() == arrays[1].keys() and all(equal(x, arrays[1][name]) for name, x in arrays[0].items())

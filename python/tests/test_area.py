"""Meshes that all rays miss cause a warning when they are created."""

import warnings

import numpy as np
import pytest
from conftest import CUBE, CUBE_FACES

from stackless_bvh import Scene

LINE = np.array([[0, 1, 2], [3, 1, 2], [3.5, 1, 2]])
COLLAPSED = np.repeat(CUBE[:1], 8, axis=0)
FLAT = {
    "an index twice": (CUBE, [[0, 7, 0], [1, 6, 6], [5, 5, 2]]),
    "a point": (CUBE, [[7, 7, 7]]),
    "equal coordinates": (COLLAPSED, CUBE_FACES),
    "a line along x": (LINE, [[0, 1, 2], [2, 1, 0]]),
    "a line along y": (LINE[:, [1, 0, 2]], [[0, 1, 2]]),
    "a line along z": (LINE[:, [1, 2, 0]], [[0, 1, 2]]),
    "a line, and an index twice": (LINE, [[0, 1, 2], [1, 1, 0]]),
}
ORDINARY = {
    "a cube": (CUBE, CUBE_FACES),
    "a triangle in a plane along axes": (CUBE, [[0, 1, 2]]),
    "one triangle at the end": (CUBE, [[0, 0, 0], [1, 2, 2], [0, 1, 2]]),
    "one triangle at the start": (CUBE, [[0, 1, 2], [0, 0, 0]]),
}


@pytest.mark.parametrize("kind", FLAT)
def test_a_mesh_without_area_gets_a_warning(kind, dtype):
    vertices, faces = FLAT[kind]
    with pytest.warns(UserWarning, match="^faces: none has an area, so that all rays miss the mesh$") as warned:
        scene = Scene(vertices.astype(dtype), np.array(faces))
    assert len(warned) == 1 and warned[0].filename == __file__
    rays = np.random.default_rng(1).uniform(-2, 2, (2, 500, 3)).astype(dtype)
    assert not scene.any(*rays).any()


@pytest.mark.parametrize("kind", ORDINARY)
def test_other_meshes_get_none(kind, dtype):
    vertices, faces = ORDINARY[kind]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Scene(vertices.astype(dtype), np.array(faces, dtype=np.uint32))

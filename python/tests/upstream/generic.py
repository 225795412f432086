"""What trimesh's tests import from a module that its archive does not have: the names that ray tests use."""

import collections
import inspect
import time
import unittest

import numpy as np
import pytest
import trimesh
from trimesh import Trimesh
from trimesh.constants import log, tol

__all__ = ["Trimesh", "collections", "deque", "get_mesh", "log", "np", "random", "time", "tol", "trimesh", "unittest"]

deque = collections.deque
_state = np.random.default_rng(0)


def random(shape):
    return _state.random(shape)


def _opened():
    mesh = trimesh.creation.icosphere(3, radius=20)
    mesh.update_faces(np.arange(len(mesh.faces)) % 7 > 0)
    return mesh


# Made in place of the files of the same name.
_MADE = {
    "unit_cube.STL": trimesh.creation.box,
    "unit_sphere.STL": lambda: trimesh.creation.icosphere(2),
    "featuretype.STL": lambda: trimesh.creation.annulus(1, 2, 3),
    "20mm-xyz-cube.stl": lambda: trimesh.creation.box([20, 20, 20]),
    "teapot.stl": _opened,
    "origin_inside.STL": lambda: trimesh.creation.box([2, 2, 2]).apply_translation([0, 0, -0.5]),
    "1002_tray_bottom.STL": lambda: trimesh.creation.box([20, 10, 1]),
}


def get_mesh(name, use_embree=True, **kwargs):
    if name not in _MADE:
        _skip(name)
    mesh = _MADE[name]()
    return trimesh.Trimesh(mesh.vertices, mesh.faces, use_embree=use_embree)


def get_meshes(count):
    return [make() for make in list(_MADE.values())[:count]]


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    _skip(name)


def _skip(what):
    names = [frame.function for frame in inspect.stack() if frame.function.startswith("test_")]
    pytest.skip(f"{names[0] if names else 'it'} needs {what}")

"""Several meshes in one scene, and queries of arrays of any shape, for `RaycastingScene`."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._arrays import numbers
from ._scene import Scene

# Number of normals computed at a time, which bounds the memory.
_BLOCK = 65536

Mesh = tuple[NDArray[Any], NDArray[Any]]


class Answer(np.ndarray[Any, Any]):
    """A NumPy array with the method `numpy` of tensors."""

    def numpy(self) -> NDArray[Any]:
        """Returns the plain NumPy array, which shares the memory."""
        return self.view(np.ndarray)


class Geometries:
    """The scene of all triangles of several meshes, in the order of the meshes."""

    def __init__(self, meshes: Sequence[Mesh]) -> None:
        counts = [len(faces) for _, faces in meshes]
        self.empty = sum(counts) == 0
        if self.empty:
            # No query of an empty scene uses the answers of this triangle.
            meshes, counts = [(np.eye(3, dtype=np.float32), np.array([[0, 1, 2]]))], [1]
        self._starts = np.cumsum([0, *counts[:-1]])
        firsts = np.cumsum([0, *(len(vertices) for vertices, _ in meshes[:-1])])
        self._vertices = np.concatenate([vertices for vertices, _ in meshes])
        self._faces = np.concatenate([faces.astype(np.int64) + first for (_, faces), first in zip(meshes, firsts)])
        self.scene = Scene(self._vertices, self._faces)

    def ids(self, primitives: NDArray[np.int64]) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """Returns the geometry of each triangle of the scene, and its number there; the maximum uint32 for -1."""
        geometry = np.searchsorted(self._starts, primitives, side="right") - 1
        within = np.where(primitives < 0, -1, primitives - self._starts[geometry])
        return geometry.astype(np.uint32), within.astype(np.uint32)

    def rule(self) -> Literal["parity", "winding"]:
        """Returns the rule that defines the inside, and warns if it is a guess."""
        if self.scene.is_closed:
            return "parity"
        if not self.empty:
            warnings.warn("the meshes are not closed: the inside is a guess by the winding number", stacklevel=3)
        return "winding"

    @cached_property
    def normals(self) -> NDArray[Any]:
        """The normals of all triangles, of length 1. The last row, for misses, is zero."""
        normals = np.zeros((len(self._faces) + 1, 3), dtype=self._vertices.dtype)
        for start in range(0, len(self._faces), _BLOCK):
            faces = self._faces[start : start + _BLOCK]
            corners = self._vertices[faces].astype(np.float64)
            edges = corners[:, 1:] - corners[:, :1]
            # Triangles without an area get NaN. No ray hits them.
            with np.errstate(invalid="ignore", divide="ignore"):
                edges /= np.abs(edges).max(axis=(1, 2), keepdims=True)
                normal = np.cross(edges[:, 0], edges[:, 1])
                normals[start : start + len(faces)] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
        return normals


class Asked:
    """Queries of a scene as rows of numbers, of any leading shape.

    `rows` has shape (n, width). `real` is False for rows that always miss: rays without a direction, and all rows if
    the scene is empty.
    """

    def __init__(self, geometries: Geometries, values: Any, name: str, width: int) -> None:
        array = numbers(plain(values), name, str(geometries.scene.dtype)).view(np.ndarray)
        if array.shape[-1:] != (width,):
            raise ValueError(f"{name}: shape {array.shape}, expected (..., {width})")
        self.shape = array.shape[:-1]
        self.rows = array.reshape(-1, width)
        self.real = np.full(len(self.rows), not geometries.empty)

    def rays(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Returns origins and directions. Zero directions are replaced."""
        origins, directions = self.rows[:, :3], self.rows[:, 3:]
        moving = (directions != 0).any(axis=1)
        if not moving.all():
            directions = np.where(moving[:, np.newaxis], directions, directions.dtype.type(1))
            self.real &= moving
        return origins, directions

    def answer(self, values: NDArray[Any], missing: Any) -> Answer:
        """Returns the values of all rows in the leading shape, with `missing` for rows that are not real."""
        if not self.real.all():
            values[~self.real] = missing
        return values.reshape(self.shape + values.shape[1:]).view(Answer)


def plain(values: Any) -> Any:
    """Returns the NumPy array of a tensor, and other values unchanged."""
    return values.numpy() if hasattr(values, "numpy") else values

"""A mesh that rays and points ask."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import mesh_arrays, per_row, rays, rows
from ._results import AllHits, Hits, Near

Progress = Callable[[int, int], object]


class Scene:
    """A triangle mesh with the hierarchy that makes queries fast. All answers are exact.

    Parameters
    ----------
    vertices
        Shape (n, 3), float32 or float64, of any strides. The dtype is that of the scene: its rays, points and answers
        have it too. Lists become float64.
    faces
        Shape (m, 3), integers: three rows of `vertices` for each triangle. Faces without an area are allowed, and no
        ray hits them.
    build
        How the hierarchy is built: "standard", "fast" (the fastest build), "best" (the fastest rays), "sbvh", "bounded"
        or "median". Answers do not depend on it.
    progress
        Is called as ``progress(done, count)`` now and then, with numbers of faces, while the hierarchy is built.

    Raises
    ------
    TypeError
        An array has another dtype.
    ValueError
        An array has another shape, a coordinate is not finite, or an index is out of range; the message names the row.
    RuntimeError
        This thread does not compute as IEEE 754 demands, as after loading a library compiled with ``-ffast-math``.

    Building runs on all threads with the interpreter's lock released, and Ctrl-C ends it. So do all methods that answer
    many rays or points: they look for Ctrl-C, and call ``progress(done, count)`` if it is given, after every 65,536 of
    them. Float32 arrays are accepted by float64 scenes, which is exact. Float64 arrays are refused by float32 scenes:
    rounding is the caller's decision.
    """

    __slots__ = ("_native",)

    def __init__(
        self, vertices: ArrayLike, faces: ArrayLike, build: str = "standard", progress: Progress | None = None
    ) -> None:
        points, indices = mesh_arrays(vertices, faces)
        self._native = _native.Scene(points, indices, str(points.dtype), build, progress)

    def __repr__(self) -> str:
        return f"<stackless_bvh.Scene: {len(self.faces)} faces, {self.dtype}>"

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64."""
        return np.dtype(self._native.dtype)

    @property
    def vertices(self) -> NDArray[Any]:
        """Shape (n, 3): a copy."""
        return self._native.vertices

    @property
    def faces(self) -> NDArray[np.int64]:
        """Shape (m, 3): a copy."""
        return self._native.faces

    @property
    def nbytes(self) -> int:
        """Memory of mesh and hierarchy, in bytes."""
        return sum(self._native.bytes)

    @property
    def is_closed(self) -> bool:
        """Whether every edge is in an even number of faces, so that the mesh has an inside.

        Vertices of equal coordinates are one. How faces are oriented does not matter.
        """
        return self._native.edges()[0] == 0

    @property
    def is_oriented(self) -> bool:
        """Whether every edge is run through as often in one direction as in the other; such a mesh is closed too."""
        return self._native.edges()[1] == 0

    def closest(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> Hits:
        """The closest hit of each ray ``origin + t * direction`` with ``tmin <= t <= tmax``.

        Closest is the least exact distance, and of equal ones the least face. `t` is the distance, rounded once. Edges
        and vertices belong to their faces, and both sides are hit. A face that the ray sees edge-on is missed.

        Parameters
        ----------
        origins, directions
            Shape (n, 3); one of them may have one row or shape (3,), which then serves all rays. Directions need not
            have length 1.
        tmin, tmax
            Numbers, or arrays of shape (n,). Both ends belong to the ray.

        Raises
        ------
        TypeError
            An array has another dtype than the scene.
        ValueError
            Shapes do not fit, a number is not finite, a direction is zero, or ``0 <= tmin <= tmax`` does not hold.
        """
        return Hits(*self._native.closest(self._rays(origins, directions, tmin, tmax), progress))

    def any(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Whether each ray hits anything: shape (n,). Parameters and errors are those of `closest`."""
        return self._native.any(self._rays(origins, directions, tmin, tmax), progress)

    def all_hits(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> AllHits:
        """All hits of each ray: every face that it meets, once. Parameters and errors are those of `closest`.

        A ray through an edge meets the faces on both sides of it; `AllHits.place` tells such hits from others.
        """
        offsets, (t, primitives, uv), place = self._native.all(self._rays(origins, directions, tmin, tmax), progress)
        return AllHits(offsets, primitives, t, uv, place)

    def count_crossings(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.int64]:
        """How often each ray crosses the mesh: shape (n,). Parameters and errors are those of `closest`.

        A crossing at an edge or a vertex of a closed mesh counts once, and touching it there counts an even number of
        times (the half-open rule). From inside of a closed mesh the number is odd, from outside it is even.
        """
        return self._native.crossings(self._rays(origins, directions, tmin, tmax), progress)

    def contains(self, points: ArrayLike, boundary: bool = True, progress: Progress | None = None) -> NDArray[np.bool_]:
        """Whether each point is inside of the mesh, which must be closed: shape (n,).

        Inside is where a ray crosses the mesh an odd number of times: between two nested spheres, but not in the
        inner one. It does not matter how faces are oriented.

        Parameters
        ----------
        points
            Shape (n, 3).
        boundary
            What is answered for points that are exactly on a face that has an area.

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The mesh is not closed (the message names an edge), the shape does not fit, or a number is not finite.
        """
        points = rows(points, "points", self._native.dtype)
        count, _, wrong = self._native.edges()
        if wrong is not None:
            more = "" if count == 1 else f" ({count} such edges)"
            raise ValueError(f"the mesh is not closed: {wrong}{more}")
        return self._native.contains(points, bool(boundary), progress)

    def nearest(
        self, points: ArrayLike, radius: ArrayLike = np.inf, k: int = 1, progress: Progress | None = None
    ) -> Near:
        """The `k` faces that are nearest to each point, within a radius, in order of distance and then of face.

        Faces without area, which rays miss, are segments and points.

        Parameters
        ----------
        points
            Shape (n, 3).
        radius
            A number or shape (n,), included.
        k
            How many, at least 1.

        Raises
        ------
        TypeError
            An array has another dtype than the scene.
        ValueError
            The shape does not fit, a number is not finite, a radius is negative, or `k` is less than 1.
        """
        if k < 1:
            raise ValueError(f"k: {k}, expected at least 1")
        points = rows(points, "points", self._native.dtype)
        radii = per_row(radius, "radius", self._native.dtype, len(points))
        distance, primitive, point = self._native.nearest(points, radii, int(k), progress)
        if k == 1:
            return Near(distance[:, 0], primitive[:, 0], point)
        return Near(distance, primitive, point.reshape(-1, k, 3))

    def refit(self, vertices: ArrayLike, optimize: bool = False) -> None:
        """Moves the vertices, of which there must be as many as before. It takes a twentieth of the time of a build.

        Queries stay exact, and get slower the more the faces move relative to each other. With `optimize` parts of the
        hierarchy are then moved to better places, which takes a quarter of the time of a build. While another thread
        asks the scene, this fails with a RuntimeError.

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The shape does not fit, or a coordinate is not finite. Then nothing has changed.
        """
        self._native.refit(rows(vertices, "vertices", self._native.dtype), optimize)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes mesh and hierarchy to a file, whole or not at all."""
        path = Path(path)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".part")
        try:
            with open(handle, "wb") as file:
                file.write(self._native.to_bytes())
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene that `save` has written.

        Raises
        ------
        ValueError
            The file is damaged, or none of these. Everything is checked: a file cannot make answers wrong.
        """
        scene = cls.__new__(cls)
        scene._native = _native.Scene.from_bytes(Path(path).read_bytes())
        return scene

    def _rays(self, origins: ArrayLike, directions: ArrayLike, tmin: ArrayLike, tmax: ArrayLike) -> list[NDArray[Any]]:
        return rays(origins, directions, tmin, tmax, self._native.dtype)

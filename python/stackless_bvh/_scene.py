"""A mesh with queries of rays and points."""

from __future__ import annotations

import operator
import os
import sys
import warnings
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _native
from ._arrays import check_area, mesh_arrays, per_row, rays, rows
from ._exact import Hits, Segments
from ._inside import Inside, Progress
from ._results import AllHits, Near, all_arrays


class Scene(Inside, Segments):
    """A triangle mesh with the hierarchy that makes queries fast. All answers are exact.

    Parameters
    ----------
    vertices
        Shape (n, 3), float32 or float64, of any strides. The rays, points and answers of the scene have this dtype.
        Lists become float64.
    faces
        Shape (m, 3), integers: three rows of `vertices` for each triangle. Faces without an area are allowed, and no
        ray hits them.
    build
        Builder of the hierarchy: "standard", "best" (a longer build, rays a little faster), "sbvh", "bounded" or
        "median". Answers do not depend on it.
    progress
        Called periodically during the build as ``progress(done, count)``, with numbers of faces.

    Warns
    -----
    UserWarning
        No face has an area, because each repeats a corner or lies on a line along an axis.

    Raises
    ------
    TypeError
        An array has another dtype.
    ValueError
        An array has another shape, a coordinate is not finite, or an index is out of range; the message names the row.
    MemoryError
        There is not enough memory for the build.
    RuntimeError
        This thread violates IEEE 754, for example after loading a library compiled with ``-ffast-math``.

    The build runs on all threads with the interpreter's lock released, and Ctrl-C ends it. This also applies to all
    methods that answer many rays or points: after every 65,536 of them, they check for Ctrl-C and call
    ``progress(done, count)`` if it is given. Float64 scenes accept float32 arrays, which is exact. Float32 scenes
    refuse float64 arrays: rounding is the caller's decision.

    A scene can be pickled and sent to other processes: to forked or spawned processes of `multiprocessing`, and to
    workers of Dask. Copies share their memory until one copy is refitted.
    """

    __slots__ = ("_native",)

    def __init__(
        self,
        vertices: ArrayLike,
        faces: ArrayLike | None = None,
        build: str = "standard",
        progress: Progress | None = None,
    ) -> None:
        if isinstance(vertices, (str, bytes, os.PathLike)):
            path = os.fspath(vertices)
            raise TypeError(
                f"vertices: the path {path!r}, expected an array; a mesh is read by Scene.load_mesh({path!r}), "
                "and what Scene.save has written by Scene.load"
            )
        if faces is None:
            if hasattr(vertices, "vertices") and hasattr(vertices, "faces"):
                kind = type(vertices).__name__
                raise TypeError(f"vertices: a {kind}, expected an array; pass its .vertices and its .faces")
            raise TypeError("faces: missing, expected integers of shape (m, 3)")
        points, indices = mesh_arrays(vertices, faces)
        self._native = _native.Scene(points, indices, str(points.dtype), build, progress)
        check_area(points, indices)

    def __repr__(self) -> str:
        return f"<stackless_bvh.Scene: {len(self.faces)} faces, {self.dtype}>"

    def __copy__(self) -> Scene:
        """Returns an independent scene: a refit of one scene does not change the other."""
        copy = self.__class__.__new__(self.__class__)
        copy._native = self._native.copy()
        return copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return self.__copy__()

    def __getstate__(self) -> tuple[NDArray[np.uint8]]:
        return (self._native.to_bytes(),)

    def __setstate__(self, state: tuple[NDArray[np.uint8]]) -> None:
        self._native = _native.Scene.from_bytes(*state)

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64."""
        return np.dtype(self._native.dtype)

    @property
    def vertices(self) -> NDArray[Any]:
        """A copy, of shape (n, 3)."""
        return self._native.vertices

    @property
    def faces(self) -> NDArray[np.int64]:
        """A copy, of shape (m, 3)."""
        return self._native.faces

    @property
    def nbytes(self) -> int:
        """Memory of mesh and hierarchy, in bytes."""
        return sum(self._native.bytes)

    def closest(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> Hits:
        """Returns the closest hit of each ray ``origin + t * direction`` with ``tmin <= t <= tmax``.

        The closest hit has the least exact distance, and of equal distances the least face. `t` is this distance,
        rounded once. Edges and vertices belong to their faces, and rays hit faces from each side. A ray in the plane of
        a face misses the face.

        Parameters
        ----------
        origins, directions
            Shape (n, 3). One array may have a single row or shape (3,), for all rays. Directions need not have
            length 1.
        tmin, tmax
            Numbers, or arrays of shape (n,). Both ends belong to the ray.

        Raises
        ------
        TypeError
            An array has another dtype than the scene.
        ValueError
            Shapes do not fit, a number is not finite, a direction is zero, or ``0 <= tmin <= tmax`` does not hold.

        Examples
        --------
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> hits = scene.closest([[0.25, 0.5, 2], [5, 5, 2]], [0, 0, -1])
        >>> hits.t, hits.primitive, hits.uv[0]
        (array([ 2., inf]), array([ 0, -1]), array([0.25, 0.5 ]))
        """
        native, asked = self._native, self._rays(origins, directions, tmin, tmax)
        exact = partial(native.exact, asked, native.refits)
        return Hits(*native.closest(asked, progress), _rays=exact)

    def any(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Returns whether each ray hits a face: shape (n,). Parameters and errors are those of `closest`.

        Examples
        --------
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> scene.any([[0.25, 0.25, 2], [5, 5, 2]], [0, 0, -1], tmax=3)
        array([ True, False])
        """
        return self._native.any(self._rays(origins, directions, tmin, tmax), progress)

    def all_hits(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> AllHits:
        """Returns all hits of each ray, each face once. Parameters and errors are those of `closest`.

        A ray through an edge hits the faces on each side of the edge; `AllHits.place` marks such hits.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> hits = scene.all_hits([[0.25, 0.25, -1], [9, 9, 9]], [0, 0, 1])
        >>> hits.rays, hits.primitives, hits.t, hits.place
        (array([0, 0]), array([0, 3]), array([1. , 1.5]), array([0, 0], dtype=uint8))
        """
        return AllHits(*all_arrays(self._native.all(self._rays(origins, directions, tmin, tmax), progress)))

    def count_crossings(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.int64]:
        """Returns how often each ray crosses the mesh: shape (n,). Parameters and errors are those of `closest`.

        A crossing at an edge or a vertex of a closed mesh counts once, and touching an edge or a vertex counts an even
        number of times (the half-open rule). From inside a closed mesh the number is odd, from outside it is even.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> scene.count_crossings([[0.1, 0.1, 0.1], [-1, -1, -1]], [1, 1, 1])
        array([1, 2])
        """
        return self._native.crossings(self._rays(origins, directions, tmin, tmax), progress)

    def nearest(
        self,
        points: ArrayLike,
        radius: ArrayLike = np.inf,
        k: int = 1,
        progress: Progress | None = None,
        details: bool = False,
    ) -> Near:
        """Returns the `k` faces that are nearest to each point, within a radius, in order of distance, then of face.

        Faces without area, which rays miss, are segments and points.

        Parameters
        ----------
        points
            Shape (n, 3).
        radius
            A number or shape (n,). Faces at this distance are included.
        k
            Number of faces, at least 1. With fewer faces, rows are filled like rows beyond the radius.
        details
            Also return the position of each point on its face (``uv``, ``place``), and the ``normal`` of the face.

        Raises
        ------
        TypeError
            An array has another dtype than the scene, or `k` is not an integer.
        ValueError
            The shape does not fit, a number is not finite, a radius is negative, or `k` is less than 1.
        MemoryError
            There is not enough memory for arrays of `k` rows for each point.

        Examples
        --------
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> near = scene.nearest([[0.25, 0.5, 3], [0, -2, 0]])
        >>> near.distance, near.point[0]
        (array([3., 2.]), array([0.25, 0.5 , 0.  ]))
        >>> near = scene.nearest([[0.25, 0.5, 3], [0, -2, 0]], details=True)
        >>> near.uv[0], near.place, near.normal[0]
        (array([0.25, 0.5 ]), array([0, 2], dtype=uint8), array([0., 0., 1.]))
        """
        try:
            k = operator.index(k)
        except TypeError:
            raise TypeError(f"k: {k!r}, expected an integer") from None
        if k < 1:
            raise ValueError(f"k: {k}, expected at least 1")
        points = rows(points, "points", self._native.dtype)
        radii = per_row(radius, "radius", self._native.dtype, len(points))
        near, more = self._native.nearest((points, radii), min(k, sys.maxsize), bool(details), progress)
        distance, primitive, point = near
        shape = distance.shape if k > 1 else distance.shape[:1]
        details_of = (None,) * 3 if more is None else tuple(array.reshape(*shape, *array.shape[1:]) for array in more)
        return Near(distance.reshape(shape), primitive.reshape(shape), point.reshape(*shape, 3), *details_of)

    def refit(self, vertices: ArrayLike, optimize: bool = False, progress: Progress | None = None) -> None:
        """Moves the vertices. Their number must not change. Takes a twentieth of the time of a build.

        Queries stay exact, and become slower the more the faces move relative to each other. `optimize` then moves
        parts of the hierarchy to better places, in a quarter of the time of a build. While another thread queries the
        scene, this method fails with a RuntimeError; so do queries of other threads while it runs.

        There are three steps: checking the numbers, moving the vertices, optimizing the hierarchy. After each step the
        method checks for Ctrl-C and calls ``progress(done, count)``. After Ctrl-C the vertices are all old or all new.

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The shape does not fit, or a coordinate is not finite. The scene is unchanged.

        Examples
        --------
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> scene.refit(scene.vertices + [0, 0, 5])
        >>> scene.closest([0.25, 0.25, 9], [0, 0, -1]).t
        array([4.])
        """
        self._native.refit(rows(vertices, "vertices", self._native.dtype), optimize, progress)

    def save(self, path: str | os.PathLike[str], progress: Progress | None = None) -> None:
        """Writes mesh and hierarchy to a file atomically, also after Ctrl-C.

        An existing file keeps its permissions, and is not replaced if it is read-only. Links are followed.
        ``progress(done, count)`` is called periodically, with per cent of the file.

        Raises
        ------
        OSError
            The file cannot be written, as `open` says it.

        Examples
        --------
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> scene.save("triangle.scene")
        >>> Scene.load("triangle.scene").faces
        array([[0, 1, 2]])
        """
        self._native.save(os.fsdecode(path), progress)

    @classmethod
    def load(cls, path: str | os.PathLike[str], progress: Progress | None = None) -> Scene:
        """Reads a scene that `save` has written. Ctrl-C and `progress` are as for `save`.

        Raises
        ------
        ValueError
            The file is damaged, or not a saved scene. All content is checked: a file cannot cause wrong answers.
        OSError
            The file cannot be read, as `open` says it.
        """
        scene = cls.__new__(cls)
        scene._native = _native.Scene.load(os.fsdecode(path), progress)
        return scene

    @classmethod
    def load_mesh(
        cls,
        path: str | os.PathLike[str],
        dtype: DTypeLike = np.float64,
        build: str = "standard",
        progress: Progress | None = None,
    ) -> Scene:
        """Builds a scene from the mesh in a PLY, OBJ, STL or glTF file (.ply, .obj, .stl, .gltf, .glb).

        Faces have the order of the file. A polygon of n corners becomes n - 2 faces within its outline.
        The nodes of a glTF file place its meshes. `build` and `progress` are as for `Scene`.

        Warns
        -----
        UserWarning
            Parts of the file were skipped or changed, or float32 rounds its numbers.

        Raises
        ------
        TypeError
            `dtype` is neither float32 nor float64.
        ValueError
            The file has no mesh of triangles; the message names the line or the element.
        OSError
            The file cannot be read, as `open` says it.

        Examples
        --------
        >>> scene = Scene.load_mesh("part.stl")  # doctest: +SKIP
        """
        wanted = np.dtype(dtype)
        if wanted not in (np.float32, np.float64):
            raise TypeError(f"dtype: {wanted}, expected float32 or float64")
        scene = cls.__new__(cls)
        scene._native, note = _native.Scene.load_mesh(os.fsdecode(path), wanted.name, build, progress)
        if note is not None:
            warnings.warn(note, stacklevel=2)
        return scene

    def _rays(self, origins: ArrayLike, directions: ArrayLike, tmin: ArrayLike, tmax: ArrayLike) -> list[NDArray[Any]]:
        return rays(origins, directions, tmin, tmax, self._native.dtype)

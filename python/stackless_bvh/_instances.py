"""Scenes with many placements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import array_of, numbers, per_row, rays, rows
from ._exact import Hits
from ._inside import Progress
from ._native import Instances as NativeInstances
from ._results import AllHits, Near, all_arrays
from ._scene import Scene


class _Placed:
    path: NDArray[np.int64]

    @property
    def instance(self) -> NDArray[np.int64]:
        """Rows of `objects` of the outermost instances, one for each row of `path`; -1 for a miss."""
        return self.path[:, 0]


@dataclass(frozen=True)
class InstanceHits(_Placed, Hits):
    """The closest hit of each of n rays among instances."""

    path: NDArray[np.int64]
    """Shape (n, levels): rows of `objects`, the outermost instances first; -1 for unused levels and for misses."""


@dataclass(frozen=True)
class AllInstanceHits(_Placed, AllHits):
    """All hits of n rays among instances, by distance, then by path, then by face."""

    path: NDArray[np.int64]
    """Shape (m, levels): rows of `objects`, the outermost instances first; -1 for unused levels."""


@dataclass(frozen=True)
class InstanceNear(_Placed, Near):
    """The nearest faces of n points among instances."""

    path: NDArray[np.int64] = field(kw_only=True)
    """Shape (n, levels): rows of `objects`, the outermost instances first; -1 for unused levels and without a face."""


class Instances:
    """Scenes and nested instances of one dtype, placed any number of times by affine maps. Answers equal those of
    rational arithmetic on the exact images of the triangles.

    Parameters
    ----------
    scenes
        The placed objects: each a `Scene` or an `Instances`, nested up to 31 deep, all float32 or all float64. They are
        shared, not copied. A later `refit` of a scene does not change the instances.
    objects
        Shape (n,), integers: the index in `scenes` of each instance.
    transforms
        Shape (n, 3, 4) or (n, 4, 4), of the dtype of the scenes: the map from the scene's space to the world's. A
        fourth row must be [0, 0, 0, 1].
    progress
        Called periodically during the build as ``progress(done, count)``, with numbers of instances.

    Raises
    ------
    TypeError
        An array has another dtype, or an item of `scenes` has another type.
    ValueError
        A scene has another dtype than the first one, instances are nested too deeply, shapes do not fit, an index is
        out of range, a map has no inverse, or an image leaves the range of the dtype; the message names the row.

    Examples
    --------
    >>> import numpy as np
    >>> from stackless_bvh import Instances, Scene
    >>> triangle = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> maps = np.tile(np.eye(4), (2, 1, 1))
    >>> maps[1, :3, 3] = [5, 0, -1]
    >>> hits = Instances([triangle], [0, 0], maps).closest([[0.25, 0.25, 2], [5.25, 0.25, 2]], [0, 0, -1])
    >>> hits.instance, hits.t
    (array([0, 1]), array([2., 3.]))
    """

    __slots__ = ("_native",)
    _native: NativeInstances

    def __init__(
        self,
        scenes: Sequence[Scene | Instances],
        objects: ArrayLike,
        transforms: ArrayLike,
        progress: Progress | None = None,
    ) -> None:
        for i, scene in enumerate(scenes):
            if not isinstance(scene, (Scene, Instances)):
                raise TypeError(f"scenes[{i}]: {type(scene).__name__}, expected a Scene or Instances")
        indices = array_of(objects, "objects", None)
        if indices.dtype.kind not in "iu":
            raise TypeError(f"objects: dtype {indices.dtype}, expected integers")
        if indices.ndim != 1:
            raise ValueError(f"objects: shape {indices.shape}, expected (n,)")
        natives = [scene._native for scene in scenes]
        # Without scenes there is no index either.
        dtype = natives[0].dtype if natives else "float64"
        maps = numbers(transforms, "transforms", dtype)
        if maps.shape[1:] not in ((3, 4), (4, 4)) or len(maps) != len(indices):
            raise ValueError(
                f"transforms: shape {maps.shape}, expected ({len(indices)}, 3, 4) or ({len(indices)}, 4, 4)"
            )
        if maps.shape[1] == 4:
            wrong = np.flatnonzero((maps[:, 3] != [0, 0, 0, 1]).any(axis=1))
            if len(wrong):
                raise ValueError(
                    f"transforms[{wrong[0]}]: fourth row {maps[wrong[0], 3].tolist()}, expected [0, 0, 0, 1]"
                )
        self._native = NativeInstances(natives, indices.astype(np.int64), maps[:, :3], dtype, progress)

    def __len__(self) -> int:
        return len(self._native)

    def __copy__(self) -> Instances:
        # Instances are immutable.
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Instances:
        return self

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64."""
        return np.dtype(self._native.dtype)

    def closest(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> InstanceHits:
        """Returns the closest hit of each ray: the least exact distance, then the least path, then the least face.

        Parameters and errors are those of `Scene.closest`.
        """
        path, hits = self._native.closest(self._rays(origins, directions, tmin, tmax), progress)
        return InstanceHits(*hits, path)

    def any(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Returns whether each ray hits a face: shape (n,). Parameters and errors are those of `closest`."""
        return self._native.any(self._rays(origins, directions, tmin, tmax), progress)

    def all_hits(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> AllInstanceHits:
        """Returns all hits of each ray, each face of each instance once. Parameters and errors are those of `closest`.

        Examples
        --------
        >>> triangle = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> maps = np.tile(np.eye(4), (2, 1, 1))
        >>> maps[1, 2, 3] = -1
        >>> hits = Instances([triangle], [0, 0], maps).all_hits([0.25, 0.25, 2], [0, 0, -1])
        >>> hits.rays, hits.instance, hits.t
        (array([0, 0]), array([0, 1]), array([2., 3.]))
        """
        path, found = self._native.all(self._rays(origins, directions, tmin, tmax), progress)
        return AllInstanceHits(*all_arrays(found), path)

    def count_crossings(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.int64]:
        """Returns how often each ray crosses the instances: shape (n,). Parameters and errors are those of `closest`.

        The rule is that of `Scene.count_crossings`, on the exact images. If all scenes are closed, the number is odd
        iff an odd number of instances contain the origin. Mirrored instances count like others.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> maps = np.tile(np.eye(4), (2, 1, 1))
        >>> maps[1, :3, 3] = 1
        >>> Instances([scene], [0, 0], maps).count_crossings([[0.1, 0.1, 0.1], [-1, -1, -1]], [1, 1, 1])
        array([3, 4])
        """
        return self._native.crossings(self._rays(origins, directions, tmin, tmax), progress)

    def nearest(self, points: ArrayLike, radius: ArrayLike = np.inf, progress: Progress | None = None) -> InstanceNear:
        """Returns the face of an instance that is nearest to each point, within a radius: the least distance, then the
        least path, then the least face.

        Parameters and errors are those of `Scene.nearest`, which is many times faster: here, intervals bound the images
        of all boxes, and rational arithmetic computes each nearest point.

        Examples
        --------
        >>> triangle = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> maps = np.tile(np.eye(4), (2, 1, 1))
        >>> maps[1, 2, 3] = 5
        >>> near = Instances([triangle], [0, 0], maps).nearest([[0.25, 0.5, 3], [0, -2, 0]])
        >>> near.instance, near.distance, near.point[0]
        (array([1, 0]), array([2., 2.]), array([0.25, 0.5 , 5.  ]))
        """
        dtype = self._native.dtype
        points = rows(points, "points", dtype)
        path, found = self._native.nearest((points, per_row(radius, "radius", dtype, len(points))), progress)
        return InstanceNear(*found, path=path)

    def _rays(self, origins: ArrayLike, directions: ArrayLike, tmin: ArrayLike, tmax: ArrayLike) -> list[NDArray[Any]]:
        return rays(origins, directions, tmin, tmax, self._native.dtype)

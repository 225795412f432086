"""Scenes with many placements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import array_of, numbers, rays
from ._exact import Hits
from ._inside import Progress
from ._native import Instances as NativeInstances
from ._scene import Scene


@dataclass(frozen=True)
class InstanceHits(Hits):
    """The closest hit of each of n rays among instances."""

    path: NDArray[np.int64]
    """Shape (n, levels): rows of `objects`, the outermost instances first; -1 for unused levels and for misses."""

    @property
    def instance(self) -> NDArray[np.int64]:
        """Shape (n,): rows of `objects` of the outermost instances; -1 for a miss."""
        return self.path[:, 0]


class Instances:
    """Float32 scenes and nested instances, placed any number of times by affine maps. Answers equal those of rational
    arithmetic on the exact images of the triangles.

    Parameters
    ----------
    scenes
        The placed objects: each a `Scene` or an `Instances`, nested up to 31 deep. A later `refit` of a scene does not
        change the instances.
    objects
        Shape (n,), integers: the index in `scenes` of each instance.
    transforms
        Shape (n, 3, 4) or (n, 4, 4), float32: the map from the scene's space to the world's. A fourth row must be
        [0, 0, 0, 1].
    progress
        Called periodically during the build as ``progress(done, count)``, with numbers of faces.

    Raises
    ------
    TypeError
        An array has another dtype, or an item of `scenes` has another type.
    ValueError
        A scene is float64, instances are nested too deeply, shapes do not fit, an index is out of range, a map has no
        inverse, or an image leaves the range of float32; the message names the row.

    Examples
    --------
    >>> import numpy as np
    >>> from stackless_bvh import Instances, Scene
    >>> triangle = Scene(np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]])
    >>> maps = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    >>> maps[1, :3, 3] = [5, 0, -1]
    >>> hits = Instances([triangle], [0, 0], maps).closest([[0.25, 0.25, 2], [5.25, 0.25, 2]], [0, 0, -1])
    >>> hits.instance, hits.t
    (array([0, 1]), array([2., 3.], dtype=float32))
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
        maps = numbers(transforms, "transforms", "float32")
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
        natives = [scene._native for scene in scenes]
        self._native = NativeInstances(natives, indices.astype(np.int64), maps[:, :3], progress)

    def __len__(self) -> int:
        return len(self._native)

    def __copy__(self) -> Instances:
        # Instances are immutable.
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Instances:
        return self

    def closest(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> InstanceHits:
        """Returns the closest hit of each ray: the least exact distance, then the least path, then the least face.

        Parameters and errors are those of `Scene.closest`, for float32.
        """
        path, hits = self._native.closest(rays(origins, directions, tmin, tmax, "float32"), progress)
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
        return self._native.any(rays(origins, directions, tmin, tmax, "float32"), progress)

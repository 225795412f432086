"""Scenes that are placed many times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import listed, numbers, rays
from ._results import Hits
from ._scene import Progress, Scene


@dataclass(frozen=True)
class InstanceHits(Hits):
    """The closest hit of each of n rays among instances."""

    instance: NDArray[np.int64]
    """Shape (n,): rows of `objects`; -1 for a miss."""


class Instances:
    """Float32 scenes that are placed by affine maps, each as often as need be. Answers are those of rational
    arithmetic on the exact images of the triangles.

    Parameters
    ----------
    scenes
        The scenes that are placed. What `refit` does to one of them later does not change the instances.
    objects
        Shape (n,), integers: which scene each instance is.
    transforms
        Shape (n, 3, 4) or (n, 4, 4), float32: the map from the scene's space to the world's. A fourth row must be
        [0, 0, 0, 1].

    Raises
    ------
    TypeError
        An array has another dtype.
    ValueError
        A scene is float64, shapes do not fit, there is no such scene, a map has no inverse, or an image leaves the
        range of float32; the message names the row.
    """

    __slots__ = ("_native",)

    def __init__(self, scenes: Sequence[Scene], objects: ArrayLike, transforms: ArrayLike) -> None:
        indices = objects if isinstance(objects, np.ndarray) else listed(objects, "objects", None)
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
        self._native = _native.Instances([scene._native for scene in scenes], indices.astype(np.int64), maps[:, :3])

    def __len__(self) -> int:
        return len(self._native)

    def closest(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> InstanceHits:
        """The closest hit of each ray: the least `t`, of equal ones the least instance, of these the least face.

        Parameters and errors are those of `Scene.closest`, for float32.
        """
        instance, hits = self._native.closest(rays(origins, directions, tmin, tmax, "float32"), progress)
        return InstanceHits(*hits, instance)

    def any(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Whether each ray hits anything: shape (n,). Parameters and errors are those of `closest`."""
        return self._native.any(rays(origins, directions, tmin, tmax, "float32"), progress)

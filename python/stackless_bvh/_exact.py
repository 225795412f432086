"""Rays that start or end at exact points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import per_row, rows
from ._results import AllHits, all_arrays

Progress = Callable[[int, int], object]


class ExactRays:
    """Rays over a scene whose ends are exact points: unrounded hits, or points of floats.

    `Scene.segments`, `Hits.continue_with` and `Hits.toward` create them. They keep the current mesh, even if the scene
    is refitted later. A row after a miss has no ray, and misses.
    """

    def __init__(self, native: _native.ExactRays) -> None:
        self._native = native

    def __len__(self) -> int:
        return len(self._native)

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64."""
        return np.dtype(self._native.dtype)

    def closest(self, progress: Progress | None = None) -> Hits:
        """Returns the closest hit of each ray, like `Scene.closest`. Rays can continue from its exact points."""
        return Hits(*self._native.closest(progress), _rays=self._native)

    def any(self, progress: Progress | None = None) -> NDArray[np.bool_]:
        """Returns whether each ray hits a face: shape (n,)."""
        return self._native.any(progress)

    def all_hits(self, progress: Progress | None = None) -> AllHits:
        """Returns all hits of each ray, like `Scene.all_hits`."""
        return AllHits(*all_arrays(self._native.all(progress)))


class Segments:
    """Queries of a scene from points to points."""

    _native: _native.Scene

    def segments(self, a: ArrayLike, b: ArrayLike, closed: bool = True) -> ExactRays:
        """Returns rays that start exactly at `a` and end exactly at `b`: ``t`` is 0 at `a` and 1 at `b`.

        The direction ``b - a`` is not rounded, unlike a direction for `closest`.

        Parameters
        ----------
        a, b
            Shape (n, 3) or (3,).
        closed
            Whether the ends belong to the segments. If not, faces are not hit at the ends. `any` then returns whether a
            face blocks the view between two points on the mesh.

        Raises
        ------
        TypeError
            An array has another dtype than the scene.
        ValueError
            Shapes do not fit, a number is not finite, or two ends are equal.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> scene.segments([0.1, 0.2, 0.3], vertices).closest().t
        array([1., 1., 1., 1.])
        >>> scene.segments([0.1, 0.2, 0.3], vertices, closed=False).any()
        array([False, False, False, False])
        """
        dtype = self._native.dtype
        starts, ends = rows(a, "a", dtype), rows(b, "b", dtype)
        if len(starts) != len(ends) and 1 not in (len(starts), len(ends)):
            raise ValueError(f"{len(starts)} rows of a and {len(ends)} of b, expected as many of both")
        count = len(ends) if len(starts) == 1 else len(starts)
        both = [np.broadcast_to(array, (count, 3)) for array in (starts, ends)]
        return ExactRays(self._native.segments(both, closed))


@dataclass(frozen=True)
class Hits:
    """The closest hit of each of n rays. Numbers are of the scene's dtype."""

    t: NDArray[np.floating]
    """Shape (n,): distances along the rays, in lengths of their directions; infinite for a miss."""
    primitive: NDArray[np.int64]
    """Shape (n,): rows of `faces`; -1 for a miss."""
    uv: NDArray[np.floating]
    """Shape (n, 2): weights of the face's second and third vertex; NaN for a miss."""
    _rays: _native.ExactRays | Callable[[], _native.ExactRays] | None = field(
        default=None, repr=False, compare=False, kw_only=True
    )

    @property
    def hit(self) -> NDArray[np.bool_]:
        """Shape (n,): whether there is a hit."""
        return self.primitive >= 0

    def __len__(self) -> int:
        return len(self.t)

    def continue_with(self, directions: ArrayLike, tmax: ArrayLike = np.inf, closed: bool = False) -> ExactRays:
        """Returns rays from the exact points of the hits, not rounded: no epsilon is needed.

        Parameters
        ----------
        directions
            Shape (n, 3) or (3,). Rows of misses are unused, but must be valid directions.
        tmax
            The maximum distance, in lengths of the direction: a number or shape (n,).
        closed
            Whether the ends belong to the rays. If not, a ray does not hit the face that it leaves, nor any other face
            that contains its origin.

        Raises
        ------
        ValueError
            Shapes do not fit, a number is not finite, a direction is zero, the arrays of the rays have changed, or the
            scene was refitted since. Unpickled hits, and hits of `Instances`, have no rays.

        Examples
        --------
        >>> from stackless_bvh import Scene
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> out = scene.closest([[0.1, 0.1, 0.1]], [[0.7, 0.2, 0.3]])
        >>> back = out.continue_with([[-0.3, -0.1, -0.7]]).closest()
        >>> out.primitive, back.primitive
        (array([3]), array([0]))
        """
        native = self._exact()
        count = len(self)
        ways = np.broadcast_to(rows(directions, "directions", native.dtype), (count, 3))
        tmax = per_row(tmax, "tmax", native.dtype, count)
        return ExactRays(native.along(self.primitive, ways, tmax, closed))

    def toward(self, points: ArrayLike, closed: bool = False) -> ExactRays:
        """Returns rays from the exact points of the hits to given points, for visibility. ``t`` is 1 at these points.

        Parameters
        ----------
        points
            Shape (n, 3) or (3,).
        closed
            Whether the ends belong to the rays.

        Raises
        ------
        ValueError
            See `continue_with`; also if a point equals the hit.

        Examples
        --------
        >>> from stackless_bvh import Scene
        >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> floor = scene.closest([[0.1, 0.1, -1], [0.2, 0.2, -1]], [0, 0, 1])
        >>> floor.toward([0.1, 0.1, -5]).any(), floor.toward([0, 0, 5]).any()
        (array([False, False]), array([ True,  True]))
        """
        native = self._exact()
        targets = np.broadcast_to(rows(points, "points", native.dtype), (len(self), 3))
        return ExactRays(native.toward(self.primitive, targets, closed))

    def _exact(self) -> _native.ExactRays:
        if self._rays is None:
            raise ValueError("these hits have no rays: they were unpickled, or are of instances")
        return self._rays() if callable(self._rays) else self._rays

    def __getstate__(self) -> dict[str, Any]:
        # The exact points of the rays belong to a scene that is not pickled.
        return {**self.__dict__, "_rays": None}

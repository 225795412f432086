"""Inside and outside: whether a mesh is closed, and where points are."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import rows
from ._native import Scene as NativeScene

Progress = Callable[[int, int], object]


class Inside:
    """The part of a `Scene` that is about inside and outside."""

    __slots__ = ()

    _native: NativeScene

    @property
    def is_closed(self) -> bool:
        """Whether every point of every edge is covered an even number of times, so that the mesh has an inside.

        This is exact. Vertices of equal coordinates are one, and a vertex may lie in the middle of a neighbour's edge
        (a T-junction). How faces are oriented does not matter.
        """
        return self._native.boundary()[0] == 0

    @property
    def is_oriented(self) -> bool:
        """Whether every point of every edge is run through as often in one direction as in the other.

        Such a mesh is closed too, and its winding numbers are integers.
        """
        return self._native.boundary()[1] == 0

    def contains(
        self,
        points: ArrayLike,
        boundary: bool = True,
        progress: Progress | None = None,
        rule: Literal["parity", "nonzero", "winding"] = "parity",
    ) -> NDArray[np.bool_]:
        """Whether each point is inside of the mesh: shape (n,). Only with ``rule="winding"`` it may be open.

        Parameters
        ----------
        points
            Shape (n, 3).
        boundary
            What is answered for points that are exactly on a face that has an area.
        rule
            ``"parity"``: a point is inside where a ray crosses the mesh an odd number of times, whatever the
            orientation of faces. Parts that overlap cancel out. The mesh must be closed. ``"nonzero"``: a point is
            inside where the winding number is not 0. Parts that overlap unite. The mesh must be closed and oriented.
            ``"winding"``: a point is inside where the winding number is above 1/2, whatever the mesh. Where it has
            holes, this is a good guess.

        Warns
        -----
        UserWarning
            Faces repeat earlier ones, which cancel out by parity.

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The mesh is not closed (the message names an edge) or not oriented, the rule is unknown, the shape does not
            fit, or a number is not finite.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> scene.contains([[0.1, 0.1, 0.1], [1, 1, 1], [0, 0, 0]])
        array([ True, False,  True])
        """
        points = rows(points, "points", self._native.dtype)
        self._check_rule(rule)
        return self._native.contains(points, rule, bool(boundary), progress)

    def signed_distance(
        self,
        points: ArrayLike,
        rule: Literal["parity", "nonzero", "winding"] = "parity",
        progress: Progress | None = None,
    ) -> NDArray[np.floating]:
        """How far each point is from the mesh, negative inside: shape (n,), of the scene's dtype.

        Each is the float nearest to the exact distance, with the exact sign of the rule, and 0 on the mesh.

        Parameters
        ----------
        points
            Shape (n, 3).
        rule
            What is inside, as in `contains`.

        Warns
        -----
        UserWarning
            As `contains`.

        Raises
        ------
        TypeError, ValueError
            As `contains`.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> scene.signed_distance([[0.25, 0.25, 0.125], [0, 0, -2], [0.5, 0, 0]])
        array([-0.125,  2.   ,  0.   ])
        """
        points = rows(points, "points", self._native.dtype)
        self._check_rule(rule)
        return self._native.signed_distances(points, rule, progress)

    def _check_rule(self, rule: str) -> None:
        """Raises where a rule does not fit the mesh, and warns where its answer may not be what is expected."""
        count, unpaired, repeated, wrong = self._native.boundary()
        if rule in ("parity", "nonzero") and wrong is not None:
            more = "" if count == 1 else f" ({count} such edges)"
            raise ValueError(f"the mesh is not closed: {wrong}{more}; rule='winding' fits it")
        if rule == "nonzero" and unpaired > 0:
            raise ValueError(
                "the mesh is not oriented: its faces run through "
                f"{unpaired} of its edges more often in one direction than in the other; rule='parity' fits it"
            )
        if rule == "parity" and repeated > 0:
            warnings.warn(
                f"{repeated} of the faces repeat earlier ones, and cancel them out by parity: rule='nonzero' does not",
                stacklevel=3,
            )

    def winding_number(
        self, points: ArrayLike, progress: Progress | None = None, *, tolerance: float = 1e-6
    ) -> NDArray[np.float64]:
        """How often the mesh winds around each point: shape (n,), float64.

        It is 1 inside of a closed surface whose faces are seen counterclockwise from outside, 2 where two of them
        overlap, -1 inside of one that is turned, and 0 outside. A hole changes it by the part of the view that the hole
        takes up. Closed and oriented meshes have exact integers. The numbers of other meshes are right within
        `tolerance`, unless a point is on an open edge. Of a point that is exactly on a face, it is the number of one of
        its sides.

        Parameters
        ----------
        points
            Shape (n, 3).
        tolerance
            The greatest error; below 1e-9 it is 1e-9. The smaller it is, the longer the numbers of open meshes take.

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The shape does not fit, or a number is not finite.

        Examples
        --------
        >>> vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> scene = Scene(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> scene.winding_number([[0.1, 0.1, 0.1], [1, 1, 1]])
        array([1., 0.])
        """
        return self._native.winding_numbers(rows(points, "points", self._native.dtype), tolerance, progress)

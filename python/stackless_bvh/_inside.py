"""Inside and outside: whether a mesh is closed, and the location of points."""

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
    """The queries of a `Scene` about inside and outside."""

    __slots__ = ()

    _native: NativeScene

    @property
    def is_closed(self) -> bool:
        """Whether every point of every edge is covered an even number of times, so that the mesh has an inside.

        The answer is exact. Vertices with equal coordinates count as one, and a vertex may be in the middle of a
        neighbour's edge (a T-junction). The orientation of faces does not matter.
        """
        return self._native.boundary()[0] == 0

    @property
    def is_oriented(self) -> bool:
        """Whether the faces run through every point of every edge equally often in each direction.

        Such a mesh is also closed, and its winding numbers are integers.
        """
        return self._native.boundary()[1] == 0

    def contains(
        self,
        points: ArrayLike,
        boundary: bool = True,
        progress: Progress | None = None,
        rule: Literal["parity", "nonzero", "winding"] = "parity",
    ) -> NDArray[np.bool_]:
        """Returns whether each point is inside the mesh: shape (n,). Only with ``rule="winding"`` the mesh may be open.

        Parameters
        ----------
        points
            Shape (n, 3).
        boundary
            The answer for points that are exactly on a face with area.
        rule
            ``"parity"``: a point is inside if a ray from it crosses the mesh an odd number of times. The orientation of
            faces does not matter. Overlapping parts cancel out. The mesh must be closed. ``"nonzero"``: a point
            is inside if its winding number is not 0. Overlapping parts unite. The mesh must be closed and oriented.
            ``"winding"``: a point is inside if its winding number is above 1/2. Any mesh is allowed. Near holes this is
            a good guess.

        Warns
        -----
        UserWarning
            Repeated faces cancel out by parity.

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
        """Returns the distance of each point from the mesh, negative inside: shape (n,), of the scene's dtype.

        Each distance is the float nearest to the exact distance, with the exact sign of the rule, and 0 on the mesh.

        Parameters
        ----------
        points
            Shape (n, 3).
        rule
            The rule of `contains`.

        Warns
        -----
        UserWarning
            See `contains`.

        Raises
        ------
        TypeError, ValueError
            See `contains`.

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
        """Raises if a rule does not fit the mesh, and warns if its answers may be unexpected."""
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
        """Returns the winding number of the mesh around each point: shape (n,), float64.

        It is 1 inside a closed surface whose faces are counterclockwise seen from outside, 2 where two such surfaces
        overlap, -1 inside a reversed surface, and 0 outside. A hole changes it by the fraction of the view that the
        hole occupies. Numbers of closed and oriented meshes are exact integers. Numbers of other meshes have errors up
        to `tolerance`, unless a point is on an open edge. A point exactly on a face has the number of one of the sides.

        Parameters
        ----------
        points
            Shape (n, 3).
        tolerance
            The maximum error, at least 1e-9. For open meshes, smaller errors take longer.

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

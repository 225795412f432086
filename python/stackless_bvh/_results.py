"""Results of queries: arrays with a row for each ray or point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class AllHits:
    """All hits of n rays, by distance, then by face. The hits of ray i are rows offsets[i] to offsets[i + 1]."""

    offsets: NDArray[np.int64]
    """Shape (n + 1,), from 0 to the number m of hits."""
    primitives: NDArray[np.int64]
    """Shape (m,): rows of `faces`. Each face occurs once for a ray."""
    t: NDArray[np.floating]
    """Shape (m,): distances."""
    uv: NDArray[np.floating]
    """Shape (m, 2): weights of the face's second and third vertex."""
    place: NDArray[np.uint8]
    """Shape (m,): the exact place of the hit on the face: 0 in its interior, 1 on an edge, 2 at a vertex."""

    @property
    def rays(self) -> NDArray[np.int64]:
        """Shape (m,): the ray of each hit."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    def __len__(self) -> int:
        return len(self.offsets) - 1


def all_arrays(
    found: tuple[NDArray[np.int64], tuple[NDArray[Any], NDArray[np.int64], NDArray[Any]], NDArray[np.uint8]],
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[Any], NDArray[Any], NDArray[np.uint8]]:
    """Returns the arrays of the extension module in the order of `AllHits`."""
    offsets, (t, primitives, uv), place = found
    return offsets, primitives, t, uv, place


@dataclass(frozen=True)
class Near:
    """The nearest faces of n points: arrays of n rows, with a second axis of length k if k > 1. Numbers have the
    scene's dtype."""

    distance: NDArray[np.floating]
    """Shape (n,) or (n, k): the floats nearest to the exact distances; infinite if no face is within the radius."""
    primitive: NDArray[np.int64]
    """Shape (n,) or (n, k): rows of `faces`; -1 if no face is within the radius."""
    point: NDArray[np.floating]
    """Shape (n, 3) or (n, k, 3): the nearest points, each coordinate rounded once; NaN without a face."""
    uv: NDArray[np.floating] | None = None
    """With ``details``. Shape (n, 2) or (n, k, 2): weights of the face's second and third vertex, each rounded once."""
    place: NDArray[np.uint8] | None = None
    """With ``details``. Shape (n,) or (n, k): the exact place of the nearest point on the face: 0 in its
    interior, 1 on an edge, 2 at a vertex, 255 without a face."""
    normal: NDArray[np.floating] | None = None
    """With ``details``. Shape (n, 3) or (n, k, 3): normals of the faces, of length 1, each component rounded once. Seen
    from the tip of a normal, vertices are counterclockwise. NaN for a face without area."""

    def __len__(self) -> int:
        return len(self.distance)

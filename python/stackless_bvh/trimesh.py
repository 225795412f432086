"""A ray intersector for trimesh with exact answers.

>>> import trimesh
>>> from stackless_bvh.trimesh import RayMeshIntersector
>>> mesh = trimesh.creation.icosphere()
>>> mesh.ray = RayMeshIntersector(mesh)
>>> mesh.ray.intersects_any([[0, 0, 0]], [[0, 0, 1]])
array([ True])
>>> mesh.contains([[0, 0, 0], [0, 0, 2]])
array([ True, False])

It has the methods of `trimesh.ray.ray_triangle.RayMeshIntersector` and `trimesh.ray.ray_pyembree.RayMeshIntersector`,
with equal arguments and kinds of answers, in float64 like trimesh.
"""

from __future__ import annotations

import warnings
import weakref
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import array_of, check_shape
from ._results import AllHits
from ._scene import Scene

if TYPE_CHECKING:
    import trimesh

_Indices = NDArray[np.int64]


class RayMeshIntersector:
    """Ray queries of a `trimesh.Trimesh` over an exact `Scene`, which is built on first use, and again after changes of
    the mesh.

    Parameters
    ----------
    geometry
        The mesh.
    scale_to_box
        For compatibility only: exact answers need no scaling.
    """

    def __init__(self, geometry: trimesh.Trimesh, scale_to_box: bool = True) -> None:
        self.mesh = geometry

    @property
    def scene(self) -> Scene | None:
        """The scene over the current mesh; None for a mesh without faces."""
        return scene_of(self.mesh)

    def intersects_id(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool = True,
        max_hits: int | None = None,
        return_locations: bool = False,
    ) -> tuple[_Indices, _Indices] | tuple[_Indices, _Indices, NDArray[np.float64]]:
        """Returns the faces that rays hit, in the order of rays, then of distance.

        At an edge or a vertex, a ray hits all adjacent faces. With `return_locations`, each location of a ray occurs
        once, with its first face.

        Parameters
        ----------
        ray_origins, ray_directions
            Shape (n, 3). A ray without a direction hits nothing.
        multiple_hits
            All hits, or the first one of each ray.
        max_hits
            Maximum number of hits of each ray; the nearest hits are kept.
        return_locations
            Whether to return the locations of the hits.

        Returns
        -------
        index_tri : (m,) int64
            Rows of `mesh.faces`.
        index_ray : (m,) int64
            Rows of `ray_origins`.
        locations : (m, 3) float64
            Only with `return_locations`.

        Raises
        ------
        ValueError
            Shapes do not fit, or a number is not finite.
        """
        index_tri, index_ray, locations = self._hits(
            ray_origins, ray_directions, multiple_hits, max_hits, return_locations
        )
        return (index_tri, index_ray, locations) if return_locations else (index_tri, index_ray)

    def intersects_location(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool = True,
        max_hits: int | None = None,
    ) -> tuple[NDArray[np.float64], _Indices, _Indices]:
        """Returns the locations where rays hit the mesh, each once: `(locations, index_ray, index_tri)`.

        Parameters and errors are those of `intersects_id`.
        """
        index_tri, index_ray, locations = self._hits(ray_origins, ray_directions, multiple_hits, max_hits, True)
        return locations, index_ray, index_tri

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> _Indices:
        """Returns the first face that each ray hits, of equally near faces the least; -1 for a miss: shape (n,)."""
        origins, directions, rows = _rays(ray_origins, ray_directions)
        found = np.full(len(origins), -1, dtype=np.int64)
        if (scene := self.scene) is not None:
            found[rows] = scene.closest(origins[rows], directions[rows]).primitive
        return found

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.bool_]:
        """Returns whether each ray hits the mesh: shape (n,)."""
        origins, directions, rows = _rays(ray_origins, ray_directions)
        found = np.zeros(len(origins), dtype=bool)
        if (scene := self.scene) is not None:
            found[rows] = scene.any(origins[rows], directions[rows])
        return found

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Returns whether each point is inside the mesh or on it: shape (n,).

        The answer is exact if every edge is in an even number of faces. Otherwise there is no inside: the answer
        follows the hits of two rays like in trimesh, with a warning.
        """
        array = floats(points, "points")
        check_shape(array, "points", 3, "n")
        scene = self.scene
        if scene is None:
            return np.zeros(len(array), dtype=bool)
        if scene.is_closed:
            return scene.contains(array)
        from trimesh.ray.ray_util import contains_points

        warnings.warn("the mesh is not closed, so that what is inside of it is a guess", stacklevel=2)
        guessed: NDArray[np.bool_] = contains_points(self, array)
        return guessed

    def _hits(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool,
        max_hits: int | None,
        each_location_once: bool,
    ) -> tuple[_Indices, _Indices, NDArray[np.float64]]:
        """Returns faces, rays and locations."""
        origins, directions, rows = _rays(ray_origins, ray_directions)
        scene = self.scene
        if scene is None:
            return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 3))
        if multiple_hits:
            hits = scene.all_hits(origins[rows], directions[rows])
            keep = _kept(hits, each_location_once, max_hits)
            index_tri, index_ray, t = hits.primitives[keep], rows[hits.rays[keep]], hits.t[keep]
        else:
            first = scene.closest(origins[rows], directions[rows])
            index_tri, index_ray, t = first.primitive[first.hit], rows[first.hit], first.t[first.hit]
        return index_tri, index_ray, origins[index_ray] + t[:, np.newaxis] * directions[index_ray]

    def __copy__(self) -> RayMeshIntersector:
        return RayMeshIntersector(self.mesh)

    def __deepcopy__(self, memo: dict[int, Any]) -> RayMeshIntersector:
        return self.__copy__()


# The hash and the scene of each living mesh, by its id.
_scenes: dict[int, tuple[int, Scene | None]] = {}


def scene_of(mesh: trimesh.Trimesh) -> Scene | None:
    """Returns the scene over the current mesh, shared by all its queries; None for a mesh without faces."""
    now, key = hash(mesh), id(mesh)
    if key not in _scenes:
        weakref.finalize(mesh, _scenes.pop, key, None)
    kept = _scenes.get(key)
    if kept is None or kept[0] != now:
        vertices = np.asarray(mesh.vertices.view(np.ndarray), dtype=np.float64)
        faces = mesh.faces.view(np.ndarray)
        kept = _scenes[key] = (now, Scene(vertices, faces) if len(faces) else None)
    return kept[1]


def _rays(origins: ArrayLike, directions: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], _Indices]:
    """Returns origins and directions as arrays, and the rows with a direction."""
    starts, ways = floats(origins, "ray_origins"), floats(directions, "ray_directions")
    if starts.shape != ways.shape:
        raise ValueError(f"ray_origins and ray_directions: shapes {starts.shape} and {ways.shape}, expected the same")
    check_shape(starts, "ray_origins", 3, "n")
    return starts, ways, np.flatnonzero(ways.any(axis=1))


def floats(array: ArrayLike, name: str) -> NDArray[np.float64]:
    return np.asarray(array_of(array, name, np.float64), dtype=np.float64)


def _kept(hits: AllHits, each_location_once: bool, most: int | None) -> NDArray[np.bool_]:
    """Returns which hits are reported."""
    keep = np.ones(len(hits.t), dtype=bool)
    rays = hits.rays
    if each_location_once:
        # Hits of a ray have the order of t.
        keep[1:] = (rays[1:] != rays[:-1]) | (hits.t[1:] != hits.t[:-1])
    if most is not None:
        before = np.concatenate([[0], np.cumsum(keep)])
        keep &= before[1:] - before[hits.offsets[rays]] <= most
    return keep

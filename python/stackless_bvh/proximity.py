"""Functions of `trimesh.proximity` with exact answers.

>>> import trimesh
>>> from stackless_bvh import proximity  # instead of: from trimesh import proximity
>>> mesh = trimesh.creation.box()
>>> proximity.signed_distance(mesh, [[0, 0, 0.25], [0, 0, 2]])
array([ 0.25, -1.5 ])

They take the arguments of trimesh, and return arrays with the shapes and dtypes of trimesh. Distances and points are
exact, each number rounded once. All queries of a mesh share one scene, including those of `stackless_bvh.trimesh`. The
scene follows changes of the mesh.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import check_shape
from ._scene import Scene
from .trimesh import RayMeshIntersector, floats, scene_of

if TYPE_CHECKING:
    import trimesh

_Floats = NDArray[np.float64]
_Indices = NDArray[np.int64]

# Maximum number of compared faces at equal distances.
_TIED = 8


class ProximityQuery:
    """Answers the proximity queries of a mesh: a replacement of `trimesh.proximity.ProximityQuery`.

    >>> import trimesh
    >>> mesh = trimesh.creation.box()
    >>> mesh.nearest = ProximityQuery(mesh)
    """

    def __init__(self, mesh: trimesh.Trimesh) -> None:
        self._mesh = mesh

    def on_surface(self, points: ArrayLike) -> tuple[_Floats, _Floats, _Indices]:
        """Returns the nearest points of the mesh, like `closest_point`."""
        return closest_point(self._mesh, points)

    def vertex(self, points: ArrayLike) -> tuple[_Floats, _Indices]:
        """Returns the distance and the index of the nearest vertex of each point: shapes (n,) and (n,).

        This is the query of trimesh itself. It needs SciPy, and rounds as SciPy does.
        """
        distance, vertex = self._mesh.kdtree.query(floats(points, "points"))
        return distance, vertex

    def signed_distance(self, points: ArrayLike) -> _Floats:
        """Returns the distance of each point, positive inside, like `signed_distance`."""
        return signed_distance(self._mesh, points)


def closest_point(mesh: trimesh.Trimesh, points: ArrayLike) -> tuple[_Floats, _Floats, _Indices]:
    """Returns the nearest point of the mesh to each point, its distance, and its face.

    Parameters
    ----------
    mesh
        The mesh.
    points
        Shape (n, 3).

    Returns
    -------
    closest : (n, 3) float64
        The nearest points, each coordinate rounded once.
    distance : (n,) float64
        The distances, each rounded once.
    triangle_id : (n,) int64
        Rows of `mesh.faces`. Of equally near faces, as at an edge, it is the face whose normal points most towards the
        point. Of more than eight equally near faces, the eight of least index are compared. trimesh compares two faces,
        and takes distances as equal if their squares differ by less than 1e-8.

    Raises
    ------
    ValueError
        The mesh has no faces, the shape does not fit, or a number is not finite.
    """
    scene, points = _scene(mesh), _points(points)
    near = scene.nearest(points, details=True)
    # Only at an edge or a vertex can several faces of a mesh be equally near.
    rows = np.flatnonzero(near.place != 0)
    several = scene.nearest(points[rows], k=_TIED, details=True)
    toward = ((points[rows, np.newaxis] - several.point) * several.normal).sum(axis=-1)
    toward[(several.distance != several.distance[:, :1]) | np.isnan(toward)] = -np.inf
    best = np.arange(len(rows)), toward.argmax(axis=1)
    near.point[rows], near.primitive[rows] = several.point[best], several.primitive[best]
    return np.asarray(near.point, np.float64), np.asarray(near.distance, np.float64), near.primitive


def signed_distance(mesh: trimesh.Trimesh, points: ArrayLike) -> _Floats:
    """Returns the distance of each point from the mesh, positive inside and 0 on the mesh: shape (n,).

    The sign is exact if every edge is in an even number of faces. Then the orientation of faces does not matter: a
    point is inside if a ray from it crosses the mesh an odd number of times. Other meshes have no inside. Then the sign
    is chosen like in trimesh, by the side of the nearest face or by the hits of two rays, with a warning.

    Parameters and errors are those of `closest_point`.
    """
    scene, points = _scene(mesh), _points(points)
    if scene.is_closed:
        return np.asarray(0.0 - scene.signed_distance(points))
    near = scene.nearest(points, details=True)
    behind = ((points - near.point) * near.normal).sum(axis=1) < 0
    inside = np.where(near.place == 0, behind, RayMeshIntersector(mesh).contains_points(points))
    return np.where(inside, near.distance, 0.0 - near.distance)


def longest_ray(mesh: trimesh.Trimesh, points: ArrayLike, directions: ArrayLike) -> _Floats:
    """Returns the distance of the mesh from each point in a direction: shape (n,), infinite without a hit.

    Hits that are nearer than `trimesh.tol.planar` are skipped, as in trimesh: points on a face rarely are on it
    exactly.

    Parameters
    ----------
    mesh
        The mesh.
    points, directions
        Shape (n, 3). Directions need not have length 1.

    Raises
    ------
    ValueError
        The mesh has no faces, shapes do not fit, or a number is not finite.
    """
    from trimesh.constants import tol

    scene, points, directions = _scene(mesh), _points(points), _points(directions, "directions")
    _check_count(points, directions, "directions")
    lengths = np.linalg.norm(directions, axis=1)
    found = np.full(len(points), np.inf)
    rows = np.flatnonzero(lengths)
    found[rows] = scene.closest(points[rows], directions[rows], tmin=tol.planar / lengths[rows]).t * lengths[rows]
    return found


def max_tangent_sphere(
    mesh: trimesh.Trimesh,
    points: ArrayLike,
    inwards: bool = True,
    normals: ArrayLike | None = None,
    threshold: float = 1e-6,
    max_iter: int = 100,
) -> tuple[_Floats, _Floats]:
    """Returns centers (n, 3) and radii (n,) of the largest spheres that touch the mesh at points on it.

    These are the steps of `trimesh.proximity.max_tangent_sphere` with exact rays and exact nearest points. The result
    of the steps is approximate.
    """
    from trimesh import proximity

    points, normals = _points(points), _normals(mesh, points, normals)
    exact = mesh.copy(include_visual=False)
    exact.ray, exact.nearest = RayMeshIntersector(mesh), ProximityQuery(mesh)
    centers, radii = proximity.max_tangent_sphere(exact, points, inwards, normals, threshold, max_iter)
    return centers, radii


def thickness(
    mesh: trimesh.Trimesh,
    points: ArrayLike,
    exterior: bool = False,
    normals: ArrayLike | None = None,
    method: Literal["max_sphere", "ray"] = "max_sphere",
) -> _Floats:
    """Returns the thickness of the mesh at points on it: shape (n,).

    Parameters
    ----------
    mesh
        The mesh.
    points
        Shape (n, 3).
    exterior
        Measures the gap outside (the reach) instead of the thickness.
    normals
        Shape (n, 3); by default those of the nearest faces.
    method
        ``"max_sphere"``: the diameter of `max_tangent_sphere`. ``"ray"``: `longest_ray` along the normal.

    Raises
    ------
    ValueError
        The mesh has no faces, shapes do not fit, a number is not finite, or the method is unknown.
    """
    if method == "max_sphere":
        return max_tangent_sphere(mesh, points, not exterior, normals)[1] * 2
    if method == "ray":
        outward = _normals(mesh, points, normals)
        return longest_ray(mesh, points, outward if exterior else -outward)
    raise ValueError(f"method: {method!r}, expected 'max_sphere' or 'ray'")


def _scene(mesh: trimesh.Trimesh) -> Scene:
    if (scene := scene_of(mesh)) is None:
        raise ValueError("mesh: no faces, expected at least one")
    return scene


def _points(values: ArrayLike, name: str = "points") -> _Floats:
    array = floats(values, name)
    check_shape(array, name, 3, "n")
    return array


def _normals(mesh: trimesh.Trimesh, points: ArrayLike, normals: ArrayLike | None) -> Any:
    """Returns the normals of the faces that are nearest to points, unless normals are given."""
    if normals is None:
        return mesh.face_normals[closest_point(mesh, points)[2]]
    array = _points(normals, "normals")
    _check_count(_points(points), array, "normals")
    return array


def _check_count(points: _Floats, others: _Floats, name: str) -> None:
    if len(points) != len(others):
        raise ValueError(f"{name}: {len(others)} rows, expected {len(points)}, one for each of points")

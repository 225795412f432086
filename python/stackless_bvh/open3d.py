"""A `RaycastingScene` with the methods of `open3d.t.geometry.RaycastingScene` and exact answers.

>>> import numpy as np
>>> from stackless_bvh.open3d import RaycastingScene  # instead of: from open3d.t.geometry import RaycastingScene
>>> scene = RaycastingScene()
>>> scene.add_triangles(np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.uint32([[0, 1, 2]]))
0
>>> scene.cast_rays(np.float32([[0.25, 0.5, 2, 0, 0, -1]]))["t_hit"].numpy()
array([2.], dtype=float32)

Open3D need not be installed. Arguments are NumPy arrays, or objects with a method `numpy()`, such as tensors.
Answers are NumPy arrays with a method `numpy()`, so that scripts work unchanged.
"""

from __future__ import annotations

from typing import Any, overload

import numpy as np

from . import _pinhole
from ._arrays import mesh_arrays
from ._geometries import Answer, Asked, Geometries, Mesh, plain


class RaycastingScene:
    """Queries of rays and points over triangle meshes. Each mesh is a geometry with an id.

    Parameters
    ----------
    nthreads
        For compatibility only, as in all methods: the environment variable ``RAYON_NUM_THREADS`` limits the threads.

    Numbers are float32 as in Open3D. If the vertices of a mesh are float64, all answers are float64, and float64 rays
    and points are accepted. The hierarchy is built at the first query after `add_triangles`.

    These answers differ from those of Open3D:

    - Whether a ray hits, and which geometry and triangle it hits first, is exact: no ray slips through an edge. Of
      equal distances the least geometry wins, then the least triangle. Distances and coordinates are rounded once.
    - `count_intersections` counts a crossing at an edge or a vertex once. Open3D may count it twice.
    - `list_intersections` returns hits in the order of distances. In Open3D the hits of a ray have any order.
    - Insides are exact for closed meshes, for every `nsamples`. Points on a mesh are inside, at distance 0. Meshes that
      are not closed get a guess by their winding number, with a warning. Open3D guesses by `nsamples` rays.
    - A scene without triangles is infinitely far from every point: ids are `INVALID_ID`, points are NaN.
    - Rays and points that are not finite are a ValueError. In Open3D they miss. A ray without a direction misses.
    - Errors are a TypeError or a ValueError. In Open3D they are a RuntimeError.
    """

    INVALID_ID = 0xFFFFFFFF
    """The id of no geometry and of no triangle."""

    def __init__(self, nthreads: int = 0) -> None:
        self._meshes: list[Mesh] = []
        self._built: Geometries | None = None

    @overload
    def add_triangles(self, vertex_positions: Any, triangle_indices: Any) -> int: ...
    @overload
    def add_triangles(self, mesh: Any) -> int: ...
    def add_triangles(self, *args: Any, **kwargs: Any) -> int:
        """Adds a mesh, and returns its geometry id: 0, 1, 2 and so on.

        Parameters
        ----------
        vertex_positions
            Shape (n, 3), float32 or float64. The numbers are copied.
        triangle_indices
            Shape (m, 3), integers. There may be no triangles.
        mesh
            Instead of both: an object with ``vertex.positions`` and ``triangle.indices``, such as a
            `open3d.t.geometry.TriangleMesh`.

        Raises
        ------
        TypeError
            An array has another dtype.
        ValueError
            An array has another shape, or an index is out of range; the message names the row. A coordinate that is
            not finite fails at the first query.
        """
        one = len(args) + len(kwargs) == 1
        vertices, faces = mesh_arrays(*(_of_mesh if one else _of_arrays)(*args, **kwargs))
        out = np.argwhere((faces < 0) | (faces >= len(vertices)))
        if len(out):
            row, corner = out[0]
            index = faces[row, corner]
            raise ValueError(
                f"triangle_indices[{row}]: index {index} of vertex {corner}, expected 0 to {len(vertices) - 1}"
            )
        self._meshes.append((vertices.copy(), faces.copy()))
        self._built = None
        return len(self._meshes) - 1

    def cast_rays(self, rays: Any, nthreads: int = 0) -> dict[str, Answer]:
        """Returns the first hit of each ray: t_hit (...), geometry_ids (...), primitive_ids (...), primitive_uvs
        (..., 2), primitive_normals (..., 3).

        Parameters
        ----------
        rays
            Shape (..., 6): origins and directions, which need not have length 1.

        Returns
        -------
        dict
            A ray that misses has the distance infinity, `INVALID_ID`, and zeros. Ids are uint32. Normals are computed
            in float64 and have length 1; vertices are seen counterclockwise from their tips.

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The shape does not fit, or a number is not finite.
        """
        built, asked = self._asked(rays, "rays", 6)
        hits = built.scene.closest(*asked.rays())
        geometry, primitive = built.ids(hits.primitive)
        return {
            "t_hit": asked.answer(hits.t, np.inf),
            "geometry_ids": asked.answer(geometry, self.INVALID_ID),
            "primitive_ids": asked.answer(primitive, self.INVALID_ID),
            "primitive_uvs": asked.answer(np.nan_to_num(hits.uv), 0),
            "primitive_normals": asked.answer(built.normals[hits.primitive], 0),
        }

    def test_occlusions(self, rays: Any, tnear: float = 0.0, tfar: float = np.inf, nthreads: int = 0) -> Answer:
        """Returns whether each ray hits anything with ``tnear <= t <= tfar``: bools of shape (...).

        Both ends belong to the ray. Parameters and errors are those of `cast_rays`. It is a ValueError if
        ``0 <= tnear <= tfar`` does not hold.
        """
        if not 0 <= tnear <= tfar:
            raise ValueError(f"tnear and tfar: {tnear} and {tfar}, expected 0 <= tnear <= tfar")
        built, asked = self._asked(rays, "rays", 6)
        return asked.answer(built.scene.any(*asked.rays(), tnear, tfar), False)

    def count_intersections(self, rays: Any, nthreads: int = 0) -> Answer:
        """Returns how often each ray crosses the meshes: int32 of shape (...).

        From inside of a closed mesh the number is odd, from outside it is even. A crossing at an edge or a vertex
        counts once. By the same rule a hit on the border of an open mesh counts once or not at all.
        `Scene.count_crossings` tells the rule. Parameters and errors are those of `cast_rays`.
        """
        built, asked = self._asked(rays, "rays", 6)
        return asked.answer(built.scene.count_crossings(*asked.rays()).astype(np.int32), 0)

    def list_intersections(self, rays: Any, nthreads: int = 0) -> dict[str, Answer]:
        """Returns all hits of all rays, in the order of rays, of distances, and of triangles.

        A geometry that is hit at several triangles at one distance, as at an edge, is there once, with the first
        triangle. A ray that only touches an edge hits it, but `count_intersections` counts crossings.

        Parameters and errors are those of `cast_rays`.

        Returns
        -------
        dict
            Of m hits: ray_splits (n + 1,), the rows of ray i being ray_splits[i] to ray_splits[i + 1]; ray_ids (m,),
            t_hit (m,), geometry_ids (m,), primitive_ids (m,), primitive_uvs (m, 2). Rays of any shape are numbered in
            row-major order. Numbers of rays and hits are uint32.
        """
        built, asked = self._asked(rays, "rays", 6)
        hits = built.scene.all_hits(*asked.rays())
        geometry, primitive = built.ids(hits.primitives)
        rays = hits.rays
        # Hits of one ray at one distance are in the order of triangles, and so of geometries.
        keep = asked.real[rays]
        keep[1:] &= (np.diff(rays) != 0) | (np.diff(hits.t) != 0) | (np.diff(geometry) != 0)
        rays = rays[keep]
        found = {
            "ray_splits": np.searchsorted(rays, np.arange(len(asked.rows) + 1)).astype(np.uint32),
            "ray_ids": rays.astype(np.uint32),
            "t_hit": hits.t[keep],
            "geometry_ids": geometry[keep],
            "primitive_ids": primitive[keep],
            "primitive_uvs": hits.uv[keep],
        }
        return {name: array.view(Answer) for name, array in found.items()}

    def compute_closest_points(self, query_points: Any, nthreads: int = 0) -> dict[str, Answer]:
        """Returns the nearest point of the meshes to each point: points (..., 3), geometry_ids (...), primitive_ids
        (...), primitive_uvs (..., 2), primitive_normals (..., 3).

        All are exact, each number rounded once. A triangle without an area has the normal NaN.

        Parameters
        ----------
        query_points
            Shape (..., 3).

        Raises
        ------
        TypeError
            The array has another dtype than the scene.
        ValueError
            The shape does not fit, or a number is not finite.
        """
        built, asked = self._asked(query_points, "query_points", 3)
        near = built.scene.nearest(asked.rows, details=True)
        assert near.uv is not None and near.normal is not None
        geometry, primitive = built.ids(near.primitive)
        return {
            "points": asked.answer(near.point, np.nan),
            "geometry_ids": asked.answer(geometry, self.INVALID_ID),
            "primitive_ids": asked.answer(primitive, self.INVALID_ID),
            "primitive_uvs": asked.answer(near.uv, np.nan),
            "primitive_normals": asked.answer(near.normal, np.nan),
        }

    def compute_distance(self, query_points: Any, nthreads: int = 0) -> Answer:
        """Returns the distance of each point from the meshes, rounded once: shape (...).

        Parameters and errors are those of `compute_closest_points`.
        """
        built, asked = self._asked(query_points, "query_points", 3)
        return asked.answer(built.scene.nearest(asked.rows).distance, np.inf)

    def compute_signed_distance(self, query_points: Any, nthreads: int = 0, nsamples: int = 1) -> Answer:
        """Returns the distance of each point, negative inside: shape (...).

        A point is inside where a ray crosses the meshes an odd number of times. `nsamples` must be odd, and changes
        nothing. Parameters and errors are those of `compute_closest_points`.
        """
        _check_samples(nsamples)
        built, asked = self._asked(query_points, "query_points", 3)
        return asked.answer(built.scene.signed_distance(asked.rows, rule=built.rule()), np.inf)

    def compute_occupancy(self, query_points: Any, nthreads: int = 0, nsamples: int = 1) -> Answer:
        """Returns 1 for each point that is inside or on a mesh, and 0 for others: shape (...), of the scene's dtype.

        Parameters and errors are those of `compute_signed_distance`.
        """
        _check_samples(nsamples)
        built, asked = self._asked(query_points, "query_points", 3)
        return asked.answer(built.scene.contains(asked.rows, rule=built.rule()).astype(built.scene.dtype), 0)

    @overload
    @staticmethod
    def create_rays_pinhole(intrinsic_matrix: Any, extrinsic_matrix: Any, width_px: int, height_px: int) -> Answer: ...
    @overload
    @staticmethod
    def create_rays_pinhole(
        fov_deg: float, center: Any, eye: Any, up: Any, width_px: int, height_px: int
    ) -> Answer: ...
    @staticmethod
    def create_rays_pinhole(*args: Any, **kwargs: Any) -> Answer:
        """Returns the rays of a pinhole camera through the middles of its pixels: float32 (height_px, width_px, 6).

        Parameters
        ----------
        intrinsic_matrix, extrinsic_matrix
            Shapes (3, 3) and (4, 4). The extrinsic matrix maps the world to the camera.
        fov_deg, center, eye, up
            Instead of the matrices: the angle of the width in degrees, the point that the camera looks at, the point
            where it is, and its vertical, each of shape (3,).

        Raises
        ------
        ValueError
            A shape does not fit, or `up` is parallel to the direction of view.
        """
        four = len(args) + len(kwargs) == 4
        return (_pinhole.of_matrices if four else _pinhole.looking_at)(*args, **kwargs).view(Answer)

    def _asked(self, values: Any, name: str, width: int) -> tuple[Geometries, Asked]:
        """Returns the geometries, which are built first if they have changed, and the rows that ask them."""
        built = self._built
        if built is None:
            built = self._built = Geometries(self._meshes)
        return built, Asked(built, values, name, width)


def _of_arrays(vertex_positions: Any, triangle_indices: Any) -> tuple[Any, Any]:
    return plain(vertex_positions), plain(triangle_indices)


def _of_mesh(mesh: Any) -> tuple[Any, Any]:
    if not (hasattr(mesh, "vertex") and hasattr(mesh, "triangle")):
        raise TypeError(f"mesh: {type(mesh).__name__}, expected an object with vertex.positions and triangle.indices")
    return plain(mesh.vertex.positions), plain(mesh.triangle.indices)


def _check_samples(nsamples: int) -> None:
    if nsamples < 1 or nsamples % 2 == 0:
        raise ValueError(f"nsamples: {nsamples}, expected an odd number")

"""Signed distances, and the place of the nearest point on its face."""

import numpy as np
import pytest
from test_inside import CORNERS, FACES, GRID, both, box, on, within

from stackless_bvh import Scene


def distance_to_box(points, low=0.0, high=1.0):
    """Returns the distances of grid points from the surface of a cube, rounded once: the squares are exact."""
    beyond = np.maximum(low - points, points - high)
    outside = np.sqrt((np.maximum(beyond, 0) ** 2).sum(axis=1))
    return np.where(beyond.max(axis=1) > 0, outside, -beyond.max(axis=1))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_distances_are_negative_inside_and_zero_on_the_mesh(dtype):
    scene, points = Scene(*box(dtype=dtype)), GRID.astype(dtype)
    inside, surface = within(GRID), on(GRID)
    expected = (distance_to_box(GRID) * np.where(inside, -1, 1)).astype(dtype)
    found = scene.signed_distance(points)
    assert found.dtype == dtype and np.array_equal(found, expected)
    assert np.array_equal(found == 0, surface) and np.array_equal(found < 0, inside) and inside.sum() > 300
    for rule in ("nonzero", "winding"):
        assert np.array_equal(scene.signed_distance(points, rule=rule), expected)


def test_the_rule_says_what_is_inside():
    scene = Scene(*both(box(), box(0.5, 1.25)))
    inside = [within(GRID), within(GRID, 0.5, 1.25)]
    far = np.minimum(distance_to_box(GRID), distance_to_box(GRID, 0.5, 1.25))
    assert np.array_equal(scene.signed_distance(GRID), np.where(inside[0] ^ inside[1], -far, far) + 0)
    assert np.array_equal(scene.signed_distance(GRID, "nonzero"), np.where(inside[0] | inside[1], -far, far) + 0)
    open_box = Scene(CORNERS, FACES[1:])
    with pytest.raises(ValueError, match="the mesh is not closed: .*; rule='winding' fits it"):
        open_box.signed_distance(GRID)
    assert open_box.signed_distance([[0.5, 0.5, 0.5]], rule="winding") == [-0.5]
    twice = Scene(CORNERS, np.concatenate([FACES, FACES]))
    with pytest.warns(UserWarning, match="12 of the faces repeat earlier ones") as warned:
        assert twice.signed_distance([[0.5, 0.5, 0.5]]) == [0.5]
    assert warned[0].filename == __file__
    with pytest.raises(ValueError, match=r"points\[1\]: \[NaN, 0, 0\], expected finite numbers"):
        scene.signed_distance([[0, 0, 0], [np.nan, 0, 0]])
    with pytest.raises(ValueError, match="rule: 'odd', expected"):
        scene.signed_distance(GRID, rule="odd")


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_details_say_where_on_the_face(dtype):
    rng = np.random.default_rng(1)
    vertices = rng.integers(-4, 5, (60, 3)).astype(dtype)
    faces = rng.permutation(60).reshape(20, 3)
    scene, points = Scene(vertices, faces), rng.integers(-8, 9, (4000, 3)).astype(dtype)
    near = scene.nearest(points, k=3, details=True)
    plain = scene.nearest(points, k=3)
    assert plain.uv is None and plain.place is None and plain.normal is None
    assert all(np.array_equal(getattr(near, name), getattr(plain, name)) for name in ("distance", "primitive", "point"))
    assert near.uv.shape == (4000, 3, 2) and near.place.shape == (4000, 3) and near.normal.shape == (4000, 3, 3)
    weights = np.concatenate([1 - near.uv.sum(axis=-1, keepdims=True), near.uv], axis=-1)
    corners = vertices[faces][near.primitive]
    eps = np.finfo(dtype).eps
    assert np.abs((weights[..., None] * corners).sum(axis=-2) - near.point).max() < 64 * eps
    # For whole numbers this small, a weight is 0 or much greater than rounding errors.
    assert np.array_equal((weights > 1e-4).sum(axis=-1), 3 - near.place)
    assert np.bincount(near.place.ravel(), minlength=3).min() > 200
    normal = np.cross(corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :])
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    assert np.abs(near.normal - normal / length).max() < 4 * eps


def test_nothing_has_no_details():
    scene = Scene([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]], [[0, 1, 2], [0, 1, 3]])
    near = scene.nearest([[0, 0, 5], [9, 0, 9]], radius=[6, 1], k=2, details=True)
    assert near.place.tolist() == [[2, 2], [255, 255]] and np.isnan(near.uv[1]).all() and np.isnan(near.normal[1]).all()
    # A face without area has no normal.
    assert np.array_equal(near.normal[0], [[0, 0, 1], [np.nan] * 3], equal_nan=True)
    one = scene.nearest([[9, 9, 9]], radius=1, details=True)
    assert one.uv.shape == (1, 2) and one.place.tolist() == [255] and one.normal.shape == (1, 3)
    none = scene.nearest(np.empty((0, 3)), details=True)
    assert none.uv.shape == (0, 2) and none.place.shape == (0,) and none.normal.shape == (0, 3)

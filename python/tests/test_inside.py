"""Closed meshes, and the points inside them."""

import numpy as np
import pytest

from stackless_bvh import Scene

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
# Seen from outside.
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
FACES = np.array([corners for a, b, c, d in QUADS for corners in ([a, b, c], [a, c, d])])
GRID = np.stack(np.meshgrid(*[np.arange(-0.25, 1.5, 0.125)] * 3), axis=-1).reshape(-1, 3)


def box(low=0.0, high=1.0, dtype=np.float64):
    return (CORNERS * (high - low) + low).astype(dtype), FACES


def within(points, low=0.0, high=1.0):
    return ((points > low) & (points < high)).all(axis=1)


def on(points, low=0.0, high=1.0):
    return ((points >= low) & (points <= high)).all(axis=1) & ~within(points, low, high)


def both(one, other):
    return np.concatenate([one[0], other[0]]), np.concatenate([one[1], other[1] + len(one[0])])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_vertex_in_the_middle_of_an_edge_leaves_a_mesh_closed(dtype):
    vertices, faces = box(dtype=dtype)
    # The first face is divided at the middle of an edge; its neighbour at this edge is not.
    (a, b, c), middle = faces[0], len(vertices)
    vertices = np.concatenate([vertices, [(vertices[a] + vertices[b]) / 2]]).astype(dtype)
    scene = Scene(vertices, [[a, middle, c], [middle, b, c], *faces[1:]])
    assert scene.is_closed and scene.is_oriented
    points = GRID.astype(dtype)
    inside = scene.contains(points, boundary=False)
    assert np.array_equal(inside, within(points)) and inside.sum() > 300
    assert np.array_equal(scene.contains(points), within(points) | on(points))
    # A vertex one ulp off the edge makes a gap.
    vertices[middle] += np.spacing(vertices[middle].astype(dtype) + 1)
    assert not Scene(vertices, scene.faces).is_closed


def test_overlapping_parts_cancel_out_by_parity_and_unite_by_winding_number():
    scene = Scene(*both(box(), box(0.5, 1.25)))
    count = within(GRID).astype(int) + within(GRID, 0.5, 1.25)
    clear = ~on(GRID) & ~on(GRID, 0.5, 1.25)
    assert (count[clear] == 2).sum() > 10
    assert np.array_equal(scene.contains(GRID)[clear], count[clear] == 1)
    assert np.array_equal(scene.contains(GRID, rule="nonzero")[clear], count[clear] > 0)
    assert np.array_equal(scene.winding_number(GRID)[clear], count[clear])
    # Turned inside out, the numbers are negative.
    turned = Scene(scene.vertices, scene.faces[:, ::-1])
    assert np.array_equal(turned.winding_number(GRID)[clear], -count[clear])
    assert np.array_equal(turned.contains(GRID, rule="nonzero")[clear], count[clear] > 0)


def test_repeated_faces_are_said_where_they_cancel_out():
    scene = Scene(*both(box(), box()))
    assert scene.is_closed
    with pytest.warns(UserWarning, match="12 of the faces repeat earlier ones, and cancel them out by parity"):
        assert not scene.contains([[0.5, 0.25, 0.125]]).any()
    assert scene.contains([[0.5, 0.25, 0.125]], rule="nonzero").all()
    assert scene.winding_number([[0.5, 0.25, 0.125]]) == 2


def test_a_rule_that_does_not_fit_is_an_error():
    vertices, faces = box()
    turned = faces.copy()
    turned[0] = turned[0][::-1]
    scene = Scene(vertices, turned)
    assert scene.contains([[0.5, 0.25, 0.125]]).all()
    unoriented = "not oriented: its faces run through 3 of its edges more often in one direction than in the other"
    with pytest.raises(ValueError, match=unoriented):
        scene.contains(GRID, rule="nonzero")
    for rule in ("parity", "nonzero"):
        with pytest.raises(ValueError, match=r"not closed: the edge \(0, 3\) .* in 1 face.*; rule='winding' fits it"):
            Scene(vertices, faces[1:]).contains(GRID, rule=rule)
    with pytest.raises(ValueError, match="rule: 'even', expected 'parity', 'nonzero' or 'winding'"):
        scene.contains(GRID, rule="even")


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_winding_numbers_of_open_meshes_are_those_of_what_is_seen(dtype):
    vertices, faces = box(dtype=dtype)
    # From the middle, all faces have equal solid angles.
    points = np.array([[0.5, 0.5, 0.5], [0.5, 0.5, -2.0], [3.0, 0.5, 0.5]], dtype)
    for missing in range(12):
        assert abs(Scene(vertices, faces[missing:]).winding_number(points)[0] - (12 - missing) / 12) < 1e-12
    open_box = Scene(vertices, faces[1:])
    direct = np.zeros(len(points))
    for a, b, c in vertices[open_box.faces].astype(float):
        x, y, z = a - points, b - points, c - points
        lengths = [np.linalg.norm(v, axis=1) for v in (x, y, z)]
        bottom = (
            np.prod(lengths, axis=0)
            + (x * y).sum(1) * lengths[2]
            + (y * z).sum(1) * lengths[0]
            + (z * x).sum(1) * lengths[1]
        )
        direct += np.arctan2((x * np.cross(y, z)).sum(1), bottom) / (2 * np.pi)
    assert np.allclose(open_box.winding_number(points), direct, atol=1e-12, rtol=0)
    clear = ~on(GRID)
    inside = open_box.contains(GRID.astype(dtype), rule="winding")
    assert (inside != within(GRID))[clear].mean() < 0.01

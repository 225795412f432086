"""Rays that continue from hits, and segments: exact where rays with rounded origins or directions are not."""

import pickle

import numpy as np
import pytest
from conftest import octasphere, same

from stackless_bvh import Scene


@pytest.fixture
def sphere(dtype):
    vertices, faces = octasphere(4, dtype)
    return Scene(vertices, faces)


def directions(count, dtype, seed=1):
    return np.random.default_rng(seed).normal(size=(count, 3)).astype(dtype)


def test_a_closed_surface_keeps_every_bounce(sphere, dtype):
    count = 20_000
    hits = sphere.closest(np.zeros(3, dtype), directions(count, dtype))
    for bounce in range(5):
        assert hits.hit.all()
        vertices, faces = sphere.vertices, sphere.faces
        corners = vertices[faces[hits.primitive]]
        # Inward, from the face that was hit.
        inward = -np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        inward /= np.linalg.norm(inward, axis=1, keepdims=True)
        ways = directions(count, dtype, bounce)
        ways /= np.linalg.norm(ways, axis=1, keepdims=True)
        before, hits = hits, hits.continue_with(inward * dtype(1.1) + ways).closest()
        assert not (hits.primitive == before.primitive).any(), "a ray hits the face that it leaves"
    assert hits.hit.all()


def test_hits_end_with_the_mesh_that_they_were_on(sphere, dtype):
    hits = sphere.closest(np.zeros(3, dtype), directions(5, dtype))
    outside = hits.toward(np.full(3, 9, dtype))
    sphere.refit(2 * sphere.vertices)
    for go_on in (hits.continue_with, hits.toward):
        with pytest.raises(ValueError, match="the vertices were moved after these hits"):
            go_on(np.ones(3, dtype))
    # Rays created before the refit keep the mesh of their origins.
    assert not outside.any().all()
    assert len(sphere.closest(np.zeros(3, dtype), directions(5, dtype)).continue_with(np.ones(3, dtype))) == 5


def test_segments_end_where_they_are_told(sphere, dtype):
    vertices = sphere.vertices
    a = directions(20_000, dtype) * dtype(0.1)
    b = vertices[np.random.default_rng(2).integers(len(vertices), size=len(a))]
    hits = sphere.segments(a, b).closest()
    assert hits.hit.all() and (hits.t == 1).all(), "a segment does not touch its end"
    assert sphere.segments(a, b).any().all()
    assert not sphere.segments(a, b, closed=False).any().any()
    # Rays with the rounded direction have other answers.
    assert not sphere.any(a, b - a, tmax=1).all()


def test_shadow_rays_go_from_hits_to_points(dtype):
    # A floor, and a square above a part of it.
    vertices = np.array(
        [[x, y, z] for z, s in ((0, 4), (1, 1)) for x, y in ((-s, -s), (s, -s), (s, s), (-s, s))], dtype
    )
    scene = Scene(vertices, np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]))
    floor = scene.closest(
        np.array([[0.1, 0.2, 0.5], [3.3, 3.1, 0.5], [9, 9, 9]], dtype), np.array([0.1, 0.1, -1], dtype)
    )
    light = np.array([0, 0, 7], dtype)
    assert floor.hit.tolist() == [True, True, False]
    assert floor.toward(light).any().tolist() == [True, False, False]
    assert floor.toward(light, closed=True).any().tolist() == [True, True, False]
    up = floor.continue_with(np.array([0, 0, 1], dtype), tmax=0.5)
    assert up.any().tolist() == [False, False, False] and len(up) == 3 and up.dtype == dtype
    assert floor.continue_with(np.array([0, 0, 1], dtype)).closest().primitive.tolist()[1:] == [-1, -1]


def test_answers_are_those_of_rays_of_floats(sphere, dtype):
    hits = sphere.closest(directions(1000, dtype), directions(1000, dtype, 5))
    t, primitive, _ = hits._exact().closest(None)
    assert 50 < hits.hit.sum() < 950
    assert np.array_equal(t, hits.t) and np.array_equal(primitive, hits.primitive)


def test_what_cannot_go_on_says_why(sphere, dtype):
    origins, ways = np.zeros((2, 3), dtype), directions(2, dtype)
    hits = sphere.closest(origins, ways)
    cases = [
        (lambda: hits.continue_with(np.zeros(3, dtype)), r"directions\[0\]: \[0, 0, 0\], expected a direction"),
        (lambda: hits.continue_with(ways, tmax=-1), "tmax"),
        (lambda: sphere.segments(origins, origins), "row 0: both ends are one point"),
        (lambda: sphere.segments(np.zeros((2, 3), dtype), np.ones((3, 3), dtype)), "2 rows of a and 3 of b"),
        (lambda: sphere.segments(np.full(3, np.nan, dtype), ways), "expected finite numbers"),
        (lambda: pickle.loads(pickle.dumps(hits)).continue_with(ways), "these hits have no rays"),
    ]
    for ask, message in cases:
        with pytest.raises(ValueError, match=message):
            ask()
    ways[:] = -ways
    with pytest.raises(ValueError, match=r"primitive\[0\]: the ray does not hit face \d+; were its arrays changed"):
        hits.continue_with(np.ones(3, dtype))


def test_rays_keep_the_mesh_that_they_were_made_of(sphere, dtype):
    up = np.array([0, 0, 1], dtype)
    hits = sphere.closest(np.zeros((1, 3), dtype), up)
    onward = hits.continue_with(-up)
    sphere.refit(sphere.vertices * dtype(2))
    assert onward.closest().t[0] == 2
    assert sphere.closest(np.zeros((1, 3), dtype), up).continue_with(-up).closest().t[0] == 4


def test_all_hits_of_exact_rays_begin_with_the_closest(sphere, dtype):
    zero, ways = np.zeros(3, dtype), directions(2000, dtype)
    ends = np.concatenate([3 * ways[:1500], sphere.vertices[:500]])
    # Edges of the sphere are in this plane.
    ends[:500, 2] = 0
    bounced = sphere.closest(zero, ways).continue_with(np.where(np.arange(2000)[:, None] % 2, -ways, ways))
    for rays, place in ((sphere.segments(-ends, ends), {0, 1, 2}), (bounced, {0})):
        every, closest = rays.all_hits(), rays.closest()
        counts = np.diff(every.offsets)
        assert np.array_equal(counts > 0, closest.hit) and set(every.place) == place
        firsts = every.offsets[:-1][closest.hit]
        for one, name in ((closest.t, "t"), (closest.primitive, "primitives"), (closest.uv, "uv")):
            assert np.array_equal(one[closest.hit], getattr(every, name)[firsts])
    # The directions of these segments are floats, so rays along them have the same hits.
    found, expected = sphere.segments(zero, ends).all_hits(), sphere.all_hits(zero, ends, tmax=1)
    assert len(found.t) > 2000 and same(found, expected)

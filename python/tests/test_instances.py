"""Scenes that are placed by maps, against rational arithmetic."""

import numpy as np
import oracle
import pytest
from conftest import CUBE, CUBE_FACES, octasphere, same, some_rays
from hypothesis import given, settings
from hypothesis import strategies as st
from test_truth import BUILDS, DTYPES, GRID, meshes, points

from stackless_bvh import Instances, Scene


def image(corner, rows):
    return tuple(sum(oracle.Fraction(float(m)) * x for m, x in zip(row, (*corner, 1))) for row in rows)


def images_of(scene, rows):
    return [[image(corner, rows) for corner in oracle.corners(scene.vertices, face)] for face in scene.faces]


def all_images(placed, origin, direction, dtype):
    """Returns all hits (t rounded, path, face, u, v, place), by distance, path and face."""
    found = []
    for path, triangles in placed:
        for face, triangle in enumerate(triangles):
            hit = oracle.meet(triangle, oracle.vector(origin), oracle.vector(direction))
            if hit and hit[0] >= 0:
                t, u, v = hit
                zeros = [u, v, 1 - u - v].count(0)
                u, v = oracle.rounded(u, dtype), oracle.rounded(v, dtype)
                found.append((t, path, face, oracle.rounded(t, dtype), u, v, zeros))
    return [(t, path, face, u, v, zeros) for _, path, face, t, u, v, zeros in sorted(found)]


def check_rays(instances, placed, origins, directions):
    """Compares all queries of rays with all images. Returns the numbers of levels of the hits."""
    dtype, depths = instances.dtype.type, set()
    hits, every = instances.closest(origins, directions), instances.all_hits(origins, directions)
    anything = instances.any(origins, directions)
    levels = hits.path.shape[1]
    assert hits.t.dtype == every.t.dtype == dtype and every.path.shape == (len(every.t), levels)
    assert np.array_equal(hits.instance, hits.path[:, 0]) and np.array_equal(every.instance, every.path[:, 0])
    for ray, (origin, direction) in enumerate(zip(origins, directions)):
        truth = all_images(placed, origin, direction, dtype)
        rows = slice(every.offsets[ray], every.offsets[ray + 1])
        numbers = [every.t[rows].tolist(), every.path[rows].tolist(), every.primitives[rows].tolist()]
        found = list(zip(*numbers, *every.uv[rows].T.tolist(), every.place[rows].tolist()))
        padded = lambda path: [*path, *levels * [-1]][:levels]
        assert found == [(float(t), padded(path), face, float(u), float(v), at) for t, path, face, u, v, at in truth]
        assert anything[ray] == hits.hit[ray] == bool(truth)
        one = (hits.t[ray], hits.path[ray].tolist(), hits.primitive[ray], *hits.uv[ray])
        if truth:
            assert one == found[0][:-1]
            depths.add(len(truth[0][1]))
        else:
            assert one[:3] == (np.inf, levels * [-1], -1) and np.isnan(hits.uv[ray]).all()
    return depths


def test_instances_are_the_exact_images(dtype):
    vertices, faces = octasphere(1, dtype)
    scene, triangle = Scene(vertices, faces), Scene(dtype([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]])
    maps = np.zeros((3, 3, 4), dtype)
    maps[:, [0, 1, 2], [0, 1, 2]] = [[1, 2, 0.5], [3, 3, 3], [0.25, -1, 1.1]]
    maps[:, :, 3] = [[0, 0, 4], [-3, 1, 0], [5, 0, 0]]
    instances = Instances([scene, triangle], [0, 1, 0], maps)
    origins, directions = some_rays(dtype, 300, 5)
    origins *= 4
    assert len(instances) == 3 and instances.dtype == dtype
    placed = [((i,), images_of(part, rows)) for i, (part, rows) in enumerate(zip([scene, triangle, scene], maps))]
    # A third of the rays aims at a corner of an image, and a third starts there.
    corners = np.array([triangle[0] for _, triangles in placed for triangle in triangles], dtype)
    aims = corners[np.random.default_rng(1).integers(0, len(corners), 200)]
    directions[:100], origins[100:200] = aims[:100] - origins[:100], aims[100:]
    assert check_rays(instances, placed, origins, directions) == {1}
    assert set(instances.closest(origins, directions).instance) == {-1, 0, 1, 2}
    four = np.concatenate([maps, np.tile(dtype([[[0, 0, 0, 1]]]), (3, 1, 1))], axis=1)
    again = Instances([scene, triangle], [0, 1, 0], four)
    assert same(again.closest(origins, directions), instances.closest(origins, directions))


def test_instances_of_instances_are_the_exact_images(dtype):
    leaf = Scene(dtype([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 1]]), [[0, 1, 2], [0, 1, 3], [1, 2, 3]])
    random, turn = np.random.default_rng(8), dtype([[0, -1, 0], [1, 0, 0], [0, 0, 1]])

    def maps(count):
        made = np.zeros((count, 3, 4), dtype)
        made[:, :, :3] = turn * random.uniform(0.5, 1.5, (count, 1, 1)).astype(dtype)
        made[:, :, 3] = random.uniform(-2, 2, (count, 3))
        return made

    def placed_in(group, rows):
        return [
            [(i, *path), [[image(c, m) for c in t] for t in triangles]] for (i, m) in rows for path, triangles in group
        ]

    inner_maps, outer_maps, top_maps = maps(3), maps(3), maps(2)
    inner = Instances([leaf], [0, 0, 0], inner_maps)
    outer = Instances([inner, leaf], [0, 0, 1], outer_maps)
    told = []
    top = Instances([outer, inner], [0, 1], top_maps, progress=lambda *done: told.append(done))
    assert all(0 <= done <= count == 2 for done, count in told)
    of_leaf = [((), [oracle.corners(leaf.vertices, face) for face in leaf.faces])]
    of_inner = placed_in(of_leaf, enumerate(inner_maps))
    of_outer = placed_in(of_inner, [(0, outer_maps[0]), (1, outer_maps[1])]) + placed_in(of_leaf, [(2, outer_maps[2])])
    placed = placed_in(of_outer, [(0, top_maps[0])]) + placed_in(of_inner, [(1, top_maps[1])])
    origins = random.uniform(-4, 4, (300, 3)).astype(dtype)
    middles = np.array([[float(sum(x) / 3) for x in zip(*triangles[0])] for _, triangles in placed], dtype)
    directions = middles[random.integers(0, len(middles), 300)] - origins
    assert check_rays(top, placed, origins, directions) >= {2, 3}


def test_an_instance_that_is_not_moved_has_the_answers_of_its_scene(dtype):
    vertices, faces = octasphere(4, dtype)
    scene = Scene(vertices, faces)
    instances = Instances([scene], [0], np.eye(4, dtype=dtype)[None])
    origins, directions = some_rays(dtype, 2000, 3)
    # Half of the rays aim at vertices, where several faces are equally far.
    directions[::2] = vertices[np.arange(1000) % len(vertices)] - origins[::2]
    hits, expected = instances.closest(origins, directions), scene.closest(origins, directions)
    assert expected.hit.sum() > 1000 and np.array_equal(hits.instance, np.where(expected.hit, 0, -1))
    every, all_expected = instances.all_hits(origins, directions), scene.all_hits(origins, directions)
    for found, wanted in ((hits, expected), (every, all_expected)):
        names = [name for name in vars(wanted) if not name.startswith("_")]
        assert all(np.array_equal(getattr(found, name), getattr(wanted, name), equal_nan=True) for name in names)
    assert (every.instance == 0).all()
    assert np.array_equal(instances.any(origins, directions), expected.hit)
    counts = instances.count_crossings(origins, directions)
    assert np.array_equal(counts, scene.count_crossings(origins, directions)) and set(counts) >= {0, 1, 2}


@st.composite
def maps(draw):
    """Draws an invertible map with entries of a few bits; half of them are mirrors."""
    lower, upper = np.eye(3), np.eye(3)
    lower[np.tril_indices(3, -1)] = draw(st.lists(GRID, min_size=3, max_size=3))
    upper[np.triu_indices(3, 1)] = draw(st.lists(GRID, min_size=3, max_size=3))
    scale = draw(st.lists(st.sampled_from([-2, -1, -0.5, 0.5, 1, 3]), min_size=3, max_size=3))
    return np.column_stack([lower * scale @ upper, draw(points(GRID, 1))[0]])


@st.composite
def groups(draw, numbers):
    """Draws scenes of one dtype, and their placements."""
    dtype = draw(DTYPES)
    made = [draw(numbers) for _ in range(draw(st.integers(1, 2)))]
    scenes = [Scene(np.array(vertices, dtype), np.array(faces), draw(BUILDS)) for vertices, faces in made]
    objects = draw(st.lists(st.integers(0, len(scenes) - 1), min_size=1, max_size=3))
    rows = np.array([draw(maps()) for _ in objects], dtype)
    placed = [((i,), images_of(scenes[part], rows[i])) for i, part in enumerate(objects)]
    return Instances(scenes, objects, rows), placed


@pytest.mark.filterwarnings("ignore:faces. none has an area")
@settings(max_examples=100)
@given(groups(meshes(GRID)), points(GRID, 6), points(GRID.filter(bool), 6))
def test_drawn_instances_are_the_exact_images(group, origins, directions):
    instances, placed = group
    check_rays(instances, placed, *(np.array(rows, instances.dtype) for rows in (origins, directions)))


@pytest.mark.filterwarnings("ignore:faces. none has an area")
@settings(max_examples=100)
@given(groups(meshes(GRID)), points(GRID, 4), st.sampled_from([np.inf, 0.5, 1.0]))
def test_nearest_points_of_instances_are_those_of_rational_arithmetic(group, centers, radius):
    instances, placed = group
    dtype = instances.dtype.type
    centers = np.array(centers, dtype)
    near = instances.nearest(centers, radius)
    assert near.distance.dtype == near.point.dtype == dtype and len(near) == 4
    twice = Instances([instances], [0], np.eye(4, dtype=dtype)[None]).nearest(centers, radius)
    assert np.array_equal(twice.distance, near.distance) and np.array_equal(twice.point, near.point, equal_nan=True)
    for i, center in enumerate(centers):
        measured = [
            (*oracle.nearest_square(triangle, oracle.vector(center)), path, face)
            for path, triangles in placed
            for face, triangle in enumerate(triangles)
        ]
        squares = [square for square, *_ in measured]
        if min(squares) > radius**2:
            assert near.distance[i] == np.inf and near.primitive[i] == near.instance[i] == -1
            assert np.isnan(near.point[i]).all()
            continue
        assert oracle.is_rounded_root(near.distance[i], min(squares))
        # The first of all faces whose distances round to it.
        rounds = [found for found in measured if oracle.is_rounded_root(near.distance[i], found[0])]
        _, point, path, face = min(rounds, key=lambda found: found[2:])
        assert (tuple(near.path[i]), near.primitive[i]) == (path, face)
        assert near.point[i].tolist() == [oracle.rounded(x, dtype) for x in point]


@st.composite
def tetrahedra(draw):
    return draw(points(GRID, 4)), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


@pytest.mark.filterwarnings("ignore:faces. none has an area")
@settings(max_examples=100)
@given(groups(tetrahedra()), points(GRID, 6), points(GRID.filter(bool), 6))
def test_crossings_of_instances_are_those_of_a_ray_moved_by_very_little(group, origins, directions):
    instances, placed = group
    triangles = [triangle for _, each in placed for triangle in each if oracle.has_area(triangle)]
    counts = instances.count_crossings(*(np.array(rows, instances.dtype) for rows in (origins, directions)))
    for count, origin, direction in zip(counts, origins, directions):
        if all(oracle.nearest_square(triangle, oracle.vector(origin))[0] > 0 for triangle in triangles):
            assert count == oracle.crossings(triangles, origin, direction)


def test_crossings_count_the_instances_around_the_origin(dtype):
    # The edges of mirrored cubes meet, and rays run through edges, corners and diagonals of many of them.
    cube, signs = (
        Scene(CUBE.astype(dtype), CUBE_FACES),
        np.array([[x, y, z] for x in (1, -1) for y in (1, -1) for z in (1, -3)]),
    )
    rows = np.zeros((len(signs), 3, 4), dtype)
    rows[:, [0, 1, 2], [0, 1, 2]] = signs
    instances = Instances([cube], np.zeros(len(rows), int), rows)
    corners = np.array([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-3, 0, 1)], dtype)
    for origin, around in (([0.5, 0.25, 0.5], 1), ([-0.5, -0.5, -1], 1), ([0.5, 2, 0.25], 0)):
        counts = instances.count_crossings(dtype(origin), corners - dtype(origin))
        assert (counts % 2 == around).all() and len(set(counts)) > 1
    twice = Instances([instances], [0, 0], np.tile(np.eye(4, dtype=dtype), (2, 1, 1)))
    assert (twice.count_crossings(dtype(origin), corners - dtype(origin)) == 2 * counts).all()


def test_a_later_refit_does_not_change_the_instances(dtype):
    scene = Scene(*octasphere(3, dtype), build="sbvh")
    instances = Instances([scene], [0], np.eye(4, dtype=dtype)[None])
    origins, directions = some_rays(dtype, 500, 2)
    before = instances.all_hits(origins, directions)
    scene.refit(scene.vertices * 3, optimize=True)
    assert len(before.t) > 100 and same(instances.all_hits(origins, directions), before)


def test_float64_instances_accept_float32_rays_and_maps():
    scene = Scene(*octasphere(2))
    instances = Instances([scene], [0], np.eye(4, dtype=np.float32)[None])
    origins, directions = some_rays(np.float32, 100)
    assert same(
        instances.closest(origins, directions), instances.closest(*(x.astype(float) for x in (origins, directions)))
    )
    single = Instances([Scene(*octasphere(2, np.float32))], [0], np.eye(4, dtype=np.float32)[None])
    with pytest.raises(TypeError, match="origins: dtype float64, expected float32"):
        single.any(origins.astype(float), directions)

"""Scenes that are placed by maps, against rational arithmetic."""

import numpy as np
import oracle
from conftest import octasphere, same, some_rays

from stackless_bvh import Instances, Scene


def image(corner, rows):
    return tuple(sum(oracle.Fraction(float(m)) * x for m, x in zip(row, (*corner, 1))) for row in rows)


def closest_image(placed, origin, direction):
    """Returns the least (t, path, face) of all (path, triangles), or that of a miss."""
    found = [
        (oracle.rounded(hit[0], np.float32), path, face)
        for path, triangles in placed
        for face, triangle in enumerate(triangles)
        if (hit := oracle.meet(triangle, oracle.vector(origin), oracle.vector(direction))) and hit[0] >= 0
    ]
    return min(found, default=(np.inf, None, -1))


def triangles_of(scene):
    return [oracle.corners(scene.vertices, face) for face in scene.faces]


def images(triangles, rows):
    return [[image(corner, rows) for corner in triangle] for triangle in triangles]


def test_instances_are_the_exact_images():
    vertices, faces = octasphere(2, np.float32)
    scene, cube = Scene(vertices, faces), Scene(np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]])
    maps = np.zeros((3, 3, 4), np.float32)
    maps[:, [0, 1, 2], [0, 1, 2]] = [[1, 2, 0.5], [3, 3, 3], [0.25, 1, 1]]
    maps[:, :, 3] = [[0, 0, 4], [-3, 1, 0], [5, 0, 0]]
    instances = Instances([scene, cube], [0, 1, 0], maps)
    origins, directions = some_rays(np.float32, 300, 5)
    origins *= 4
    hits, hit_any = instances.closest(origins, directions), instances.any(origins, directions)
    assert len(instances) == 3 and set(hits.instance) == {-1, 0, 1, 2} and hits.path.shape == (300, 1)
    placed = [
        ((i,), images(triangles_of(part), rows)) for i, (part, rows) in enumerate(zip([scene, cube, scene], maps))
    ]
    for ray, (origin, direction) in enumerate(zip(origins, directions)):
        t, path, face = closest_image(placed, origin, direction)
        assert (hits.t[ray], hits.primitive[ray]) == (t, face) and hits.instance[ray] == (
            -1 if path is None else path[0]
        )
        assert hit_any[ray] == (face >= 0)
    four = np.concatenate([maps, np.tile(np.float32([[[0, 0, 0, 1]]]), (3, 1, 1))], axis=1)
    assert same(Instances([scene, cube], [0, 1, 0], four).closest(origins, directions), hits)


def test_instances_of_instances_are_the_exact_images():
    leaf = Scene(np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 1]]), [[0, 1, 2], [0, 1, 3], [1, 2, 3]])
    random, turn = np.random.default_rng(8), np.float32([[0, -1, 0], [1, 0, 0], [0, 0, 1]])

    def maps(count):
        made = np.zeros((count, 3, 4), np.float32)
        made[:, :, :3] = turn * random.uniform(0.5, 1.5, (count, 1, 1)).astype(np.float32)
        made[:, :, 3] = random.uniform(-2, 2, (count, 3))
        return made

    inner_maps, outer_maps, top_maps = maps(3), maps(3), maps(2)
    inner = Instances([leaf], [0, 0, 0], inner_maps)
    outer = Instances([inner, leaf], [0, 0, 1], outer_maps)
    told = []
    top = Instances([outer, inner], [0, 1], top_maps, progress=lambda *done: told.append(done))
    # All parts are groups, so the progress counts no faces.
    assert all(done == (0, 0) for done in told)
    of_inner = [((i,), images(triangles_of(leaf), rows)) for i, rows in enumerate(inner_maps)]
    of_outer = [
        ((i, *path), images(triangles, outer_maps[i]))
        for i, parts in enumerate([of_inner, of_inner, [((), triangles_of(leaf))]])
        for path, triangles in parts
    ]
    placed = [
        ((i, *path), images(triangles, top_maps[i]))
        for i, parts in enumerate([of_outer, of_inner])
        for path, triangles in parts
    ]
    origins = random.uniform(-4, 4, (300, 3)).astype(np.float32)
    middles = np.array([[float(sum(x) / 3) for x in zip(*triangles[0])] for _, triangles in placed], np.float32)
    directions = middles[random.integers(0, len(middles), 300)] - origins
    hits, depths = top.closest(origins, directions), set()
    assert hits.path.shape == (300, 3)
    for ray, (origin, direction) in enumerate(zip(origins, directions)):
        t, path, face = closest_image(placed, origin, direction)
        padded = [*(path or ()), *3 * [-1]][:3]
        assert (hits.t[ray], hits.path[ray].tolist(), hits.primitive[ray]) == (t, padded, face)
        depths.add(len(path or ()))
    assert depths >= {2, 3}


def test_an_instance_that_is_not_moved_has_the_answers_of_its_scene():
    vertices, faces = octasphere(4, np.float32)
    scene = Scene(vertices, faces)
    instances = Instances([scene], [0], np.eye(4, dtype=np.float32)[None])
    origins, directions = some_rays(np.float32, 2000, 3)
    # Half of the rays aim at vertices, where several faces are equally far.
    directions[::2] = vertices[np.arange(1000) % len(vertices)] - origins[::2]
    hits, expected = instances.closest(origins, directions), scene.closest(origins, directions)
    assert expected.hit.sum() > 1000 and np.array_equal(hits.instance, np.where(expected.hit, 0, -1))
    assert all(
        np.array_equal(getattr(hits, name), getattr(expected, name), equal_nan=True)
        for name in ("t", "primitive", "uv")
    )
    assert np.array_equal(instances.any(origins, directions), expected.hit)

"""The intersector for trimesh: compared with trimesh's own where that is correct, otherwise tested alone."""

import copy
import pickle
import warnings

import numpy as np
import pytest

trimesh = pytest.importorskip("trimesh")

from stackless_bvh.trimesh import RayMeshIntersector  # noqa: E402


def exact(mesh):
    mesh.ray = RayMeshIntersector(mesh)
    return mesh


def general_rays(count=300):
    random = np.random.default_rng(7)
    return random.uniform(-1.5, 1.5, (count, 3)), random.normal(size=(count, 3))


def test_answers_are_those_of_trimesh_for_rays_in_general_position():
    for mesh in (trimesh.creation.icosphere(2), trimesh.creation.box(), trimesh.creation.torus(1, 0.3)):
        origins, directions = general_rays()
        ours, theirs = RayMeshIntersector(mesh), trimesh.ray.ray_triangle.RayMeshIntersector(mesh)

        def pairs(answer):
            return sorted(zip(answer[1].tolist(), answer[0].tolist()))

        for multiple in (True, False):
            found = ours.intersects_id(origins, directions, multiple_hits=multiple)
            assert pairs(found) == pairs(theirs.intersects_id(origins, directions, multiple_hits=multiple))
            assert len(found[0]) > 30
        locations, index_ray, index_tri = ours.intersects_location(origins, directions)
        expected, their_ray, _ = theirs.intersects_location(origins, directions)
        order = lambda rays, places: np.lexsort((*places.round(6).T, rays))
        assert np.allclose(locations[order(index_ray, locations)], expected[order(their_ray, expected)])
        assert np.array_equal(ours.intersects_any(origins, directions), theirs.intersects_any(origins, directions))
        assert np.array_equal(ours.intersects_first(origins, directions), theirs.intersects_first(origins, directions))
        assert np.array_equal(ours.contains_points(origins), theirs.contains_points(origins))


def test_each_location_is_there_once_and_each_face_with_ids():
    mesh = exact(trimesh.creation.box())
    origins, directions = np.zeros((8, 3)), mesh.vertices.view(np.ndarray)
    _, rays, _ = mesh.ray.intersects_location(origins, directions)
    assert rays.tolist() == list(range(8))
    _, rays = mesh.ray.intersects_id(origins, directions)
    assert (np.bincount(rays) == [sum(v in face for face in mesh.faces) for v in range(8)]).all()
    through = np.tile([[-2.0, 0.25, 0.25]], (8, 1)), np.tile([[1.0, 0, 0]], (8, 1))
    tri, rays = mesh.ray.intersects_id(*through, max_hits=1)
    assert rays.tolist() == list(range(8))
    _, rays, places = mesh.ray.intersects_id(*through, multiple_hits=True, return_locations=True)
    assert np.bincount(rays).tolist() == [2] * 8 and np.allclose(np.abs(places[:, 0]), 0.5)


def test_contains_is_right_where_rays_meet_vertices():
    mesh = exact(trimesh.creation.icosphere(3))
    # Points on the lines between opposite vertices.
    points = np.concatenate([mesh.vertices * scale for scale in (0, 0.5, 0.99, 1.01, 2)])
    assert mesh.contains(points).tolist() == [True] * (3 * len(mesh.vertices)) + [False] * (2 * len(mesh.vertices))
    assert mesh.contains(mesh.vertices).all()


def test_a_mesh_that_is_not_closed_gets_a_guess_and_a_warning():
    mesh = trimesh.creation.box()
    mesh.update_faces(np.arange(len(mesh.faces)) > 0)
    exact(mesh)
    with pytest.warns(UserWarning, match="not closed"):
        assert mesh.contains([[0, 0, 0], [5, 5, 5]]).shape == (2,)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert exact(trimesh.creation.box()).contains([[0, 0, 0]]).all()


def test_a_changed_mesh_is_seen():
    mesh = exact(trimesh.creation.box())
    ray = [[0, 0, 5.0]], [[0, 0, -1.0]]
    assert mesh.ray.intersects_location(*ray)[0].tolist() == [[0, 0, 0.5], [0, 0, -0.5]]
    scene = mesh.ray.scene
    assert mesh.ray.scene is scene
    mesh.apply_scale(2)
    assert mesh.ray.intersects_location(*ray)[0].tolist() == [[0, 0, 1], [0, 0, -1]]
    assert copy.deepcopy(mesh.ray).intersects_any(*ray).all() and copy.copy(mesh.ray).intersects_any(*ray).all()
    assert pickle.loads(pickle.dumps(mesh.ray)).intersects_any(*ray).all()


def test_rays_without_a_direction_and_meshes_without_faces():
    mesh = exact(trimesh.creation.box())
    rays = np.zeros((2, 3)), np.array([[0, 0, 0.0], [0, 0, 1]])
    assert mesh.ray.intersects_any(*rays).tolist() == [False, True]
    assert mesh.ray.intersects_first(*rays)[0] == -1
    assert set(mesh.ray.intersects_id(*rays)[1].tolist()) == {1}
    empty = exact(trimesh.Trimesh(vertices=[[0, 0, 0]], faces=np.zeros((0, 3), int)))
    assert not empty.ray.intersects_any(*rays).any() and (empty.ray.intersects_first(*rays) == -1).all()
    assert [len(part) for part in empty.ray.intersects_location(*rays)] == [0, 0, 0]
    with pytest.raises(ValueError, match="expected the same"):
        mesh.ray.intersects_any([[0, 0, 0]], rays[1])
    with pytest.raises(ValueError, match=r"origins\[0\]: \[NaN, 0, 0\]"):
        mesh.ray.intersects_any([[np.nan, 0, 0]], [[0, 0, 1]])


def test_unknown_arguments_and_masked_arrays_are_refused():
    ray = [[0, 0, 5.0]], [[0, 0, -1.0]]
    intersector = RayMeshIntersector(trimesh.creation.box())
    for query in ("id", "location", "first", "any"):
        with pytest.raises(TypeError, match="unexpected keyword argument 'tmax'"):
            getattr(intersector, f"intersects_{query}")(*ray, tmax=1)
    masked = np.ma.masked_equal([[0, 0, 5.0]], 5)
    with pytest.raises(ValueError, match=r"ray_origins\[0\]: masked"):
        intersector.intersects_any(masked, ray[1])
    with pytest.raises(ValueError, match=r"points\[0\]: masked"):
        intersector.contains_points(masked)

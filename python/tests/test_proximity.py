"""The proximity functions: compared with those of trimesh where trimesh is correct, otherwise tested alone."""

import gc
import inspect
import pickle
import warnings
import weakref

import numpy as np
import pytest

trimesh = pytest.importorskip("trimesh")

from stackless_bvh import proximity  # noqa: E402
from stackless_bvh.trimesh import RayMeshIntersector, scene_of  # noqa: E402

MESHES = [trimesh.creation.icosphere(2), trimesh.creation.box(), trimesh.creation.torus(1, 0.3)]
POINTS = np.random.default_rng(5).uniform(-1.5, 1.5, (300, 3))
ON, NORMALS = [], []
for _mesh in MESHES:
    _faces = np.arange(0, len(_mesh.faces), 7)
    # Points away from the middles of faces: the opposite point is then on a face too, not on an edge.
    ON.append(np.einsum("j,ijk->ik", [0.5, 0.3, 0.2], _mesh.triangles[_faces]))
    NORMALS.append(_mesh.face_normals[_faces])

CALLS = {
    "closest_point": lambda module, mesh, on, normals: module.closest_point(mesh, POINTS),
    "on_surface": lambda module, mesh, on, normals: module.ProximityQuery(mesh).on_surface(POINTS),
    "vertex": lambda module, mesh, on, normals: module.ProximityQuery(mesh).vertex(POINTS),
    "signed_distance": lambda module, mesh, on, normals: module.signed_distance(mesh, POINTS),
    "its signed_distance": lambda module, mesh, on, normals: module.ProximityQuery(mesh).signed_distance(POINTS),
    "longest_ray": lambda module, mesh, on, normals: module.longest_ray(mesh, POINTS, 3 * POINTS[::-1]),
    "longest_ray inwards": lambda module, mesh, on, normals: module.longest_ray(mesh, on, -normals),
    "max_tangent_sphere": lambda module, mesh, on, normals: module.max_tangent_sphere(mesh, on),
    "of given normals": lambda module, mesh, on, normals: module.max_tangent_sphere(mesh, on, False, normals),
    "thickness": lambda module, mesh, on, normals: module.thickness(mesh, on),
    "reach": lambda module, mesh, on, normals: module.thickness(mesh, on, exterior=True),
    "ray thickness": lambda module, mesh, on, normals: module.thickness(mesh, on, method="ray"),
    "ray reach": lambda module, mesh, on, normals: module.thickness(mesh, on, True, normals, "ray"),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("which", range(len(MESHES)))
def test_answers_are_those_of_trimesh(which, call):
    mesh = MESHES[which]
    ours, theirs = (CALLS[call](module, mesh, ON[which], NORMALS[which]) for module in (proximity, trimesh.proximity))
    assert type(ours) is type(theirs)
    for our, their in zip(*(parts if isinstance(parts, tuple) else (parts,) for parts in (ours, theirs))):
        assert type(our) is np.ndarray and our.dtype == their.dtype and our.shape == their.shape
        if our.dtype.kind == "f":
            # Tangent spheres are approximate where the mesh is concave.
            assert np.allclose(our, their, rtol=0, atol=1e-4 if mesh is MESHES[2] else 1e-9, equal_nan=True)
        elif call == "vertex":
            assert np.array_equal(our, their)
        else:
            # trimesh compares only two of the equally near faces.
            toward = [((POINTS - ours[0]) * mesh.face_normals[faces]).sum(axis=1) for faces in (our, their)]
            assert (toward[0] > toward[1] - 1e-9).all() and (our == their).mean() > 0.8


@pytest.mark.parametrize("name", ["closest_point", "signed_distance", "longest_ray", "max_tangent_sphere", "thickness"])
def test_arguments_are_those_of_trimesh(name):
    ours, theirs = (inspect.signature(getattr(module, name)).parameters for module in (proximity, trimesh.proximity))
    assert list(ours) == list(theirs)
    assert [p.default for p in ours.values()] == [p.default for p in theirs.values()]
    with pytest.raises(TypeError, match="unexpected keyword argument 'tmax'"):
        getattr(proximity, name)(MESHES[1], POINTS, tmax=1)


def test_of_equally_near_faces_the_one_that_faces_the_point():
    box = trimesh.creation.box()
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    # The nearest point is a corner of four or more faces; one side of the box faces the point most directly.
    points = (axes[:, np.newaxis] * 2 + 1.25 * box.vertices.view(np.ndarray)).reshape(-1, 3)
    points = points[(np.abs(points) > 0.5).all(axis=1) & (np.abs(points) > 2).any(axis=1)]
    closest, distance, face = proximity.closest_point(box, points)
    assert (np.abs(closest) == 0.5).all() and np.array_equal(distance, np.linalg.norm(points - closest, axis=1))
    assert np.array_equal(box.face_normals[face].round(), np.where(np.abs(points) > 2, np.sign(points), 0))
    assert len(points) == 24


def test_signed_distances_are_exact():
    box = trimesh.creation.box()
    grid = np.stack(np.meshgrid(*[np.arange(-8, 9) / 8] * 3), axis=-1).reshape(-1, 3)
    beyond = np.abs(grid) - 0.5
    expected = np.where(beyond.max(axis=1) > 0, -np.sqrt((np.maximum(beyond, 0) ** 2).sum(axis=1)), -beyond.max(axis=1))
    for mesh in (box, trimesh.Trimesh(box.vertices, box.faces[:, ::-1])):
        assert np.array_equal(proximity.signed_distance(mesh, grid), expected)
    assert not np.signbit(proximity.signed_distance(box, box.vertices)).any()


def test_the_sign_of_a_mesh_that_is_not_closed_is_that_of_trimesh():
    mesh = MESHES[0].copy()
    mesh.update_faces(np.arange(len(mesh.faces)) % 9 > 0)
    mesh.ray = RayMeshIntersector(mesh)
    with pytest.warns(UserWarning, match="not closed"):
        ours = proximity.signed_distance(mesh, POINTS)
        theirs = trimesh.proximity.signed_distance(mesh, POINTS)
    assert np.allclose(ours, theirs) and 0 < (ours > 0).sum() < len(ours)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        proximity.signed_distance(MESHES[0], POINTS)


def test_hits_at_the_point_itself_are_skipped():
    box = trimesh.creation.box()
    points = [[0.5 + gap, 0.1, 0.2] for gap in (1e-6, 5e-5, 0.1, 0, 0)]
    found = proximity.longest_ray(box, points, [[-9, 0, 0], [-9, 0, 0], [-2, 0, 0], [1, 0, 0], [0, 0, 0]])
    assert np.allclose(found, [1 + 1e-6, 5e-5, 0.1, np.inf, np.inf], rtol=1e-9)


def test_queries_share_a_scene_which_follows_the_mesh():
    mesh = trimesh.creation.box()
    mesh.ray, mesh.nearest = RayMeshIntersector(mesh), proximity.ProximityQuery(mesh)
    assert mesh.nearest.signed_distance([[0, 0, 0]]) == [0.5]
    assert mesh.ray.scene is scene_of(mesh)
    mesh.apply_scale(2)
    assert mesh.nearest.signed_distance([[0, 0, 0]]) == [1]
    assert pickle.loads(pickle.dumps(mesh)).nearest.signed_distance([[0, 0, 0]]) == [1]
    scene, gone = scene_of(mesh), weakref.ref(mesh)
    assert scene_of(mesh.copy()) is not scene
    mesh.ray = mesh.nearest = None
    del mesh
    gc.collect()
    assert gone() is None


EMPTY = trimesh.Trimesh(vertices=[[0, 0, 0]], faces=np.zeros((0, 3), int))
REFUSED = [
    (lambda p: p.closest_point(EMPTY, POINTS), "mesh: no faces, expected at least one"),
    (lambda p: p.closest_point(MESHES[1], [0, 0, 0]), r"points: shape \(3,\), expected \(n, 3\)"),
    (lambda p: p.signed_distance(MESHES[1], [[0, 0, np.nan]]), r"points\[0\]: \[0, 0, NaN\], expected finite numbers"),
    (lambda p: p.longest_ray(MESHES[1], POINTS, POINTS[1:]), "directions: 299 rows, expected 300, one for each of"),
    (lambda p: p.thickness(MESHES[1], POINTS, False, POINTS[1:]), "normals: 299 rows, expected 300"),
    (lambda p: p.thickness(MESHES[1], POINTS, method="cube"), "method: 'cube', expected 'max_sphere' or 'ray'"),
]


@pytest.mark.parametrize(("call", "message"), REFUSED)
def test_what_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call(proximity)


def test_no_points():
    none = np.zeros((0, 3))
    assert [part.shape for part in proximity.closest_point(MESHES[1], none)] == [(0, 3), (0,), (0,)]
    assert proximity.signed_distance(MESHES[1], none).shape == (0,)
    assert proximity.longest_ray(MESHES[1], none, none).shape == (0,)

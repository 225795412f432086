"""`RaycastingScene` on meshes with known answers, and compared with that of Open3D if it is installed."""

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import CUBE, CUBE_FACES, octasphere

from stackless_bvh import Scene
from stackless_bvh.open3d import RaycastingScene

NONE = RaycastingScene.INVALID_ID
# A square of two triangles, counterclockwise from above, and below it a triangle, counterclockwise from below.
SQUARE = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [2, 2, 0]], dtype=np.float64), np.array([[0, 1, 2], [1, 3, 2]])
BELOW = np.array([[9, 9, 9], [0, 0, -1], [2, 0, -1], [0, 2, -1]], dtype=np.float64), np.array([[1, 3, 2]])
NOTHING = CUBE, CUBE_FACES[:0]


class Tensor:
    """A stand-in for a tensor: it has only the method."""

    def __init__(self, array):
        self.array = np.asarray(array)

    def numpy(self):
        return self.array


def scene_of(*meshes, dtype=np.float32):
    scene = RaycastingScene()
    ids = [scene.add_triangles(vertices.astype(dtype), faces.astype(np.uint32)) for vertices, faces in meshes]
    assert ids == list(range(len(meshes)))
    return scene


def check(found, expected, dtype):
    """Compares all values, shapes and dtypes of answers with lists, by name."""
    assert found.keys() == expected.keys()
    for name, values in expected.items():
        kind = np.uint32 if "ids" in name or "splits" in name else dtype
        assert found[name].dtype == kind and type(found[name].numpy()) is np.ndarray, name
        assert np.array_equal(found[name], np.array(values, dtype=kind), equal_nan=kind is dtype), name


RAYS = [
    [0.25, 0.5, 5, 0, 0, -2],  # through both geometries
    [9, 9, 9, 0, 0, 1],  # a miss
    [1, 1, 5, 0, 0, -1],  # through the diagonal of the square, and the border of the triangle below
    [0.25, 0.5, -5, 0, 0, 1],  # from below
    [1.5, 1, 5, 0, 0, -1],  # the second triangle
    [0.25, 0.5, 0, 0, 0, 0],  # no direction
]


def test_rays_of_known_answers(dtype):
    scene, rays = scene_of(SQUARE, NOTHING, BELOW, dtype=dtype), np.array(RAYS, dtype)
    up, down, zero = [0, 0, 1], [0, 0, -1], [0, 0, 0]
    first = {
        "t_hit": [2.5, np.inf, 5, 4, 5, np.inf],
        "geometry_ids": [0, NONE, 0, 2, 0, NONE],
        "primitive_ids": [0, NONE, 0, 0, 1, NONE],
        "primitive_uvs": [[0.125, 0.25], [0, 0], [0.5, 0.5], [0.25, 0.125], [0.25, 0.25], [0, 0]],
        "primitive_normals": [up, zero, up, down, up, zero],
    }
    check(scene.cast_rays(rays), first, dtype)
    pairs = {name: [[a, b], [c, d], [e, f]] for name, (a, b, c, d, e, f) in first.items()}
    check(scene.cast_rays(rays.reshape(3, 2, 6)), pairs, dtype)
    check(scene.cast_rays(rays[0]), {name: values[0] for name, values in first.items()}, dtype)
    check(scene.cast_rays(rays[:0]), {name: np.empty((0, *np.shape(a)[1:])) for name, a in first.items()}, dtype)
    a = 0.125
    every = {
        "ray_splits": [0, 2, 2, 4, 6, 7, 7],
        "ray_ids": [0, 0, 2, 2, 3, 3, 4],
        "t_hit": [2.5, 3, 5, 6, 4, 5, 5],
        "geometry_ids": [0, 2, 0, 2, 2, 0, 0],
        "primitive_ids": [0, 0, 0, 0, 0, 0, 1],
        "primitive_uvs": [[a, 2 * a], [2 * a, a], [0.5, 0.5], [0.5, 0.5], [2 * a, a], [a, 2 * a], [2 * a, 2 * a]],
    }
    check(scene.list_intersections(rays.reshape(3, 2, 6)), every, dtype)
    counts = scene.count_intersections(rays.reshape(2, 3, 6))
    assert counts.dtype == np.int32 and counts.tolist() == [[2, 0, 1], [2, 1, 0]]
    occluded = scene.test_occlusions(rays.reshape(2, 3, 6))
    assert occluded.dtype == bool and occluded.tolist() == [[True, False, True], [True, True, False]]
    assert scene.test_occlusions(rays, tnear=3, tfar=4.5).tolist() == [True, False, False, True, False, False]
    assert scene.test_occlusions(rays, 4, 4).tolist() == [False, False, False, True, False, False]


def test_points_of_known_answers(dtype):
    scene = scene_of(BELOW, NOTHING, SQUARE, (CUBE, np.array([[0, 0, 4]])), dtype=dtype)
    points = np.array([[[0.25, 0.5, 3]], [[-3, 0, -5]], [[1.5, 1, 0.5]], [[0.5, -1, 0]]], dtype)
    # The edge of the square at y = 0 is as near as the segment from (0, 0, 0) to (1, 0, 0), and comes first.
    expected = {
        "points": [[[0.25, 0.5, 0]], [[0, 0, -1]], [[1.5, 1, 0]], [[0.5, 0, 0]]],
        "geometry_ids": [[2], [0], [2], [2]],
        "primitive_ids": [[0], [0], [1], [0]],
        "primitive_uvs": [[[0.125, 0.25]], [[0, 0]], [[0.25, 0.25]], [[0.25, 0]]],
        "primitive_normals": [[[0, 0, 1]], [[0, 0, -1]], [[0, 0, 1]], [[0, 0, 1]]],
    }
    check(scene.compute_closest_points(points), expected, dtype)
    distance = scene.compute_distance(points)
    assert distance.dtype == dtype and distance.tolist() == [[3], [5], [0.5], [1]]
    with pytest.warns(UserWarning, match="none has an area"):
        segment = scene_of((CUBE, np.array([[0, 0, 4]])), dtype=dtype).compute_closest_points(points)
    assert segment["points"][3].tolist() == [[0.5, 0, 0]] and np.isnan(segment["primitive_normals"]).all()


def test_inside_and_outside(dtype):
    scene = scene_of((CUBE, CUBE_FACES), (CUBE[:, ::-1] + [3, 0, 0], CUBE_FACES), dtype=dtype)
    x = np.arange(-8, 36) / 8
    points = np.stack(np.broadcast_arrays(x[:, None], 0.5, np.array([0.5, 0.75, 1.5])), axis=-1).astype(dtype)
    across = np.minimum(np.abs(x - 0.5), np.abs(x - 3.5))[:, None] - 0.5
    upward = np.array([-0.5, -0.25, 0.5])
    expected = np.where((across > 0) & (upward > 0), np.hypot(across, upward), np.maximum(across, upward))
    for keywords in ({}, {"nthreads": 2, "nsamples": 5}):
        signed, inside = scene.compute_signed_distance(points, **keywords), scene.compute_occupancy(points, **keywords)
        assert signed.dtype == inside.dtype == dtype
        assert np.array_equal(signed, expected.astype(dtype)) and np.array_equal(inside, expected <= 0)


def test_the_inside_of_open_meshes_is_a_guess():
    scene = scene_of((CUBE, CUBE_FACES[1:]))
    for query, answer in ((scene.compute_occupancy, [1, 0]), (scene.compute_signed_distance, [-0.25, 1])):
        with pytest.warns(UserWarning, match="the meshes are not closed") as warned:
            assert query(np.float32([[0.5, 0.5, 0.75], [0.5, 0.5, 2]])).tolist() == answer
        assert len(warned) == 1 and warned[0].filename == __file__


@pytest.mark.parametrize("meshes", [(), (NOTHING,)])
@pytest.mark.filterwarnings("error")
def test_a_scene_without_triangles_is_far_away(meshes):
    scene, rays, points = scene_of(*meshes), np.float32(RAYS), np.zeros((2, 3), np.float32)
    hits = scene.cast_rays(rays)
    assert (
        np.isinf(hits["t_hit"]).all() and (hits["geometry_ids"] == NONE).all() and (hits["primitive_ids"] == NONE).all()
    )
    assert not hits["primitive_uvs"].any() and not hits["primitive_normals"].any()
    assert not scene.count_intersections(rays).any() and not scene.test_occlusions(rays).any()
    assert scene.list_intersections(rays)["ray_splits"].tolist() == [0] * 7
    near = scene.compute_closest_points(points)
    assert np.isnan(near["points"]).all() and (near["geometry_ids"] == NONE).all()
    assert np.isinf(scene.compute_distance(points)).all() and np.isinf(scene.compute_signed_distance(points)).all()
    assert not scene.compute_occupancy(points).any()


def test_ids_are_those_of_one_merged_scene():
    spheres = [octasphere(2), octasphere(1), octasphere(3)]
    meshes = [(v * scale, f) for (v, f), scale in zip(spheres, (1, 2, 0.5))]
    sizes = np.array([len(v) for v, _ in meshes]), np.array([len(f) for _, f in meshes])
    first_vertex, first_face = (np.cumsum([0, *size[:-1]]) for size in sizes)
    merged = Scene(
        np.concatenate([v for v, _ in meshes]), np.concatenate([f + at for (_, f), at in zip(meshes, first_vertex)])
    )
    rays = np.random.default_rng(2).uniform(-2, 2, (2000, 6))
    scene, hits, near = (
        scene_of(*meshes, dtype=np.float64),
        merged.closest(rays[:, :3], rays[:, 3:]),
        merged.nearest(rays[:, :3]),
    )
    found, points = scene.cast_rays(rays), scene.compute_closest_points(rays[:, :3])
    assert np.array_equal(found["t_hit"], hits.t) and np.array_equal(points["points"], near.point)
    for answers, primitive in ((found, hits.primitive), (points, near.primitive)):
        hit = primitive >= 0
        geometry = answers["geometry_ids"][hit].astype(int)
        assert np.array_equal(first_face[geometry] + answers["primitive_ids"][hit], primitive[hit])
        assert (answers["primitive_ids"][hit] < sizes[1][geometry]).all() and len(np.unique(geometry)) > 1
    assert np.allclose(np.linalg.norm(found["primitive_normals"][hits.hit], axis=1), 1, rtol=1e-15)


def test_a_hit_of_two_geometries_is_listed_for_each():
    scene, diagonal = scene_of(SQUARE, SQUARE), np.float32([[1, 1, 5, 0, 0, -1]] * 2)
    found = scene.list_intersections(diagonal)
    assert found["geometry_ids"].tolist() == [0, 1, 0, 1] and found["ray_splits"].tolist() == [0, 2, 4]
    assert scene.count_intersections(diagonal).tolist() == [2, 2]


def test_meshes_can_be_added_later_and_do_not_change():
    vertices, faces = np.float32(SQUARE[0]), SQUARE[1].copy()
    scene, ray = RaycastingScene(nthreads=1), np.float32([[0.25, 0.5, -5, 0, 0, 1]])
    scene.add_triangles(vertices, faces)
    vertices[:], faces[:] = 7, 0
    assert scene.cast_rays(ray)["t_hit"] == 5
    assert scene.add_triangles(np.float32(BELOW[0]), BELOW[1]) == 1
    assert scene.cast_rays(ray)["t_hit"] == 4
    assert scene.cast_rays(ray)["t_hit"].dtype == np.float32
    # One mesh of float64 makes the whole scene float64.
    scene.add_triangles(BELOW[0] + [0, 0, 0.1], BELOW[1])
    assert scene.cast_rays(ray.astype(np.float64))["t_hit"] == 4 and scene.cast_rays(ray)["t_hit"].dtype == np.float64


def test_tensors_are_taken_for_arrays():
    vertices, faces = Tensor(np.float32(SQUARE[0])), Tensor(SQUARE[1])
    mesh = SimpleNamespace(vertex=SimpleNamespace(positions=vertices), triangle=SimpleNamespace(indices=faces))
    scene = RaycastingScene()
    added = [
        scene.add_triangles(vertices, faces),
        scene.add_triangles(triangle_indices=faces, vertex_positions=vertices),
        scene.add_triangles(mesh),
        scene.add_triangles(mesh=mesh),
    ]
    assert added == [0, 1, 2, 3]
    assert scene.cast_rays(Tensor(np.float32(RAYS)))["t_hit"][0] == 2.5
    assert scene.compute_distance(Tensor(np.float32([[0, 0, 4]]))) == 4
    assert np.array_equal(RaycastingScene.create_rays_pinhole(Tensor(K), Tensor(E), 2, 3), CAMERAS[2][1])


K = np.array([[100, 50, 1], [0, 125, 1.5], [0, 0, 1]])
E = np.array([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])


def rays_of(origin, directions):
    directions = np.array(directions, dtype=np.float32)
    return np.concatenate([np.broadcast_to(np.float32(origin), directions.shape), directions], axis=-1)


# The directions are those of Open3D; test_cameras_are_those_of_open3d compares more.
CAMERAS = [
    (
        dict(fov_deg=90, center=[0, 0, 0], eye=[0, 0, 5], up=[0, 1, 0], width_px=2, height_px=3),
        rays_of([0, 0, 5], [[[x, y, -1] for x in (0.5, -0.5)] for y in (-1, 0, 1)]),
    ),
    (
        dict(fov_deg=90, center=[3, 0, 1], eye=[1, 0, 1], up=[0, 7, 2], width_px=2, height_px=1),
        rays_of([1, 0, 1], [[[1, np.sin(a) * x, np.cos(a) * x] for x in (0.5, -0.5)] for a in [np.arctan2(-2, 7)]]),
    ),
    (
        dict(intrinsic_matrix=K, extrinsic_matrix=E, width_px=2, height_px=3),
        # y is (row - 1) / 125, and x is (column - 0.5 - 50 y) / 100. Turned to the world they are (y, -x, 1).
        rays_of([-2, 1, -3], [[[r / 125, -(c - 0.4 * r) / 100, 1] for c in (-0.5, 0.5)] for r in (-1, 0, 1)]),
    ),
]  # fmt: skip


@pytest.mark.parametrize(("camera", "expected"), CAMERAS)
def test_cameras(camera, expected):
    for rays in (
        RaycastingScene.create_rays_pinhole(**camera),
        RaycastingScene().create_rays_pinhole(*camera.values()),
    ):
        assert rays.dtype == np.float32 and rays.shape == (camera["height_px"], camera["width_px"], 6)
        assert np.allclose(rays, expected, rtol=0, atol=1e-7)
        assert type(rays.numpy()) is np.ndarray


F4, F8, ALONG = np.float32, np.float64, np.array([0, 0, 1])
REFUSED = [
    (lambda s: s.add_triangles(CUBE.astype(int), CUBE_FACES), TypeError, "vertices: dtype int64"),
    (lambda s: s.add_triangles(CUBE, CUBE_FACES + 1), ValueError, r"triangle_indices\[2\]: index 8 of vertex 2"),
    (lambda s: s.add_triangles(CUBE, CUBE_FACES - 1), ValueError, r"triangle_indices\[0\]: index -1 of vertex 0"),
    (lambda s: s.add_triangles(CUBE[:, :2], CUBE_FACES), ValueError, r"vertices: shape \(8, 2\)"),
    (lambda s: s.add_triangles(CUBE), TypeError, "mesh: ndarray, expected an object with vertex.positions"),
    (lambda s: s.add_triangles(CUBE, CUBE_FACES, 3), TypeError, "3 were given"),
    (lambda s: s.add_triangles(CUBE, faces=CUBE_FACES), TypeError, "unexpected keyword argument 'faces'"),
    (lambda s: s.cast_rays(np.zeros((4, 5), F4)), ValueError, r"rays: shape \(4, 5\), expected \(..., 6\)"),
    (lambda s: s.cast_rays(np.zeros((4, 6), F8)), TypeError, "rays: dtype float64, expected float32"),
    (lambda s: s.cast_rays(F4([[0] * 6, [np.nan, 0, 0, 0, 0, 1]])), ValueError, r"origins\[1\]: \[NaN, 0, 0\]"),
    (lambda s: s.cast_rays(F4([[0, 0, 0, 0, 0, np.nan]])), ValueError, r"directions\[0\]: \[0, 0, NaN\]"),
    (lambda s: s.cast_rays(np.zeros((4, 6), F4), tnear=0), TypeError, "unexpected keyword argument 'tnear'"),
    (lambda s: s.test_occlusions(np.zeros((4, 6), F4), 2, 1), ValueError, "tnear and tfar: 2 and 1, expected 0 <="),
    (lambda s: s.test_occlusions(np.zeros((4, 6), F4), -1), ValueError, "tnear and tfar: -1 and inf, expected 0 <="),
    (lambda s: s.compute_distance(np.zeros((4, 6), F4)), ValueError, r"query_points: shape \(4, 6\), expected"),
    (lambda s: s.compute_signed_distance(np.zeros((4, 3), F4), nsamples=2), ValueError, "nsamples: 2, expected an odd"),
    (lambda s: s.compute_occupancy(np.zeros((4, 3), F4), nsamples=-1), ValueError, "nsamples: -1, expected an odd"),
    (lambda s: s.create_rays_pinhole(K[:2], E, 2, 3), ValueError, r"intrinsic_matrix: shape \(2, 3\), expected"),
    (lambda s: s.create_rays_pinhole(K, E[:3], 2, 3), ValueError, r"extrinsic_matrix: shape \(3, 4\), expected"),
    (lambda s: s.create_rays_pinhole(60, ALONG, 5 * ALONG, ALONG, 2, 3), ValueError, r"up: \[0.0, 0.0, 1.0\]"),
    (lambda s: s.create_rays_pinhole(60, [0, 0], ALONG, ALONG, 2, 3), ValueError, r"center: shape \(2,\), expected"),
]  # fmt: skip


@pytest.mark.parametrize(("call", "kind", "message"), REFUSED)
def test_what_is_refused(call, kind, message):
    with pytest.raises(kind, match=message) as error:
        call(scene_of((CUBE, CUBE_FACES)))
    assert "\n" not in str(error.value)


EXAMPLE = Path(__file__).parents[1] / "examples/from_open3d.py"


def run_example(capsys, source):
    exec(compile(source, EXAMPLE, "exec"), {})
    return capsys.readouterr().out


def test_the_example_draws_three_sides_of_a_box(capsys):
    picture, told = run_example(capsys, EXAMPLE.read_text()).split("inside: ")
    rows = picture.splitlines()
    assert len(rows) == 30 and {len(row) for row in rows} == {60} and set(picture) == set(".=+o\n")
    assert told == "[1. 0.]\ndistance: [-0.25  2.  ]\n"


def test_the_example_runs_with_open3d(theirs, capsys):
    ours = EXAMPLE.read_text()
    their = re.sub("^from stackless_bvh.open3d import", "from open3d.t.geometry import", ours, flags=re.MULTILINE)
    assert their != ours and run_example(capsys, their) == run_example(capsys, ours)


@pytest.fixture
def theirs():
    open3d = pytest.importorskip("open3d", reason="Open3D is not installed, so nothing is compared with it")
    return open3d.t.geometry.RaycastingScene


def test_answers_are_those_of_open3d_in_general_position(theirs):
    ours, theirs = RaycastingScene(), theirs()
    for levels, scale, move in ((5, 1, 0), (3, 0.7, 0.2), (4, 1.5, 3)):
        vertices, faces = octasphere(levels)
        mesh = (vertices * scale + move).astype(np.float32), faces.astype(np.uint32)
        assert ours.add_triangles(*mesh) == theirs.add_triangles(*mesh)
    random = np.random.default_rng(9)
    starts = random.uniform(-2, 5, (100, 1000, 3))
    rays = np.concatenate([starts, random.uniform(-1, 4, starts.shape) - starts], axis=-1).astype(np.float32)
    points = rays[:20, :, :3].copy()
    queries = {
        "cast_rays": (rays,),
        "test_occlusions": (rays, 0.25, 0.75),
        "count_intersections": (rays,),
        "compute_closest_points": (points,),
        "compute_distance": (points,),
        "compute_signed_distance": (points,),
        "compute_occupancy": (points,),
    }
    for query, arguments in queries.items():
        our, their = getattr(ours, query)(*arguments), getattr(theirs, query)(*arguments)
        if not isinstance(our, dict):
            our, their = {query: our}, {query: their}
        assert our.keys() == their.keys()
        # About half of the nearest points are on an edge or a vertex, where several triangles are correct.
        same = our["primitive_ids"] == their["primitive_ids"].numpy() if "primitive_ids" in our else True
        assert np.mean(same) > (0.5 if query == "compute_closest_points" else 0.9999)
        for name, found in our.items():
            expected = their[name].numpy()
            assert found.dtype == expected.dtype and found.shape == expected.shape, (query, name)
            if found.dtype.kind == "f" and name not in ("primitive_uvs", "primitive_normals"):
                assert np.allclose(found, expected, rtol=1e-4, atol=3e-3 if name == "points" else 1e-5), (query, name)
            elif found.dtype.kind == "f":
                # Open3D rounds at each step, so normals and weights of small triangles have few correct digits.
                assert np.abs(found - expected)[same].max() < 0.02, (query, name)
            elif name != "primitive_ids":
                assert (found == expected).mean() > 0.9999, (query, name)
    our, their = ours.list_intersections(rays), theirs.list_intersections(rays)
    assert our.keys() == their.keys() and {a.dtype for a in our.values()} == {a.numpy().dtype for a in their.values()}
    # Compare only rays with equal counts: at an edge, Open3D counts one or two hits.
    counts = [np.diff(answers["ray_splits"].numpy().astype(int)) for answers in (our, their)]
    alike = counts[0] == counts[1]
    assert alike.mean() > 0.9999 and counts[0].sum() > len(rays)
    kept = [np.repeat(alike, count) for count in counts]
    # Open3D returns the hits of a ray in any order.
    order = np.lexsort((their["t_hit"].numpy(), their["ray_ids"].numpy()))
    assert (np.lexsort((our["t_hit"], our["ray_ids"])) == np.arange(len(our["t_hit"]))).all()
    for name in ("ray_ids", "geometry_ids", "primitive_ids", "t_hit"):
        found, expected = our[name][kept[0]], their[name].numpy()[order][kept[1]]
        assert np.isclose(found, expected, rtol=1e-4, atol=1e-4).mean() > 0.9999, name


def test_cameras_are_those_of_open3d(theirs):
    random = np.random.default_rng(4)
    turned = np.eye(4)
    turned[:3, :3], turned[:3, 3] = np.linalg.qr(random.normal(size=(3, 3)))[0], random.normal(size=3)
    for camera in [
        *(camera for camera, _ in CAMERAS),
        dict(intrinsic_matrix=K, extrinsic_matrix=turned, width_px=7, height_px=5),
        dict(fov_deg=35, center=[1, 2, 3], eye=[4, -1, 0], up=[0.2, 1, 0.1], width_px=8, height_px=5),
    ]:
        expected = theirs.create_rays_pinhole(**camera).numpy()
        assert np.allclose(RaycastingScene.create_rays_pinhole(**camera), expected, rtol=1e-5, atol=1e-6)

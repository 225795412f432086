"""Scenes apart from their answers: arrays of any layout, files, new vertices."""

import doctest
import os

import numpy as np
import oracle
import pytest
from conftest import octasphere, same, some_rays

import stackless_bvh
from stackless_bvh import Scene


def test_no_ray_leaks_out_of_a_closed_sphere(dtype):
    vertices, faces = octasphere(4, dtype)
    scene = Scene(vertices, faces)
    a, b = vertices[faces[:, 0]], vertices[faces[:, 1]]
    aims = np.concatenate([vertices, (a + b) / dtype(2)])
    center = np.zeros(3, dtype)
    assert scene.closest(center, aims).hit.all() and scene.any(center, aims).all()
    assert (scene.count_crossings(center, aims) == 1).all()
    everything = scene.all_hits(center, vertices)
    assert (np.diff(everything.offsets) >= 4).all() and (everything.place == 2).all()
    assert (everything.rays == np.repeat(np.arange(len(vertices)), np.diff(everything.offsets))).all()
    outside = np.array([3, 0.1, -0.2], dtype)
    assert (scene.count_crossings(outside, aims - outside) % 2 == 0).all()


def test_arrays_of_any_layout_get_the_same_answers(dtype):
    vertices, faces = octasphere(3, dtype)
    origins, directions = some_rays(dtype)
    expected = Scene(vertices, faces).closest(origins, directions)
    assert expected.hit.any() and not expected.hit.all()

    def strided(array):
        wide = np.zeros((2 * len(array), 7), array.dtype)
        wide[::2, 1:6:2] = array
        return wide[::2, 1:6:2]

    def packed(array):
        records = np.zeros(len(array), dtype=[("tag", np.uint8), ("row", array.dtype, 3)])
        records["row"] = array
        assert not records["row"].flags.aligned
        return records["row"]

    def frozen(array):
        array = array.copy()
        array.flags.writeable = False
        return array

    for layout in (
        strided,
        packed,
        frozen,
        np.asfortranarray,
        lambda array: array[::-1].copy()[::-1],
        np.ndarray.tolist,
    ):
        scene = Scene(layout(vertices) if layout is not np.ndarray.tolist else vertices, layout(faces))
        assert same(scene.closest(layout(origins), layout(directions)), expected)
    for index in (np.int8, np.int16, np.int32, np.uint32, np.uint64):
        assert same(
            Scene(vertices, faces.astype(np.uint16 if index == np.int8 else index)).closest(origins, directions),
            expected,
        )


def test_float32_rays_are_taken_exactly_by_float64_scenes():
    vertices, faces = octasphere(3)
    scene, (origins, directions) = Scene(vertices, faces), some_rays(np.float32)
    expected = scene.closest(origins.astype(np.float64), directions.astype(np.float64))
    assert same(scene.closest(origins, directions), expected) and expected.t.dtype == np.float64


def test_one_origin_serves_all_directions_and_ends_may_differ(dtype):
    scene = Scene(*octasphere(2, dtype))
    _, directions = some_rays(dtype, 9)
    hits = scene.closest([0, 0, 0], directions)
    assert len(hits) == 9 and hits.hit.all()
    ends = hits.t.copy()
    ends[::2] = np.nextafter(ends[::2], dtype(0))
    exact = scene.closest([0, 0, 0], directions, 0, ends)
    for i, direction in enumerate(directions):
        truth = oracle.all_hits(scene.vertices, scene.faces, np.zeros(3), direction, 0, ends[i], dtype)
        assert exact.hit[i] == bool(truth)
    assert not exact.hit[::2].any()


def test_no_rays_are_no_answers(dtype):
    scene, none = Scene(*octasphere(1, dtype)), np.zeros((0, 3), dtype)
    assert scene.closest(none, none).uv.shape == (0, 2)
    assert scene.any(none, none).shape == scene.contains(none).shape == (0,)
    assert scene.all_hits(none, none).offsets.tolist() == [0]


def test_a_mesh_is_closed_by_its_coordinates_whatever_its_indices():
    vertices, faces = octasphere(1)
    soup = Scene(vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
    assert soup.is_closed and soup.is_oriented
    # Zeros of either sign are equal.
    every_other = np.arange(len(soup.vertices))[:, np.newaxis] % 2 == 0
    assert Scene(np.where((soup.vertices == 0) & every_other, -0.0, soup.vertices), soup.faces).is_closed
    turned = faces.copy()
    turned[5] = turned[5][::-1]
    turned = Scene(vertices, turned)
    assert turned.is_closed and not turned.is_oriented
    random = np.random.default_rng(3).uniform(-1, 1, (500, 3))
    assert np.array_equal(turned.contains(random), soup.contains(random))
    # By the even-odd rule, a duplicate face is a hole, and a triplicate face is not.
    for copies, wrong in [
        (2, r"\(0, 6\) of faces\[0\] is in 3 faces, expected an even number \(3 such edges\)"),
        (3, None),
    ]:
        repeated = Scene(vertices, np.concatenate([faces, *[faces[:1]] * (copies - 1)]))
        assert repeated.is_closed == (wrong is None)
        if wrong:
            with pytest.raises(ValueError, match=wrong):
                repeated.contains([0, 0, 0])
        else:
            with pytest.warns(UserWarning, match="2 of the faces repeat"):
                assert np.array_equal(repeated.contains(random), soup.contains(random))
    # The inner one of two spheres is a hole.
    hollow = Scene(np.concatenate([vertices, vertices / 2]), np.concatenate([faces, faces + len(vertices)]))
    assert hollow.contains([[0, 0, 0], [0, 0, 0.75], [0, 0, 1], [0, 0, 0.5], [0, 0, 2]]).tolist() == [
        False,
        True,
        True,
        True,
        False,
    ]


def test_points_on_the_surface_are_told_from_others(dtype):
    vertices, faces = octasphere(3, dtype)
    scene = Scene(vertices, faces)
    assert scene.contains(vertices).all() and not scene.contains(vertices, boundary=False).any()
    outward = vertices + np.sign(vertices) * np.spacing(np.abs(vertices))
    inward = vertices - np.sign(vertices) * np.spacing(np.abs(vertices))
    # One float beyond a corner is outside of a convex mesh; one float before a corner is not on the surface.
    assert not scene.contains(outward).any()
    assert np.array_equal(scene.contains(inward), scene.contains(inward, boundary=False))
    assert scene.contains(inward).any()


def test_each_side_of_a_box_is_on_it(cube, dtype):
    vertices, faces = cube
    box = Scene(vertices.astype(dtype), faces)
    # The grid has points on sides, on edges and at corners; all other points are inside.
    steps = np.array([0, 0.25, 0.5, 1], dtype)
    points = np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3)
    is_on = ((points == 0) | (points == 1)).any(axis=1)
    assert box.contains(points).all()
    assert np.array_equal(box.contains(points, boundary=False), ~is_on)


def test_what_is_saved_is_loaded(dtype, tmp_path):
    scene, (origins, directions) = Scene(*octasphere(3, dtype), build="sbvh"), some_rays(dtype)
    path = tmp_path / "sphere.scene"
    scene.save(path)
    loaded = Scene.load(str(path))
    assert loaded.dtype == scene.dtype and np.array_equal(loaded.vertices, scene.vertices)
    assert same(loaded.closest(origins, directions), scene.closest(origins, directions))
    assert np.array_equal(loaded.contains(origins), scene.contains(origins))
    data = path.read_bytes()
    assert os.listdir(tmp_path) == ["sphere.scene"]
    for at in [0, 9, 13, 20, 40, len(data) // 2, len(data) - 1]:
        path.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :])
        with pytest.raises(ValueError) as error:
            Scene.load(path)
        assert "\n" not in str(error.value)
    for length in [0, 7, 31, 40, len(data) - 1]:
        path.write_bytes(data[:length])
        with pytest.raises(ValueError):
            Scene.load(path)


def checksum(data):
    """Computes the checksum of spec/bvh-file.md, so that forged files have a correct one."""
    total, word = len(data), 2**64 - 1
    data += bytes(8 - len(data) % 8)
    for at in range(0, len(data), 8):
        total ^= int.from_bytes(data[at : at + 8], "little")
        total = ((total ^ total >> 30) * 0xBF58476D1CE4E5B9) & word
        total = ((total ^ total >> 27) * 0x94D049BB133111EB) & word
        total ^= total >> 31
    return total.to_bytes(8, "little")


def test_a_forged_file_is_refused(dtype, tmp_path):
    (vertices, faces), path = octasphere(1, dtype), tmp_path / "forged.scene"
    files = []
    for scale in (1, 2):
        Scene(dtype(scale) * vertices, faces).save(path)
        files.append(path.read_bytes())
    mesh = 32 + vertices.nbytes + 12 * len(faces)
    assert checksum(files[0][:-8]) == files[0][-8:]
    forged = [
        # The hierarchy of another mesh.
        (files[0][:mesh] + files[1][mesh:-8], None),
        # A face with a vertex that does not exist.
        (files[0][: mesh - 12] + b"\xff\xff\0\0" + files[0][mesh - 8 : -8], "index 65535 is out of range"),
        # More vertices than there are bytes.
        (files[0][:16] + b"\xff" * 8 + files[0][24:-8], "fewer than the header says"),
        (files[0][:8] + b"\2" + files[0][9:-8], "version 2 of the format, expected 1"),
        (files[0][:12] + b"\5" + files[0][13:-8], "coordinates of 5 bytes"),
    ]
    for data, message in forged:
        path.write_bytes(data + checksum(data))
        with pytest.raises(ValueError, match=message):
            Scene.load(path)


def test_refit_moves_the_vertices_or_changes_nothing(dtype):
    vertices, faces = octasphere(3, dtype)
    scene, (origins, directions) = Scene(vertices, faces), some_rays(dtype)
    before = scene.closest(origins, directions)
    moved = (vertices * dtype(1.25) + dtype(0.5)).astype(dtype)
    scene.refit(moved)
    assert np.array_equal(scene.vertices, moved)
    after = scene.closest(origins, directions)
    assert same(after, Scene(moved, faces).closest(origins, directions)) and not same(after, before)
    scene.refit(moved, optimize=True)
    assert same(scene.closest(origins, directions), after)
    for bad in (moved[1:], np.where(np.arange(len(moved))[:, None] == 3, dtype(np.nan), moved)):
        with pytest.raises(ValueError):
            scene.refit(bad)
        assert same(scene.closest(origins, directions), after)
    # A refit can open a closed mesh.
    scene = Scene(vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
    assert scene.is_closed
    torn = scene.vertices
    torn[0] += dtype(0.25)
    scene.refit(torn)
    assert not scene.is_closed
    # A refit can give a face an area, or take its area.
    flat = Scene(np.eye(3, dtype=dtype)[[0, 1, 2, 2]], [[0, 1, 2], [1, 2, 3]])
    raised = np.array([[0, 1, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], dtype=dtype)
    flat.refit(raised)
    assert flat.closest([0.25, 1, 2], [0, 0, -1]).primitive[0] == 1
    assert flat.nearest(raised[[0]] * 3, k=2).primitive.tolist() == [[0, 1]]


def test_faces_without_area_have_nearest_points(dtype):
    vertices = [[2.25, -8, 16.5], [-0.5, -8, 16.5], [-0.5, -8, 16.5], [99, 99, 99], [100, 99, 99], [99, 100, 99]]
    scene = Scene(np.array(vertices, dtype=dtype), [[0, 1, 2], [3, 4, 5], [1, 1, 2]])
    near = scene.nearest(np.array([[1, -8, 16.75]], dtype=dtype), k=3)
    assert near.primitive.tolist() == [[0, 2, 1]] and near.distance[0, 0] == 0.25
    assert near.point[0, 0].tolist() == [1, -8, 16.5] and near.point[0, 1].tolist() == vertices[1]
    assert not scene.any([1, -8, 17], [0, 0, -1])[0]


def test_a_scene_that_is_asked_is_not_changed(dtype):
    vertices, faces = octasphere(1, dtype)
    scene = Scene(vertices, faces)
    with pytest.raises(RuntimeError, match="Already borrowed"):
        scene.any([0, 0, 0], vertices, progress=lambda *_: scene.refit(2 * vertices))
    assert np.array_equal(scene.vertices, vertices)


def test_the_scene_says_what_it_is(dtype):
    scene = Scene(*octasphere(1, dtype))
    assert repr(scene) == f"<stackless_bvh.Scene: 32 faces, {np.dtype(dtype)}>"
    assert scene.dtype == dtype and scene.nbytes > 32 * 9 * np.dtype(dtype).itemsize


@pytest.mark.parametrize("module", ["", "_inside", "_instances", "_scene"])
def test_examples_of_docstrings(module, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = getattr(stackless_bvh, module, stackless_bvh)
    found = doctest.testmod(module, extraglobs={"Scene": Scene})
    assert found.failed == 0 and found.attempted > 5

"""Meshes from files."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from stackless_bvh import Scene

PART = Path(__file__).parents[2] / "examples/data/part.stl"
# A concave polygon, and a vertex that float32 cannot represent.
ARROW = "v 0 0 0\nv 4 0 0\nv 0.1 0.25 0\nv 0 4 0\n"


@pytest.fixture
def arrow(tmp_path):
    path = tmp_path / "arrow.obj"
    path.write_text(ARROW + "f 1 2 3 4\n")
    return path


def test_a_part_is_loaded_as_it_is():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scenes = [Scene.load_mesh(PART, dtype=dtype) for dtype in (np.float32, "float64")]
    assert [scene.dtype for scene in scenes] == [np.float32, np.float64]
    assert np.array_equal(*[scene.vertices for scene in scenes]) and np.array_equal(*[scene.faces for scene in scenes])
    assert len(scenes[0].faces) > 10 and all(scene.is_closed for scene in scenes)


def test_double_precision_is_the_default_and_polygons_keep_their_outline(arrow):
    steps = []
    scene = Scene.load_mesh(str(arrow), progress=lambda done, count: steps.append((done, count)))
    assert scene.dtype == np.float64 and scene.vertices[2, 0] == 0.1 and len(scene.faces) == 2
    # There is no face beyond the inner corner; a fan from the first corner would have one.
    hits = scene.closest([[1, 1, 1], [0.05, 0.05, 1], [2, 0.05, 1]], [0, 0, -1])
    assert hits.hit.tolist() == [False, True, True]
    assert not steps or steps[-1] == (2, 2)


def test_what_is_skipped_or_rounded_is_said(arrow):
    with pytest.warns(UserWarning, match="arrow.obj: .*rounded") as said:
        assert Scene.load_mesh(arrow, dtype=np.float32).dtype == np.float32
    assert said[0].filename == __file__
    arrow.write_text(ARROW + "f 1 2 3 4\nf 1 2\n")
    with pytest.warns(UserWarning, match="1 face with fewer than 3 corners was skipped"):
        assert len(Scene.load_mesh(arrow).faces) == 2


def test_what_is_no_mesh_is_refused(arrow, tmp_path):
    with pytest.raises(TypeError, match="dtype: int64, expected float32 or float64"):
        Scene.load_mesh(arrow, dtype=np.int64)
    with pytest.raises(ValueError, match="build: 'quick'"):
        Scene.load_mesh(arrow, build="quick")
    arrow.write_text(ARROW + "f 1 2 9\n")
    with pytest.raises(ValueError, match="arrow.obj: line 5: .*9"):
        Scene.load_mesh(arrow)
    with pytest.raises(FileNotFoundError):
        Scene.load_mesh(tmp_path / "none.obj")
    with pytest.raises(ValueError, match="part.step"):
        Scene.load_mesh(tmp_path / "part.step")

"""Files of scenes: overwriting, links, errors of the system, progress and Ctrl-C."""

import os
import signal
import stat
import time

import numpy as np
import pytest
from conftest import octasphere, same, some_rays

from stackless_bvh import Scene

SCENE = Scene(*octasphere(1))


@pytest.fixture(scope="module")
def large():
    """Returns a scene that takes some tenths of a second to save."""
    return Scene(np.random.default_rng(1).random((900_000, 3)), np.arange(900_000).reshape(-1, 3), "median")


@pytest.mark.skipif(os.name == "nt", reason="no permissions")
def test_a_file_has_the_permissions_that_others_have(tmp_path):
    path, other = tmp_path / "scene", tmp_path / "other"
    other.write_bytes(b"")
    SCENE.save(path)
    mode = lambda path: stat.S_IMODE(path.stat().st_mode)
    assert mode(path) == mode(other)
    path.chmod(0o640)
    SCENE.save(path)
    assert mode(path) == 0o640
    path.chmod(0o444)
    with pytest.raises(PermissionError) as error:
        Scene(*octasphere(2)).save(path)
    assert error.value.filename == str(path)
    assert len(Scene.load(path).faces) == 32 and sorted(os.listdir(tmp_path)) == ["other", "scene"]


@pytest.mark.skipif(os.name == "nt", reason="links need rights")
def test_links_are_followed(tmp_path):
    (tmp_path / "there").mkdir()
    link = tmp_path / "link"
    link.symlink_to("there/scene")
    for path in (link, bytes(link), str(link)):
        SCENE.save(path)
        assert link.is_symlink() and os.listdir(tmp_path / "there") == ["scene"]
        assert len(Scene.load(path).faces) == 32


def test_errors_of_the_system_name_the_path(tmp_path):
    path = tmp_path / "none" / "scene"
    for do, kind, wrong in [
        (SCENE.save, FileNotFoundError, path),
        (Scene.load, FileNotFoundError, path),
        (SCENE.save, IsADirectoryError, tmp_path),
        (Scene.load, IsADirectoryError, tmp_path),
    ]:
        with pytest.raises(kind) as error:
            do(wrong)
        assert error.value.filename == str(wrong) and error.value.errno and "os error" not in str(error.value)


def test_progress_of_files_and_its_errors(large, tmp_path):
    path, told = tmp_path / "scene", []
    large.save(path, progress=lambda *done: told.append(done))
    data = path.read_bytes()
    assert told == sorted(told) and all(0 <= done <= count == 100 for done, count in told) and told
    told.clear()
    assert np.array_equal(Scene.load(path, progress=lambda *done: told.append(done)).vertices, large.vertices)
    assert told == sorted(told) and all(0 <= done <= count == 100 for done, count in told) and told

    def stop(done, count):
        raise LookupError(done)

    SCENE.save(path)
    before = path.read_bytes()
    with pytest.raises(LookupError):
        large.save(path, progress=stop)
    wait_for(lambda: os.listdir(tmp_path) == ["scene"])
    assert path.read_bytes() == before
    path.write_bytes(data)
    with pytest.raises(LookupError):
        Scene.load(path, progress=stop)


@pytest.mark.skipif(os.name == "nt", reason="no signals")
def test_ctrl_c_ends_the_work_on_files(large, tmp_path):
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        path = tmp_path / "scene"
        interrupt = lambda *_: signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            large.save(path, progress=interrupt)
        wait_for(lambda: os.listdir(tmp_path) == [])
        large.save(path)
        with pytest.raises(KeyboardInterrupt):
            Scene.load(path, progress=interrupt)
        with pytest.raises(KeyboardInterrupt):
            large.refit(large.vertices, progress=interrupt)
    finally:
        signal.signal(signal.SIGINT, handler)


def test_refit_tells_its_steps_and_ends_between_them(dtype):
    vertices, faces = octasphere(2, dtype)
    scene, told, rays = Scene(vertices, faces), [], some_rays(dtype)
    scene.refit(2 * vertices, progress=lambda *done: told.append(done))
    scene.refit(2 * vertices, optimize=True, progress=lambda *done: told.append(done))
    assert told == [(1, 2), (2, 2), (1, 3), (2, 3), (3, 3)]
    old, new = scene.closest(*rays), Scene(vertices, faces).closest(*rays)

    def stop_at(step):
        def stop(done, count):
            if done == step:
                raise LookupError(done)

        return stop

    for step, expected in [(1, old), (2, new)]:
        with pytest.raises(LookupError):
            scene.refit(vertices, optimize=True, progress=stop_at(step))
        assert same(scene.closest(*rays), expected)


def test_an_array_that_is_resized_meanwhile_is_refused(dtype):
    scene, count = Scene(*octasphere(1, dtype)), 200_000
    asks = [
        ("points", lambda array, resize: scene.contains(array, progress=resize)),
        ("points", lambda array, resize: scene.nearest(array, progress=resize)),
        ("origins", lambda array, resize: scene.closest(array, [0, 0, 1], progress=resize)),
        ("directions", lambda array, resize: scene.all_hits([0, 0, 0], array[::-1], progress=resize)),
    ]
    for name, ask in asks:
        for rows in (1, 10 * count):
            array = np.ones((count, 3), dtype)
            resize = lambda *_: array.resize((rows, 3), refcheck=False)
            with pytest.raises(RuntimeError, match=f"{name}: resized while it was read"):
                ask(array, resize)
    # A program may change the numbers meanwhile.
    points = np.zeros((count, 3), dtype)
    inside = scene.contains(points, progress=lambda *_: points.__setitem__(slice(None), 9))
    assert inside[:65536].all() and not inside[65536:].any()


def wait_for(condition):
    """Waits: a cancelled thread ends at its next check."""
    for _ in range(100):
        if condition():
            return
        time.sleep(0.1)
    raise AssertionError("it did not come")

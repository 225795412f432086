"""Scenes in other processes: forked and spawned ones, copies and pickles, workers of Dask."""

import contextlib
import copy
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import octasphere, same, some_rays

from stackless_bvh import Instances, Scene

BEGIN = """
import os, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from conftest import octasphere, same
from stackless_bvh import Instances, Scene
vertices, faces = octasphere(3)
directions = np.random.default_rng(1).normal(size=(int(sys.argv[2]), 3))
"""

FORKED = (
    BEGIN
    + """
scene = Scene(vertices, faces)
rays = np.zeros(3), directions
hits, everything = scene.closest(*rays), scene.all_hits(*rays)
near = scene.nearest(directions, k=2)
if os.fork() == 0:
    assert same(scene.closest(*rays), hits) and same(scene.all_hits(*rays), everything)
    assert scene.contains(directions / 100).all() and scene.any(*rays).all() and scene.is_closed
    scene.refit(2 * vertices, optimize=True)
    assert same(scene.closest(*rays), Scene(2 * vertices, faces).closest(*rays))
    scene.refit(vertices)
    assert same(scene.nearest(directions, k=2), near)
    # A child of the child.
    if os.fork() == 0:
        assert scene.any(*rays).all()
        os._exit(0)
    os._exit(os.waitstatus_to_exitcode(os.wait()[1]))
child = os.waitstatus_to_exitcode(os.wait()[1])
assert same(scene.closest(*rays), hits)
print(child)
"""
)

forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")


def ran(*command, threads="2"):
    """Runs a program and returns its output and status. Ends its child processes too, even if it hangs."""
    environment = {**os.environ, "RAYON_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": "1"}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    program = subprocess.Popen(
        [sys.executable, *map(str, command)], env=environment, start_new_session=os.name != "nt", **pipes
    )
    try:
        output, errors = program.communicate(timeout=100)
    finally:
        if os.name != "nt":
            with contextlib.suppress(ProcessLookupError):
                os.killpg(program.pid, signal.SIGKILL)
        program.kill()
    assert program.returncode == 0, errors
    return output


HERE = os.path.dirname(__file__)


@forks
@pytest.mark.parametrize("threads", ["1", "4"])
@pytest.mark.parametrize("count", [1, 200, 257, 20_000])
def test_a_forked_child_has_threads_of_its_own(threads, count):
    assert ran("-c", FORKED, HERE, count, threads=threads) == "0\n"


BUSY = (
    BEGIN
    + """
import threading
scene, done = Scene(vertices, faces), threading.Event()

def ask():
    while not done.is_set():
        scene.closest(np.zeros(3), directions)
        Scene(vertices, faces).is_closed

others = [threading.Thread(target=ask) for _ in range(3)]
for other in others:
    other.start()
found = []
for _ in range(20):
    if os.fork() == 0:
            os._exit(0 if scene.closest(np.zeros(3), directions).hit.all() and scene.is_closed else 1)
    found.append(os.waitstatus_to_exitcode(os.wait()[1]))
done.set()
print(set(found))
"""
)


@forks
def test_a_fork_while_other_threads_ask():
    assert ran("-c", BUSY, HERE, 10_000) == "{0}\n"


WITHIN = (
    BEGIN
    + """
parent, children = os.getpid(), []

def fork(done, count):
    if os.getpid() == parent and len(children) < 2:
        children.append(os.fork())

rows = np.tile(directions, (2, 1))
hits = Scene(vertices, faces).closest(np.zeros(3), rows, progress=fork)
assert hits.hit.all()
if os.getpid() != parent:
    os._exit(0)
print([os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children])
children.clear()
soup = np.random.default_rng(1).random((900_000, 3))
try:
    Scene(soup, np.arange(900_000).reshape(-1, 3), "standard", fork)
except RuntimeError as error:
    assert os.getpid() != parent
    os._exit(5 if str(error) == "only the process that began this can end it" else 6)
print({os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children})
"""
)


@forks
def test_a_fork_by_progress():
    assert ran("-c", WITHIN, HERE, 100_000) == "[0, 0]\n{5}\n"


THREADS = (
    BEGIN
    + """
count = lambda: len(os.listdir("/proc/self/task"))
before = count()
scene = Scene(vertices, faces)
for rays in (directions[:1], directions[:200], directions):
    scene.closest(np.zeros(3), rays), scene.all_hits(np.zeros(3), rays), scene.nearest(rays, k=2), scene.contains(rays)
placed = Instances([Scene(vertices.astype("f4"), faces)], [0], np.eye(4, dtype="f4")[None])
for rays in (directions[:200].astype("f4"), directions.astype("f4")):
    placed.closest([0, 0, 0], rays), placed.any([0, 0, 0], rays)
assert scene.is_closed
print(count() - before)
"""
)


@pytest.mark.skipif(not os.path.exists("/proc/self/task"), reason="this system does not list threads")
def test_there_is_one_pool_of_threads():
    assert ran("-c", THREADS, HERE, 100_000, threads="3") == "3\n"


WORKERS = """
import functools, multiprocessing, sys
import numpy as np
sys.path.insert(0, sys.argv[1])

def ask(scene, points):
    return scene.contains(points), scene.closest(points, points).t

if __name__ == "__main__":
    from conftest import octasphere
    from stackless_bvh import Scene
    scene = Scene(*octasphere(3))
    points = np.random.default_rng(1).uniform(-1, 1, (4000, 3))
    expected = ask(scene, points)
    with multiprocessing.get_context(sys.argv[2]).Pool(2) as pool:
        pieces = pool.map(functools.partial(ask, scene), np.array_split(points, 4))
    print(all(np.array_equal(a, np.concatenate(b)) for a, b in zip(expected, zip(*pieces))))
"""


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
def test_workers_of_multiprocessing(method, tmp_path):
    script = tmp_path / "workers.py"
    script.write_text(WORKERS)
    assert ran(script, HERE, method) == "True\n"


@pytest.mark.parametrize(
    "again",
    [copy.copy, copy.deepcopy, *(lambda scene, p=p: pickle.loads(pickle.dumps(scene, p)) for p in range(6))],
)
def test_copies_and_pickles_are_scenes_of_their_own(again, dtype):
    vertices, faces = octasphere(3, dtype)
    rays = some_rays(dtype)
    scene = Scene(vertices, faces)
    before, made = scene.closest(*rays), again(scene)
    assert type(made) is Scene and made.dtype == dtype and np.array_equal(made.faces, faces)
    assert same(made.closest(*rays), before) and made.is_closed
    made.refit(2 * vertices)
    after = made.closest(*rays)
    assert same(scene.closest(*rays), before) and not same(after, before)
    scene.refit(vertices / 2, optimize=True)
    assert same(made.closest(*rays), after)
    assert np.array_equal(made.vertices, 2 * vertices) and np.array_equal(scene.vertices, vertices / 2)


def test_a_pickle_can_leave_the_bytes_where_they_are():
    scene, buffers = Scene(*octasphere(2)), []
    small = pickle.dumps(scene, 5, buffer_callback=buffers.append)
    assert len(small) < 1000 and sum(len(buffer.raw()) for buffer in buffers) > scene.nbytes / 2
    assert np.array_equal(pickle.loads(small, buffers=buffers).vertices, scene.vertices)


def test_a_changed_pickle_is_refused():
    state = Scene(*octasphere(1)).__getstate__()
    state[0][100] ^= 1
    with pytest.raises(ValueError, match="checksum"):
        Scene.__new__(Scene).__setstate__(state)


def test_instances_are_copied_as_what_never_changes():
    scene = Scene(*octasphere(1, np.float32))
    placed = Instances([scene], [0], np.eye(4, dtype=np.float32)[None])
    for again in (copy.copy(placed), copy.deepcopy(placed)):
        assert again.any([0, 0, 0], [0, 0, 1]).all()


def test_workers_of_dask():
    pytest.importorskip("distributed", reason="dask is not installed: scenes are NOT tested with its workers")
    example = Path(__file__).parents[1] / "examples/dask_points.py"
    assert "each of 2 workers has one scene" in ran(example, "--points", 200_000)

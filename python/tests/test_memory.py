"""Insufficient memory: an exception, never the end of the interpreter."""

import os
import platform
import subprocess
import sys

import numpy as np
import pytest
from conftest import octasphere

from stackless_bvh import Scene

resource = pytest.importorskip("resource", reason="this system does not limit memory")

# The call runs with more and more memory, until this is enough. Until then each run must fail with MemoryError.
LIMITED = """
import ctypes, gc, resource, sys, tempfile
import numpy as np
sys.path.insert(0, sys.argv[1])
from conftest import octasphere
from stackless_bvh import Scene

def used():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[0]) * resource.getpagesize()

dtype = sys.argv[2]
vertices, faces = octasphere(6, dtype)
soup = np.random.default_rng(1).random((180_000, 3)).astype(dtype)
soup_faces = np.arange(180_000).reshape(-1, 3)
# Each ray hits many faces.
plates = np.tile(np.array([[-9, -9, 0], [9, -9, 0], [0, 9, 0]], dtype), (2000, 1))
plates[:, 2] = np.repeat(np.arange(2000), 3)
stack = Scene(plates, np.arange(6000).reshape(-1, 3))
scene, points = Scene(vertices, faces), np.full((200_000, 3), 0.1, dtype)
up = np.broadcast_to(np.array([0, 0, 1], dtype), points.shape)
path = tempfile.mkdtemp() + "/scene"
scene.save(path)
state = scene.__getstate__()

def loose():
    # A scene whose edges are not computed yet.
    made = Scene(soup, soup_faces)
    return lambda: made.is_closed

def shared():
    made = scene.__copy__()
    return lambda: made.refit(vertices, optimize=True)

ASK = {
    "standard": lambda: lambda: Scene(vertices, faces),
    "sbvh": lambda: lambda: Scene(soup, soup_faces, "sbvh"),
    "closest": lambda: lambda: scene.closest(points, up),
    "all_hits": lambda: lambda: stack.all_hits(points[:1000], up[:1000]),
    "nearest": lambda: lambda: scene.nearest(points[:100], k=2000),
    "is_closed": loose,
    "refit": shared,
    "vertices": lambda: lambda: (scene.vertices, scene.faces),
    "pickle": lambda: lambda: scene.__getstate__(),
    "unpickle": lambda: lambda: scene.__setstate__(state),
    "save": lambda: lambda: scene.save(path),
    "load": lambda: lambda: Scene.load(path),
}
ask, found = ASK[sys.argv[3]](), set()
for spare in (int(2**18 * 1.4**i) for i in range(30)):
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    resource.setrlimit(resource.RLIMIT_AS, (used() + spare, resource.RLIM_INFINITY))
    try:
        ask()
        found.add("enough")
        break
    except MemoryError:
        found.add("MemoryError")
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
print(sorted(found))
"""

QUERIES = ["standard", "sbvh", "closest", "all_hits", "nearest", "is_closed", "refit", "vertices"]
QUERIES += ["pickle", "unpickle", "save", "load"]


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="this system does not tell its memory")
@pytest.mark.parametrize("query", QUERIES)
@pytest.mark.parametrize("dtype", ["float32", "float64"])
def test_the_lack_of_memory_is_an_exception(query, dtype):
    command = [sys.executable, "-c", LIMITED, os.path.dirname(__file__), dtype, query]
    # The allocator returns freed memory to the system, and all threads share one arena.
    environment = {**os.environ, "MALLOC_ARENA_MAX": "1", "MALLOC_TRIM_THRESHOLD_": "65536"}
    child = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert (child.stdout, child.returncode) == ("['MemoryError', 'enough']\n", 0), child.stderr


HUGE = """
import resource, sys
sys.path.insert(0, sys.argv[1])
from conftest import CUBE, CUBE_FACES
from stackless_bvh import Scene
scene = Scene(CUBE, CUBE_FACES)
resource.setrlimit(resource.RLIMIT_AS, (2**32, 2**32))
for k in (10**9, 2**62, 2**63, 10**30):
    try:
        scene.nearest([[2.0, 2, 2]], k=k)
    except MemoryError as error:
        print(error)
"""


def test_more_neighbours_than_there_can_be():
    child = subprocess.run([sys.executable, "-c", HUGE, os.path.dirname(__file__)], capture_output=True, text=True)
    assert child.returncode == 0, child.stderr
    messages = child.stdout.splitlines()
    assert len(messages) == 4 and messages[0] == f"no memory for {8 * 10**9} bytes"


def test_more_neighbours_than_faces(dtype):
    scene = Scene(*octasphere(0, dtype))
    near = scene.nearest(np.array([[2, 1, 1], [0, 0, 3]], dtype), k=11)
    assert near.distance.shape == (2, 11) and near.point.shape == (2, 11, 3)
    assert np.isfinite(near.distance[:, :8]).all() and np.isinf(near.distance[:, 8:]).all()
    assert (np.sort(near.primitive[:, :8]) == np.arange(8)).all() and (near.primitive[:, 8:] == -1).all()
    assert np.isnan(near.point[:, 8:]).all()


def test_no_memory_is_an_exception():
    scene = Scene(*octasphere(1))
    with pytest.raises(MemoryError, match=f"no memory for {8 * 2**54} bytes"):
        scene.closest([0, 0, 0], np.broadcast_to(np.float64([0.1, 0.2, 0.3]), (2**54, 3)))

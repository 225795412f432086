"""Finds the points inside a mesh on the workers of Dask. Each worker receives the scene once.

    pip install dask distributed
    python examples/dask_points.py [--points N]

`Client("tcp://...")` instead of the two local workers uses a cluster.
"""

import argparse
import os

import dask.array as da
import numpy as np
from dask.distributed import Client

from stackless_bvh import Scene

VERTICES = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)
FACES = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])


def contains(points, scene):
    return scene.contains(points)


def which(points, scene):
    """Returns the process that answers a block of points, and its scene."""
    return np.array([[os.getpid(), id(scene)]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=1_000_000)
    count = parser.parse_args().points
    scene = Scene(VERTICES, FACES)
    # One Python thread per worker; a query uses all threads of RAYON_NUM_THREADS.
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        points = da.random.default_rng(1).uniform(-1, 1, (count, 3), chunks=(count // 20, 3))
        sent = client.scatter(scene, broadcast=True)
        inside = points.map_blocks(contains, scene=sent, drop_axis=1, dtype=bool)
        # An octahedron is a sixth of the cube around it.
        print(f"{100 * inside.mean().compute():.1f} % of {count} points are inside")
        assert np.array_equal(inside[: count // 20].compute(), scene.contains(points[: count // 20].compute()))
        scenes = points.map_blocks(which, scene=sent, chunks=(1, 2), dtype=np.int64).compute()
    workers, held = len(np.unique(scenes[:, 0])), len(np.unique(scenes, axis=0))
    assert workers == held, "a worker received the scene more than once"
    print(f"each of {workers} workers has one scene")


if __name__ == "__main__":
    main()

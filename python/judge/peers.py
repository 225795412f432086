"""Equal queries to Open3D, trimesh and libigl, if they are installed and support them."""

from __future__ import annotations

import sys
from importlib.util import find_spec

import numpy as np
import trimesh

# Number of points for trimesh, whose distances and own rays are slow.
FEW = 2_000


class Open3D:
    """RaycastingScene, in single precision."""

    def __init__(self, vertices, faces):
        import open3d

        self.tensor = lambda array: open3d.core.Tensor(np.ascontiguousarray(array, np.float32))
        self.scene = open3d.t.geometry.RaycastingScene()
        faces = open3d.core.Tensor(np.ascontiguousarray(faces, np.uint32))
        self.scene.add_triangles(self.tensor(vertices), faces)

    def inside(self, points):
        return self.scene.compute_occupancy(self.tensor(points)).numpy() > 0.5

    def signed(self, points):
        return self.scene.compute_signed_distance(self.tensor(points)).numpy()


class Trimesh:
    """`contains` by the installed engine, and `proximity.signed_distance` with reversed sign."""

    def __init__(self, vertices, faces):
        self.mesh = trimesh.Trimesh(vertices.astype(np.float64), faces, process=False)

    def inside(self, points):
        return self.mesh.contains(points)

    def signed(self, points):
        return -trimesh.proximity.signed_distance(self.mesh, points)


class Libigl:
    """The fast winding number, and `signed_distance` with its sign."""

    def __init__(self, vertices, faces):
        import igl

        self.igl, self.mesh = igl, (vertices.astype(np.float64), faces.astype(np.int64))

    def inside(self, points):
        return self.igl.fast_winding_number(*self.mesh, points.astype(np.float64)) > 0.5

    def signed(self, points):
        kind = self.igl.SignedDistanceType.SIGNED_DISTANCE_TYPE_FAST_WINDING_NUMBER
        return self.igl.signed_distance(points.astype(np.float64), *self.mesh, sign_type=kind)[0]


MODULES = {"Open3D": ("open3d", Open3D), "trimesh": ("trimesh", Trimesh), "libigl": ("igl", Libigl)}
PEERS = {name: make for name, (module, make) in MODULES.items() if find_spec(module)}


def judge(kind, vertices, faces, points, truth):
    """Returns a row: the numbers of wrong insides, signs and distances of each library, for points off the mesh."""
    cells = []
    for name, make in PEERS.items():
        rows = np.arange(FEW if make is Trimesh else len(points))
        rule = "winding" if make is Libigl else "parity"
        inside, judged = truth.inside("winding" if truth.angles is not None else rule)
        judged = (judged & ~truth.on_mesh)[rows]
        inside = inside[rows]
        try:
            asked = make(vertices, faces)
            found, signed = asked.inside(points[rows]), asked.signed(points[rows])
        except Exception as error:  # An exception of any type.
            print(f"{name}, {kind}: {error}", file=sys.stderr)
            cells += ["fails"] * 3
            continue
        right = truth.distance()[rows]
        far = np.abs(np.abs(signed) - right) > 1e-6 * np.maximum(right, np.ptp(vertices, axis=0).max())
        wrong = [
            (found != inside) & judged,
            ((signed < 0) != inside) & judged & (signed != 0),
            ~(np.abs(signed) < np.inf) | far,
        ]
        cells += [
            f"{100 * count.sum() / max(1, some):.3g} %" if count.any() else "0"
            for count, some in zip(wrong, (judged.sum(), judged.sum(), len(rows)))
        ]
    return [f"| {kind}, {points.dtype} | " + " | ".join(cells) + " |"]


def table(rows):
    """Prints the results of `judge`."""
    print("\nWrong insides, wrong signs of distances, and distances off by a millionth of the mesh, per cent\n")
    print("| mesh |" + "".join(f" {name}: insides | signs | distances |" for name in PEERS))
    print("|---|" + "---:|" * 3 * len(PEERS))
    print("\n".join(rows))

"""Compares `RaycastingScene` of Open3D with that of this package.

    python examples/open3d_rays.py

Rays go from the middle of a sphere to its vertices and the middles of its edges. It needs open3d and trimesh.
"""

from __future__ import annotations

import numpy as np
import open3d
import trimesh

from stackless_bvh.open3d import RaycastingScene


def main():
    mesh = trimesh.creation.icosphere(5)
    vertices, faces = mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)
    ends = np.sort(mesh.edges_unique, axis=1)
    aims = np.concatenate([vertices, (vertices[ends[:, 0]] + vertices[ends[:, 1]]) / np.float32(2)])
    rays = np.concatenate([np.zeros_like(aims), aims], axis=1)

    theirs = open3d.t.geometry.RaycastingScene()
    theirs.add_triangles(open3d.core.Tensor(vertices), open3d.core.Tensor(faces))
    expected = {key: array.numpy() for key, array in theirs.cast_rays(open3d.core.Tensor(rays)).items()}
    ours = RaycastingScene()
    ours.add_triangles(vertices, faces)
    found = ours.cast_rays(rays)
    print(f"{len(rays)} rays out of a closed sphere")
    print(f"lost: {np.isinf(found['t_hit']).sum()} here, {np.isinf(expected['t_hit']).sum()} by Open3D")
    both = np.isfinite(expected["t_hit"])
    print(f"t differs in {(found['t_hit'] != expected['t_hit'])[both].sum()} of {both.sum()},", end=" ")
    print(f"by at most {np.abs(found['t_hit'] - expected['t_hit'])[both].max():.2g}")


if __name__ == "__main__":
    main()

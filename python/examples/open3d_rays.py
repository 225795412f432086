"""`cast_rays` of Open3D's RaycastingScene by exact answers, and where both differ.

    python examples/open3d_rays.py

Rays go from the middle of a sphere to its vertices and the middles of its edges. It needs open3d and trimesh.
"""

from __future__ import annotations

import numpy as np
import open3d
import trimesh

from stackless_bvh import Scene

INVALID = np.uint32(0xFFFFFFFF)


def cast_rays(scene: Scene, rays: np.ndarray) -> dict[str, np.ndarray]:
    """What `RaycastingScene.cast_rays` answers of one geometry, from rays of shape (..., 6)."""
    flat = rays.reshape(-1, 6)
    hits = scene.closest(flat[:, :3], flat[:, 3:])
    shape = rays.shape[:-1]
    return {
        "t_hit": hits.t.reshape(shape),
        "primitive_ids": np.where(hits.hit, hits.primitive, INVALID).astype(np.uint32).reshape(shape),
        "primitive_uvs": np.nan_to_num(hits.uv).reshape(*shape, 2),
        "geometry_ids": np.where(hits.hit, 0, INVALID).astype(np.uint32).reshape(shape),
    }


def main():
    mesh = trimesh.creation.icosphere(5)
    vertices, faces = mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)
    ends = np.sort(mesh.edges_unique, axis=1)
    aims = np.concatenate([vertices, (vertices[ends[:, 0]] + vertices[ends[:, 1]]) / np.float32(2)])
    rays = np.concatenate([np.zeros_like(aims), aims], axis=1)

    theirs = open3d.t.geometry.RaycastingScene()
    theirs.add_triangles(open3d.core.Tensor(vertices), open3d.core.Tensor(faces))
    expected = {key: array.numpy() for key, array in theirs.cast_rays(open3d.core.Tensor(rays)).items()}
    found = cast_rays(Scene(vertices, faces), rays)
    print(f"{len(rays)} rays out of a closed sphere")
    print(f"lost: {np.isinf(found['t_hit']).sum()} here, {np.isinf(expected['t_hit']).sum()} by Open3D")
    both = np.isfinite(expected["t_hit"])
    print(f"t differs in {(found['t_hit'] != expected['t_hit'])[both].sum()} of {both.sum()},", end=" ")
    print(f"by at most {np.abs(found['t_hit'] - expected['t_hit'])[both].max():.2g}")


if __name__ == "__main__":
    main()

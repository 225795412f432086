"""A script for Open3D with one changed import: an image of a box, its inside, and distances of points.

python examples/from_open3d.py
"""

import numpy as np

from stackless_bvh.open3d import RaycastingScene  # instead of: from open3d.t.geometry import RaycastingScene

corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float32)
sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
triangles = np.array([[a, b, c] for a, *rest in sides for b, c in zip(rest, rest[1:])], dtype=np.uint32)

scene = RaycastingScene()
scene.add_triangles(corners, triangles)

rays = RaycastingScene.create_rays_pinhole(
    fov_deg=30, center=[0.5, 0.5, 0.5], eye=[3, -2, 2], up=[0, 0, -1], width_px=60, height_px=30
)
side = scene.cast_rays(rays)["primitive_ids"].numpy() // 2
print("\n".join("".join(".#=+-:o"[s + 1] if s < 6 else "." for s in row) for row in side.astype(int)))

points = np.array([[0.5, 0.5, 0.25], [0.5, 0.5, 3]], dtype=np.float32)
print("inside:", scene.compute_occupancy(points).numpy())
print("distance:", scene.compute_signed_distance(points).numpy())

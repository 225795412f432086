"""Replaces both intersectors of trimesh by the one that INTERSECTOR names. The exact one brings proximity functions."""

import os
import sys
import types

import trimesh.proximity
import trimesh.ray.ray_triangle as native

if os.environ["INTERSECTOR"] == "exact":
    from stackless_bvh import proximity
    from stackless_bvh.trimesh import RayMeshIntersector

    embree = types.ModuleType("trimesh.ray.ray_pyembree")
    sys.modules["trimesh.ray.ray_pyembree"] = embree
    trimesh_ray = sys.modules["trimesh.ray"]
    trimesh_ray.ray_pyembree, trimesh_ray.has_embree = embree, True
    embree.RayMeshIntersector = native.RayMeshIntersector = RayMeshIntersector
    # Not `max_tangent_sphere`, because ours calls the one of trimesh.
    for name in ("ProximityQuery", "closest_point", "signed_distance", "longest_ray", "thickness"):
        setattr(trimesh.proximity, name, getattr(proximity, name))
elif os.environ["INTERSECTOR"] == "native":
    import trimesh.ray

    embree = types.ModuleType("trimesh.ray.ray_pyembree")
    sys.modules["trimesh.ray.ray_pyembree"] = embree
    trimesh.ray.ray_pyembree, trimesh.ray.has_embree = embree, False

    class RayMeshIntersector(native.RayMeshIntersector):
        def __init__(self, mesh, scale_to_box=True):
            super().__init__(mesh)

    embree.RayMeshIntersector = RayMeshIntersector

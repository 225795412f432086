"""Exact ray tracing on triangle meshes: every answer equals that of rational arithmetic.

>>> import numpy as np
>>> from stackless_bvh import Scene
>>> vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)
>>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> scene = Scene(vertices, faces)
>>> scene.closest([[0.25, 0.25, -1.0]], [[0.0, 0.0, 1.0]]).t
array([1.])
>>> scene.contains([[0.1, 0.1, 0.1], [1.0, 1.0, 1.0]])
array([ True, False])

The floats of the arrays are exact rational numbers. Intersections of rays and triangles, including edges and corners,
are decided exactly. A distance is the float nearest to the exact distance. So answers depend neither on the builder of
the scene nor on the number of threads.
"""

from ._exact import ExactRays, Hits
from ._instances import AllInstanceHits, InstanceHits, InstanceNear, Instances
from ._results import AllHits, Near
from ._scene import Scene

__all__ = [
    "AllHits",
    "AllInstanceHits",
    "ExactRays",
    "Hits",
    "InstanceHits",
    "InstanceNear",
    "Instances",
    "Near",
    "Scene",
]

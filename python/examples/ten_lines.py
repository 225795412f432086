"""A sphere that no ray leaks out of, also through its vertices: the ten lines of the README."""

import numpy as np

from stackless_bvh import Scene

vertices = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)
faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
scene = Scene(vertices, faces)
hits = scene.closest(np.zeros(3), vertices)
assert hits.hit.all() and (hits.t == 1).all()
assert (scene.count_crossings(np.zeros(3), vertices) == 1).all()
assert scene.contains([[0.1, 0.2, 0.3], [0.4, 0.4, 0.4]]).tolist() == [True, False]

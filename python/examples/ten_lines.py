"""Hits, inside and distance of an STL part: the ten lines of README. It needs trimesh for reading the file."""

from pathlib import Path

import numpy as np
import trimesh

from stackless_bvh import Scene

part = trimesh.load(Path(__file__).parents[2] / "examples/data/part.stl", process=False)
scene = Scene(part.vertices, part.faces)  # in double precision, as they are
hits = scene.closest([[2, 0, 9]], [[0, 0, -1]])
print(hits.t, hits.primitive, hits.uv)  # distances, faces, where in the face
print(scene.contains([[2, 0, 0.5], [0, 0, 0.5]]))  # in the plate, in its hole
print(scene.nearest(np.zeros((1, 3))).distance)

assert hits.t.tolist() == [8] and hits.hit.all()
assert scene.contains([[2, 0, 0.5], [0, 0, 0.5]]).tolist() == [True, False]
assert scene.nearest([[0, 0, 0.5]]).distance > 0.9

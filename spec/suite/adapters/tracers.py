#!/usr/bin/env python3
"""Ray tracers from PyPI as implementations of the level `ray`: tracers.py embreex | embreex-robust | open3d

`pip install embreex open3d`. What a library has no words for, as a beginning other than 0, it is not asked: that is
`unsupported`, and fails.
"""

import json
import struct
import sys

import numpy as np


def floats(texts, count):
    words = [int(word, 16) for text in texts for word in text.split()]
    return np.array(words, dtype=np.uint32).view(np.float32).reshape(-1, count)


def hit(prim, t):
    return {"prim": int(prim), "t": struct.pack(">f", t).hex()}


class Embreex:
    profiles = ["watertight", "ulp-8", "ulp-256", "grid", "exact"]

    def __init__(self, robust):
        self.robust = robust

    def answer(self, vertices, triangles, rays, query):
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        if np.any(rays[:, 6] != 0):
            raise NotImplementedError("rays begin at 0")
        scene = EmbreeScene(robust=self.robust)
        TriangleMesh(scene, vertices, triangles.astype(np.int32))
        origins, directions = (np.ascontiguousarray(part) for part in (rays[:, :3], rays[:, 3:6]))
        found = scene.run(origins, directions, dists=np.ascontiguousarray(rays[:, 7]), query="INTERSECT", output=True)
        hits = [None if prim < 0 else hit(prim, t) for prim, t in zip(found["primID"], found["tfar"])]
        return [it is not None for it in hits] if query == "any" else hits


class Open3D:
    profiles = ["watertight", "parity", "ulp-8", "ulp-256", "grid", "exact"]

    def answer(self, vertices, triangles, rays, query):
        import open3d

        scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        scene.add_triangles(open3d.core.Tensor(vertices), open3d.core.Tensor(triangles))
        tensor = open3d.core.Tensor(np.ascontiguousarray(rays[:, :6]))
        if query == "parity":
            return [bool(count % 2) for count in scene.count_intersections(tensor).numpy()]
        if query == "any":
            # The ends of the interval are the same for all rays of a call.
            calls = [
                (open3d.core.Tensor(np.ascontiguousarray(ray[None, :6])), float(ray[6]), float(ray[7])) for ray in rays
            ]
            return [bool(scene.test_occlusions(one, *ends).numpy()[0]) for one, *ends in calls]
        if np.any(rays[:, 6] != 0) or not np.all(np.isinf(rays[:, 7])):
            raise NotImplementedError("rays begin at 0 and have no end")
        found = scene.cast_rays(tensor)
        prims, distances = found["primitive_ids"].numpy(), found["t_hit"].numpy()
        return [hit(prim, t) if np.isfinite(t) else None for prim, t in zip(prims, distances)]


TRACERS = {"embreex": Embreex(False), "embreex-robust": Embreex(True), "open3d": Open3D()}


def main():
    name = sys.argv[1] if len(sys.argv) == 2 else ""
    if name not in TRACERS:
        sys.exit(__doc__)
    profiles = [f"ray/{profile}" for profile in TRACERS[name].profiles]
    for line in sys.stdin:
        request = json.loads(line)
        if request["cmd"] == "bye":
            break
        if request["cmd"] == "hello":
            reply = {"protocol": 1, "name": name, "version": "", "profiles": profiles, "features": []}
        else:
            fields, reply = request["input"], {"seq": request["seq"]}
            triangles = np.array(fields["triangles"], dtype=np.uint32).reshape(-1, 3)
            scene = floats(fields["vertices"], 3), triangles, floats(fields["rays"], 8)
            try:
                reply["result"] = {"hits": TRACERS[name].answer(*scene, fields["query"])}
            except Exception as error:  # what they raise is theirs
                reply["unsupported"] = f"{type(error).__name__}: {error}"
        print(json.dumps(reply), flush=True)


if __name__ == "__main__":
    main()

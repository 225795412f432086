"""Pictures of a mesh: depth by closest hits, and a slice that shows what is inside.

    python examples/pictures.py [MESH] [-o FOLDER]

It needs trimesh and Pillow. Without a mesh it draws a made one: a torus in a hollow sphere. `depth.png` is grey by
distance. `slice.png` is blue inside and white outside; red is where trimesh's own engine (embreex if it is installed)
says something else.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image

from stackless_bvh import Scene


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", nargs="?", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("."))
    parser.add_argument("--size", type=int, default=512)
    arguments = parser.parse_args()
    mesh = trimesh.load(arguments.mesh, process=False, force="mesh") if arguments.mesh else made()
    scene = Scene(mesh.vertices.view(np.ndarray), mesh.faces.view(np.ndarray))
    Image.fromarray(depth(scene, mesh.bounds, arguments.size)).save(arguments.output / "depth.png")
    if scene.is_closed:
        Image.fromarray(section(scene, mesh, arguments.size)).save(arguments.output / "slice.png")
    else:
        print("the mesh is not closed: there is no slice")


def made():
    outer, inner = trimesh.creation.icosphere(4, 1.0), trimesh.creation.icosphere(4, 0.9)
    return trimesh.util.concatenate([outer, inner, trimesh.creation.torus(0.55, 0.2)])


def depth(scene, bounds, size):
    """A perspective view along -z, from where all of the mesh is seen."""
    middle, extent = bounds.mean(axis=0), np.ptp(bounds, axis=0)
    away = np.array([0, 0, 1.5 * extent.max() + extent[2] / 2])
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, size), np.linspace(0.5, -0.5, size))
    ways = np.stack([x, y, np.full_like(x, -1.2)], axis=-1).reshape(-1, 3)
    hits = scene.closest(middle + away, ways)
    far, near = (hits.t[hits.hit].max(), hits.t[hits.hit].min()) if hits.hit.any() else (1, 0)
    grey = np.where(hits.hit, 255 - 200 * (hits.t - near) / max(far - near, 1e-9), 0)
    return grey.reshape(size, size).astype(np.uint8)


def section(scene, mesh, size):
    """The plane through the middle across z, on a grid that meets vertices and edges where it can."""
    lo, hi = mesh.bounds
    x, y = np.meshgrid(np.linspace(lo[0], hi[0], size), np.linspace(hi[1], lo[1], size))
    points = np.stack([x, y, np.full_like(x, (lo[2] + hi[2]) / 2)], axis=-1).reshape(-1, 3)
    inside, theirs = scene.contains(points), mesh.contains(points)
    # Of points on the surface trimesh promises nothing.
    wrong = (inside != theirs) & (inside == scene.contains(points, boundary=False))
    colours = np.where(inside[:, None], [70, 110, 190], [255, 255, 255])
    colours[wrong] = [220, 30, 30]
    print(f"{inside.sum()} of {len(inside)} points are inside; trimesh says something else of {wrong.sum()}")
    return colours.reshape(size, size, 3).astype(np.uint8)


if __name__ == "__main__":
    main()

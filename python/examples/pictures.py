"""Pictures of a mesh: depth by closest hits, and a section that shows what is inside, and where others are wrong.

    python examples/pictures.py [MESH] [-o FOLDER]

It needs trimesh and Pillow. Without a mesh it draws a made one with deep folds, like a brain's (`folds.py`, which needs
SciPy). `depth.png` is grey by distance. `section.png` shows which voxels of a plane are inside, as volumes are often
filled: a ray along z from each centre, and whether it crosses the mesh an odd number of times. It has a panel for each
of trimesh with embreex (`intersects_location`) and Open3D (`count_intersections`) that is installed. Blue is inside,
white outside, and red wrong. What is right `Scene.contains` tells, and rational arithmetic for a sample.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image, ImageDraw

from stackless_bvh import Scene

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1]), str(Path(__file__).parents[1] / "tests")]
import folds  # noqa: E402
import oracle  # noqa: E402

from bench import ENGINES, near_misses_and_hits  # noqa: E402

# Of trimesh's own engine a section would take hours.
OTHERS = {name: ENGINES[name] for name in ("trimesh embreex", "Open3D") if name in ENGINES}
INSIDE, OUTSIDE, WRONG = (120, 155, 215), (255, 255, 255), (225, 30, 30)
UP = np.float32([0, 0, 1])
# No component is 0, and no two are alike.
WAY = np.array([0.61, 0.37, 0.53])
# Answers that rational arithmetic judges, and as many of those that others get wrong.
JUDGED = 150


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", nargs="?", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("."))
    parser.add_argument("--size", type=int, default=512, help="pixels of the depth image")
    arguments = parser.parse_args()
    vertices, faces = loaded(arguments.mesh) if arguments.mesh else folds.folded_sphere()
    scene = Scene(vertices, faces)
    Image.fromarray(depth(scene, vertices, arguments.size)).save(arguments.output / "depth.png", optimize=True)
    if not scene.is_closed:
        sys.exit("the mesh is not closed: there is no section")
    panels = [panel(scene, vertices, faces, name, make) for name, make in OTHERS.items()]
    beside(panels).quantize(16).save(arguments.output / "section.png", optimize=True)


def loaded(path):
    mesh = trimesh.load(path, process=False, force="mesh")
    return mesh.vertices.view(np.ndarray).astype(np.float64), mesh.faces.view(np.ndarray)


def depth(scene, vertices, size):
    """A perspective view along -z, from where all of the mesh is seen."""
    lo, hi = vertices.min(axis=0), vertices.max(axis=0)
    away = np.array([0, 0, 1.5 * (hi - lo).max() + (hi - lo)[2] / 2])
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, size), np.linspace(0.5, -0.5, size))
    ways = np.stack([x, y, np.full_like(x, -1.2)], axis=-1).reshape(-1, 3)
    hits = scene.closest((lo + hi) / 2 + away, ways)
    far, near = (hits.t[hits.hit].max(), hits.t[hits.hit].min()) if hits.hit.any() else (1, 0)
    grey = np.where(hits.hit, 255 - 225 * (hits.t - near) / max(far - near, 1e-9), 0)
    return grey.reshape(size, size).astype(np.uint8)


def grid(vertices, steps=256):
    """Points of the plane across z near the middle of the mesh. They are on a grid of a power of two, as the centres of
    voxels are, and so are in single precision as they are in double."""
    lo, hi = vertices.min(axis=0), vertices.max(axis=0)
    step = 2.0 ** np.ceil(np.log2((hi - lo)[:2].max() / steps))
    x, y = (np.arange(np.floor(lo[k] / step) - 3, np.ceil(hi[k] / step) + 4) * step for k in (0, 1))
    x, y = np.meshgrid(x, y[::-1])
    z = np.round((lo[2] + hi[2]) / 2 / step) * step
    return np.stack([x, y, np.full_like(x, z)], axis=-1)


def panel(scene, vertices, faces, name, make):
    """The section as an engine sees it."""
    places = grid(vertices)
    points = places.reshape(-1, 3).astype(np.float32)
    inside = scene.contains(points)
    is_off = inside == scene.contains(points, boundary=False)
    theirs = make(vertices.astype(np.float32), faces).crossings(points, np.tile(UP, (len(points), 1))) % 2 == 1
    wrong = (theirs != inside) & is_off
    sample = np.random.default_rng(1).permutation(np.flatnonzero(is_off))[:JUDGED]
    sample = np.concatenate([sample, np.flatnonzero(wrong)[:JUDGED]])
    truth = np.array([is_inside(vertices, faces, point) for point in points[sample]])
    assert np.array_equal(truth, inside[sample]), "an answer of this library is wrong"
    print(
        f"{name}: {wrong.sum()} of {is_off.sum()} points are wrong; {len(sample)} answers of this library were judged"
    )
    colours = np.where(inside[:, None], INSIDE, OUTSIDE)
    colours[wrong] = WRONG
    image = Image.fromarray(colours.reshape(places.shape).astype(np.uint8))
    image = image.resize((2 * image.width, 2 * image.height), Image.Resampling.NEAREST)
    ImageDraw.Draw(image).text((4, 2), f"{name}: {wrong.sum():,} wrong of {is_off.sum():,}", fill=(0, 0, 0))
    return image


def is_inside(vertices, faces, point):
    """By rational arithmetic, of a point that is not on the mesh."""
    near = near_misses_and_hits(vertices, faces, point, WAY)
    return oracle.crossings(vertices, faces[near], point, WAY) % 2 == 1


def beside(images):
    wide = Image.new("RGB", (sum(image.width for image in images), max(image.height for image in images)), OUTSIDE)
    left = 0
    for image in images:
        wide.paste(image, (left, 0))
        left += image.width
    return wide


if __name__ == "__main__":
    main()

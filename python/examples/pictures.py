"""Draws pictures of a mesh: depth by closest hits, and a section with its inside and the errors of other libraries.

    python examples/pictures.py [MESH] [-o FOLDER]

It needs trimesh and Pillow. The default mesh is generated, with deep folds like a brain (`folds.py` needs SciPy).
`depth.png` is grey by distance. `section.png` shows the voxels of a plane that are inside. A voxel is inside if a ray
along z from its centre crosses the mesh an odd number of times. Installed libraries get a panel: trimesh with embreex
(`intersects_location`) and Open3D (`count_intersections`). Blue is inside, white outside, and red wrong.
`Scene.contains` judges the answers, and rational arithmetic judges a sample.

`inside.png`, only for the generated mesh, shows a section of the mesh with two holes. Points with a winding number
above 1/2 are inside. Open3D, trimesh and libigl are shown next to this library. Sums of all solid angles judge a
sample.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image, ImageDraw, ImageFont

from stackless_bvh import Scene

PYTHON = Path(__file__).parents[1]
sys.path[:0] = [str(Path(__file__).parent), *(str(PYTHON / name) for name in (".", "tests", "judge"))]
import folds  # noqa: E402
import oracle  # noqa: E402
from peers import PEERS  # noqa: E402

from bench import ENGINES, near_misses_and_hits  # noqa: E402

# A section with trimesh's own engine would take hours.
OTHERS = {name: ENGINES[name] for name in ("trimesh embreex", "Open3D") if name in ENGINES}
INSIDE, OUTSIDE, WRONG = (120, 155, 215), (255, 255, 255), (225, 30, 30)
UP = np.float32([0, 0, 1])
# All components are different and not 0.
WAY = np.array([0.61, 0.37, 0.53])
# Number of answers that rational arithmetic judges; an equal number of wrong answers of other libraries.
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
    if not arguments.mesh:
        open_section(vertices, folds.opened(vertices, faces)).save(arguments.output / "inside.png", optimize=True)
    if not scene.is_closed:
        sys.exit("the mesh is not closed: there is no section")
    panels = [panel(scene, vertices, faces, name, make) for name, make in OTHERS.items()]
    beside(panels).quantize(16).save(arguments.output / "section.png", optimize=True)


def loaded(path):
    mesh = trimesh.load(path, process=False, force="mesh")
    return mesh.vertices.view(np.ndarray).astype(np.float64), mesh.faces.view(np.ndarray)


def depth(scene, vertices, size):
    """Draws a perspective view along -z of the whole mesh."""
    lo, hi = vertices.min(axis=0), vertices.max(axis=0)
    away = np.array([0, 0, 1.5 * (hi - lo).max() + (hi - lo)[2] / 2])
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, size), np.linspace(0.5, -0.5, size))
    ways = np.stack([x, y, np.full_like(x, -1.2)], axis=-1).reshape(-1, 3)
    hits = scene.closest((lo + hi) / 2 + away, ways)
    far, near = (hits.t[hits.hit].max(), hits.t[hits.hit].min()) if hits.hit.any() else (1, 0)
    grey = np.where(hits.hit, 255 - 225 * (hits.t - near) / max(far - near, 1e-9), 0)
    return grey.reshape(size, size).astype(np.uint8)


def grid(vertices, steps=256):
    """Returns points of the plane across z near the middle of the mesh. Like the centres of voxels, they are on a grid
    with a power of two as its step, so single precision represents them exactly."""
    lo, hi = vertices.min(axis=0), vertices.max(axis=0)
    step = 2.0 ** np.ceil(np.log2((hi - lo)[:2].max() / steps))
    x, y = (np.arange(np.floor(lo[k] / step) - 3, np.ceil(hi[k] / step) + 4) * step for k in (0, 1))
    x, y = np.meshgrid(x, y[::-1])
    z = np.round((lo[2] + hi[2]) / 2 / step) * step
    return np.stack([x, y, np.full_like(x, z)], axis=-1)


def panel(scene, vertices, faces, name, make):
    """Returns the section according to an engine."""
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


def open_section(vertices, faces):
    """Draws sections of an open mesh: the answers of this library, and errors of other libraries."""
    scene, places = Scene(vertices, faces), grid(vertices)
    points = places.reshape(-1, 3)
    inside = scene.contains(points, rule="winding")
    is_off = inside == scene.contains(points, rule="winding", boundary=False)
    cut = trimesh.intersections.mesh_plane(trimesh.Trimesh(vertices, faces, process=False), [0, 0, 1], places[0, 0])
    judged = np.random.default_rng(1).permutation(np.flatnonzero(is_off))[:JUDGED]
    panels = [drawn(places, cut, inside, np.zeros(len(points), bool), "stackless-bvh")]
    for name, make in PEERS.items():
        wrong = (make(vertices, faces).inside(points) != inside) & is_off
        panels.append(drawn(places, cut, inside, wrong, name))
        judged = np.concatenate([judged, np.flatnonzero(wrong)[:: max(1, wrong.sum() // JUDGED)]])
    truth = np.array([winding(vertices[faces], point) for point in points[judged]])
    assert np.array_equal(truth > 0.5, inside[judged]), "an answer of this library is wrong"
    print(f"open section: {len(judged)} answers of this library were judged")
    rows = [beside(panels[k : k + 2]) for k in (0, 2)]
    return Image.fromarray(np.concatenate([np.asarray(row) for row in rows])).quantize(16)


def drawn(places, cut, inside, wrong, name, width=600):
    """Draws a panel with the outline of the mesh, and a title that is legible at small sizes."""
    colours = np.where(inside[:, None], INSIDE, OUTSIDE)
    colours[wrong] = WRONG
    image = Image.fromarray(colours.reshape(places.shape).astype(np.uint8))
    scale, title = width / image.width, 52
    image = image.resize((width, int(image.height * scale)), Image.Resampling.NEAREST)
    panel = Image.new("RGB", (width, image.height + title), OUTSIDE)
    panel.paste(image, (0, title))
    draw = ImageDraw.Draw(panel)
    step = places[0, 1, 0] - places[0, 0, 0]
    for line in (cut - places[0, 0])[:, :, :2] / step * [1, -1] + 0.5:
        draw.line([(x * scale, y * scale + title) for x, y in line], fill=(0, 0, 0), width=2)
    text = f"{name}: {wrong.sum():,} wrong"
    draw.text((10, 2), text, fill=WRONG if wrong.any() else (0, 0, 0), font=ImageFont.load_default(40))
    return panel


def winding(triangles, point):
    """Returns the sum of all solid angles (Van Oosterom & Strackee 1983), over 4 pi."""
    a, b, c = (triangles - point).astype(np.longdouble).transpose(1, 0, 2)
    la, lb, lc = (np.sqrt((v * v).sum(axis=1)) for v in (a, b, c))
    y = (a * np.cross(b, c)).sum(axis=1)
    x = la * lb * lc + (a * b).sum(axis=1) * lc + (b * c).sum(axis=1) * la + (c * a).sum(axis=1) * lb
    return float(np.arctan2(y, x).sum() / (2 * np.pi))


def is_inside(vertices, faces, point):
    """Decides with rational arithmetic, for a point off the mesh."""
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

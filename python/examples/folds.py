"""A closed surface with deep folds, like a brain: a sphere, displaced by a pattern that grows on it."""

from __future__ import annotations

import numpy as np
import trimesh
from scipy import sparse

STEPS = 6000


def folded_sphere(levels=6, depth=0.4, grid=128):
    """Returns a mesh with vertices on a grid of steps 1/grid, like that of a segmented volume.

    The pattern is Gray and Scott's reaction of two substances that spread over the sphere.
    """
    sphere = trimesh.creation.icosphere(levels)
    pattern = labyrinth(sphere)
    low, high = np.quantile(pattern, [0.1, 0.9])
    ridge = np.clip((pattern - low) / (high - low), 0, 1)
    ridge = ridge * ridge * (3 - 2 * ridge)
    vertices = sphere.vertices * [1.0, 0.8, 0.75] * (1 - depth * (1 - ridge))[:, None]
    return np.round(vertices * grid) / grid, sphere.faces.view(np.ndarray)


def opened(vertices, faces, holes=((1.0, 0.25), (-0.6, -0.75)), width=0.3):
    """Removes the faces around some directions across z, like parts that a scanner has not seen."""
    middles = vertices[faces].mean(axis=1)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    aims = np.array([(*hole, 0) / np.linalg.norm(hole) for hole in holes])
    return faces[(middles @ aims.T < np.cos(width)).all(axis=1)]


def labyrinth(sphere, feed=0.037, kill=0.06):
    """Returns the concentration of the second substance at each vertex."""
    edges = np.concatenate([sphere.edges_unique, sphere.edges_unique[:, ::-1]])
    count = len(sphere.vertices)
    near = sparse.csr_matrix((np.ones(len(edges)), edges.T), shape=(count, count))
    spread = sparse.diags_array(1 / np.asarray(near.sum(axis=1)).ravel()) @ near - sparse.eye_array(count)
    random = np.random.default_rng(5)
    a, b = np.ones(count), np.zeros(count)
    for seed in random.integers(0, count, 60):
        b[np.linalg.norm(sphere.vertices - sphere.vertices[seed], axis=1) < 0.05] = 0.5
    for _ in range(STEPS):
        made = a * b * b
        a += 0.8 * (spread @ a) - made + feed * (1 - a)
        b += 0.4 * (spread @ b) + made - (feed + kill) * b
    return b

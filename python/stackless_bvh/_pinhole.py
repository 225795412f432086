"""Rays of a pinhole camera, like those of Open3D."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._geometries import plain


def of_matrices(intrinsic_matrix: Any, extrinsic_matrix: Any, width_px: int, height_px: int) -> NDArray[np.float32]:
    """Returns one ray for the middle of each pixel: shape (height_px, width_px, 6)."""
    intrinsic = _array(intrinsic_matrix, "intrinsic_matrix", (3, 3))
    extrinsic = _array(extrinsic_matrix, "extrinsic_matrix", (4, 4))
    to_world = np.linalg.inv(extrinsic[:3, :3])
    return _rays(-to_world @ extrinsic[:3, 3], to_world @ np.linalg.inv(intrinsic), width_px, height_px)


def looking_at(fov_deg: float, center: Any, eye: Any, up: Any, width_px: int, height_px: int) -> NDArray[np.float32]:
    """Returns the rays of a camera at `eye` that looks at `center`. The field of view spans the width."""
    start, upward = _array(eye, "eye", (3,)), _array(up, "up", (3,))
    forward = _array(center, "center", (3,)) - start
    right = np.cross(upward, forward)
    if not right.any():
        raise ValueError(f"up: {upward.tolist()}, expected another direction than from eye to center")
    axes = np.stack([right, np.cross(forward, right), forward], axis=1)
    focal = 0.5 * width_px / np.tan(0.5 * np.deg2rad(fov_deg))
    intrinsic = np.array([[focal, 0, 0.5 * width_px], [0, focal, 0.5 * height_px], [0, 0, 1]])
    return _rays(start, axes / np.linalg.norm(axes, axis=0) @ np.linalg.inv(intrinsic), width_px, height_px)


def _rays(origin: NDArray[Any], to_world: NDArray[Any], width: int, height: int) -> NDArray[np.float32]:
    rays = np.empty((height, width, 6), dtype=np.float32)
    rays[..., :3] = origin
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    rays[..., 3:] = np.stack([x, y, np.ones_like(x)], axis=-1) @ to_world.T
    return rays


def _array(values: Any, name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    array = np.asarray(plain(values), dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"{name}: shape {array.shape}, expected {shape}")
    return array

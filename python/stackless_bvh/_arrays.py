"""Checks of the dtypes and shapes of arrays from users, with errors of one line."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FLOATS = ("float32", "float64")
INDICES = ("int32", "int64", "uint32")


def mesh_arrays(vertices: ArrayLike, faces: ArrayLike) -> tuple[NDArray[Any], NDArray[Any]]:
    """Returns vertices and faces as arrays with unchecked values."""
    points = array_of(vertices, "vertices", np.float64)
    if points.dtype not in FLOATS:
        raise TypeError(f"vertices: dtype {points.dtype}, expected float32 or float64")
    check_shape(points, "vertices", 3, "n")
    return aligned(points), face_array(faces)


def check_area(vertices: NDArray[Any], faces: NDArray[Any]) -> None:
    """Warns if each face repeats a corner or lies on a line along an axis, so that rays miss the whole mesh.

    The first face of an ordinary mesh has an area. Faces on other lines are not recognized.
    """
    for some in (faces[:1], faces):
        corners = vertices[some]
        repeats = (corners == corners[:, [1, 2, 0]]).all(axis=2).any(axis=1)
        straight = (corners == corners[:, :1]).all(axis=1).sum(axis=1) >= 2
        if not (repeats | straight).all():
            return
    warnings.warn("faces: none has an area, so that all rays miss the mesh", stacklevel=3)


def face_array(faces: ArrayLike) -> NDArray[Any]:
    """Returns indices of a supported dtype. Other integers are converted without loss."""
    array = array_of(faces, "faces", None)
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces: dtype {array.dtype}, expected integers")
    check_shape(array, "faces", 3, "m")
    if array.dtype in INDICES:
        return aligned(array)
    if array.dtype.kind == "u" and array.dtype.itemsize == 8:
        # Indices that are out of range stay out of range.
        array = np.minimum(array, np.iinfo(np.int64).max)
    return array.astype(np.int64)


def rows(array: ArrayLike, name: str, dtype: str, width: int = 3) -> NDArray[Any]:
    """Returns an array of shape (n, width). Shape (width,) becomes a single row."""
    array = numbers(array, name, dtype)
    if array.shape == (width,):
        array = array[np.newaxis]
    check_shape(array, name, width, "n")
    # The shape of a view does not change with the shape of the array.
    return array.view(np.ndarray)


def rays(origins: ArrayLike, directions: ArrayLike, tmin: ArrayLike, tmax: ArrayLike, dtype: str) -> list[NDArray[Any]]:
    """Returns four arrays with equal numbers of rows. A single origin or direction is repeated."""
    starts, ways = rows(origins, "origins", dtype), rows(directions, "directions", dtype)
    if len(starts) != len(ways) and 1 not in (len(starts), len(ways)):
        raise ValueError(f"{len(starts)} origins and {len(ways)} directions, expected as many of both")
    count = len(ways) if len(starts) == 1 else len(starts)
    # Repeated rows are not copied.
    starts, ways = np.broadcast_to(starts, (count, 3)), np.broadcast_to(ways, (count, 3))
    return [starts, ways, per_row(tmin, "tmin", dtype, count), per_row(tmax, "tmax", dtype, count)]


def per_row(array: ArrayLike, name: str, dtype: str, count: int) -> NDArray[Any]:
    """Returns a number for each of `count` rows. A single number is repeated."""
    array = numbers(array, name, dtype)
    if array.shape not in ((), (1,), (count,)):
        raise ValueError(f"{name}: shape {array.shape}, expected a number or shape ({count},)")
    return np.broadcast_to(array, (count,))


def numbers(array: ArrayLike, name: str, dtype: str) -> NDArray[Any]:
    """Returns an array of the dtype of a scene. Only lists and single numbers, which have no dtype, are rounded."""
    array = array_of(array, name, dtype)
    if array.dtype == dtype:
        return aligned(array)
    if array.dtype == "float32":
        return array.astype(dtype)
    fix = f"pass {name}.astype('{dtype}')" if array.dtype.kind in "fiu" else "pass numbers"
    if array.dtype == "float64":
        fix += " or make the Scene of float64 vertices"
    raise TypeError(f"{name}: dtype {array.dtype}, expected {dtype}; {fix}")


def aligned(array: NDArray[Any]) -> NDArray[Any]:
    """Returns the array, copied if it is unaligned, as in packed records."""
    return array if array.flags.aligned else array.copy()


def array_of(values: ArrayLike, name: str, dtype: Any) -> NDArray[Any]:
    """Returns an array unchanged, and lists and numbers as an array of a dtype."""
    if isinstance(values, (list, tuple)) and any(isinstance(row, np.ma.MaskedArray) for row in values):
        values = np.ma.asarray(values, dtype=dtype)
    if isinstance(values, np.ndarray):
        return unmasked(values, name)
    try:
        return np.asarray(values, dtype=dtype)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: expected an array of numbers, not this {type(values).__name__}") from None


def unmasked(array: NDArray[Any], name: str) -> NDArray[Any]:
    """Returns the array without its mask. Refuses masked numbers, which would be read like other numbers."""
    if not isinstance(array, np.ma.MaskedArray):
        return array
    masked = np.argwhere(np.ma.getmaskarray(array))
    if len(masked):
        row = f"[{masked[0][0]}]" if array.ndim else ""
        raise ValueError(f"{name}{row}: masked, expected numbers; leave masked rows out, or pass {name}.filled(value)")
    return array.data


def check_shape(array: NDArray[Any], name: str, width: int, count: str) -> None:
    """Refuses shapes other than (n, width)."""
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{name}: shape {array.shape}, expected ({count}, {width})")

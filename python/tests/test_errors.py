"""Invalid arrays: the error is one line that names the argument, and the row if there is one."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import CUBE, CUBE_FACES

from stackless_bvh import Instances, Scene

F4, F8 = np.float32, np.float64
ORIGIN, ALONG = np.zeros((3, 3)), np.ones((3, 3))


def changed(array, where, value, dtype=None):
    array = array.astype(dtype or array.dtype)
    array[where] = value
    return array


MESHES = [
    (CUBE[:, :2], CUBE_FACES, ValueError, "vertices: shape (8, 2), expected (n, 3)"),
    (CUBE[0], CUBE_FACES, ValueError, "vertices: shape (3,), expected (n, 3)"),
    (CUBE[None], CUBE_FACES, ValueError, "vertices: shape (1, 8, 3), expected (n, 3)"),
    (CUBE.astype(int), CUBE_FACES, TypeError, "vertices: dtype int64, expected float32 or float64"),
    (CUBE.astype(np.float16), CUBE_FACES, TypeError, "vertices: dtype float16, expected float32 or float64"),
    (CUBE.astype(">f8"), CUBE_FACES, TypeError, "vertices: dtype >f8, expected float32 or float64"),
    (CUBE.astype(complex), CUBE_FACES, TypeError, "vertices: dtype complex128, expected float32 or float64"),
    (CUBE.astype(object), CUBE_FACES, TypeError, "vertices: dtype object, expected float32 or float64"),
    (changed(CUBE, (5, 1), np.nan), CUBE_FACES, ValueError, "vertices[5]: [1, NaN, 1], expected finite numbers"),
    (changed(CUBE, (2, 0), np.inf), CUBE_FACES, ValueError, "vertices[2]: [inf, 1, 0], expected finite numbers"),
    ([[0, 0, 0], [1, 0]], CUBE_FACES, TypeError, "vertices: expected an array of numbers, not this list"),
    ({"a": 1}, CUBE_FACES, TypeError, "vertices: expected an array of numbers, not this dict"),
    (np.ma.masked_equal(CUBE, 1), CUBE_FACES, ValueError, "vertices[1]: masked, expected numbers; leave masked rows out, or pass vertices.filled(value)"),
    (CUBE, np.ma.masked_equal(CUBE_FACES, 7), ValueError, "faces[2]: masked, expected numbers; leave masked rows out, or pass faces.filled(value)"),
    (None, CUBE_FACES, ValueError, "vertices: shape (), expected (n, 3)"),
    (CUBE, CUBE_FACES[:, :2], ValueError, "faces: shape (12, 2), expected (m, 3)"),
    (CUBE, CUBE_FACES.ravel(), ValueError, "faces: shape (36,), expected (m, 3)"),
    (CUBE, CUBE_FACES.astype(float), TypeError, "faces: dtype float64, expected integers"),
    (CUBE, CUBE_FACES > 2, TypeError, "faces: dtype bool, expected integers"),
    (CUBE, CUBE_FACES[:0], ValueError, "faces: no rows, expected at least one"),
    (CUBE, changed(CUBE_FACES, (7, 1), 99), ValueError, "faces[7]: index 99 of vertex 1, expected < 8"),
    (CUBE, changed(CUBE_FACES, (3, 2), -1), ValueError, "faces[3]: index -1 of vertex 2, expected >= 0"),
    (CUBE, changed(CUBE_FACES, (3, 0), 2**63, np.uint64), ValueError, f"faces[3]: index {2**63 - 1} of vertex 0, expected < 8"),
    (CUBE, changed(CUBE_FACES, (3, 0), 2**32, np.int64), ValueError, f"faces[3]: index {2**32} of vertex 0, expected < 8"),
    (CUBE[:0], CUBE_FACES, ValueError, "faces[0]: index 0 of vertex 0, expected < 0"),
]  # fmt: skip


def test_meshes_that_are_no_arrays():
    read = "a mesh is read by Scene.load_mesh('part.stl'), and what Scene.save has written by Scene.load"
    for path in ("part.stl", Path("part.stl")):
        for faces in ((), (CUBE_FACES,)):
            check(TypeError, f"vertices: the path 'part.stl', expected an array; {read}", lambda: Scene(path, *faces))
    mesh = SimpleNamespace(vertices=CUBE, faces=CUBE_FACES)
    message = "vertices: a SimpleNamespace, expected an array; pass its .vertices and its .faces"
    check(TypeError, message, lambda: Scene(mesh))
    check(TypeError, "faces: missing, expected integers of shape (m, 3)", lambda: Scene(CUBE))


@pytest.mark.parametrize(("vertices", "faces", "kind", "message"), MESHES)
def test_meshes(vertices, faces, kind, message):
    check(kind, message, lambda: Scene(vertices, faces))


RAYS = [
    ((ORIGIN[:, :2], ALONG), ValueError, "origins: shape (3, 2), expected (n, 3)"),
    ((ORIGIN, ALONG[:2]), ValueError, "3 origins and 2 directions, expected as many of both"),
    ((ORIGIN.astype(F8), ALONG), TypeError, "origins: dtype float64, expected float32; pass origins.astype('float32') or make the Scene of float64 vertices"),
    ((ORIGIN.astype(F4), ALONG.astype(int)), TypeError, "directions: dtype int64, expected float32; pass directions.astype('float32')"),
    ((ORIGIN.astype(F4), ALONG.astype("U3")), TypeError, "directions: dtype <U3, expected float32; pass numbers"),
    (([["a", 0, 0]], ALONG), TypeError, "origins: expected an array of numbers, not this list"),
    ((changed(ORIGIN, (1, 2), np.nan, F4), ALONG.astype(F4)), ValueError, "origins[1]: [0, 0, NaN], expected finite numbers"),
    ((ORIGIN.astype(F4), changed(ALONG, (2, 0), -np.inf, F4)), ValueError, "directions[2]: [-inf, 1, 1], expected finite numbers"),
    ((ORIGIN.astype(F4), changed(ALONG, 1, 0, F4)), ValueError, "directions[1]: [0, 0, 0], expected a direction"),
    ((ORIGIN.tolist(), ALONG.tolist(), -1), ValueError, "tmin[0]: -1, expected >= 0"),
    ((ORIGIN.tolist(), ALONG.tolist(), [0, 3, 0], 2), ValueError, "tmin[1] and tmax[1]: 3 and 2, expected a finite tmin, and a tmax that is not less"),
    ((ORIGIN.tolist(), ALONG.tolist(), np.nan), ValueError, "tmin[0] and tmax[0]: NaN and inf, expected a finite tmin, and a tmax that is not less"),
    ((ORIGIN.tolist(), ALONG.tolist(), 0, [1, 2]), ValueError, "tmax: shape (2,), expected a number or shape (3,)"),
]  # fmt: skip


@pytest.mark.parametrize("query", ["closest", "any", "all_hits", "count_crossings"])
@pytest.mark.parametrize(("arguments", "kind", "message"), RAYS)
def test_rays(query, arguments, kind, message):
    arguments = [
        a.astype(F4) if isinstance(a, np.ndarray) and "pass" not in message and a.dtype.kind == "f" else a
        for a in arguments
    ]
    scene = Scene(CUBE.astype(F4), CUBE_FACES)
    check(kind, message, lambda: getattr(scene, query)(*arguments))


def test_points_and_what_else_is_asked():
    single, double = Scene(CUBE.astype(F4), CUBE_FACES), Scene(CUBE, CUBE_FACES)
    points = changed(ORIGIN, (2, 1), np.nan, F4)
    for query in (single.contains, single.nearest):
        check(ValueError, "points[2]: [0, NaN, 0], expected finite numbers", lambda: query(points))
        check(ValueError, "points: shape (2, 2), expected (n, 3)", lambda: query(np.zeros((2, 2), F4)))
    check(ValueError, "radius[0]: -1, expected >= 0", lambda: single.nearest([0, 0, 0], -1))
    check(ValueError, "radius: shape (2,), expected a number or shape (1,)", lambda: single.nearest([0, 0, 0], [1, 2]))
    check(ValueError, "k: 0, expected at least 1", lambda: single.nearest([0, 0, 0], k=0))
    check(TypeError, "k: 2.5, expected an integer", lambda: single.nearest([0, 0, 0], k=2.5))
    check(ValueError, "points[0]: [inf, 0, 0], expected finite numbers", lambda: double.nearest([np.inf, 0, 0]))
    check(ValueError, "radius[0]: NaN, expected >= 0", lambda: double.nearest([0, 0, 0], np.nan))
    message = "build: 'slow', expected one of standard, best, sbvh, bounded, median"
    check(ValueError, message, lambda: Scene(CUBE, CUBE_FACES, "slow"))
    message = "the mesh is not closed: the edge (0, 1) of faces[0] is in 1 face, expected an even number (4 such edges); rule='winding' fits it"
    opened = Scene(CUBE, np.delete(CUBE_FACES, [4, 5], axis=0))
    assert not opened.is_closed
    check(ValueError, message, lambda: opened.contains([0, 0, 0]))


def test_masked_arrays_are_refused_unless_nothing_is_masked():
    scene, mask = Scene(CUBE, CUBE_FACES), np.zeros((3, 3), bool)
    free = np.ma.array(ORIGIN, mask=mask)
    assert np.array_equal(scene.closest(free, np.ma.array(ALONG)).t, scene.closest(ORIGIN, ALONG).t)
    mask[2, 1] = True
    masked = np.ma.array(ORIGIN, mask=mask)
    end = "masked, expected numbers; leave masked rows out, or pass"
    for array in (masked, list(masked)):
        check(ValueError, f"origins[2]: {end} origins.filled(value)", lambda: scene.closest(array, ALONG))
        check(ValueError, f"directions[2]: {end} directions.filled(value)", lambda: scene.any(ORIGIN, array))
        check(ValueError, f"points[2]: {end} points.filled(value)", lambda: scene.contains(array))
        check(ValueError, f"points[2]: {end} points.filled(value)", lambda: scene.nearest(array))
    ends = np.ma.masked_greater([1.0, 3, 1], 2)
    check(ValueError, f"tmin[1]: {end} tmin.filled(value)", lambda: scene.all_hits(ORIGIN, ALONG, ends))
    check(ValueError, f"tmax[1]: {end} tmax.filled(value)", lambda: scene.any(ORIGIN, ALONG, 0, ends))
    check(ValueError, f"radius: {end} radius.filled(value)", lambda: scene.nearest(ORIGIN, np.ma.masked))
    vertices = np.ma.masked_equal(CUBE, 0)
    check(ValueError, f"vertices[0]: {end} vertices.filled(value)", lambda: scene.refit(vertices))
    single, unit = Scene(CUBE.astype(F4), CUBE_FACES), np.eye(4, dtype=F4)[None]
    objects, maps = np.ma.masked_equal([0], 0), np.ma.masked_equal(unit, 0)
    check(ValueError, f"objects[0]: {end} objects.filled(value)", lambda: Instances([single], objects, unit))
    check(ValueError, f"transforms[0]: {end} transforms.filled(value)", lambda: Instances([single], [0], maps))


def test_instances():
    single, double = Scene(CUBE.astype(F4), CUBE_FACES), Scene(CUBE, CUBE_FACES)
    unit = np.eye(4, dtype=F4)[None]
    check(TypeError, "objects: dtype float64, expected integers", lambda: Instances([single], [0.0], unit))
    check(ValueError, "objects: shape (1, 1), expected (n,)", lambda: Instances([single], [[0]], unit))
    check(ValueError, "objects[0]: 1, expected 0 to 0", lambda: Instances([single], [1], unit))
    check(ValueError, "objects[0]: -1, expected 0 to 0", lambda: Instances([single], [-1], unit))
    message = "scenes[1]: float64, expected float32, the dtype of scenes[0]"
    check(ValueError, message, lambda: Instances([single, double], [0], unit))
    message = "scenes[1]: float32, expected float64, the dtype of scenes[0]"
    check(ValueError, message, lambda: Instances([double, Instances([single], [0], unit)], [0], unit))
    message = "transforms: dtype float64, expected float32; pass transforms.astype('float32') or make the Scene of float64 vertices"
    check(TypeError, message, lambda: Instances([single], [0], unit.astype(float)))
    check(TypeError, "scenes[0]: ndarray, expected a Scene or Instances", lambda: Instances([CUBE], [0], unit))
    nested = Instances([single], [0], unit)
    for _ in range(30):
        nested = Instances([nested], [0], unit)
    assert nested.closest([0.25, 0.25, -1], [0, 0, 1]).path.tolist() == [31 * [0]]
    check(ValueError, "objects[0]: groups in more than 31 levels", lambda: Instances([nested], [0], unit))
    message = "transforms: shape (1, 4, 4), expected (2, 3, 4) or (2, 4, 4)"
    check(ValueError, message, lambda: Instances([single], [0, 0], unit))
    message = "transforms[0]: fourth row [0.0, 0.0, 0.0, 2.0], expected [0, 0, 0, 1]"
    check(ValueError, message, lambda: Instances([single], [0], changed(unit, (0, 3, 3), 2)))
    message = "transforms[0]: the determinant is 0, so the map has no inverse"
    check(ValueError, message, lambda: Instances([single], [0], changed(unit, (0, 0, 0), 0)))
    message = "transforms[0]: row 1, column 3: NaN, expected a finite number"
    check(ValueError, message, lambda: Instances([single], [0], changed(unit, (0, 1, 3), np.nan)))
    check(
        ValueError, "objects: no rows, expected at least one", lambda: Instances([single], np.zeros(0, int), unit[:0])
    )


def check(kind, message, do):
    with pytest.raises(kind) as error:
        do()
    assert str(error.value) == message and "\n" not in message
    assert type(error.value) is kind

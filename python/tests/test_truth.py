"""Every query is compared with rational arithmetic, on meshes and rays that hypothesis draws."""

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stackless_bvh import Scene

# A grid of few points, so that rays often meet edges and corners; and floats of all magnitudes.
GRID = st.integers(-8, 8).map(lambda x: x / 8)
FLOATS = st.floats(-1000.0, 1000.0, width=32)
EXTREME = st.one_of(
    GRID, st.floats(width=32, allow_nan=False, allow_infinity=False, max_value=2.0**60, min_value=-(2.0**60))
)
DTYPES = st.sampled_from([np.float32, np.float64])
BUILDS = st.sampled_from(["standard", "best", "sbvh", "bounded", "median"])


def points(numbers, count):
    return st.lists(st.tuples(numbers, numbers, numbers), min_size=count, max_size=count)


@st.composite
def meshes(draw, numbers):
    """Draws up to eight vertices, and arbitrary faces over them, also degenerate and repeated ones."""
    count = draw(st.integers(3, 8))
    index = st.integers(0, count - 1)
    faces = draw(st.lists(st.tuples(index, index, index), min_size=1, max_size=12))
    return draw(points(numbers, count)), faces


@st.composite
def questions(draw):
    """Draws a scene, and rays: arbitrary ones, and others through a vertex or the middle of an edge."""
    numbers = draw(st.sampled_from([GRID, FLOATS, EXTREME]))
    dtype = draw(DTYPES)
    vertices, faces = draw(meshes(numbers))
    vertices = np.array(vertices, dtype=dtype)
    origins = np.array(draw(points(numbers, 6)), dtype=dtype)
    directions = np.array(draw(points(numbers, 6)), dtype=dtype)
    for ray in range(4):
        a, b, _ = faces[draw(st.integers(0, len(faces) - 1))]
        aim = vertices[a] if ray % 2 == 0 else vertices[a] / 2 + vertices[b] / 2
        with np.errstate(over="ignore"):
            directions[ray] = aim - origins[ray]
    keep = np.isfinite(directions).all(axis=1) & directions.any(axis=1)
    ends = sorted(draw(st.tuples(*2 * [st.floats(0, 4, width=32)])))
    tmin, tmax = draw(st.sampled_from([(0.0, np.inf), tuple(ends)]))
    return Scene(vertices, np.array(faces), draw(BUILDS)), origins[keep], directions[keep], tmin, tmax


@given(questions())
def test_rays_get_the_answers_of_rational_arithmetic(question):
    scene, origins, directions, tmin, tmax = question
    dtype, vertices, faces = scene.dtype.type, scene.vertices, scene.faces
    closest = scene.closest(origins, directions, tmin, tmax)
    everything = scene.all_hits(origins, directions, tmin, tmax)
    anything = scene.any(origins, directions, tmin, tmax)
    assert closest.t.dtype == everything.t.dtype == dtype and len(closest) == len(everything) == len(origins)
    for i, (origin, direction) in enumerate(zip(origins, directions)):
        truth = oracle.all_hits(vertices, faces, origin, direction, tmin, tmax, dtype)
        rows = slice(everything.offsets[i], everything.offsets[i + 1])
        assert everything.primitives[rows].tolist() == [hit[1] for hit in truth]
        assert everything.t[rows].tolist() == [hit[0] for hit in truth]
        assert everything.place[rows].tolist() == [hit[5] for hit in truth]
        weights = [[oracle.rounded(u, dtype), oracle.rounded(v, dtype)] for _, _, _, u, v, _ in truth]
        assert everything.uv[rows].tolist() == weights
        assert anything[i] == closest.hit[i] == bool(truth)
        if truth:
            assert (closest.t[i], closest.primitive[i], closest.uv[i].tolist()) == (*truth[0][:2], weights[0])
        else:
            assert closest.t[i] == np.inf and closest.primitive[i] == -1 and np.isnan(closest.uv[i]).all()


@st.composite
def tetrahedra(draw):
    """Draws a closed mesh of tetrahedra on the grid, whose faces may overlap, and points and directions on the grid."""
    vertices, faces = [], []
    for _ in range(draw(st.integers(1, 3))):
        first = len(vertices)
        vertices += draw(points(GRID, 4))
        faces += [[first + i for i in face] for face in ([0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3])]
    origins, directions = draw(points(GRID, 6)), draw(points(GRID.filter(bool), 6))
    return np.array(vertices), np.array(faces), np.array(origins), np.array(directions)


@pytest.mark.filterwarnings("ignore:.* of the faces repeat earlier ones")
@given(tetrahedra(), DTYPES, BUILDS)
def test_crossings_and_inside_are_those_of_a_ray_moved_by_very_little(mesh, dtype, build):
    vertices, faces, origins, directions = mesh
    scene = Scene(vertices.astype(dtype), faces, build)
    origins, directions = origins.astype(dtype), directions.astype(dtype)
    assert scene.is_closed and scene.is_oriented
    counts = scene.count_crossings(origins, directions)
    inside, strictly = scene.contains(origins), scene.contains(origins, boundary=False)
    for i, (origin, direction) in enumerate(zip(origins, directions)):
        triangles = [oracle.corners(vertices, face) for face in faces]
        triangles = [triangle for triangle in triangles if oracle.has_area(triangle)]
        if any(oracle.nearest_square(triangle, oracle.vector(origin))[0] == 0 for triangle in triangles):
            assert inside[i] and not strictly[i]
        else:
            truth = oracle.crossings(triangles, origin, direction)
            assert counts[i] == truth
            assert inside[i] == strictly[i] == (truth % 2 == 1)


# Also far away, where all points round to one in single precision; very small; and beyond its range.
PLACES = st.sampled_from([(0.0, 1.0), (6.4e6, 1.0), (1e9, 1.0), (0.0, 1e-50), (1.0, 1e50)])
NUMBERS = st.one_of(GRID, st.floats(-1000.0, 1000.0))


@given(meshes(NUMBERS), points(NUMBERS, 4), st.integers(1, 4), DTYPES, PLACES, BUILDS)
def test_nearest_is_that_of_rational_arithmetic(mesh, asked, k, dtype, place, build):
    far, scale = place if dtype is np.float64 else (0.0, 1.0)
    vertices, faces = ((np.array(mesh[0]) + far) * scale).astype(dtype), np.array(mesh[1])
    # On vertices and middles of edges too.
    asked = ((np.array(asked) + far) * scale).astype(dtype)
    asked[:2] = [vertices[faces[0, 0]], vertices[faces[-1, 0]] / 2 + vertices[faces[-1, 1]] / 2]
    scene = Scene(vertices, faces, build)
    near = scene.nearest(asked, k=k)
    shape = (len(asked), k) if k > 1 else (len(asked),)
    assert near.distance.shape == near.primitive.shape == shape and near.point.shape == (*shape, 3)
    assert near.distance.dtype == near.point.dtype == dtype
    distance, primitive = near.distance.reshape(-1, k), near.primitive.reshape(-1, k)
    places = near.point.reshape(-1, k, 3)
    for i, point in enumerate(asked):
        triangles = [oracle.corners(vertices, indices) for indices in faces]
        truth = {face: oracle.nearest_square(triangle, oracle.vector(point)) for face, triangle in enumerate(triangles)}
        count = min(k, len(truth))
        assert (primitive[i, count:] == -1).all() and np.isinf(distance[i, count:]).all()
        found = primitive[i, :count].tolist()
        assert len(set(found)) == count
        for face, root, place in zip(found, distance[i], places[i]):
            square, exact = truth[face]
            assert oracle.is_rounded_root(root, square)
            assert place.tolist() == [oracle.rounded(x, dtype) for x in exact]
            # The radius is compared with the exact distance.
            within = scene.nearest(point, root).primitive[0] >= 0
            assert within == any(other <= oracle.Fraction(float(root)) ** 2 for other, _ in truth.values())
        # All other faces are farther away, or equally far with a greater index.
        assert found == sorted(found, key=lambda face: (distance[i, found.index(face)], face))
        worst = max((truth[face][0] for face in found), default=0)
        for face, (square, _) in truth.items():
            if face not in found and square < worst:
                assert oracle.is_rounded_root(distance[i, count - 1], square) and face > found[-1]

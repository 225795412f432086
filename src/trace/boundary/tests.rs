use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::*;
use crate::geom::Mesh;

type Point = [i32; 3];

/// Counts how often each piece of an edge between two neighbours on its line is covered, forward and backward, by
/// visiting every point of the mesh.
fn covering(faces: &[[Point; 3]]) -> BTreeMap<[Point; 2], [usize; 2]> {
    let points: BTreeSet<Point> = faces.iter().flatten().copied().collect();
    let mut pieces = BTreeMap::new();
    for &[a, b, c] in faces {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let mut on_edge: Vec<_> = points.iter().copied().filter(|&p| is_between(p, from, to)).collect();
            on_edge.sort_unstable();
            for piece in on_edge.windows(2) {
                let counts = pieces.entry([piece[0], piece[1]]).or_insert([0; 2]);
                counts[usize::from(to < from)] += 1;
            }
        }
    }
    pieces
}

fn is_between(p: Point, from: Point, to: Point) -> bool {
    let minus = |a: Point, b: Point| [0, 1, 2].map(|k| a[k] - b[k]);
    let (edge, way) = (minus(to, from), minus(p, from));
    let cross = [0, 1, 2].map(|k| edge[(k + 1) % 3] * way[(k + 2) % 3] - edge[(k + 2) % 3] * way[(k + 1) % 3]);
    cross == [0; 3] && (0..3).all(|k| from[k].min(to[k]) <= p[k] && p[k] <= from[k].max(to[k]))
}

fn mesh(faces: &[[Point; 3]]) -> Mesh {
    let corners = faces.iter().flatten().map(|p| Vec3::from(p.map(|x| x as f32)));
    let count = faces.len() as u32;
    Mesh::new(corners.collect(), (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh")
}

/// Returns the mesh in double precision at other places and scales. At the last one neither differences nor products
/// are floats.
fn placed(faces: &[[Point; 3]]) -> Vec<Mesh<DVec3>> {
    let places: [(f64, f64); 4] =
        [(1.0, 0.0), (2f64.powi(-600), 0.0), (2f64.powi(900), 0.0), (1.0, 2f64.powi(52) - 9.0)];
    let place = |(size, at): (f64, f64)| {
        let single = mesh(faces);
        let vertices = single.vertices().iter().map(|v| v.as_dvec3() * size + at).collect();
        Mesh::new(vertices, single.triangles().to_vec()).expect("a mesh")
    };
    places.map(place).into()
}

/// Draws faces of tetrahedra. Some are cut at a point of an edge although their neighbours are not, some are reversed,
/// and some are missing.
fn faces() -> impl Strategy<Value = Vec<[Point; 3]>> {
    let point = || [0..5i32, 0..5, 0..5];
    let tetrahedra = prop::collection::vec([point(), point(), point(), point()], 1..4);
    let cuts = prop::collection::vec((0..100usize, 0..3usize), 0..6);
    let changes = prop::collection::vec((0..100usize, prop::bool::ANY), 0..2);
    (tetrahedra, cuts, changes).prop_map(|(tetrahedra, cuts, changes)| {
        let of = |[a, b, c, d]: [Point; 4]| [[a, b, c], [a, d, b], [b, d, c], [a, c, d]];
        // Even coordinates, so the midpoint of an edge is on the grid.
        let double = |p: Point| p.map(|x| 4 * x);
        let mut faces: Vec<_> = tetrahedra.into_iter().flat_map(|corners| of(corners.map(double))).collect();
        for (face, edge) in cuts {
            let face = face % faces.len();
            let [a, b, c] = [0, 1, 2].map(|k| faces[face][(edge + k) % 3]);
            let sum = [0, 1, 2].map(|k| a[k] + b[k]);
            if sum.iter().all(|x| x % 2 == 0) {
                let middle = sum.map(|x| x / 2);
                faces[face] = [a, middle, c];
                faces.push([middle, b, c]);
            }
        }
        for (face, is_lost) in changes {
            let face = face % faces.len();
            if is_lost && faces.len() > 1 {
                faces.swap_remove(face);
            } else {
                faces[face].swap(0, 1);
            }
        }
        faces
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// [CLOSED-1]
    #[test]
    fn a_mesh_is_closed_if_every_piece_of_every_edge_is_covered_evenly(faces in faces()) {
        let pieces = covering(&faces);
        let is_closed = pieces.values().all(|[forward, backward]| (forward + backward) % 2 == 0);
        let is_oriented = pieces.values().all(|[forward, backward]| forward == backward);
        let boundary = Boundary::of(&mesh(&faces));
        prop_assert_eq!([boundary.is_closed(), boundary.is_oriented()], [is_closed, is_oriented], "{:?}", boundary);
        prop_assert_eq!(boundary.first.is_none(), is_closed);
        for mesh in placed(&faces) {
            let moved = Boundary::of(&mesh);
            let corners = || mesh.vertices().iter().map(|vertex| vertex.widen());
            let bounds = [corners().reduce(DVec3::min), corners().reduce(DVec3::max)];
            prop_assert_eq!(moved.bounds.map(Some), bounds);
            prop_assert_eq!(&Boundary { bounds: boundary.bounds, ..moved }, &boundary);
        }
        // A reported edge has an end at which an open piece of its line ends.
        if let Some(OpenEdge { face, ends, .. }) = boundary.first {
            let [from, to] = ends.map(|end| faces[end as usize / 3][end as usize % 3]);
            prop_assert!(faces[face].contains(&from) && faces[face].contains(&to));
            let is_on_line = |p: Point| is_between(p, from, to) || is_between(from, p, to) || is_between(to, from, p);
            let is_open = |(piece, counts): (&[Point; 2], &[usize; 2])| {
                let ends_there = piece.contains(&from) || piece.contains(&to);
                ends_there && piece.iter().all(|&p| is_on_line(p)) && counts.iter().sum::<usize>() % 2 == 1
            };
            prop_assert!(pieces.iter().any(is_open), "{from:?} {to:?}");
        }
    }
}

/// Many edges at one vertex: all on one line, all along the axes, or all on different lines.
#[test]
fn edges_at_a_vertex_are_sorted_by_their_lines() {
    let point =
        |i: i32| [[i, 0, 0], [0, i, 0], [0, 0, i], [i, 2 * i, 0], [i, 2 * i, 3 * i], [0, i, 5 * i], [i, i, i * i]];
    let ends: Vec<_> = (-4..=4).filter(|&i| i != 0).flat_map(point).map(|p| DVec3::from(p.map(f64::from))).collect();
    let mut equal = 0;
    for &a in &ends {
        for &b in &ends {
            let order = order_of_lines(DVec3::ZERO, [a, b]);
            assert_eq!(order.is_eq(), a.cross(b) == DVec3::ZERO, "{a} {b}");
            assert_eq!(order, order_of_lines(DVec3::ZERO, [b, a]).reverse(), "{a} {b}");
            equal += usize::from(order.is_eq() && a != b);
            for &c in &ends {
                let [then, last] = [[b, c], [a, c]].map(|to| order_of_lines(DVec3::ZERO, to));
                assert!(!(order.is_le() && then.is_le()) || last.is_le(), "{a} {b} {c}");
            }
        }
    }
    assert!(equal > 200, "{equal}");
}

#[test]
fn repeated_faces_are_counted() {
    let face = [[0, 0, 0], [4, 0, 0], [0, 4, 0]];
    let [a, b, c] = face;
    for (faces, repeated) in
        [(vec![face], 0), (vec![face, [b, c, a], [b, a, c]], 2), (vec![face, [a, b, [0, 0, 4]]], 0)]
    {
        assert_eq!(Boundary::of(&mesh(&faces)).repeated, repeated, "{faces:?}");
    }
}

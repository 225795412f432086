use glam::{DVec3, Vec3};

use super::*;
use crate::bvh::Bvh;
use crate::generate::{Rng, Source};
use crate::geom::lanes::Precision;
use crate::geom::{Mesh, Vector};
use crate::trace::{BinaryTracer, Tracer};
use crate::traverse::Method;

type Box3 = [[i32; 3]; 2];

/// Returns the faces of a box, seen from outside. One of them is split at a vertex in the middle of an edge, and its
/// neighbour is not.
fn faces([lo, hi]: Box3, cut: usize) -> Vec<[[i32; 3]; 3]> {
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { hi[k] } else { lo[k] });
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut faces = Vec::new();
    for (i, quad) in quads.into_iter().enumerate() {
        let [a, b, c, d] = quad.map(corner);
        let middle = [0, 1, 2].map(|k| i32::midpoint(a[k], b[k]));
        if i == cut {
            faces.extend([[a, middle, d], [middle, c, d], [middle, b, c]]);
        } else {
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    faces
}

fn mesh<V: Vector>(faces: &[[[i32; 3]; 3]]) -> Mesh<V> {
    let vertices = faces.iter().flatten().map(|p| V::from(Vec3::from(p.map(|x| x as f32)))).collect();
    Mesh::new(vertices, (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh")
}

fn square_to_surface([lo, hi]: &Box3, point: [i32; 3]) -> i32 {
    let beyond = [0, 1, 2].map(|k| (lo[k] - point[k]).max(point[k] - hi[k]));
    match beyond.into_iter().max().expect("three") {
        within @ ..=0 => within * within,
        _ => beyond.map(|x| x.max(0).pow(2)).iter().sum(),
    }
}

/// Boxes that overlap, touch and repeat, and all points of a grid, many of them on faces, edges and corners. All rules,
/// both tracers and both precisions are compared with the boxes themselves. [CLOSED-2]
fn points_are_where_the_boxes_say<V: Precision>() {
    let (mut random, mut counts) = (Rng::new(5), [0; 4]);
    for round in 0..12 {
        let boxes: Vec<Box3> = (0..=round % 4)
            .map(|_| {
                let lo = [0; 3].map(|_: i32| 2 * random.below(3) as i32);
                [lo, lo.map(|x| x + 2 + 2 * random.below(3) as i32)]
            })
            .collect();
        let cut = random.below(6) as usize;
        let mut faces: Vec<_> = boxes.iter().flat_map(|&it| faces(it, cut)).collect();
        if round % 2 == 1 {
            // Seen from inside.
            for face in &mut faces {
                face.swap(0, 1);
            }
        }
        let mesh: Mesh<V> = mesh(&faces);
        let boundary = Boundary::of(&mesh);
        assert!(boundary.is_closed() && boundary.is_oriented(), "{boxes:?} {boundary:?}");
        let bvh = Bvh::build(&mesh).expect("a tree");
        let wide = Tracer::of(&mesh).expect("a tree");
        let binary = BinaryTracer::<_, V::Exact, V::Slabs>::with_tests(&bvh, Method::default()).expect("a tracer");
        for x in 0..11 {
            for y in 0..11 {
                for z in 0..11 {
                    let point = [x, y, z];
                    let holds = |&[lo, hi]: &Box3, by| (0..3).all(|k| lo[k] - by < point[k] && point[k] < hi[k] + by);
                    let (within, near) = (
                        boxes.iter().filter(|it| holds(it, 0)).count(),
                        boxes.iter().filter(|it| holds(it, 1)).count(),
                    );
                    for rule in [Rule::Parity, Rule::Nonzero, Rule::Winding] {
                        let is_inside = match rule {
                            Rule::Parity => within % 2 == 1,
                            Rule::Nonzero => within > 0,
                            Rule::Winding => within > 0 && round % 2 == 0,
                        };
                        let expected = match (near > within, is_inside) {
                            (true, _) => Location::Surface,
                            (false, true) => Location::Inside,
                            (false, false) => Location::Outside,
                        };
                        counts[expected as usize] += 1;
                        counts[3] += usize::from(within > 1);
                        let at = V::from(Vec3::from(point.map(|x| x as f32)));
                        let by_wide = Solid::new(&wide, &mesh, &boundary, rule).expect("closed");
                        let by_binary = Solid::new(&binary, &mesh, &boundary, rule).expect("closed");
                        let located = [by_wide.locate(at), by_binary.locate(at)];
                        assert_eq!(located, [Ok(expected); 2], "{boxes:?} {point:?} {rule:?}");
                        let distance = boxes.iter().map(|it| square_to_surface(it, point)).min().map(f64::from);
                        let distance = distance.expect("a box").sqrt() * if is_inside { -1.0 } else { 1.0 };
                        let measured = [by_wide.signed_distance(at), by_binary.signed_distance(at)];
                        // Signs of zeros are not compared.
                        let expected = V::Real::rounded(distance + 0.0);
                        assert_eq!(measured, [Ok(expected); 2], "{boxes:?} {point:?} {rule:?}");
                    }
                }
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}

#[test]
fn points_are_where_the_boxes_say_in_single() {
    points_are_where_the_boxes_say::<Vec3>();
}

#[test]
fn points_are_where_the_boxes_say_in_double() {
    points_are_where_the_boxes_say::<DVec3>();
}

#[test]
fn a_rule_that_does_not_fit_says_why() {
    let whole = faces([[0; 3], [2; 3]], 6);
    let refused = |faces: &[_], rule| {
        let mesh: Mesh = mesh(faces);
        let (tracer, boundary) = (Tracer::of(&mesh).expect("a tree"), Boundary::of(&mesh));
        assert!(Solid::new(&tracer, &mesh, &boundary, Rule::Winding).is_ok());
        Solid::new(&tracer, &mesh, &boundary, rule).map_err(|error| error.to_string()).err()
    };
    assert_eq!(refused(&whole, Rule::Nonzero), None);
    let open = "the mesh is open: 3 edges are covered an odd number of times, first that of faces[0] from vertex 0 to vertex 1; rule `winding` fits";
    assert_eq!(refused(&whole[1..], Rule::Parity).as_deref(), Some(open));
    let mut turned = whole;
    turned[3].swap(0, 1);
    assert_eq!(refused(&turned, Rule::Parity), None);
    let unoriented = "the mesh is not oriented: faces run through 3 edges more often in one direction than in the other; rule `parity` fits";
    assert_eq!(refused(&turned, Rule::Nonzero).as_deref(), Some(unoriented));
}

#[test]
fn points_that_are_no_numbers_are_refused() {
    let mesh: Mesh = mesh(&faces([[0; 3], [2; 3]], 6));
    let (tracer, boundary) = (Tracer::of(&mesh).expect("a tree"), Boundary::of(&mesh));
    let solid = Solid::new(&tracer, &mesh, &boundary, Rule::default()).expect("closed");
    let point = Vec3::new(1.0, f32::NAN, 0.0);
    assert!(matches!(solid.locate(point), Err(RayError::Origin(_))));
    assert!(matches!(solid.signed_distance(point), Err(RayError::Origin(_))));
}

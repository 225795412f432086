use glam::Vec3;

use super::*;
use crate::generate::{Rng, Source, procedural, stress};
use crate::geom::Mesh;
use crate::geom::lanes::Precision;
use crate::trace::Tracer;

/// Returns the sum over all triangles.
fn direct<V: Vector>(mesh: &Mesh<V>, point: V) -> f64 {
    let angle = |i| {
        let [a, b, c] = mesh.triangle(i).map(|v: V| v.widen() - point.widen());
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let bottom = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(bottom)
    };
    (0..mesh.triangles().len()).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn in_precision<V: Vector>(mesh: &Mesh, moved: Vec3) -> Mesh<V> {
    let vertices = mesh.vertices().iter().map(|&v| V::from(v + moved)).collect();
    Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh")
}

/// Spheres with holes, with duplicate or reversed faces, and loose triangles. [WINDING-1] [WINDING-2]
fn numbers_are_those_of_the_direct_sum<V: Precision>() {
    let (mut random, mut fractions, mut near, mut worst) = (Rng::new(2), 0, 0, 0.0_f64);
    let sphere = stress::icosphere(2, 1.0, Vec3::ZERO).expect("a mesh");
    let soup = procedural::soup(3, 60);
    for round in 0..16 {
        let mut faces = if round % 4 == 3 { soup.triangles().to_vec() } else { sphere.triangles().to_vec() };
        for _ in 0..round {
            let at = random.below(faces.len() as u64) as usize;
            match random.below(3) {
                0 => drop(faces.swap_remove(at)),
                1 => faces.push(faces[at]),
                _ => faces[at].swap(0, 1),
            }
        }
        let vertices = if round % 4 == 3 { soup.vertices() } else { sphere.vertices() };
        let mesh = Mesh::new(vertices.to_vec(), faces).expect("a mesh");
        let mesh: Mesh<V> = in_precision(&mesh, Vec3::new(0.0, 0.0, (round % 3) as f32));
        let (tracer, boundary) = (Tracer::of(&mesh).expect("a tree"), Boundary::of(&mesh));
        let winding = Winding::new(&tracer, &mesh, &boundary);
        let whole = winding.with_tolerance(0.0);
        assert_eq!(boundary.borders.is_empty(), boundary.is_oriented());
        for i in 0..200 {
            let mut unit = || random.below(1 << 20) as f32 / (1 << 19) as f32 - 1.0;
            let point = V::from(Vec3::new(unit(), unit(), unit()) * 1.5);
            // Also exactly below vertices: a direction toward an end of the border is not used.
            let below = mesh.vertices()[i % mesh.vertices().len()].widen() - DVec3::X * 0.25;
            let below = V::from_components([below.x, below.y, below.z].map(V::Real::rounded));
            for point in [point, below] {
                let (number, expected) = (whole.number(point).expect("finite"), direct(&mesh, point));
                let fast = winding.number(point).expect("finite");
                assert!((fast - number).abs() < 1e-6, "{round} {point:?}: {fast}, {number}");
                // The direct sum is unreliable if the point is on a triangle or almost on it.
                let is_near =
                    tracer.nearest(&crate::geom::Ball::new(point, V::Real::rounded(1e-3)).expect("a ball")).is_some();
                near += usize::from(is_near);
                if !is_near {
                    worst = worst.max((number - expected).abs());
                    assert!((number - expected).abs() < 1e-9, "{round} {point:?}: {number}, {expected}");
                }
                fractions += usize::from(number.fract() != 0.0);
                if boundary.is_oriented() {
                    assert_eq!(number.fract(), 0.0);
                }
            }
        }
    }
    assert!(fractions > 3000 && near < 1000 && worst < 1e-11, "{fractions} {near} {worst:e}");
}

#[test]
fn numbers_are_those_of_the_direct_sum_in_single() {
    numbers_are_those_of_the_direct_sum::<Vec3>();
}

#[test]
fn numbers_are_those_of_the_direct_sum_in_double() {
    numbers_are_those_of_the_direct_sum::<DVec3>();
}

/// A cube without some of its triangles, from its middle. Each has a twelfth of the solid angle, and rays along the
/// axes hit edges of the border. [WINDING-2]
#[test]
fn rays_through_the_border_are_not_taken() {
    let corners = (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)));
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let faces: Vec<[u32; 3]> = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let corners: Vec<_> = corners.collect();
    for missing in 0..1_u32 << 12 {
        let left: Vec<_> = (0..12).filter(|i| missing >> i & 1 == 0).map(|i| faces[i]).collect();
        if left.is_empty() || missing % 7 > 0 && missing.count_ones() > 2 {
            continue;
        }
        let expected = left.len() as f64 / 12.0;
        let mesh = Mesh::new(corners.clone(), left).expect("a mesh");
        let (tracer, boundary) = (Tracer::of(&mesh).expect("a tree"), Boundary::of(&mesh));
        let number = Winding::new(&tracer, &mesh, &boundary).number(DVec3::splat(0.5)).expect("finite");
        assert!((number - expected).abs() < 1e-12, "{missing:b}: {number}");
    }
}

/// A square, seen from points ever nearer to one of its edges. Its solid angle tends to the angle at the edge.
/// [WINDING-2]
#[test]
fn numbers_are_right_near_the_border() {
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    let (tracer, boundary) = (Tracer::of(&mesh).expect("a tree"), Boundary::of(&mesh));
    let winding = Winding::new(&tracer, &mesh, &boundary);
    for exponent in 1..60 {
        let by = 2f64.powi(-exponent);
        // Above and below the plane; above the edge, inside it and outside it.
        for (above, aside, limit) in [(by, 0.0, 0.25), (by, by, 0.375), (by, -by, 0.125), (by, by * 1e-3, 0.25)] {
            for side in [1.0, -1.0] {
                let number = winding.number(DVec3::new(0.5, aside, side * above)).expect("finite");
                let error = 2.0 * by + 1e-9 + aside.abs() / above * f64::from(u8::from(limit == 0.25));
                assert!((number + side * limit).abs() <= error, "{above} {aside} {side}: {number}");
            }
        }
    }
    for huge in [1e300, -1e300, f64::MAX] {
        assert!(winding.number(DVec3::new(huge, 0.25, huge)).expect("finite").abs() < 1e-9);
    }
    // Almost on an edge.
    assert!(winding.number(DVec3::new(1e-300, 0.25, 1e-300)).expect("finite").is_finite());
    assert!(winding.number(DVec3::new(f64::NAN, 0.0, 0.0)).is_err());
}

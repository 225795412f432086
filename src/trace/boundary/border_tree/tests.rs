use super::*;
use crate::generate::Rng;
use crate::geom::{Mesh, fan};
use crate::trace::Boundary;

/// Returns a wavy ring of `n` edges around a point.
fn ring(n: u32, center: DVec3, size: f64) -> Vec<DVec3> {
    let at = |i| {
        let angle = f64::from(i) / f64::from(n) * 2.0 * PI;
        center + DVec3::new(angle.cos(), angle.sin(), (3.0 * angle).sin() * 0.5) * size
    };
    (0..n).map(at).collect()
}

/// Returns cones with the rings as their borders.
fn cones(rings: &[Vec<DVec3>]) -> Mesh<DVec3> {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for ring in rings {
        let (first, n) = (vertices.len() as u32, ring.len() as u32);
        vertices.extend(ring);
        vertices.push(ring.iter().sum::<DVec3>() / f64::from(n) + DVec3::Z);
        faces.extend((0..n).map(|i| [first + i, first + (i + 1) % n, first + n]));
    }
    Mesh::new(vertices, faces).expect("a mesh")
}

/// Returns the number of visited edges, and the greatest difference from the sum over all edges.
fn compare(mesh: &Mesh<DVec3>, tolerance: f64, seed: u64) -> [f64; 2] {
    let boundary = Boundary::of(mesh);
    let tree = boundary.tree(mesh.vertices());
    let count: u32 = boundary.borders.iter().map(|border| border.faces).sum();
    assert_eq!(tree.edges.len(), count as usize);
    let (mut random, mut shown, mut worst) = (Rng::new(seed), 0.0, 0.0_f64);
    for round in 0..300 {
        let mut unit = || random.bits() as f64 * 2f64.powi(-63) - 1.0;
        let (point, e) = (DVec3::new(unit(), unit(), unit()) * 20.0, DVec3::new(unit(), unit(), unit()).normalize());
        let e = if round % 2 == 0 { e } else { (mesh.vertices()[round % mesh.vertices().len()] - point).normalize() };
        let all: f64 = tree.edges.iter().map(|&edge| fan::share(point, edge, e)[0]).sum();
        let mut sum = 0.0;
        let far = tree.fan(point, e, tolerance, |edge| {
            sum += fan::share(point, edge, e)[0];
            shown += 1.0 / 300.0;
        });
        worst = worst.max((sum + far - all).abs());
    }
    [shown, worst]
}

/// [WINDING-3]
#[test]
fn what_is_left_out_is_within_the_tolerance() {
    let mut random = Rng::new(5);
    let mut place = || DVec3::from([(); 3].map(|()| random.bits() as f64 * 2f64.powi(-63) - 1.0)) * 10.0;
    let one = cones(&[ring(1000, DVec3::ZERO, 1.0)]);
    let many: Vec<_> = (0..600).map(|i| ring(3 + i % 4, place(), 0.3)).collect();
    for (mesh, fewest) in [(one, 0.1), (cones(&many), 0.3)] {
        let mut last = f64::INFINITY;
        for tolerance in [0.0, 1e-9, 1e-6, 1e-3] {
            let [shown, worst] = compare(&mesh, tolerance, 9);
            // The sum itself rounds.
            assert!(worst <= tolerance + 1e-12, "{tolerance}: {worst:e}");
            assert!(shown <= last, "{tolerance}: {shown}");
            last = shown;
        }
        let all = compare(&mesh, 0.0, 9)[0];
        assert!(last < fewest * all, "{last} of {all}");
    }
}

/// Two triangles that share a vertex, and an edge of two faces.
#[test]
fn loops_have_each_edge_as_often_as_it_counts() {
    let border = |from, to, faces| Border { ends: [from, to], faces };
    let borders = [
        border(0, 1, 1),
        border(1, 2, 1),
        border(2, 0, 2),
        border(0, 3, 1),
        border(3, 4, 1),
        border(4, 2, 1),
        border(2, 5, 1),
        border(5, 2, 1),
    ];
    let mut found: Vec<_> = loops(&borders).concat();
    let all = loops(&borders);
    assert!(all.len() >= 3, "{all:?}");
    for path in &all {
        assert!(path.windows(2).all(|pair| pair[0][1] == pair[1][0]), "{path:?}");
        assert_eq!(path[0][0], path[path.len() - 1][1]);
        let mut starts: Vec<_> = path.iter().map(|edge| edge[0]).collect();
        starts.sort_unstable();
        assert!(starts.windows(2).all(|pair| pair[0] != pair[1]), "{path:?}");
    }
    let mut expected: Vec<_> = borders.iter().flat_map(|border| vec![border.ends; border.faces as usize]).collect();
    found.sort_unstable();
    expected.sort_unstable();
    assert_eq!(found, expected);
}

/// Sizes whose powers would overflow or underflow, and edges on the ray, are left to the exact sum.
#[test]
fn what_is_not_usual_is_shown() {
    for (scale, is_taken) in [(1e-70, false), (1e-50, true), (1.0, true), (1e50, true), (1e70, false), (1e160, false)] {
        let ring: Vec<_> = ring(64, DVec3::ZERO, 1.0).into_iter().map(|p| p * scale).collect();
        let mut vertices = ring;
        vertices.push(DVec3::Z * scale);
        let mesh = Mesh::new(vertices, (0..64).map(|i| [i, (i + 1) % 64, 64]).collect()).expect("a mesh");
        let (boundary, point) = (Boundary::of(&mesh), DVec3::Y * 1e4 * scale);
        let shown = |e: DVec3| {
            let mut shown = 0;
            boundary.tree(mesh.vertices()).fan(point, e, 1e-6, |_| shown += 1);
            shown
        };
        assert_eq!(shown(DVec3::X) == 0, is_taken, "{scale:e}");
        assert!(shown(DVec3::NEG_Y) > 0, "{scale:e}");
    }
}

//! Double precision, compared with rational arithmetic. (The tests of the parent module cover single precision.)

use glam::DVec3;

use super::*;
use crate::bvh::{BuildOptions, Degenerate, SahOptions, validate};
use crate::generate::{Rng, Source};
use crate::geom::Mesh;
use crate::trace::crossings::AllHits64;
use crate::trace::truth::Truth;
use crate::traverse::{Stack, traverse};

/// Draws a number in -1..1 with 53 bits.
fn unit(random: &mut Rng) -> f64 {
    (random.bits() >> 10) as f64 / 2f64.powi(53) - 1.0
}

fn point(random: &mut Rng) -> DVec3 {
    DVec3::new(unit(random), unit(random), unit(random))
}

/// Returns small triangles within -10..10.
fn soup(seed: u64, n: usize) -> Mesh<DVec3> {
    let mut random = Rng::new(seed);
    let corners = (0..n).flat_map(|_| {
        let (place, size) = (point(&mut random) * 9.0, unit(&mut random).abs() * 3.0);
        [(); 3].map(|()| place + point(&mut random) * size)
    });
    separate(corners.collect())
}

fn separate(corners: Vec<DVec3>) -> Mesh<DVec3> {
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::new(corners, triangles).expect("a mesh")
}

/// Returns a closed cube of `n` squares along an edge, with integer corners and two triangles per square.
fn cube(n: u32) -> Mesh<DVec3> {
    let squares = (0..6 * n * n).flat_map(|i| {
        let (face, x, y) = (i / (n * n), i % n, i / n % n);
        let at = |x: u32, y: u32| {
            let mut corner = [x, y, n * (face % 2)].map(f64::from);
            corner.rotate_right(face as usize / 2);
            DVec3::from(corner)
        };
        let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        [a, b, c, b, d, c]
    });
    separate(squares.collect())
}

fn moved(mesh: &Mesh<DVec3>, to: impl Fn(DVec3) -> DVec3) -> Mesh<DVec3> {
    Mesh::new(mesh.vertices().iter().map(|&v| to(v)).collect(), mesh.triangles().to_vec()).expect("a mesh")
}

/// Returns rays at corners, midpoints of edges and other points close to the mesh, from corners and from other points,
/// also along axes, with and without ends.
fn rays(mesh: &Mesh<DVec3>, seed: u64, n: usize) -> Vec<Ray<DVec3>> {
    let mut random = Rng::new(seed);
    let corners = mesh.vertices();
    let (lo, hi) = corners.iter().fold((corners[0], corners[0]), |(lo, hi), &v| (lo.min(v), hi.max(v)));
    let ray = |i: usize| {
        let [a, b, _] = mesh.triangle(random.below(mesh.triangles().len() as u64) as usize);
        let any = lo * 0.5 + hi * 0.5 + (hi * 0.5 - lo * 0.5) * point(&mut random);
        let aim = [a, a * 0.5 + b * 0.5, any][i % 3];
        let mut origin = [corners[random.below(corners.len() as u64) as usize], any * 2.0 - aim, any][i / 3 % 3];
        if i % 4 == 3 {
            let axis = random.below(3) as usize;
            origin = aim.with_x(aim.x);
            origin[axis] = any[axis];
        }
        let direction = (aim - origin) * [1.0, 1.0, 1.0 / 3.0, 1e-30][random.below(4) as usize];
        let [tmin, tmax] =
            [[0.0, f64::INFINITY], [0.0, 1.0], [1.0, f64::INFINITY], [0.5, 1.5]][random.below(4) as usize];
        Ray::within(origin, direction, tmin, tmax).ok()
    };
    (0..n).filter_map(ray).collect()
}

fn bits(hit: Hit<f64>) -> (u32, [u64; 3]) {
    let Hit { prim, t, u, v } = hit;
    (prim, [t, u, v].map(f64::to_bits))
}

/// Compares every answer of both kinds of trees with the exact one. Returns the number of hits.
fn compare(mesh: &Mesh<DVec3>, rays: &[Ray<DVec3>]) -> usize {
    let options = SahOptions { max_leaf: 3, ..SahOptions::default() };
    let trees = [Bvh::sah(mesh, options), Bvh::median(mesh, 1), Bvh::median(mesh, 4)].map(|tree| tree.expect("a tree"));
    for bvh in &trees {
        validate(bvh, mesh).expect("sound");
    }
    let (truth, mut hits) = (Truth::new(mesh), 0);
    for ray in rays {
        let expected: Vec<_> = truth.all(ray).iter().map(|hit| bits(hit.rounded())).collect();
        hits += usize::from(!expected.is_empty());
        for bvh in &trees {
            let mut memory = Vec::new();
            let mut closest = Closest64::new(bvh, ray);
            traverse(Stack::new(bvh, &mut memory), &mut closest, &mut ());
            assert_eq!(closest.hit().map(bits).as_ref(), expected.first(), "{ray:?}");
            let mut any = Any64::new(bvh, ray);
            traverse(Stack::new(bvh, &mut memory), &mut any, &mut ());
            assert!(any.hit().map(bits).is_none_or(|hit| expected.contains(&hit)), "{ray:?}");
            assert_eq!(any.hit().is_some(), !expected.is_empty(), "{ray:?}");
            let mut all = AllHits64::new(bvh, ray);
            traverse(Stack::new(bvh, &mut memory), &mut all, &mut ());
            assert!(all.into_hits().into_iter().map(bits).eq(expected.iter().copied()), "{ray:?}");
        }
    }
    hits
}

fn compare_well(mesh: &Mesh<DVec3>, seed: u64, n: usize) {
    let rays = rays(mesh, seed, n);
    let hits = compare(mesh, &rays);
    assert!(rays.len() * 3 > n * 2 && hits * 4 > rays.len(), "{hits} of {}", rays.len());
}

#[test]
fn tame_doubles() {
    for (seed, n) in [(1, 1), (2, 3), (3, 40), (4, 400)] {
        let mesh = soup(seed, n);
        compare_well(&mesh, seed, 600);
    }
}

#[test]
fn the_integer_lattice() {
    compare_well(&cube(1), 5, 600);
    compare_well(&cube(7), 6, 1000);
}

#[test]
fn far_from_the_origin() {
    for (seed, offset) in (10..).zip([1e6, 1e12, -1e15]) {
        compare_well(&moved(&cube(5), |v| v + offset), seed, 400);
        compare_well(&moved(&soup(seed, 100), |v| v + DVec3::new(offset, 1.0, -offset)), seed, 400);
    }
}

#[test]
fn at_any_scale() {
    for (seed, scale) in (20..).zip([1e-100, 1e-61, 1e-50, 1e-30, 1e30, 1e37, 1e50, 1e100]) {
        compare_well(&moved(&soup(seed, 40), |v| v * scale), seed, 100);
        compare_well(&moved(&cube(3), |v| v * scale), seed, 100);
    }
    let stretched = moved(&cube(4), |v| v * DVec3::new(1e-90, 1.0, 1e20));
    assert!(compare(&stretched, &rays(&stretched, 30, 200)) > 50);
}

#[test]
fn where_doubles_over_and_underflow() {
    for (seed, scale) in (40..).zip([1e300, 1e-300, 1e-320]) {
        for mesh in [soup(seed, 20), cube(2)] {
            let mesh = moved(&mesh, |v| v * scale);
            let hits = compare(&mesh, &rays(&mesh, seed, 60));
            assert!(hits > 10, "{hits} at {scale}");
        }
    }
    // Numbers of all magnitudes.
    let mut random = Rng::new(50);
    let mut hits = 0;
    for round in 0..30 {
        let mut number = || loop {
            let x = f64::from_bits(random.bits());
            if x.is_finite() {
                return if random.below(8) == 0 { 0.0 } else { x };
            }
        };
        let mesh = separate((0..24).map(|_| DVec3::new(number(), number(), number())).collect());
        hits += compare(&mesh, &rays(&mesh, round, 12));
    }
    assert!(hits > 30, "{hits}");
}

#[test]
fn degenerate_triangles_are_left_out_at_any_scale() {
    for scale in [1.0, 1e-70, 1e-310, 1e300] {
        let line = [1.0, 2.0, 3.0].map(|x| DVec3::new(x, 2.0 * x, 0.0) * scale);
        let [a, b, c] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| v * scale);
        // Exactly on a line or an ulp off it; three points; a valid mesh.
        let off = DVec3::new(line[2].x, line[2].y.next_up(), 0.0);
        let mesh = separate([line, [line[0], line[1], off], [a; 3], [a, b, c]].concat());
        let left_out = BuildOptions { degenerate: Degenerate::LeftOut, ..BuildOptions::default() };
        let bvh = left_out.build(&mesh).expect("a tree");
        assert_eq!(bvh.dropped(), 2, "{scale}");
        validate(&bvh, &mesh).expect("sound");
    }
}

#[test]
fn the_nearest_of_triangles_that_single_precision_cannot_tell_apart() {
    // Three parallel triangles, one double-precision ulp apart, the nearest one last.
    let at = |z: f64| [DVec3::new(-1.0, -1.0, z), DVec3::new(3.0, -1.0, z), DVec3::new(-1.0, 3.0, z)];
    let mesh = separate([at(1f64.next_up().next_up()), at(1f64.next_up()), at(1.0)].concat());
    for bvh in [Bvh::median(&mesh, 1), Bvh::sah(&mesh, SahOptions::default())].map(|tree| tree.expect("a tree")) {
        let ray = Ray::new(DVec3::ZERO, DVec3::Z).expect("a ray");
        let mut closest = Closest64::new(&bvh, &ray);
        traverse(Stack::new(&bvh, &mut Vec::new()), &mut closest, &mut ());
        assert_eq!(closest.found(), Some((2, 1.0)));
    }
}

//! Faces without area are segments and points, which have nearest points. Rays miss them.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{self, BuildOptions, Builder, Bvh, Degenerate, SpatialOptions, WideBvh};
use stackless_bvh::generate::{Rng, Source, procedural};
use stackless_bvh::geom::{Mesh, Precision, Ray, Real, Triangle, Vector};
use stackless_bvh::trace::{BinaryTracer, MeshQueries, RayQueries, Tracer};
use stackless_bvh::traverse::Method;
use stackless_check::{check_nearest, nearest as truth};

use super::{all, ball, point};

/// Three corners on a line: of different lengths, two of them equal, or all.
fn on_a_line(random: &mut Rng) -> [Vec3; 3] {
    let mut whole = |size: u64| random.below(2 * size + 1) as f32 - size as f32;
    let [a, way] = [(); 2].map(|()| Vec3::new(whole(8), whole(8), whole(8)) / 4.0);
    [a, a + way * whole(3), a + way * whole(3)]
}

/// Such faces alone, each twice; and among faces with an area, which are cut.
fn meshes() -> [Mesh; 2] {
    let mut random = Rng::new(17);
    let flat: Vec<_> = (0..60).flat_map(|_| on_a_line(&mut random)).collect();
    let faces = |count: usize| (0..count as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let twice = faces(flat.len()).chain(faces(flat.len())).collect();
    let soup = procedural::soup(3, 40);
    let among = soup.triangles().iter().flat_map(|face| face.map(|i| soup.vertices()[i as usize] * 3.0));
    let among: Vec<_> = among.chain(flat.iter().copied()).collect();
    let faces = faces(among.len()).collect();
    [Mesh::new(flat, twice), Mesh::new(among, faces)].map(|mesh| mesh.expect("a mesh"))
}

fn options(builder: Builder) -> BuildOptions {
    let spatial = SpatialOptions { extra_percent: 200, overlap: 0.0 };
    BuildOptions { builder, spatial, ..BuildOptions::fine() }
}

/// A former version omitted the face next to the point.
#[test]
fn the_nearest_face_may_be_a_segment() {
    let corners = [[2.25, -8.0, 16.5], [-0.5, -8.0, 16.5], [-0.5, -8.0, 16.5], [99.0, 99.0, 99.0], [99.0, 100.0, 99.0]];
    let mut corners: Vec<_> = corners.map(Vec3::from_array).into();
    corners.push(Vec3::new(100.0, 99.0, 99.0));
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [3, 4, 5]]).expect("a mesh");
    let ball = ball(Vec3::new(1.0, -8.0, 16.75), f64::INFINITY);
    let nears =
        [BinaryTracer::of(&mesh).expect("a tracer").nearest(&ball), Tracer::of(&mesh).expect("one").nearest(&ball)];
    for near in nears.map(|near| near.expect("a face")) {
        assert_eq!((near.prim, near.distance, near.point), (0, 0.25, Vec3::new(1.0, -8.0, 16.5)));
    }
}

/// Returns how many faces without area were found.
fn check<V: Precision>(mesh: &Mesh<V>, bvh: &Bvh<Triangle<V>>, queries: u64) -> usize {
    bvh::validate(bvh, mesh).expect("sound");
    assert_eq!(bvh.dropped(), 0);
    let mut random = Rng::new(5);
    let found = (0..queries).flat_map(|i| {
        let (point, k) = (point(mesh, &mut random), [1, 4, 300][i as usize % 3]);
        let radius = V::Real::rounded([f64::INFINITY, 1.0][i as usize % 2]);
        check_nearest(bvh, mesh, point, radius, k).unwrap_or_else(|fault| panic!("{fault}: {point:?} {k}"));
        truth(mesh, point, radius, k)
    });
    found.filter(|&(_, prim)| Triangle(mesh.triangle(prim as usize)).is_degenerate()).count()
}

/// Returns the faces in reverse: some faces lose their area, and some get one.
fn reversed<V: Vector>(mesh: &Mesh<V>) -> Mesh<V> {
    let faces = mesh.triangles().iter().rev().copied().collect();
    Mesh::new(mesh.vertices().to_vec(), faces).expect("a mesh")
}

/// [NEAR-1] [NEAR-2] [NEAR-3]
#[test]
fn faces_without_area_are_found_in_all_trees() {
    let mut found = 0;
    for mesh in meshes() {
        for builder in Builder::ALL {
            let mut bvh = options(builder).build(&mesh).expect("a tree");
            found += check(&mesh, &bvh, 60);
            let mut wide = WideBvh::of(&bvh).expect("a wide one");
            let mut binary = BinaryTracer::new(bvh.clone());
            for moved in [&mesh, &reversed(&mesh)] {
                bvh.refit(moved).expect("as many");
                wide.refit(moved).expect("as many");
                wide.validate(moved).expect("sound");
                found += check(moved, &bvh, 30);
                binary = BinaryTracer::new(bvh.clone());
                let (tracer, mut random) = (Tracer::new(&wide), Rng::new(6));
                for k in 1..60 {
                    let ball = ball(point(moved, &mut random), f64::INFINITY);
                    assert_eq!(tracer.nearest_k(&ball, k), binary.nearest_k(&ball, k), "{builder} {ball:?} {k}");
                    assert_eq!(tracer.nearest(&ball), binary.nearest(&ball), "{builder} {ball:?}");
                }
            }
            // Nothing of this is lost in bytes.
            let back = Bvh::from_bytes(&bvh.to_bytes()).expect("what was written");
            let ball = ball(Vec3::new(0.1, 0.2, 0.3), f64::INFINITY);
            assert_eq!(BinaryTracer::new(&back).nearest_k(&ball, 200), binary.nearest_k(&ball, 200));
        }
    }
    assert!(found > 20_000, "{found}");
}

/// Whole coordinates, far away, and of sizes at the ends of what twice the digits are taken of.
#[test]
fn faces_without_area_are_found_in_double_precision() {
    let mut found = 0;
    for mesh in meshes() {
        for (far, scale) in [(0.0, 1.0), (6.4e6, 1.0), (0.0, 1e-70), (1.0, 1e70)] {
            let vertices = mesh.vertices().iter().map(|v| (v.as_dvec3() + far) * scale).collect();
            let mesh = Mesh::<DVec3>::new(vertices, mesh.triangles().to_vec()).expect("a mesh");
            for builder in Builder::ALL {
                let mut bvh = options(builder).build(&mesh).expect("a tree");
                found += check(&mesh, &bvh, 20);
                let reversed = reversed(&mesh);
                bvh.refit(&reversed).expect("as many");
                found += check(&reversed, &bvh, 10);
            }
        }
    }
    assert!(found > 10_000, "{found}");
}

/// Their trees have other nodes, and rays have the same answers. [EXACT-1] [PARITY-1]
#[test]
fn rays_miss_faces_without_area() {
    let [_, mesh] = meshes();
    let mut random = Rng::new(8);
    let rays: Vec<_> = (0..600)
        .filter_map(|i| {
            let [from, to]: [Vec3; 2] = [(); 2].map(|()| point(&mesh, &mut random));
            let to = if i % 2 == 0 { to } else { mesh.vertices()[120 + random.below(180) as usize] };
            Ray::new(from, to - from).ok()
        })
        .collect();
    let mut hits = 0;
    for builder in Builder::ALL {
        let [kept, left_out] = [Degenerate::Kept, Degenerate::LeftOut]
            .map(|degenerate| BuildOptions { degenerate, ..options(builder) }.build(&mesh).expect("a tree"));
        assert!(left_out.dropped() == 60 && kept.dropped() == 0, "{builder}");
        let wide = [&kept, &left_out].map(|bvh| Tracer::new(WideBvh::of(bvh).expect("a wide one")));
        let binary = [&kept, &left_out].map(|bvh| BinaryTracer::with_method(bvh, Method::Hashed));
        let binary = binary.map(|tracer| tracer.expect("a tracer"));
        for ray in &rays {
            assert_eq!(wide[0].closest(ray), wide[1].closest(ray), "{ray:?}");
            assert_eq!(wide[0].any(ray), wide[1].any(ray), "{ray:?}");
            assert_eq!(wide[0].crossings(ray), wide[1].crossings(ray), "{ray:?}");
            let all = [wide[0].all(ray), wide[1].all(ray)];
            assert_eq!(all[0], all[1], "{ray:?}");
            let by_binary = binary.each_ref().map(|tracer| tracer.all(ray));
            assert_eq!([&all[0]; 2], by_binary.each_ref(), "{ray:?}");
            hits += all[0].len();
        }
    }
    assert!(hits > 500, "{hits}");
}

/// A tree that left them out is for rays.
#[test]
fn what_was_left_out_is_not_found() {
    let [_, mesh] = meshes();
    let bvh = BuildOptions { degenerate: Degenerate::LeftOut, ..BuildOptions::default() }.build(&mesh).expect("a tree");
    let nears = BinaryTracer::new(&bvh).nearest_k(&ball(Vec3::ZERO, f64::INFINITY), 200);
    assert_eq!((bvh.dropped(), nears.len()), (60, 40));
    assert!(all(&nears).iter().all(|&(_, prim)| prim < 40));
}

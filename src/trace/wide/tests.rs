use super::*;
use crate::bvh::{BuildOptions, Builder, Bvh};
use crate::generate::{procedural, stress};
use crate::geom::{Mesh, lanes};
use crate::trace::{Tracer, Truth};

fn bits(hit: Option<Hit>) -> Option<(u32, [u32; 3])> {
    hit.map(|Hit { prim, t, u, v }| (prim, [t, u, v].map(f32::to_bits)))
}

/// All traversals and levels answer as `Tracer` does, bit for bit; returns the number of hits.
fn compare(mesh: &Mesh, rays: &[Ray], options: &BuildOptions) -> usize {
    let bvh = options.build(mesh).expect("a hierarchy");
    let (wide, binary) = (WideBvh::of(&bvh).expect("a wide one"), Tracer::new(&bvh));
    let expected: Vec<_> = binary.closest_each(rays).into_iter().map(bits).collect();
    for method in Method::ALL {
        for (name, level) in lanes::levels() {
            let tracer = WideTracer::with_method(&wide, method).expect("a tracer").with_level(level);
            let closest: Vec<_> = tracer.closest_each(rays).into_iter().map(bits).collect();
            assert_eq!(closest, expected, "{method} {name}");
            let any = tracer.any_each(rays);
            for (i, ray) in rays.iter().enumerate() {
                assert_eq!(bits(tracer.closest(ray)), expected[i], "{method} {name} {ray:?}");
                let is_hit = expected[i].is_some();
                assert_eq!((any[i], tracer.any(ray)), (is_hit, is_hit), "{method} {name} {ray:?}");
                assert_eq!(tracer.any_hit(ray).is_some(), is_hit);
            }
        }
    }
    expected.iter().flatten().count()
}

/// [DET-1] [LANES-1] [LANES-2] [LANES-3] [LANES-4] [WIDE-4] [WIDE-8]
#[test]
fn all_traversals_and_levels_answer_as_the_binary_tracer_does() {
    let meshes = [procedural::soup(1, 500), procedural::strands(2, 60), procedural::layers(40)];
    for mesh in &meshes {
        let rays = procedural::rays(mesh, 3, 300);
        for builder in Builder::ALL {
            for reinsertion in [0, 2] {
                let hits = compare(mesh, &rays, &BuildOptions { builder, reinsertion, ..BuildOptions::default() });
                assert!(hits > 20, "{hits}");
            }
        }
    }
}

#[test]
fn hard_rays_are_answered_as_by_the_binary_tracer() {
    let mut hits = 0;
    for case in stress::cases(60) {
        hits += compare(&case.mesh, &case.rays, &BuildOptions::default());
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn the_truth_is_the_answer() {
    let mesh = procedural::soup(4, 300);
    let (truth, rays) = (Truth::new(&mesh), procedural::rays(&mesh, 5, 400));
    let tracer = WideTracer::new(WideBvh::of(&Bvh::build(&mesh).unwrap()).unwrap());
    for ray in &rays {
        let expected = truth.closest(ray).map(|hit| hit.rounded());
        assert_eq!(bits(tracer.closest(ray)), bits(expected), "{ray:?}");
        assert_eq!(tracer.closest_distance(ray), expected.map(|hit| (hit.prim, hit.t)));
    }
    assert_eq!(tracer.closest_parallel(&rays), tracer.closest_each(&rays));
    assert_eq!(tracer.any_parallel(&rays), tracer.any_each(&rays));
}

#[test]
fn an_empty_hierarchy_and_no_rays() {
    let ray = Ray::new(glam::Vec3::ZERO, glam::Vec3::X).unwrap();
    for method in Method::ALL {
        let tracer = WideTracer::with_method(WideBvh::empty(), method).unwrap();
        assert_eq!((tracer.closest(&ray), tracer.any(&ray)), (None, false));
        assert_eq!(tracer.closest_each(&[ray; 3]), [None; 3]);
        assert_eq!(tracer.any_each(&[]), [false; 0]);
    }
}

/// Rays end in another order than they begin, and in each number that a turn can end with.
#[test]
fn each_answer_is_of_its_ray() {
    let mesh = procedural::soup(6, 200);
    let tracer = WideTracer::new(WideBvh::of(&Bvh::build(&mesh).unwrap()).unwrap());
    let rays = procedural::rays(&mesh, 7, 64);
    let expected: Vec<_> = rays.iter().map(|ray| tracer.closest_distance(ray)).collect();
    for count in 0..rays.len() {
        let mut found = vec![Some((7, 7.0)); rays.len()];
        tracer.closest_distances(&rays[..count], &mut found);
        assert_eq!(found[..count], expected[..count]);
        assert!(found[count..].iter().all(|&untouched| untouched == Some((7, 7.0))));
    }
}

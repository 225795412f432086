//! Rays from far away into instances test no more triangles than other rays, from any origin. `[INST-7]`

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::Builder;
use stackless_bvh::generate::draw::Draw;
use stackless_bvh::generate::stress;
use stackless_bvh::geom::{Mesh, Ray, Vector};
use stackless_bvh::trace::InstanceTracer;
use stackless_bvh::traverse::Method;
use stackless_check::{InstanceOracle, check_answer};

use super::scenes::{Kind, Scene, narrow, placed};
use super::{assembly, hierarchies, wide};

/// Draws rays through the unit ball or past it, from this distance: along an axis, through the middle, or in rounded
/// directions.
fn rays<V: Vector>(draw: &mut Draw, far: f64) -> Vec<Ray<V>> {
    let mut rays = Vec::new();
    for _ in 0..3 {
        let (axis, way) = (draw.axis().as_dvec3(), draw.ints(7).as_dvec3());
        let beside = (DVec3::ONE - axis.abs()) * draw.centred().as_dvec3();
        let at = draw.centred().as_dvec3() * far;
        for (o, d) in [(beside - axis * far, axis), (-way * far, way), (at, beside - at)] {
            rays.extend(Ray::new(narrow::<V>(o), narrow(d)));
        }
    }
    rays
}

fn few_triangles_are_tested_from_afar<V: Kind>(most: i32, step: usize) {
    let single = stress::icosphere(3, 1.0, Vec3::ZERO).expect("a sphere");
    let vertices = single.vertices().iter().map(|v| narrow(v.as_dvec3())).collect();
    let sphere: Mesh<V> = Mesh::new(vertices, single.triangles().to_vec()).expect("a sphere");
    let turn = [[0.8, -0.6, 0.0, 0.0], [0.6, 0.8, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let half = [[0.0, 0.5, 0.0, 0.1], [0.0, 0.0, 0.5, 0.0], [0.5, 0.0, 0.0, 0.0]];
    let (mut draw, mut hits, mut asked) = (Draw::new(1), 0, 0);
    for maps in [vec![half], vec![turn], vec![turn, half, turn]] {
        let shapes = placed(sphere.clone(), &maps);
        let (flat, scene) = (InstanceOracle::new(&shapes), Scene { name: format!("{maps:?}"), shapes });
        let tracers = [hierarchies(&scene, Builder::Standard, 1), wide(&scene, Builder::Standard, 1)].map(|built| {
            let (assembly, object) = assembly(&built, &scene);
            InstanceTracer::new(&assembly, object, Method::default()).expect("any tree")
        });
        for exponent in (0..most).step_by(step) {
            for ray in rays::<V>(&mut draw, 2f64.powi(exponent)) {
                let expected = flat.all(&ray);
                for tracer in &tracers {
                    check_answer(tracer, &expected, &ray)
                        .unwrap_or_else(|fault| panic!("{exponent}, {ray:?}: {fault}"));
                    let counts = [tracer.count_closest(&[ray]), tracer.count_any(&[ray])];
                    assert!(counts.iter().all(|counts| counts.triangles < 100), "{exponent}, {ray:?}: {counts:?}");
                }
                (asked, hits) = (asked + 1, hits + usize::from(!expected.is_empty()));
            }
        }
    }
    assert!(hits > asked / 4, "{hits} of {asked}");
}

#[test]
fn few_triangles_are_tested_from_afar_in_single() {
    few_triangles_are_tested_from_afar::<Vec3>(124, 9);
}

#[test]
fn few_triangles_are_tested_from_afar_in_double() {
    few_triangles_are_tested_from_afar::<DVec3>(126, 18);
}

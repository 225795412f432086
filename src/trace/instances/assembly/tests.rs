use glam::DVec3;

use super::*;
use crate::bvh::{Builder, SpatialOptions};
use crate::generate::draw::{Draw, one_of};
use crate::geom::{Mesh, Ray};
use crate::trace::{InstanceTracer, RayQueries};
use crate::traverse::Method;

/// Returns options for every builder, one of which splits triangles.
fn all_options() -> impl Iterator<Item = BuildOptions> {
    let spatial = SpatialOptions { extra_percent: 1000, overlap: 0.0 };
    Builder::ALL.into_iter().map(move |builder| BuildOptions { builder, spatial, ..BuildOptions::fine() })
}

/// Meshes placed so that the image ends close to the greatest float. Whether it fits must not depend on the builder:
/// for the mesh, for a group, for a group of groups, and for wide meshes. [INST-2]
fn what_leaves_the_range_depends_on_no_builder<V: Vector>(most: f64, scales: &[f64]) {
    let (mut draw, mut seen) = (Draw::new(1), [0; 2]);
    for round in 0..1000 {
        let scale = scales[draw.below(scales.len())];
        let vertices: Vec<V> = (0..12)
            .map(|_| {
                let v = (draw.centred() * draw.ints(3) + draw.ints(2)).as_dvec3() * scale;
                V::from_components(v.to_array().map(V::Real::rounded))
            })
            .collect();
        let triangles = (0..8).map(|_| [(); 3].map(|()| draw.below(12) as u32)).collect();
        let mesh = Mesh::new(vertices.clone(), triangles).expect("a mesh");
        let mut map = |reach: f64| {
            let reach = if draw.one_in(2) { reach } else { reach * f64::from(1 + draw.below(4) as u32) };
            let entry = (0..draw.below(4)).fold(V::Real::rounded(most / reach), |entry, _| entry.next_down());
            let turn = draw.below(3);
            let mut rows = [[V::Real::ZERO; 4]; 3];
            for (axis, row) in rows.iter_mut().enumerate() {
                row[(axis + turn) % 3] = entry;
                if draw.one_in(2) {
                    row[(axis + turn + 1) % 3] = V::Real::rounded(entry.into() * one_of([0.5, 0.3, -0.7], &mut draw));
                }
            }
            AffineMap::new(rows).ok()
        };
        let reach = vertices.iter().map(|v| v.widen().abs().max_element()).fold(0.0, f64::max);
        let (Some(inner), Some(outer)) = (map(reach * 1e3), map(most / 1e3)) else { continue };
        let mut fits = Vec::new();
        for options in all_options() {
            let mut assembly = Assembly::new();
            let bvh = options.build(&mesh).expect("a tree");
            let object = assembly.add_mesh(bvh);
            let place = |object, affine| vec![Instance { object, affine }];
            let group = assembly.add_group(place(object, inner), &options);
            let nested = group.and_then(|group| assembly.add_group(place(group, outer), &options));
            fits.push([group.is_ok(), nested.is_ok()]);
        }
        assert!(fits.iter().all(|fits_too| *fits_too == fits[0]), "{round}: {fits:?}");
        seen[usize::from(fits[0][1])] += 1;
    }
    assert!(seen.into_iter().all(|seen| seen > 50), "{seen:?}");
}

#[test]
fn what_leaves_the_range_depends_on_no_builder_in_single() {
    what_leaves_the_range_depends_on_no_builder::<Vec3>(f32::MAX.into(), &[1.0, 1e-3, 1e20, 1e-40]);
}

#[test]
fn what_leaves_the_range_depends_on_no_builder_in_double() {
    what_leaves_the_range_depends_on_no_builder::<DVec3>(f64::MAX, &[1.0, 1e-3, 1e100, 1e-310, 1e200]);
}

/// Far away, where floats are coarse, the box is rounded outwards. [INST-2]
#[test]
fn bounds_contain_all_images() {
    let mut draw = Draw::new(2);
    for round in 0..200 {
        let vertices: Vec<Vec3> = (0..9).map(|_| draw.centred()).collect();
        let mesh = Mesh::new(vertices.clone(), vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]]).expect("a mesh");
        let far = draw.centred() * 1e6;
        let mut assembly = Assembly::new();
        let object = assembly.add_mesh(Bvh::build(&mesh).expect("a tree"));
        let affine = AffineMap::translation(far).expect("a map");
        let group = assembly.add_group(vec![Instance { object, affine }], &BuildOptions::default()).expect("a group");
        let [lo, hi] = assembly.bounds(group).expect("bounds").map(Vec3::as_dvec3);
        for v in vertices {
            let image = v.as_dvec3() + far.as_dvec3();
            assert!(lo.cmple(image).all() && image.cmple(hi).all(), "{round}: {image} is not in {lo} to {hi}");
        }
        assert!((hi - lo).max_element() < 3.0, "{round}: {lo} to {hi}");
    }
}

/// Objects with equal numbers in two assemblies stay different objects in a third one. [INST-6]
#[test]
fn appended_objects_are_those_that_they_were() {
    let place = |object| Instance { object, affine: AffineMap::IDENTITY };
    let group = |assembly: &mut Assembly, objects: &[Object]| {
        let placed = objects.iter().map(|&object| place(object)).collect();
        assembly.add_group(placed, &BuildOptions::default()).expect("a group")
    };
    let [first, second] = [1.0, 2.0].map(|height| {
        let vertices = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|v| v + Vec3::Z * height).to_vec();
        let mesh = Mesh::new(vertices, vec![[0, 1, 2]]).expect("a mesh");
        let mut assembly = Assembly::new();
        let object = assembly.add_mesh(Bvh::build(&mesh).expect("a tree"));
        let group = group(&mut assembly, &[object]);
        (assembly, group)
    });
    let mut both = Assembly::new();
    let [low, high] = [first, second].map(|(assembly, group)| both.append(&assembly)(group));
    let root = group(&mut both, &[high, low]);
    assert_eq!((both.levels(root), both.bounds(root)), (3, Some([Vec3::Z, Vec3::new(1.0, 1.0, 2.0)])));
    let tracer = InstanceTracer::new(&both, root, Method::default()).expect("any tree");
    let ray = Ray::new(Vec3::new(0.25, 0.25, 0.0), Vec3::Z).expect("a ray");
    let hits: Vec<_> = tracer.all(&ray).into_iter().map(|hit| (hit.path, hit.t)).collect();
    assert_eq!(hits, [(vec![1, 0], 1.0), (vec![0, 0], 2.0)]);
    assert!(both.bounds(Object(9)).is_none());
}

//! Targets of hierarchies: builders, refit, files, instances.

use arbitrary::Unstructured;
use glam::DVec3;
use stackless_bvh::bvh::wide::WideOptions;
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, Degenerate, SahOptions, SpatialOptions, WideBvh};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::{AffineMap, Ends, Mesh, Precision, Ray, Real, Triangle};
use stackless_bvh::hash::checksum;
use stackless_bvh::trace::{Assembly, InstanceError, InstanceTracer, RayQueries, Tracer};
use stackless_bvh::traverse::Method;
use stackless_bvh::tree::{Recorded, Topology};
use stackless_bvh::wide;
use stackless_check::{
    Exactly, Heading, Hierarchies, InstanceOracle, Leg, Shape, check_held, check_instances, check_path, check_trees,
};

use super::draw::{Draw, patched};
use super::right;

/// Checks every builder on a small mesh of arbitrary numbers: the hierarchy is valid and answers rays correctly.
/// `[DET-1]`
pub(crate) fn builders(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let options = options(&mut draw);
    if draw.below(4) == 1 {
        let Some(mesh) = mesh_64(&mut draw, 6) else { return };
        let rays: Vec<_> = (0..3).filter_map(|i| draw.ray_64(mesh.triangle(i % mesh.triangles().len()))).collect();
        return check_builders(&mesh, &rays, options);
    }
    let Some(mesh) = draw.mesh(12) else { return };
    let rays = draw.rays(&mesh, 4);
    check_builders(&mesh, &rays, options);
}

fn check_builders<V: Precision>(mesh: &Mesh<V>, rays: &[Ray<V>], options: BuildOptions) {
    for builder in Builder::ALL {
        let options = BuildOptions { builder, ..options };
        if let Some((bvh, wide)) = built(mesh, options) {
            right(check_trees(&bvh, &wide, mesh, rays), format_args!("{options:?}\n{mesh:?}\n{rays:?}"));
        }
    }
}

fn mesh_64(draw: &mut Draw<'_>, most: u64) -> Option<Mesh<DVec3>> {
    let triangles = draw.triangles(most);
    let count = triangles.iter().flatten().max().map_or(1, |&last| last + 1);
    Mesh::new((0..count).map(|_| draw.point_64()).collect(), triangles).ok()
}

/// Refits hierarchies to other vertices. `[BUILD-7]`
pub(crate) fn refit(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let options = BuildOptions { builder: draw.one_of(Builder::ALL), ..options(&mut draw) };
    let Some(mesh) = draw.mesh(8) else { return };
    let Ok(moved) = Mesh::new(draw.vertices(mesh.triangles()), mesh.triangles().to_vec()) else { return };
    let rays = draw.rays(&moved, 4);
    let Some((mut bvh, mut wide)) = built(&mesh, options) else { return };
    let before = format!("{bvh:?} {wide:?}");
    let refitted = [bvh.refit(&moved), wide.refit(&moved)];
    if refitted == [Ok(()); 2] {
        if draw.coin() {
            wide.optimize().expect("memory");
        }
        right(check_trees(&bvh, &wide, &moved, &rays), format_args!("{mesh:?}\n{moved:?}\n{rays:?}"));
    } else {
        assert_eq!((refitted[0], format!("{bvh:?} {wide:?}")), (refitted[1], before), "a refusal changes nothing");
    }
}

/// Reads bytes that may be a hierarchy: valid ones, changed ones, and any; mostly with a valid checksum. `[FILE-5]`
/// `[FILE-8]`
pub(crate) fn bvh_bytes(bytes: &[u8]) {
    let (head, rest) = bytes.split_at(bytes.len().min(160));
    let mut draw = Draw::new(head);
    let kind = draw.below(4);
    let options = BuildOptions { builder: draw.one_of(Builder::ALL), ..options(&mut draw) };
    let recorded = draw.one_of([Recorded::Uncles, Recorded::ParentSibling, Recorded::Nothing]);
    let Some(mesh) = draw.mesh(6) else { return };
    let rays = draw.rays(&mesh, 3);
    let is_wide = draw.coin();
    let file = match options.build(&mesh) {
        Ok(bvh) if kind < 3 => {
            let wide = if is_wide { WideBvh::<8>::of(&bvh).ok() } else { None };
            let file = wide.map_or_else(|| bvh.with_links(recorded).to_bytes(), |wide| wide.to_bytes());
            patched(&mut Unstructured::new(rest), file)
        }
        _ => rest.to_vec(),
    };
    let file = if kind == 2 { file } else { sealed(file) };
    if let Ok(bvh) = Bvh::<Triangle>::from_bytes(&file) {
        assert!(bvh.to_bytes() == file, "another file than was read: {file:?}");
        right(check_held(&bvh, &rays), format_args!("{file:?}\n{rays:?}"));
    }
    if let Ok(wide) = WideBvh::<8>::from_bytes(&file) {
        assert!(wide.to_bytes() == file, "another file than was read: {file:?}");
        let tracer = Tracer::new(wide);
        for ray in &rays {
            let (closest, all) = (tracer.closest(ray), tracer.all(ray).into_iter().next());
            assert_eq!(closest, all, "{file:?}\n{ray:?}");
        }
    }
    // No file is valid in both precisions.
    if let Ok(bvh) = Bvh::<Triangle<DVec3>>::from_bytes(&file) {
        assert!(bvh.to_bytes() == file, "another file than was read: {file:?}");
    }
}

/// Compares placed objects in groups with all triangles transformed one by one. `[INST-1]` `[INST-6]`
pub(crate) fn instances(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let ray_64 = |draw: &mut Draw<'_>, aims: &[[DVec3; 3]]| {
        let aim = aims.get(draw.below(aims.len().max(1) as u64) as usize)?;
        draw.ray_64(*aim)
    };
    match draw.below(5) {
        1 => placed(&mut draw, |draw| mesh_64(draw, 3), Draw::double, ray_64),
        2 => path(&mut draw),
        _ => placed(&mut draw, |draw| draw.mesh(3), Draw::float, Draw::ray),
    }
}

/// Checks instances in a precision, with functions that draw a mesh, a number, and a ray at one of some triangles.
fn placed<'a, V: Precision>(
    draw: &mut Draw<'a>,
    mesh: impl Fn(&mut Draw<'a>) -> Option<Mesh<V>>,
    number: impl Fn(&mut Draw<'a>) -> V::Real,
    ray: impl Fn(&mut Draw<'a>, &[[V; 3]]) -> Option<Ray<V>>,
) {
    let methods = Method::ALL.len() as u64;
    let (groups, meshes, levels) = (draw.below(methods), draw.below(methods), 1 + draw.below(2));
    let options = options(draw);
    let mut shapes: Vec<_> = (0..=draw.below(2)).filter_map(|_| mesh(draw)).map(Shape::Mesh).collect();
    if shapes.is_empty() {
        return;
    }
    for _ in 0..levels {
        let count = shapes.len() as u64;
        let group = (0..=draw.below(3)).map(|_| (draw.below(count) as usize, affine(draw, &number)));
        let group = group.collect();
        shapes.push(Shape::Group(group));
    }
    let wide = draw.coin().then(|| WideOptions { max_leaf: draw.one_of([8, 1, 4, 15]), ..WideOptions::default() });
    let Ok(hierarchies) = Hierarchies::new(&shapes, options, wide.as_ref()) else { return };
    // Images beyond the range of floats are rejected.
    let Ok((assembly, objects)) = hierarchies.assembly(&shapes) else { return };
    let Some(&root) = objects.last() else { return };
    let [groups, meshes] = [groups, meshes].map(|i| Method::ALL[i as usize]);
    let widely = draw.one_of(wide::Method::ALL);
    let tracer = InstanceTracer::with_methods(&assembly, root, groups, meshes).and_then(|it| it.with_wide(widely));
    let tracer = match tracer {
        Ok(tracer) => tracer,
        Err(InstanceError::Unsupported { .. }) => return,
        Err(error) => panic!("{error}"),
    };
    let flat = InstanceOracle::new(&shapes);
    let aims: Vec<_> = flat.corners().copied().filter(|corners| corners.iter().all(|&v| V::is_finite(v))).collect();
    for _ in 0..3 {
        if let Some(ray) = ray(draw, &aims) {
            right(
                check_instances(&tracer, &flat, &ray),
                format_args!("{groups} {meshes} {widely} {wide:?} {shapes:?} {ray:?}"),
            );
        }
    }
}

/// Checks rays that begin at hits of other rays. `[SECOND-1]` `[SECOND-2]`
fn path(draw: &mut Draw<'_>) {
    let method = draw.one_of(Method::ALL);
    let options = BuildOptions { builder: draw.one_of(Builder::ALL), ..options(draw) };
    let Some(mesh) = draw.mesh(6) else { return };
    let Some((bvh, wide)) = built(&mesh, options) else { return };
    let mut assembly = Assembly::new();
    let wide = draw.coin().then_some(wide);
    let is_wide = wide.is_some();
    let object = match wide {
        Some(wide) => assembly.add_wide(wide),
        None => assembly.add_mesh(bvh),
    };
    let Ok(tracer) = InstanceTracer::new(&assembly, object, method) else { return };
    let mut legs = Vec::new();
    for _ in 0..=draw.below(4) {
        let ends = if draw.coin() { Ends::Closed } else { Ends::Open };
        let Some(ray) = draw.rays(&mesh, 1).pop() else { continue };
        let heading = if draw.coin() {
            Heading::Along(ray.direction(), ray.tmax())
        } else {
            Heading::Toward(mesh.vertices()[draw.below(mesh.vertices().len() as u64) as usize])
        };
        legs.push(Leg { heading, ends });
    }
    let origin = draw.point();
    right(
        check_path(&Exactly, &tracer, &mesh, origin, &legs),
        format_args!("{method}, wide: {is_wide}, {options:?}\n{mesh:?}\n{origin:?} {legs:?}"),
    );
}

/// Draws a map of axes to axes, or any map; the identity if the numbers have no inverse.
fn affine<'a, R: Real>(draw: &mut Draw<'a>, number: impl Fn(&mut Draw<'a>) -> R) -> AffineMap<R> {
    let rows = if draw.coin() {
        [(); 3].map(|()| [(); 4].map(|()| number(draw)))
    } else {
        let (first, mirror) = (draw.below(3) as usize, draw.coin());
        let mut rows = [[R::ZERO; 4]; 3];
        for (axis, row) in rows.iter_mut().enumerate() {
            let column = (first + if mirror { 3 - axis } else { axis }) % 3;
            row[column] = R::rounded(draw.one_of([1.0, -1.0, 2.0, 0.5, 0.1]));
            row[3] = number(draw);
        }
        rows
    };
    AffineMap::new(rows).unwrap_or(AffineMap::IDENTITY)
}

fn options(draw: &mut Draw<'_>) -> BuildOptions {
    let max_leaf = draw.one_of([4, 1, 2, 3, 8, 100, 0, u32::MAX]);
    let depth_limit = draw.one_of([u32::MAX, 60, 31, 4, 3, 2, 1, 0]);
    let extra_percent = draw.one_of([0, 30, 100, 300]);
    let overlap = draw.one_of([0.0, 1e-5, 0.5, 1.0]);
    BuildOptions {
        builder: draw.one_of(Builder::ALL),
        sah: SahOptions { max_leaf, depth_limit },
        spatial: SpatialOptions { extra_percent, overlap },
        degenerate: Degenerate::LeftOut,
    }
}

/// Builds trees of two and of eight children; `None` if the options exclude the binary tree.
fn built<V: Precision>(mesh: &Mesh<V>, options: BuildOptions) -> Option<(Bvh<Triangle<V>>, WideBvh<8, V>)> {
    let SahOptions { max_leaf, depth_limit } = options.sah;
    match options.build(mesh) {
        Ok(bvh) => {
            assert!(bvh.depth() <= depth_limit, "deeper than {depth_limit}: {options:?}");
            Some((bvh, options.build_wide(mesh).unwrap_or_else(|error| panic!("{error}: {options:?}"))))
        }
        Err(BuildError::ZeroLeafSize) if max_leaf == 0 => None,
        Err(BuildError::DepthLimit { .. }) if depth_limit < 8 => None,
        Err(error) => panic!("{error}: {options:?}"),
    }
}

/// Corrects the checksum of a file, so the reader continues to the checks after it.
fn sealed(mut file: Vec<u8>) -> Vec<u8> {
    if let Some((content, sum)) = file.split_last_chunk_mut() {
        *sum = checksum(content).to_le_bytes();
    }
    file
}

//! Small scenes of instances, in which much goes wrong that can.

use glam::{Mat3, Vec3};
use stackless_bvh::generate::{Rng, Source, procedural};
use stackless_bvh::geom::{AffineMap, Mesh};
use stackless_check::Shape;

/// A scene, by name.
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) shapes: Vec<Shape>,
}

type Maker = fn(&mut Rng) -> Vec<Shape>;

/// All scenes, in three variants each.
pub(crate) fn all() -> Vec<Scene> {
    let makers: [(&str, Maker); 12] = [
        ("lattice", |rng| one_group(rng, 6, lattice)),
        ("rotated", |rng| one_group(rng, 6, rotated)),
        ("sheared", |rng| one_group(rng, 5, |rng| map(rng, |rng| unit(rng) * 2.0))),
        ("mirrored", |rng| one_group(rng, 5, |rng| scaled(rng, -1.0))),
        ("tiny", |rng| one_group(rng, 4, |rng| scaled(rng, 1e-30))),
        ("least", |rng| one_group(rng, 4, |rng| scaled(rng, 1e-43))),
        ("huge", |rng| one_group(rng, 4, |rng| scaled(rng, 1e30))),
        ("far", |rng| one_group(rng, 5, far)),
        ("nearly flat", |rng| one_group(rng, 5, nearly_flat)),
        ("coincident", coincident),
        ("three levels", |rng| nested(rng, rotated)),
        ("three levels of a lattice", |rng| nested(rng, lattice)),
    ];
    let scenes = makers.iter().enumerate().flat_map(|(i, (name, make))| {
        (0..3).map(move |variant| {
            let shapes = make(&mut Rng::new(100 * i as u64 + variant));
            Scene { name: format!("{name} {variant}"), shapes }
        })
    });
    scenes.collect()
}

/// From -1 to 1.
pub(crate) fn unit(rng: &mut Rng) -> f32 {
    rng.below(1 << 24) as f32 / (1 << 23) as f32 - 1.0
}

fn vector(rng: &mut Rng) -> Vec3 {
    Vec3::new(unit(rng), unit(rng), unit(rng))
}

/// A closed solid with its corners on the lattice.
fn octahedron() -> Mesh {
    let corners = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let triangles = (0..8).map(|i: u32| [i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2)]).collect();
    Mesh::new(corners.to_vec(), triangles).expect("a mesh")
}

/// A box with faces across the axes, and one triangle without area.
fn cuboid() -> Mesh {
    let corner = |i: u8| Vec3::new(f32::from(i & 1), f32::from(i >> 1 & 1), f32::from(i >> 2)) * 2.0 - 1.0;
    let quads = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let mut triangles: Vec<_> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    triangles.push([0, 0, 7]);
    Mesh::new((0..8).map(corner).collect(), triangles).expect("a mesh")
}

fn meshes() -> Vec<Shape> {
    vec![Shape::Mesh(octahedron()), Shape::Mesh(cuboid()), Shape::Mesh(procedural::soup(5, 6))]
}

fn one_group(rng: &mut Rng, n: usize, place: impl Fn(&mut Rng) -> AffineMap) -> Vec<Shape> {
    let mut shapes = meshes();
    let instances = (0..n).map(|_| (rng.below(3) as usize, place(rng))).collect();
    shapes.push(Shape::Group(instances));
    shapes
}

/// Meshes beside groups of meshes beside groups of those.
fn nested(rng: &mut Rng, place: impl Fn(&mut Rng) -> AffineMap) -> Vec<Shape> {
    let mut shapes = meshes();
    for n in [3, 2, 3] {
        let before = shapes.len();
        let mut instances: Vec<_> = (0..n).map(|_| (rng.below(before as u64) as usize, place(rng))).collect();
        instances[0].0 = before - 1;
        shapes.push(Shape::Group(instances));
    }
    shapes
}

/// The same things in the same places, also by way of a group, and mirrored onto itself: ties.
fn coincident(rng: &mut Rng) -> Vec<Shape> {
    let mut shapes = meshes();
    let (place, identity) = (lattice(rng), AffineMap::IDENTITY);
    let mirror = AffineMap::new([[-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]).expect("a map");
    shapes.push(Shape::Group(vec![(1, identity), (0, mirror), (0, identity), (0, identity)]));
    let others = (0..3).map(|_| (rng.below(4) as usize, if rng.coin() { place } else { lattice(rng) }));
    let mut instances: Vec<_> = others.collect();
    instances.extend([(3, place), (0, place), (1, place), (3, place)]);
    shapes.push(Shape::Group(instances));
    shapes
}

fn affine(a: Mat3, b: Vec3) -> Option<AffineMap> {
    let [x, y, z] = [a.row(0), a.row(1), a.row(2)];
    AffineMap::new([[x.x, x.y, x.z, b.x], [y.x, y.y, y.z, b.y], [z.x, z.y, z.z, b.z]]).ok()
}

/// The first map that has an inverse.
fn map(rng: &mut Rng, entry: impl Fn(&mut Rng) -> f32) -> AffineMap {
    loop {
        let column = |rng: &mut Rng| Vec3::new(entry(rng), entry(rng), entry(rng));
        let a = Mat3::from_cols(column(rng), column(rng), column(rng));
        if let Some(map) = affine(a, vector(rng) * 3.0) {
            return map;
        }
    }
}

/// Axes onto axes, by powers of two, and small integers.
fn lattice(rng: &mut Rng) -> AffineMap {
    let (first, odd) = (rng.below(3) as usize, rng.coin());
    let mut rows = [[0.0; 4]; 3];
    for (axis, row) in rows.iter_mut().enumerate() {
        let column = (first + if odd { 3 - axis } else { axis }) % 3;
        row[column] = [1.0, -1.0, 2.0, 0.5][rng.below(4) as usize];
        row[3] = rng.below(7) as f32 - 3.0;
    }
    AffineMap::new(rows).expect("axes onto axes")
}

fn rotation(rng: &mut Rng) -> Mat3 {
    Mat3::from_axis_angle(vector(rng).try_normalize().unwrap_or(Vec3::X), 3.0 * unit(rng))
}

fn rotated(rng: &mut Rng) -> AffineMap {
    affine(rotation(rng), vector(rng) * 3.0).expect("a rotation")
}

/// As a whole, with what is placed.
fn scaled(rng: &mut Rng, by: f32) -> AffineMap {
    affine(rotation(rng) * by, vector(rng) * (3.0 * by.abs())).expect("not flat")
}

fn far(rng: &mut Rng) -> AffineMap {
    affine(rotation(rng), vector(rng) + Vec3::new(1e6, -3e5, 1e4)).expect("a rotation")
}

/// Rows that differ by little.
fn nearly_flat(rng: &mut Rng) -> AffineMap {
    let row = vector(rng);
    let near = |rng: &mut Rng| Vec3::from(row.to_array().map(|x| f32::from_bits(x.to_bits() + rng.below(3) as u32)));
    loop {
        let a = Mat3::from_cols(near(rng), near(rng), vector(rng)).transpose();
        if let Some(map) = affine(a, vector(rng)) {
            return map;
        }
    }
}

//! Small scenes of instances with all typical difficulties.

use glam::{DMat3, DVec3, Vec3};
use stackless_bvh::generate::{Rng, Source, procedural};
use stackless_bvh::geom::{AffineMap, Mesh, Precision, Real, Vector};
use stackless_check::Shape;

/// Single or double precision, with the scales of its scenes.
pub(crate) trait Kind: Precision {
    const TINY: f64;
    const LEAST: f64;
    const HUGE: f64;
    const FAR: f64;
}

impl Kind for Vec3 {
    const TINY: f64 = 1e-30;
    const LEAST: f64 = 1e-43;
    const HUGE: f64 = 1e30;
    const FAR: f64 = 1e6;
}

impl Kind for DVec3 {
    const TINY: f64 = 1e-50;
    const LEAST: f64 = 1e-320;
    const HUGE: f64 = 1e50;
    const FAR: f64 = 6.4e6;
}

/// A scene, by name.
pub(crate) struct Scene<V: Vector> {
    pub(crate) name: String,
    pub(crate) shapes: Vec<Shape<V>>,
}

/// Returns a mesh nested in these transforms, the innermost first.
pub(crate) fn placed<V: Vector>(mesh: Mesh<V>, maps: &[[[f64; 4]; 3]]) -> Vec<Shape<V>> {
    let map = |rows: &[[f64; 4]; 3]| AffineMap::new(rows.map(|row| row.map(V::Real::rounded))).expect("an inverse");
    let groups = maps.iter().enumerate().map(|(below, rows)| Shape::Group(vec![(below, map(rows))]));
    std::iter::once(Shape::Mesh(mesh)).chain(groups).collect()
}

type Maker<V> = fn(&mut Rng) -> Vec<Shape<V>>;

/// Returns all scenes, in three variants each.
pub(crate) fn all<V: Kind>() -> Vec<Scene<V>> {
    let makers: [(&str, Maker<V>); 15] = [
        ("lattice", |rng| one_group(rng, 6, lattice)),
        ("rotated", |rng| one_group(rng, 6, rotated)),
        ("sheared", |rng| one_group(rng, 5, sheared)),
        ("mirrored", |rng| one_group(rng, 5, |rng| scaled(rng, -1.0))),
        ("tiny", |rng| one_group(rng, 4, |rng| scaled(rng, V::TINY))),
        ("least", |rng| one_group(rng, 4, |rng| scaled(rng, V::LEAST))),
        ("huge", |rng| one_group(rng, 4, |rng| scaled(rng, V::HUGE))),
        ("far", |rng| one_group(rng, 5, far::<V>)),
        ("nearly flat", |rng| one_group(rng, 5, nearly_flat)),
        ("coincident", coincident),
        ("three levels", |rng| nested(rng, rotated)),
        ("three levels of a lattice", |rng| nested(rng, lattice)),
        ("three levels far away", |rng| nested(rng, far::<V>)),
        ("mixed scales", mixed),
        ("tiny of huge", tiny_of_huge),
    ];
    let scenes = makers.iter().enumerate().flat_map(|(i, (name, make))| {
        (0..3).map(move |variant| {
            let shapes = make(&mut Rng::new(100 * i as u64 + variant));
            Scene { name: format!("{name} {variant}"), shapes }
        })
    });
    scenes.collect()
}

/// Draws a number from -1 to 1.
pub(crate) fn unit(rng: &mut Rng) -> f64 {
    rng.below(1 << 53) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Draws a vector with components from -1 to 1.
pub(crate) fn vector(rng: &mut Rng) -> DVec3 {
    DVec3::new(unit(rng), unit(rng), unit(rng))
}

/// Rounds a vector.
pub(crate) fn narrow<V: Vector>(v: DVec3) -> V {
    V::from_components(v.to_array().map(V::Real::rounded))
}

fn mesh<V: Vector>(vertices: impl IntoIterator<Item = DVec3>, triangles: Vec<[u32; 3]>) -> Mesh<V> {
    Mesh::new(vertices.into_iter().map(narrow).collect(), triangles).expect("a mesh")
}

/// Returns a closed solid with its corners on the lattice.
fn octahedron<V: Vector>() -> Mesh<V> {
    let corners = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let triangles = (0..8).map(|i: u32| [i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2)]).collect();
    mesh(corners, triangles)
}

/// Returns a box with faces across the axes, and one triangle without area.
fn cuboid<V: Vector>() -> Mesh<V> {
    let corner = |i: u8| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 2.0 - 1.0;
    let quads = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let mut triangles: Vec<_> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    triangles.push([0, 0, 7]);
    mesh((0..8).map(corner), triangles)
}

/// Returns a soup with numbers of all digits.
fn soup<V: Vector>() -> Mesh<V> {
    let soup = procedural::soup(5, 6);
    mesh(soup.vertices().iter().map(|v| v.widen() * 1.1), soup.triangles().to_vec())
}

fn meshes<V: Vector>() -> Vec<Shape<V>> {
    vec![Shape::Mesh(octahedron()), Shape::Mesh(cuboid()), Shape::Mesh(soup())]
}

fn one_group<V: Vector>(rng: &mut Rng, n: usize, place: impl Fn(&mut Rng) -> AffineMap<V::Real>) -> Vec<Shape<V>> {
    let mut shapes = meshes();
    let instances = (0..n).map(|_| (rng.below(3) as usize, place(rng))).collect();
    shapes.push(Shape::Group(instances));
    shapes
}

/// Returns meshes next to groups of meshes next to groups of groups.
fn nested<V: Vector>(rng: &mut Rng, place: impl Fn(&mut Rng) -> AffineMap<V::Real>) -> Vec<Shape<V>> {
    let mut shapes = meshes();
    for n in [3, 2, 3] {
        let before = shapes.len();
        let mut instances: Vec<_> = (0..n).map(|_| (rng.below(before as u64) as usize, place(rng))).collect();
        instances[0].0 = before - 1;
        shapes.push(Shape::Group(instances));
    }
    shapes
}

/// Returns copies at equal places, also inside a group, and mirrored onto itself: ties.
fn coincident<V: Vector>(rng: &mut Rng) -> Vec<Shape<V>> {
    let mut shapes = meshes();
    let (place, identity) = (lattice(rng), AffineMap::IDENTITY);
    let mirror = affine(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)), DVec3::ZERO).expect("a map");
    shapes.push(Shape::Group(vec![(1, identity), (0, mirror), (0, identity), (0, identity)]));
    let others = (0..3).map(|_| (rng.below(4) as usize, if rng.coin() { place } else { lattice(rng) }));
    let mut instances: Vec<_> = others.collect();
    instances.extend([(3, place), (0, place), (1, place), (3, place)]);
    shapes.push(Shape::Group(instances));
    shapes
}

/// Returns a huge group in a small one, where the frame matters.
fn tiny_of_huge<V: Kind>(rng: &mut Rng) -> Vec<Shape<V>> {
    let mut shapes = one_group(rng, 3, |rng| scaled(rng, V::HUGE));
    let group = shapes.len() - 1;
    shapes.push(Shape::Group((0..3).map(|_| (group, scaled(rng, V::TINY))).collect()));
    shapes
}

/// Returns nested shapes, each a million times smaller than its siblings.
fn mixed<V: Vector>(rng: &mut Rng) -> Vec<Shape<V>> {
    let mut shapes = meshes();
    for _ in 0..2 {
        let last = shapes.len() - 1;
        let small = (last, scaled(rng, 1e-6));
        let instances = vec![small, (rng.below(3) as usize, rotated(rng)), (0, scaled(rng, 1e3)), (1, sheared(rng))];
        shapes.push(Shape::Group(instances));
    }
    shapes
}

fn affine<R: Real>(a: DMat3, b: DVec3) -> Option<AffineMap<R>> {
    let row = |k: usize| [a.row(k).x, a.row(k).y, a.row(k).z, b[k]].map(R::rounded);
    AffineMap::new([0, 1, 2].map(row)).ok()
}

/// Draws maps until one has an inverse.
fn sheared<R: Real>(rng: &mut Rng) -> AffineMap<R> {
    loop {
        let a = DMat3::from_cols(vector(rng) * 2.0, vector(rng) * 2.0, vector(rng) * 2.0);
        if let Some(map) = affine(a, vector(rng) * 3.0) {
            return map;
        }
    }
}

/// Draws any of these maps, of about this size.
pub(crate) fn about(rng: &mut Rng, size: f64) -> AffineMap {
    loop {
        let scale = DVec3::splat(1.0) + vector(rng) * 0.3;
        let a = match rng.below(4) {
            0 => DMat3::IDENTITY,
            1 => DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 0.5)),
            2 => rotation(rng) * DMat3::from_diagonal(scale),
            _ => DMat3::from_cols(vector(rng), vector(rng), vector(rng)),
        };
        if let Some(map) = affine(a, vector(rng) * size) {
            return map;
        }
    }
}

/// Draws a map of axes to axes, by powers of two, with small integers.
fn lattice<R: Real>(rng: &mut Rng) -> AffineMap<R> {
    let (first, odd) = (rng.below(3) as usize, rng.coin());
    let mut rows = [[0.0; 4]; 3];
    for (axis, row) in rows.iter_mut().enumerate() {
        let column = (first + if odd { 3 - axis } else { axis }) % 3;
        row[column] = [1.0, -1.0, 2.0, 0.5][rng.below(4) as usize];
        row[3] = rng.below(7) as f64 - 3.0;
    }
    AffineMap::new(rows.map(|row: [f64; 4]| row.map(R::rounded))).expect("axes onto axes")
}

fn rotation(rng: &mut Rng) -> DMat3 {
    DMat3::from_axis_angle(vector(rng).try_normalize().unwrap_or(DVec3::X), 3.0 * unit(rng))
}

fn rotated<R: Real>(rng: &mut Rng) -> AffineMap<R> {
    affine(rotation(rng), vector(rng) * 3.0).expect("a rotation")
}

/// Draws a uniform scaling, also of the translation.
fn scaled<R: Real>(rng: &mut Rng, by: f64) -> AffineMap<R> {
    affine(rotation(rng) * by, vector(rng) * (3.0 * by.abs())).expect("not flat")
}

fn far<V: Kind>(rng: &mut Rng) -> AffineMap<V::Real> {
    affine(rotation(rng), vector(rng) + DVec3::new(V::FAR, -0.3 * V::FAR, 0.01 * V::FAR)).expect("a rotation")
}

/// Draws a map whose rows differ little.
fn nearly_flat<R: Real>(rng: &mut Rng) -> AffineMap<R> {
    let row = vector(rng).to_array().map(R::rounded);
    let near =
        |rng: &mut Rng| DVec3::from(row.map(|x| -> f64 { (0..rng.below(3)).fold(x, |x, _| x.next_up()).into() }));
    loop {
        let a = DMat3::from_cols(near(rng), near(rng), vector(rng)).transpose();
        if let Some(map) = affine(a, vector(rng)) {
            return map;
        }
    }
}

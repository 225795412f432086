//! Tests in double precision: the frame of boxes left out or rounded, and sums that are not exact.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::marker::PhantomData;

use glam::DVec3;

use super::draw::Draw;
use super::layers::{Instead, Mistake, marks};
use crate::check_tree;
use stackless_bvh::bvh::{BuildOptions, Builder, SahOptions};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::kernel::Exact64;
use stackless_bvh::geom::slabs::{Directed, Intervals, Wide};
use stackless_bvh::geom::{Frame, Kernel, Mesh, Ray, Region, Slabs, Triangle};

pub(super) const MISTAKES: [Mistake; 8] = [
    of::<Exact64, Boxes<AtZero>>("boxes are taken as if their frame were at zero", "FRAME-1"),
    of::<Exact64, Boxes<UnitOne>>("boxes are taken as if the unit of their frame were 1", "FRAME-1"),
    of::<Exact64, Boxes<Rounded>>("the ray is rounded before it is taken into the frame", "BOX-8"),
    of::<Exact64, Boxes<EndFromThere>>(
        "the end of a ray from afar is taken to be one from where it enters the scene",
        "BOX-9",
    ),
    of::<Exact64, Boxes<Unchecked>>("where a ray from afar enters the scene, doubles are believed", "BOX-9"),
    of::<Sums<Flushed>, Wide>("sums take what is next to nothing for nothing", "EXACT-8"),
    of::<Sums<InDoubles>, Wide>("far from 1, determinants are rounded", "EXACT-8"),
    of::<Sums<NearPoint>, Wide>("a line from afar is taken to run through a double near to the triangle", "EXACT-12"),
];

pub(super) const CONTROLS: [Mistake; 2] = [
    of::<Exact64, Boxes<Nothing>>("boxes in a frame, wrapped", "BOX-8"),
    of::<Sums<Nothing>, Wide>("the exact test of doubles, wrapped", "EXACT-7"),
];

const fn of<K, B>(name: &'static str, clause: &'static str) -> Mistake
where
    K: Kernel<Vector = DVec3, Shape = Triangle<DVec3>>,
    B: Slabs<Vector = DVec3>,
{
    Mistake::new(name, clause, fault::<K, B>, Instead::Nothing("the suite's rays are in single precision"))
}

fn fault<K, B>(draw: &mut Draw<'_>) -> Option<String>
where
    K: Kernel<Vector = DVec3, Shape = Triangle<DVec3>>,
    B: Slabs<Vector = DVec3>,
{
    let (mesh, rays) = scene(draw)?;
    let sah = SahOptions { max_leaf: 1, ..SahOptions::default() };
    let options = BuildOptions { builder: draw.one_of(Builder::ALL), sah, ..BuildOptions::default() };
    check_tree::<K, B, _>(&options.build(&mesh).ok()?, &mesh, &rays).err().map(|fault| fault.to_string())
}

/// A scene of whole numbers or thirds, moved and in another unit; now and then a ray begins beside it by next to nothing,
/// or from afar.
fn scene(draw: &mut Draw<'_>) -> Option<(Mesh<DVec3>, Vec<Ray<DVec3>>)> {
    const NEXT_TO_NOTHING: f64 = 1e-250;
    let (by, part) = (DVec3::new(1.0, -1.0, 0.5) * draw.one_of([0.0, 6.4e6, 1e12]), draw.one_of([1.0, 3.0]));
    let [place, way] = [(); 2].map(|()| 2f64.powi(draw.one_of([0, -166, 166, 300, -300])));
    let (mesh, rays) = draw.scene()?;
    let vertices = mesh.vertices().iter().map(|v| (v.as_dvec3() / part + by) * place).collect();
    let mesh = Mesh::new(vertices, mesh.triangles().to_vec()).ok()?;
    let mut moved = |ray: &Ray| {
        let (mut o, d) = ((ray.origin().as_dvec3() / part + by) * place, ray.direction().as_dvec3() / part * way);
        let axis = draw.below(12) as usize;
        if axis < 3 && o[axis] == 0.0 {
            o[axis] = draw.one_of([NEXT_TO_NOTHING, -NEXT_TO_NOTHING]);
        } else if axis == 3 && ray.tmax() == f32::INFINITY {
            o -= d * (place / way) * 2f64.powi(40);
        }
        let [tmin, tmax] = [ray.tmin(), ray.tmax()].map(|t| f64::from(t) * place / way);
        Ray::within(o, d, tmin, tmax).ok()
    };
    let rays = rays.iter().filter_map(&mut moved).collect();
    Some((mesh, rays))
}

marks! { Nothing AtZero UnitOne Rounded EndFromThere Unchecked Flushed InDoubles NearPoint }

/// The box test of doubles with a mistake.
#[derive(Clone, Copy, Debug)]
struct Boxes<S> {
    wide: Wide,
    /// The ray in the frame, in single precision.
    single: Option<Directed>,
    /// Distance that is taken off the end.
    away: f64,
    /// Distance at which the tested ray begins.
    start: f64,
    spoil: PhantomData<S>,
}

impl<S: Spoil> Slabs for Boxes<S> {
    type Vector = DVec3;

    fn new(ray: &Ray<DVec3>, region: &Region) -> Self {
        let frame = region.frame();
        let other = |origin, exponent| Frame::new(origin, exponent).map(|frame| Region::within(frame, region.bounds()));
        let region = match S::BUG {
            Bug::AtZero => other(DVec3::ZERO, frame.exponent()),
            Bug::UnitOne => other(frame.origin(), 0),
            _ => None,
        }
        .unwrap_or(*region);
        let (from_there, start) = entered::<S>(ray, &region).unwrap_or((*ray, 0.0));
        let (wide, single, away) =
            (Wide::new(&from_there, &region), rounded::<S>(ray, &region), away::<S>(ray, &region));
        Self { wide, single, away, start, spoil: PhantomData }
    }

    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        let Some(single) = &self.single else {
            let Intervals { hit, near, far } = self.wide.pair(planes, tmax - self.away - self.start);
            return Intervals { hit, near: near.map(|near| near + self.start), far: far.map(|far| far + self.start) };
        };
        let Intervals { hit, near, far } = single.pair(planes, (tmax as f32).next_up());
        Intervals { hit, near: near.map(|near| f64::from(near.next_down())), far: far.map(f64::from) }
    }
}

/// The ray, rounded to single precision and taken into the frame, where that is a ray.
fn rounded<S: Spoil>(ray: &Ray<DVec3>, region: &Region) -> Option<Directed> {
    let (frame, unit) = (region.frame(), 2f64.powi(-region.frame().exponent()));
    if S::BUG != Bug::Rounded {
        return None;
    }
    let origin = ((ray.origin().as_vec3().as_dvec3() - frame.origin()) * unit).as_vec3();
    let direction = (ray.direction() * unit).as_vec3();
    let ray = Ray::within(origin, direction, (ray.tmin() as f32).next_down().max(0.0), f32::INFINITY).ok()?;
    Some(Directed::new(&ray, &Region::of(region.bounds())))
}

/// About the distance at which a ray from afar enters the scene.
fn away<S: Spoil>(ray: &Ray<DVec3>, region: &Region) -> f64 {
    let is_afar = S::BUG == Bug::EndFromThere && is_from_afar(ray, region);
    if is_afar { 0.5 * region.distance(ray.origin()) / ray.direction().abs().max_element() } else { 0.0 }
}

fn is_from_afar(ray: &Ray<DVec3>, region: &Region) -> bool {
    region.distance(ray.origin()) > 1e6 * region.size()
}

/// A ray from afar, from shortly before it enters the scene, as doubles have that point; and how far that is.
fn entered<S: Spoil>(ray: &Ray<DVec3>, region: &Region) -> Option<(Ray<DVec3>, f64)> {
    if S::BUG != Bug::Unchecked || !is_from_afar(ray, region) {
        return None;
    }
    let (o, d) = (ray.origin(), ray.direction());
    let start = (region.distance(o) - 2.0 * region.size()) / d.abs().max_element();
    let ray = Ray::within(o + d * start, d, (ray.tmin() - start).max(0.0), f64::INFINITY).ok()?;
    Some((ray, start))
}

/// The exact test of doubles with a mistake.
#[derive(Clone, Copy, Debug)]
struct Sums<S> {
    exact: Exact64,
    ray: Ray<DVec3>,
    spoil: PhantomData<S>,
}

impl<S: Spoil> Kernel for Sums<S> {
    type Vector = DVec3;
    type Shape = Triangle<DVec3>;
    type Filter = ();

    fn new(ray: &Ray<DVec3>, region: &Region) -> Self {
        let flush = |v: DVec3| DVec3::select(v.abs().cmplt(DVec3::splat(1e-200)), DVec3::ZERO, v);
        let flushed = Ray::within(flush(ray.origin()), ray.direction(), ray.tmin(), ray.tmax());
        let taken = if S::BUG == Bug::Flushed { flushed.unwrap_or(*ray) } else { *ray };
        Self { exact: Exact64::new(&taken, region), ray: *ray, spoil: PhantomData }
    }

    fn distance(&self, shape: &Triangle<DVec3>, limit: f64) -> Option<f64> {
        let greatest = shape.0.iter().fold(0.0, |greatest: f64, corner| greatest.max(corner.abs().max_element()));
        if S::BUG == Bug::InDoubles && !(1e-60..1e60).contains(&greatest) {
            return self.rounded(shape);
        }
        if S::BUG == Bug::NearPoint && self.runs_beside(shape) {
            return None;
        }
        self.exact.distance(shape, limit)
    }

    fn blocks(&self, shape: &Triangle<DVec3>) -> bool {
        self.distance(shape, f64::INFINITY).is_some()
    }

    fn compare(&self, shape: &Triangle<DVec3>, other: &Triangle<DVec3>) -> Ordering {
        self.exact.compare(shape, other)
    }

    fn compare_with(&self, shape: &Triangle<DVec3>, t: f64) -> Ordering {
        self.exact.compare_with(shape, t)
    }

    fn weights(&self, shape: &Triangle<DVec3>) -> [f64; 2] {
        self.exact.weights(shape)
    }
}

impl<S> Sums<S> {
    /// The distance by determinants as they are rounded.
    fn rounded(&self, &Triangle([a, b, c]): &Triangle<DVec3>) -> Option<f64> {
        let (det, [u, v, t]) = determinants([a, b, c], self.ray.origin(), self.ray.direction());
        let (u, v, t) = (u / det, v / det, t / det);
        let is_hit = det != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && self.ray.tmin() <= t && t <= self.ray.tmax();
        is_hit.then_some(t)
    }

    /// Whether a line from afar, from a point near to the triangle, seems to miss that.
    fn runs_beside(&self, &Triangle([a, b, c]): &Triangle<DVec3>) -> bool {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        let edge = (b - a).abs().max((c - a).abs()).max_element();
        let (way, part) = (o - a, (a - o).dot(d) / d.length_squared());
        // Each coordinate is rounded once.
        let near = DVec3::from([0, 1, 2].map(|k| part.mul_add(d[k], o[k])));
        let (det, [u, v, _]) = determinants([a, b, c], near, d);
        let signs = [u, v, det - u - v].map(|x| x * det.signum());
        way.abs().max_element() > edge * 2f64.powi(32) && signs.iter().any(|&x| x < 0.0)
    }
}

/// The determinant, and its products with both weights and the distance.
fn determinants([a, b, c]: [DVec3; 3], o: DVec3, d: DVec3) -> (f64, [f64; 3]) {
    let (e1, e2, s) = (b - a, c - a, o - a);
    let (p, q) = (d.cross(e2), s.cross(e1));
    (e1.dot(p), [s.dot(p), d.dot(q), e2.dot(q)])
}

//! The stages of the exact triangle test, with error bounds that are parts of what they should be.

use std::cmp::Ordering;
use std::fmt::Debug;

use glam::{DVec3, Vec3};

use super::draw::Draw;
use super::files::cast;
use super::layers::{Instead, Mistake};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::kernel::{
    DETERMINANT, DISTANCE, EDGE, Exact, MAX_COORDINATE, MIN_EDGE, QUOTIENT, QUOTIENT_FACTOR, SIGN,
};
use stackless_bvh::geom::slabs::Directed;
use stackless_bvh::geom::truth::{RBig, round_f64};
use stackless_bvh::geom::{Kernel, Ray, Region, Triangle, Vector};

macro_rules! smaller {
    ($name:literal, $clause:literal, $part:literal of $share:ident, $filter:ty) => {
        Mistake::new(
            $name,
            $clause,
            |draw| beyond(draw, $part, |shares| shares.$share),
            Instead::Rays(cast::<$filter, Directed>),
        )
    };
}

pub(super) const MISTAKES: [Mistake; 6] = [
    smaller!("half for edge functions in single precision", "EXACT-4", 0.5 of edge, Filter<50, 100, 100>),
    smaller!("a third for edge functions in single precision", "EXACT-4", 0.33 of edge, Filter<33, 100, 100>),
    smaller!("half for signs", "EXACT-6", 0.5 of sign, Filter<100, 50, 100>),
    smaller!("a quarter for signs", "EXACT-6", 0.25 of sign, Filter<100, 25, 100>),
    smaller!("half for the determinant", "EXACT-4", 0.5 of determinant, Filter<100, 100, 50>),
    smaller!("half for the distance times the determinant", "EXACT-4", 0.5 of distance, Filter<100, 100, 50>),
];

pub(super) const CONTROLS: [Mistake; 1] = [Mistake::new(
    "whole bounds",
    "EXACT-4",
    |draw| beyond(draw, 1.0, Shares::most),
    Instead::Rays(cast::<Filter<100, 100, 100>, Directed>),
)];

/// The exact test, by its stages, with so many percent of the bound in single precision, of that of signs, and of those
/// of distances.
#[derive(Clone, Copy, Debug)]
pub(super) struct Filter<const SINGLE: u32, const SIGNS: u32, const PLACES: u32> {
    exact: Exact,
    ray: Ray,
    region: Region,
}

impl<const SINGLE: u32, const SIGNS: u32, const PLACES: u32> Kernel for Filter<SINGLE, SIGNS, PLACES> {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = ();

    fn new(ray: &Ray, region: &Region) -> Self {
        Self { exact: Exact::new(ray, region), ray: *ray, region: *region }
    }

    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        if self.is_missed_in_single(shape) {
            return None;
        }
        let (found, interval) = (Determinants::of(&self.ray, shape), [self.ray.tmin(), self.ray.tmax()]);
        let origin = f64::from(self.ray.origin().abs().max_element());
        let scene = Sizes { c: self.region.reach() + origin, e: self.region.size(), ..found.sizes };
        for sizes in [scene, found.sizes] {
            let sign = sizes.sign() * f64::from(SIGNS) / 100.0;
            let edges = found.edges.map(|edge| edge * 1.0_f64.copysign(found.determinant));
            if !edges.iter().all(|&edge| edge >= -sign) {
                return None;
            }
            if edges.iter().all(|&edge| edge > sign) {
                let [near, far] = found.place(&sizes, f64::from(PLACES) / 100.0).map(|t| t as f32);
                if near == far && interval[0] < near && near < interval[1] {
                    return Some(near);
                }
                if far < interval[0] || limit < near {
                    return None;
                }
            }
        }
        self.exact.distance(shape, limit)
    }

    fn compare(&self, shape: &Triangle, other: &Triangle) -> Ordering {
        self.exact.compare(shape, other)
    }

    fn compare_with(&self, shape: &Triangle, t: f32) -> Ordering {
        self.exact.compare_with(shape, t)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        self.exact.weights(shape)
    }
}

impl<const SINGLE: u32, const SIGNS: u32, const PLACES: u32> Filter<SINGLE, SIGNS, PLACES> {
    /// Two edge functions seem to have opposite signs for certain.
    fn is_missed_in_single(&self, shape: &Triangle) -> bool {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        let Some(power) = power_of(d) else { return false };
        if o.abs().max_element() > MAX_COORDINATE || self.region.reach() > f64::from(MAX_COORDINATE) {
            return false;
        }
        let found = single(o, d / power, &shape.0);
        let bound = edge_bound(o, d / power, &shape.0) * f64::from(SINGLE) / 100.0;
        let edges = [0, 1, 2].map(|i| f64::from(found[i]));
        edges.iter().any(|&edge| edge < -bound) && edges.iter().any(|&edge| edge > bound)
    }
}

/// The power of two of the greatest component; `None` if the direction is too long or too short for single precision.
fn power_of(direction: Vec3) -> Option<f32> {
    let power = f32::from_bits(direction.abs().max_element().to_bits() & 0x7f80_0000);
    (power > 0.0 && power < f32::from_bits(253 << 23)).then_some(power)
}

/// Edge functions in single precision, in the order of [EXACT-1].
fn single(o: Vec3, d: Vec3, &[v0, v1, v2]: &[Vec3; 3]) -> [f32; 3] {
    let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);
    let p = d.cross(e2);
    let (u, v) = (s.dot(p), d.dot(s.cross(e1)));
    [u, v, (e1.dot(p) - u) - v]
}

fn edge_bound(o: Vec3, d: Vec3, &[v0, v1, v2]: &[Vec3; 3]) -> f64 {
    let greatest = |v: Vec3| f64::from(v.abs().max_element());
    let edge = greatest(v1 - v0).max(greatest(v2 - v0)).max(MIN_EDGE.into());
    f64::from(EDGE) * f64::from(f32::EPSILON / 2.0) * greatest(d) * edge * (2.0 * greatest(o - v0) + edge)
}

/// The determinants in double precision, as [EXACT-1] has them.
#[derive(Clone, Copy, Debug)]
struct Determinants {
    determinant: f64,
    edges: [f64; 3],
    t: f64,
    sizes: Sizes,
}

/// The greatest components of d, s, and e1 and e2.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    d: f64,
    c: f64,
    e: f64,
}

/// Half of the distance from 1 to the next double.
const UNIT: f64 = f64::EPSILON / 2.0;

impl Determinants {
    fn of(ray: &Ray, shape: &Triangle) -> Self {
        let ([v0, v1, v2], o, d) = (shape.widen(), ray.origin().widen(), ray.direction().widen());
        let (e1, e2, s) = (v1 - v0, v2 - v0, o - v0);
        let (p, q) = (d.cross(e2), s.cross(e1));
        let (determinant, u, v) = (e1.dot(p), s.dot(p), d.dot(q));
        let greatest = |v: DVec3| v.abs().max_element();
        let sizes = Sizes { d: greatest(d), c: greatest(s), e: greatest(e1).max(greatest(e2)) };
        Self { determinant, edges: [u, v, (determinant - u) - v], t: e2.dot(q), sizes }
    }

    /// Bounds of the distance, with a part of their errors.
    fn place(&self, sizes: &Sizes, part: f64) -> [f64; 2] {
        let reciprocal = self.determinant.recip();
        let x = self.t * reciprocal;
        let error = (sizes.distance() + x.abs() * sizes.determinant()) * QUOTIENT_FACTOR * reciprocal.abs();
        let error = (error + x.abs() * f64::from(QUOTIENT) * UNIT) * part;
        [x - error, x + error]
    }
}

impl Sizes {
    fn sign(&self) -> f64 {
        f64::from(SIGN) * UNIT * (self.d * self.e) * (self.c + self.e)
    }

    fn determinant(&self) -> f64 {
        f64::from(DETERMINANT) * UNIT * self.d * self.e * self.e
    }

    fn distance(&self) -> f64 {
        f64::from(DISTANCE) * UNIT * self.c * self.e * self.e
    }
}

/// The errors of an input, as parts of their bounds.
#[derive(Debug)]
struct Shares {
    edge: f64,
    sign: f64,
    determinant: f64,
    distance: f64,
}

impl Shares {
    fn most(&self) -> f64 {
        self.edge.max(self.sign).max(self.determinant).max(self.distance)
    }

    /// `None` for what is no ray, or too long or short for single precision.
    fn of([o, d, corners @ ..]: [Vec3; 5]) -> Option<Self> {
        let (ray, shape) = (Ray::new(o, d).ok()?, Triangle(corners));
        let power = power_of(d)?;
        let off =
            |found: f64, exact: &RBig| RBig::try_from(found).map_or(0.0, |found| round_f64(&(found - exact)).abs());
        let (exact, scaled) = (exact(o, d, corners)?, exact(o, d / power, corners)?);
        let (found, narrow) = (Determinants::of(&ray, &shape), single(o, d / power, &corners));
        let edge = (0..3).map(|i| off(narrow[i].into(), &scaled[i])).fold(0.0, f64::max);
        let determinant = off(found.determinant, &exact[3]);
        let signs = (0..3).map(|i| off(found.edges[i], &exact[i]) + determinant).fold(0.0, f64::max);
        Some(Self {
            edge: edge / edge_bound(o, d / power, &corners),
            sign: signs / found.sizes.sign(),
            determinant: determinant / found.sizes.determinant(),
            distance: off(found.t, &exact[4]) / found.sizes.distance(),
        })
    }
}

/// Edge functions, determinant, and distance times the determinant.
fn exact(o: Vec3, d: Vec3, corners: [Vec3; 3]) -> Option<[RBig; 5]> {
    let [o, d, v0, v1, v2] = [o, d, corners[0], corners[1], corners[2]].map(|v| {
        let [x, y, z] = v.to_array().map(RBig::try_from);
        Some([x.ok()?, y.ok()?, z.ok()?])
    });
    let (o, d, v0, v1, v2) = (o?, d?, v0?, v1?, v2?);
    let minus = |a: &[RBig; 3], b: &[RBig; 3]| [0, 1, 2].map(|i| &a[i] - &b[i]);
    let dot = |a: &[RBig; 3], b: &[RBig; 3]| &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2];
    let cross = |a: &[RBig; 3], b: &[RBig; 3]| [(1, 2), (2, 0), (0, 1)].map(|(i, k)| &a[i] * &b[k] - &b[i] * &a[k]);
    let (e1, e2, s) = (minus(&v1, &v0), minus(&v2, &v0), minus(&o, &v0));
    let (p, q) = (cross(&d, &e2), cross(&s, &e1));
    let (determinant, u, v) = (dot(&e1, &p), dot(&s, &p), dot(&d, &q));
    let w = &determinant - &u - &v;
    Some([u, v, w, determinant, dot(&e2, &q)])
}

/// Which error of a drawn input is more than a part of its bound.
fn beyond(draw: &mut Draw<'_>, part: f64, share: fn(&Shares) -> f64) -> Option<String> {
    let mut input = draw.one_of(WORST).map(|v| Vec3::from(v.map(f32::from_bits)));
    let (scale, length) = (draw.power(), draw.power());
    let signs = Vec3::from([(); 3].map(|()| if draw.coin() { -1.0 } else { 1.0 }));
    if draw.coin() {
        let (row, axis) = (draw.below(5) as usize, draw.below(3) as usize);
        input[row][axis] = f32::from_bits(input[row][axis].to_bits() ^ draw.below(8) as u32);
    }
    let input = [0, 1, 2, 3, 4].map(|row| input[row] * signs * if row == 1 { length } else { scale });
    let share = share(&Shares::of(input)?);
    (share > part).then(|| format!("an error of {share} of its bound: {input:?}"))
}

/// Inputs whose errors come near the bounds: of W in single precision; of W, the determinant, and the distance times
/// it, in double. `tests/library/bounds/worst.rs` has more of them. Rows: origin, direction, three corners.
const WORST: [[[u32; 3]; 5]; 4] = [
    [
        [0x3a1a_4f10, 0xba0f_2cf8, 0xba20_3161],
        [0x3f80_0988, 0x3f82_d942, 0xbf80_0d5c],
        [0x38d0_a003, 0xb860_c002, 0xb8c2_267f],
        [0x3f80_25e6, 0xbf80_0c32, 0x3f80_083f],
        [0xbf80_07e5, 0xbf80_068a, 0xbf80_05c1],
    ],
    [
        [0x3a87_c04b, 0x3a7e_ec18, 0xba6b_c4dd],
        [0x3f80_010b, 0xbf80_047e, 0x3f80_3e69],
        [0x2b86_6c5d, 0xab99_93e0, 0x2b81_4451],
        [0x3f80_2ac2, 0x3f80_1138, 0xbf80_0484],
        [0xbf81_54d8, 0x3f80_0cfe, 0x3f80_6b40],
    ],
    [
        [0xbf04_9e5e, 0xbed8_f6c9, 0x3f17_d1ee],
        [0x3f80_1945, 0x3f80_06e5, 0xbf80_0de4],
        [0xade3_61bf, 0xade8_2ec0, 0x2e20_4ae0],
        [0x3f80_7a1b, 0xbf80_2002, 0xbf80_7766],
        [0x3f80_0edd, 0x3f80_0259, 0x3f80_086c],
    ],
    [
        [0x3f80_0439, 0xbf80_4fc0, 0xbf80_0783],
        [0xbe84_312f, 0xbffe_37dd, 0xbfa0_7d63],
        [0xad0e_937f, 0x2e28_8560, 0x2d9c_ed40],
        [0xbf80_00af, 0x3f80_0349, 0xbf80_01e0],
        [0x3f80_baa1, 0x3f80_6249, 0x3f80_2612],
    ],
];

//! Checks in integers that the cases have the described corners, edges, planes and distances.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec2, Vec3};

use crate::generate::draw::{exp2, nudge};
use crate::generate::stress::tests::{RAYS, aimed_at, named};
use crate::geom::Ray;

/// det, U, V, W and T of a ray and a triangle in integers, negated if det is negative.
///
/// Points and directions have separate units: powers of two, of which all coordinates are multiples.
struct Exact {
    det: i128,
    weights: [i128; 3],
    t: i128,
    /// `t` is T / det times 2 to this power.
    shift: i32,
}

impl Exact {
    fn of(corners: [Vec3; 3], ray: &Ray) -> Self {
        let [a, b, c] = corners;
        let ([a, b, c, o], length) = in_units([a, b, c, ray.origin()]);
        let ([d], speed) = in_units([ray.direction()]);
        let (e1, e2, s) = (minus(b, a), minus(c, a), minus(o, a));
        let (p, q) = (cross(d, e2), cross(s, e1));
        let (det, u, v, t) = (dot(e1, p), dot(s, p), dot(d, q), dot(e2, q));
        let sign = if det < 0 { -1 } else { 1 };
        let weights = [sign * u, sign * v, sign * (det - u - v)];
        Self { det: sign * det, weights, t: sign * t, shift: length - speed }
    }

    fn hits(&self) -> bool {
        self.det > 0 && self.t >= 0 && self.weights.iter().all(|&weight| weight >= 0)
    }

    /// Returns 0 inside, 1 on an edge, 2 on a corner.
    fn zeros(&self) -> usize {
        self.weights.iter().filter(|&&weight| weight == 0).count()
    }

    /// Returns whether `t` is 1 divided by this number.
    fn t_is_one_over(&self, n: i128) -> bool {
        let [t, det] = [self.t << self.shift.max(0), self.det << (-self.shift).max(0)];
        n * t == det
    }

    /// Returns `t` in double precision, with an error of about 2^-50.
    fn t(&self) -> f64 {
        self.t as f64 / self.det as f64 * power(self.shift)
    }
}

/// Converts points to integers and a common exponent of two.
fn in_units<const N: usize>(points: [Vec3; N]) -> ([[i128; 3]; N], i32) {
    let least_bit = |x: f32| {
        let (exponent, fraction) = ((x.to_bits() >> 23 & 255) as i32, x.to_bits() & 0x7f_ffff);
        let whole = if exponent > 0 { fraction | 1 << 23 } else { fraction };
        exponent.max(1) - 150 + whole.trailing_zeros() as i32
    };
    let numbers = points.iter().flat_map(Vec3::to_array);
    let unit = numbers.filter(|&x| x != 0.0).map(least_bit).min().unwrap_or(0);
    let whole = |x: f32| {
        let x = f64::from(x) * power(-unit);
        assert!(x.fract() == 0.0 && x.abs() < power(40), "{points:?} has more than 40 bits");
        x as i128
    };
    (points.map(|v| v.to_array().map(whole)), unit)
}

fn power(of_two: i32) -> f64 {
    f64::from_bits(((1023 + of_two) as u64) << 52)
}

fn minus(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn cross(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [i128; 3], b: [i128; 3]) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Counts the rays of a case that satisfy an exact predicate with any triangle.
fn count(name: &str, wanted: impl Fn(&Exact, &Ray) -> bool) -> usize {
    let case = named(name);
    let meets =
        |ray: &&Ray| (0..case.mesh.triangles().len()).any(|i| wanted(&Exact::of(case.mesh.triangle(i), ray), ray));
    case.rays.iter().filter(meets).count()
}

/// Counts the rays of a case that satisfy an exact predicate with the triangle at which they are aimed.
fn count_aimed(name: &str, wanted: impl Fn(&Exact, &Ray) -> bool) -> usize {
    let case = named(name);
    let meets = |(i, ray): &(usize, &Ray)| wanted(&Exact::of(aimed_at(&case, *i), ray), ray);
    case.rays.iter().enumerate().filter(meets).count()
}

#[test]
fn whole_rays_meet_edges_and_corners_exactly() {
    // Name, number of zero weights, and the least number of rays that hit such a place.
    let exact = [
        ("edge", 1, 199),
        ("vertex", 2, 199),
        ("edge-2^-149", 1, 199),
        ("edge-2^-132", 1, 199),
        ("edge-2^-70", 1, 199),
        ("edge-2^60", 1, 199),
        ("edge-2^114", 1, 199),
        ("edge-at-2^24", 1, 199),
        ("edge-wide", 1, 199),
        ("vertex-wide", 2, 199),
        ("shared-vertex-wide", 2, 199),
        ("edge-fraction", 1, 199),
        ("box-corner-fraction", 2, 190),
        ("interval-at-fraction", 1, 100),
        ("needle-wide", 2, 190),
        ("t-is-0-wide", 1, 100),
        ("t-is-1-wide", 1, 100),
        ("between-vertices", 2, 190),
        ("axis-grid", 1, 130),
        ("coplanar", 1, 100),
        ("coplanar-skew", 1, 60),
        ("cube-diagonal", 1, 60),
        ("t-junction", 1, 199),
        ("city", 1, 130),
        ("nested-boxes", 1, 199),
        ("folded-edge", 1, 199),
        ("fan-thin", 1, 199),
        ("overlap-coplanar", 1, 190),
        ("shared-vertex", 2, 199),
        ("seam", 1, 199),
        ("collinear-whole", 1, 40),
        ("box-corner", 2, 195),
        ("point-box", 1, 120),
        ("signed-zeros", 1, 50),
        ("tetrahedron", 1, 100),
        ("cube", 1, 90),
    ];
    for (name, zeros, least) in exact {
        let found = count(name, |exact, _| exact.hits() && exact.zeros() >= zeros);
        assert!(found >= least, "{name}: {found} of {RAYS}");
    }
    let through_edges = count_aimed("edge-from-0", |exact, _| exact.det > 0 && exact.zeros() == 1);
    assert!(through_edges >= 199, "{through_edges}");
    let case = named("vertex-from-0");
    for (i, ray) in case.rays.iter().enumerate() {
        // Products of two floats are exact in double precision.
        let along = |v: Vec3| v.as_dvec3().cross(ray.direction().as_dvec3()) == DVec3::ZERO;
        assert!(ray.origin() == Vec3::ZERO && aimed_at(&case, i).into_iter().any(along), "{ray:?}");
    }
}

#[test]
fn near_misses_are_near() {
    let beside = |exact: &Exact, _: &Ray| {
        let nearest = exact.weights.iter().map(|weight| weight.abs()).min().unwrap_or(0);
        nearest > 0 && nearest << 17 < exact.det
    };
    let found = count_aimed("beside-edge", beside);
    assert!(found >= 150, "{found}");
    for name in ["along-edge", "parallel-wide"] {
        assert_eq!(count_aimed(name, |exact, _| exact.det == 0), RAYS, "{name}");
    }
    let nearly = count_aimed("parallel-ulp", |exact, _| exact.det != 0);
    assert!(nearly >= 150, "{nearly}");
    for name in ["coplanar", "coplanar-skew"] {
        let parallel = count(name, |exact, _| exact.det == 0);
        assert!(parallel >= 160, "{name}: {parallel}");
    }
    for (name, axis) in [("u-near-0", 0), ("v-near-0", 1)] {
        let case = named(name);
        assert!(case.rays.iter().all(|ray| ray.origin()[axis].abs() <= exp2(-24)), "{name}");
        let signs = |sign: f32| case.rays.iter().filter(|ray| ray.origin()[axis] * sign > 0.0).count();
        assert!(signs(1.0) >= 40 && signs(-1.0) >= 40, "{name}");
    }
    let (mut below, mut above) = (0, 0);
    for ray in named("w-near-0").rays {
        let off = f64::from(ray.origin().x) + f64::from(ray.origin().y) - 1.0;
        assert!(off.abs() <= power(-23));
        below += usize::from(off < 0.0);
        above += usize::from(off > 0.0);
    }
    assert!(below >= 40 && above >= 40, "{below} {above}");
}

#[test]
fn ties_are_ties() {
    let case = named("stack-ulp");
    for ray in case.rays.iter().filter(|ray| ray.direction().truncate() == Vec2::ZERO) {
        let exact: Vec<_> = (0..200).map(|i| Exact::of(case.mesh.triangle(i), ray)).collect();
        assert!(exact.iter().all(Exact::hits));
        // All distances differ, but they round to at most three floats.
        assert!(exact.windows(2).all(|pair| pair[0].t() != pair[1].t()));
        assert!(exact.iter().map(|exact| (exact.t() as f32).to_bits()).collect::<BTreeSet<_>>().len() <= 3);
    }
    for name in ["shared-vertex", "shared-vertex-wide"] {
        let case = named(name);
        for ray in &case.rays {
            let hits = (0..case.mesh.triangles().len()).map(|i| Exact::of(case.mesh.triangle(i), ray));
            assert!(hits.filter(|exact| exact.hits() && exact.zeros() == 2).count() > 100, "{name}: {ray:?}");
        }
    }
    for (name, copies) in [("copies", 64), ("three-times", 3)] {
        let case = named(name);
        let mut seen = BTreeMap::<_, usize>::new();
        for i in 0..case.mesh.triangles().len() {
            let mut corners = case.mesh.triangle(i).map(|v| v.to_array().map(f32::to_bits));
            corners.sort_unstable();
            *seen.entry(corners).or_default() += 1;
        }
        assert!(seen.len() == 24 && seen.values().all(|&n| n == copies), "{name}");
    }
}

/// Returns the distance along z to a ramp of slope 1, as a multiple of 2^-101.
fn to_ramp(corner: Vec3, ray: &Ray) -> i128 {
    let in_units = |x: f32| {
        if x.fract() == 0.0 { (x as i128) << 101 } else { (f64::from(x) * power(101)) as i128 }
    };
    assert_eq!(ray.direction(), Vec3::Z);
    in_units(corner.z) - in_units(corner.x) + in_units(ray.origin().x) - in_units(ray.origin().z)
}

#[test]
fn distances_lie_between_floats() {
    // Half of the spacing of floats from 2^24 on, in these units.
    let half = 1_i128 << 101;
    let case = named("midpoint-even");
    let even = case.rays.iter().enumerate().map(|(i, ray)| to_ramp(aimed_at(&case, i)[0], ray));
    for distance in even {
        assert!(distance > half << 24 && distance < half << 25 && distance % half == 0 && distance / half % 2 == 1);
    }
    let case = named("midpoint-near");
    for (i, ray) in case.rays.iter().enumerate() {
        let distance = to_ramp(aimed_at(&case, i)[0], ray);
        let off = distance % (2 * half) - half;
        assert!(off != 0 && off.abs() <= half >> 30, "{off}");
    }
    let case = named("midpoint-sheared");
    for (i, ray) in case.rays.iter().enumerate() {
        let t = f64::from(aimed_at(&case, i)[0].z - aimed_at(&case, i)[0].x) + f64::from(ray.origin().x)
            - f64::from(ray.origin().z);
        // Without the drift it is odd. The drift changes it by less than 2^-17 of 2^24.
        assert!(t % 2.0 == 1.0 && ray.direction().truncate().abs().max_element() <= exp2(-42));
    }
    let case = named("t-subnormal-midpoint");
    for (i, ray) in case.rays.iter().enumerate() {
        let distance = f64::from(aimed_at(&case, i)[0].z) - f64::from(ray.origin().z);
        assert_eq!(distance / f64::from(ray.direction().z) * power(150) % 2.0, 1.0);
    }
}

#[test]
fn intervals_end_at_hits() {
    for (name, end) in [("tmax-at-hit", Ray::tmax as fn(&Ray) -> f32), ("tmin-at-hit", Ray::tmin)] {
        let case = named(name);
        let mut beside = [0; 3];
        for (i, ray) in case.rays.iter().enumerate() {
            let t = aimed_at(&case, i)[0].z - ray.origin().z;
            let off = (-1..=1).position(|by| nudge(t, by) == end(ray)).expect("an end next to t");
            beside[off] += 1;
        }
        assert!(beside.iter().all(|&n| n > 40), "{name}: {beside:?}");
    }
    for name in ["tmax-at-third", "tmin-at-third"] {
        let case = named(name);
        let inexact = case.rays.iter().enumerate();
        let inexact = inexact.filter(|(i, ray)| (aimed_at(&case, *i)[0].z - ray.origin().z) % 3.0 != 0.0).count();
        assert!(inexact > 100, "{name}: {inexact}");
    }
    for (name, end) in [("tmax-is-near", Ray::tmax as fn(&Ray) -> f32), ("tmin-is-far", Ray::tmin)] {
        let exactly = count_aimed(name, |exact, ray| exact.hits() && exact.t() == f64::from(end(ray)));
        assert!(exactly >= 20, "{name}: {exactly}");
    }
    let gaps = named("interval-in-gap").rays;
    assert!(gaps.iter().all(|ray| ray.tmin().next_up() == ray.tmax()));
    for name in ["t-is-0", "t-is-0-wide", "between-vertices"] {
        let at_origin = count(name, |exact, _| exact.hits() && exact.t == 0);
        assert!(at_origin >= 195, "{name}: {at_origin}");
    }
    let is_fraction = |exact: &Exact| [3, 5, 7].into_iter().any(|n| exact.t_is_one_over(n));
    for name in ["edge-fraction", "box-corner-fraction", "interval-at-fraction"] {
        let found = count_aimed(name, |exact, _| exact.hits() && is_fraction(exact));
        assert!(found >= 150, "{name}: {found}");
    }
    let at_1 = count_aimed("t-is-1-wide", |exact, _| exact.hits() && exact.t_is_one_over(1));
    assert!(at_1 >= 199, "{at_1}");
}

#[test]
fn degenerate_triangles_have_no_area() {
    for (name, least) in
        [("collinear-whole", 100), ("seam", 240), ("two-equal-corners", 40), ("three-equal-corners", 40)]
    {
        let mesh = named(name).mesh;
        let area = |i: &usize| {
            let ([a, b, c], _) = in_units(mesh.triangle(*i));
            cross(minus(b, a), minus(c, a)) == [0; 3]
        };
        let found = (0..mesh.triangles().len()).filter(area).count();
        assert!(found >= least && found < mesh.triangles().len(), "{name}: {found}");
    }
}

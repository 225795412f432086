//! Ray-triangle hits in integers without limit. `[EXACT-1]`
//!
//! Every float is an integer multiple of 2^-149. Hits depend only on signs and quotients of products of three such
//! numbers, so the unit cancels.

use core::cmp::Ordering;

use dashu_int::IBig;

/// The vertices, and three indices for each triangle.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) vertices: Vec<[f32; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Origin, direction, and the ends of the interval, which are not negative.
pub(super) type Ray = [f32; 8];

/// A hit: distance and weights of the second and third corner, each rounded once. Hits are ordered by exact distance,
/// not by `t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    pub(super) prim: u32,
    pub(super) t: f32,
    pub(super) u: f32,
    pub(super) v: f32,
}

/// The magnitudes of volumes. Their quotients with the sum are the distance and the weights of two corners.
struct Quotients {
    parts: [IBig; 3],
    sum: IBig,
}

impl Mesh {
    /// Returns all hits, ordered by exact distance, then by index.
    pub(super) fn hits(&self, ray: &Ray) -> Vec<Hit> {
        let met = |(prim, corners): (u32, &[u32; 3])| {
            let corners = corners.map(|corner| self.vertices[corner as usize]);
            if is_beside(corners, ray) { None } else { Some((prim, meet(corners, ray)?)) }
        };
        let mut hits: Vec<_> = (0..).zip(&self.triangles).filter_map(met).collect();
        // Both sums are positive or 0. The sort is stable, so ties keep the order of indices.
        hits.sort_by(|(_, a), (_, b)| (&a.parts[0] * &b.sum).cmp(&(&b.parts[0] * &a.sum)));
        let rounded = |(prim, Quotients { parts, sum }): (u32, Quotients)| {
            let [t, u, v] = parts.map(|part| nearest(&part, &sum));
            Hit { prim, t, u, v }
        };
        hits.into_iter().map(rounded).collect()
    }
}

/// Returns whether all corners are on one side of the ray along an axis, or behind its origin. Then there is no hit. It
/// rejects most misses quickly.
fn is_beside(corners: [[f32; 3]; 3], ray: &Ray) -> bool {
    (0..3).any(|axis| {
        let (o, d) = (ray[axis], ray[axis + 3]);
        let (is_above, is_below) = (|corner: &[f32; 3]| corner[axis] > o, |corner: &[f32; 3]| corner[axis] < o);
        d <= 0.0 && corners.iter().all(is_above) || d >= 0.0 && corners.iter().all(is_below)
    })
}

/// Intersects a ray and a triangle. Relative to the origin, the direction spans a volume with each edge. The weight of
/// a corner is the volume of the opposite edge divided by the sum of all three. A sum of 0 means a triangle without
/// area, or one parallel to the ray.
fn meet(corners: [[f32; 3]; 3], &[x, y, z, dx, dy, dz, tmin, tmax]: &Ray) -> Option<Quotients> {
    let [corner_a, corner_b, corner_c] = corners;
    let [o, d, a, b, c] = whole([[x, y, z], [dx, dy, dz], corner_a, corner_b, corner_c]);
    let [a, b, c] = [a, b, c].map(|[x, y, z]| [x - &o[0], y - &o[1], z - &o[2]]);
    let across = cross(&b, &c);
    let [of_a, of_b, of_c] = [dot(&d, &across), dot(&d, &cross(&c, &a)), dot(&d, &cross(&a, &b))];
    let (sum, along) = (&of_a + &of_b + &of_c, dot(&a, &across));
    // Negated if the triangle is seen from behind.
    let [sum, of_a, of_b, of_c, along] =
        if sum < IBig::ZERO { [-sum, -of_a, -of_b, -of_c, -along] } else { [sum, of_a, of_b, of_c, along] };
    // Every distance is finite, even if it rounds to infinity.
    let is_beyond_all = |t: f32| t == f32::INFINITY;
    let compared = |t: f32| (unit(t) * &sum).cmp(&(&along << 149));
    let is_hit = sum > IBig::ZERO
        && [&of_a, &of_b, &of_c].into_iter().all(|weight| *weight >= IBig::ZERO)
        && !is_beyond_all(tmin)
        && compared(tmin) != Ordering::Greater
        && (is_beyond_all(tmax) || compared(tmax) != Ordering::Less);
    is_hit.then(|| Quotients { parts: [along, of_b, of_c], sum })
}

/// Decomposes a float into an odd integer, or 0, and the exponent of a power of two, relative to 2^-149.
fn parts(x: f32) -> (i64, usize) {
    let (exponent, fraction) = (x.to_bits() >> 23 & 255, x.to_bits() & 0x7f_ffff);
    let size = i64::from(if exponent == 0 { fraction } else { fraction | 1 << 23 });
    let zeros = if size == 0 { 0 } else { size.trailing_zeros() };
    let odd = (size >> zeros) * if x.is_sign_negative() { -1 } else { 1 };
    (odd, (exponent.saturating_sub(1) + zeros) as usize)
}

/// Converts a float to units of 2^-149.
fn unit(x: f32) -> IBig {
    let (odd, power) = parts(x);
    IBig::from(odd) << power
}

/// Converts floats to integers in their greatest common unit.
fn whole(points: [[f32; 3]; 5]) -> [[IBig; 3]; 5] {
    let powers = points.as_flattened().iter().filter(|x| **x != 0.0).map(|&x| parts(x).1);
    let least = powers.min().unwrap_or(0);
    points.map(|point| {
        point.map(|x| {
            let (odd, power) = parts(x);
            IBig::from(odd) << power.saturating_sub(least)
        })
    })
}

fn dot([a, b, c]: &[IBig; 3], [x, y, z]: &[IBig; 3]) -> IBig {
    a * x + b * y + c * z
}

fn cross([a, b, c]: &[IBig; 3], [x, y, z]: &[IBig; 3]) -> [IBig; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Rounds a non-negative quotient to the nearest float, ties to even. Floats are ordered like their bits, and infinity
/// takes the place of 2^128.
fn nearest(over: &IBig, under: &IBig) -> f32 {
    let in_units = over << 149;
    let is_above = |bits: u32| unit(f32::from_bits(bits)) * under > in_units;
    let (mut low, mut high) = (0, f32::INFINITY.to_bits());
    while high - low > 1 {
        let middle = u32::midpoint(low, high);
        if is_above(middle) { high = middle } else { low = middle }
    }
    let middle = (unit(f32::from_bits(low)) + unit(f32::from_bits(high))) * under;
    f32::from_bits(match middle.cmp(&(in_units * 2)) {
        Ordering::Less => high,
        Ordering::Greater => low,
        Ordering::Equal => low + low % 2,
    })
}

#[cfg(test)]
mod tests {
    use super::super::ray::scene;
    use super::*;
    use stackless_bvh::generate::{Rng, Source, stress};
    use stackless_bvh::internals::trace::brute_force;

    #[test]
    fn quotients_are_rounded_once() {
        let of = |over: f32, under: f32| nearest(&unit(over), &unit(under));
        let mut rng = Rng::new(1);
        let float = |rng: &mut Rng| f32::from_bits(rng.below(0x7f80_0000) as u32);
        for _ in 0..2000 {
            let (a, b) = (float(&mut rng), float(&mut rng).max(f32::from_bits(1)));
            assert_eq!(of(a, b), a / b, "{a} / {b}");
        }
        assert_eq!(of(f32::MAX, 1.0), f32::MAX);
        assert_eq!(of(f32::MAX, f32::MIN_POSITIVE), f32::INFINITY);
        assert_eq!(of(0.0, 3.0), 0.0);
    }

    /// Two sheets whose distances round to the same float, in both orders, and two sheets at equal distances.
    #[test]
    fn the_least_exact_distance_comes_first() {
        let sheet = |z: f32| [[-1.0, -1.0, z], [1.0, -1.0, z], [0.0, 1.0, z]];
        let order = |heights: [f32; 3]| {
            let mesh = Mesh {
                vertices: heights.into_iter().flat_map(sheet).collect(),
                triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
            };
            let hits = mesh.hits(&[0.0, 0.0, 100.0, 0.0, 0.0, -3.0, 0.0, f32::INFINITY]);
            assert!(hits.iter().all(|hit| hit.t == hits[0].t), "{hits:?}");
            hits.iter().map(|hit| hit.prim).collect::<Vec<_>>()
        };
        assert_eq!(order([0.0, 1e-6, -1e-6]), [1, 0, 2]);
        assert_eq!(order([1e-6, 0.0, 1e-6]), [0, 2, 1]);
        assert_eq!(order([0.0, 0.0, 0.0]), [0, 1, 2]);
    }

    /// Compares with an independent implementation in fractions.
    #[test]
    fn the_library_finds_the_same() {
        let mut hits = 0;
        for case in stress::cases(6).filter(|case| case.mesh.triangles().len() < 200) {
            let (mesh, rays) = scene(&case);
            for (ray, plain) in case.rays.iter().zip(&rays) {
                let expected = brute_force(&case.mesh, ray).into_iter().map(|hit| hit.rounded());
                let expected: Vec<_> = expected.map(|hit| (hit.prim, hit.t, hit.u, hit.v)).collect();
                let found: Vec<_> = mesh.hits(plain).iter().map(|hit| (hit.prim, hit.t, hit.u, hit.v)).collect();
                assert_eq!(found, expected, "{}", case.name);
                hits += found.len();
            }
        }
        assert!(hits > 200, "{hits}");
    }
}

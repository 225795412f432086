//! Compares two answers for one ray.

use glam::Vec3;
use stackless_bvh::geom::Ray;
use stackless_bvh::trace::Hit;

use crate::scene::{SIDE, Scene};

/// The difference between the inexact and the exact answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Difference {
    /// Equal triangles, or no hit in either answer.
    None,
    /// Lost hit: the inexact answer is a miss.
    Lost,
    /// Ghost: only the inexact answer is a hit.
    Ghost,
    /// Different triangles.
    Other,
}

impl Difference {
    /// The difference between the exact and the inexact answer.
    pub fn of([exact, inexact]: &[Option<Hit>; 2]) -> Self {
        match (exact, inexact) {
            (Some(_), None) => Self::Lost,
            (None, Some(_)) => Self::Ghost,
            (Some(exact), Some(inexact)) if exact.prim != inexact.prim => Self::Other,
            _ => Self::None,
        }
    }
}

/// A row of both pictures: four bytes of colour per pixel, all 0 for a miss.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// The exact picture.
    pub exact: Vec<u8>,
    /// The inexact picture.
    pub inexact: Vec<u8>,
    /// For each pixel a [`Difference`].
    pub differences: Vec<u8>,
}

/// Counts over all rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Totals {
    /// Number of rays that hit, by the exact tracer.
    pub hits: u64,
    /// [`Difference::Lost`].
    pub lost: u64,
    /// [`Difference::Ghost`].
    pub ghosts: u64,
    /// [`Difference::Other`].
    pub other: u64,
    /// A hash of all bits of the answers, for each picture.
    #[serde(serialize_with = "in_hex")]
    pub digests: [u64; 2],
}

impl Default for Totals {
    fn default() -> Self {
        Self { hits: 0, lost: 0, ghosts: 0, other: 0, digests: [START; 2] }
    }
}

/// The start and the factor of the hash of Fowler, Noll and Vo.
const START: u64 = 0xcbf2_9ce4_8422_2325;
const FACTOR: u64 = 0x0100_0000_01b3;

impl Totals {
    fn add(&mut self, hits: &[Option<Hit>; 2], difference: Difference) {
        self.hits += u64::from(hits[0].is_some());
        match difference {
            Difference::None => {}
            Difference::Lost => self.lost += 1,
            Difference::Ghost => self.ghosts += 1,
            Difference::Other => self.other += 1,
        }
        for (digest, hit) in self.digests.iter_mut().zip(hits) {
            let words = hit.map_or([u32::MAX; 4], |hit| [hit.prim, hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits()]);
            for byte in words.into_iter().flat_map(u32::to_le_bytes) {
                *digest = (*digest ^ u64::from(byte)).wrapping_mul(FACTOR);
            }
        }
    }
}

impl Scene {
    /// Traces a row, counted from the top, and adds its counts to the totals.
    pub fn row(&self, y: usize, totals: &mut Totals) -> Row {
        let mut row = Row::default();
        for x in 0..SIDE {
            let ray = self.ray([x, y]);
            let hits = ray.as_ref().map_or([None; 2], |ray| self.hits(ray));
            let difference = Difference::of(&hits);
            totals.add(&hits, difference);
            let seen = |hit: Option<Hit>| ray.as_ref().zip(hit).map_or([0; 4], |(ray, hit)| self.colour(ray, &hit));
            let [exact, inexact] = hits.map(seen);
            row.exact.extend(exact);
            row.inexact.extend(inexact);
            row.differences.push(difference as u8);
        }
        row
    }

    /// Brighter where the surface faces the camera, and slightly different for each triangle.
    fn colour(&self, ray: &Ray, hit: &Hit) -> [u8; 4] {
        let [a, b, c] = self.mesh().triangle(hit.prim as usize).map(|corner: Vec3| corner.as_dvec3());
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let facing = normal.dot(ray.direction().as_dvec3().normalize_or_zero()).abs();
        let shade = hit.prim.wrapping_mul(0x9E37_79B9) >> 24;
        let light = (0.25 + 0.75 * facing) * (1.0 - f64::from(shade) / 1024.0);
        let [red, green, blue] = [214.0, 190.0, 150.0].map(|channel| (channel * light + 0.5) as u8);
        [red, green, blue, 255]
    }
}

/// As text, because numbers of JavaScript have fewer bits.
fn in_hex<S: serde::Serializer>(digests: &[u64; 2], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(digests.map(|digest| format!("{digest:016x}")))
}

//! Numbers, rays and meshes from bytes. Few bytes decide the important choices, and earlier numbers are repeated.

use arbitrary::Unstructured;
use glam::{DVec3, Vec3};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::{Mesh, Ray};

/// Draws from the bytes of a fuzzer.
pub(crate) struct Draw<'a> {
    bytes: Unstructured<'a>,
    /// The numbers so far, for repetition.
    drawn: Vec<f64>,
}

const SPECIAL: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-45,
    -1e-45,
    f32::MIN_POSITIVE as f64,
    f32::MAX as f64,
    f32::MIN as f64,
    1e-20,
    -1e-30,
    1e30,
    0.1,
    8_388_609.0,
    -1e-42,
];

impl Source for Draw<'_> {
    fn below(&mut self, bound: u64) -> u64 {
        self.bytes.below(bound)
    }
}

impl<'a> Draw<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes: Unstructured::new(bytes), drawn: Vec::new() }
    }

    /// Draws one of the choices.
    pub(crate) fn one_of<T: Copy, const N: usize>(&mut self, choices: [T; N]) -> T {
        choices[self.below(N as u64) as usize]
    }

    /// Draws a finite number in single precision.
    pub(crate) fn float(&mut self) -> f32 {
        let number = self.number();
        let number = if number.abs() <= f64::from(f32::MAX) { number as f32 } else { 1.0 };
        self.drawn.push(number.into());
        number
    }

    /// Draws a finite number.
    pub(crate) fn double(&mut self) -> f64 {
        let number = match self.below(8) {
            0 => f64::from_bits(self.below(u64::MAX)),
            1 => (self.small() + 1.0) * 2f64.powi(self.below(2046) as i32 - 1022),
            2 => self.float().into(),
            _ => self.number(),
        };
        let number = if number.is_finite() { number } else { 1.0 };
        self.drawn.push(number);
        number
    }

    fn number(&mut self) -> f64 {
        match self.below(9) {
            0..=2 => self.small(),
            3 => self.one_of(SPECIAL),
            4 => self.small() / 16.0,
            5 => f32::from_bits(self.below(1 << 32) as u32).into(),
            6 => (self.small() + 1.0) * 2f64.powi(self.below(276) as i32 - 149),
            7 => self.again(),
            // A few floats away from an earlier one.
            _ => {
                let (by, number) = (self.below(7) as i32 - 3, self.again() as f32);
                f32::from_bits(number.to_bits().wrapping_add_signed(by)).into()
            }
        }
    }

    /// Draws an integer from -8 to 8.
    fn small(&mut self) -> f64 {
        let number = self.below(17) as f64;
        if number > 8.0 { 8.0 - number } else { number }
    }

    /// Draws an earlier number, or its negation.
    fn again(&mut self) -> f64 {
        let count = self.drawn.len() as u64;
        let number = self.drawn.get(self.bytes.below(count.max(1)) as usize).copied().unwrap_or(1.0);
        if self.coin() { -number } else { number }
    }

    pub(crate) fn point(&mut self) -> Vec3 {
        Vec3::new(self.float(), self.float(), self.float())
    }

    pub(crate) fn point_64(&mut self) -> DVec3 {
        DVec3::new(self.double(), self.double(), self.double())
    }

    /// Draws coordinates that cannot overflow.
    pub(crate) fn tame_point(&mut self) -> Vec3 {
        self.point().clamp(Vec3::splat(-1e6), Vec3::splat(1e6))
    }

    /// Draws the interval of a ray.
    fn interval(&mut self) -> [f32; 2] {
        match self.below(4) {
            0 | 1 => [0.0, f32::INFINITY],
            2 => [0.0, self.float().abs()],
            _ => {
                let [a, b] = [self.float().abs(), self.float().abs()];
                [a.min(b), a.max(b)]
            }
        }
    }

    /// Draws a ray, often at a point with simple weights of one of these triangles.
    pub(crate) fn ray(&mut self, aims: &[[Vec3; 3]]) -> Option<Ray> {
        let origin = self.point();
        let direction = self.aim(aims, origin);
        let [tmin, tmax] = self.interval();
        Ray::within(origin, direction, tmin, tmax).ok()
    }

    /// Draws a ray in double precision.
    pub(crate) fn ray_64(&mut self, [a, b, c]: [DVec3; 3]) -> Option<Ray<DVec3>> {
        let origin = self.point_64();
        let direction = if self.below(4) == 0 {
            self.point_64()
        } else {
            let [u, v] = [self.below(9) as f64 / 8.0, self.below(9) as f64 / 8.0];
            a + (b - a) * u + (c - a) * (v * (1.0 - u)) - origin
        };
        let [tmin, tmax] = match self.below(3) {
            0 => [0.0, f64::INFINITY],
            1 => [0.0, 1.0],
            _ => {
                let [a, b] = [self.double().abs(), self.double().abs()];
                [a.min(b), a.max(b)]
            }
        };
        Ray::within(origin, direction, tmin, tmax).ok()
    }

    fn aim(&mut self, aims: &[[Vec3; 3]], origin: Vec3) -> Vec3 {
        if aims.is_empty() || self.below(4) == 1 {
            return self.point();
        }
        let [a, b, c] = aims[self.below(aims.len() as u64) as usize];
        let [u, v] = [self.below(9) as f32 / 8.0, self.below(9) as f32 / 8.0];
        a + (b - a) * u + (c - a) * (v * (1.0 - u)) - origin
    }

    /// Draws rays at the triangles of a mesh.
    pub(crate) fn rays(&mut self, mesh: &Mesh, most: u64) -> Vec<Ray> {
        let aims: Vec<_> = (0..mesh.triangles().len()).map(|prim| mesh.triangle(prim)).collect();
        (0..=self.below(most)).filter_map(|_| self.ray(&aims)).collect()
    }

    /// Draws a mesh of a few triangles over a few vertices, so edges are shared and some triangles are degenerate.
    pub(crate) fn mesh(&mut self, most: u64) -> Option<Mesh> {
        let triangles = self.triangles(most);
        let vertices = self.vertices(&triangles);
        Mesh::new(vertices, triangles).ok()
    }

    /// Draws the corners of up to `most` triangles.
    pub(crate) fn triangles(&mut self, most: u64) -> Vec<[u32; 3]> {
        let (count, vertices) = (1 + self.below(most), 3 + self.below(most + 8));
        (0..count).map(|_| [(); 3].map(|()| self.below(vertices) as u32)).collect()
    }

    /// Draws the vertices that these triangles need.
    pub(crate) fn vertices(&mut self, triangles: &[[u32; 3]]) -> Vec<Vec3> {
        let count = triangles.iter().flatten().max().map_or(1, |&last| last + 1);
        let is_tame = self.coin();
        (0..count).map(|_| if is_tame { self.tame_point() } else { self.point() }).collect()
    }
}

/// Changes valid bytes. Each change reads an offset and two bytes, and then the new value.
pub(crate) fn patched(source: &mut impl Source, mut bytes: Vec<u8>) -> Vec<u8> {
    for _ in 0..source.below(6) {
        let at = source.below(bytes.len().max(1) as u64) as usize;
        match source.below(6) {
            0 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = byte.wrapping_add(1)),
            1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = 0),
            2 => bytes.iter_mut().skip(at).take(4).for_each(|byte| *byte = 0xff),
            3 => {
                let word = source.below(1 << 32) as u32;
                bytes.iter_mut().skip(at / 4 * 4).zip(word.to_le_bytes()).for_each(|(byte, new)| *byte = new);
            }
            4 => {
                let from = source.below(bytes.len().max(1) as u64) as usize / 4 * 4;
                let word: Vec<u8> = bytes.iter().copied().skip(from).take(4).collect();
                bytes.iter_mut().skip(at / 4 * 4).zip(word).for_each(|(byte, new)| *byte = new);
            }
            _ => bytes.truncate(at),
        }
    }
    bytes
}

//! What a pixel's rays are, and what is seen along them.

use glam::Vec3;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::Rng;
use stackless_bvh::geom::Ray;
use stackless_bvh::trace::{self, Hit, RayQueries, Tracer};

use crate::camera::Camera;
use crate::input::Scene;

/// Which rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Rays {
    /// The camera's: a matt surface, lit from the upper left of the camera and by the sky.
    #[default]
    Primary,
    /// The camera's: colours are the normals.
    Normals,
    /// From where those hit: ambient occlusion within a tenth of the scene's diagonal.
    Ao,
    /// Closest hits of endless rays from there: the light that comes back from what a lamp at the camera lights.
    Diffuse,
}

impl Rays {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Primary | Self::Normals => "primary ray",
            Self::Ao => "occlusion ray",
            Self::Diffuse => "diffuse ray",
        }
    }
}

/// The samples of all pixels.
pub(super) struct Samples<'a> {
    pub(super) scene: &'a Scene,
    pub(super) bvh: &'a Bvh,
    pub(super) tracer: Tracer,
    pub(super) camera: Camera,
    /// Of the camera: forward, right and up.
    pub(super) axes: [Vec3; 3],
    pub(super) rays: Rays,
    /// Of a pixel.
    pub(super) spp: u32,
    pub(super) seed: u64,
}

/// One sample of a pixel.
pub(super) struct Sample {
    pub(super) primary: Ray,
    hit: Option<Hit>,
    /// The ray that the sample is about.
    pub(super) traced: Option<Ray>,
}

/// How far an occlusion ray reaches, in diagonals of the scene.
const REACH: f32 = 0.1;

/// Light and colours, linear, of a plain picture.
const BACKGROUND: Vec3 = Vec3::new(0.92, 0.94, 0.97);
const MATT: Vec3 = Vec3::new(0.72, 0.76, 0.82);
const WARM: Vec3 = Vec3::new(0.95, 0.88, 0.76);
const COOL: Vec3 = Vec3::new(0.16, 0.20, 0.28);

/// Brightness of what lies outside the scene.
const SKY: f32 = 0.8;

impl Samples<'_> {
    /// The samples of a pixel, always the same ones.
    pub(super) fn of(&self, pixel: usize) -> impl Iterator<Item = Sample> + '_ {
        (0..self.spp).filter_map(move |k| {
            // A sequence that fills the pixel evenly from its middle (Roberts' R2).
            let place =
                [0.754_877_666_246_692_7, 0.569_840_290_998_053_3].map(|step| (0.5 + step * f64::from(k)).fract());
            let primary = self.camera.ray(pixel, place)?;
            let number = pixel as u64 * u64::from(self.spp) + u64::from(k);
            Some(self.sample(primary, &mut Rng::new(self.seed ^ Rng::new(number).bits())))
        })
    }

    /// The colour of a pixel: the mean of its samples.
    pub(super) fn colour(&self, pixel: usize) -> [u8; 3] {
        let (sum, n) = self.of(pixel).fold((Vec3::ZERO, 0.0), |(sum, n), sample| (sum + self.seen(&sample), n + 1.0));
        let mean = if n > 0.0 { sum / n } else { Vec3::ZERO };
        // Normals are numbers; all others are brightness, which screens raise to this power.
        let shown = if self.rays == Rays::Normals { mean } else { mean.powf(1.0 / 2.2) };
        (shown * 255.0 + 0.5).to_array().map(|channel| channel as u8)
    }

    fn sample(&self, primary: Ray, rng: &mut Rng) -> Sample {
        let needs_hit = matches!(self.rays, Rays::Ao | Rays::Diffuse);
        let bounced = || {
            let hit = self.tracer.closest(&primary);
            let ray = trace::reflect(&self.scene.mesh, &primary, hit.as_ref()?, rng);
            Some((hit, ray))
        };
        match needs_hit.then(bounced) {
            None => Sample { primary, hit: None, traced: Some(primary) },
            Some(None) => Sample { primary, hit: None, traced: None },
            Some(Some((hit, ray))) => {
                let reach = REACH * self.bvh.bounds().extent().length();
                let traced = if self.rays == Rays::Ao { ray.and_then(|ray| trace::cut(&ray, reach)) } else { ray };
                Sample { primary, hit, traced }
            }
        }
    }

    /// Light along a sample, per channel from 0 to 1.
    fn seen(&self, sample: &Sample) -> Vec3 {
        let primary = &sample.primary;
        let sky = Vec3::splat(SKY);
        match self.rays {
            Rays::Primary => self.matt(primary),
            Rays::Normals => {
                let normal = self.tracer.closest(primary).and_then(|hit| self.normal(primary, &hit));
                normal.map_or(Vec3::ZERO, |normal| normal * 0.5 + 0.5)
            }
            Rays::Ao | Rays::Diffuse if sample.hit.is_none() => sky,
            Rays::Ao => Vec3::splat(sample.traced.map_or(1.0, |ray| f32::from(!self.tracer.any(&ray)))),
            Rays::Diffuse => sample.traced.map_or(sky, |ray| Vec3::splat(self.lit(&ray))),
        }
    }

    /// A matt surface in light from the upper left of the camera, warm, and from above and below, cool.
    fn matt(&self, ray: &Ray) -> Vec3 {
        let Some(hit) = self.tracer.closest(ray) else { return BACKGROUND };
        let Some(normal) = self.normal(ray, &hit) else { return Vec3::ZERO };
        let [forward, right, up] = self.axes;
        let lamp = normal.dot((up * 1.4 - right * 0.8 - forward * 1.2).normalize()).max(0.0);
        let sky = 0.5 + 0.5 * normal.dot(up);
        MATT * (WARM * lamp + COOL * sky).min(Vec3::ONE)
    }

    /// The cosine between a ray and the normal of what it hits.
    fn lit(&self, ray: &Ray) -> f32 {
        let Some(hit) = self.tracer.closest(ray) else { return SKY };
        self.normal(ray, &hit).map_or(0.0, |normal| -normal.dot(ray.direction().normalize_or_zero()))
    }

    /// The unit normal that looks against the ray; `None` for triangles that are too small to have one.
    fn normal(&self, ray: &Ray, hit: &Hit) -> Option<Vec3> {
        let [a, b, c] = self.scene.mesh.triangle(hit.prim as usize);
        let normal = (b - a).cross(c - a).try_normalize()?;
        Some(if normal.dot(ray.direction()) > 0.0 { -normal } else { normal })
    }
}

//! The rays of a pixel, and their colours.

use glam::Vec3;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::Rng;
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::trace::{cut, reflect};
use stackless_bvh::trace::{Hit, RayQueries, Tracer};

use crate::camera::Camera;
use crate::input::Scene;

/// The kind of rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Rays {
    /// Camera rays: a matt surface, lit from the upper left of the camera and by the sky.
    #[default]
    Primary,
    /// Camera rays: colours are the surface normals.
    Normals,
    /// Ambient occlusion at the hits of camera rays, within a tenth of the scene's diagonal.
    Ao,
    /// Closest hits of unbounded rays from the hits of camera rays, lit by a lamp at the camera.
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
    /// Forward, right and up, of the camera.
    pub(super) axes: [Vec3; 3],
    pub(super) rays: Rays,
    /// Samples per pixel.
    pub(super) spp: u32,
    pub(super) seed: u64,
}

/// One sample of a pixel.
pub(super) struct Sample {
    pub(super) primary: Ray,
    hit: Option<Hit>,
    /// The ray of this kind.
    pub(super) traced: Option<Ray>,
}

/// The length of occlusion rays, in diagonals of the scene.
const REACH: f32 = 0.1;

/// Linear light and colours of shaded pictures.
const BACKGROUND: Vec3 = Vec3::new(0.92, 0.94, 0.97);
const MATT: Vec3 = Vec3::new(0.72, 0.76, 0.82);
const WARM: Vec3 = Vec3::new(0.95, 0.88, 0.76);
const COOL: Vec3 = Vec3::new(0.16, 0.20, 0.28);

/// Brightness of rays that leave the scene.
const SKY: f32 = 0.8;

impl Samples<'_> {
    /// The samples of a pixel, equal in each call.
    pub(super) fn of(&self, pixel: usize) -> impl Iterator<Item = Sample> + '_ {
        (0..self.spp).filter_map(move |k| {
            // A sequence that fills the pixel evenly from its centre (Roberts' R2).
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
        // Normals stay linear. Brightness is gamma-corrected for screens.
        let shown = if self.rays == Rays::Normals { mean } else { mean.powf(1.0 / 2.2) };
        (shown * 255.0 + 0.5).to_array().map(|channel| channel as u8)
    }

    fn sample(&self, primary: Ray, rng: &mut Rng) -> Sample {
        let needs_hit = matches!(self.rays, Rays::Ao | Rays::Diffuse);
        let bounced = || {
            let hit = self.tracer.closest(&primary);
            let ray = reflect(&self.scene.mesh, &primary, hit.as_ref()?, rng);
            Some((hit, ray))
        };
        match needs_hit.then(bounced) {
            None => Sample { primary, hit: None, traced: Some(primary) },
            Some(None) => Sample { primary, hit: None, traced: None },
            Some(Some((hit, ray))) => {
                let reach = REACH * self.bvh.bounds().extent().length();
                let traced = if self.rays == Rays::Ao { ray.and_then(|ray| cut(&ray, reach)) } else { ray };
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

    /// A matt surface in warm light from the upper left of the camera, and cool light from above and below.
    fn matt(&self, ray: &Ray) -> Vec3 {
        let Some(hit) = self.tracer.closest(ray) else { return BACKGROUND };
        let Some(normal) = self.normal(ray, &hit) else { return Vec3::ZERO };
        let [forward, right, up] = self.axes;
        let lamp = normal.dot((up * 1.4 - right * 0.8 - forward * 1.2).normalize()).max(0.0);
        let sky = 0.5 + 0.5 * normal.dot(up);
        MATT * (WARM * lamp + COOL * sky).min(Vec3::ONE)
    }

    /// The cosine between a ray and the normal of the triangle that it hits.
    fn lit(&self, ray: &Ray) -> f32 {
        let Some(hit) = self.tracer.closest(ray) else { return SKY };
        self.normal(ray, &hit).map_or(0.0, |normal| -normal.dot(ray.direction().normalize_or_zero()))
    }

    /// The unit normal against the ray; `None` for triangles that are too small.
    fn normal(&self, ray: &Ray, hit: &Hit) -> Option<Vec3> {
        let [a, b, c] = self.scene.mesh.triangle(hit.prim as usize);
        let normal = (b - a).cross(c - a).try_normalize()?;
        Some(if normal.dot(ray.direction()) > 0.0 { -normal } else { normal })
    }
}

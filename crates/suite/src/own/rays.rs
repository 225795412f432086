//! Level `ray`.

use glam::Vec3;
use serde_json::{Value, json};

use crate::ask::Rays;
use crate::text::{hit, parse_floats};
use crate::{Answer, Ask, Query};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::geom::{Kernel, Mesh, MeshError, Ray, RayError};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::trace::{Accuracy, KernelShape, Search, WithTests, with_level};
use stackless_bvh::trace::{BinaryTracer, Hit, MeshQueries};
use stackless_bvh::traverse::{Stack, traverse};

pub(super) fn answer(accuracy: Accuracy, ask: &Ask) -> Option<Answer> {
    let Ask::Ray(asked) = ask else { return None };
    let scene = match asked.read() {
        Ok(scene) => scene,
        Err(error) => return error.code().map(|code| Answer::Reject(code.to_owned())),
    };
    let hits = scene.hits(|mesh, rays| {
        let bvh = Bvh::sah(mesh, SahOptions::default()).map_err(|error| error.to_string())?;
        Ok(match asked.query {
            Query::Closest => with_level(accuracy, Cast { bvh, rays, any: false }),
            Query::Any => with_level(accuracy, Cast { bvh, rays, any: true }),
            // Crossings are counted exactly or not at all.
            Query::Parity => {
                let tracer = BinaryTracer::new(bvh);
                rays.iter().map(|ray| json!(tracer.crossings(ray) % 2 == 1)).collect()
            }
        })
    });
    Some(match hits {
        Ok(hits) => Answer::of([("hits", Value::Array(hits))]),
        Err(error) => Answer::Unsupported(error),
    })
}

struct Cast {
    bvh: Bvh,
    rays: Vec<Ray>,
    any: bool,
}

impl WithTests for Cast {
    type Output = Vec<Value>;

    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape> + 'static, B: Slabs<Vector = Vec3> + 'static>(
        self,
    ) -> Vec<Value> {
        let Self { bvh, rays, any } = self;
        let bvh = bvh.map(K::Shape::from);
        let mut memory = Vec::new();
        let hit = |ray: &Ray| {
            if any {
                let mut search = Search::<K, B, true>::new(&bvh, ray);
                traverse(Stack::new(bvh.tree(), &mut memory), &mut search, &mut ());
                return json!(search.found().is_some());
            }
            let mut search = Search::<K, B, false>::new(&bvh, ray);
            traverse(Stack::new(bvh.tree(), &mut memory), &mut search, &mut ());
            search.hit().map_or(Value::Null, |Hit { prim, t, u, v }| hit(prim, [t, u, v]))
        };
        rays.iter().map(hit).collect()
    }
}

/// Vertices and rays.
type Numbers = (Vec<[f32; 3]>, Vec<[f32; 8]>);

impl Rays {
    /// Builds mesh and rays. Also represents inputs that the library's types exclude: a mesh without triangles, and
    /// intervals at infinity.
    ///
    /// # Errors
    /// [`RaysError`].
    pub fn read(&self) -> Result<RayScene, RaysError> {
        let (vertices, rays) = self.numbers()?;
        let vertices: Vec<_> = vertices.into_iter().map(Vec3::from_array).collect();
        let mesh = if self.triangles.is_empty() {
            if let Some(vertex) = vertices.iter().position(|v| !v.is_finite()) {
                return Err(MeshError::NonFinite { vertex, position: vertices[vertex].as_dvec3() }.into());
            }
            None
        } else {
            Some(Mesh::new(vertices, self.triangles.clone())?)
        };
        let ray = |[a, b, c, x, y, z, tmin, tmax]: [f32; 8]| {
            // No distance is infinite, so the ray misses. Origin and direction must still be valid.
            let is_nowhere = tmin == f32::INFINITY && tmax == f32::INFINITY;
            let within = if is_nowhere { [0.0, tmax] } else { [tmin, tmax] };
            let ray = Ray::within(Vec3::new(a, b, c), Vec3::new(x, y, z), within[0], within[1])?;
            Ok((!is_nowhere).then_some(ray))
        };
        let rays = rays.into_iter().map(ray).collect::<Result<_, RaysError>>()?;
        Ok(RayScene { mesh, rays, missed: if self.query == Query::Closest { Value::Null } else { json!(false) } })
    }

    /// Returns vertices and rays as numbers.
    ///
    /// # Errors
    /// [`RaysError::Floats`].
    pub fn numbers(&self) -> Result<Numbers, RaysError> {
        fn all<const N: usize>(texts: &[String]) -> Result<Vec<[f32; N]>, RaysError> {
            texts.iter().map(|text| parse_floats(text).ok_or(RaysError::Floats)).collect()
        }
        Ok((all(&self.vertices)?, all(&self.rays)?))
    }
}

/// A valid mesh with rays.
#[derive(Clone, Debug)]
pub struct RayScene {
    /// `None` without triangles.
    mesh: Option<Mesh>,
    /// `None` if the interval is at infinity.
    rays: Vec<Option<Ray>>,
    /// The answer for a miss.
    missed: Value,
}

impl RayScene {
    /// Returns the answers of all rays. `trace` gets the rays that can hit, and returns one answer for each.
    ///
    /// # Errors
    /// The errors of `trace`.
    pub fn hits<E>(&self, trace: impl FnOnce(&Mesh, Vec<Ray>) -> Result<Vec<Value>, E>) -> Result<Vec<Value>, E> {
        let asked: Vec<Ray> = self.rays.iter().copied().flatten().collect();
        let found = match &self.mesh {
            Some(mesh) if !asked.is_empty() => trace(mesh, asked)?,
            _ => Vec::new(),
        };
        let mut found = found.into_iter();
        let answer = |ray: &Option<Ray>| ray.and_then(|_| found.next()).unwrap_or_else(|| self.missed.clone());
        Ok(self.rays.iter().map(answer).collect())
    }
}

/// Errors of decoding a mesh and rays.
#[derive(Debug, thiserror::Error)]
pub enum RaysError {
    /// A text has the wrong number of floats.
    #[error("expected floats of 8 hexadecimal digits, a space between")]
    Floats,
    /// The triangles are not a valid mesh.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// The numbers are not a valid ray.
    #[error("{0}")]
    Ray(#[from] RayError),
}

impl RaysError {
    /// Returns the code of the rejection; `None` if the suite has no code for it.
    pub const fn code(&self) -> Option<&'static str> {
        Some(match self {
            Self::Mesh(MeshError::NonFinite { .. }) | Self::Ray(RayError::Origin(_) | RayError::Direction(_)) => {
                "not-finite"
            }
            Self::Mesh(MeshError::Index { .. }) => "index",
            Self::Ray(RayError::ZeroDirection) => "no-direction",
            Self::Ray(RayError::Interval { .. } | RayError::NegativeTmin(_) | RayError::EmptyInterval { .. }) => {
                "interval"
            }
            _ => return None,
        })
    }
}

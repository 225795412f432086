//! Level `ray`.

use glam::Vec3;
use serde_json::{Value, json};

use crate::ask::Rays;
use crate::text::{hit, parse_floats};
use crate::{Answer, Ask, Query};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::geom::{Kernel, Mesh, MeshError, Ray, RayError, Slabs};
use stackless_bvh::trace::{Accuracy, Form, Hit, Search, WithTests, with_level};
use stackless_bvh::traverse::{Stack, traverse};

pub(super) fn answer(accuracy: Accuracy, ask: &Ask) -> Option<Answer> {
    let Ask::Ray(asked) = ask else { return None };
    let (mesh, rays) = match asked.read() {
        Ok(read) => read,
        Err(error) => return error.code().map(|code| Answer::Reject(code.to_owned())),
    };
    let bvh = Bvh::sah(&mesh, SahOptions::default()).ok()?;
    Some(with_level(accuracy, Cast { bvh, rays, query: asked.query }))
}

struct Cast {
    bvh: Bvh,
    rays: Vec<Ray>,
    query: Query,
}

impl WithTests for Cast {
    type Output = Answer;

    fn call<K: Kernel<Vector = Vec3, Shape: Form> + 'static, B: Slabs<Vector = Vec3> + 'static>(self) -> Answer {
        let Self { bvh, rays, query } = self;
        let bvh = bvh.map(K::Shape::from);
        let mut memory = Vec::new();
        let hit = |ray: &Ray| match query {
            Query::Closest => {
                let mut search = Search::<K, B, false>::new(&bvh, ray);
                traverse(Stack::new(bvh.tree(), &mut memory), &mut search, &mut ());
                search.hit().map_or(Value::Null, |Hit { prim, t, u, v }| hit(prim, [t, u, v]))
            }
            Query::Any => {
                let mut search = Search::<K, B, true>::new(&bvh, ray);
                traverse(Stack::new(bvh.tree(), &mut memory), &mut search, &mut ());
                json!(search.found().is_some())
            }
        };
        Answer::of([("hits", Value::Array(rays.iter().map(hit).collect()))])
    }
}

impl Rays {
    /// The mesh and the rays.
    ///
    /// # Errors
    /// [`RaysError`].
    pub fn read(&self) -> Result<(Mesh, Vec<Ray>), RaysError> {
        let vertices =
            self.vertices.iter().map(|text| parse_floats(text).map(Vec3::from_array).ok_or(RaysError::Floats));
        let mesh = Mesh::new(vertices.collect::<Result<_, _>>()?, self.triangles.clone())?;
        let ray = |text: &String| {
            let [a, b, c, x, y, z, tmin, tmax] = parse_floats(text).ok_or(RaysError::Floats)?;
            Ok(Ray::within(Vec3::new(a, b, c), Vec3::new(x, y, z), tmin, tmax)?)
        };
        let rays = self.rays.iter().map(ray).collect::<Result<_, RaysError>>()?;
        Ok((mesh, rays))
    }
}

/// Why texts are no mesh and rays.
#[derive(Debug, thiserror::Error)]
pub enum RaysError {
    /// A text is not as many floats as there should be.
    #[error("expected floats of 8 hexadecimal digits, a space between")]
    Floats,
    /// The triangles are no mesh.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// The numbers are no ray.
    #[error("{0}")]
    Ray(#[from] RayError),
}

impl RaysError {
    /// The code by which the input is rejected; `None` if the suite has none for it.
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

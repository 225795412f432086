//! Level `ray`.

use glam::Vec3;
use serde_json::{Value, json};

use crate::bvh::{Bvh, SahOptions};
use crate::geom::{Ray, RayError};
use crate::scene::{Mesh, MeshError};
use crate::suite::ask::Rays;
use crate::suite::author::hit;
use crate::suite::text::parse_floats;
use crate::suite::{Answer, Ask, Query};
use crate::trace::Tracer;

pub(super) fn answer(ask: &Ask) -> Option<Answer> {
    let Ask::Ray(asked) = ask else { return None };
    let (mesh, rays) = match read(asked)? {
        Ok(read) => read,
        Err(code) => return Some(Answer::Reject(code.to_owned())),
    };
    let bvh = Bvh::sah(&mesh, SahOptions::default()).ok()?;
    let tracer = Tracer::new(&bvh);
    let hits: Vec<Value> = match asked.query {
        Query::Closest => tracer.closest_each(&rays).into_iter().map(hit).collect(),
        Query::Any => tracer.any_each(&rays).into_iter().map(|any| json!(any)).collect(),
    };
    Some(Answer::of([("hits", Value::Array(hits))]))
}

/// Mesh and rays, or the code of what is wrong with them; `None` where texts are no numbers.
fn read(asked: &Rays) -> Option<Result<(Mesh, Vec<Ray>), &'static str>> {
    let vertices = asked.vertices.iter().map(|vertex| parse_floats(vertex).map(Vec3::from_array));
    let mesh = match Mesh::new(vertices.collect::<Option<_>>()?, asked.triangles.clone()) {
        Ok(mesh) => mesh,
        Err(MeshError::NonFinite { .. }) => return Some(Err("not-finite")),
        Err(MeshError::Index { .. }) => return Some(Err("index")),
        Err(_) => return None,
    };
    let mut rays = Vec::new();
    for ray in &asked.rays {
        let [a, b, c, x, y, z, tmin, tmax] = parse_floats(ray)?;
        rays.push(match Ray::new(Vec3::new(a, b, c), Vec3::new(x, y, z), tmin, tmax) {
            Ok(ray) => ray,
            Err(RayError::Origin(_) | RayError::Direction(_)) => return Some(Err("not-finite")),
            Err(RayError::ZeroDirection) => return Some(Err("no-direction")),
            Err(RayError::Interval { .. } | RayError::NegativeTmin(_) | RayError::EmptyInterval { .. }) => {
                return Some(Err("interval"));
            }
        });
    }
    Some(Ok((mesh, rays)))
}

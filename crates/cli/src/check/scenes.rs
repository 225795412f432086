//! Checks of scenes and their rays, in single or in double precision.

use std::error::Error;
use std::path::PathBuf;
use std::str::FromStr;

use glam::DVec3;
use serde_json::Value;
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Kernel, Mesh, MeshError, Ray, RayError, Triangle, Vector};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::geom::kernel::{Exact, Exact64};
use stackless_bvh::internals::geom::slabs::{Directed, Slabs64};
use stackless_bvh::internals::trace::Truth;
use stackless_check::{Plan, SceneDisagreement, SceneTree, Shard, check_scene};
use stackless_scene::Position;

use super::{SceneFault, Total};
use crate::build;
use crate::input::{self, MADE, Scene};
use crate::output::{bar, warn};
use crate::record::{Run, fingerprint, in_blocks};

/// The checked scenes, in one precision.
pub(super) enum Scenes {
    Single(Vec<Scene>),
    Double(Vec<Scene<DVec3>>),
}

/// The translation of scenes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shift(DVec3);

impl FromStr for Shift {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[x, y, z]) if DVec3::new(x, y, z).is_finite() => Ok(Self(DVec3::new(x, y, z))),
            _ => Err("expected X,Y,Z: three finite numbers".to_owned()),
        }
    }
}

impl Scenes {
    /// Loads the scenes at these paths.
    pub(super) fn load(paths: &[PathBuf], double: bool, shift: Shift) -> Result<Self, Box<dyn Error>> {
        if !double {
            return Ok(Self::Single(input::scenes(paths)?));
        }
        let mut scenes = input::scenes::<DVec3>(paths)?;
        for Scene { name, mesh, .. } in &mut scenes {
            let vertices = mesh.vertices().iter().map(|&vertex| vertex + shift.0).collect();
            *mesh = Mesh::new(vertices, mesh.triangles().to_vec()).map_err(|error| format!("{name}: {error}"))?;
        }
        Ok(Self::Double(scenes))
    }

    /// The generated scenes.
    pub(super) fn made(double: bool, shift: Shift) -> Result<Self, Box<dyn Error>> {
        Self::load(&MADE.map(PathBuf::from), double, shift)
    }

    pub(super) fn is_empty(&self) -> bool {
        match self {
            Self::Single(scenes) => scenes.is_empty(),
            Self::Double(scenes) => scenes.is_empty(),
        }
    }

    pub(super) fn fingerprints(&self) -> Vec<Value> {
        match self {
            Self::Single(scenes) => scenes.iter().map(|scene| fingerprint(&scene.mesh)).collect(),
            Self::Double(scenes) => scenes.iter().map(|scene| fingerprint(&scene.mesh)).collect(),
        }
    }

    /// Checks `count` rays through each scene.
    pub(super) fn check(
        &self,
        plan: &Plan,
        count: u64,
        shard: Shard,
        run: &mut Run,
        total: &mut Total,
    ) -> Result<(), Box<dyn Error>> {
        let mut take = |index| run.take(shard, &format!("rays of scene {index}"), count);
        match self {
            Self::Single(scenes) => {
                for (index, scene) in scenes.iter().enumerate() {
                    let numbers = take(index);
                    // A part of a run may have no rays of a scene.
                    if numbers.is_empty() {
                        continue;
                    }
                    let truth = Truth::new(&scene.mesh);
                    let drawn = in_blocks(numbers, count, plan.seed, |seed, n| procedural::rays(&scene.mesh, seed, n));
                    check_one::<Exact, Directed, _>(plan, index, scene, &truth, &drawn.collect::<Vec<_>>(), total)?;
                }
            }
            Self::Double(scenes) => {
                for (index, scene) in scenes.iter().enumerate() {
                    let numbers = take(index);
                    if numbers.is_empty() {
                        continue;
                    }
                    let (home, truth) = (Home::of(&scene.mesh)?, Truth::new(&scene.mesh));
                    let drawn = in_blocks(numbers, count, plan.seed, |seed, n| procedural::rays(&home.mesh, seed, n));
                    let rays = drawn.map(|(number, ray)| {
                        let ray = home.ray(&ray)?;
                        // `procedural::rays` does not aim at corners, so half of the rays get a new direction.
                        let aimed = if number / 8 % 2 == 1 { aimed(&truth, &scene.mesh, &ray) } else { None };
                        Ok((number, aimed.unwrap_or(ray)))
                    });
                    let rays = rays.collect::<Result<Vec<_>, RayError>>()?;
                    check_one::<Exact64, Slabs64, _>(plan, index, scene, &truth, &rays, total)?;
                    // A translation may create triangles without area.
                    if let Some(note) = scene.degenerate_note() {
                        warn(&note);
                    }
                }
            }
        }
        Ok(())
    }
}

/// A mesh translated and scaled to the origin and a size of about 1, in single precision. Rays are drawn there.
struct Home {
    mesh: Mesh,
    origin: DVec3,
    unit: f64,
}

impl Home {
    fn of(mesh: &Mesh<DVec3>) -> Result<Self, MeshError> {
        let frame = <DVec3 as Vector>::frame(mesh.vertices().iter().copied());
        let (origin, unit) = (frame.origin(), 2f64.powi(frame.exponent()));
        let vertices = mesh.vertices().iter().map(|&vertex| ((vertex - origin) / unit).as_vec3()).collect();
        Ok(Self { mesh: Mesh::new(vertices, mesh.triangles().to_vec())?, origin, unit })
    }

    /// Maps a ray to the original mesh.
    fn ray(&self, ray: &Ray) -> Result<Ray<DVec3>, RayError> {
        let [o, d] = [ray.origin(), ray.direction()].map(|v| v.as_dvec3() * self.unit);
        Ray::within(o + self.origin, d, ray.tmin().into(), ray.tmax().into())
    }
}

/// A ray from the origin of `ray` to a corner of the triangle that it hits, or to the middle of an edge. `None` on a
/// miss.
fn aimed(truth: &Truth<DVec3>, mesh: &Mesh<DVec3>, ray: &Ray<DVec3>) -> Option<Ray<DVec3>> {
    let hit = truth.closest(ray)?.rounded();
    let [a, b, c] = mesh.triangle(hit.prim as usize);
    let target = match (hit.u > 0.5, hit.v > 0.5) {
        (true, _) => b,
        (_, true) => c,
        _ if hit.u + hit.v < 0.5 => a,
        _ => (b + c) * 0.5,
    };
    Ray::new(ray.origin(), target - ray.origin()).ok()
}

/// Checks rays through the scene under the trees of [`build::CHECKED`]. Keeps the first disagreement under each tree.
fn check_one<K, B, V>(
    plan: &Plan,
    index: usize,
    scene: &Scene<V>,
    truth: &Truth<V>,
    rays: &[(u64, Ray<V>)],
    total: &mut Total,
) -> Result<(), Box<dyn Error>>
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Position,
{
    let Some(&(first, _)) = rays.first() else { return Ok(()) };
    let rays: Vec<_> = rays.iter().map(|&(_, ray)| ray).collect();
    for build in build::CHECKED {
        let bvh = build::binary(build, scene)?;
        let progress = bar(rays.len() as u64, &scene.name);
        let tree = SceneTree::new(truth, &bvh);
        let (tally, found) = check_scene::<K, B, V>(plan, &tree, &rays, &|done| progress.inc(done));
        progress.finish_and_clear();
        let found = found.map(|found| SceneDisagreement { number: first + found.number, ..found });
        total.scenes.extend(found.map(|found| SceneFault::new(index, scene, build, &found)));
        total.tally = std::mem::take(&mut total.tally).merge(&tally);
        // The part with the first ray counts the tree.
        total.trees += u64::from(first == 0);
        total.rays += rays.len() as u64;
    }
    Ok(())
}

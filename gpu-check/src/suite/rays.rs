//! Level `ray`: `grid` with the test in single precision, `exact` with the test that reports certain results.

use serde_json::{Value, json};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::trace::{BinaryTracer, Hit, RayQueries};
use stackless_bvh::tree::Topology as _;
use stackless_suite::{Answer, Ask, Query as Asked};

use super::{Device, lazily, result};
use crate::exact::{self, EDGE_FACTOR, UNCERTAIN};
use crate::launch::BINDINGS;
use crate::model::Found;
use crate::probe::Arithmetic;
use crate::scene::{Query, SINGLE, Scene, takes, takes_ray};
use crate::{GpuError, Pipeline, rays};

/// Number of rays of `ray/exact`, and of certain rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Rays.
    pub rays: usize,
    /// Number of rays that the device answered.
    pub certain: usize,
}

/// A kernel with both tests, for closest-hit and any-hit queries.
#[derive(Debug)]
pub(super) struct Rays {
    arithmetic: Arithmetic,
    pipelines: [[Option<Pipeline>; 2]; 2],
    share: Share,
}

impl Rays {
    pub(super) fn new(arithmetic: Arithmetic) -> Self {
        Self { arithmetic, pipelines: Default::default(), share: Share::default() }
    }

    pub(super) const fn share(&self) -> Share {
        self.share
    }

    pub(super) fn answer(&mut self, device: &Device<'_>, profile: &str, ask: &Ask) -> Result<Option<Answer>, GpuError> {
        let Ask::Ray(asked) = ask else { return Ok(None) };
        let scene = match asked.read() {
            Ok(scene) => scene,
            Err(error) => return Ok(error.code().map(|code| Answer::Reject(code.to_owned()))),
        };
        if profile != "exact" && self.arithmetic.refines().is_err() {
            return Ok(None);
        }
        let any = asked.query == Asked::Any;
        let hits = scene.hits(|mesh, rays| self.trace(device, profile, mesh, &rays, any))?;
        Ok(Some(result([("hits", Value::Array(hits))])))
    }

    /// Returns one answer for each ray.
    fn trace(
        &mut self,
        device: &Device<'_>,
        profile: &str,
        mesh: &Mesh,
        rays: &[Ray],
        any: bool,
    ) -> Result<Vec<Value>, GpuError> {
        let bvh = Bvh::sah(mesh, SahOptions::default()).map_err(|error| GpuError::Data(error.to_string()))?;
        if bvh.depth() > device.scene_depth() {
            return Err(GpuError::Data(format!("a hierarchy of {} edges", bvh.depth())));
        }
        if profile == "exact" {
            return self.exact(device, &bvh, rays, any);
        }
        let refines = self.arithmetic.refines().unwrap_or(false);
        let pipeline = self.pipeline(device, SINGLE, [0, usize::from(any)], refines)?;
        let scene = Scene::new(device.gpu, &bvh)?;
        let found = rays::launch(device.gpu, &scene, &device.kernel, pipeline, rays)?;
        let hit = |found: &Found| {
            let [u, v] = found.weights;
            found.is_hit().then_some(Hit { prim: found.triangle, t: found.t, u, v })
        };
        Ok(found.iter().map(|found| if any { json!(found.is_hit()) } else { text(hit(found)) }).collect())
    }

    fn exact(&mut self, device: &Device<'_>, bvh: &Bvh, rays: &[Ray], any: bool) -> Result<Vec<Value>, GpuError> {
        // Unsupported rays are in doubt from the start.
        let mut found = vec![UNCERTAIN; rays.len()];
        let taken: Vec<usize> = (0..rays.len()).filter(|&i| takes(bvh) && takes_ray(&rays[i])).collect();
        if !taken.is_empty() {
            let test = exact::triangles(&self.arithmetic, EDGE_FACTOR);
            let pipeline = self.pipeline(device, &test, [1, usize::from(any)], false)?;
            let scene = Scene::new(device.gpu, bvh)?;
            let within: Vec<Ray> = taken.iter().map(|&i| rays[i]).collect();
            let said = exact::launch(device.gpu, &scene, &device.kernel, pipeline, &within)?;
            taken.iter().zip(said).for_each(|(&i, said)| found[i] = said);
        }
        self.share.rays += rays.len();
        self.share.certain += found.iter().filter(|&&said| said != UNCERTAIN).count();
        if !any {
            return Ok(exact::settle(bvh, rays, &found)?.0.into_iter().map(text).collect());
        }
        let tracer = BinaryTracer::new(bvh);
        let settled = |(ray, &said): (&Ray, &u32)| match said {
            UNCERTAIN => tracer.any(ray),
            said => said != u32::MAX,
        };
        Ok(rays.iter().zip(&found).map(settled).map(|hit| json!(hit)).collect())
    }

    fn pipeline(
        &mut self,
        device: &Device<'_>,
        triangles: &str,
        [test, any]: [usize; 2],
        refines: bool,
    ) -> Result<&Pipeline, GpuError> {
        let query = Query { triangles, any: any == 1, parallel: true, refines };
        let made = lazily(&mut self.pipelines[test][any], || {
            let source = Scene::source_for_any(device.gpu, &device.kernel, query, device.scene_depth());
            device.compile(&device.kernel.full_name(), &source, &BINDINGS)
        })?;
        Ok(made)
    }
}

fn text(hit: Option<Hit>) -> Value {
    let bits = |float: f32| json!(format!("{:08x}", float.to_bits()));
    hit.map_or(Value::Null, |Hit { prim, t, u, v }| json!({ "prim": prim, "t": bits(t), "u": bits(u), "v": bits(v) }))
}

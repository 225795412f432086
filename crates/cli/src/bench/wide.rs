//! The traversals of wide trees.

use cpu_time::ProcessTime;
use stackless_bvh::bvh::WideBvh;
use stackless_bvh::geom::Ray;
use stackless_bvh::geom::lanes::Level;
use stackless_bvh::trace::{Accuracy, Tracer};
use stackless_bvh::wide::{Method, Topology};

use super::Contestant;
use crate::build::Build;
use crate::input::Scene;
use crate::judge::{Answer, Query};

/// A wide hierarchy over a mesh.
pub(super) struct WideTree {
    build: Build,
    bvh: WideBvh,
    build_seconds: f64,
}

/// How rays are traced.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    /// With the instructions of this level.
    pub(super) level: Level,
    /// One at a time, not two in turns.
    pub(super) is_alone: bool,
}

impl WideTree {
    pub(super) fn build(scene: &Scene, build: Build) -> Result<Self, Box<dyn std::error::Error>> {
        let start = ProcessTime::now();
        let bvh = build.run_wide(scene)?;
        Ok(Self { build, bvh, build_seconds: start.elapsed().as_secs_f64() })
    }

    pub(super) fn contestant(
        &self,
        method: Method,
        manner: Manner,
    ) -> Result<Box<dyn Contestant + '_>, Box<dyn std::error::Error>> {
        let tracer = Tracer::with_method(&self.bvh, method)?.with_level(manner.level);
        Ok(Box::new(Runner { tree: self, tracer, is_alone: manner.is_alone }))
    }
}

struct Runner<'a> {
    tree: &'a WideTree,
    tracer: Tracer<&'a WideBvh>,
    is_alone: bool,
}

impl Contestant for Runner<'_> {
    fn method(&self) -> &'static str {
        self.tracer.method().name()
    }

    fn build(&self) -> Option<Build> {
        Some(self.tree.build)
    }

    fn accuracy(&self) -> Option<Accuracy> {
        Some(Accuracy::Exact)
    }

    fn trace(&mut self, query: Query, rays: &[Ray], _: usize, answers: &mut [Answer]) {
        let piece = if self.is_alone { 1 } else { rays.len().max(1) };
        for (rays, answers) in rays.chunks(piece).zip(answers.chunks_mut(piece)) {
            match (query, rays) {
                (Query::Closest, [ray]) => answers[0] = self.tracer.closest_distance(ray),
                (Query::Closest, _) => self.tracer.closest_distances(rays, answers),
                (Query::Any, [ray]) => answers[0] = answer_of(self.tracer.any(ray)),
                (Query::Any, _) => {
                    let hits = self.tracer.any_each(rays);
                    answers.iter_mut().zip(hits).for_each(|(answer, hit)| *answer = answer_of(hit));
                }
            }
        }
    }

    fn nodes(&mut self, query: Query, rays: &[Ray]) -> Option<u64> {
        let counters = (query == Query::Closest).then(|| self.tracer.count_closest(rays))?;
        Some(counters.nodes + counters.leaves)
    }

    fn state_bytes(&self) -> Option<usize> {
        Some(self.tracer.method().state_bytes::<8>(self.tree.bvh.levels() as usize))
    }

    fn build_seconds(&self) -> f64 {
        self.tree.build_seconds
    }
}

/// Whether anything is hit. Which triangle does not count.
fn answer_of(hit: bool) -> Answer {
    hit.then_some((0, 0.0))
}

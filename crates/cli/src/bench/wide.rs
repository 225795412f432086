//! The traversals of wide trees.

use std::borrow::Borrow;
use std::hint::black_box;

use stackless_bvh::bvh::{Builder, WideBvh};
use stackless_bvh::geom::{Precision, Ray, Real as _};
use stackless_bvh::internals::geom::lanes::Level;
use stackless_bvh::internals::trace::Accuracy;
use stackless_bvh::trace::{Hit, RayQueries, Tracer};
use stackless_bvh::wide::{Method, Topology};

use super::{Contestant, timed};
use crate::build;
use crate::input::Scene;
use crate::judge::{Answer, Query};

/// A wide hierarchy over a mesh.
pub(super) struct WideTree {
    build: Builder,
    bvh: WideBvh,
    build_seconds: f64,
}

/// The method of tracing.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    /// The instruction level.
    pub(super) level: Level,
    /// Traces single rays instead of two interleaved rays.
    pub(super) is_alone: bool,
    /// Computes the weights of closest hits.
    pub(super) with_weights: bool,
}

impl Manner {
    /// Traces rays, in either precision.
    pub(super) fn trace<V: Precision>(
        self,
        tracer: &Tracer<impl Borrow<WideBvh<8, V>>, V>,
        query: Query,
        rays: &[Ray<V>],
        answers: &mut [Option<(u32, V::Real)>],
    ) {
        // `black_box` keeps the weights, which would otherwise not be computed.
        let of_hit = |hit: Option<Hit<V::Real>>| hit.map(|hit| (hit.prim, black_box(hit).t));
        let of_any = |is_hit: bool| is_hit.then_some((0, V::Real::ZERO));
        let piece = if self.is_alone { 1 } else { rays.len().max(1) };
        for (rays, answers) in rays.chunks(piece).zip(answers.chunks_mut(piece)) {
            match (query, rays) {
                (Query::Closest, [ray]) if self.with_weights => answers[0] = of_hit(tracer.closest(ray)),
                (Query::Closest, [ray]) => answers[0] = tracer.closest_distance(ray),
                (Query::Any, [ray]) => answers[0] = of_any(tracer.any(ray)),
                (Query::Closest, _) if self.with_weights => {
                    answers.iter_mut().zip(tracer.closest_each(rays)).for_each(|(answer, hit)| *answer = of_hit(hit));
                }
                (Query::Closest, _) => tracer.closest_distances(rays, answers),
                (Query::Any, _) => {
                    answers.iter_mut().zip(tracer.any_each(rays)).for_each(|(answer, hit)| *answer = of_any(hit));
                }
            }
        }
    }
}

impl WideTree {
    pub(super) fn build(scene: &Scene, build: Builder) -> Result<Self, Box<dyn std::error::Error>> {
        let (bvh, build_seconds) = timed(|| build::wide(build, scene))?;
        Ok(Self { build, bvh, build_seconds })
    }

    pub(super) fn contestant(
        &self,
        method: Method,
        manner: Manner,
    ) -> Result<Box<dyn Contestant + '_>, Box<dyn std::error::Error>> {
        let tracer = Tracer::with_method(&self.bvh, method)?.with_level(manner.level);
        Ok(Box::new(Runner { tree: self, tracer, manner }))
    }
}

struct Runner<'a> {
    tree: &'a WideTree,
    tracer: Tracer<&'a WideBvh>,
    manner: Manner,
}

impl Contestant for Runner<'_> {
    fn method(&self) -> &'static str {
        self.tracer.method().name()
    }

    fn build(&self) -> Option<Builder> {
        Some(self.tree.build)
    }

    fn accuracy(&self) -> Option<Accuracy> {
        Some(Accuracy::Exact)
    }

    fn trace(&mut self, query: Query, rays: &[Ray], _: usize, answers: &mut [Answer]) {
        self.manner.trace(&self.tracer, query, rays, answers);
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

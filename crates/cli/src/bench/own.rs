//! The traversals of this library, with the tests of a level of accuracy.

use glam::Vec3;
use stackless_bvh::bvh::{BuildError, Builder, Bvh};
use stackless_bvh::geom::{Kernel, Ray};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::trace::{Accuracy, KernelBvhs, KernelShape, WithTests, with_level};
use stackless_bvh::trace::{BinaryTracer, RayQueries};
use stackless_bvh::traverse::{Method, Unsupported};
use stackless_bvh::tree::{Recorded, Topology};

use super::{Contestant, timed};
use crate::build;
use crate::input::Scene;
use crate::judge::{Answer, Query};

/// The trees over a mesh.
pub(super) struct Trees {
    build: Builder,
    /// With uncles in the records.
    uncles: KernelBvhs,
    /// With parents and siblings in the records.
    parents: KernelBvhs,
    build_seconds: f64,
}

impl Trees {
    pub(super) fn build(scene: &Scene, build: Builder) -> Result<Self, BuildError> {
        let (bvh, build_seconds) = timed(|| build::binary(build, scene))?;
        let uncles = KernelBvhs::new(bvh.clone().with_links(Recorded::Uncles));
        Ok(Self { build, uncles, parents: KernelBvhs::new(bvh), build_seconds })
    }

    pub(super) fn bvh(&self) -> &Bvh {
        self.parents.corners()
    }

    /// Returns a traversal, over the tree with the records that it needs.
    pub(super) fn contestant(
        &self,
        method: Method,
        accuracy: Accuracy,
    ) -> Result<Box<dyn Contestant + '_>, Unsupported> {
        with_level(accuracy, MakeRunner { trees: self, method, accuracy })
    }
}

struct MakeRunner<'a> {
    trees: &'a Trees,
    method: Method,
    accuracy: Accuracy,
}

impl<'a> WithTests for MakeRunner<'a> {
    type Output = Result<Box<dyn Contestant + 'a>, Unsupported>;

    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape> + 'static, B: Slabs<Vector = Vec3> + 'static>(
        self,
    ) -> Self::Output {
        let forms = match self.method.wants_recorded() {
            Recorded::Uncles => &self.trees.uncles,
            _ => &self.trees.parents,
        };
        Ok(Box::new(Runner { tracer: BinaryTracer::<_, K, B>::with_tests(forms.of(), self.method)?, make: self }))
    }
}

/// A traversal with its tree, the tree's tables, and the types of its tests.
struct Runner<'a, K: Kernel, B> {
    make: MakeRunner<'a>,
    tracer: BinaryTracer<&'a Bvh<K::Shape>, K, B>,
}

impl<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>> Contestant for Runner<'_, K, B> {
    fn method(&self) -> &'static str {
        self.make.method.name()
    }

    fn build(&self) -> Option<Builder> {
        Some(self.make.trees.build)
    }

    fn accuracy(&self) -> Option<Accuracy> {
        Some(self.make.accuracy)
    }

    fn trace(&mut self, query: Query, rays: &[Ray], _: usize, answers: &mut [Answer]) {
        match query {
            Query::Closest => self.tracer.closest_distances(rays, answers),
            Query::Any => {
                let hits = self.tracer.any_each(rays);
                // The query does not report a triangle.
                answers.iter_mut().zip(hits).for_each(|(answer, hit)| *answer = hit.then_some((0, 0.0)));
            }
        }
    }

    fn nodes(&mut self, query: Query, rays: &[Ray]) -> Option<u64> {
        let counters = match query {
            Query::Closest => self.tracer.count_closest(rays),
            Query::Any => self.tracer.count_any(rays),
        };
        Some(counters.inner + counters.leaves)
    }

    fn state_bytes(&self) -> Option<usize> {
        Some(self.make.method.state_bytes_in(self.tracer.word(), self.tracer.bvh().depth()))
    }

    fn build_seconds(&self) -> f64 {
        self.make.trees.build_seconds
    }
}

//! The traversals of this library, each with the tests of a level.

use std::marker::PhantomData;

use cpu_time::ProcessTime;
use glam::Vec3;
use stackless_bvh::bvh::{BuildError, Bvh, SahOptions};
use stackless_bvh::check::run_query;
use stackless_bvh::geom::{Aabb, Kernel, Ray, Slabs};
use stackless_bvh::key::KeyWord;
use stackless_bvh::scene::Mesh;
use stackless_bvh::trace::{self, Accuracy, Counted, Form, Forms, NodeSearch, WithTests};
use stackless_bvh::traverse::{Method, Tables, Unfit, WordName};
use stackless_bvh::tree::{Implicit, Node, Recorded, Topology};

use super::Contestant;
use crate::judge::{Answer, Query};

/// The tree over a mesh.
pub(super) struct Trees {
    /// With uncles in its records.
    uncles: Forms,
    /// With parents and siblings.
    parents: Forms,
    boxes: Vec<Aabb>,
    build_seconds: f64,
}

impl Trees {
    pub(super) fn build(mesh: &Mesh) -> Result<Self, BuildError> {
        let start = ProcessTime::now();
        let bvh = Bvh::sah(mesh, SahOptions::default())?;
        let build_seconds = start.elapsed().as_secs_f64();
        let parents = Forms::new(bvh.clone().with_links(Recorded::ParentSibling));
        Ok(Self { boxes: bvh.own_boxes(), uncles: Forms::new(bvh), parents, build_seconds })
    }

    pub(super) fn bvh(&self) -> &Bvh {
        self.uncles.corners()
    }

    /// A traversal, over the tree whose records suit it.
    pub(super) fn contestant(&self, method: Method, accuracy: Accuracy) -> Box<dyn Contestant + '_> {
        trace::with_level(accuracy, MakeRunner { trees: self, method, accuracy })
    }
}

struct MakeRunner<'a> {
    trees: &'a Trees,
    method: Method,
    accuracy: Accuracy,
}

impl<'a> WithTests for MakeRunner<'a> {
    type Output = Box<dyn Contestant + 'a>;

    fn call<K: Kernel<Vector = Vec3, Shape: Form> + 'static, B: Slabs<Vector = Vec3> + 'static>(self) -> Self::Output {
        // The builder keeps to depths that one of these carries.
        match WordName::narrowest(self.trees.bvh().depth()) {
            WordName::U32 => Box::new(Runner::<K, B, u32>::new(self)),
            _ => Box::new(Runner::<K, B, u64>::new(self)),
        }
    }
}

/// A traversal with its tree, that tree's tables, and the types of its tests and of its words.
struct Runner<'a, K: Kernel, B, W> {
    make: MakeRunner<'a>,
    bvh: &'a Bvh<K::Shape>,
    tables: Tables<'a, Bvh<K::Shape>>,
    memory: Vec<Node>,
    types: PhantomData<fn() -> (B, W)>,
}

impl<'a, K: Kernel<Vector = Vec3, Shape: Form>, B: Slabs<Vector = Vec3>, W: KeyWord> Runner<'a, K, B, W> {
    fn new(make: MakeRunner<'a>) -> Self {
        let forms = match make.method.wants_recorded() {
            Recorded::ParentSibling => &make.trees.parents,
            _ => &make.trees.uncles,
        };
        let bvh = forms.of::<K::Shape>();
        let tables = Tables::new(bvh, bvh.axes(), &[make.method], Implicit::LIMIT);
        Self { make, bvh, tables, memory: Vec::new(), types: PhantomData }
    }

    #[inline(never)]
    fn ask<const ANY: bool>(&mut self, rays: &[Ray], answers: &mut [Answer]) -> Result<(), Unfit> {
        let Self { make: MakeRunner { trees, method, .. }, bvh, tables, memory, .. } = self;
        for (ray, answer) in rays.iter().zip(answers) {
            let mut search = NodeSearch::<K, B, ANY>::new(bvh, &trees.boxes, ray);
            tables.run::<W, _>(*method, ray.octant(), memory, &mut search, &mut ())?;
            *answer = search.found();
        }
        Ok(())
    }

    fn count<const ANY: bool>(&mut self, rays: &[Ray]) -> Result<u64, Unfit> {
        let Self { make: MakeRunner { trees, method, .. }, bvh, tables, memory, .. } = self;
        let mut visits = 0;
        for ray in rays {
            let mut search = Counted::new(NodeSearch::<K, B, ANY>::new(bvh, &trees.boxes, ray));
            run_query(WordName::narrowest(bvh.depth()), tables, *method, ray, memory, &mut search)?;
            visits += search.inner + search.leaves;
        }
        Ok(visits)
    }
}

impl<K: Kernel<Vector = Vec3, Shape: Form>, B: Slabs<Vector = Vec3>, W: KeyWord> Contestant for Runner<'_, K, B, W> {
    fn method(&self) -> &'static str {
        self.make.method.name()
    }

    fn accuracy(&self) -> Option<Accuracy> {
        Some(self.make.accuracy)
    }

    fn trace(&mut self, query: Query, rays: &[Ray], _: usize, answers: &mut [Answer]) -> Result<(), Unfit> {
        match query {
            Query::Closest => self.ask::<false>(rays, answers),
            Query::Any => self.ask::<true>(rays, answers),
        }
    }

    fn nodes(&mut self, query: Query, rays: &[Ray]) -> Result<Option<u64>, Unfit> {
        let visits = match query {
            Query::Closest => self.count::<false>(rays),
            Query::Any => self.count::<true>(rays),
        };
        visits.map(Some)
    }

    fn state_bytes(&self) -> Option<usize> {
        Some(self.make.method.state_bytes::<W>(self.bvh.depth()))
    }

    fn build_seconds(&self) -> f64 {
        self.make.trees.build_seconds
    }
}

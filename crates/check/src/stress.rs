//! Hard rays through every traversal, at any accuracy, against rational arithmetic.

use glam::Vec3;
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, SahOptions};
use stackless_bvh::generate::stress::StressCase;
use stackless_bvh::geom::{Kernel, Slabs};
use stackless_bvh::trace::{Form, Hit, KernelName, NodeSearch, Query, SlabsName, Truth, WithTests, with_tests};
use stackless_bvh::traverse::{Method, Tables, Unfit, WordName};
use stackless_bvh::tree::{Implicit, Topology};

/// How often tests went wrong, in numbers of rays: a ray counts once if any traversal errs with it. `[CONF-2]`
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Errors {
    /// Rays.
    pub rays: u64,
    /// Something is hit, but was not, by the closest-hit or the any-hit query.
    pub false_misses: u64,
    /// Nothing is hit, but was.
    pub false_hits: u64,
    /// Another triangle is the closest.
    pub wrong_primitives: u64,
    /// The greatest distance of a reported `t` from the nearest float to the exact one, in floats between them; where
    /// the triangle is right.
    pub max_ulp: u32,
}

impl Errors {
    /// Whether every answer was right to the last bit.
    pub fn is_none(&self) -> bool {
        Self { rays: 0, ..*self } == Self::default()
    }
}

/// A case with its true answers and its hierarchies.
#[derive(Debug)]
pub struct Stress<'c> {
    case: &'c StressCase,
    truth: Vec<Option<Hit>>,
    /// By surface area, complete, and with triangles in parts that have been moved about.
    trees: [Bvh; 3],
}

impl<'c> Stress<'c> {
    /// Prepares a case.
    ///
    /// # Errors
    /// Those of building; the cases of [`stress`](stackless_bvh::generate::stress) have none.
    pub fn new(case: &'c StressCase) -> Result<Self, BuildError> {
        let truth = Truth::new(&case.mesh);
        let truth = case.rays.iter().map(|ray| truth.closest(ray).map(|hit| hit.rounded())).collect();
        let in_parts = BuildOptions { builder: Builder::Spatial, reinsertion: 2, ..BuildOptions::default() };
        let trees =
            [Bvh::sah(&case.mesh, SahOptions::default())?, Bvh::median(&case.mesh, 2)?, in_parts.build(&case.mesh)?];
        Ok(Self { case, truth, trees })
    }

    /// What the rays truly hit.
    pub fn truth(&self) -> &[Option<Hit>] {
        &self.truth
    }

    /// Traces all rays by all of `methods`, closest hit and any hit, through a tree by surface area, a complete one,
    /// and one with triangles in parts.
    ///
    /// # Errors
    /// A traversal that does not run at all.
    pub fn run(&self, tests: (KernelName, SlabsName), methods: &[Method]) -> Result<Errors, Unfit> {
        with_tests(tests, Run { stress: self, methods })
    }
}

struct Run<'a> {
    stress: &'a Stress<'a>,
    methods: &'a [Method],
}

/// What went wrong with one ray.
#[derive(Clone, Copy, Default)]
struct Wrong {
    miss: bool,
    hit: bool,
    primitive: bool,
}

impl WithTests for Run<'_> {
    type Output = Result<Errors, Unfit>;

    fn call<K: Kernel<Vector = Vec3, Shape: Form>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
        let Stress { case, truth, trees } = self.stress;
        let mut wrong = vec![Wrong::default(); case.rays.len()];
        let mut errors = Errors { rays: case.rays.len() as u64, ..Errors::default() };
        let mut memory = Vec::new();
        for (tree, is_complete) in trees.iter().zip([false, true, false]) {
            let bvh = tree.clone().map(K::Shape::from);
            let boxes = bvh.own_boxes();
            let tables = Tables::new(bvh.tree(), bvh.axes(), self.methods, Implicit::LIMIT);
            let word = WordName::narrowest(bvh.depth());
            for &method in self.methods.iter().filter(|&&method| is_complete || method != Method::Complete) {
                for ((ray, truth), wrong) in case.rays.iter().zip(truth).zip(&mut wrong) {
                    let mut any = NodeSearch::<K, B, true>::new(&bvh, &boxes, ray);
                    let mut closest = NodeSearch::<K, B, false>::new(&bvh, &boxes, ray);
                    // The first hit ends an any-hit query: there is nothing left to be pruned.
                    let queries: [(&mut dyn Query, Method); 2] =
                        [(&mut any, method.without_pruning()), (&mut closest, method)];
                    for (query, method) in queries {
                        tables.run_query(word, method, ray.octant(), &mut memory, query)?;
                    }
                    let (any, closest) = (any.found().is_some(), closest.hit());
                    wrong.miss |= truth.is_some() && (closest.is_none() || !any);
                    wrong.hit |= truth.is_none() && (closest.is_some() || any);
                    if let (Some(truth), Some(found)) = (truth, closest) {
                        wrong.primitive |= truth.prim != found.prim;
                        if truth.prim == found.prim {
                            errors.max_ulp = errors.max_ulp.max(floats_between(truth.t, found.t));
                        }
                    }
                }
            }
        }
        let count = |is_wrong: fn(&Wrong) -> bool| wrong.iter().filter(|&wrong| is_wrong(wrong)).count() as u64;
        errors.false_misses = count(|wrong| wrong.miss);
        errors.false_hits = count(|wrong| wrong.hit);
        errors.wrong_primitives = count(|wrong| wrong.primitive);
        Ok(errors)
    }
}

/// Steps from one float to the other; those of zero are one.
pub fn floats_between(a: f32, b: f32) -> u32 {
    let place = |x: f32| {
        let magnitude = (x.to_bits() & 0x7fff_ffff) as i32;
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b))
}

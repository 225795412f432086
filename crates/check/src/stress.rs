//! Hard rays through every traversal, at any accuracy, against rational arithmetic.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, SahOptions, WideBvh};
use stackless_bvh::generate::stress::StressCase;
use stackless_bvh::geom::lanes;
use stackless_bvh::geom::{Kernel, Real, Slabs};
use stackless_bvh::trace::{Form, Hit, KernelName, NodeSearch, Query, SlabsName, Tracer, Truth, WithTests, with_tests};
use stackless_bvh::traverse::{Method, Tables, Unfit, WordName};
use stackless_bvh::tree::{Implicit, Topology};
use stackless_bvh::wide;

use crate::doubles::{DoubleError, check_doubles};

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

    /// The same rays in double precision, where they are and far from the origin of coordinates: exact.
    ///
    /// # Errors
    /// What [`DoubleError`] lists.
    pub fn run_double(&self, methods: &[Method]) -> Result<Errors, DoubleError> {
        let mut sum = Errors::default();
        for by in [DVec3::ZERO, DVec3::new(6.4e6, -6.4e6, 6.4e6)] {
            let Errors { rays, false_misses, false_hits, wrong_primitives, max_ulp } =
                check_doubles(&self.case.mesh, &self.case.rays, by, methods)?;
            sum = Errors {
                rays: sum.rays + rays,
                false_misses: sum.false_misses + false_misses,
                false_hits: sum.false_hits + false_hits,
                wrong_primitives: sum.wrong_primitives + wrong_primitives,
                max_ulp: sum.max_ulp.max(max_ulp),
            };
        }
        Ok(sum)
    }

    /// The same by traversals of wide trees, with all instructions of this machine, one ray at a time and two in turns:
    /// exact.
    ///
    /// # Errors
    /// What could not be made, in words.
    pub fn run_wide(&self, methods: &[wide::Method]) -> Result<Errors, String> {
        let (rays, mut found) = (&self.case.rays, Findings::new(&self.truth));
        for tree in &self.trees {
            let bvh = WideBvh::of(tree).map_err(|error| error.to_string())?;
            bvh.validate(&self.case.mesh).map_err(|error| error.to_string())?;
            for &method in methods {
                for (_, level) in lanes::levels() {
                    let tracer = Tracer::with_method(&bvh, method).map_err(|unfit| unfit.to_string())?;
                    let tracer = tracer.with_level(level);
                    let (closest, any) = (tracer.closest_each(rays), tracer.any_each(rays));
                    for (i, ray) in rays.iter().enumerate() {
                        found.see(i, any[i], closest[i]);
                        found.see(i, tracer.any(ray), tracer.closest(ray));
                    }
                }
            }
        }
        Ok(found.errors())
    }
}

struct Run<'a> {
    stress: &'a Stress<'a>,
    methods: &'a [Method],
}

/// What goes wrong with each ray.
pub(crate) struct Findings<'t, R> {
    truth: &'t [Option<Hit<R>>],
    wrong: Vec<Wrong>,
    max_ulp: u32,
}

#[derive(Clone, Copy, Default)]
struct Wrong {
    miss: bool,
    hit: bool,
    primitive: bool,
}

impl<'t, R: Real> Findings<'t, R> {
    pub(crate) fn new(truth: &'t [Option<Hit<R>>]) -> Self {
        Self { truth, wrong: vec![Wrong::default(); truth.len()], max_ulp: 0 }
    }

    /// Compares the answers to a ray.
    pub(crate) fn see(&mut self, ray: usize, any: bool, closest: Option<Hit<R>>) {
        let (truth, wrong) = (self.truth[ray], &mut self.wrong[ray]);
        wrong.miss |= truth.is_some() && (closest.is_none() || !any);
        wrong.hit |= truth.is_none() && (closest.is_some() || any);
        if let (Some(truth), Some(found)) = (truth, closest) {
            wrong.primitive |= truth.prim != found.prim;
            if truth.prim == found.prim {
                self.max_ulp = self.max_ulp.max(floats_between(truth.t, found.t));
            }
        }
    }

    pub(crate) fn errors(&self) -> Errors {
        let count = |is_wrong: fn(&Wrong) -> bool| self.wrong.iter().filter(|&wrong| is_wrong(wrong)).count() as u64;
        Errors {
            rays: self.truth.len() as u64,
            false_misses: count(|wrong| wrong.miss),
            false_hits: count(|wrong| wrong.hit),
            wrong_primitives: count(|wrong| wrong.primitive),
            max_ulp: self.max_ulp,
        }
    }
}

impl WithTests for Run<'_> {
    type Output = Result<Errors, Unfit>;

    fn call<K: Kernel<Vector = Vec3, Shape: Form>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
        let Stress { case, truth, trees } = self.stress;
        let (mut found, mut memory) = (Findings::new(truth), Vec::new());
        for (tree, is_complete) in trees.iter().zip([false, true, false]) {
            let bvh = tree.clone().map(K::Shape::from);
            let boxes = bvh.own_boxes();
            let tables = Tables::new(bvh.tree(), bvh.axes(), self.methods, Implicit::LIMIT);
            let word = WordName::narrowest(bvh.depth());
            for &method in self.methods.iter().filter(|&&method| is_complete || method != Method::Complete) {
                for (i, ray) in case.rays.iter().enumerate() {
                    let mut any = NodeSearch::<K, B, true>::new(&bvh, &boxes, ray);
                    let mut closest = NodeSearch::<K, B, false>::new(&bvh, &boxes, ray);
                    // The first hit ends an any-hit query: there is nothing left to be pruned.
                    let queries: [(&mut dyn Query, Method); 2] =
                        [(&mut any, method.without_pruning()), (&mut closest, method)];
                    for (query, method) in queries {
                        tables.run_query(word, method, ray.octant(), &mut memory, query)?;
                    }
                    found.see(i, any.found().is_some(), closest.hit());
                }
            }
        }
        Ok(found.errors())
    }
}

/// Steps from one number to the other; those of zero are one. Of doubles `u32::MAX` stands for more, too.
pub fn floats_between<R: Real>(a: R, b: R) -> u32 {
    let place = |x: R| {
        let x: f64 = x.into();
        // Where the number is one of single precision, its own bits.
        let magnitude = if size_of::<R>() == 4 { (x as f32).abs().to_bits().into() } else { x.abs().to_bits() } as i64;
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b)).try_into().unwrap_or(u32::MAX)
}

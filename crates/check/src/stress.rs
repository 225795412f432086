//! Checks of difficult rays through every traversal, with any tests, against rational arithmetic.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, SahOptions, WideBvh};
use stackless_bvh::generate::stress::StressCase;
use stackless_bvh::geom::{Kernel, Mesh, Ray};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::geom::kernel::Exact64;
use stackless_bvh::internals::geom::lanes;
use stackless_bvh::internals::geom::slabs::Slabs64;
use stackless_bvh::internals::trace::{
    KernelName, KernelShape, NodeSearch, Query, SlabsName, Truth, WithTests, with_tests,
};
use stackless_bvh::trace::{BinaryTracer, Hit, RayQueries, Tracer};
use stackless_bvh::traverse::{Method, Tables, Unsupported, WordName};
use stackless_bvh::tree::{Implicit, Topology};
use stackless_bvh::wide;

/// Counts of rays with wrong answers. A ray counts once if any traversal answers it wrongly. `[CONF-2]`
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Errors {
    /// Rays.
    pub rays: u64,
    /// Rays that hit, but the closest-hit or the any-hit query missed.
    pub false_misses: u64,
    /// Rays that miss, but a query hit.
    pub false_hits: u64,
    /// Rays whose reported closest triangle is wrong.
    pub wrong_primitives: u64,
    /// The greatest error of a reported `t` with the right triangle, in ulps from the correctly rounded distance.
    pub max_ulp: u32,
}

impl Errors {
    /// Returns whether every answer was right to the last bit.
    pub fn is_none(&self) -> bool {
        Self { rays: 0, ..*self } == Self::default()
    }
}

/// A case with its exact answers and its hierarchies.
#[derive(Debug)]
pub struct Stress<'c> {
    case: &'c StressCase,
    truth: Vec<Option<Hit>>,
    /// A hierarchy by surface area, a complete one, and one with permuted triangle parts.
    trees: [Bvh; 3],
}

impl<'c> Stress<'c> {
    /// Prepares a case.
    ///
    /// # Errors
    /// The errors of building. The cases of [`stress`](stackless_bvh::generate::stress) have none.
    pub fn new(case: &'c StressCase) -> Result<Self, BuildError> {
        let truth = Truth::new(&case.mesh);
        let truth = case.rays.iter().map(|ray| truth.closest(ray).map(|hit| hit.rounded())).collect();
        let in_parts = BuildOptions { builder: Builder::Spatial, ..BuildOptions::default() };
        let trees =
            [Bvh::sah(&case.mesh, SahOptions::default())?, Bvh::median(&case.mesh, 2)?, in_parts.build(&case.mesh)?];
        Ok(Self { case, truth, trees })
    }

    /// Returns the exact hits of the rays.
    pub fn truth(&self) -> &[Option<Hit>] {
        &self.truth
    }

    /// Traces all rays with all of `methods`, for the closest hit and any hit, through a hierarchy by surface area, a
    /// complete one, and one with triangles in parts.
    ///
    /// # Errors
    /// A traversal that supports none of the hierarchies.
    pub fn run(&self, tests: (KernelName, SlabsName), methods: &[Method]) -> Result<Errors, Unsupported> {
        with_tests(tests, Run { stress: self, methods })
    }

    /// Traces the rays in double precision with exact tests, in place and with the scene translated far away. Each ray
    /// counts twice.
    ///
    /// # Errors
    /// A description of the object that could not be built.
    pub fn run_double(&self, methods: &[Method]) -> Result<Errors, String> {
        let places = [DVec3::ZERO, DVec3::new(6.4e6, -6.4e6, 6.4e6)].map(|by| moved(self.case, by));
        let places = places.into_iter().collect::<Result<Vec<_>, _>>()?;
        let truth = places.iter().flat_map(|(mesh, rays)| {
            let truth = Truth::new(mesh);
            rays.iter().map(move |ray| truth.closest(ray).map(|hit| hit.rounded()))
        });
        let truth: Vec<_> = truth.collect();
        let (mut found, mut first) = (Findings::new(&truth, doubles_between), 0);
        for (mesh, rays) in &places {
            let trees = [Bvh::sah(mesh, SahOptions::default()), Bvh::median(mesh, 2)];
            for (tree, is_complete) in trees.into_iter().zip([false, true]) {
                let bvh = tree.map_err(|error| error.to_string())?;
                for &method in methods.iter().filter(|&&method| is_complete || method != Method::Complete) {
                    let tracer = BinaryTracer::<_, Exact64, Slabs64>::with_tests(&bvh, method);
                    let tracer = tracer.map_err(|unfit| format!("{method}: {unfit}"))?;
                    let answers = tracer.closest_each(rays).into_iter().zip(tracer.any_each(rays));
                    for (i, (closest, any)) in answers.enumerate() {
                        found.see(first + i, any, closest);
                    }
                }
                let bvh = WideBvh::of(&bvh).map_err(|error| error.to_string())?;
                for (_, level) in lanes::levels() {
                    let tracer = Tracer::new(&bvh).with_level(level);
                    let (closest, any) = (tracer.closest_each(rays), tracer.any_each(rays));
                    for (i, ray) in rays.iter().enumerate() {
                        found.see(first + i, any[i], closest[i]);
                        found.see(first + i, tracer.any(ray), tracer.closest(ray));
                    }
                }
            }
            first += rays.len();
        }
        Ok(found.errors())
    }

    /// Traces the rays with traversals of wide trees and exact tests, with all instruction sets of this machine, one
    /// ray at a time and two interleaved.
    ///
    /// # Errors
    /// A description of the object that could not be built.
    pub fn run_wide(&self, methods: &[wide::Method]) -> Result<Errors, String> {
        let (rays, mut found) = (&self.case.rays, Findings::new(&self.truth, floats_between));
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

/// Faults found for each ray.
struct Findings<'t, R> {
    truth: &'t [Option<Hit<R>>],
    wrong: Vec<Wrong>,
    max_ulp: u32,
    /// Returns the distance between two floats.
    between: fn(R, R) -> u32,
}

#[derive(Clone, Copy, Default)]
struct Wrong {
    miss: bool,
    hit: bool,
    primitive: bool,
}

impl<'t, R: Copy> Findings<'t, R> {
    fn new(truth: &'t [Option<Hit<R>>], between: fn(R, R) -> u32) -> Self {
        Self { truth, wrong: vec![Wrong::default(); truth.len()], max_ulp: 0, between }
    }

    /// Compares the answers to a ray.
    fn see(&mut self, ray: usize, any: bool, closest: Option<Hit<R>>) {
        let (truth, wrong) = (self.truth[ray], &mut self.wrong[ray]);
        wrong.miss |= truth.is_some() && (closest.is_none() || !any);
        wrong.hit |= truth.is_none() && (closest.is_some() || any);
        if let (Some(truth), Some(found)) = (truth, closest) {
            wrong.primitive |= truth.prim != found.prim;
            if truth.prim == found.prim {
                self.max_ulp = self.max_ulp.max((self.between)(truth.t, found.t));
            }
        }
    }

    fn errors(&self) -> Errors {
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
    type Output = Result<Errors, Unsupported>;

    fn call<K: Kernel<Vector = Vec3, Shape: KernelShape>, B: Slabs<Vector = Vec3>>(self) -> Self::Output {
        let Stress { case, truth, trees } = self.stress;
        let (mut found, mut memory) = (Findings::new(truth, floats_between), Vec::new());
        for (tree, is_complete) in trees.iter().zip([false, true, false]) {
            let bvh = tree.clone().map(K::Shape::from);
            let boxes = bvh.own_boxes();
            let tables = Tables::new(bvh.tree(), bvh.axes(), self.methods, Implicit::LIMIT);
            let word = WordName::narrowest(bvh.depth());
            for &method in self.methods.iter().filter(|&&method| is_complete || method != Method::Complete) {
                for (i, ray) in case.rays.iter().enumerate() {
                    let mut any = NodeSearch::<K, B, true>::new(&bvh, &boxes, ray);
                    let mut closest = NodeSearch::<K, B, false>::new(&bvh, &boxes, ray);
                    // The first hit ends an any-hit query, so pruning does not apply.
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

/// Translates a case and converts it to double precision.
fn moved(case: &StressCase, by: DVec3) -> Result<(Mesh<DVec3>, Vec<Ray<DVec3>>), String> {
    let place = |v: Vec3| v.as_dvec3() + by;
    let vertices = case.mesh.vertices().iter().copied().map(place).collect();
    let mesh = Mesh::new(vertices, case.mesh.triangles().to_vec()).map_err(|error| error.to_string())?;
    let ray = |ray: &Ray| {
        let [tmin, tmax] = [ray.tmin(), ray.tmax()].map(f64::from);
        Ray::within(place(ray.origin()), ray.direction().as_dvec3(), tmin, tmax).map_err(|error| error.to_string())
    };
    Ok((mesh, case.rays.iter().map(ray).collect::<Result<_, _>>()?))
}

/// Counts the steps from one float to the other. Both zeros count as one float.
pub fn floats_between(a: f32, b: f32) -> u32 {
    let place = |x: f32| {
        let magnitude = (x.to_bits() & 0x7fff_ffff) as i32;
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b))
}

/// Counts the steps between doubles, saturating at the maximum of `u32`.
fn doubles_between(a: f64, b: f64) -> u32 {
    let place = |x: f64| {
        let magnitude = x.abs().to_bits() as i64;
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b)).try_into().unwrap_or(u32::MAX)
}

//! The plan of the default tracer: decisions by scene and query, without a change of an answer.

use glam::{DVec3, Vec3};

use super::*;
use crate::bvh::{Degenerate, SpatialOptions};
use crate::geom::Region;
use crate::geom::lanes::{Block, Hits as _};
use crate::trace::plan::tests::{diagonals, with_flat_triangles};

const PARTS: [Part; 6] = [Part::Hash, Part::Weights, Part::Degenerate, Part::Repeats, Part::ExactTests, Part::Entries];

const QUERIES: [QueryKind; 4] = [QueryKind::Any, QueryKind::Distance, QueryKind::Hit, QueryKind::All];

/// A scene, and the options of its hierarchy.
struct Scene<V: Precision> {
    mesh: Mesh<V>,
    rays: Vec<Ray<V>>,
    options: BuildOptions,
}

impl<V: Precision> Scene<V> {
    /// Scales a mesh, and rays through it, to a greatest coordinate.
    fn new(mesh: &Mesh, reach: f64, builder: Builder) -> Self {
        let greatest = mesh.vertices().iter().map(|v| f64::from(v.abs().max_element())).fold(0.0, f64::max);
        let times = |v: Vec3, scale: f64| {
            let v = v.as_dvec3() * scale;
            V::from_components([v.x, v.y, v.z].map(V::Real::rounded))
        };
        let scale = reach / greatest;
        let scaled = |v: Vec3| times(v, scale);
        let ray = |ray: &Ray| Ray::new(scaled(ray.origin()), times(ray.direction(), scale.max(1.0))).expect("a ray");
        let rays = procedural::rays(mesh, 4, 40).iter().map(ray).collect();
        let mesh = Mesh::new(mesh.vertices().iter().copied().map(scaled).collect(), mesh.triangles().to_vec());
        let spatial = SpatialOptions { extra_percent: 300, overlap: 0.0 };
        let options = BuildOptions { builder, spatial, degenerate: Degenerate::LeftOut, ..BuildOptions::default() };
        Self { mesh: mesh.expect("a mesh"), rays, options }
    }

    fn tracer(&self, plan: Option<&Plan>, method: Method) -> Tracer<WideBvh<8, V>, V> {
        let Self { mesh, options, .. } = self;
        let options = plan.map_or(*options, |plan| plan.options(*options));
        let bvh = options.build_wide(mesh).expect("a hierarchy");
        let bvh = if let Some(plan) = plan { plan.on(bvh) } else { bvh };
        let tracer = Tracer::with_method(bvh, method).expect("a tracer");
        if let Some(plan) = plan { tracer.planned(plan) } else { tracer }
    }

    /// Returns the tracer of a region without near rays.
    fn with_entries(&self) -> Tracer<WideBvh<8, V>, V> {
        let mut bvh = self.options.build_wide(&self.mesh).expect("a hierarchy");
        bvh.map_region(Region::without_near_rays);
        Tracer::new(bvh)
    }

    fn answers(&self, tracer: &Tracer<WideBvh<8, V>, V>) -> impl PartialEq + use<V> {
        let rays = &self.rays;
        let mut distances = vec![None; rays.len()];
        tracer.closest_distances(rays, &mut distances);
        let single: Vec<_> = rays.iter().map(|ray| (tracer.any(ray), tracer.closest_distance(ray))).collect();
        (tracer.any_each(rays), distances, single, tracer.closest_each(rays), tracer.all_each(rays))
    }

    /// Checks the parts that a scene needs, and that every other part costs something, and changes no answer.
    fn check(&self, method: Method, needed: &[Part]) {
        let lean = self.tracer(None, method);
        let answers = self.answers(&lean);
        assert!(lean.closest_each(&self.rays).iter().flatten().count() > 3);
        for ask in QUERIES {
            let plan = lean.plan(ask);
            let of_query = match ask {
                QueryKind::Any | QueryKind::Distance => None,
                QueryKind::Hit | QueryKind::All => Some(Part::Weights),
            };
            // Repeats change only the answers of all hits.
            let is_needed = |part: &Part| needed.contains(part) && (*part != Part::Repeats || ask == QueryKind::All);
            if needed.contains(&Part::ExactTests) {
                assert_eq!(self.work(Part::ExactTests, &lean), 4 * lean.bvh().blocks().len() * self.rays.len());
            }
            // In double precision, plan and ray call the same function.
            if needed.contains(&Part::Entries) && size_of::<V::Real>() == 4 {
                assert_eq!(self.work(Part::Entries, &self.with_entries()), 0, "all rays are tested from their entries");
            }
            for part in PARTS {
                let omits = !is_needed(&part) && of_query != Some(part);
                assert_eq!((plan.skips(part), plan.restores(part)), (omits, false), "{part:?}, {ask:?}");
                let with = plan.clone().with(part);
                assert_eq!((with.skips(part), with.restores(part), with == plan), (false, omits, !omits), "{part:?}");
                // Restored parts do not depend on the query.
                let is_tried = matches!(ask, QueryKind::Any | QueryKind::All);
                if is_tried && omits && !(part == Part::Repeats && needed.contains(&part)) {
                    let tracer = self.tracer(Some(&with), method);
                    let [without, with] = [&lean, &tracer].map(|tracer| self.work(part, tracer));
                    assert!(without < with, "{part:?}, {ask:?}: {without}, {with}");
                    assert!(self.answers(&tracer) == answers, "{part:?}, {ask:?}");
                }
            }
        }
        let everything = self.tracer(Some(&lean.plan(QueryKind::Any).with_everything()), method);
        assert!(self.answers(&everything) == answers);
    }

    /// Returns the cost of a part.
    fn work(&self, part: Part, tracer: &Tracer<WideBvh<8, V>, V>) -> usize {
        let bvh = tracer.bvh();
        match part {
            Part::Hash => tracer.bytes(),
            Part::Weights => {
                let hits = |ask| self.rays.iter().filter_map(move |ray| tracer.one(ray, ask));
                let with_weights = |ask| hits(ask).filter(|hit| hit.u != V::Real::ZERO).count();
                with_weights(HitQuery::Any).min(with_weights(HitQuery::Distance))
            }
            Part::Degenerate => bvh.blocks().iter().flat_map(|block| block.prims).filter(|&p| p != Block::NONE).count(),
            Part::Repeats => usize::from(tracer.watches),
            Part::ExactTests => with_baseline!(simd => {
                let left = |ray| {
                    let filter = V::Hits::new(ray, bvh.region()).filter(simd);
                    let of = |block| filter.survivors(simd, block, V::Real::INFINITY).count_ones() as usize;
                    bvh.blocks().iter().map(of).sum::<usize>()
                };
                self.rays.iter().map(left).sum()
            }),
            Part::Entries => {
                // Distances from the entry are rounded differently.
                let (lean, root) = (self.tracer(None, tracer.method()), Node::inner(0));
                self.rays.iter().filter(|ray| tracer.wanted(ray, root).ranks != lean.wanted(ray, root).ranks).count()
            }
            _ => unreachable!("{part:?}"),
        }
    }
}

fn check_precision<V: Precision>(huge: f64, extreme: f64) {
    let soup = procedural::soup(5, 80);
    let scene = |mesh: &Mesh, reach, builder| Scene::<V>::new(mesh, reach, builder);
    let usual = scene(&with_flat_triangles(&soup), 100.0, Builder::Standard);
    usual.check(Method::default(), &[]);
    usual.check(Method::Hashed, &[Part::Hash]);
    scene(&soup, 1.0, Builder::Standard).check(Method::default(), &[Part::Degenerate]);
    let split = scene(&diagonals(), 1.0, Builder::Spatial);
    split.check(Method::default(), &[Part::Degenerate, Part::Repeats]);
    scene(&soup, huge, Builder::Standard).check(Method::default(), &[Part::Degenerate, Part::ExactTests]);
    let needed = [Part::Degenerate, Part::ExactTests, Part::Entries];
    let mut extreme = scene(&soup, extreme, Builder::Standard);
    extreme.options.degenerate = Degenerate::Kept;
    extreme.check(Method::default(), &needed);

    // The watch is necessary.
    let mut blind = split.tracer(None, Method::default());
    blind.watches = false;
    assert!(split.answers(&blind) != split.answers(&split.tracer(None, Method::default())));
}

#[test]
fn the_plan_follows_scene_and_query_and_changes_no_answer() {
    check_precision::<Vec3>(2_f64.powi(42), 1.1 * 2_f64.powi(126));
    check_precision::<DVec3>(2_f64.powi(210), 2_f64.powi(-1068));
}

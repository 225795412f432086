//! The property bodies of hierarchies: valid, of their mesh, and with right answers for rays and points.

use std::collections::BTreeMap;
use std::fmt;

use glam::DVec3;

use stackless_bvh::bvh::wide::WideBvhError;
use stackless_bvh::bvh::{Bvh, BvhError, WideBvh, WideError, validate};
use stackless_bvh::geom::{Ball, BallError, Mesh, MeshError, Precision, Ray, Triangle, Vector};
use stackless_bvh::internals::geom::truth::{RBig, round_root, square_distance};
use stackless_bvh::internals::trace::{AllHitsQuery, NodeSearch, OwnBoxes, Query, Truth};
use stackless_bvh::trace::{BinaryTracer, Filter, Filterable, Hit, MeshQueries, Near, RayQueries, Tracer};
use stackless_bvh::traverse::{Method, Tables, Unsupported, WordName};
use stackless_bvh::tree::Topology;

use crate::kernels::{GeometryFault, check_point};

/// A fault of a hierarchy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TreeFault {
    /// The hierarchy is invalid, or is not of the mesh.
    #[error("it is not sound: {0}")]
    Unsound(#[from] BvhError),
    /// Its wide tree is invalid, or is not of the mesh.
    #[error("the wide tree of it is not sound: {0}")]
    UnsoundWide(#[from] WideBvhError),
    /// The wide tree cannot be built.
    #[error(transparent)]
    Wide(#[from] WideError),
    /// Its triangles are not a valid mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// It cannot be traversed.
    #[error("it cannot be traversed: {0}")]
    Unsupported(Unsupported),
    /// The answer to a ray differs from rational arithmetic.
    #[error("{what} of ray {ray}: {found}, expected {expected}")]
    Ray {
        /// The name of the query.
        what: &'static str,
        /// Index of the ray.
        ray: usize,
        /// The right answer.
        expected: String,
        /// The answer found.
        found: String,
    },
    /// The input is not a valid point and radius.
    #[error(transparent)]
    Point(#[from] BallError),
    /// The nearest triangles differ.
    #[error("nearest (distance, triangle): {found:?}, expected {expected:?}")]
    Nearest {
        /// The right distances and triangles.
        expected: Vec<(f64, u32)>,
        /// The distances and triangles found.
        found: Vec<(f64, u32)>,
    },
    /// The nearest point of a triangle differs.
    #[error(transparent)]
    Place(#[from] GeometryFault),
}

/// Checks two hierarchies, a binary and a wide one: both must be valid and of the mesh. Traces each ray with `hashed`
/// in the binary one, and in the wide one. The closest hit, any hit and all hits must equal rational arithmetic in
/// every bit, also in filtered tracers. `[DET-1]` `[FILTER-1]`
///
/// Returns the number of rays that hit.
///
/// # Errors
/// The first fault.
pub fn check_trees<V: Precision>(
    bvh: &Bvh<Triangle<V>>,
    wide: &WideBvh<8, V>,
    mesh: &Mesh<V>,
    rays: &[Ray<V>],
) -> Result<usize, TreeFault> {
    validate(bvh, mesh)?;
    wide.validate(mesh)?;
    let prims: Vec<_> = (0..mesh.triangles().len() as u32).collect();
    check_rays(bvh, wide, mesh, &prims, rays)
}

/// Checks a hierarchy of unknown origin like [`check_trees`]. Its own triangles are the mesh. `[FILE-5]`
///
/// Returns the number of rays that hit.
///
/// # Errors
/// The first fault.
pub fn check_held<V: Precision>(bvh: &Bvh<Triangle<V>>, rays: &[Ray<V>]) -> Result<usize, TreeFault> {
    let held: BTreeMap<u32, [V; 3]> = bvh.triangles().iter().map(|held| (held.prim, held.shape.0)).collect();
    let vertices = held.values().flatten().copied().collect();
    let mesh = Mesh::new(vertices, (0..held.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())?;
    check_rays(bvh, &WideBvh::of(bvh)?, &mesh, &held.into_keys().collect::<Vec<_>>(), rays)
}

/// Checks rays against the exact answers for a mesh whose triangles have these indices in the hierarchy.
fn check_rays<V: Precision>(
    bvh: &Bvh<Triangle<V>>,
    wide: &WideBvh<8, V>,
    mesh: &Mesh<V>,
    prims: &[u32],
    rays: &[Ray<V>],
) -> Result<usize, TreeFault> {
    let tree = bvh.tree();
    let tables = Tables::new(tree, tree.axes(), &[Method::Hashed], 0);
    let (word, mut memory) = (WordName::narrowest(tree.depth()), Vec::new());
    let mut run = |query: &mut dyn Query| {
        tables.run_query(word, Method::Hashed, 0, &mut memory, query).map_err(TreeFault::Unsupported)
    };
    let tracer = Tracer::new(wide);
    let binary =
        BinaryTracer::<_, V::Exact, V::Slabs>::with_tests(bvh, Method::Hashed).map_err(TreeFault::Unsupported)?;
    let (in_turns, in_turns_any) = (tracer.closest_each(rays), tracer.any_each(rays));
    let (truth, mut hits) = (Truth::new(mesh), 0);
    for (number, ray) in rays.iter().enumerate() {
        let true_hits = truth.all(ray);
        let expected: Vec<_> =
            true_hits.iter().map(|hit| bits(&Hit { prim: prims[hit.prim as usize], ..hit.rounded() })).collect();
        let mut closest = NodeSearch::<V::Exact, V::Slabs, false>::new(bvh, &[], ray);
        run(&mut closest)?;
        let closest: Vec<_> = closest.hit().iter().map(bits).collect();
        compare(number, "the closest hit", &expected[..expected.len().min(1)], &closest[..])?;
        let mut any = NodeSearch::<V::Exact, V::Slabs, true>::new(bvh, &[], ray);
        run(&mut any)?;
        compare(number, "any hit", &!expected.is_empty(), &any.found().is_some())?;
        let mut all = OwnBoxes::over(AllHitsQuery::<V::Exact, V::Slabs>::new(bvh, ray), &[]);
        run(&mut all)?;
        let all: Vec<_> = all.query().clone().into_hits().iter().map(bits).collect();
        compare(number, "all hits", &expected, &all)?;
        let first = expected.first();
        for (what, hit) in [
            ("the closest hit in a wide tree", tracer.closest(ray)),
            ("the closest hit in a wide tree, of two in turns", in_turns[number]),
        ] {
            compare(number, what, &first, &hit.as_ref().map(bits).as_ref())?;
        }
        let any = [tracer.any(ray), in_turns_any[number], tracer.closest_distance(ray).is_some()];
        compare(number, "any hit in a wide tree", &[!expected.is_empty(); 3], &any)?;
        let all: Vec<_> = tracer.all(ray).iter().map(bits).collect();
        compare(number, "all hits in a wide tree", &expected, &all)?;
        check_filtered(&tracer, ray, number, &expected)?;
        check_filtered(&binary, ray, number, &expected)?;
        hits += usize::from(!expected.is_empty());
    }
    Ok(hits)
}

/// Checks the accepted hits of a ray, with filters that depend on its number. `[FILTER-1]`
fn check_filtered<V: Vector>(
    tracer: &impl Filterable<V>,
    ray: &Ray<V>,
    number: usize,
    all: &[Bits],
) -> Result<(), TreeFault> {
    let accepts_triangle = |prim: u32| prim as usize % 3 != number % 4;
    let accepts_u = |u: f64| u <= [0.2, 0.6, 1.0][number % 3];
    let accepts_hit = |hit: &Hit<V::Real>| accepts_u(hit.u.into());
    for [by_triangle, by_hit] in [[true, false], [false, true], [true, true]] {
        let filter = if by_triangle { Filter::ALL.triangles(&accepts_triangle) } else { Filter::ALL };
        let filter = if by_hit { filter.hits(&accepts_hit) } else { filter };
        let is_accepted = |&&(prim, [_, u, _]): &&Bits| {
            (!by_triangle || accepts_triangle(prim)) && (!by_hit || accepts_u(f64::from_bits(u)))
        };
        let expected: Vec<_> = all.iter().filter(is_accepted).copied().collect();
        let tracer = tracer.filtered(filter);
        let hits: Vec<_> = tracer.all(ray).iter().map(bits).collect();
        compare(number, "all accepted hits", &expected, &hits)?;
        compare(
            number,
            "the closest accepted hit",
            &expected.first(),
            &tracer.closest(ray).as_ref().map(bits).as_ref(),
        )?;
        let any = tracer.any_hit(ray).as_ref().map(bits);
        let is_right =
            any.map_or(expected.is_empty(), |any| expected.contains(&any)) && tracer.any(ray) == any.is_some();
        compare(number, "whether any hit is an accepted one", &true, &is_right)?;
    }
    Ok(())
}

/// Checks that the `k` triangles nearest to a point equal those of rational arithmetic, with their nearest points, and
/// that the nearest triangle is the first of them. `[NEAR-2]` `[NEAR-3]`
///
/// # Errors
/// [`TreeFault::Nearest`], [`TreeFault::Place`], [`TreeFault::Point`], [`TreeFault::Unsupported`].
pub fn check_nearest<V: Precision>(
    bvh: &Bvh<Triangle<V>>,
    mesh: &Mesh<V>,
    point: V,
    radius: V::Real,
    k: usize,
) -> Result<(), TreeFault> {
    let tracer =
        BinaryTracer::<_, V::Exact, V::Slabs>::with_tests(bvh, Method::default()).map_err(TreeFault::Unsupported)?;
    let ball = Ball::new(point, radius)?;
    let nears = tracer.nearest_k(&ball, k);
    let wide = Tracer::new(WideBvh::<8, V>::of(bvh)?);
    if (wide.nearest_k(&ball, k), wide.nearest(&ball)) != (nears.clone(), tracer.nearest(&ball)) {
        let [expected, found] = [distances(&nears), distances(&wide.nearest_k(&ball, k))];
        return Err(TreeFault::Nearest { expected, found });
    }
    let (mut expected, found) = (nearest(mesh, point, radius, k.max(1)), distances(&nears));
    let (first, near) = (expected.first().copied(), tracer.nearest(&ball));
    expected.truncate(k);
    if expected != found {
        return Err(TreeFault::Nearest { expected, found });
    }
    for near in nears.iter().chain(&near) {
        check_point(&Triangle(mesh.triangle(near.prim as usize)), point, near.point)?;
    }
    let near = distances(near.as_slice());
    if first.as_slice() != near {
        return Err(TreeFault::Nearest { expected: first.into_iter().collect(), found: near });
    }
    Ok(())
}

/// Returns the first `k` triangles within a radius, by (rounded distance, index). Exact arithmetic decides among all
/// candidates.
pub fn nearest<V: Vector>(mesh: &Mesh<V>, point: V, radius: V::Real, k: usize) -> Vec<(f64, u32)> {
    let (p, radius): (_, f64) = (point.widen(), radius.into());
    // The distance is at least each component of the distance to the box, and at most the sum of the components to the
    // nearest corner.
    let bounds = |prim: usize| {
        let corners = Triangle(mesh.triangle(prim)).widen();
        let [lo, hi] = [corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2])];
        let to_box = (lo - p).max(p - hi).max(DVec3::ZERO).max_element();
        let to_corner =
            corners.map(|corner| (corner - p).abs().element_sum()).into_iter().fold(f64::INFINITY, f64::min);
        (to_box * (1.0 - 1e-12), to_corner * (1.0 + 1e-6))
    };
    let all: Vec<_> = (0..mesh.triangles().len()).map(|prim| (prim, bounds(prim))).collect();
    let mut most: Vec<f64> = all.iter().map(|&(_, (_, most))| most).collect();
    most.sort_by(f64::total_cmp);
    let most = k.checked_sub(1).map_or(f64::NEG_INFINITY, |last| most.get(last).copied().unwrap_or(f64::INFINITY));
    // Distances below the least float may round to it, or to 0.
    let candidates =
        all.into_iter().filter(|&(_, (least, _))| least <= most.max(f32::MIN_POSITIVE.into()) && least <= radius);
    let exact = candidates.filter_map(|(prim, _)| {
        let corners = mesh.triangle(prim).map(V::components);
        let square = square_distance(corners, point.components())?;
        // An infinite radius is not rational.
        let is_within = RBig::try_from(radius).map_or(radius > 0.0, |radius| square <= &radius * &radius);
        is_within.then(|| (round_root::<V::Real>(&square).into(), prim as u32))
    });
    let mut found: Vec<_> = exact.collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found.truncate(k);
    found
}

fn distances<V: Vector>(nears: &[Near<V>]) -> Vec<(f64, u32)> {
    nears.iter().map(|near| (near.distance.into(), near.prim)).collect()
}

/// Triangle, and distance and weights as bits.
type Bits = (u32, [u64; 3]);

fn bits<R: Copy + Into<f64>>(hit: &Hit<R>) -> Bits {
    (hit.prim, [hit.t, hit.u, hit.v].map(|x| x.into().to_bits()))
}

fn compare<T: PartialEq + fmt::Debug + ?Sized>(
    ray: usize,
    what: &'static str,
    expected: &T,
    found: &T,
) -> Result<(), TreeFault> {
    if expected == found {
        return Ok(());
    }
    Err(TreeFault::Ray { what, ray, expected: format!("{expected:x?}"), found: format!("{found:x?}") })
}

//! The property bodies of hierarchies: sound, of their mesh, and right about rays and points.

use std::collections::BTreeMap;
use std::fmt;

use glam::DVec3;

use stackless_bvh::bvh::{Bvh, BvhError, validate};
use stackless_bvh::geom::truth::{RBig, round_root, square_distance};
use stackless_bvh::geom::{Ball, BallError, Kernel, Mesh, MeshError, Ray, Slabs, Triangle, Vector};
use stackless_bvh::trace::{BinaryTracer, Hit, Near, NodeSearch, OwnBoxes, Query, Sweep, Truth};
use stackless_bvh::traverse::{Method, Tables, Unfit, WordName};
use stackless_bvh::tree::Topology;

use crate::kernels::{GeometryFault, check_point};

/// What is wrong with a hierarchy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TreeFault {
    /// It is not sound, or not that of the mesh.
    #[error("it is not sound: {0}")]
    Unsound(#[from] BvhError),
    /// Its triangles are not a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// It cannot be traversed.
    #[error("it cannot be traversed: {0}")]
    Unfit(Unfit),
    /// A ray is answered otherwise than by rational arithmetic.
    #[error("{what} of ray {ray}: {found}, expected {expected}")]
    Ray {
        /// What was asked.
        what: &'static str,
        /// Which ray.
        ray: usize,
        /// The answer that is right.
        expected: String,
        /// The answer that was given.
        found: String,
    },
    /// The numbers are not a point and a radius.
    #[error(transparent)]
    Point(#[from] BallError),
    /// Other triangles are nearest.
    #[error("nearest (distance, triangle): {found:?}, expected {expected:?}")]
    Nearest {
        /// Distances and triangles that are right.
        expected: Vec<(f64, u32)>,
        /// Those that were found.
        found: Vec<(f64, u32)>,
    },
    /// The nearest point of a triangle is another.
    #[error(transparent)]
    Place(#[from] GeometryFault),
}

/// Checks that a hierarchy is sound and that of the mesh, and that by `hashed` the closest hit, any hit and all hits of
/// each ray are those of rational arithmetic, in every bit. `[DET-1]`
///
/// Returns the number of rays that hit.
///
/// # Errors
/// The first fault.
pub fn check_tree<K, B, V>(bvh: &Bvh<Triangle<V>>, mesh: &Mesh<V>, rays: &[Ray<V>]) -> Result<usize, TreeFault>
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    validate(bvh, mesh)?;
    let prims: Vec<_> = (0..mesh.triangles().len() as u32).collect();
    check_rays::<K, B, V>(bvh, mesh, &prims, rays)
}

/// The same for a hierarchy of unknown origin, whose triangles are taken for the mesh. `[FILE-5]`
///
/// Returns the number of rays that hit.
///
/// # Errors
/// The first fault.
pub fn check_held<K, B, V>(bvh: &Bvh<Triangle<V>>, rays: &[Ray<V>]) -> Result<usize, TreeFault>
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let held: BTreeMap<u32, [V; 3]> = bvh.triangles().iter().map(|held| (held.prim, held.shape.0)).collect();
    let vertices = held.values().flatten().copied().collect();
    let mesh = Mesh::new(vertices, (0..held.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())?;
    check_rays::<K, B, V>(bvh, &mesh, &held.into_keys().collect::<Vec<_>>(), rays)
}

/// Rays against the truth of a mesh, whose triangles have these numbers in the hierarchy.
fn check_rays<K, B, V>(
    bvh: &Bvh<Triangle<V>>,
    mesh: &Mesh<V>,
    prims: &[u32],
    rays: &[Ray<V>],
) -> Result<usize, TreeFault>
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let tree = bvh.tree();
    let tables = Tables::new(tree, tree.axes(), &[Method::Hashed], 0);
    let (word, mut memory) = (WordName::narrowest(tree.depth()), Vec::new());
    let mut run =
        |query: &mut dyn Query| tables.run_query(word, Method::Hashed, 0, &mut memory, query).map_err(TreeFault::Unfit);
    let (truth, mut hits) = (Truth::new(mesh), 0);
    for (number, ray) in rays.iter().enumerate() {
        let true_hits = truth.all(ray);
        let expected: Vec<_> =
            true_hits.iter().map(|hit| bits(&Hit { prim: prims[hit.prim as usize], ..hit.rounded() })).collect();
        let mut closest = NodeSearch::<K, B, false>::new(bvh, &[], ray);
        run(&mut closest)?;
        let closest: Vec<_> = closest.hit().iter().map(bits).collect();
        compare(number, "the closest hit", &expected[..expected.len().min(1)], &closest[..])?;
        let mut any = NodeSearch::<K, B, true>::new(bvh, &[], ray);
        run(&mut any)?;
        compare(number, "any hit", &!expected.is_empty(), &any.found().is_some())?;
        let mut all = OwnBoxes::over(Sweep::<K, B>::new(bvh, ray), &[]);
        run(&mut all)?;
        let all: Vec<_> = all.query().hits().iter().map(bits).collect();
        compare(number, "all hits", &expected, &all)?;
        hits += usize::from(!expected.is_empty());
    }
    Ok(hits)
}

/// Checks that the `k` triangles nearest to a point are those of rational arithmetic, with the points of each that are
/// nearest, and the nearest one the first of them. `[NEAR-2]` `[NEAR-3]`
///
/// # Errors
/// [`TreeFault::Nearest`], [`TreeFault::Place`], [`TreeFault::Point`], [`TreeFault::Unfit`].
pub fn check_nearest<K, B, V>(
    bvh: &Bvh<Triangle<V>>,
    mesh: &Mesh<V>,
    point: V,
    radius: V::Real,
    k: usize,
) -> Result<(), TreeFault>
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let tracer = BinaryTracer::<_, K, B>::with_tests(bvh, Method::default()).map_err(TreeFault::Unfit)?;
    let ball = Ball::new(point, radius)?;
    let nears = tracer.nearest_k(&ball, k);
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

/// The first `k` triangles within a radius, by (distance, rounded; index), in exact arithmetic on all that can be among
/// them.
pub fn nearest<V: Vector>(mesh: &Mesh<V>, point: V, radius: V::Real, k: usize) -> Vec<(f64, u32)> {
    let (p, radius): (_, f64) = (point.widen(), radius.into());
    // The distance is at least a component of that of the box, and at most the sum of those of the nearest corner.
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
    // What is nearer than the least float may round to it, or to 0.
    let candidates =
        all.into_iter().filter(|&(_, (least, _))| least <= most.max(f32::MIN_POSITIVE.into()) && least <= radius);
    let exact = candidates.filter_map(|(prim, _)| {
        let corners = mesh.triangle(prim).map(V::components);
        let square = square_distance(corners, point.components())?;
        // An infinite radius is no rational number.
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

/// Primitive, and distance and weights by their bits.
fn bits<R: Copy + Into<f64>>(hit: &Hit<R>) -> (u32, [u64; 3]) {
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

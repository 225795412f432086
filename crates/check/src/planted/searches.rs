//! Searches over rays with a mistake, against rational arithmetic; and a restart trail with one.

use std::cmp::Ordering;
use std::marker::PhantomData;

use glam::{Vec3, Vec3Swizzles};

use super::draw::Draw;
use super::files::cast;
use super::kernels::{self, BelowLimit, ByIndex, Endless, OpenInterval};
use super::layers::{Hits, Instead, Mistake};
use super::slabs::{self, BeforeEnd};
use super::wrapped::{Mutation, Wrapped};
use super::{Planted, drive};
use crate::{Case, check_tree};
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::kernel::{Exact, Filter, Moller32};
use stackless_bvh::geom::lanes::TriangleFilter;
use stackless_bvh::geom::slabs::{Directed, Plain};
use stackless_bvh::geom::{Kernel, Mesh, Ray, Region, Slabs, Triangle};
use stackless_bvh::trace::BinaryTracer;
use stackless_bvh::traverse::{Laine, Method};

pub(super) const MISTAKES: [Mistake; 10] = [
    of::<kernels::Spoilt<BelowLimit>, Directed>("of equal hits the first that is met", "DET-1"),
    Mistake::new(
        "hits at one rounded distance are in the order of their indices",
        "EXACT-13",
        sheets::<kernels::Spoilt<ByIndex>, Directed>,
        Instead::Rays(cast::<kernels::Spoilt<ByIndex>, Directed>),
    ),
    of::<kernels::Spoilt<OpenInterval>, Directed>("an open interval", "EXACT-1"),
    of::<kernels::Spoilt<Endless>, Directed>("any hit, whatever the end of the ray", "EXACT-1"),
    of::<Exact, slabs::Spoilt<BeforeEnd>>("boxes that begin at the best hit are skipped", "DET-1"),
    of::<Exact, Plain>("boxes without padding", "BOX-2"),
    of::<Moller32, Directed>("triangles in single precision", "EXACT-1"),
    filter::<SingleFilter>("four triangles are filtered without bounds", "LANES-3"),
    filter::<ExchangedFilter>("four triangles are filtered with two axes exchanged", "LANES-3"),
    Mistake::new(
        "a restart takes a node that wants one child for done",
        "LAINE-1",
        |draw| restart(draw, Mutation::Hasty),
        Instead::Walk(|| restarted(Mutation::Hasty)),
    ),
];

pub(super) const CONTROLS: [Mistake; 3] = [
    of::<Exact, Directed>("the exact search", "DET-1"),
    filter::<TriangleFilter>("the exact search behind a filter of four", "LANES-3"),
    Mistake::new(
        "a restart trail, wrapped",
        "LAINE-1",
        |draw| restart(draw, Mutation::None),
        Instead::Walk(|| restarted(Mutation::None)),
    ),
];

const fn of<K, B>(name: &'static str, clause: &'static str) -> Mistake
where
    K: Kernel<Vector = Vec3, Shape = Triangle>,
    B: Slabs<Vector = Vec3>,
{
    Mistake::new(name, clause, fault::<K, B>, Instead::Rays(cast::<K, B>))
}

fn fault<K, B>(draw: &mut Draw<'_>) -> Option<String>
where
    K: Kernel<Vector = Vec3, Shape = Triangle>,
    B: Slabs<Vector = Vec3>,
{
    let (mesh, rays) = draw.scene()?;
    let bvh = built(draw, &mesh)?;
    check_tree::<K, B, _>(&bvh, &mesh, &rays).err().map(|fault| fault.to_string())
}

/// Sheets that are some ulps apart, seen from afar.
fn sheets<K, B>(draw: &mut Draw<'_>) -> Option<String>
where
    K: Kernel<Vector = Vec3, Shape = Triangle>,
    B: Slabs<Vector = Vec3>,
{
    let corners = [[-4.0, -4.0], [8.0, -4.0], [-4.0, 8.0]];
    let heights: Vec<_> = (0..=draw.below(6)).map(|_| f32::from_bits(1f32.to_bits() + draw.below(8) as u32)).collect();
    let vertices = heights.iter().flat_map(|&z| corners.map(|[x, y]| Vec3::new(x, y, z))).collect();
    let mesh = Mesh::new(vertices, (0..heights.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).ok()?;
    let ray =
        Ray::new(Vec3::new(0.5, 0.25, draw.one_of([-1.0, 64.0, 1024.0])), Vec3::Z * draw.one_of([1.0, -1.0])).ok()?;
    let bvh = built(draw, &mesh)?;
    check_tree::<K, B, _>(&bvh, &mesh, &[ray]).err().map(|fault| fault.to_string())
}

const fn filter<F: Filter<Vec3, Triangle> + 'static>(name: &'static str, clause: &'static str) -> Mistake {
    Mistake::new(name, clause, fault::<Behind<F>, Directed>, Instead::Rays(by_fours::<Behind<F>>))
}

/// What the library's tracer answers, with up to four triangles a leaf.
fn by_fours<K: Kernel<Vector = Vec3, Shape = Triangle>>(mesh: &Mesh, rays: &[Ray]) -> Option<Hits> {
    let bvh = Bvh::median(mesh, 4).ok()?;
    let tracer = BinaryTracer::<_, K, Directed>::with_tests(&bvh, Method::Stack).ok()?;
    Some(Hits { closest: tracer.closest_each(rays), any: tracer.any_each(rays) })
}

/// The exact test behind a filter of four triangles.
#[derive(Clone, Copy, Debug)]
struct Behind<F> {
    exact: Exact,
    filter: PhantomData<F>,
}

impl<F: Filter<Vec3, Triangle>> Kernel for Behind<F> {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = F;

    fn new(ray: &Ray, region: &Region) -> Self {
        Self { exact: Exact::new(ray, region), filter: PhantomData }
    }

    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        self.exact.distance(shape, limit)
    }

    fn blocks(&self, shape: &Triangle) -> bool {
        self.exact.blocks(shape)
    }

    fn compare(&self, shape: &Triangle, other: &Triangle) -> Ordering {
        self.exact.compare(shape, other)
    }

    fn compare_with(&self, shape: &Triangle, t: f32) -> Ordering {
        self.exact.compare_with(shape, t)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        self.exact.weights(shape)
    }
}

/// Rejects what single precision takes for a miss.
#[derive(Clone, Copy, Debug)]
struct SingleFilter(Moller32);

impl Filter<Vec3, Triangle> for SingleFilter {
    fn new(ray: &Ray, region: &Region) -> Self {
        Self(Moller32::new(ray, region))
    }

    fn survivors(&self, shapes: [&Triangle; 4], limit: f32) -> u32 {
        (0..).zip(shapes).map(|(lane, shape)| u32::from(self.0.distance(shape, limit).is_some()) << lane).sum()
    }
}

/// Puts two axes of the ray into each other's lanes.
#[derive(Clone, Copy, Debug)]
struct ExchangedFilter(TriangleFilter);

impl Filter<Vec3, Triangle> for ExchangedFilter {
    fn new(ray: &Ray, region: &Region) -> Self {
        let exchanged = Ray::within(ray.origin().yxz(), ray.direction().yxz(), ray.tmin(), ray.tmax());
        Self(TriangleFilter::new(&exchanged.unwrap_or(*ray), region))
    }

    fn survivors(&self, shapes: [&Triangle; 4], limit: f32) -> u32 {
        self.0.survivors(shapes, limit)
    }
}

/// A hierarchy by any builder.
pub(super) fn built(draw: &mut Draw<'_>, mesh: &Mesh) -> Option<Bvh> {
    let sah = SahOptions { max_leaf: draw.one_of([1, 2, 4]), ..SahOptions::default() };
    let options = BuildOptions { builder: draw.one_of(Builder::ALL), sah, ..BuildOptions::default() };
    options.build(mesh).ok()
}

fn restart(draw: &mut Draw<'_>, mutation: Mutation) -> Option<String> {
    let case = Case::draw(draw, Case::LEAVES);
    restarted(mutation).fault(&case).map(|fault| fault.to_string())
}

fn restarted(mutation: Mutation) -> Planted {
    let run = Planted::any("", "", move |tree, _, visitor, watcher| {
        if let Ok(laine) = Laine::<0, u64, _>::new(tree) {
            drive(Wrapped::new(tree, laine, mutation), visitor, watcher);
        }
    });
    run.restarting()
}

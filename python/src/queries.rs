//! Queries of many rays or points over a scene, as arrays.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use stackless_bvh::geom::truth::{Meeting, Place, Point, meet};
use stackless_bvh::geom::{Mesh, Ray, Vector, check_environment};
use stackless_bvh::trace::Hit;

use crate::arrays::{Chunks, Rays};
use crate::batch::in_pieces;
use crate::errors::failed;
use crate::memory::{reserve, room, zeroed};
use crate::space::{Coordinate, Space};
use crate::threads::{FEW, Threads, of_chunks, of_each};

/// A function that is called between pieces.
pub(crate) type Progress<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

/// Distances, triangles and weights.
pub(crate) type HitArrays<'py, R> = (Bound<'py, PyArray1<R>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray2<R>>);

/// The closest hit of each ray.
pub(crate) fn closest<'py, S: Space>(
    py: Python<'py>,
    bvh: &S,
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
) -> PyResult<HitArrays<'py, S::Real>> {
    let mut found = Found::zeroed(rays.len())?;
    let answer = |chunks: Chunks<S>| found.fill(chunks, |rays| bvh.closest(rays));
    traced(py, rays, progress, answer)?;
    found.into_arrays(py)
}

/// Whether each ray hits anything.
pub(crate) fn any<'py, S: Space>(
    py: Python<'py>,
    bvh: &S,
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let mut found = zeroed(rays.len())?;
    traced(py, rays, progress, |Chunks { rows, chunks }| {
        checked_each(chunks.iter().zip(found[rows].chunks_mut(FEW)), |(rays, found)| {
            found.copy_from_slice(&bvh.any(rays));
        })
    })?;
    Ok(found.into_pyarray(py))
}

/// Number of crossings of each ray with the mesh, by the half-open rule.
pub(crate) fn crossings<'py, S: Space>(
    py: Python<'py>,
    bvh: &S,
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let mut counts = zeroed(rays.len())?;
    traced(py, rays, progress, |Chunks { rows, chunks }| {
        checked_each(chunks.iter().zip(counts[rows].chunks_mut(FEW)), |(rays, counts)| {
            for (count, found) in counts.iter_mut().zip(bvh.crossings(rays)) {
                *count = i64::from(found);
            }
        })
    })?;
    Ok(counts.into_pyarray(py))
}

/// Answers all rays, piece by piece.
fn traced<'py, S: Space>(
    py: Python<'py>,
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
    answer: impl FnMut(Chunks<S>) -> PyResult<()> + Send,
) -> PyResult<()> {
    let read = |threads: &Threads, rows| rays.chunks(threads, rows);
    in_pieces(py, (rays.len(), FEW), progress, read, answer, |_, ()| Ok(()))
}

/// Works on each item, on threads with valid arithmetic.
fn checked_each<I: Send>(items: impl Iterator<Item = I>, work: impl Fn(I) + Sync) -> PyResult<()> {
    let checked = |item| check_environment().map(|()| work(item)).map_err(failed);
    of_each(items, checked).into_iter().collect()
}

/// The start of each ray's hits, then distances, triangles, weights and places: 0 in the interior of the triangle, 1 on
/// an edge, 2 at a corner.
pub(crate) type AllArrays<'py, R> = (Bound<'py, PyArray1<i64>>, HitArrays<'py, R>, Bound<'py, PyArray1<u8>>);

/// All hits of each ray.
pub(crate) fn all<'py, S: Space>(
    py: Python<'py>,
    (mesh, bvh): (&Mesh<S::Vector>, &S),
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
) -> PyResult<AllArrays<'py, S::Real>> {
    let (mut offsets, mut found, mut places) = (room(rays.len() + 1)?, Found::with_room(0)?, Vec::new());
    offsets.push(0);
    let answer = |rays: Vec<Ray<S::Vector>>| of_chunks(&rays, FEW, |rays| all_of::<S>(mesh, bvh, rays));
    let keep = |_: &Threads, chunks: Vec<AllOf<S::Real>>| {
        let count = chunks.iter().map(|chunk| chunk.hits.len()).sum();
        found.reserve(count)?;
        reserve(&mut places, count)?;
        for AllOf { ends, hits, places: new } in chunks {
            offsets.extend(ends.into_iter().map(|end| (found.t.len() + end) as i64));
            for hit in &hits {
                found.push(Some(hit));
            }
            places.extend(new);
        }
        Ok(())
    };
    in_pieces(py, (rays.len(), FEW), progress, |threads, rows| rays.chunk(threads, rows), answer, keep)?;
    Ok((offsets.into_pyarray(py), found.into_arrays(py)?, places.into_pyarray(py)))
}

/// All hits of some rays, the end of each ray's hits, and the places of hits.
struct AllOf<R> {
    ends: Vec<usize>,
    hits: Vec<Hit<R>>,
    places: Vec<u8>,
}

fn all_of<S: Space>(mesh: &Mesh<S::Vector>, bvh: &S, rays: &[Ray<S::Vector>]) -> PyResult<AllOf<S::Real>> {
    check_environment().map_err(failed)?;
    let mut all = AllOf { ends: room(rays.len())?, hits: Vec::new(), places: Vec::new() };
    for ray in rays {
        let hits = bvh.all(ray);
        reserve(&mut all.hits, hits.len())?;
        reserve(&mut all.places, hits.len())?;
        all.places.extend(hits.iter().map(|hit| place(mesh, ray, hit)));
        all.hits.extend(hits);
        all.ends.push(all.hits.len());
    }
    Ok(all)
}

/// The part of the triangle with a hit, exactly. Weights far from 0 and 1 decide; otherwise rational arithmetic
/// decides.
fn place<V: Vector<Real: Coordinate>>(mesh: &Mesh<V>, ray: &Ray<V>, hit: &Hit<V::Real>) -> u8 {
    let [u, v, near]: [f64; 3] = [hit.u, hit.v, V::Real::NEAR].map(Into::into);
    if u > near && v > near && 1.0 - u - v > near {
        return 0;
    }
    let corners = mesh.triangle(hit.prim as usize).map(V::components);
    match meet(corners, ray.origin().components(), ray.direction().components()) {
        Meeting::Hit(Point { place, .. }) => number_of(place),
        // Unreachable: the ray hits.
        Meeting::Miss | Meeting::Coplanar => 0,
    }
}

/// The number of a part of a triangle in arrays.
pub(crate) const fn number_of(place: Place) -> u8 {
    match place {
        Place::Interior => 0,
        Place::Edge => 1,
        Place::Vertex => 2,
    }
}

/// Growing arrays of hits.
pub(crate) struct Found<R> {
    t: Vec<R>,
    primitive: Vec<i64>,
    uv: Vec<[R; 2]>,
}

impl<R: Coordinate> Found<R> {
    pub(crate) fn with_room(count: usize) -> PyResult<Self> {
        Ok(Self { t: room(count)?, primitive: room(count)?, uv: room(count)? })
    }

    /// Arrays to [`fill`](Self::fill).
    fn zeroed(count: usize) -> PyResult<Self> {
        Ok(Self { t: zeroed(count)?, primitive: zeroed(count)?, uv: zeroed(count)? })
    }

    /// Reserves space for `count` more hits.
    fn reserve(&mut self, count: usize) -> PyResult<()> {
        reserve(&mut self.t, count)?;
        reserve(&mut self.primitive, count)?;
        reserve(&mut self.uv, count)
    }

    pub(crate) fn push(&mut self, hit: Option<&Hit<R>>) {
        self.t.push(distance(hit));
        self.primitive.push(primitive(hit));
        self.uv.push(weights(hit));
    }

    /// Fills the rows of these rays, on all threads.
    fn fill<S: Space<Real = R>>(
        &mut self,
        Chunks { rows, chunks }: Chunks<S>,
        answer: impl Fn(&[Ray<S::Vector>]) -> Vec<Option<Hit<R>>> + Sync,
    ) -> PyResult<()> {
        let t = self.t[rows.clone()].chunks_mut(FEW);
        let primitive = self.primitive[rows.clone()].chunks_mut(FEW);
        let uv = self.uv[rows].chunks_mut(FEW);
        checked_each(chunks.iter().zip(t).zip(primitive).zip(uv), |(((rays, t), primitive), uv)| {
            for (i, hit) in answer(rays).iter().map(Option::as_ref).enumerate() {
                (t[i], primitive[i], uv[i]) = (distance(hit), self::primitive(hit), weights(hit));
            }
        })
    }

    pub(crate) fn into_arrays(self, py: Python<'_>) -> PyResult<HitArrays<'_, R>> {
        let uv = self.uv.into_flattened().into_pyarray(py).reshape([self.t.len(), 2])?;
        Ok((self.t.into_pyarray(py), self.primitive.into_pyarray(py), uv))
    }
}

fn distance<R: Coordinate>(hit: Option<&Hit<R>>) -> R {
    hit.map_or(R::INFINITY, |hit| hit.t)
}

fn primitive<R>(hit: Option<&Hit<R>>) -> i64 {
    hit.map_or(-1, |hit| i64::from(hit.prim))
}

fn weights<R: Coordinate>(hit: Option<&Hit<R>>) -> [R; 2] {
    hit.map_or([R::NAN; 2], |hit| [hit.u, hit.v])
}

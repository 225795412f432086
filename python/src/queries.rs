//! Queries of many rays or points over a scene, as arrays.

use bytemuck::Zeroable;
use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use stackless_bvh::geom::{Ray, check_environment};
use stackless_bvh::trace::Hit;

use crate::arrays::{Chunks, Rays};
use crate::batch::in_pieces;
use crate::errors::failed;
use crate::memory::{reserve, room, zeroed};
use crate::space::{Coordinate, Space};
use crate::threads::{FEW, Threads, of_each};

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

/// An answer for each ray, as an element of an array.
pub(crate) fn per_ray<'py, S: Space, A, E: Element + Zeroable>(
    py: Python<'py>,
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
    answer: impl Fn(&[Ray<S::Vector>]) -> Vec<A> + Sync,
    element: impl Fn(A) -> E + Sync,
) -> PyResult<Bound<'py, PyArray1<E>>> {
    let mut found = zeroed(rays.len())?;
    traced(py, rays, progress, |Chunks { rows, chunks }| {
        checked_each(chunks.iter().zip(found[rows].chunks_mut(FEW)), |(rays, found)| {
            for (found, answer) in found.iter_mut().zip(answer(rays)) {
                *found = element(answer);
            }
        })
    })?;
    Ok(found.into_pyarray(py))
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
    pub(crate) fn reserve(&mut self, count: usize) -> PyResult<()> {
        reserve(&mut self.t, count)?;
        reserve(&mut self.primitive, count)?;
        reserve(&mut self.uv, count)
    }

    pub(crate) fn len(&self) -> usize {
        self.t.len()
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

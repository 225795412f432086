//! Queries of many rays or points over a scene, as arrays.

use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;
use stackless_bvh::geom::Ray;
use stackless_bvh::trace::Hit;

use crate::arrays::Rays;
use crate::batch::in_pieces;
use crate::errors::failed;
use crate::memory::{reserve, room};
use crate::space::{Answers, Coordinate, Space};
use crate::threads::{FEW, ROWS, Threads};

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
    let mut found = Found::with_room(rays.len())?;
    let answer = |rays: Vec<Ray<S::Vector>>| bvh.closest(&rays).map_err(failed);
    let keep = |threads: &Threads, hits: Vec<_>| {
        found.extend(threads, &hits);
        Ok(())
    };
    in_pieces(py, (rays.len(), FEW), progress, |threads, rows| rays.chunk(threads, rows), answer, keep)?;
    found.into_arrays(py)
}

/// An answer for each ray, as an element of an array.
pub(crate) fn per_ray<'py, S: Space, A: Send, E: Element>(
    py: Python<'py>,
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
    answer: impl Fn(&[Ray<S::Vector>]) -> Answers<A> + Sync,
    element: impl Fn(A) -> E,
) -> PyResult<Bound<'py, PyArray1<E>>> {
    let mut found = room(rays.len())?;
    let answer = |rays: Vec<Ray<S::Vector>>| answer(&rays).map_err(failed);
    let keep = |_: &Threads, answers: Vec<A>| {
        found.extend(answers.into_iter().map(&element));
        Ok(())
    };
    in_pieces(py, (rays.len(), FEW), progress, |threads, rows| rays.chunk(threads, rows), answer, keep)?;
    Ok(found.into_pyarray(py))
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

    /// Runs on all threads, because a single thread would be slower than tracing.
    fn extend(&mut self, threads: &Threads, hits: &[Option<Hit<R>>]) {
        if hits.len() <= ROWS {
            for hit in hits {
                self.push(hit.as_ref());
            }
            return;
        }
        let hits = || hits.par_iter().with_min_len(ROWS).map(Option::as_ref);
        threads.run(|| {
            self.t.par_extend(hits().map(distance));
            self.primitive.par_extend(hits().map(primitive));
            self.uv.par_extend(hits().map(weights));
        });
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

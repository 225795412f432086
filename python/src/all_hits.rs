//! All hits of many rays, as arrays.

use std::ops::Range;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use stackless_bvh::geom::{Mesh, Ray, Vector, check_environment};
use stackless_bvh::internals::geom::truth::{Meeting, Place, Point, meet};
use stackless_bvh::trace::Hit;

use crate::arrays::Rays;
use crate::batch::in_pieces;
use crate::errors::failed;
use crate::memory::{reserve, room};
use crate::queries::{Found, HitArrays, Progress};
use crate::space::{Coordinate, Space};
use crate::threads::{FEW, Threads, of_chunks};

/// The start of each ray's hits, then distances, triangles, weights and places: 0 in the interior of the triangle, 1 on
/// an edge, 2 at a corner.
pub(crate) type AllArrays<'py, R> = (Bound<'py, PyArray1<i64>>, HitArrays<'py, R>, Bound<'py, PyArray1<u8>>);

/// All hits of each ray over a mesh.
pub(crate) fn of_mesh<'py, S: Space>(
    py: Python<'py>,
    (mesh, bvh): (&Mesh<S::Vector>, &S),
    rays: &Rays<'py, S>,
    progress: Progress<'_, 'py>,
) -> PyResult<AllArrays<'py, S::Real>> {
    let place = |ray: &Ray<S::Vector>, hit: Hit<S::Real>, _: &mut Vec<i64>| {
        let place = place(&hit, || {
            let corners = mesh.triangle(hit.prim as usize).map(Vector::components);
            match meet(corners, ray.origin().components(), ray.direction().components()) {
                Meeting::Hit(Point { place, .. }) => Some(place),
                Meeting::Miss | Meeting::Coplanar => None,
            }
        });
        (hit, place)
    };
    let read = |threads: &Threads, rows| rays.chunk(threads, rows);
    Ok(all(py, (rays.len(), read), progress, |ray| bvh.all(ray), place)?.0)
}

/// All hits of rays of any kind: their number, and the function that reads some of them. `describe` returns a hit and
/// its place, and appends its path. Returns the paths too.
pub(crate) fn all<'py, Q: Sync, I: AsRef<[Q]> + Send, H, R: Coordinate>(
    py: Python<'py>,
    (count, read): (usize, impl Fn(&Threads, Range<usize>) -> PyResult<I>),
    progress: Progress<'_, 'py>,
    hits: impl Fn(&Q) -> Vec<H> + Sync,
    describe: impl Fn(&Q, H, &mut Vec<i64>) -> (Hit<R>, u8) + Sync,
) -> PyResult<(AllArrays<'py, R>, Vec<i64>)> {
    let (mut offsets, mut found) = (room(count + 1)?, Found::with_room(0)?);
    let (mut places, mut paths) = (Vec::new(), Vec::new());
    offsets.push(0);
    let answer = |rays: I| of_chunks(rays.as_ref(), FEW, |rays| Chunk::of(rays, &hits, &describe));
    let keep = |_: &Threads, chunks: Vec<Chunk<R>>| {
        let count = chunks.iter().map(|chunk| chunk.hits.len()).sum();
        found.reserve(count)?;
        reserve(&mut places, count)?;
        reserve(&mut paths, chunks.iter().map(|chunk| chunk.paths.len()).sum())?;
        for chunk in chunks {
            offsets.extend(chunk.ends.into_iter().map(|end| (found.len() + end) as i64));
            for (hit, place) in &chunk.hits {
                found.push(Some(hit));
                places.push(*place);
            }
            paths.extend(chunk.paths);
        }
        Ok(())
    };
    in_pieces(py, (count, FEW), progress, read, answer, keep)?;
    Ok(((offsets.into_pyarray(py), found.into_arrays(py)?, places.into_pyarray(py)), paths))
}

/// All hits of some rays: the end of each ray's hits, hits with their places, and paths.
struct Chunk<R> {
    ends: Vec<usize>,
    hits: Vec<(Hit<R>, u8)>,
    paths: Vec<i64>,
}

impl<R> Chunk<R> {
    fn of<Q, H>(
        rays: &[Q],
        all: impl Fn(&Q) -> Vec<H>,
        describe: impl Fn(&Q, H, &mut Vec<i64>) -> (Hit<R>, u8),
    ) -> PyResult<Self> {
        check_environment().map_err(failed)?;
        let mut chunk = Self { ends: room(rays.len())?, hits: Vec::new(), paths: Vec::new() };
        for ray in rays {
            let hits = all(ray);
            reserve(&mut chunk.hits, hits.len())?;
            chunk.hits.extend(hits.into_iter().map(|hit| describe(ray, hit, &mut chunk.paths)));
            chunk.ends.push(chunk.hits.len());
        }
        Ok(chunk)
    }
}

/// The part of the triangle with a hit, exactly. Weights far from 0 and 1 decide; otherwise rational arithmetic
/// decides.
pub(crate) fn place<R: Coordinate>(hit: &Hit<R>, exactly: impl FnOnce() -> Option<Place>) -> u8 {
    let [u, v, near]: [f64; 3] = [hit.u, hit.v, R::NEAR].map(Into::into);
    if u > near && v > near && 1.0 - u - v > near {
        return 0;
    }
    // `None` is unreachable: the ray hits.
    exactly().map_or(0, number_of)
}

/// The number of a part of a triangle in arrays.
pub(crate) const fn number_of(place: Place) -> u8 {
    match place {
        Place::Interior => 0,
        Place::Edge => 1,
        Place::Vertex => 2,
    }
}

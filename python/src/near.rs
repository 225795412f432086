//! The nearest faces of points.

use std::ops::Range;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use stackless_bvh::geom::{Ball, Mesh, Triangle, Vector, check_environment};
use stackless_bvh::internals::geom::Foot;
use stackless_bvh::trace::Near;

use crate::all_hits::number_of;
use crate::arrays::{Place, check_places, numbers, places, points, row_of};
use crate::batch::in_pieces;
use crate::errors::{failed, of_ball, refused};
use crate::memory::{self, room};
use crate::queries::Progress;
use crate::space::{Coordinate, Space};
use crate::threads::{FEW, Threads, of_chunks};

/// Balls as two arrays: points of shape (n, 3) and radii of shape (n,).
pub(crate) struct Balls<'py, S: Space> {
    points: PyReadonlyArray2<'py, S::Real>,
    radius: PyReadonlyArray1<'py, S::Real>,
    places: Vec<Place<'py>>,
}

impl<'py, S: Space> Balls<'py, S> {
    /// Checks that the arrays have equal lengths.
    pub(crate) fn new(arrays: [&Bound<'py, PyAny>; 2]) -> PyResult<Self> {
        let (points, radius) = (points::<S>(arrays[0], "points")?, numbers::<S>(arrays[1], "radius")?);
        let (count, radii) = (points.as_array().nrows(), radius.as_array().len());
        if radii != count {
            return Err(refused(format!("{count} points, but {radii} radii")));
        }
        Ok(Self { points, radius, places: places(count, arrays, ["points", "radius"])? })
    }

    pub(crate) fn len(&self) -> usize {
        self.points.as_array().nrows()
    }

    /// Some of the balls.
    pub(crate) fn chunk(&self, rows: Range<usize>) -> PyResult<Vec<Ball<S::Vector>>> {
        check_places(&self.places)?;
        let (points, radius) = (self.points.as_array(), self.radius.as_array());
        let center = |row| S::Vector::from_components(row_of(&points, row));
        rows.map(|row| Ball::new(center(row), radius[row]).map_err(|error| of_ball(error, row))).collect()
    }
}

/// Distances, triangles and points, `k` for each row; infinite, -1 and NaN if there are fewer.
pub(crate) type NearArrays<'py, R> = (Bound<'py, PyArray2<R>>, Bound<'py, PyArray2<i64>>, Bound<'py, PyArray2<R>>);

/// Weights, parts of the triangles, and normals, for each found triangle; NaN, 255 and NaN for missing triangles. The
/// normal of a triangle without area is NaN.
pub(crate) type Details<'py, R> = (Bound<'py, PyArray2<R>>, Bound<'py, PyArray1<u8>>, Bound<'py, PyArray2<R>>);

/// Details are optional.
pub(crate) type Answer<'py, R> = (NearArrays<'py, R>, Option<Details<'py, R>>);

/// Finds the `k` nearest triangles of each point, with details on request.
pub(crate) fn nearest<'py, S: Space>(
    py: Python<'py>,
    (mesh, bvh): (&Mesh<S::Vector>, &S),
    arrays: [&Bound<'py, PyAny>; 2],
    (k, with_details): (usize, bool),
    progress: Progress<'_, 'py>,
) -> PyResult<Answer<'py, S::Real>> {
    let balls = Balls::<S>::new(arrays)?;
    let count = balls.len();
    let numbers = count.saturating_mul(k);
    let (mut distance, mut primitive) = (room(numbers)?, room(numbers)?);
    let mut point = room(numbers.saturating_mul(3))?;
    let detailed = if with_details { numbers } else { 0 };
    let (mut uv, mut place) = (room(detailed.saturating_mul(2))?, room(detailed)?);
    let mut normal = room(detailed.saturating_mul(3))?;
    // There are no more results than faces.
    let most = k.min(mesh.triangles().len());
    let few = if k == 1 { FEW } else { FEW_BALLS };
    let answer = |balls: Vec<_>| {
        let nears = nearest_of(bvh, &balls, most)?;
        let details = if with_details { details_of::<S>(mesh, &balls, &nears)? } else { Vec::new() };
        Ok((nears, details))
    };
    let keep = |_: &Threads, (all, details): (Nears<S>, Vec<Detail<S::Real>>)| {
        let mut details = details.into_iter();
        for nears in all {
            let missing = k - nears.len();
            for Near { prim, distance: d, point: p } in nears {
                distance.push(d);
                primitive.push(i64::from(prim));
                point.extend(p.components());
                if let Some(Detail { foot, normal: n }) = details.next() {
                    uv.extend(foot.weights);
                    place.push(number_of(foot.place));
                    normal.extend(n);
                }
            }
            distance.resize(distance.len() + missing, <S::Real as Coordinate>::INFINITY);
            primitive.resize(primitive.len() + missing, -1);
            point.resize(point.len() + 3 * missing, S::Real::NAN);
            if with_details {
                uv.resize(uv.len() + 2 * missing, S::Real::NAN);
                place.resize(place.len() + missing, NO_PLACE);
                normal.resize(normal.len() + 3 * missing, S::Real::NAN);
            }
        }
        Ok(())
    };
    in_pieces(py, (count, few), progress, |_, rows| balls.chunk(rows), answer, keep)?;
    let shape = [count, k];
    let rows = |numbers: Vec<S::Real>, columns| {
        let shape = [numbers.len() / columns, columns];
        numbers.into_pyarray(py).reshape(shape)
    };
    let near = (distance.into_pyarray(py).reshape(shape)?, primitive.into_pyarray(py).reshape(shape)?, rows(point, 3)?);
    let details = if with_details { Some((rows(uv, 2)?, place.into_pyarray(py), rows(normal, 3)?)) } else { None };
    Ok((near, details))
}

/// The part of a missing triangle.
const NO_PLACE: u8 = 255;

/// A smaller limit than for rays, because a search for several triangles takes longer.
pub(crate) const FEW_BALLS: usize = 64;

/// An upper bound of the memory for one of the nearest triangles.
const NEAR_BYTES: usize = 128;

fn nearest_of<S: Space>(bvh: &S, balls: &[Ball<S::Vector>], k: usize) -> PyResult<Nears<S>> {
    if k == 1 {
        let nears = bvh.nearest(balls).map_err(failed)?;
        return Ok(nears.into_iter().map(|near| near.into_iter().collect()).collect());
    }
    let chunks = of_chunks(balls, FEW_BALLS, |balls| {
        check_environment().map_err(failed)?;
        let mut all = room(balls.len())?;
        for ball in balls {
            memory::check(k.saturating_mul(NEAR_BYTES))?;
            all.push(bvh.nearest_k(ball, k));
        }
        Ok(all)
    });
    Ok(chunks?.into_iter().flatten().collect())
}

/// The nearest triangles of each point.
type Nears<S> = Vec<Vec<Near<<S as Space>::Vector>>>;

/// The details of a found triangle.
struct Detail<R> {
    foot: Foot<R>,
    normal: [R; 3],
}

/// Computes the details of all found triangles, in order.
fn details_of<S: Space>(
    mesh: &Mesh<S::Vector>,
    balls: &[Ball<S::Vector>],
    nears: &[Vec<Near<S::Vector>>],
) -> PyResult<Vec<Detail<S::Real>>> {
    let pairs: Vec<_> = balls.iter().zip(nears).collect();
    let detail = |ball: &Ball<S::Vector>, near: &Near<_>| {
        let triangle = Triangle(mesh.triangle(near.prim as usize));
        let foot = Foot::of(&triangle, ball.center()).ok_or_else(|| failed("a vertex is not finite"))?;
        let normal = triangle.normal().map_or([S::Real::NAN; 3], Vector::components);
        Ok(Detail { foot, normal })
    };
    let chunks = of_chunks(&pairs, FEW_BALLS, |pairs| {
        pairs.iter().flat_map(|(ball, nears)| nears.iter().map(|near| detail(ball, near))).collect::<PyResult<Vec<_>>>()
    });
    Ok(chunks?.into_iter().flatten().collect())
}

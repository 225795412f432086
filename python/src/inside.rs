//! Points in arrays: inside, outside, and winding numbers.

use std::ops::Range;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use stackless_bvh::geom::{Mesh, Vector, check_environment};
use stackless_bvh::trace::{Boundary, Location, Rule};

use crate::arrays::{check_places, places, points, row_of};
use crate::batch::in_pieces;
use crate::errors::{failed, listed, refused};
use crate::memory::{self, room};
use crate::queries::Progress;
use crate::space::Space;
use crate::threads::{FEW, Threads, of_chunks};

/// A mesh, its hierarchy and its boundary.
pub(crate) type Solid<'a, S> = (&'a Mesh<<S as Space>::Vector>, &'a S, &'a Boundary);

/// The rule of a name.
pub(crate) fn rule_of(name: &str) -> PyResult<Rule> {
    let expected = || refused(format!("rule: '{name}', expected 'parity', 'nonzero' or 'winding'"));
    Rule::ALL.into_iter().find(|rule| rule.name() == name).ok_or_else(expected)
}

/// Whether each point is inside the mesh; `surface` for points on it.
pub(crate) fn contains<'py, S: Space>(
    py: Python<'py>,
    solid: Solid<'_, S>,
    points: &Bound<'py, PyAny>,
    (rule, surface): (Rule, bool),
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let is_in = |location| match location {
        Location::Inside => true,
        Location::Surface => surface,
        Location::Outside => false,
    };
    let (mesh, bvh, boundary) = with_room(solid)?;
    let answer = |points: &[_]| Ok(bvh.locate(mesh, boundary, rule, points)?.into_iter().map(is_in).collect());
    of_points::<S, _>(py, points, answer, progress)
}

/// The distance of each point from a mesh, negative inside.
pub(crate) fn signed_distances<'py, S: Space>(
    py: Python<'py>,
    solid: Solid<'_, S>,
    points: &Bound<'py, PyAny>,
    rule: Rule,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<S::Real>>> {
    let (mesh, bvh, boundary) = with_room(solid)?;
    let answer = |points: &[_]| bvh.signed_distances(mesh, boundary, rule, points);
    of_points::<S, _>(py, points, answer, progress)
}

/// The winding number of each point. A point on a face gets the number of one of the sides.
pub(crate) fn winding_numbers<'py, S: Space>(
    py: Python<'py>,
    solid: Solid<'_, S>,
    points: &Bound<'py, PyAny>,
    tolerance: f64,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (mesh, bvh, boundary) = with_room(solid)?;
    of_points::<S, _>(py, points, |points| bvh.windings(mesh, boundary, tolerance, points), progress)
}

/// Checks the memory for the hierarchy of the border, which the first point builds. The bound exceeds measured use.
fn with_room<S: Space>(solid: Solid<'_, S>) -> PyResult<Solid<'_, S>> {
    let (_, _, boundary) = solid;
    memory::check(512 * boundary.borders.len()).map(|()| solid)
}

/// Computes an answer for each point.
fn of_points<'py, S: Space, A: Send + numpy::Element>(
    py: Python<'py>,
    array: &Bound<'py, PyAny>,
    answer: impl Fn(&[S::Vector]) -> PyResult<Vec<A>> + Sync,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<A>>> {
    let rows = points::<S>(array, "points")?;
    let places = places(rows.as_array().nrows(), [array], ["points"])?;
    let array = rows.as_array();
    let read = |_: &Threads, rows: Range<usize>| {
        check_places(&places)?;
        let mut points = room(rows.len())?;
        for row in rows {
            let point = row_of(&array, row);
            if let [x, y, z] = point.map(Into::<f64>::into)
                && !(x.is_finite() && y.is_finite() && z.is_finite())
            {
                let found = listed(glam::DVec3::new(x, y, z));
                return Err(refused(format!("points[{row}]: {found}, expected finite numbers")));
            }
            points.push(S::Vector::from_components(point));
        }
        Ok(points)
    };
    let answer = |points: Vec<S::Vector>| {
        of_chunks(&points, FEW, |points| {
            check_environment().map_err(failed)?;
            answer(points)
        })
    };
    let mut found = room(array.nrows())?;
    let keep = |_: &Threads, answers: Vec<Vec<A>>| {
        found.extend(answers.into_iter().flatten());
        Ok(())
    };
    in_pieces(py, (array.nrows(), FEW), progress, read, answer, keep)?;
    Ok(found.into_pyarray(py))
}

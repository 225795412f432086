//! Points in arrays: inside, outside, and how often the mesh winds around them.

use std::ops::Range;

use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use stackless_bvh::geom::{Mesh, Vector, check_environment};
use stackless_bvh::trace::{Boundary, Location, Rule};

use crate::arrays::{check_places, places, points, row_of};
use crate::batch::in_pieces;
use crate::errors::{failed, listed, refused};
use crate::memory::room;
use crate::queries::Progress;
use crate::space::Space;
use crate::threads::{FEW, Threads, of_chunks};

/// A mesh, its hierarchy and its boundary.
pub(crate) type Solid<'a, S> = (&'a Mesh<<S as Space>::Vector>, &'a S, &'a Boundary);

/// The rule of a name.
pub(crate) fn rule_of(name: &str) -> PyResult<Rule> {
    Ok(match name {
        "parity" => Rule::Parity,
        "nonzero" => Rule::Nonzero,
        "winding" => Rule::Winding,
        _ => return Err(refused(format!("rule: '{name}', expected 'parity', 'nonzero' or 'winding'"))),
    })
}

/// Whether each point is inside of a mesh, and `surface` for those on it.
pub(crate) fn contains<'py, S: Space>(
    py: Python<'py>,
    solid: Solid<'_, S>,
    points: &Bound<'py, PyAny>,
    (rule, surface): (Rule, bool),
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let outside = (rule != Rule::Winding).then_some(false);
    let is_in = |location| match location {
        Location::Inside => true,
        Location::Surface => surface,
        Location::Outside => false,
    };
    let (mesh, bvh, boundary) = solid;
    let answer = |points: &[_]| Ok(bvh.locate(mesh, boundary, rule, points)?.into_iter().map(is_in).collect());
    of_points::<S, _>(py, mesh, points, outside, answer, progress)
}

/// How far each point is from a mesh: negative inside.
pub(crate) fn signed_distances<'py, S: Space>(
    py: Python<'py>,
    solid: Solid<'_, S>,
    points: &Bound<'py, PyAny>,
    rule: Rule,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<S::Real>>> {
    let (mesh, bvh, boundary) = solid;
    let answer = |points: &[_]| bvh.signed_distances(mesh, boundary, rule, points);
    of_points::<S, _>(py, mesh, points, None, answer, progress)
}

/// The winding number of each point; of one on a face that of one of its sides.
pub(crate) fn winding_numbers<'py, S: Space>(
    py: Python<'py>,
    solid: Solid<'_, S>,
    points: &Bound<'py, PyAny>,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (mesh, bvh, boundary) = solid;
    let outside = boundary.is_oriented().then_some(0.0);
    of_points::<S, _>(py, mesh, points, outside, |points| bvh.windings(mesh, boundary, points), progress)
}

/// An answer for each point. Those outside of the box of the mesh need no ray, if it is known what they are.
fn of_points<'py, S: Space, A: Copy + Default + Send + numpy::Element>(
    py: Python<'py>,
    mesh: &Mesh<S::Vector>,
    array: &Bound<'py, PyAny>,
    outside: Option<A>,
    answer: impl Fn(&[(usize, S::Vector)]) -> PyResult<Vec<A>> + Sync,
    progress: Progress<'_, 'py>,
) -> PyResult<Bound<'py, PyArray1<A>>> {
    let rows = points::<S>(array, "points")?;
    let places = places(rows.as_array().nrows(), [array], ["points"])?;
    let array = rows.as_array();
    let [lo, hi] = py.detach(|| bounds(mesh));
    let read = |_: &Threads, rows: Range<usize>| {
        check_places(&places)?;
        let mut inside_box = Vec::new();
        let count = rows.len();
        for (i, row) in rows.enumerate() {
            let point = row_of(&array, row);
            let wide = point.map(Into::<f64>::into);
            if wide.iter().any(|x| !x.is_finite()) {
                let [x, y, z] = wide;
                return Err(refused(format!(
                    "points[{row}]: {}, expected finite numbers",
                    listed(glam::DVec3::new(x, y, z))
                )));
            }
            if outside.is_none() || (0..3).all(|k| lo[k] <= wide[k] && wide[k] <= hi[k]) {
                inside_box.push((i, S::Vector::from_components(point)));
            }
        }
        Ok((count, inside_box))
    };
    let answer = |(count, inside_box): (usize, Vec<(usize, S::Vector)>)| {
        let mut answers = vec![outside.unwrap_or_default(); count];
        let found = of_chunks(&inside_box, FEW, |points| {
            check_environment().map_err(failed)?;
            answer(points)
        });
        for ((i, _), found) in inside_box.iter().zip(found?.into_iter().flatten()) {
            answers[*i] = found;
        }
        Ok(answers)
    };
    let mut found = room(array.nrows())?;
    let keep = |_: &Threads, answers: Vec<A>| {
        found.extend(answers);
        Ok(())
    };
    in_pieces(py, (array.nrows(), FEW), progress, read, answer, keep)?;
    Ok(found.into_pyarray(py))
}

/// The box of the vertices.
pub(crate) fn bounds<V: Vector<Real: Into<f64>>>(mesh: &Mesh<V>) -> [[f64; 3]; 2] {
    mesh.vertices().iter().fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[lo, hi], vertex| {
        let x = vertex.components().map(Into::<f64>::into);
        [[0, 1, 2].map(|k| lo[k].min(x[k])), [0, 1, 2].map(|k| hi[k].max(x[k]))]
    })
}

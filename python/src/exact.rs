//! Rays that start at exact points (of hits or of floats), as a Python object. `[SECOND-1]`

use std::ops::Range;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use stackless_bvh::geom::{Ends, ExactPoint, ExactRay, Mesh, RayError, Triangle, Vector as _, check_environment};
use stackless_bvh::trace::{Assembly, Hit, InstanceHit, InstanceTracer, RayQueries};
use stackless_bvh::traverse::Method;

use crate::all_hits::{AllArrays, all, place};
use crate::arrays::{Place, Rays, check_aligned, check_places, numbers, places, points, row_of};
use crate::batch::in_pieces;
use crate::errors::{failed, listed, of_ray, refused};
use crate::memory::room;
use crate::queries::{Found, HitArrays, Progress};
use crate::space::{Double, Single, Space};
use crate::threads::{FEW, Threads, of_chunks};

/// Rays over one mesh, with exact origins. A row without a hit has no ray.
#[pyclass(frozen, module = "stackless_bvh._native")]
pub(crate) struct ExactRays(Precision);

enum Precision {
    Single(Batch<Single>),
    Double(Batch<Double>),
}

struct Batch<S: Space> {
    mesh: Arc<Mesh<S::Vector>>,
    tracer: Arc<InstanceTracer<S::Vector>>,
    rays: Vec<Option<ExactRay<S::Vector>>>,
}

/// Evaluates an expression in either precision.
macro_rules! either {
    ($rays:expr, $batch:ident => $run:expr) => {
        match &$rays.0 {
            Precision::Single($batch) => $run,
            Precision::Double($batch) => $run,
        }
    };
}

#[pymethods]
impl ExactRays {
    fn __len__(&self) -> usize {
        either!(self, batch => batch.rays.len())
    }

    #[getter]
    fn dtype(&self) -> &'static str {
        match self.0 {
            Precision::Single(_) => Single::DTYPE,
            Precision::Double(_) => Double::DTYPE,
        }
    }

    fn closest<'py>(&self, py: Python<'py>, progress: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        either!(self, batch => batch.closest(py, progress.as_ref())?.into_bound_py_any(py))
    }

    fn any<'py>(&self, py: Python<'py>, progress: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyArray1<bool>>> {
        either!(self, batch => batch.any(py, progress.as_ref()))
    }

    fn all<'py>(&self, py: Python<'py>, progress: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        either!(self, batch => batch.all(py, progress.as_ref())?.into_bound_py_any(py))
    }

    /// Rays from the hits of `primitives`, along `directions`. Open ends do not belong to the ray.
    fn along<'py>(
        &self,
        py: Python<'py>,
        primitives: PyReadonlyArray1<'py, i64>,
        directions: &Bound<'py, PyAny>,
        tmax: &Bound<'py, PyAny>,
        closed: bool,
    ) -> PyResult<Self> {
        either!(self, batch => batch.along(py, &primitives, (directions, tmax), ends(closed)).map(|made| Self(made.into())))
    }

    /// Rays from the hits of `primitives` to `targets`.
    fn toward<'py>(
        &self,
        py: Python<'py>,
        primitives: PyReadonlyArray1<'py, i64>,
        targets: &Bound<'py, PyAny>,
        closed: bool,
    ) -> PyResult<Self> {
        either!(self, batch => batch.toward(py, &primitives, targets, ends(closed)).map(|made| Self(made.into())))
    }
}

impl From<Batch<Single>> for Precision {
    fn from(batch: Batch<Single>) -> Self {
        Self::Single(batch)
    }
}

impl From<Batch<Double>> for Precision {
    fn from(batch: Batch<Double>) -> Self {
        Self::Double(batch)
    }
}

/// Rays of floats, with closed ends.
#[expect(private_bounds, reason = "`Precision` is of this module")]
pub(crate) fn of_rays<'py, S: Space>(
    py: Python<'py>,
    (mesh, bvh): (&Arc<Mesh<S::Vector>>, &Arc<S>),
    rays: &Rays<'py, S>,
) -> PyResult<ExactRays>
where
    Precision: From<Batch<S>>,
{
    let read = |threads: &Threads, rows| {
        let rays = rays.chunk(threads, rows)?;
        Ok(rays.iter().map(|ray| Some(ExactRay::from(ray))).collect())
    };
    let rays = gathered(py, rays.len(), &[], read)?;
    Ok(ExactRays(Batch { mesh: Arc::clone(mesh), tracer: Arc::new(alone(bvh)?), rays }.into()))
}

/// Rays from float points to float points, where `t` is 1 exactly.
#[expect(private_bounds, reason = "`Precision` is of this module")]
pub(crate) fn segments<'py, S: Space>(
    py: Python<'py>,
    (mesh, bvh): (&Arc<Mesh<S::Vector>>, &Arc<S>),
    arrays: [&Bound<'py, PyAny>; 2],
    closed: bool,
) -> PyResult<ExactRays>
where
    Precision: From<Batch<S>>,
{
    let (from, to) = (points::<S>(arrays[0], "a")?, points::<S>(arrays[1], "b")?);
    let (from, to) = (from.as_array(), to.as_array());
    if from.nrows() != to.nrows() {
        return Err(refused(format!("a has {} rows, and b {}", from.nrows(), to.nrows())));
    }
    let ray = |row: usize| {
        let point = |array| ExactPoint::new(S::Vector::from_components(row_of(array, row)));
        let ray = point(&from).and_then(|from| from.toward(&point(&to)?, ends(closed)));
        ray.map(Some).map_err(|error| of_ends(error, row))
    };
    let places = places(from.nrows(), arrays, ["a", "b"])?;
    let rays = gathered(py, from.nrows(), &places, |threads, rows| threads.map(rows, ray))?;
    Ok(ExactRays(Batch { mesh: Arc::clone(mesh), tracer: Arc::new(alone(bvh)?), rays }.into()))
}

/// A tracer of exact rays through one mesh.
fn alone<S: Space>(bvh: &Arc<S>) -> PyResult<InstanceTracer<S::Vector>> {
    let mut assembly = Assembly::new();
    let object = bvh.add_to(&mut assembly);
    InstanceTracer::new(&assembly, object, Method::default()).map_err(failed)
}

/// Reads all rows of arrays piece by piece, and checks that the arrays do not move.
fn gathered<T: Send>(
    py: Python<'_>,
    count: usize,
    places: &[Place<'_>],
    read: impl Fn(&Threads, Range<usize>) -> PyResult<Vec<T>>,
) -> PyResult<Vec<T>> {
    let mut all = room(count)?;
    let read = |threads: &Threads, rows| check_places(places).and_then(|()| read(threads, rows));
    let keep = |_: &Threads, more| {
        all.extend(more);
        Ok(())
    };
    in_pieces(py, (count, FEW), None, read, Ok, keep)?;
    Ok(all)
}

impl<S: Space> Batch<S> {
    fn closest<'py>(&self, py: Python<'py>, progress: Progress<'_, 'py>) -> PyResult<HitArrays<'py, S::Real>> {
        let mut found = Found::with_room(self.rays.len())?;
        let hit = |ray: &ExactRay<S::Vector>| {
            self.tracer.closest(ray).map(|InstanceHit { prim, t, u, v, .. }| Hit { prim, t, u, v })
        };
        self.each(py, progress, |ray| ray.and_then(hit), |hit| found.push(hit.as_ref()))?;
        found.into_arrays(py)
    }

    fn any<'py>(&self, py: Python<'py>, progress: Progress<'_, 'py>) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let mut found = room(self.rays.len())?;
        self.each(py, progress, |ray| ray.is_some_and(|ray| self.tracer.any(ray)), |is_hit| found.push(is_hit))?;
        Ok(found.into_pyarray(py))
    }

    fn all<'py>(&self, py: Python<'py>, progress: Progress<'_, 'py>) -> PyResult<AllArrays<'py, S::Real>> {
        let hits = |ray: &Option<ExactRay<_>>| ray.as_ref().map(|ray| self.tracer.all(ray)).unwrap_or_default();
        let describe = |ray: &Option<ExactRay<_>>, InstanceHit { prim, t, u, v, .. }, _: &mut Vec<i64>| {
            let hit = Hit { prim, t, u, v };
            let triangle = || Triangle(self.mesh.triangle(prim as usize));
            let place = place(&hit, || Some(ray.as_ref()?.meet(&triangle(), &[])?.place));
            (hit, place)
        };
        Ok(all(py, (self.rays.len(), |_: &Threads, rows| Ok(&self.rays[rows])), progress, hits, describe)?.0)
    }

    /// Answers all rows, on all threads.
    fn each<A: Send>(
        &self,
        py: Python<'_>,
        progress: Progress<'_, '_>,
        answer: impl Fn(Option<&ExactRay<S::Vector>>) -> A + Sync,
        mut keep: impl FnMut(A),
    ) -> PyResult<()> {
        let answer = |rays: &[Option<ExactRay<S::Vector>>]| {
            of_chunks(rays, FEW, |rays| {
                check_environment().map_err(failed)?;
                Ok(rays.iter().map(|ray| answer(ray.as_ref())).collect::<Vec<_>>())
            })
        };
        let keep = |_: &Threads, answers: Vec<Vec<A>>| {
            answers.into_iter().flatten().for_each(&mut keep);
            Ok(())
        };
        in_pieces(py, (self.rays.len(), FEW), progress, |_, rows| Ok(&self.rays[rows]), answer, keep)
    }

    fn along<'py>(
        &self,
        py: Python<'py>,
        primitives: &PyReadonlyArray1<'py, i64>,
        (directions, tmax): (&Bound<'py, PyAny>, &Bound<'py, PyAny>),
        ends: Ends,
    ) -> PyResult<Self> {
        let arrays = [primitives.as_any(), directions, tmax];
        let places = places(self.rays.len(), arrays, ["primitive", "directions", "tmax"])?;
        let (directions, tmax) = (points::<S>(directions, "directions")?, numbers::<S>(tmax, "tmax")?);
        let (directions, tmax) = (directions.as_array(), tmax.as_array());
        self.check_rows([("directions", directions.nrows()), ("tmax", tmax.len())])?;
        self.onward(py, primitives, &places, |row, point| {
            let ray = point.ray(S::Vector::from_components(row_of(&directions, row)), tmax[row], ends);
            ray.map_err(|error| of_ray(error, row))
        })
    }

    fn toward<'py>(
        &self,
        py: Python<'py>,
        primitives: &PyReadonlyArray1<'py, i64>,
        targets: &Bound<'py, PyAny>,
        ends: Ends,
    ) -> PyResult<Self> {
        let places = places(self.rays.len(), [primitives.as_any(), targets], ["primitive", "points"])?;
        let targets = points::<S>(targets, "points")?;
        let targets = targets.as_array();
        self.check_rows([("points", targets.nrows())])?;
        self.onward(py, primitives, &places, |row, point| {
            let target = ExactPoint::new(S::Vector::from_components(row_of(&targets, row)));
            target.and_then(|target| point.toward(&target, ends)).map_err(|error| of_ends(error, row))
        })
    }

    /// A ray for each hit, from its row and its exact point.
    fn onward<'py>(
        &self,
        py: Python<'py>,
        primitives: &PyReadonlyArray1<'py, i64>,
        places: &[Place<'py>],
        next: impl Fn(usize, ExactPoint<S::Vector>) -> PyResult<ExactRay<S::Vector>> + Sync,
    ) -> PyResult<Self> {
        check_aligned(primitives.as_any(), "primitive")?;
        let primitives = primitives.as_array();
        self.check_rows([("primitive", primitives.len())])?;
        let ray = |row: usize| {
            let (Some(ray), Ok(prim)) = (&self.rays[row], usize::try_from(primitives[row])) else { return Ok(None) };
            let lost =
                || refused(format!("primitive[{row}]: the ray does not hit face {prim}; were its arrays changed?"));
            if prim >= self.mesh.triangles().len() {
                return Err(lost());
            }
            let point = ExactPoint::met(ray, &Triangle(self.mesh.triangle(prim))).ok_or_else(lost)?;
            next(row, point).map(Some)
        };
        let rays = gathered(py, self.rays.len(), places, |threads, rows| threads.map(rows, ray))?;
        Ok(Self { mesh: Arc::clone(&self.mesh), tracer: Arc::clone(&self.tracer), rays })
    }

    fn check_rows<const N: usize>(&self, arrays: [(&str, usize); N]) -> PyResult<()> {
        let count = self.rays.len();
        match arrays.into_iter().find(|(_, rows)| *rows != count) {
            Some((name, rows)) => Err(refused(format!("{name}: {rows} rows, expected {count}, one for each ray"))),
            None => Ok(()),
        }
    }
}

const fn ends(closed: bool) -> Ends {
    if closed { Ends::Closed } else { Ends::Open }
}

/// An error for two points without a ray.
fn of_ends(error: RayError, row: usize) -> PyErr {
    match error {
        RayError::ZeroDirection => refused(format!("row {row}: both ends are one point, expected two")),
        RayError::Origin(point) => refused(format!("row {row}: {}, expected finite numbers", listed(point))),
        other => of_ray(other, row),
    }
}

//! Scenes with many placements, as a Python object.

use std::sync::Arc;

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;

use crate::arrays::Rays;
use crate::errors::refused;
use crate::near::Balls;
use crate::placed::{Part, Placed};
use crate::scene::{Either, Scene};
use crate::space::{Double, Single, Space};

/// Scenes and groups of scenes, placed by affine maps.
#[pyclass(frozen, module = "stackless_bvh._native")]
pub(crate) struct Instances(Precision);

/// Instances of scenes in single or in double precision.
enum Precision {
    Single(Placed<Single>),
    Double(Placed<Double>),
}

/// A part in either precision.
enum AnyPart {
    Single(Part<Single>),
    Double(Part<Double>),
}

/// Evaluates an expression in either precision.
macro_rules! either {
    ($instances:expr, $placed:ident => $run:expr) => {
        match &$instances.0 {
            Precision::Single($placed) => $run,
            Precision::Double($placed) => $run,
        }
    };
}

#[pymethods]
impl Instances {
    /// `scenes[objects[i]]`, a scene or instances, is placed by the map `transforms[i]`, of shape (3, 4).
    #[new]
    fn new(
        py: Python<'_>,
        scenes: Vec<Bound<'_, PyAny>>,
        objects: PyReadonlyArray1<'_, i64>,
        transforms: &Bound<'_, PyAny>,
        dtype: &str,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (maps, progress) = ((&objects, transforms), progress.as_ref());
        Ok(Self(if dtype == Single::DTYPE {
            Precision::Single(Placed::new(py, parts(&scenes)?, maps, progress)?)
        } else {
            Precision::Double(Placed::new(py, parts(&scenes)?, maps, progress)?)
        }))
    }

    fn __len__(&self) -> usize {
        either!(self, placed => placed.group.placed.len())
    }

    #[getter]
    fn dtype(&self) -> &'static str {
        match self.0 {
            Precision::Single(_) => Single::DTYPE,
            Precision::Double(_) => Double::DTYPE,
        }
    }

    fn closest<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, placed => {
            placed.closest(py, &Rays::new(rays.each_ref())?, progress.as_ref())?.into_bound_py_any(py)
        })
    }

    fn any<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        either!(self, placed => placed.any(py, &Rays::new(rays.each_ref())?, progress.as_ref()))
    }

    fn crossings<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        either!(self, placed => placed.crossings(py, &Rays::new(rays.each_ref())?, progress.as_ref()))
    }

    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points_and_radius: [Bound<'py, PyAny>; 2],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, placed => {
            placed.nearest(py, &Balls::new(points_and_radius.each_ref())?, progress.as_ref())?.into_bound_py_any(py)
        })
    }

    fn all<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, placed => {
            placed.all(py, &Rays::new(rays.each_ref())?, progress.as_ref())?.into_bound_py_any(py)
        })
    }
}

/// Parts that must have one precision.
fn parts<S: Space>(scenes: &[Bound<'_, PyAny>]) -> PyResult<Vec<Part<S>>>
where
    Part<S>: TryFrom<AnyPart, Error = &'static str>,
{
    let part = |(i, scene): (usize, &Bound<'_, PyAny>)| {
        let other = |dtype| refused(format!("scenes[{i}]: {dtype}, expected {}, the dtype of scenes[0]", S::DTYPE));
        AnyPart::of(scene)?.try_into().map_err(other)
    };
    scenes.iter().enumerate().map(part).collect()
}

impl AnyPart {
    fn of(scene: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(instances) = scene.cast::<Instances>() {
            return Ok(match &instances.get().0 {
                Precision::Single(placed) => Self::Single(Part::Group(Arc::clone(&placed.group))),
                Precision::Double(placed) => Self::Double(Part::Group(Arc::clone(&placed.group))),
            });
        }
        let scene: PyRef<'_, Scene> = scene.extract()?;
        Ok(match &scene.held {
            Either::Single(held) => Self::Single(Part::of(held)),
            Either::Double(held) => Self::Double(Part::of(held)),
        })
    }
}

impl TryFrom<AnyPart> for Part<Single> {
    type Error = &'static str;

    fn try_from(part: AnyPart) -> Result<Self, Self::Error> {
        match part {
            AnyPart::Single(part) => Ok(part),
            AnyPart::Double(_) => Err(Double::DTYPE),
        }
    }
}

impl TryFrom<AnyPart> for Part<Double> {
    type Error = &'static str;

    fn try_from(part: AnyPart) -> Result<Self, Self::Error> {
        match part {
            AnyPart::Double(part) => Ok(part),
            AnyPart::Single(_) => Err(Single::DTYPE),
        }
    }
}

//! A mesh with its hierarchy, as a Python object.

use std::path::PathBuf;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use stackless_scene::{SavedError, scene_from_bytes};

use crate::arrays::{Rays, mesh};
use crate::batch::in_background;
use crate::errors::refused;
use crate::exact::ExactRays;
use crate::held::Held;
use crate::memory::{self, room};
use crate::space::{Double, Single, Space, builder};
use crate::threads::Threads;
use crate::{all_hits, exact, file, inside, near, queries};

/// A mesh with its hierarchy.
#[pyclass(module = "stackless_bvh._native")]
pub(crate) struct Scene {
    pub(crate) held: Either,
}

/// A mesh in single or in double precision.
#[derive(Clone)]
pub(crate) enum Either {
    Single(Box<Held<Single>>),
    Double(Box<Held<Double>>),
}

/// Evaluates an expression in either precision.
macro_rules! either {
    ($scene:expr, $held:ident, $space:ident => $run:expr) => {
        match &$scene.held {
            Either::Single($held) => {
                type $space = Single;
                $run
            }
            Either::Double($held) => {
                type $space = Double;
                $run
            }
        }
    };
}

fn object<'py>(py: Python<'py>, made: impl IntoPyObject<'py>) -> PyResult<Bound<'py, PyAny>> {
    made.into_bound_py_any(py)
}

#[pymethods]
impl Scene {
    #[new]
    fn new(
        py: Python<'_>,
        vertices: &Bound<'_, PyAny>,
        faces: &Bound<'_, PyAny>,
        dtype: &str,
        build: &str,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (builder, progress) = (builder(build)?, progress.as_ref());
        let held = if dtype == Single::DTYPE {
            Either::Single(Box::new(Held::build(py, mesh::<Single>(vertices, faces)?, builder, progress)?))
        } else {
            Either::Double(Box::new(Held::build(py, mesh::<Double>(vertices, faces)?, builder, progress)?))
        };
        Ok(Self { held })
    }

    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: PyReadonlyArray1<'_, u8>) -> PyResult<Self> {
        let (bytes, threads) = (bytes.as_slice()?, Threads::all(py)?);
        Ok(Self { held: py.detach(|| threads.run(|| Either::from_bytes(bytes)))? })
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u8>>> {
        Ok(py.detach(|| self.held.to_bytes())?.into_pyarray(py))
    }

    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, progress: Option<Bound<'_, PyAny>>) -> PyResult<Self> {
        let work = move |tell: &(dyn Fn(usize) + Sync)| Either::from_bytes(&file::read(&path, tell)?);
        Ok(Self { held: in_background(py, file::STEPS, progress.as_ref(), work)? })
    }

    fn save(&self, py: Python<'_>, path: PathBuf, progress: Option<Bound<'_, PyAny>>) -> PyResult<()> {
        let held = self.held.clone();
        let work = move |tell: &(dyn Fn(usize) + Sync)| file::write(&path, &held.to_bytes()?, tell);
        in_background(py, file::STEPS, progress.as_ref(), work)
    }

    /// Reads a scene from a mesh file, with a note about the file.
    #[staticmethod]
    fn load_mesh(
        py: Python<'_>,
        path: PathBuf,
        dtype: &str,
        build: &str,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<(Self, Option<String>)> {
        let (builder, progress) = (builder(build)?, progress.as_ref());
        let (held, note) = if dtype == Single::DTYPE {
            let (mesh, note) = file::load_mesh(py, path)?;
            (Either::Single(Box::new(Held::build(py, mesh, builder, progress)?)), note)
        } else {
            let (mesh, note) = file::load_mesh(py, path)?;
            (Either::Double(Box::new(Held::build(py, mesh, builder, progress)?)), note)
        };
        Ok((Self { held }, note))
    }

    fn copy(&self) -> Self {
        Self { held: self.held.clone() }
    }

    fn refit(
        &mut self,
        py: Python<'_>,
        vertices: &Bound<'_, PyAny>,
        optimize: bool,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        match &mut self.held {
            Either::Single(held) => held.refit(py, vertices, optimize, progress.as_ref()),
            Either::Double(held) => held.refit(py, vertices, optimize, progress.as_ref()),
        }
    }

    #[getter]
    fn dtype(&self) -> &'static str {
        either!(self, _held, S => S::DTYPE)
    }

    /// How often the vertices were moved.
    #[getter]
    fn refits(&self) -> u64 {
        match &self.held {
            Either::Single(held) => held.refits,
            Either::Double(held) => held.refits,
        }
    }

    /// Memory of the mesh and of the hierarchy, in bytes.
    #[getter]
    fn bytes(&self) -> (usize, usize) {
        either!(self, held, S => {
            let mesh = size_of_val(held.mesh.vertices()) + size_of_val(held.mesh.triangles());
            (mesh, S::bytes(&held.bvh))
        })
    }

    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            let mut numbers = room(3 * held.mesh.vertices().len())?;
            numbers.extend(held.mesh.vertices().iter().flat_map(|&v| <[_; 3]>::from(v)));
            let numbers: Bound<'py, PyArray1<<S as Space>::Real>> = numbers.into_pyarray(py);
            object(py, numbers.reshape([held.mesh.vertices().len(), 3])?)
        })
    }

    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let faces = self.triangles();
        let mut indices = room(3 * faces.len())?;
        indices.extend(faces.iter().flatten().map(|&index| i64::from(index)));
        indices.into_pyarray(py).reshape([faces.len(), 3])
    }

    /// Numbers of open edges, unpaired edges and repeated faces, and a message for the first open edge.
    fn boundary(&self, py: Python<'_>) -> PyResult<(usize, usize, usize, Option<String>)> {
        let boundary = either!(self, held, _S => held.boundary(py)?);
        let wrong = boundary.first.map(|edge| {
            let ([a, b], count) = (edge.ends, edge.faces);
            let faces = if count == 1 { "face" } else { "faces" };
            format!("the edge ({a}, {b}) of faces[{}] is in {count} {faces}, expected an even number", edge.face)
        });
        Ok((boundary.open, boundary.unpaired, boundary.repeated, wrong))
    }

    fn closest<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            object(py, queries::closest::<S>(py, &held.bvh, &Rays::new(rays.each_ref())?, progress.as_ref())?)
        })
    }

    fn any<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            let rays = Rays::<S>::new(rays.each_ref())?;
            object(py, queries::per_ray(py, &rays, progress.as_ref(), |rays| held.bvh.any(rays), |hit| hit)?)
        })
    }

    fn all<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            let rays = Rays::new(rays.each_ref())?;
            object(py, all_hits::of_mesh::<S>(py, (&held.mesh, &held.bvh), &rays, progress.as_ref())?)
        })
    }

    /// Rays with exact hits, from which rays can continue.
    fn exact<'py>(&self, py: Python<'py>, rays: [Bound<'py, PyAny>; 4], refits: u64) -> PyResult<ExactRays> {
        if refits != self.refits() {
            return Err(refused("the vertices were moved after these hits"));
        }
        either!(self, held, S => exact::of_rays::<S>(py, (&held.mesh, &held.bvh), &Rays::new(rays.each_ref())?))
    }

    /// Rays from points to points.
    fn segments<'py>(&self, py: Python<'py>, ends: [Bound<'py, PyAny>; 2], closed: bool) -> PyResult<ExactRays> {
        either!(self, held, S => exact::segments::<S>(py, (&held.mesh, &held.bvh), ends.each_ref(), closed))
    }

    fn crossings<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            let rays = Rays::<S>::new(rays.each_ref())?;
            object(py, queries::per_ray(py, &rays, progress.as_ref(), |rays| held.bvh.crossings(rays), i64::from)?)
        })
    }

    fn contains<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        rule: &str,
        surface: bool,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let rule = inside::rule_of(rule)?;
        either!(self, held, S => {
            let solid = (&*held.mesh, &*held.bvh, held.boundary(py)?);
            object(py, inside::contains::<S>(py, solid, points, (rule, surface), progress.as_ref())?)
        })
    }

    fn winding_numbers<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        tolerance: f64,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            let solid = (&*held.mesh, &*held.bvh, held.boundary(py)?);
            object(py, inside::winding_numbers::<S>(py, solid, points, tolerance, progress.as_ref())?)
        })
    }

    fn signed_distances<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        rule: &str,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let rule = inside::rule_of(rule)?;
        either!(self, held, S => {
            let solid = (&*held.mesh, &*held.bvh, held.boundary(py)?);
            object(py, inside::signed_distances::<S>(py, solid, points, rule, progress.as_ref())?)
        })
    }

    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points_and_radius: [Bound<'py, PyAny>; 2],
        k: usize,
        details: bool,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            let of = (&*held.mesh, &*held.bvh);
            object(py, near::nearest::<S>(py, of, points_and_radius.each_ref(), (k, details), progress.as_ref())?)
        })
    }
}

impl Scene {
    fn triangles(&self) -> &[[u32; 3]] {
        either!(self, held, _S => held.mesh.triangles())
    }
}

impl Either {
    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        // An upper bound of all memory for reading.
        memory::check(bytes.len().saturating_mul(3))?;
        let found = match scene_from_bytes(bytes) {
            Err(SavedError::Precision { .. }) => {
                scene_from_bytes(bytes).map(|(mesh, bvh)| Self::Double(Box::new(Held::new(mesh, bvh))))
            }
            single => single.map(|(mesh, bvh)| Self::Single(Box::new(Held::new(mesh, bvh)))),
        };
        found.map_err(refused)
    }

    fn to_bytes(&self) -> PyResult<Vec<u8>> {
        match self {
            Self::Single(held) => file::to_bytes(&held.mesh, &held.bvh),
            Self::Double(held) => file::to_bytes(&held.mesh, &held.bvh),
        }
    }
}

//! A mesh with its hierarchy, as a Python object.

use std::sync::{Arc, OnceLock};

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stackless_bvh::bvh::{Builder, Stored};
use stackless_bvh::geom::Mesh;

use crate::arrays::{Rays, mesh, mesh_of, vertices_of};
use crate::batch::in_background;
use crate::closed::Edges;
use crate::errors::refused;
use crate::space::{Double, Single, Space};
use crate::{file, queries};

/// A mesh with its hierarchy.
#[pyclass(module = "stackless_bvh._native")]
pub(crate) struct Scene {
    held: Either,
}

/// In single or in double precision.
enum Either {
    Single(Box<Held<Single>>),
    Double(Box<Held<Double>>),
}

/// A mesh, its hierarchy, and what is known of its edges.
struct Held<S: Space> {
    /// Shared with what is made of it in the background.
    mesh: Arc<Mesh<S::Vector>>,
    bvh: S,
    edges: OnceLock<Edges>,
}

/// The same expression for either precision.
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

/// An object of either kind of arrays.
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
    fn from_bytes(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        let held = if file::real_bytes(bytes)? == 4 {
            Either::Single(Box::new(py.detach(|| Held::from_bytes(bytes))?))
        } else {
            Either::Double(Box::new(py.detach(|| Held::from_bytes(bytes))?))
        };
        Ok(Self { held })
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes = either!(self, held, S => py.detach(|| file::to_bytes::<S>(&held.mesh, &held.bvh)));
        PyBytes::new(py, &bytes)
    }

    fn refit(&mut self, py: Python<'_>, vertices: &Bound<'_, PyAny>, optimize: bool) -> PyResult<()> {
        match &mut self.held {
            Either::Single(held) => held.refit(py, vertices, optimize),
            Either::Double(held) => held.refit(py, vertices, optimize),
        }
    }

    #[getter]
    fn dtype(&self) -> &'static str {
        either!(self, _held, S => S::DTYPE)
    }

    /// Memory in bytes: of the mesh, and of the hierarchy.
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
            let numbers: Vec<_> = held.mesh.vertices().iter().flat_map(|&v| <[_; 3]>::from(v)).collect();
            let numbers: Bound<'py, PyArray1<<S as Space>::Real>> = numbers.into_pyarray(py);
            object(py, numbers.reshape([held.mesh.vertices().len(), 3])?)
        })
    }

    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let faces = self.triangles();
        let indices: Vec<_> = faces.iter().flatten().map(|&index| i64::from(index)).collect();
        indices.into_pyarray(py).reshape([faces.len(), 3])
    }

    /// The numbers of open edges and of unpaired ones, and what is wrong with the first open one.
    fn edges(&self, py: Python<'_>) -> (usize, usize, Option<String>) {
        let edges = match &self.held {
            Either::Single(held) => py.detach(|| held.edges()),
            Either::Double(held) => py.detach(|| held.edges()),
        };
        let wrong = edges.first.map(|edge| {
            let ([a, b], count) = (edge.ends, edge.faces);
            let faces = if count == 1 { "face" } else { "faces" };
            format!("the edge ({a}, {b}) of faces[{}] is in {count} {faces}, expected an even number", edge.face)
        });
        (edges.open, edges.unpaired, wrong)
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
            object(py, queries::any::<S>(py, &held.bvh, &Rays::new(rays.each_ref())?, progress.as_ref())?)
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
            object(py, queries::all::<S>(py, (&held.mesh, &held.bvh), &rays, progress.as_ref())?)
        })
    }

    fn crossings<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            object(py, queries::crossings::<S>(py, &held.bvh, &Rays::new(rays.each_ref())?, progress.as_ref())?)
        })
    }

    fn contains<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        boundary: bool,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            object(py, queries::contains::<S>(py, (&held.mesh, &held.bvh), points, boundary, progress.as_ref())?)
        })
    }

    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        radius: &Bound<'py, PyAny>,
        k: usize,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(self, held, S => {
            object(py, queries::nearest::<S>(py, &held.bvh, [points, radius], k, progress.as_ref())?)
        })
    }
}

impl Scene {
    fn triangles(&self) -> &[[u32; 3]] {
        match &self.held {
            Either::Single(held) => held.mesh.triangles(),
            Either::Double(held) => held.mesh.triangles(),
        }
    }

    /// The mesh, if it is in single precision.
    pub(crate) fn single_mesh(&self) -> Option<&Arc<Mesh>> {
        match &self.held {
            Either::Single(held) => Some(&held.mesh),
            Either::Double(_) => None,
        }
    }
}

impl<S: Space<Vector: Stored> + 'static> Held<S> {
    fn build(
        py: Python<'_>,
        mesh: Mesh<S::Vector>,
        builder: Builder,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let count = mesh.triangles().len();
        in_background(py, count, progress, move |tell| {
            let bvh = S::build(&mesh, builder, tell)?;
            Ok(Self { mesh: Arc::new(mesh), bvh, edges: OnceLock::new() })
        })
    }

    fn from_bytes(bytes: &[u8]) -> PyResult<Self> {
        let (mesh, bvh) = file::from_bytes(bytes)?;
        Ok(Self { mesh: Arc::new(mesh), bvh, edges: OnceLock::new() })
    }

    /// Nothing has changed after an error, but for one of optimizing.
    fn refit(&mut self, py: Python<'_>, vertices: &Bound<'_, PyAny>, optimize: bool) -> PyResult<()> {
        let (vertices, count) = (vertices_of::<S>(vertices)?, self.mesh.vertices().len());
        if vertices.len() != count {
            return Err(refused(format!("vertices: {} rows, expected {count} as the scene has", vertices.len())));
        }
        py.detach(|| {
            let mesh = mesh_of::<S>(vertices, self.mesh.triangles().to_vec())?;
            self.bvh.refit(&mesh)?;
            (self.mesh, self.edges) = (Arc::new(mesh), OnceLock::new());
            if optimize { self.bvh.optimize() } else { Ok(()) }
        })
    }

    fn edges(&self) -> &Edges {
        self.edges.get_or_init(|| Edges::of(&self.mesh))
    }
}

/// A builder by its name.
fn builder(build: &str) -> PyResult<Builder> {
    let names = Builder::ALL.map(Builder::name).join(", ");
    build.parse().map_err(|_| refused(format!("build: '{build}', expected one of {names}")))
}

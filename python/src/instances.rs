//! Scenes that are placed many times, as a Python object.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;
use rayon::prelude::*;
use stackless_bvh::bvh::{BuildOptions, Bvh, WideBvh};
use stackless_bvh::geom::{AffineError, AffineMap, EnvironmentError, Ray, check_environment};
use stackless_bvh::trace::{Assembly, AssemblyError, Hit, Instance, InstanceHit, InstanceTracer};
use stackless_bvh::traverse::Method;

use crate::arrays::{Rays, check_aligned};
use crate::batch::in_pieces;
use crate::errors::{failed, refused};
use crate::queries::{Found, HitArrays, room};
use crate::scene::Scene;
use crate::space::Answers;

/// Scenes in single precision, placed by affine maps.
#[pyclass(frozen, module = "stackless_bvh._native")]
pub(crate) struct Instances {
    tracer: InstanceTracer,
    count: usize,
}

/// Rays that a thread takes at once.
const CHUNK: usize = 256;

#[pymethods]
impl Instances {
    /// `scenes[objects[i]]` is placed by the map `transforms[i]`, of shape (3, 4).
    #[new]
    fn new(
        py: Python<'_>,
        scenes: Vec<PyRef<'_, Scene>>,
        objects: PyReadonlyArray1<'_, i64>,
        transforms: PyReadonlyArray3<'_, f32>,
    ) -> PyResult<Self> {
        check_aligned(objects.as_any(), "objects")?;
        check_aligned(transforms.as_any(), "transforms")?;
        let mut assembly = Assembly::new();
        let mut added = Vec::new();
        for (i, scene) in scenes.iter().enumerate() {
            let mesh = scene.single_mesh().ok_or_else(|| refused(format!("scenes[{i}]: float64, expected float32")))?;
            let bvh = py.detach(|| Bvh::build(mesh)).map_err(failed)?;
            added.push(assembly.add_mesh(bvh));
        }
        let (objects, transforms) = (objects.as_array(), transforms.as_array());
        if transforms.dim() != (objects.len(), 3, 4) {
            let (count, rows, columns) = transforms.dim();
            let expected = objects.len();
            return Err(refused(format!(
                "transforms: shape ({count}, {rows}, {columns}), expected ({expected}, 3, 4)"
            )));
        }
        let instance = |(i, &object): (usize, &i64)| {
            let of_object = usize::try_from(object).ok().and_then(|object| added.get(object));
            let unknown = || refused(format!("objects[{i}]: {object}, expected 0 to {}", added.len() as i64 - 1));
            let rows = [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| transforms[[i, row, column]]));
            let affine = AffineMap::new(rows).map_err(|error| of_affine(error, i))?;
            Ok(Instance { object: *of_object.ok_or_else(unknown)?, affine })
        };
        let placed: PyResult<Vec<_>> = objects.iter().enumerate().map(instance).collect();
        let (placed, count) = (placed?, objects.len());
        let tracer = py.detach(|| {
            let root = assembly.add_group(placed, &BuildOptions::default()).map_err(of_assembly)?;
            InstanceTracer::new(&assembly, root, Method::default()).map_err(failed)
        })?;
        Ok(Self { tracer, count })
    }

    fn __len__(&self) -> usize {
        self.count
    }

    /// Instances, and what a scene answers.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, HitArrays<'py, f32>)> {
        let rays = Rays::<WideBvh>::new(rays.each_ref())?;
        let (mut instances, mut found) = (room(rays.len())?, Found::with_room(rays.len())?);
        let answer = |rays: Vec<Ray>| in_parallel(&rays, |ray| self.tracer.closest(ray)).map_err(failed);
        in_pieces(
            py,
            rays.len(),
            progress.as_ref(),
            |rows| rays.chunk(rows),
            answer,
            |hits| {
                for hit in hits {
                    let hit = hit.map(|InstanceHit { path, prim, t, u, v }| (path, Hit { prim, t, u, v }));
                    let instance = hit.as_ref().and_then(|(path, _)| path.first());
                    instances.push(instance.map_or(-1, |&instance| i64::from(instance)));
                    found.push(hit.as_ref().map(|(_, hit)| hit));
                }
            },
        )?;
        Ok((instances.into_pyarray(py), found.into_arrays(py)?))
    }

    fn any<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let rays = Rays::<WideBvh>::new(rays.each_ref())?;
        let mut found = room(rays.len())?;
        let answer = |rays: Vec<Ray>| in_parallel(&rays, |ray| self.tracer.any(ray)).map_err(failed);
        in_pieces(py, rays.len(), progress.as_ref(), |rows| rays.chunk(rows), answer, |hits| found.extend(hits))?;
        Ok(found.into_pyarray(py))
    }
}

/// Answers each, on all threads.
fn in_parallel<A: Send>(rays: &[Ray], answer: impl Fn(&Ray) -> A + Sync) -> Answers<A> {
    let of_chunk = |rays: &[Ray]| -> Result<Vec<A>, EnvironmentError> {
        check_environment()?;
        Ok(rays.iter().map(&answer).collect())
    };
    let chunks: Result<Vec<_>, _> = rays.par_chunks(CHUNK).map(of_chunk).collect();
    Ok(chunks?.into_iter().flatten().collect())
}

fn of_affine(error: AffineError, i: usize) -> PyErr {
    refused(format!("transforms[{i}]: {error}"))
}

fn of_assembly(error: AssemblyError) -> PyErr {
    refused(match error {
        AssemblyError::OutOfRange { instance } => {
            format!("transforms[{instance}]: the image of the scene leaves the range of float32")
        }
        AssemblyError::Build(stackless_bvh::bvh::BuildError::Empty) => "objects: no rows, expected at least one".into(),
        other => other.to_string(),
    })
}

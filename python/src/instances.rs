//! Scenes with many placements, as a Python object.

use std::collections::HashMap;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder};
use stackless_bvh::geom::{AffineError, AffineMap, Mesh, Ray};
use stackless_bvh::trace::{Assembly, AssemblyError, Hit, Instance, InstanceHit, InstanceTracer, Object, RayQueries};
use stackless_bvh::traverse::Method;

use crate::arrays::{Rays, check_aligned};
use crate::batch::{in_background, in_pieces};
use crate::errors::{failed, refused};
use crate::memory::room;
use crate::queries::{Found, HitArrays};
use crate::scene::Scene;
use crate::space::{Single, Space};
use crate::threads::{FEW, Threads};

/// Scenes in single precision and groups of scenes, placed by affine maps.
#[pyclass(frozen, module = "stackless_bvh._native")]
pub(crate) struct Instances {
    group: Arc<Group>,
    tracer: InstanceTracer,
}

/// The placements of a group, for adding the group to another group.
struct Group {
    parts: Vec<Part>,
    /// The index of a part, and its map.
    placed: Vec<(usize, AffineMap)>,
    /// Nesting depth of groups: 1 if all parts are meshes.
    levels: usize,
}

enum Part {
    Mesh(Arc<Single>),
    Group(Arc<Group>),
}

/// The source of a part.
enum Source {
    Mesh(Arc<Mesh>),
    Group(Arc<Group>),
}

#[pymethods]
impl Instances {
    /// `scenes[objects[i]]`, a scene or instances, is placed by the map `transforms[i]`, of shape (3, 4).
    #[new]
    fn new(
        py: Python<'_>,
        scenes: Vec<Bound<'_, PyAny>>,
        objects: PyReadonlyArray1<'_, i64>,
        transforms: PyReadonlyArray3<'_, f32>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        check_aligned(objects.as_any(), "objects")?;
        check_aligned(transforms.as_any(), "transforms")?;
        let sources = scenes.iter().enumerate().map(|(i, scene)| source(scene, i)).collect::<PyResult<Vec<_>>>()?;
        let (objects, transforms) = (objects.as_array(), transforms.as_array());
        if transforms.dim() != (objects.len(), 3, 4) {
            let (count, rows, columns) = transforms.dim();
            let expected = objects.len();
            return Err(refused(format!(
                "transforms: shape ({count}, {rows}, {columns}), expected ({expected}, 3, 4)"
            )));
        }
        let place = |(i, &object): (usize, &i64)| {
            let part = usize::try_from(object).ok().filter(|&part| part < sources.len());
            let unknown = || refused(format!("objects[{i}]: {object}, expected 0 to {}", sources.len() as i64 - 1));
            let rows = [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| transforms[[i, row, column]]));
            let affine = AffineMap::new(rows).map_err(|error| of_affine(error, i))?;
            Ok((part.ok_or_else(unknown)?, affine))
        };
        let placed = objects.iter().enumerate().map(place).collect::<PyResult<Vec<_>>>()?;
        let count = sources.iter().map(Source::faces).sum();
        in_background(py, count, progress.as_ref(), move |tell| {
            let parts = sources.into_iter().map(|source| source.into_part(tell)).collect::<PyResult<Vec<_>>>()?;
            let levels = 1 + parts.iter().map(Part::levels).max().unwrap_or(0);
            let group = Arc::new(Group { parts, placed, levels });
            let mut assembly = Assembly::new();
            let root = group.add_to(&mut assembly, &mut HashMap::new()).map_err(of_assembly)?;
            let tracer = InstanceTracer::new(&assembly, root, Method::default()).map_err(failed)?;
            Ok(Self { group, tracer })
        })
    }

    fn __len__(&self) -> usize {
        self.group.placed.len()
    }

    /// Rows of instances from the outermost group on, -1 for unused levels, and the answers of a scene.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray2<i64>>, HitArrays<'py, f32>)> {
        let (rays, levels) = (Rays::<Single>::new(rays.each_ref())?, self.group.levels);
        let (mut paths, mut found) = (room(rays.len().saturating_mul(levels))?, Found::with_room(rays.len())?);
        let answer = |rays: Vec<Ray>| self.tracer.closest_parallel(&rays).map_err(failed);
        let keep = |_: &Threads, hits: Vec<Option<InstanceHit>>| {
            for hit in hits {
                let end = paths.len() + levels;
                let hit = hit.map(|InstanceHit { path, prim, t, u, v }| {
                    paths.extend(path.into_iter().map(i64::from));
                    Hit { prim, t, u, v }
                });
                paths.resize(end, -1);
                found.push(hit.as_ref());
            }
            Ok(())
        };
        in_pieces(py, (rays.len(), FEW), progress.as_ref(), |threads, rows| rays.chunk(threads, rows), answer, keep)?;
        Ok((paths.into_pyarray(py).reshape([rays.len(), levels])?, found.into_arrays(py)?))
    }

    fn any<'py>(
        &self,
        py: Python<'py>,
        rays: [Bound<'py, PyAny>; 4],
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let rays = Rays::<Single>::new(rays.each_ref())?;
        let mut found = room(rays.len())?;
        let answer = |rays: Vec<Ray>| self.tracer.any_parallel(&rays).map_err(failed);
        let keep = |_: &Threads, hits: Vec<bool>| {
            found.extend(hits);
            Ok(())
        };
        in_pieces(py, (rays.len(), FEW), progress.as_ref(), |threads, rows| rays.chunk(threads, rows), answer, keep)?;
        Ok(found.into_pyarray(py))
    }
}

impl Source {
    /// Number of faces in hierarchies that are still to be built.
    fn faces(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.triangles().len(),
            Self::Group(_) => 0,
        }
    }

    fn into_part(self, tell: &(dyn Fn(usize) + Sync)) -> PyResult<Part> {
        match self {
            Self::Mesh(mesh) => Ok(Part::Mesh(Arc::new(<Single as Space>::build(&mesh, Builder::default(), tell)?))),
            Self::Group(group) => Ok(Part::Group(group)),
        }
    }
}

impl Part {
    fn levels(&self) -> usize {
        match self {
            Self::Mesh(_) => 0,
            Self::Group(group) => group.levels,
        }
    }
}

impl Group {
    /// Adds the group and its parts. A group in `known`, by its address, is added once.
    fn add_to(
        &self,
        assembly: &mut Assembly,
        known: &mut HashMap<*const Group, Object>,
    ) -> Result<Object, AssemblyError> {
        let mut objects = Vec::new();
        for part in &self.parts {
            objects.push(match part {
                Part::Mesh(bvh) => assembly.add_wide(Arc::clone(bvh)),
                Part::Group(group) => match known.get(&Arc::as_ptr(group)) {
                    Some(&object) => object,
                    None => group.add_to(assembly, known)?,
                },
            });
        }
        let placed = self.placed.iter().map(|&(part, affine)| Instance { object: objects[part], affine });
        let object = assembly.add_group(placed.collect(), &BuildOptions::default())?;
        known.insert(self, object);
        Ok(object)
    }
}

fn source(scene: &Bound<'_, PyAny>, i: usize) -> PyResult<Source> {
    if let Ok(instances) = scene.cast::<Instances>() {
        return Ok(Source::Group(Arc::clone(&instances.get().group)));
    }
    let scene: PyRef<'_, Scene> = scene.extract()?;
    let mesh = scene.single_mesh().ok_or_else(|| refused(format!("scenes[{i}]: float64, expected float32")))?;
    Ok(Source::Mesh(Arc::clone(mesh)))
}

fn of_affine(error: AffineError, i: usize) -> PyErr {
    match error {
        AffineError::Environment(_) => failed(error),
        _ => refused(format!("transforms[{i}]: {error}")),
    }
}

fn of_assembly(error: AssemblyError) -> PyErr {
    refused(match error {
        AssemblyError::OutOfRange { instance } => {
            format!("transforms[{instance}]: the image of the scene leaves the range of float32")
        }
        AssemblyError::TooManyLevels { instance, .. } => {
            format!("objects[{instance}]: groups in more than {} levels", Assembly::MAX_LEVELS - 1)
        }
        AssemblyError::Build(BuildError::Empty) => "objects: no rows, expected at least one".into(),
        other => other.to_string(),
    })
}

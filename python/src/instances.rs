//! Scenes with many placements, as a Python object.

use std::collections::HashMap;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use stackless_bvh::bvh::{BuildError, BuildOptions};
use stackless_bvh::geom::{AffineError, AffineMap, ExactRay, Mesh, Ray, Triangle};
use stackless_bvh::trace::{Assembly, AssemblyError, Hit, Instance, InstanceHit, InstanceTracer, Object, RayQueries};
use stackless_bvh::traverse::Method;

use crate::all_hits::{AllArrays, all, place};
use crate::arrays::{Rays, check_aligned};
use crate::batch::{in_background, in_pieces};
use crate::errors::{failed, refused};
use crate::held::Held;
use crate::memory::room;
use crate::queries::{Found, HitArrays, Progress, per_ray};
use crate::scene::{Either, Scene};
use crate::space::{Double, Single, Space};
use crate::threads::{FEW, Threads};

/// Scenes and groups of scenes, placed by affine maps.
#[pyclass(frozen, module = "stackless_bvh._native")]
pub(crate) struct Instances(Precision);

/// Instances of scenes in single or in double precision.
enum Precision {
    Single(Placed<Single>),
    Double(Placed<Double>),
}

/// A group, and its tracer.
struct Placed<S: Space> {
    group: Arc<Group<S>>,
    tracer: InstanceTracer<S::Vector>,
}

/// The placements of a group, for adding the group to another group.
struct Group<S: Space> {
    parts: Vec<Part<S>>,
    /// The index of a part, and its map.
    placed: Vec<(usize, AffineMap<S::Real>)>,
    /// Nesting depth of groups: 1 if all parts are meshes.
    levels: usize,
}

enum Part<S: Space> {
    Mesh(Arc<Mesh<S::Vector>>, Arc<S>),
    Group(Arc<Group<S>>),
}

/// A part in either precision.
enum AnyPart {
    Single(Part<Single>),
    Double(Part<Double>),
}

/// Rows of instances from the outermost group on, for each hit; -1 for unused levels.
type Paths<'py> = Bound<'py, PyArray2<i64>>;

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

impl<S: Space + 'static> Placed<S> {
    fn new(
        py: Python<'_>,
        parts: Vec<Part<S>>,
        (objects, transforms): (&PyReadonlyArray1<'_, i64>, &Bound<'_, PyAny>),
        progress: Progress<'_, '_>,
    ) -> PyResult<Self> {
        check_aligned(objects.as_any(), "objects")?;
        check_aligned(transforms, "transforms")?;
        let unfit = |_| refused(format!("transforms: expected an array of {} of shape (n, 3, 4)", S::DTYPE));
        let transforms: PyReadonlyArray3<'_, S::Real> = transforms.extract().map_err(unfit)?;
        let (objects, transforms) = (objects.as_array(), transforms.as_array());
        if transforms.dim() != (objects.len(), 3, 4) {
            let (count, rows, columns) = transforms.dim();
            let expected = objects.len();
            return Err(refused(format!(
                "transforms: shape ({count}, {rows}, {columns}), expected ({expected}, 3, 4)"
            )));
        }
        let place = |(i, &object): (usize, &i64)| {
            let part = usize::try_from(object).ok().filter(|&part| part < parts.len());
            let unknown = || refused(format!("objects[{i}]: {object}, expected 0 to {}", parts.len() as i64 - 1));
            let rows = [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| transforms[[i, row, column]]));
            let affine = AffineMap::new(rows).map_err(|error| of_affine(error, i))?;
            Ok((part.ok_or_else(unknown)?, affine))
        };
        let placed = objects.iter().enumerate().map(place).collect::<PyResult<Vec<_>>>()?;
        let levels = 1 + parts.iter().map(Part::levels).max().unwrap_or(0);
        let group = Arc::new(Group { parts, placed, levels });
        in_background(py, group.placed.len(), progress, move |tell| {
            let mut assembly = Assembly::new();
            let root = group.add_to(&mut assembly, &mut HashMap::new()).map_err(of_assembly::<S>)?;
            tell(group.placed.len());
            let tracer = InstanceTracer::new(&assembly, root, Method::default()).map_err(failed)?;
            Ok(Self { group, tracer })
        })
    }

    fn closest<'py>(
        &self,
        py: Python<'py>,
        rays: &Rays<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<(Paths<'py>, HitArrays<'py, S::Real>)> {
        let levels = self.group.levels;
        let (mut paths, mut found) = (room(rays.len().saturating_mul(levels))?, Found::with_room(rays.len())?);
        let answer = |rays: Vec<Ray<S::Vector>>| self.tracer.closest_parallel(&rays).map_err(failed);
        let keep = |_: &Threads, hits: Vec<Option<InstanceHit<S::Real>>>| {
            for hit in hits {
                match hit {
                    Some(hit) => found.push(Some(&self.append(hit, &mut paths))),
                    None => {
                        paths.resize(paths.len() + levels, -1);
                        found.push(None);
                    }
                }
            }
            Ok(())
        };
        in_pieces(py, (rays.len(), FEW), progress, |threads, rows| rays.chunk(threads, rows), answer, keep)?;
        Ok((paths.into_pyarray(py).reshape([rays.len(), levels])?, found.into_arrays(py)?))
    }

    fn any<'py>(
        &self,
        py: Python<'py>,
        rays: &Rays<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        per_ray(py, rays, progress, |rays| self.tracer.any_parallel(rays), |hit| hit)
    }

    fn crossings<'py>(
        &self,
        py: Python<'py>,
        rays: &Rays<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        per_ray(py, rays, progress, |rays| self.tracer.crossings_parallel(rays), i64::from)
    }

    fn all<'py>(
        &self,
        py: Python<'py>,
        rays: &Rays<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<(Paths<'py>, AllArrays<'py, S::Real>)> {
        let describe = |ray: &Ray<S::Vector>, hit: InstanceHit<S::Real>, paths: &mut Vec<i64>| {
            let path = hit.path.clone();
            let hit = self.append(hit, paths);
            let place = place(&hit, || {
                let (triangle, maps) = self.group.image(&path, hit.prim)?;
                Some(ExactRay::from(ray).meet(&triangle, &maps)?.place)
            });
            (hit, place)
        };
        let read = |threads: &Threads, rows| rays.chunk(threads, rows);
        let (arrays, paths) = all(py, (rays.len(), read), progress, |ray| self.tracer.all(ray), describe)?;
        let levels = self.group.levels;
        let count = paths.len() / levels;
        Ok((paths.into_pyarray(py).reshape([count, levels])?, arrays))
    }

    /// Appends the path of a hit, and returns the rest.
    fn append(&self, hit: InstanceHit<S::Real>, paths: &mut Vec<i64>) -> Hit<S::Real> {
        let InstanceHit { path, prim, t, u, v } = hit;
        let end = paths.len() + self.group.levels;
        paths.extend(path.into_iter().map(i64::from));
        paths.resize(end, -1);
        Hit { prim, t, u, v }
    }
}

impl<S: Space> Part<S> {
    fn levels(&self) -> usize {
        match self {
            Self::Mesh(..) => 0,
            Self::Group(group) => group.levels,
        }
    }
}

impl<S: Space> Group<S> {
    /// Adds the group and its parts. A group in `known`, by its address, is added once.
    fn add_to(
        &self,
        assembly: &mut Assembly<S::Vector>,
        known: &mut HashMap<*const Self, Object>,
    ) -> Result<Object, AssemblyError> {
        let mut objects = Vec::new();
        for part in &self.parts {
            objects.push(match part {
                Part::Mesh(_, bvh) => bvh.add_to(assembly),
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

    /// A triangle and the maps of the instances on its path, innermost first. `None` if there is none.
    fn image(&self, path: &[u32], prim: u32) -> Option<Image<S>> {
        let (&first, rest) = path.split_first()?;
        let &(part, affine) = self.placed.get(first as usize)?;
        let (triangle, mut maps) = match &self.parts[part] {
            Part::Mesh(mesh, _) => (Triangle(mesh.triangle(prim as usize)), Vec::new()),
            Part::Group(group) => group.image(rest, prim)?,
        };
        maps.push(affine);
        Some((triangle, maps))
    }
}

/// A triangle, and the maps that place it.
type Image<S> = (Triangle<<S as Space>::Vector>, Vec<AffineMap<<S as Space>::Real>>);

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

impl<S: Space> Part<S> {
    fn of(held: &Held<S>) -> Self {
        Self::Mesh(Arc::clone(&held.mesh), Arc::clone(&held.bvh))
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

fn of_affine(error: AffineError, i: usize) -> PyErr {
    match error {
        AffineError::Environment(_) => failed(error),
        _ => refused(format!("transforms[{i}]: {error}")),
    }
}

fn of_assembly<S: Space>(error: AssemblyError) -> PyErr {
    refused(match error {
        AssemblyError::OutOfRange { instance } => {
            format!("transforms[{instance}]: the image of the scene leaves the range of {}", S::DTYPE)
        }
        AssemblyError::TooManyLevels { instance, .. } => {
            format!("objects[{instance}]: groups in more than {} levels", Assembly::MAX_LEVELS - 1)
        }
        AssemblyError::Build(BuildError::Empty) => "objects: no rows, expected at least one".into(),
        other => other.to_string(),
    })
}

//! Scenes with many placements in one precision, and their queries.

use std::collections::HashMap;
use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;
use stackless_bvh::bvh::{BuildError, BuildOptions};
use stackless_bvh::geom::{AffineError, AffineMap, ExactRay, Mesh, Ray, Triangle, Vector};
use stackless_bvh::trace::{
    Assembly, AssemblyError, Hit, Instance, InstanceHit, InstanceNear, InstanceTracer, Object, RayQueries,
};
use stackless_bvh::traverse::Method;

use crate::all_hits::{AllArrays, all, place};
use crate::arrays::{Rays, check_aligned};
use crate::batch::{in_background, in_pieces};
use crate::errors::{failed, refused};
use crate::held::Held;
use crate::memory::room;
use crate::near::{Balls, FEW_BALLS};
use crate::queries::{Found, HitArrays, Progress, per_ray};
use crate::space::{Coordinate, Space};
use crate::threads::{FEW, Threads};

/// A group, and its tracer.
pub(crate) struct Placed<S: Space> {
    pub(crate) group: Arc<Group<S>>,
    tracer: InstanceTracer<S::Vector>,
}

/// The placements of a group, for adding the group to another group.
pub(crate) struct Group<S: Space> {
    parts: Vec<Part<S>>,
    /// The index of a part, and its map.
    pub(crate) placed: Vec<(usize, AffineMap<S::Real>)>,
    /// Nesting depth of groups: 1 if all parts are meshes.
    levels: usize,
}

pub(crate) enum Part<S: Space> {
    Mesh(Arc<Mesh<S::Vector>>, Arc<S>),
    Group(Arc<Group<S>>),
}

/// Rows of instances from the outermost group on, for each hit; -1 for unused levels.
pub(crate) type Paths<'py> = Bound<'py, PyArray2<i64>>;

/// Distances, triangles and points.
pub(crate) type Nearest<'py, R> = (Bound<'py, PyArray1<R>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray2<R>>);

impl<S: Space + 'static> Placed<S> {
    pub(crate) fn new(
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

    pub(crate) fn closest<'py>(
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
                let hit = hit.map(|hit| self.append(hit, &mut paths));
                if hit.is_none() {
                    self.append_path(&[], &mut paths);
                }
                found.push(hit.as_ref());
            }
            Ok(())
        };
        in_pieces(py, (rays.len(), FEW), progress, |threads, rows| rays.chunk(threads, rows), answer, keep)?;
        Ok((paths.into_pyarray(py).reshape([rays.len(), levels])?, found.into_arrays(py)?))
    }

    pub(crate) fn any<'py>(
        &self,
        py: Python<'py>,
        rays: &Rays<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        per_ray(py, rays, progress, |rays| self.tracer.any_each(rays), |hit| hit)
    }

    pub(crate) fn crossings<'py>(
        &self,
        py: Python<'py>,
        rays: &Rays<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        per_ray(py, rays, progress, |rays| rays.iter().map(|ray| self.tracer.crossings(ray)).collect(), i64::from)
    }

    pub(crate) fn all<'py>(
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

    pub(crate) fn nearest<'py>(
        &self,
        py: Python<'py>,
        balls: &Balls<'py, S>,
        progress: Progress<'_, 'py>,
    ) -> PyResult<(Paths<'py>, Nearest<'py, S::Real>)> {
        let (count, levels) = (balls.len(), self.group.levels);
        let (mut paths, mut point) = (room(count.saturating_mul(levels))?, room(count.saturating_mul(3))?);
        let (mut distance, mut primitive) = (room(count)?, room(count)?);
        let answer = |balls: Vec<_>| self.tracer.nearest_parallel(&balls).map_err(failed);
        let keep = |_: &Threads, nears: Vec<Option<InstanceNear<S::Vector>>>| {
            for near in nears {
                let path = near.as_ref().map_or(&[][..], |near| &near.path);
                self.append_path(path, &mut paths);
                distance.push(near.as_ref().map_or(<S::Real as Coordinate>::INFINITY, |near| near.distance));
                primitive.push(near.as_ref().map_or(-1, |near| i64::from(near.prim)));
                point.extend(near.map_or([S::Real::NAN; 3], |near| near.point.components()));
            }
            Ok(())
        };
        in_pieces(py, (count, FEW_BALLS), progress, |_, rows| balls.chunk(rows), answer, keep)?;
        let arrays = (distance.into_pyarray(py), primitive.into_pyarray(py), point.into_pyarray(py));
        Ok((paths.into_pyarray(py).reshape([count, levels])?, (arrays.0, arrays.1, arrays.2.reshape([count, 3])?)))
    }

    /// Appends the path of a hit, and returns the rest.
    fn append(&self, hit: InstanceHit<S::Real>, paths: &mut Vec<i64>) -> Hit<S::Real> {
        let InstanceHit { path, prim, t, u, v } = hit;
        self.append_path(&path, paths);
        Hit { prim, t, u, v }
    }

    fn append_path(&self, path: &[u32], paths: &mut Vec<i64>) {
        let end = paths.len() + self.group.levels;
        paths.extend(path.iter().copied().map(i64::from));
        paths.resize(end, -1);
    }
}

impl<S: Space> Part<S> {
    pub(crate) fn of(held: &Held<S>) -> Self {
        Self::Mesh(Arc::clone(&held.mesh), Arc::clone(&held.bvh))
    }

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

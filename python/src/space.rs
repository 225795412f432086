//! The differences between scenes in single and in double precision.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::DVec3;
use numpy::Element;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, WideBvh, WideError};
use stackless_bvh::geom::{Ball, EnvironmentError, Mesh, Precision, Ray, Vector};
use stackless_bvh::internals::bvh::Stored;
use stackless_bvh::trace::{
    Assembly, Boundary, Hit, Location, MeshQueries, Near, Object, RayQueries, Rule, Solid, Tracer, Winding,
};

use crate::errors::{failed, of_refit, refused};
use crate::memory;

/// A number type of arrays.
pub(crate) trait Coordinate: Element + Copy + Into<f64> + Zeroable {
    /// The distance of a miss.
    const INFINITY: Self;
    /// A weight or a coordinate without a value.
    const NAN: Self;
    /// Numbers within this distance of 0 and 1 may be rounded, and need the exact weights.
    const NEAR: Self;
}

impl Coordinate for f32 {
    const INFINITY: Self = f32::INFINITY;
    const NAN: Self = f32::NAN;
    const NEAR: Self = 4.0 * f32::EPSILON;
}

impl Coordinate for f64 {
    const INFINITY: Self = f64::INFINITY;
    const NAN: Self = f64::NAN;
    const NEAR: Self = 4.0 * f64::EPSILON;
}

/// Answers of many rays, or the error of a thread.
pub(crate) type Answers<A> = Result<Vec<A>, EnvironmentError>;

/// A hierarchy over meshes of one precision.
pub(crate) trait Space: Sized + Clone + Send + Sync {
    /// A position or direction.
    type Vector: Vector<Real = Self::Real>;
    /// Its number type.
    type Real: Coordinate + stackless_bvh::geom::Real;
    /// The name of the array type.
    const DTYPE: &'static str;

    /// `tell` receives the number of faces placed since its last call.
    fn build(mesh: &Mesh<Self::Vector>, builder: Builder, tell: &(dyn Fn(usize) + Sync)) -> PyResult<Self>;
    fn refit(&mut self, mesh: &Mesh<Self::Vector>) -> PyResult<()>;
    fn optimize(&mut self) -> PyResult<()>;
    /// Adds the mesh to an assembly, which shares the hierarchy.
    fn add_to(self: &Arc<Self>, assembly: &mut Assembly<Self::Vector>) -> Object;
    /// Memory in bytes.
    fn bytes(&self) -> usize;

    // Of the calling thread, whose arithmetic is checked.
    fn closest(&self, rays: &[Ray<Self::Vector>]) -> Vec<Option<Hit<Self::Real>>>;
    fn any(&self, rays: &[Ray<Self::Vector>]) -> Vec<bool>;
    fn all(&self, ray: &Ray<Self::Vector>) -> Vec<Hit<Self::Real>>;
    fn crossings(&self, rays: &[Ray<Self::Vector>]) -> Vec<u32>;
    /// Whether points are inside, outside or on the mesh. Each point has its row.
    fn locate(
        &self,
        mesh: &Mesh<Self::Vector>,
        boundary: &Boundary,
        rule: Rule,
        points: &[Self::Vector],
    ) -> PyResult<Vec<Location>>;
    /// Distances of points, negative inside.
    fn signed_distances(
        &self,
        mesh: &Mesh<Self::Vector>,
        boundary: &Boundary,
        rule: Rule,
        points: &[Self::Vector],
    ) -> PyResult<Vec<Self::Real>>;
    /// Winding numbers of points.
    fn windings(
        &self,
        mesh: &Mesh<Self::Vector>,
        boundary: &Boundary,
        tolerance: f64,
        points: &[Self::Vector],
    ) -> PyResult<Vec<f64>>;
    fn nearest(&self, balls: &[Ball<Self::Vector>]) -> Answers<Option<Near<Self::Vector>>>;
    fn nearest_k(&self, ball: &Ball<Self::Vector>, k: usize) -> Vec<Near<Self::Vector>>;
}

/// A hierarchy over a mesh in single precision.
pub(crate) type Single = WideBvh;

/// A hierarchy over a mesh in double precision.
pub(crate) type Double = WideBvh<8, DVec3>;

impl<V: Precision + Stored> Space for WideBvh<8, V>
where
    V::Real: Coordinate,
{
    type Vector = V;
    type Real = V::Real;
    const DTYPE: &'static str = if V::REAL_BYTES == 4 { "float32" } else { "float64" };

    fn build(mesh: &Mesh<V>, builder: Builder, tell: &(dyn Fn(usize) + Sync)) -> PyResult<Self> {
        // More than the measured use per triangle (175 and 233 bytes), and with spatial splits (326 and 397).
        let bytes = mesh.triangles().len() * (160 + 16 * size_of::<V::Real>());
        let bytes = if builder == Builder::Spatial { bytes * 8 / 5 } else { bytes };
        memory::check_shared(bytes, rayon::current_num_threads())?;
        let options = BuildOptions { builder, ..BuildOptions::default() };
        options.build_wide_watched(mesh, tell).map_err(of_wide)
    }

    fn refit(&mut self, mesh: &Mesh<V>) -> PyResult<()> {
        self.refit(mesh).map_err(of_refit)
    }

    fn optimize(&mut self) -> PyResult<()> {
        self.optimize().map_err(of_wide)
    }

    fn add_to(self: &Arc<Self>, assembly: &mut Assembly<V>) -> Object {
        assembly.add_wide::<V>(Arc::clone(self))
    }

    fn bytes(&self) -> usize {
        self.bytes()
    }

    fn closest(&self, rays: &[Ray<V>]) -> Vec<Option<Hit<V::Real>>> {
        Tracer::new(self).closest_each(rays)
    }

    fn any(&self, rays: &[Ray<V>]) -> Vec<bool> {
        Tracer::new(self).any_each(rays)
    }

    fn all(&self, ray: &Ray<V>) -> Vec<Hit<V::Real>> {
        Tracer::new(self).all(ray)
    }

    fn crossings(&self, rays: &[Ray<V>]) -> Vec<u32> {
        Tracer::new(self).crossings_each(rays)
    }

    fn locate(&self, mesh: &Mesh<V>, boundary: &Boundary, rule: Rule, points: &[V]) -> PyResult<Vec<Location>> {
        let tracer = Tracer::new(self);
        let solid = Solid::new(&tracer, mesh, boundary, rule).map_err(refused)?;
        points.iter().map(|&point| solid.locate(point).map_err(failed)).collect()
    }

    fn signed_distances(
        &self,
        mesh: &Mesh<V>,
        boundary: &Boundary,
        rule: Rule,
        points: &[V],
    ) -> PyResult<Vec<V::Real>> {
        let tracer = Tracer::new(self);
        let solid = Solid::new(&tracer, mesh, boundary, rule).map_err(refused)?;
        points.iter().map(|&point| solid.signed_distance(point).map_err(failed)).collect()
    }

    fn windings(&self, mesh: &Mesh<V>, boundary: &Boundary, tolerance: f64, points: &[V]) -> PyResult<Vec<f64>> {
        let tracer = Tracer::new(self);
        let winding = Winding::new(&tracer, mesh, boundary).with_tolerance(tolerance);
        points.iter().map(|&point| winding.number(point).map_err(failed)).collect()
    }

    fn nearest(&self, balls: &[Ball<V>]) -> Answers<Option<Near<V>>> {
        Tracer::new(self).nearest_parallel(balls)
    }

    fn nearest_k(&self, ball: &Ball<V>, k: usize) -> Vec<Near<V>> {
        Tracer::new(self).nearest_k(ball, k)
    }
}

fn of_wide(error: WideError) -> PyErr {
    match error {
        WideError::Build(BuildError::Memory(_)) => PyMemoryError::new_err(error.to_string()),
        WideError::Build(error) if !matches!(error, BuildError::Environment(_)) => refused(error),
        error => failed(error),
    }
}

/// A builder by its name.
pub(crate) fn builder(build: &str) -> PyResult<Builder> {
    let names = Builder::ALL.map(Builder::name).join(", ");
    build.parse().map_err(|_| refused(format!("build: '{build}', expected one of {names}")))
}

//! What differs between scenes in single and in double precision.

use glam::{DVec3, Vec3};
use numpy::Element;
use pyo3::prelude::*;
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, WideBvh};
use stackless_bvh::geom::kernel::Exact64;
use stackless_bvh::geom::slabs::Wide;
use stackless_bvh::geom::{Ball, EnvironmentError, Mesh, Ray, Triangle, Vector};
use stackless_bvh::trace::{BinaryTracer, Hit, Near, Tracer};
use stackless_bvh::traverse::Method;

use crate::errors::{failed, of_refit, refused};

/// A coordinate that arrays hold.
pub(crate) trait Coordinate: Element + Copy + Into<f64> {
    /// The distance of a miss.
    const INFINITY: Self;
    /// A weight or a coordinate where there is none.
    const NAN: Self;
    const ZERO: Self;
    const ONE: Self;
    /// 1 and 0 apart from a number nearer than this may be rounded: the exact weights are to be asked.
    const NEAR: Self;
}

impl Coordinate for f32 {
    const INFINITY: Self = f32::INFINITY;
    const NAN: Self = f32::NAN;
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const NEAR: Self = 4.0 * f32::EPSILON;
}

impl Coordinate for f64 {
    const INFINITY: Self = f64::INFINITY;
    const NAN: Self = f64::NAN;
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const NEAR: Self = 4.0 * f64::EPSILON;
}

/// Answers of many rays, or what kept a thread from them.
pub(crate) type Answers<A> = Result<Vec<A>, EnvironmentError>;

/// A hierarchy over meshes of one precision.
pub(crate) trait Space: Sized + Send + Sync {
    /// A position or direction.
    type Vector: Vector<Real = Self::Real>;
    /// A number of it.
    type Real: Coordinate + stackless_bvh::geom::Real;
    /// The array type's name.
    const DTYPE: &'static str;

    /// `tell` hears how many faces have found their place since it was last called.
    fn build(mesh: &Mesh<Self::Vector>, how: (Builder, u32), tell: &(dyn Fn(usize) + Sync)) -> PyResult<Self>;
    fn refit(&mut self, mesh: &Mesh<Self::Vector>) -> PyResult<()>;
    /// Memory in bytes.
    fn bytes(&self) -> usize;
    fn to_bytes(&self) -> Vec<u8>;
    /// The hierarchy that bytes are, if it is one over this mesh.
    fn from_bytes(bytes: &[u8], mesh: &Mesh<Self::Vector>) -> PyResult<Self>;

    fn closest(&self, rays: &[Ray<Self::Vector>]) -> Answers<Option<Hit<Self::Real>>>;
    fn any(&self, rays: &[Ray<Self::Vector>]) -> Answers<bool>;
    fn all(&self, rays: &[Ray<Self::Vector>]) -> Answers<Vec<Hit<Self::Real>>>;
    fn crossings(&self, rays: &[Ray<Self::Vector>]) -> Answers<u32>;
    fn nearest(&self, balls: &[Ball<Self::Vector>]) -> Answers<Option<Near<Self::Vector>>>;
    fn nearest_k(&self, ball: &Ball<Self::Vector>, k: usize) -> Vec<Near<Self::Vector>>;
}

impl Space for WideBvh {
    type Vector = Vec3;
    type Real = f32;
    const DTYPE: &'static str = "float32";

    fn build(mesh: &Mesh, (builder, reinsertion): (Builder, u32), tell: &(dyn Fn(usize) + Sync)) -> PyResult<Self> {
        let options = BuildOptions { builder, reinsertion, ..BuildOptions::fine() };
        Self::of(&options.build_watched(mesh, tell).map_err(of_build)?).map_err(failed)
    }

    fn refit(&mut self, mesh: &Mesh) -> PyResult<()> {
        self.refit(mesh).map_err(of_refit)
    }

    fn bytes(&self) -> usize {
        self.bytes()
    }

    fn to_bytes(&self) -> Vec<u8> {
        self.to_bytes()
    }

    fn from_bytes(bytes: &[u8], mesh: &Mesh) -> PyResult<Self> {
        let bvh = Self::from_bytes(bytes).map_err(refused)?;
        bvh.validate(mesh).map_err(refused)?;
        Ok(bvh)
    }

    fn closest(&self, rays: &[Ray]) -> Answers<Option<Hit>> {
        Tracer::new(self).closest_parallel(rays)
    }

    fn any(&self, rays: &[Ray]) -> Answers<bool> {
        Tracer::new(self).any_parallel(rays)
    }

    fn all(&self, rays: &[Ray]) -> Answers<Vec<Hit>> {
        Tracer::new(self).all_parallel(rays)
    }

    fn crossings(&self, rays: &[Ray]) -> Answers<u32> {
        Tracer::new(self).crossings_parallel(rays)
    }

    fn nearest(&self, balls: &[Ball]) -> Answers<Option<Near>> {
        Tracer::new(self).nearest_parallel(balls)
    }

    fn nearest_k(&self, ball: &Ball, k: usize) -> Vec<Near> {
        Tracer::new(self).nearest_k(ball, k)
    }
}

/// A hierarchy over a mesh in double precision, which only binary ones are.
pub(crate) struct Double {
    tracer: BinaryTracer<Bvh<Triangle<DVec3>>, Exact64, Wide>,
}

impl Double {
    fn of(bvh: Bvh<Triangle<DVec3>>) -> PyResult<Self> {
        BinaryTracer::with_tests(bvh, Method::default()).map(|tracer| Self { tracer }).map_err(failed)
    }
}

impl Space for Double {
    type Vector = DVec3;
    type Real = f64;
    const DTYPE: &'static str = "float64";

    fn build(
        mesh: &Mesh<DVec3>,
        (builder, reinsertion): (Builder, u32),
        tell: &(dyn Fn(usize) + Sync),
    ) -> PyResult<Self> {
        let options = BuildOptions { builder, reinsertion, ..BuildOptions::default() };
        Self::of(options.build_watched(mesh, tell).map_err(of_build)?)
    }

    fn refit(&mut self, mesh: &Mesh<DVec3>) -> PyResult<()> {
        let mut bvh = self.tracer.bvh().clone();
        bvh.refit(mesh).map_err(of_refit)?;
        *self = Self::of(bvh)?;
        Ok(())
    }

    fn bytes(&self) -> usize {
        self.tracer.bvh().bytes()
    }

    fn to_bytes(&self) -> Vec<u8> {
        self.tracer.bvh().to_bytes()
    }

    fn from_bytes(bytes: &[u8], mesh: &Mesh<DVec3>) -> PyResult<Self> {
        let bvh = Bvh::from_bytes(bytes).map_err(refused)?;
        stackless_bvh::bvh::validate(&bvh, mesh).map_err(refused)?;
        Self::of(bvh)
    }

    fn closest(&self, rays: &[Ray<DVec3>]) -> Answers<Option<Hit<f64>>> {
        self.tracer.closest_parallel(rays)
    }

    fn any(&self, rays: &[Ray<DVec3>]) -> Answers<bool> {
        self.tracer.any_parallel(rays)
    }

    fn all(&self, rays: &[Ray<DVec3>]) -> Answers<Vec<Hit<f64>>> {
        self.tracer.all_parallel(rays)
    }

    fn crossings(&self, rays: &[Ray<DVec3>]) -> Answers<u32> {
        self.tracer.crossings_parallel(rays)
    }

    fn nearest(&self, balls: &[Ball<DVec3>]) -> Answers<Option<Near<DVec3>>> {
        self.tracer.nearest_parallel(balls)
    }

    fn nearest_k(&self, ball: &Ball<DVec3>, k: usize) -> Vec<Near<DVec3>> {
        self.tracer.nearest_k(ball, k)
    }
}

fn of_build(error: BuildError) -> PyErr {
    if let BuildError::Environment(_) = error { failed(error) } else { refused(error) }
}

//! A mesh in one precision, with its hierarchy and its boundary.

use std::sync::{Arc, OnceLock};

use pyo3::prelude::*;
use stackless_bvh::bvh::Builder;
use stackless_bvh::geom::Mesh;
use stackless_bvh::internals::bvh::Stored;
use stackless_bvh::trace::Boundary;

use crate::arrays::{mesh_of, vertices_of};
use crate::batch::in_background;
use crate::errors::refused;
use crate::memory::{self, room};
use crate::space::Space;
use crate::threads::Threads;

/// A mesh, its hierarchy, and its boundary. Copies share them until one copy changes.
#[derive(Clone)]
pub(crate) struct Held<S: Space> {
    pub(crate) mesh: Arc<Mesh<S::Vector>>,
    pub(crate) bvh: Arc<S>,
    boundary: OnceLock<Boundary>,
    /// How often the vertices were moved.
    pub(crate) refits: u64,
}

impl<S: Space<Vector: Stored> + 'static> Held<S> {
    pub(crate) fn new(mesh: Mesh<S::Vector>, bvh: S) -> Self {
        Self { mesh: Arc::new(mesh), bvh: Arc::new(bvh), boundary: OnceLock::new(), refits: 0 }
    }

    pub(crate) fn build(
        py: Python<'_>,
        mesh: Mesh<S::Vector>,
        builder: Builder,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let count = mesh.triangles().len();
        in_background(py, count, progress, move |tell| {
            let bvh = S::build(&mesh, builder, tell)?;
            Ok(Self::new(mesh, bvh))
        })
    }

    /// Runs in three steps. After an error or Ctrl-C the vertices are all old or all new.
    pub(crate) fn refit(
        &mut self,
        py: Python<'_>,
        vertices: &Bound<'_, PyAny>,
        optimize: bool,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (vertices, count) = (vertices_of::<S>(vertices)?, self.mesh.vertices().len());
        if vertices.len() != count {
            return Err(refused(format!("vertices: {} rows, expected {count} as the scene has", vertices.len())));
        }
        let (threads, steps) = (Threads::all(py)?, if optimize { 3 } else { 2 });
        let look = |done: usize| {
            py.check_signals()?;
            progress.map_or(Ok(()), |progress| progress.call1((done, steps)).map(drop))
        };
        let mut triangles = room(self.mesh.triangles().len())?;
        triangles.extend_from_slice(self.mesh.triangles());
        let mesh = py.detach(|| threads.run(|| mesh_of::<S>(vertices, triangles)))?;
        look(1)?;
        if Arc::get_mut(&mut self.bvh).is_none() {
            // A shared hierarchy is copied.
            memory::check(self.bvh.bytes())?;
        }
        py.detach(|| threads.run(|| Arc::make_mut(&mut self.bvh).refit(&mesh)))?;
        (self.mesh, self.boundary) = (Arc::new(mesh), OnceLock::new());
        self.refits += 1;
        look(2)?;
        if optimize {
            // An upper bound of the measured memory use.
            memory::check_shared(self.bvh.bytes() + 448 * self.mesh.triangles().len(), threads.count())?;
            py.detach(|| threads.run(|| Arc::make_mut(&mut self.bvh).optimize()))?;
            look(3)?;
        }
        Ok(())
    }

    /// Two threads may compute the boundary at the same time, with equal results. No thread waits for another thread: a
    /// forked child does not have the parent's threads.
    pub(crate) fn boundary(&self, py: Python<'_>) -> PyResult<&Boundary> {
        if let Some(boundary) = self.boundary.get() {
            return Ok(boundary);
        }
        let threads = Threads::all(py)?;
        // An upper bound of the measured memory use.
        memory::check(48 * self.mesh.vertices().len() + 448 * self.mesh.triangles().len())?;
        let boundary = py.detach(|| threads.run(|| Boundary::of(&self.mesh)));
        Ok(self.boundary.get_or_init(|| boundary))
    }
}

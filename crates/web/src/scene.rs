//! A scene with its two tracers.

use std::path::Path;

use stackless_bvh::bvh::{BuildError, BuildOptions, Bvh, WideBvh, WideError};
use stackless_bvh::generate::procedural::View;
use stackless_bvh::geom::{Mesh, MeshError, Ray};
use stackless_bvh::internals::geom::kernel::Moller32;
use stackless_bvh::internals::geom::slabs::Plain;
use stackless_bvh::internals::trace::Search;
use stackless_bvh::trace::{Hit, RayQueries, Tracer};
use stackless_bvh::traverse::{Stack, traverse};
use stackless_explain::{self as explain, ExplainError, USUAL};
use stackless_scene::{SceneError, read_named};

use crate::Example;

/// Pixels along an edge of the picture.
pub const SIDE: usize = 512;

/// Maximum size of a file: the memory of a browser must hold the mesh with its hierarchies.
pub const MOST_BYTES: usize = 64 << 20;

/// A mesh with its hierarchies and camera.
#[derive(Debug)]
pub struct Scene {
    name: String,
    note: Option<String>,
    mesh: Mesh,
    view: View,
    bvh: Bvh,
    exact: Tracer,
}

/// Reasons why a scene or an explanation of a pixel is not shown, in one line.
#[derive(Debug, thiserror::Error)]
pub enum SceneFault {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] SceneError),
    /// The file is too large for a browser.
    #[error("{name}: {bytes} bytes, and this page takes at most {MOST_BYTES}")]
    Size {
        /// The file.
        name: String,
        /// Its size.
        bytes: usize,
    },
    /// An example is not a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// No example has this name.
    #[error("{0}: there is no such example")]
    NoExample(String),
    /// The scene cannot be traced.
    #[error("{name}: {error}")]
    Build {
        /// The scene.
        name: String,
        /// The reason.
        error: BuildError,
    },
    /// The scene is too large for the fast hierarchy.
    #[error("{name}: {error}")]
    Wide {
        /// The scene.
        name: String,
        /// The reason.
        error: WideError,
    },
    /// The camera has no ray for this pixel.
    #[error("the camera is too far away for a ray")]
    NoRay,
    /// The traversal cannot be shown.
    #[error(transparent)]
    Explain(#[from] ExplainError),
}

impl Scene {
    /// Reads the scene in the bytes of a file.
    ///
    /// # Errors
    /// [`SceneFault`].
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, SceneFault> {
        if bytes.len() > MOST_BYTES {
            return Err(SceneFault::Size { name: name.to_owned(), bytes: bytes.len() });
        }
        let path = Path::new(name);
        let loaded = read_named(path, bytes)?;
        let view = View::of(&loaded.mesh);
        let note = loaded.note(path);
        Self::new(name, note, loaded.mesh, view)
    }

    /// The example with this name.
    ///
    /// # Errors
    /// [`SceneFault`].
    pub fn example(name: &str) -> Result<Self, SceneFault> {
        let example = Example::ALL.iter().find(|example| example.name == name);
        let example = example.ok_or_else(|| SceneFault::NoExample(name.to_owned()))?;
        let (mesh, view) = (example.make)()?;
        Self::new(name, None, mesh, view)
    }

    fn new(name: &str, note: Option<String>, mesh: Mesh, view: View) -> Result<Self, SceneFault> {
        let named = || name.to_owned();
        let bvh = BuildOptions::default().build(&mesh).map_err(|error| SceneFault::Build { name: named(), error })?;
        let wide = WideBvh::of(&bvh).map_err(|error| SceneFault::Wide { name: named(), error })?;
        Ok(Self { name: named(), note, mesh, view, bvh, exact: Tracer::new(wide) })
    }

    /// The name of the file or of the example.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A note about the file, such as skipped parts.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The binary hierarchy.
    pub fn bvh(&self) -> &Bvh {
        &self.bvh
    }

    /// The ray through the middle of a pixel. `None` outside the picture, and if coordinates overflow.
    pub fn ray(&self, [x, y]: [usize; 2]) -> Option<Ray> {
        (x < SIDE && y < SIDE).then(|| self.view.ray_of(y * SIDE + x, SIDE * SIDE)).flatten()
    }

    /// The exact hit, and the hit of an ordinary tracer: Möller and Trumbore's test in single precision, boxes without
    /// a margin, a stack.
    pub fn hits(&self, ray: &Ray) -> [Option<Hit>; 2] {
        let mut inexact = Search::<Moller32, Plain, false>::new(&self.bvh, ray);
        traverse(Stack::new(&self.bvh, &mut Vec::new()), &mut inexact, &mut ());
        [self.exact.closest(ray), inexact.hit()]
    }

    /// The page with the traversals of the ray through a pixel, visit by visit.
    ///
    /// # Errors
    /// [`SceneFault`].
    pub fn explain(&self, pixel: [usize; 2]) -> Result<String, SceneFault> {
        let ray = self.ray(pixel).ok_or(SceneFault::NoRay)?;
        let title = format!("{}, pixel {},{}", self.name, pixel[0], pixel[1]);
        Ok(explain::page(&title, &explain::of_ray(&self.bvh, &ray), &USUAL)?.to_html()?)
    }
}

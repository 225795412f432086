//! A mesh with its hierarchy, without `unsafe`.

use std::fs;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use glam::{DVec3, Vec3};
use rayon::{ThreadPool, ThreadPoolBuilder};
use stackless_bvh::bvh::{BuildOptions, Builder, WideBvh};
use stackless_bvh::geom::{MAX_COUNT, Mesh, Precision};
use stackless_bvh::internals::bvh::Stored;
use stackless_bvh::trace::{Assembly, Boundary, InstanceTracer, Tracer};
use stackless_bvh::traverse::Method;
use stackless_scene::{scene_from_bytes, scene_to_bytes, write_atomically};

use crate::error::{Error, Fault};
use crate::memory::{Anywhere, In};
use crate::types::{Options, STACKLESS_QUALITY_HIGH, STACKLESS_QUALITY_SPATIAL, STACKLESS_QUALITY_STANDARD};

/// A mesh with its hierarchy. Any number of threads may query it at the same time.
#[derive(Debug)]
pub struct Scene<V: Precision> {
    mesh: Mesh<V>,
    bvh: Arc<WideBvh<8, V>>,
    /// A tracer of the hierarchy, kept because `Tracer::new` detects the instruction level each time.
    tracer: Tracer<Arc<WideBvh<8, V>>, V>,
    /// The bounds of the corners of faces: the least and the greatest coordinates.
    bounds: [[V::Real; 3]; 2],
    /// A mask for each face. If empty, all bits are set.
    masks: Arc<[u32]>,
    /// Computed by the first query that needs it.
    boundary: OnceLock<Boundary>,
    /// Computed by the first ray that starts at an exact point.
    exact: OnceLock<InstanceTracer<V>>,
    /// The scene's own threads; `None` for the threads of the process.
    pool: Option<ThreadPool>,
}

/// Queries need no lock.
const _: () = {
    const fn is_shared<T: Sync + Send>() {}
    is_shared::<Scene<Vec3>>();
    is_shared::<Scene<DVec3>>();
};

/// Vertices and faces in the format of C.
pub(crate) type Vertices<'a, V> = In<'a, Anywhere<[<V as stackless_bvh::geom::Vector>::Real; 3]>>;
pub(crate) type Faces<'a> = In<'a, Anywhere<[u32; 3]>>;

impl<V: Precision + Stored> Scene<V> {
    pub(crate) fn new(vertices: &Vertices<'_, V>, faces: &Faces<'_>, options: Options) -> Result<Self, Fault> {
        let builder = builder(options.quality)?;
        let pool = pool(options.threads)?;
        let faces = faces.to_vec()?;
        let mesh = Mesh::new(vectors::<V>(vertices)?, faces.into_iter().map(|Anywhere(face)| face).collect())?;
        let options = BuildOptions { builder, ..BuildOptions::default() };
        let bvh = shared(pool.as_ref(), || options.build_wide(&mesh))?;
        Ok(Self::of(mesh, bvh, pool))
    }

    fn of(mesh: Mesh<V>, bvh: WideBvh<8, V>, pool: Option<ThreadPool>) -> Self {
        let (bvh, bounds) = (Arc::new(bvh), bounds(&mesh));
        let tracer = Tracer::new(Arc::clone(&bvh));
        Self {
            mesh,
            bvh,
            tracer,
            bounds,
            masks: Arc::default(),
            boundary: OnceLock::new(),
            exact: OnceLock::new(),
            pool,
        }
    }

    /// Sets the masks of faces.
    pub(crate) fn set_masks(&mut self, masks: &In<'_, u32>) -> Result<(), Fault> {
        let (found, expected) = (masks.count(), self.mesh.triangles().len());
        if found != expected {
            return Err(Fault::argument(format!("face_count: {found}, expected {expected} as the scene has")));
        }
        self.masks = masks.to_vec()?.into();
        Ok(())
    }

    /// Moves the vertices.
    pub(crate) fn refit(&mut self, vertices: &Vertices<'_, V>) -> Result<(), Fault> {
        let (found, expected) = (vertices.count(), self.mesh.vertices().len());
        if found != expected {
            return Err(Fault::argument(format!("vertex_count: {found}, expected {expected} as the scene has")));
        }
        let mesh = Mesh::new(vectors::<V>(vertices)?, self.mesh.triangles().to_vec())?;
        let Self { bvh, tracer, pool, exact, .. } = self;
        // Releases the other references to the hierarchy, so that it is copied only if instances share it.
        (*tracer, *exact) = (Tracer::new(Arc::new(WideBvh::empty())), OnceLock::new());
        let refitted = shared(pool.as_ref(), || Arc::make_mut(bvh).refit(&mesh));
        *tracer = Tracer::new(Arc::clone(bvh));
        refitted?;
        (self.bounds, self.mesh, self.boundary) = (bounds(&mesh), mesh, OnceLock::new());
        Ok(())
    }

    pub(crate) fn to_bytes(&self) -> Result<Vec<u8>, Fault> {
        scene_to_bytes(&self.mesh, &self.bvh).map_err(|error| Fault::new(Error::OutOfMemory, error))
    }

    pub(crate) fn from_bytes(bytes: &[u8], threads: u32) -> Result<Self, Fault> {
        let pool = pool(threads)?;
        let (mesh, bvh) = shared(pool.as_ref(), || scene_from_bytes(bytes))?;
        Ok(Self::of(mesh, bvh, pool))
    }

    /// Writes a file atomically.
    pub(crate) fn save(&self, path: &Path) -> Result<(), Fault> {
        let bytes = self.to_bytes()?;
        write_atomically(path, |file| file.write_all(&bytes)).map_err(|error| of_file(error, path))
    }

    pub(crate) fn load(path: &Path, threads: u32) -> Result<Self, Fault> {
        let bytes = fs::read(path).map_err(|error| of_file(error, path))?;
        let in_file = |fault: Fault| Fault { message: format!("{}: {}", path.display(), fault.message), ..fault };
        Self::from_bytes(&bytes, threads).map_err(in_file)
    }
}

impl<V: Precision> Scene<V> {
    pub(crate) fn mesh(&self) -> &Mesh<V> {
        &self.mesh
    }

    pub(crate) fn tracer(&self) -> &Tracer<Arc<WideBvh<8, V>>, V> {
        &self.tracer
    }

    /// Two threads may compute it at the same time, with equal results. No thread waits.
    pub(crate) fn boundary(&self) -> &Boundary {
        if let Some(boundary) = self.boundary.get() {
            return boundary;
        }
        let boundary = self.share(|| Boundary::of(&self.mesh));
        self.boundary.get_or_init(|| boundary)
    }

    /// Runs work whose parallel parts use the threads of this scene.
    pub(crate) fn share<A: Send>(&self, work: impl FnOnce() -> A + Send) -> A {
        shared(self.pool.as_ref(), work)
    }

    pub(crate) const fn bounds(&self) -> [[V::Real; 3]; 2] {
        self.bounds
    }

    pub(crate) const fn masks(&self) -> &Arc<[u32]> {
        &self.masks
    }

    pub(crate) const fn bvh(&self) -> &Arc<WideBvh<8, V>> {
        &self.bvh
    }

    pub(crate) const fn pool(&self) -> Option<&ThreadPool> {
        self.pool.as_ref()
    }

    /// A tracer of rays that start at exact points. It shares the hierarchy.
    pub(crate) fn exact_tracer(&self) -> Result<&InstanceTracer<V>, Fault> {
        if let Some(tracer) = self.exact.get() {
            return Ok(tracer);
        }
        let mut assembly = Assembly::new();
        let object = assembly.add_wide::<V>(Arc::clone(&self.bvh));
        let tracer = InstanceTracer::new(&assembly, object, Method::default());
        let tracer = tracer.map_err(|error| Fault::new(Error::Internal, error))?;
        Ok(self.exact.get_or_init(|| tracer))
    }
}

fn bounds<V: Precision>(mesh: &Mesh<V>) -> [[V::Real; 3]; 2] {
    let corners = mesh.triangles().iter().flatten().map(|&corner| mesh.vertices()[corner as usize]);
    let first = mesh.triangle(0)[0].components();
    corners.map(V::components).fold([first; 2], |[lower, upper], x| {
        let least = |a, b| if b < a { b } else { a };
        let most = |a, b| if b > a { b } else { a };
        [[0, 1, 2].map(|k| least(lower[k], x[k])), [0, 1, 2].map(|k| most(upper[k], x[k]))]
    })
}

/// Runs work whose parallel parts use these threads, or those of the process.
pub(crate) fn shared<A: Send>(pool: Option<&ThreadPool>, work: impl FnOnce() -> A + Send) -> A {
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// Refuses a count above the limit, before memory is allocated.
pub(crate) fn check_count(count: usize, name: &str) -> Result<(), Fault> {
    if count > MAX_COUNT {
        return Err(Fault::argument(format!("{name}: {count}, expected at most {MAX_COUNT}")));
    }
    Ok(())
}

fn vectors<V: Precision>(vertices: &Vertices<'_, V>) -> Result<Vec<V>, Fault> {
    let vertices = vertices.to_vec()?;
    Ok(vertices.into_iter().map(|Anywhere(vertex)| V::from_components(vertex)).collect())
}

pub(crate) fn builder(quality: u32) -> Result<Builder, Fault> {
    Ok(match quality {
        STACKLESS_QUALITY_STANDARD => Builder::Standard,
        STACKLESS_QUALITY_HIGH => Builder::Best,
        STACKLESS_QUALITY_SPATIAL => Builder::Spatial,
        _ => return Err(Fault::argument(format!("quality: {quality}, expected a STACKLESS_QUALITY constant, 0 to 2"))),
    })
}

/// The maximum number of threads.
const MAX_THREADS: u32 = 1 << 12;

pub(crate) fn pool(threads: u32) -> Result<Option<ThreadPool>, Fault> {
    if threads == 0 {
        return Ok(None);
    }
    if threads > MAX_THREADS {
        return Err(Fault::argument(format!("threads: {threads}, expected at most {MAX_THREADS}")));
    }
    let made = ThreadPoolBuilder::new().num_threads(threads as usize).build();
    let lacking = |error| Fault::new(Error::OutOfMemory, format!("threads: {threads} cannot be started: {error}"));
    made.map(Some).map_err(lacking)
}

fn of_file(error: std::io::Error, path: &Path) -> Fault {
    Fault::new(Error::File, format!("{}: {error}", path.display()))
}

//! Other ray tracers behind one interface of plain numbers, so that they can be measured interleaved with
//! `stackless-bvh` on equal rays.
//!
//! Each peer is used as its documentation recommends for many rays; its file gives the details. All peers build with
//! one thread.

mod by_bvh;
mod by_obvhs;
mod by_parry;
mod embree;

/// Triangle and distance, in lengths of the ray's direction.
pub type Hit = (u32, f32);

/// A half-line `origin + t direction` with `tmin <= t <= tmax`; `tmax` may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the names are clear")]
pub struct Ray {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub tmin: f32,
    pub tmax: f32,
}

/// A mesh that is ready for tracing. Each query answers the rays that have an element in `hits`.
pub trait Tracer {
    /// The closest hit of each ray.
    fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]);

    /// Whether each ray hits anything.
    fn any(&self, rays: &[Ray], hits: &mut [bool]);
}

/// Another ray tracer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is documented where it is implemented")]
pub enum Peer {
    ObvhsBvh2,
    ObvhsCwbvh,
    Bvh,
    Parry3d,
    Embree,
    EmbreeRobust,
    EmbreeDouble,
}

/// Reasons why a peer does not trace a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PeerError {
    /// A corner is not a vertex.
    #[error("triangle {triangle} has a corner that is not a vertex")]
    Index {
        /// Index of the triangle.
        triangle: usize,
    },
    /// A library that is loaded at run time is missing or unsuitable.
    #[error("not installed: {0}")]
    NotInstalled(String),
    /// The peer refuses the mesh.
    #[error("{0}")]
    Refused(String),
}

impl Peer {
    /// All peers.
    pub const ALL: [Self; 7] = [
        Self::ObvhsBvh2,
        Self::ObvhsCwbvh,
        Self::Bvh,
        Self::Parry3d,
        Self::Embree,
        Self::EmbreeRobust,
        Self::EmbreeDouble,
    ];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ObvhsBvh2 => "obvhs-bvh2",
            Self::ObvhsCwbvh => "obvhs-cwbvh",
            Self::Bvh => "bvh",
            Self::Parry3d => "parry3d",
            Self::Embree => "embree",
            Self::EmbreeRobust => "embree-robust",
            Self::EmbreeDouble => "embree-double",
        }
    }

    /// Builds a tracer from triangles of three indices into `vertices`.
    ///
    /// # Errors
    /// [`PeerError`].
    ///
    /// ```
    /// use stackless_peers::{Peer, Ray};
    ///
    /// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let ray = Ray { origin: [0.25, 0.25, -2.0], direction: [0.0, 0.0, 1.0], tmin: 0.0, tmax: f32::INFINITY };
    /// let tracer = Peer::ObvhsBvh2.build(&corners, &[[0, 1, 2]])?;
    /// let mut hits = [None];
    /// tracer.closest(&[ray], &mut hits);
    /// assert_eq!(hits, [Some((0, 2.0))]);
    /// # Ok::<(), stackless_peers::PeerError>(())
    /// ```
    pub fn build(self, vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Box<dyn Tracer>, PeerError> {
        let corners = corners(vertices, triangles)?;
        Ok(match self {
            Self::ObvhsBvh2 => Box::new(by_obvhs::Binary::new(&corners)),
            Self::ObvhsCwbvh => Box::new(by_obvhs::Wide::new(&corners)),
            Self::Bvh => Box::new(by_bvh::Hierarchy::new(&corners)?),
            Self::Parry3d => Box::new(by_parry::Hierarchy::new(&corners)),
            Self::Embree => Box::new(embree::Scene::new(vertices, triangles, embree::Kind::Plain)?),
            Self::EmbreeRobust => Box::new(embree::Scene::new(vertices, triangles, embree::Kind::Robust)?),
            Self::EmbreeDouble => {
                let widen = |corners: [[f32; 3]; 3]| corners.map(|corner| corner.map(f64::from));
                Box::new(embree::DoubleScene::new(corners.into_iter().map(widen).collect())?)
            }
        })
    }
}

/// An Embree scene with moving vertices; its tree is refitted.
#[allow(missing_debug_implementations, reason = "no useful content")]
pub struct Moving(embree::Scene);

impl Moving {
    /// Builds the scene.
    ///
    /// # Errors
    /// [`PeerError`].
    pub fn new(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Self, PeerError> {
        corners(vertices, triangles)?;
        embree::Scene::new(vertices, triangles, embree::Kind::Moving).map(Self)
    }

    /// Moves the vertices. Their number must not change.
    ///
    /// # Errors
    /// [`PeerError::Refused`] for another number of vertices, or without memory.
    pub fn refit(&mut self, vertices: &[[f32; 3]]) -> Result<(), PeerError> {
        self.0.refit(vertices)
    }
}

impl Tracer for Moving {
    fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        self.0.closest(rays, hits);
    }

    fn any(&self, rays: &[Ray], hits: &mut [bool]) {
        self.0.any(rays, hits);
    }
}

fn corners(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Vec<[[f32; 3]; 3]>, PeerError> {
    let corners = triangles.iter().enumerate().map(|(triangle, &[a, b, c])| {
        let vertex = |i: u32| vertices.get(i as usize).copied().ok_or(PeerError::Index { triangle });
        Ok([vertex(a)?, vertex(b)?, vertex(c)?])
    });
    corners.collect()
}

/// Answers each ray.
#[inline]
fn each<H>(rays: &[Ray], hits: &mut [H], mut answer: impl FnMut(&Ray) -> H) {
    for (ray, hit) in rays.iter().zip(hits) {
        *hit = answer(ray);
    }
}

#[cfg(test)]
mod tests;

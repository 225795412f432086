//! An indexed triangle mesh, valid by construction.

use glam::{DVec3, Vec3};

use super::{EnvironmentError, Frame, Vector, check_environment};

/// Greatest number of vertices and of triangles: the range of [`Node`](crate::tree::Node).
pub const MAX_COUNT: usize = (1 << 31) - 1;

/// A triangle mesh: vertices with finite coordinates, and at least one triangle over them.
///
/// The position of a triangle in [`triangles`](Self::triangles) is its primitive index: the order of the file, where
/// the triangles of a polygon replace it. Degenerate triangles and unused vertices are kept, because they are input
/// data.
///
/// Coordinates are in single precision, or with [`DVec3`] in double precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh<V = Vec3> {
    vertices: Vec<V>,
    triangles: Vec<[u32; 3]>,
    frame: Frame,
}

/// Errors of [`Mesh::new`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// There is nothing to hit.
    #[error("no triangles, expected at least one")]
    Empty,
    /// More than [`MAX_COUNT`] vertices or triangles.
    #[error("{count} {what}, expected at most {MAX_COUNT}")]
    TooMany {
        /// `vertices` or `triangles`.
        what: &'static str,
        /// The number of them.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex}: position {position}, expected finite coordinates")]
    NonFinite {
        /// Index of the vertex.
        vertex: usize,
        /// Its position.
        position: DVec3,
    },
    /// A corner is not a vertex.
    #[error("triangle {triangle}: vertex index {index} is out of range, expected less than {vertices}")]
    Index {
        /// Index of the triangle.
        triangle: usize,
        /// The index of the corner.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// This thread's floating-point arithmetic is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl<V: Vector> Mesh<V> {
    /// Creates a mesh of these triangles, each three indices into `vertices`.
    ///
    /// # Errors
    /// [`MeshError`]; of several errors the first.
    pub fn new(vertices: Vec<V>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_environment()?;
        check_counts(vertices.len(), triangles.len())?;
        if let Some(vertex) = vertices.iter().position(|v| !v.is_finite()) {
            return Err(MeshError::NonFinite { vertex, position: vertices[vertex].widen() });
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices.len()) {
                return Err(MeshError::Index { triangle, index, vertices: vertices.len() });
            }
        }
        let frame = V::frame(triangles.iter().flatten().map(|&corner| vertices[corner as usize]));
        Ok(Self { vertices, triangles, frame })
    }

    /// Returns the positions, in the order of the file.
    #[inline]
    pub fn vertices(&self) -> &[V] {
        &self.vertices
    }

    /// Returns the corners of every triangle, as indices into [`vertices`](Self::vertices).
    #[inline]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the frame for the boxes of its hierarchies. In single precision it is [`Frame::IDENTITY`].
    #[inline]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns the corners of the triangle with this index.
    ///
    /// # Panics
    /// If there is no such triangle.
    #[inline]
    pub fn triangle(&self, index: usize) -> [V; 3] {
        let [a, b, c] = self.triangles[index];
        [self.vertices[a as usize], self.vertices[b as usize], self.vertices[c as usize]]
    }
}

fn check_counts(vertices: usize, triangles: usize) -> Result<(), MeshError> {
    for (what, count) in [("vertices", vertices), ("triangles", triangles)] {
        if count > MAX_COUNT {
            return Err(MeshError::TooMany { what, count });
        }
    }
    if triangles == 0 { Err(MeshError::Empty) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn refusal(vertices: &[Vec3], triangles: &[[u32; 3]]) -> String {
        Mesh::new(vertices.to_vec(), triangles.to_vec()).unwrap_err().to_string()
    }

    #[test]
    fn a_valid_mesh_keeps_degenerate_triangles_and_unused_vertices() {
        let mesh = Mesh::new(CORNERS.to_vec(), vec![[0, 1, 1], [1, 0, 1]]).unwrap();
        assert_eq!(mesh.vertices(), CORNERS);
        assert_eq!(mesh.triangles(), [[0, 1, 1], [1, 0, 1]]);
        assert_eq!(mesh.triangle(1), [Vec3::X, Vec3::ZERO, Vec3::X]);
    }

    #[test]
    fn the_first_offender_is_named() {
        assert_eq!(refusal(&CORNERS, &[]), "no triangles, expected at least one");
        assert_eq!(
            refusal(&CORNERS, &[[0, 1, 2], [0, 3, 4]]),
            "triangle 1: vertex index 3 is out of range, expected less than 3"
        );
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let vertices = [Vec3::ZERO, Vec3::new(0.0, bad, 0.0), Vec3::splat(bad)];
            assert_eq!(
                refusal(&vertices, &[[0, 1, 2]]),
                format!("vertex 1: position [0, {bad}, 0], expected finite coordinates")
            );
        }
    }

    #[test]
    fn counts_end_where_addresses_do() {
        assert_eq!(check_counts(MAX_COUNT, MAX_COUNT), Ok(()));
        let what = |v, t| check_counts(v, t).unwrap_err().to_string();
        assert_eq!(what(1 << 31, 1), "2147483648 vertices, expected at most 2147483647");
        assert_eq!(what(1, 1 << 31), "2147483648 triangles, expected at most 2147483647");
    }
}

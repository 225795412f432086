//! Construction of a mesh by a reader.

use stackless_bvh::geom::Mesh;

use super::error::{Fault, Place, ReadError};
use super::float::Position;
use super::note::{NoteKind, Notes};
use super::number::Number;
use super::{Loaded, Part, Rounding, polygon};

/// The vertices and faces read so far.
pub(crate) struct Draft<V: Position> {
    vertices: Vec<V>,
    triangles: Vec<[u32; 3]>,
    /// The face of each triangle.
    faces: Vec<u32>,
    /// Number of faces so far. Of the face being read: the number of corners, the first and the last one.
    face: u32,
    corners: u64,
    first: u32,
    last: u32,
    parts: Vec<Part>,
    not_finite: Vec<NotFinite>,
    pub(crate) notes: Notes,
    pub(crate) rounding: Rounding,
}

/// A coordinate that is not finite, of a vertex that faces may or may not use.
struct NotFinite {
    vertex: u32,
    axis: usize,
    value: f64,
    /// Its line or node.
    at: u64,
}

impl<V: Position> Draft<V> {
    pub(crate) fn new(vertices: usize, triangles: usize) -> Self {
        Self {
            vertices: Vec::with_capacity(vertices),
            triangles: Vec::with_capacity(triangles),
            faces: Vec::with_capacity(triangles),
            face: 0,
            corners: 0,
            first: 0,
            last: 0,
            parts: Vec::new(),
            not_finite: Vec::new(),
            notes: Notes::default(),
            rounding: Rounding::default(),
        }
    }

    /// Returns the number of vertices so far.
    pub(crate) fn vertices(&self) -> usize {
        self.vertices.len()
    }

    /// Returns the number of triangles so far.
    pub(crate) fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Returns the number of corners of the face being read.
    pub(crate) fn corners(&self) -> u64 {
        self.corners
    }

    /// Adds a coordinate of the next vertex. A coordinate that is not finite is an error only if a face uses the
    /// vertex.
    #[inline]
    pub(crate) fn coordinate(
        &mut self,
        axis: usize,
        number: Result<Number<V::Real>, Fault>,
        at: u64,
    ) -> Result<V::Real, Fault> {
        match number {
            Ok(number) => Ok(self.rounding.coordinate(number)),
            Err(Fault::NonFinite { value, .. }) => {
                let vertex = self.vertices.len() as u32;
                if self.not_finite.last().is_none_or(|last| last.vertex != vertex) {
                    self.not_finite.push(NotFinite { vertex, axis, value, at });
                }
                Ok(V::Real::default())
            }
            Err(fault) => Err(fault),
        }
    }

    /// Adds a vertex.
    #[inline]
    pub(crate) fn vertex(&mut self, position: [V::Real; 3]) {
        self.vertices.push(V::from_components(position));
    }

    /// Adds a corner to the face being read. From the third corner on, each adds a triangle of the fan.
    #[inline]
    pub(crate) fn corner(&mut self, corner: u32) {
        match self.corners {
            0 => self.first = corner,
            1 => {}
            _ => {
                self.triangles.push([self.first, self.last, corner]);
                self.faces.push(self.face);
            }
        }
        self.corners += 1;
        self.last = corner;
    }

    /// Ends the face being read. If it has fewer than three corners, notes its place.
    #[inline]
    pub(crate) fn end_face(&mut self, place: impl FnOnce() -> String) {
        if self.corners < 3 {
            self.notes.add(NoteKind::FewCorners, 1, place);
        }
        self.face += 1;
        self.corners = 0;
    }

    /// Adds a triangular face.
    #[inline]
    pub(crate) fn triangle(&mut self, corners: [u32; 3]) {
        self.triangles.push(corners);
        self.faces.push(self.face);
        self.face += 1;
    }

    /// Begins a part. The following triangles belong to it.
    pub(crate) fn part(&mut self, name: String) {
        let first = self.triangles.len() as u32;
        self.parts.pop_if(|part| part.first == first);
        self.parts.push(Part { name, first });
    }

    /// Builds the mesh. `place` converts the number of a vertex, and the line or node of its coordinate, to a place.
    pub(crate) fn finish(mut self, place: impl Fn(u32, u64) -> Place) -> Result<Loaded<V>, ReadError> {
        self.move_unused(place)?;
        if self.triangles.is_empty() {
            return Err(ReadError::Empty(self.notes.0));
        }
        self.parts.pop_if(|part| part.first as usize == self.triangles.len());
        let Self { vertices, mut triangles, faces, parts, mut notes, rounding, .. } = self;
        polygon::cut(&vertices, &mut triangles, &faces, &mut notes);
        Ok(Loaded { mesh: Mesh::new(vertices, triangles)?, faces, parts, notes: notes.0, rounding })
    }

    /// Replaces unused vertices that are not finite by a finite one. If a face uses one, that is an error.
    fn move_unused(&mut self, place: impl Fn(u32, u64) -> Place) -> Result<(), ReadError> {
        let Some(first) = self.not_finite.first() else { return Ok(()) };
        let at = place(first.vertex, first.at);
        self.notes.add(NoteKind::UnusedVertex, self.not_finite.len() as u64, || format!("in {at}"));
        let mut used = vec![false; self.vertices.len()];
        self.triangles.iter().flatten().for_each(|&corner| used[corner as usize] = true);
        if let Some(bad) = self.not_finite.iter().find(|bad| used[bad.vertex as usize]) {
            return Err(Fault::non_finite::<V::Real>(bad.axis, bad.value).at(place(bad.vertex, bad.at)));
        }
        if let Some(&[inside, ..]) = self.triangles.first() {
            self.not_finite.iter().for_each(|bad| self.vertices[bad.vertex as usize] = self.vertices[inside as usize]);
        }
        Ok(())
    }
}

/// Returns the corners of the triangle of a strip that begins at a corner. Every second triangle is reversed.
pub(crate) fn of_strip(first: usize) -> [usize; 3] {
    [first, first + 1 + first % 2, first + 2 - first % 2]
}

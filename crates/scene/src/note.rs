//! Notes: content of a file that a reader skips or changes.

use std::fmt;

/// Items of one kind that a reader skipped or changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The kind.
    pub kind: NoteKind,
    /// Number of items.
    pub count: u64,
    /// The place of the first one, such as `in line 3`.
    pub first: String,
}

/// Kinds of skipped or changed content.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoteKind {
    /// A statement that is not part of OBJ.
    UnknownStatement,
    /// An OBJ statement of points, lines, curves or surfaces, or of another file with them.
    OtherStatement,
    /// An element of a PLY file other than vertices, faces and strips.
    OtherElement,
    /// A glTF primitive of points or lines.
    OtherPrimitive,
    /// A face or strip with fewer than three corners.
    FewCorners,
    /// A polygon without a triangulation: it intersects itself, or has too many corners for the search.
    Crossing,
    /// A vertex that is not finite, and that no face uses. It is replaced by a used vertex.
    UnusedVertex,
    /// A byte after the last triangle of a binary STL file.
    TrailingByte,
    /// A skin of a glTF node. Its mesh keeps the transform of the node.
    Skin,
    /// A glTF primitive with morph targets. It keeps its base shape.
    Morph,
    /// An unknown glTF extension that the file does not require.
    Extension,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, count, first } = self;
        let (one, many, done) = match kind {
            NoteKind::UnknownStatement => {
                ("statement that OBJ does not have", "statements that OBJ does not have", "skipped")
            }
            NoteKind::OtherStatement => (
                "statement of points, lines, curves or surfaces",
                "statements of points, lines, curves or surfaces",
                "skipped",
            ),
            NoteKind::OtherElement => ("element of another kind", "elements of other kinds", "skipped"),
            NoteKind::OtherPrimitive => ("primitive of points or lines", "primitives of points or lines", "skipped"),
            NoteKind::FewCorners => ("face with fewer than 3 corners", "faces with fewer than 3 corners", "skipped"),
            NoteKind::Crossing => (
                "polygon that crosses itself or has too many corners",
                "polygons that cross themselves or have too many corners",
                "cut as a fan",
            ),
            NoteKind::UnusedVertex => (
                "vertex that no face uses and that is not finite",
                "vertices that no face uses and that are not finite",
                "moved into the mesh",
            ),
            NoteKind::TrailingByte => ("byte after the last triangle", "bytes after the last triangle", "skipped"),
            NoteKind::Skin => ("skin", "skins", "not applied"),
            NoteKind::Morph => ("set of morph targets", "sets of morph targets", "not applied"),
            NoteKind::Extension => ("unknown extension", "unknown extensions", "ignored"),
        };
        let (what, were) = if *count == 1 { (one, "was") } else { (many, "were") };
        write!(f, "{count} {what} {were} {done}, the first {first}")
    }
}

/// The notes of a reader, one per kind.
#[derive(Debug, Default)]
pub(crate) struct Notes(pub(crate) Vec<Note>);

impl Notes {
    /// Counts items of a kind. `first` gives their place.
    pub(crate) fn add(&mut self, kind: NoteKind, count: u64, first: impl FnOnce() -> String) {
        match self.0.iter_mut().find(|note| note.kind == kind) {
            Some(note) => note.count += count,
            None if count > 0 => self.0.push(Note { kind, count, first: first() }),
            None => {}
        }
    }
}

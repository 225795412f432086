//! Input of the subcommands: scenes, rays, names of traversals and words.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use glam::Vec3;
use serde::{Serialize, Serializer};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Mesh, Real as _, Triangle};
use stackless_bvh::internals::geom::lanes;
use stackless_bvh::internals::trace::Accuracy;
use stackless_bvh::traverse::Method;
use stackless_bvh::wide;
use stackless_scene::{Format, LoadedRows, Position, Row, RowFileError, SceneError, UnknownFormat};
use stackless_suite::Traversal;

use crate::output;
use crate::places::{self, Output};

/// A scene with its name.
pub(crate) struct Scene<V: Position = Vec3> {
    pub(crate) name: String,
    pub(crate) mesh: Mesh<V>,
    /// The face of the file from which each triangle is cut; empty for a generated scene.
    pub(crate) faces: Vec<u32>,
}

/// The reason why a scene cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub(crate) enum LoadError {
    /// The mesh file is invalid.
    #[error(transparent)]
    File(SceneError),
    /// The name is neither a mesh file nor a generated scene.
    #[error("{_0}, or the name of a generated scene: {}", MADE.join(", "))]
    Name(SceneError),
}

/// A record stores the name of a scene.
impl Serialize for Scene {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.name.serialize(serializer)
    }
}

/// Names of the generated scenes.
pub(crate) const MADE: [&str; 3] = ["strands", "stadium", "soup"];

impl<V: Position> Scene<V> {
    /// Reads a mesh file, or generates the scene of this name.
    pub(crate) fn load(path: &Path) -> Result<Self, LoadError> {
        let name = path.to_string_lossy();
        if let Some(mesh) = made(&name) {
            return Ok(Self { name: name.into_owned(), mesh, faces: Vec::new() });
        }
        let stem = path.file_stem().map_or_else(|| name.clone(), |stem| stem.to_string_lossy());
        let loaded = stackless_scene::load(path).map_err(|error| match error {
            error @ SceneError::Extension { .. } if path.extension().is_none() => LoadError::Name(error),
            error => LoadError::File(error),
        })?;
        if let Some(note) = loaded.note(path) {
            output::warn(&note);
        }
        Ok(Self { name: stem.into_owned(), mesh: loaded.mesh, faces: loaded.faces })
    }

    /// The number of a triangle in answers: its own number, or the number of its face in the file.
    pub(crate) fn number(&self, prim: u32, of_face: bool) -> u32 {
        let face = self.faces.get(prim as usize).filter(|_| of_face);
        face.copied().unwrap_or(prim)
    }

    /// Number of triangles without area.
    pub(crate) fn degenerate(&self) -> usize {
        let triangles = (0..self.mesh.triangles().len()).map(|i| Triangle(self.mesh.triangle(i)));
        triangles.filter(Triangle::is_degenerate).count()
    }

    /// Returns a note about triangles without area, if there are any.
    pub(crate) fn degenerate_note(&self) -> Option<String> {
        let of = output::count(self.mesh.triangles().len() as u64, "triangle");
        let say = |count, what| format!("{}: {count} of {of} {what}", self.name);
        match self.degenerate() {
            0 => None,
            1 => Some(say("1".to_owned(), "has no area: rays miss it")),
            count => Some(say(output::grouped(count as u64), "have no area: rays miss them")),
        }
    }
}

/// The format of a file by its extension, or `other` without an extension.
pub(crate) fn format(path: &Path, other: Format) -> Result<Format, UnknownFormat> {
    Ok(Format::of(path)?.unwrap_or(other))
}

/// The format of an output file. Refuses to write binary files to a terminal.
pub(crate) fn format_to_write(output: &Output, other: Format) -> Result<Format, Box<dyn Error>> {
    let format = format(output, other)?;
    if format == Format::Npy {
        places::refuse_terminal(output, format.name())?;
    }
    Ok(format)
}

/// Reads rays or points. Also returns the file name for messages. `-` is the standard input.
pub(crate) fn rows<R: Row>(path: &Path, format: Format) -> Result<(&Path, LoadedRows<R>), RowFileError> {
    if path.as_os_str() != "-" {
        return Ok((path, stackless_scene::read_rows(path, format)?));
    }
    let name = Path::new("standard input");
    Ok((name, stackless_scene::read_rows_from(std::io::stdin().lock(), name, format)?))
}

fn made<V: Position>(name: &str) -> Option<Mesh<V>> {
    let mesh = match name {
        "strands" => procedural::strands(1, 2000),
        "stadium" => procedural::stadium(1),
        "soup" => procedural::soup(1, 20_000),
        _ => return None,
    };
    let same = |vertex: &Vec3| V::from_components(vertex.as_dvec3().to_array().map(V::Real::rounded));
    Mesh::new(mesh.vertices().iter().map(same).collect(), mesh.triangles().to_vec()).ok()
}

/// Loads all scenes before any work starts, so that errors appear early.
pub(crate) fn scenes<V: Position>(paths: &[PathBuf]) -> Result<Vec<Scene<V>>, LoadError> {
    paths.iter().map(|path| Scene::load(path)).collect()
}

/// Reads a name from a list. Help, errors and completions list the names, and errors suggest similar names.
pub(crate) fn names<T: Copy + Send + Sync + 'static>(
    all: impl IntoIterator<Item = T>,
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    listed(all.into_iter().map(|value| (PossibleValue::new(name(value)), value)).collect())
}

/// Like [`names`], with a help text for each name.
pub(crate) fn listed<T: Copy + Send + Sync + 'static>(
    all: Vec<(PossibleValue, T)>,
) -> impl TypedValueParser<Value = T> {
    let values: Vec<_> = all.iter().map(|(value, _)| value.clone()).collect();
    PossibleValuesParser::new(values).try_map(move |name| {
        let found = all.iter().find(|(value, _)| value.get_name() == name);
        found.map(|&(_, value)| value).ok_or("no such name")
    })
}

/// Reads the name of a traversal of binary trees.
pub(crate) fn method() -> impl TypedValueParser<Value = Method> {
    listed(binary().collect())
}

/// Reads the name of a traversal of binary or of wide trees.
pub(crate) fn traversal() -> impl TypedValueParser<Value = Traversal> {
    let binary = binary().map(|(value, method)| (value, Traversal::Binary(method)));
    listed(binary.chain(wide().map(|(value, method)| (value, Traversal::Wide(method)))).collect())
}

fn binary() -> impl Iterator<Item = (PossibleValue, Method)> {
    Method::ALL.into_iter().map(|method| (PossibleValue::new(method.name()).help(method.help()), method))
}

fn wide() -> impl Iterator<Item = (PossibleValue, wide::Method)> {
    wide::Method::ALL.into_iter().map(|method| (PossibleValue::new(method.name()).help(method.help()), method))
}

/// Reads the name of an instruction level of this machine.
pub(crate) fn simd() -> impl TypedValueParser<Value = lanes::Level> {
    listed(lanes::levels().into_iter().map(|(name, level)| (PossibleValue::new(name), level)).collect())
}

/// Reads the name of a level of accuracy.
pub(crate) fn accuracy() -> impl TypedValueParser<Value = Accuracy> {
    names(Accuracy::ALL, Accuracy::name)
}

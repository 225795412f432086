//! What the subcommands take in: scenes, names of traversals and words.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Mesh, lanes};
use stackless_bvh::trace::Accuracy;
use stackless_bvh::traverse::{Method, WordName};
use stackless_bvh::wide;
use stackless_scene::SceneError;
use stackless_suite::{Level, Traversal};

use crate::output;

/// A scene with its name.
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) mesh: Mesh,
}

/// Names of the scenes that are made and not read.
pub(crate) const MADE: [&str; 3] = ["strands", "stadium", "soup"];

impl Scene {
    /// Reads a mesh file, or makes the scene of this name.
    pub(crate) fn load(path: &Path) -> Result<Self, SceneError> {
        let name = path.to_string_lossy();
        if let Some(mesh) = made(&name) {
            return Ok(Self { name: name.into_owned(), mesh });
        }
        let stem = path.file_stem().map_or_else(|| name.clone(), |stem| stem.to_string_lossy());
        let loaded = stackless_scene::load(path)?;
        if let Some(note) = loaded.note(path) {
            output::warn(&note);
        }
        Ok(Self { name: stem.into_owned(), mesh: loaded.mesh })
    }
}

fn made(name: &str) -> Option<Mesh> {
    match name {
        "strands" => Some(procedural::strands(1, 2000)),
        "stadium" => Some(procedural::stadium(1)),
        "soup" => Some(procedural::soup(1, 20_000)),
        _ => None,
    }
}

/// Loads all scenes before anything is done with one, so that a bad one is known at once.
pub(crate) fn scenes(paths: &[PathBuf]) -> Result<Vec<Scene>, SceneError> {
    paths.iter().map(|path| Scene::load(path)).collect()
}

/// Reads a traversal's name; the help says how each works, the error lists their names.
#[derive(Clone, Debug)]
pub(crate) struct MethodName;

impl TypedValueParser for MethodName {
    type Value = Method;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<Method, clap::Error> {
        (method as fn(&str) -> Result<Method, String>).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let value = |method: Method| PossibleValue::new(method.name()).help(method.help());
        Some(Box::new(Method::ALL.into_iter().map(value)))
    }
}

/// Reads a traversal's name; the error lists all of them.
pub(crate) fn method(name: &str) -> Result<Method, String> {
    name.parse().map_err(|_| format!("expected one of: {}", Method::ALL.map(Method::name).join(", ")))
}

/// Reads the name of a traversal of binary or of wide trees, and lists all of them.
#[derive(Clone)]
pub(crate) struct TraversalName;

impl TypedValueParser for TraversalName {
    type Value = Traversal;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<Traversal, clap::Error> {
        (traversal as fn(&str) -> Result<Traversal, String>).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let wide = |method: wide::Method| PossibleValue::new(method.name()).help(method.help());
        let binary = MethodName.possible_values().into_iter().flatten();
        Some(Box::new(binary.chain(wide::Method::ALL.into_iter().map(wide))))
    }
}

fn traversal(name: &str) -> Result<Traversal, String> {
    let binary = method(name).map(Traversal::Binary);
    binary.or_else(|error| {
        let wide = wide_method(name).map(Traversal::Wide);
        wide.map_err(|more| format!("{error}, {}", more.trim_start_matches("expected one of: ")))
    })
}

/// Reads the name of a traversal of wide trees; the error lists all of them.
pub(crate) fn wide_method(name: &str) -> Result<wide::Method, String> {
    name.parse().map_err(|_| format!("expected one of: {}", wide::Method::ALL.map(wide::Method::name).join(", ")))
}

/// Reads the name of a level of instructions; the error lists those that this machine has.
pub(crate) fn simd(name: &str) -> Result<lanes::Level, String> {
    let levels = lanes::levels();
    let found = levels.iter().find(|(known, _)| *known == name);
    let known = || levels.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", ");
    found.map(|(_, level)| *level).ok_or_else(|| format!("this machine has: {}", known()))
}

/// Reads the name of a level; the error lists all of them.
pub(crate) fn accuracy(name: &str) -> Result<Accuracy, String> {
    name.parse().map_err(|_| format!("expected one of: {}", Accuracy::ALL.map(Accuracy::name).join(", ")))
}

/// Reads a word's name; the error lists all of them.
pub(crate) fn word(name: &str) -> Result<WordName, String> {
    name.parse().map_err(|_| format!("expected one of: {}", WordName::ALL.map(WordName::name).join(", ")))
}

/// Reads the name of a level of the conformance suite; the error lists all of them.
pub(crate) fn level(name: &str) -> Result<Level, String> {
    name.parse().map_err(|_| format!("expected one of: {}", Level::ALL.map(Level::name).join(", ")))
}

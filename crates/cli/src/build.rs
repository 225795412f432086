//! `--build`: how a scene's hierarchy is built.

use std::ffi::OsStr;
use std::fmt;
use std::str::FromStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command};
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, Degenerate, WideBvh, WideError};
use stackless_bvh::geom::Triangle;
use stackless_bvh::geom::lanes::Precision;
use stackless_bvh::traverse::Method;
use stackless_scene::Position;

use crate::input::Scene;
use crate::output::bar;

/// A builder and how many rounds of reinsertion follow, as in `sbvh+2`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Build {
    builder: Builder,
    reinsertion: u32,
}

/// Rounds that nobody waits for.
const MAX_ROUNDS: u32 = 1000;

impl Build {
    /// What trees are like in the checks: the default, complete, and with triangles in parts that have been moved
    /// about.
    pub(crate) const CHECKED: [Self; 3] = [
        Self { builder: Builder::Sah, reinsertion: 0 },
        Self { builder: Builder::Median, reinsertion: 0 },
        Self { builder: Builder::Spatial, reinsertion: 2 },
    ];

    /// What was asked for; else the default, but for `complete`, which needs a complete tree.
    pub(crate) fn chosen(asked: Option<Self>, methods: &[Method]) -> Self {
        let usual = if methods.contains(&Method::Complete) { Builder::Median } else { Builder::default() };
        asked.unwrap_or(Self { builder: usual, reinsertion: 0 })
    }

    /// A wide hierarchy, with a progress bar.
    pub(crate) fn run_wide<V: Precision + Position>(self, scene: &Scene<V>) -> Result<WideBvh<8, V>, WideError> {
        WideBvh::of(&self.run_fine(scene)?)
    }

    /// The binary one that it is made of, with one triangle a leaf.
    pub(crate) fn run_fine<V: Position>(self, scene: &Scene<V>) -> Result<Bvh<Triangle<V>>, BuildError> {
        self.run_as(BuildOptions::fine(), scene)
    }

    /// Builds, with a progress bar.
    pub(crate) fn run<V: Position>(self, scene: &Scene<V>) -> Result<Bvh<Triangle<V>>, BuildError> {
        self.run_as(BuildOptions::default(), scene)
    }

    /// These options with this builder. The command asks rays alone, which miss degenerate triangles.
    pub(crate) fn of(self, options: BuildOptions) -> BuildOptions {
        let degenerate = Degenerate::LeftOut;
        BuildOptions { builder: self.builder, reinsertion: self.reinsertion, degenerate, ..options }
    }

    fn run_as<V: Position>(self, options: BuildOptions, scene: &Scene<V>) -> Result<Bvh<Triangle<V>>, BuildError> {
        let progress = bar(scene.mesh.triangles().len() as u64, &format!("{}, {self}", scene.name));
        let bvh = self.of(options).build_watched(&scene.mesh, &|placed| progress.inc(placed as u64));
        progress.finish_and_clear();
        bvh
    }
}

impl fmt::Display for Build {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reinsertion {
            0 => write!(f, "{}", self.builder),
            rounds => write!(f, "{}+{rounds}", self.builder),
        }
    }
}

impl FromStr for Build {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, rounds) = text.split_once('+').unwrap_or((text, "0"));
        let builder = name.parse().map_err(|_| {
            format!("expected one of: {}; and perhaps + and a number", Builder::ALL.map(Builder::name).join(", "))
        })?;
        match rounds.parse() {
            Ok(reinsertion @ 0..=MAX_ROUNDS) => Ok(Self { builder, reinsertion }),
            _ => Err(format!("expected up to {MAX_ROUNDS} rounds of reinsertion after the +")),
        }
    }
}

/// Reads such a name; completions offer the builders.
#[derive(Clone)]
pub(crate) struct BuildName;

impl TypedValueParser for BuildName {
    type Value = Build;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<Build, clap::Error> {
        (Build::from_str as fn(&str) -> _).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(Builder::ALL.into_iter().map(|builder| PossibleValue::new(builder.name()))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_written() {
        for name in ["sah", "sbvh+2", "lbvh+1000"] {
            assert_eq!(name.parse::<Build>().map(|build| build.to_string()), Ok(name.to_owned()));
        }
        assert_eq!("sah+0".parse(), Ok(Build::default()));
        for bad in ["", "bvh", "+1", "sah+", "sah+1001", "sah+-1", "sah+1+1"] {
            assert!(bad.parse::<Build>().is_err(), "{bad}");
        }
    }
}

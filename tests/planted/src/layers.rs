//! The layers of checks: test programs of the copy, each with its tests.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use serde::Deserialize;

/// Tests of one program.
pub(crate) struct Layer {
    pub(crate) name: &'static str,
    /// A description, for the table.
    pub(crate) about: &'static str,
    /// Name of the program's target.
    pub(crate) target: &'static str,
    tests: Tests,
    /// Excluded tests.
    without: &'static [&'static str],
}

/// A selection of tests of a program.
enum Tests {
    /// The tests of the edited file's module.
    OfModule,
    /// Tests whose names contain one of these texts; all tests if the list is empty.
    Named(&'static [&'static str]),
}

/// Tests of the battery, with random and exhaustive cases.
const BATTERY: &[&str] = &["random::", "exhaustive::"];

/// Bodies of the fuzz targets, over seeds and findings.
const FUZZ: &[&str] = &["regressions::seeds", "regressions::what_fuzzing"];

/// The target that builds fastest: the library with its unit tests.
pub(crate) const UNIT_TESTS: &str = "stackless_bvh";

/// All layers, in the order in which they run, the fastest first.
pub(crate) const LAYERS: [Layer; 7] = [
    Layer {
        name: "module",
        about: "unit tests of the edited module",
        target: UNIT_TESTS,
        tests: Tests::OfModule,
        without: &[],
    },
    Layer {
        name: "unit",
        about: "all unit tests of the library",
        target: UNIT_TESTS,
        tests: Tests::Named(&[]),
        without: &[],
    },
    Layer {
        name: "harness",
        about: "bodies of the proof harnesses",
        target: "harnesses",
        tests: Tests::Named(&[]),
        without: &["every_twin_is_refuted", "names_are_different"],
    },
    Layer {
        name: "suite",
        about: "the conformance suite asks this library",
        target: "suite",
        tests: Tests::Named(&["this_library_conforms"]),
        without: &[],
    },
    Layer {
        name: "battery",
        about: "the battery over random and all small cases",
        target: "library",
        tests: Tests::Named(BATTERY),
        without: &[],
    },
    Layer {
        name: "fuzz",
        about: "fuzz targets over their seeds and findings",
        target: "library",
        tests: Tests::Named(FUZZ),
        without: &[],
    },
    Layer {
        name: "library",
        about: "the other tests from outside",
        target: "library",
        tests: Tests::Named(&[]),
        without: &["random::", "exhaustive::", "regressions::"],
    },
];

/// The test programs of a copy.
pub(crate) struct Programs {
    programs: BTreeMap<String, Program>,
    /// Duration of the build, in seconds.
    pub(crate) seconds: f64,
}

struct Program {
    path: PathBuf,
    /// The folder of its package.
    folder: PathBuf,
    tests: Vec<String>,
}

/// Reasons why there are no programs.
#[derive(Debug, thiserror::Error)]
pub(crate) enum BuildError {
    #[error("cargo cannot be run: {0}")]
    Cargo(std::io::Error),
    #[error("the copy with all bugs does not compile: see the messages of cargo above")]
    Failed,
    #[error("cargo has built no test program {0}")]
    Missing(&'static str),
    #[error("{path}: --list failed: {what}")]
    List { path: PathBuf, what: String },
    #[error("layer {0} has no tests, expected at least one")]
    Empty(&'static str),
}

#[derive(Deserialize)]
struct Message {
    executable: Option<PathBuf>,
    manifest_path: Option<PathBuf>,
    target: Option<Target>,
}

#[derive(Deserialize)]
struct Target {
    name: String,
}

/// The run of a layer for one bug.
pub(crate) struct Job<'p> {
    pub(crate) program: &'p Path,
    pub(crate) folder: &'p Path,
    pub(crate) arguments: Vec<String>,
}

/// Compiles only the library of the copy.
pub(crate) fn compile(copy: &Path) -> Result<(), BuildError> {
    let status = cargo(copy).args(["check", "-p", "stackless-bvh", "--all-features"]).status();
    if status.map_err(BuildError::Cargo)?.success() { Ok(()) } else { Err(BuildError::Failed) }
}

fn cargo(copy: &Path) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(copy).env("CARGO_INCREMENTAL", "0").env("CARGO_PROFILE_DEV_DEBUG", "none");
    command
}

impl Programs {
    /// Builds test programs of the copy once: all programs, or only the unit tests.
    pub(crate) fn build(copy: &Path, only_unit_tests: bool) -> Result<Self, BuildError> {
        let began = Instant::now();
        let mut command = cargo(copy);
        command.args(["test", "--no-run", "--quiet", "--message-format=json-render-diagnostics", "--all-features"]);
        command.args(["-p", "stackless-bvh", "--lib"]);
        if !only_unit_tests {
            command.args(["-p", "tests", "-p", "stackless-suite", "-p", "proofs"]);
            command.args(["--test", "library", "--test", "suite", "--test", "harnesses"]);
        }
        let mut child = command.stdout(Stdio::piped()).spawn().map_err(BuildError::Cargo)?;
        let mut programs = BTreeMap::new();
        let lines = child.stdout.take().into_iter().flat_map(|output| BufReader::new(output).lines());
        for line in lines.map_while(Result::ok) {
            let Ok(Message { executable: Some(path), manifest_path: Some(manifest), target: Some(target) }) =
                serde_json::from_str(&line)
            else {
                continue;
            };
            let folder = manifest.parent().unwrap_or(copy).to_path_buf();
            programs.insert(target.name, Program { path, folder, tests: Vec::new() });
        }
        if !child.wait().map_err(BuildError::Cargo)?.success() {
            return Err(BuildError::Failed);
        }
        for program in programs.values_mut() {
            program.tests = list(&program.path, &program.folder)?;
        }
        let programs = Self { programs, seconds: began.elapsed().as_secs_f64() };
        for layer in LAYERS.iter().filter(|layer| !only_unit_tests || layer.target == UNIT_TESTS) {
            let program = programs.programs.get(layer.target).ok_or(BuildError::Missing(layer.target))?;
            if !program.tests.iter().any(|test| layer.has(test)) {
                return Err(BuildError::Empty(layer.name));
            }
        }
        Ok(programs)
    }

    /// One test of a layer.
    pub(crate) fn one(&self, layer: &Layer, test: &str) -> Option<Job<'_>> {
        let Program { path, folder, tests } = self.programs.get(layer.target)?;
        let arguments = vec![test.to_owned(), "--exact".to_owned()];
        tests.iter().any(|known| known == test).then_some(Job { program: path, folder, arguments })
    }

    /// The tests that a layer runs for a bug in this file; `None` if the file's module has no tests.
    pub(crate) fn job(&self, layer: &Layer, file: &str) -> Option<Job<'_>> {
        let Program { path, folder, tests } = self.programs.get(layer.target)?;
        let mut arguments = match layer.tests {
            Tests::OfModule => vec![module_with_tests(file, tests)?],
            Tests::Named(names) => names.iter().map(ToString::to_string).collect(),
        };
        for name in layer.without {
            arguments.extend(["--skip".into(), (*name).into()]);
        }
        arguments.push("--test-threads=2".into());
        Some(Job { program: path, folder, arguments })
    }
}

impl Layer {
    fn has(&self, test: &str) -> bool {
        let is_named = |names: &[&str]| names.iter().any(|name| test.contains(name));
        !is_named(self.without)
            && match self.tests {
                Tests::OfModule | Tests::Named([]) => true,
                Tests::Named(names) => is_named(names),
            }
    }
}

fn list(path: &Path, folder: &Path) -> Result<Vec<String>, BuildError> {
    let failed = |what: String| BuildError::List { path: path.to_path_buf(), what };
    let output = Command::new(path).arg("--list").current_dir(folder).output();
    let output = output.map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(output.status.to_string()));
    }
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok(text.lines().filter_map(|line| line.strip_suffix(": test")).map(ToOwned::to_owned).collect())
}

/// The module of a file, or the nearest parent with tests, as the prefix of test names. `None` at the root.
fn module_with_tests(file: &str, tests: &[String]) -> Option<String> {
    let path = file.strip_prefix("src/")?.strip_suffix(".rs")?;
    let mut module = path.trim_end_matches("/mod").replace('/', "::");
    loop {
        let prefix = format!("{module}::");
        if tests.iter().any(|test| test.starts_with(&prefix)) {
            return Some(prefix);
        }
        module.truncate(module.rfind("::")?);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_module_with_tests_is_chosen() {
        let tests = ["geom::kernel::exact::tests::a", "key::tests::b"].map(ToOwned::to_owned);
        let module = |file| module_with_tests(file, &tests);
        assert_eq!(module("src/geom/kernel/exact/sum.rs").as_deref(), Some("geom::kernel::exact::"));
        assert_eq!(module("src/key/mod.rs").as_deref(), Some("key::"));
        assert_eq!(module("src/oracle.rs"), None);
    }

    #[test]
    fn no_test_is_in_two_layers_of_a_program() {
        let of = |test: &str| LAYERS.iter().filter(|layer| layer.target == "library" && layer.has(test)).count();
        for test in ["random::a", "exhaustive::a", "regressions::seeds_of", "regressions::what_fuzzing_has", "wide::a"]
        {
            assert_eq!(of(test), 1, "{test}");
        }
    }
}

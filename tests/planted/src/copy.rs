//! A copy of the tree with all bugs compiled in.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::bug::Bug;
use crate::check::by_file;
use crate::edit::{EditError, Source};

/// Name of the environment variable that selects a bug.
pub(crate) const SWITCH: &str = "STACKLESS_PLANTED";

/// The module that reads [`SWITCH`]; the text `SWITCH` is replaced by its value. 0, or no number, selects no bug.
const MODULE: &str = r#"//! The number of the planted bug.

extern crate std;

/// Reads it from the environment, once.
#[inline]
pub fn bug() -> u32 {
    static BUG: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *BUG.get_or_init(|| std::env::var("SWITCH").ok().and_then(|text| text.parse().ok()).unwrap_or(0))
}
"#;

/// Reasons why the copy failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CopyError {
    #[error("{path}: {source}")]
    File { path: PathBuf, source: io::Error },
    #[error("{file}: {source}")]
    Edit { file: String, source: EditError },
    #[error("git ls-files failed: {0}")]
    Git(String),
}

/// Writes the copy. Unchanged files are not touched, so that little is compiled again.
pub(crate) fn write(root: &Path, to: &Path, bugs: &[Bug]) -> Result<(), CopyError> {
    let bugs = by_file(bugs);
    let files = listed(root)?;
    for file in &files {
        let (from, to) = (root.join(file), to.join(file));
        // Copies links as links, such as a link to a folder of the suite's files.
        if let Ok(target) = fs::read_link(&from) {
            link(&target, &to)?;
            continue;
        }
        // The file may be deleted without a commit.
        if !from.is_file() {
            continue;
        }
        let content = fs::read(&from).map_err(failed(&from))?;
        let content = match bugs.get(file.as_str()) {
            Some(bugs) => planted(file, &String::from_utf8_lossy(&content), bugs)?.into_bytes(),
            None if file == "src/lib.rs" => {
                [&content[..], b"\n/// Chooses a planted bug.\npub mod planted;\n"].concat()
            }
            None => content,
        };
        put(&to, &content)?;
        let mode = fs::metadata(&from).map_err(failed(&from))?.permissions();
        fs::set_permissions(&to, mode).map_err(failed(&to))?;
    }
    put(&to.join("src/planted.rs"), MODULE.replace("SWITCH", SWITCH).as_bytes())?;
    remove_others(to, &files)
}

fn planted(file: &str, text: &str, bugs: &[(usize, &Bug)]) -> Result<String, CopyError> {
    let failed = |source| CopyError::Edit { file: file.to_owned(), source };
    let source = Source::parse(text).map_err(failed)?;
    let edits: Result<Vec<_>, _> = bugs.iter().map(|&(number, bug)| source.edit(number, bug)).collect();
    Ok(source.with(&edits.map_err(failed)?))
}

fn listed(root: &Path) -> Result<Vec<String>, CopyError> {
    let mut command = Command::new("git");
    command.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]);
    let output = command.current_dir(root).output();
    let output = output.map_err(|error| CopyError::Git(error.to_string()))?;
    if !output.status.success() {
        return Err(CopyError::Git(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    let names = String::from_utf8_lossy(&output.stdout);
    Ok(names.split('\0').filter(|name| !name.is_empty()).map(ToOwned::to_owned).collect())
}

fn put(path: &Path, content: &[u8]) -> Result<(), CopyError> {
    if fs::read(path).is_ok_and(|old| old == content) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed(folder))?;
    }
    fs::write(path, content).map_err(failed(path))
}

fn link(target: &Path, path: &Path) -> Result<(), CopyError> {
    if fs::read_link(path).is_ok_and(|old| old == target) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed(folder))?;
    }
    // A previous copy may have a file there.
    if path.is_file() {
        fs::remove_file(path).map_err(failed(path))?;
    }
    std::os::unix::fs::symlink(target, path).map_err(failed(path))
}

/// Removes Rust files of previous copies: an old test could fail, or catch a bug. Also removes seeds that proptest
/// wrote when tests of a copy ran without this tool. This tool neither reads nor writes seeds.
fn remove_others(copy: &Path, files: &[String]) -> Result<(), CopyError> {
    for folder in ["src", "tests", "crates", "proofs", "proptest-regressions"] {
        let mut folders = vec![copy.join(folder)];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).map_err(failed(&folder))? {
                let path = entry.map_err(failed(&folder))?.path();
                let is_listed = || {
                    let name = path.strip_prefix(copy).unwrap_or(&path).to_string_lossy();
                    name == "src/planted.rs" || files.iter().any(|file| *file == name)
                };
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|ending| ending == "rs" || ending == "txt") && !is_listed() {
                    fs::remove_file(&path).map_err(failed(&path))?;
                }
            }
        }
    }
    Ok(())
}

fn failed(path: &Path) -> impl Fn(io::Error) -> CopyError + use<> {
    let path = path.to_path_buf();
    move |source| CopyError::File { path: path.clone(), source }
}

//! The files of the package, for tests that read them.

use std::fs;
use std::path::{Path, PathBuf};

pub(crate) fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The files below a folder with this extension, relative to the package, in order.
pub(crate) fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let (mut files, mut folders) = (Vec::new(), vec![root().join(folder)]);
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == ending) {
                files.push(path.strip_prefix(root()).unwrap().to_path_buf());
            }
        }
    }
    files.sort();
    files
}

pub(crate) fn read(file: &Path) -> String {
    fs::read_to_string(root().join(file)).unwrap()
}

/// The code of the library, of its crates and of the Python package, without the folders of tests.
pub(crate) fn sources() -> Vec<PathBuf> {
    let is_source = |file: &PathBuf| file.components().nth(2).is_some_and(|folder| folder.as_os_str() == "src");
    [files("src", "rs"), files("python/src", "rs"), files("python/stackless_bvh", "py")]
        .concat()
        .into_iter()
        .chain(files("crates", "rs").into_iter().filter(is_source))
        .collect()
}

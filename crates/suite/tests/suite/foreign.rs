//! Tests of reading modified suites: every listed case is run, or the file is rejected.

use std::io;

use stackless_suite::{Suite, SuiteError, VERSION};
use tempfile::TempDir;

/// Returns a few cases of two profiles.
fn some() -> Suite {
    let mut suite = super::SUITE.clone();
    suite.profiles.retain(|profile| ["key/u32", "key/u64"].contains(&profile.name().as_str()));
    suite.profiles.iter_mut().for_each(|profile| profile.cases.truncate(3));
    suite
}

/// Writes the suite to files, modifies them, and reads them.
fn reread(change: impl FnOnce(&mut Vec<(String, String)>)) -> Result<Suite, SuiteError> {
    let mut files = some().files();
    change(&mut files);
    Suite::read(|file| {
        let found = files.iter().find(|(path, _)| path == file);
        found.map(|(_, text)| text.clone()).ok_or_else(|| io::ErrorKind::NotFound.into())
    })
}

fn replaced(file: usize, from: &str, to: &str) -> Result<Suite, SuiteError> {
    reread(|files| {
        assert!(files[file].1.contains(from), "{from}");
        files[file].1 = files[file].1.replace(from, to);
    })
}

const FIRST: usize = 0;
const INDEX: usize = 2;

#[test]
fn files_are_read_as_they_are_written() {
    assert_eq!(reread(|_| ()).unwrap(), some());
    assert!(matches!(reread(|files| files.truncate(1)), Err(SuiteError::Read { path, .. }) if path == "index.json"));
}

/// No name leaves the folder or reaches a shell or a terminal unescaped.
#[test]
fn names_are_letters() {
    for name in ["../x", "..", "", "a/b", "U32", "u32\\u001b[2J", "u 32", "u\\\"32"] {
        let change = replaced(INDEX, "key/u32", &format!("key/{name}"));
        assert!(matches!(change, Err(SuiteError::Name { .. })), "{name}: {change:?}");
        let own = replaced(FIRST, "\"profile\":\"u32\"", &format!("\"profile\":\"{name}\""));
        assert!(matches!(own, Err(SuiteError::Index { .. })), "{name}: {own:?}");
    }
    let id = &some().profiles[0].cases[0].id;
    for name in ["key/u32/", "key/u64/x", "key/u32/it's", "key/u32/a\\u0007", "key/u32/../x", "x"] {
        assert!(matches!(replaced(FIRST, id, name), Err(SuiteError::Place { .. })), "{name}");
    }
    assert!(matches!(replaced(FIRST, id, &some().profiles[0].cases[1].id), Err(SuiteError::Twice { .. })));
}

/// The files must match the index, without duplicates.
#[test]
fn the_index_is_compared() {
    let with = |from: &str, to: &str| replaced(INDEX, from, to).unwrap_err();
    assert!(matches!(with("\"cases\":3", "\"cases\":4"), SuiteError::Index { cases: 3, .. }));
    assert!(matches!(with("key/u64", "key/u32"), SuiteError::ProfileTwice { .. }));
    assert!(matches!(with("vectors/key/u32", "vectors/key/u64"), SuiteError::Name { .. }));
    assert!(matches!(with(VERSION, "1.0.0"), SuiteError::Version { .. }));
    assert!(matches!(with("\"suite\"", "\"more\":1,\"suite\""), SuiteError::Json { .. }));
    // Another profile's content under this profile's name.
    let swapped = reread(|files| files[0].1 = files[1].1.clone());
    assert!(matches!(swapped, Err(SuiteError::Index { .. })), "{swapped:?}");
    let gone = reread(|files| drop(files.remove(0)));
    assert!(matches!(gone, Err(SuiteError::Read { path, .. }) if path == "vectors/key/u32.json"));
    let empty = reread(|files| files[INDEX].1 = format!("{{\"suite\":\"{VERSION}\",\"files\":[]}}"));
    assert!(matches!(empty, Err(SuiteError::Empty)));
}

/// Every file in a folder must be listed.
#[test]
fn a_folder_holds_what_its_index_names() {
    let folder = TempDir::new().unwrap();
    let write = |path: &str, text: &str| {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    for (path, text) in some().files() {
        // Byte order marks are ignored.
        write(&path, &format!("\u{feff}{text}"));
    }
    write("vectors/key/README.md", "");
    assert_eq!(Suite::load(folder.path()).unwrap(), some());
    for stray in ["vectors/key/u33.json", "vectors/more/u32.json", "vectors/u32.json"] {
        write(stray, "{}");
        let found = Suite::load(folder.path());
        assert!(matches!(&found, Err(SuiteError::Stray { path }) if path == stray), "{found:?}");
        std::fs::remove_file(folder.path().join(stray)).unwrap();
    }
    std::fs::remove_dir_all(folder.path().join("vectors/key")).unwrap();
    assert!(matches!(Suite::load(folder.path()), Err(SuiteError::Read { .. })));
}

//! The expectations and the judge use only the library's random choices. `[CONF-4]`

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Files of `src` with the library modules that they may use: random choices, and the macro for names of enumerations.
const ALLOWED: &[(&str, &[&str])] = &[
    ("ask.rs", &["generate"]),
    ("author", &["generate"]),
    ("bits.rs", &[]),
    ("case.rs", &["name"]),
    ("judge.rs", &[]),
    ("protocol.rs", &[]),
    ("text.rs", &[]),
];

/// All names through which the library's answers could be called.
const FORBIDDEN: &[&str] = &[
    "stackless_check",
    "own::",
    "walk::",
    "scripted::",
    "Library",
    "RaysError",
    "WalkError",
    ".case()",
    ".read()",
    ".tree::",
    ".search::",
];

fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// Returns the library modules that code uses, and all forbidden names.
fn used(code: &str) -> BTreeSet<String> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let module = |at: usize| {
        let rest = code[at..].strip_prefix("::").unwrap_or(&code[at..]);
        // For `stackless_bvh::{a, b}` this is `{`, which is in no list.
        rest[..rest.find(|c| !is_name(c)).unwrap_or(rest.len()).max(1)].to_owned()
    };
    let name = "stackless_bvh";
    let modules = code.match_indices(name).map(|(at, _)| module(at + name.len()));
    let forbidden = FORBIDDEN.iter().filter(|&&name| code.contains(name)).map(|&name| name.to_owned());
    modules.chain(forbidden).collect()
}

fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| !path.ends_with("tests.rs")).flat_map(|path| files(&path)).collect()
}

#[test]
fn author_and_judge_share_only_choices_with_the_library() {
    for (name, allowed) in ALLOWED {
        let of_all = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(name));
        let used: BTreeSet<_> =
            of_all.iter().flat_map(|file| used(&code(&std::fs::read_to_string(file).unwrap()))).collect();
        assert_eq!(used, allowed.iter().map(|&module| module.to_owned()).collect(), "{name}");
    }
}

#[test]
fn what_is_shared_is_seen_in_every_form() {
    let seen = |text: &str| used(&code(text)).into_iter().collect::<Vec<_>>();
    assert_eq!(seen("use stackless_bvh::hash::{KeySet, Options};"), ["hash"]);
    assert_eq!(seen("use stackless_bvh::{hash, trail};"), ["{"]);
    assert_eq!(seen("use stackless_bvh as library;"), [" "]);
    assert_eq!(seen("stackless_bvh::trail::backtrack_climbing(key, trail).0"), ["trail"]);
    assert_eq!(seen("let tree = walk.case()?.tree;\nuse crate::own::text::hex;"), [".case()", "own::"]);
    assert_eq!(seen("let tree = walk.tree::<4>();\nuse crate::scripted::ScriptedSearch;"), [".tree::", "scripted::"]);
    assert_eq!(seen("// stackless_bvh::hash\n#[cfg(test)]\nmod tests { use stackless_bvh::oracle; }"), [""; 0]);
}

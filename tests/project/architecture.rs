//! The order of the modules as in ARCHITECTURE.md: a row of [`ALLOWED`] imports only earlier rows. Also habits that a
//! script can check: short files, no `unsafe`, no deliberate panics.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::files::{files, read, root, sources};

/// The imports of each module of the library, all of them from earlier rows.
const ALLOWED: &[(&str, &[&str])] = &[
    ("key", &[]),
    ("name", &[]),
    ("trail", &["key"]),
    ("swap", &["key"]),
    ("tree", &["key"]),
    ("order", &["key", "tree"]),
    ("environment", &[]),
    ("threads", &["environment"]),
    ("hash", &["key", "threads", "tree"]),
    ("event", &["key", "order", "trail", "tree"]),
    ("oracle", &["event", "order", "tree"]),
    ("traverse", &["event", "hash", "key", "name", "order", "swap", "trail", "tree"]),
    ("wide", &["event", "hash", "key", "name", "order", "tree"]),
    // The core, in the rows above, needs no geometry.
    ("geom", &["environment"]),
    ("generate", &["geom", "hash", "name", "order", "tree", "wide"]),
    ("bvh", &["geom", "hash", "name", "order", "threads", "tree", "wide"]),
    ("trace", &["bvh", "event", "generate", "geom", "key", "name", "order", "threads", "traverse", "tree", "wide"]),
    ("internals", &["bvh", "event", "geom", "hash", "trace", "traverse", "wide"]),
];

/// The crates of this repository that each crate needs, all of them from earlier rows.
const CRATES: &[(&str, &[&str])] = &[
    (".", &[]),
    ("crates/scene", &["stackless-bvh"]),
    ("crates/check", &["stackless-bvh", "stackless-scene"]),
    ("crates/suite", &["stackless-bvh", "stackless-check", "stackless-scene"]),
    ("crates/explain", &["stackless-bvh", "stackless-check"]),
    (
        "crates/cli",
        &[
            "stackless-bvh",
            "stackless-check",
            "stackless-explain",
            "stackless-peers",
            "stackless-scene",
            "stackless-suite",
        ],
    ),
    ("crates/capi", &["stackless-bvh", "stackless-scene"]),
    ("crates/web", &["stackless-bvh", "stackless-explain", "stackless-scene"]),
];

/// Macros in the root of the crate, without imports.
const MACROS: [&str; 2] = ["named", "topology_of"];

/// Lines that may panic deliberately, by file and text, with reasons.
const PANICS: &[(&str, &str, &str)] = &[
    ("src/hash/modulo.rs", ".expect(\"a table has 1 to 2^31 cells\")", "evaluated by the compiler"),
    ("src/generate/procedural.rs", ".expect(\"coordinates are finite", "a generated scene is a mesh for every seed"),
    ("src/geom/lanes/mod.rs", "None => unreachable!(", "the target has the requested instructions"),
    ("src/geom/lanes/mod.rs", "(None, None) => unreachable!(", "the target has the requested instructions"),
    ("src/tree/linked.rs", "None => panic!(", "evaluated by the compiler"),
];

const LONGEST: usize = 400;

/// An import of another module of the library: the importing module, and the path after `crate::`.
type Import = (String, String);

fn is_test(file: &Path) -> bool {
    file.with_extension("").ends_with("tests") || file.parent().is_some_and(|folder| folder.ends_with("tests"))
}

/// The text without comments, and without the unit tests at its end.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The module of a file: `src/hash/fold.rs` is `hash::fold`, `src/hash/mod.rs` is `hash`; the crate's root has no name.
fn module(file: &Path) -> Vec<String> {
    let path = file.strip_prefix("src").unwrap().with_extension("");
    let names = path.iter().map(|name| name.to_string_lossy().into_owned());
    names.filter(|name| !matches!(name.as_str(), "mod" | "lib")).collect()
}

/// The paths of a use tree: `a::{b, c::d}` gives `a::b` and `a::c::d`. It ends at the end of the Rust syntax.
fn expand(tree: &str) -> Vec<String> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let path = &tree[..tree.find(|c| !is_path(c)).unwrap_or(tree.len())];
    let Some(inside) = tree[path.len()..].strip_prefix('{').filter(|_| path.is_empty() || path.ends_with("::")) else {
        return vec![path.trim_end_matches(':').to_owned()];
    };
    let (mut depth, mut start, mut paths) = (0, 0, Vec::new());
    for (at, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            ',' | '}' if depth == 0 => {
                let item = inside[start..at].trim();
                paths.extend(expand(item).into_iter().filter(|_| !item.is_empty()).map(|item| format!("{path}{item}")));
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    paths
}

/// The imports of other modules in a file: by `crate::`, or by the corresponding number of `super::`.
fn imports(module: &[String], code: &str) -> BTreeSet<Import> {
    let Some(own) = module.first() else { return BTreeSet::new() };
    let mut found = BTreeSet::new();
    let to_root = "super::".repeat(module.len());
    for start in ["crate::", &to_root] {
        let at = code.match_indices(start).map(|(at, _)| at);
        // Skips the tail of `stackless_bvh::` or of a longer chain of `super::`.
        let whole = at.filter(|&at| !code[..at].ends_with(|c: char| c.is_alphanumeric() || "_:".contains(c)));
        for path in whole.flat_map(|at| expand(&code[at + start.len()..])) {
            if path.split("::").next() != Some(own) {
                found.insert((own.clone(), path));
            }
        }
    }
    found
}

fn all_imports() -> BTreeSet<Import> {
    let library = files("src", "rs").into_iter().filter(|file| !is_test(file));
    let all = library.flat_map(|file| imports(&module(&file), &code(&read(&file))));
    all.filter(|(_, path)| !MACROS.contains(&path.as_str())).collect()
}

/// The imports that are not allowed.
fn forbidden(imports: &BTreeSet<Import>) -> Vec<&Import> {
    let is_allowed = |(from, path): &&Import| {
        let row = ALLOWED.iter().find(|(module, _)| module == from);
        let to = path.split("::").next().unwrap_or_default();
        row.is_some_and(|(_, allowed)| allowed.contains(&to))
    };
    imports.iter().filter(|import| !is_allowed(import)).collect()
}

#[test]
fn imports_point_to_earlier_modules() {
    let imports = all_imports();
    assert_eq!(forbidden(&imports), Vec::<&Import>::new());
}

#[test]
fn the_table_is_an_order_and_says_no_more_than_there_is() {
    let imports = all_imports();
    for (row, &(from, allowed)) in ALLOWED.iter().enumerate() {
        assert!(
            root().join(format!("src/{from}.rs")).exists() || root().join(format!("src/{from}")).is_dir(),
            "{from}"
        );
        for to in allowed {
            assert!(ALLOWED[..row].iter().any(|(earlier, _)| earlier == to), "{to} does not come before {from}");
            let is_used = |(module, path): &Import| module == from && path.split("::").next() == Some(to);
            assert!(imports.iter().any(is_used), "{from} no longer imports {to}");
        }
    }
}

#[test]
fn a_backward_import_is_seen_in_every_form() {
    let seen = |module: &[&str], text: &str| {
        let module: Vec<_> = module.iter().map(|&name| name.to_owned()).collect();
        let imports = imports(&module, &code(text));
        forbidden(&imports).into_iter().map(|(from, path)| format!("{from} {path}")).collect::<Vec<_>>()
    };
    assert_eq!(seen(&["key"], "use crate::tree::Node;"), ["key tree::Node"]);
    assert_eq!(seen(&["key", "word"], "use super::super::tree::Node;"), ["key tree::Node"]);
    assert_eq!(seen(&["key"], "use super::tree;"), ["key tree"]);
    assert_eq!(seen(&["tree", "links"], "fn f(side: &crate::order::Side) {}"), ["tree order::Side"]);
    assert_eq!(
        seen(&["tree"], "use crate::{hash::{KeyMap, Lookup}, key::{self, Grow},\n traverse};"),
        ["tree hash::KeyMap", "tree hash::Lookup", "tree traverse"]
    );
    assert_eq!(seen(&["nosuch"], "use crate::key;"), ["nosuch key"]);
    let fine = "use crate::key::Side;\nuse super::order;\nuse stackless_check::Case;\n\
                // use crate::check;\n/// [`x`](crate::bvh)\n#[cfg(test)]\nmod tests { use crate::check::Case; }";
    assert_eq!(seen(&["tree", "implicit"], fine), [""; 0]);
}

/// The crates of this repository under `[dependencies]`.
fn crates_needed(manifest: &str) -> Vec<String> {
    let section = manifest.split("\n[dependencies]\n").nth(1).unwrap_or_default().split("\n[").next();
    let lines = section.unwrap_or_default().lines().filter(|line| line.starts_with("stackless-"));
    lines.map(|line| line.split(['.', ' ', '=']).next().unwrap_or_default().to_owned()).collect()
}

#[test]
fn crates_need_those_of_the_table() {
    let mut folders: Vec<_> = files("crates", "toml").into_iter().filter(|file| file.ends_with("Cargo.toml")).collect();
    folders.push("Cargo.toml".into());
    assert_eq!(folders.len(), CRATES.len());
    for (row, &(folder, needed)) in CRATES.iter().enumerate() {
        assert_eq!(crates_needed(&read(&Path::new(folder).join("Cargo.toml"))), needed, "{folder}");
        let earlier: Vec<_> = CRATES[..row].iter().map(|(folder, _)| folder.replace("crates/", "stackless-")).collect();
        let is_earlier = |name: &&str| {
            *name == "stackless-bvh" || *name == "stackless-peers" || earlier.iter().any(|it| it == *name)
        };
        assert!(needed.iter().all(is_earlier), "{folder}");
    }
    assert_eq!(
        crates_needed("[a]\n[dependencies]\nglam = 1\nstackless-bvh.workspace = true\n[b]\nstackless-x = 1"),
        ["stackless-bvh"]
    );
}

/// The rows of a table after a heading: cells without backticks.
fn rows<'t>(text: &'t str, heading: &str) -> Vec<Vec<&'t str>> {
    let section = text.split(heading).nth(1).and_then(|rest| rest.split("\n## ").next()).unwrap_or_default();
    let cells = |line: &'t str| line.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`')).collect();
    section.lines().filter(|line| line.starts_with('|')).skip(2).map(cells).collect()
}

/// The table of a ray's path matches the code: each file has the function of its row, and names the function of the
/// next row.
#[test]
fn the_table_shows_the_path_of_a_ray() {
    let text = read(Path::new("ARCHITECTURE.md"));
    let rows = rows(&text, "## The path of a ray\n");
    let texts: Vec<_> = rows.iter().map(|row| code(&read(Path::new(row[1])))).collect();
    for (row, code) in rows.iter().zip(&texts) {
        assert!(code.contains(&format!("fn {}", row[0])), "{row:?}");
    }
    for (code, next) in texts.iter().zip(&rows[1..]) {
        assert!(code.contains(&format!("{}(", next[0])) || code.contains(&format!("{}::<", next[0])), "{next:?}");
    }
    let files: BTreeSet<_> = rows.iter().map(|row| row[1]).collect();
    assert!(rows.len() > 5 && files.len() <= 6, "{files:?}");
}

#[test]
fn files_are_short() {
    for file in sources() {
        let lines = read(&file).lines().count();
        assert!(lines <= LONGEST, "{}: {lines} lines", file.display());
    }
}

/// [CONF-4]
#[test]
fn the_reference_is_short() {
    let text = read(Path::new("src/oracle.rs"));
    let lines = code(&text).lines().filter(|line| !line.trim().is_empty()).count();
    assert!(lines <= 60, "{lines} lines");
}

#[test]
fn nothing_is_unsafe() {
    let is_root = |file: &&PathBuf| file.ends_with("src/lib.rs") || file.ends_with("main.rs");
    for file in sources().iter().filter(is_root) {
        // Modules that read pointers of C, and a macro that runs a function before `main`, have exceptions.
        let is_denied = file.starts_with("crates/capi") || file.ends_with("cli/src/lib.rs");
        let level = if is_denied { "deny" } else { "forbid" };
        assert!(read(file).contains(&format!("\n#![{level}(unsafe_code)]\n")), "{}", file.display());
    }
    for file in sources().iter().filter(|file| read(file).contains("allow(unsafe_code")) {
        assert!(file.starts_with("crates/capi"), "{}", file.display());
    }
    assert!(read(Path::new("Cargo.toml")).contains("\nunsafe_code = \"deny\"\n"));
}

/// Lines of code that panic deliberately. Impossible cases should be errors instead.
fn panics(code: &str) -> impl Iterator<Item = (usize, &str)> {
    const WORDS: [&str; 6] = [".unwrap()", ".expect(", "panic!(", "unreachable!(", "todo!(", "unimplemented!("];
    code.lines().enumerate().filter(|(_, line)| WORDS.iter().any(|word| line.contains(word)))
}

#[test]
fn nothing_panics_on_purpose() {
    assert_eq!(panics("a.unwrap();\nb.unwrap_or(1);\nc\n  .expect(\"c\")\npanic!()").count(), 3);
    assert_eq!(panics(&code("a(); // b.unwrap()\n#[cfg(test)]\nmod tests {\n    a.unwrap();\n}")).count(), 0);
    let (mut used, mut unknown) = (BTreeSet::new(), Vec::new());
    for file in sources().into_iter().filter(|file| !is_test(file)) {
        for (line, text) in panics(&code(&read(&file))) {
            let known = PANICS.iter().position(|(known, what, _)| file == Path::new(known) && text.contains(what));
            match known {
                Some(known) => drop(used.insert(known)),
                None => unknown.push(format!("{}:{}: {}", file.display(), line + 1, text.trim())),
            }
        }
    }
    assert_eq!(unknown, [""; 0]);
    assert_eq!(used.len(), PANICS.len(), "an exception is no longer needed");
}

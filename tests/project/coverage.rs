//! Every clause of the specification is covered as its kind requires, and every cited clause exists.
//!
//! `cargo test --test project coverage` writes the coverage of each clause to `target/tmp/coverage.txt`.

mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::files::{files, read, sources};
use stackless_suite::author;

/// The kind of a clause, which determines how it must be covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Definition,
    Rule,
    /// Each sentence is proved by machine.
    Theorem,
    /// Proved by machine, except for parts that the clause marks as proved by hand or tested.
    TheoremInPart,
    Argument,
}

/// The kind of a cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Cover {
    Source,
    Rocq,
    Smt,
    Harness,
    Test,
    /// Cases of the conformance suite.
    Suite,
}

impl Cover {
    fn is_proof(self) -> bool {
        matches!(self, Self::Rocq | Self::Smt | Self::Harness)
    }
}

impl Kind {
    const ALL: [(Self, &'static str); 5] = [
        (Self::Definition, "Definition"),
        (Self::Rule, "Rule"),
        (Self::Theorem, "Theorem"),
        (Self::TheoremInPart, "Theorem in part"),
        (Self::Argument, "Argument"),
    ];

    fn is_covered(self, covers: &BTreeSet<Cover>) -> bool {
        let has = |cover| covers.contains(&cover);
        match self {
            Self::Definition => has(Cover::Source),
            Self::Rule => has(Cover::Source) && (has(Cover::Test) || has(Cover::Harness)),
            Self::Theorem => covers.iter().any(|cover| cover.is_proof()),
            Self::TheoremInPart => Self::Theorem.is_covered(covers) && has(Cover::Test),
            Self::Argument => has(Cover::Test),
        }
    }
}

#[derive(Debug, PartialEq, Eq)]
struct Clause {
    id: String,
    kind: Option<Kind>,
    title: String,
    /// Number of sentences in its first paragraph, without parentheses: the statement. Reasons follow in later
    /// paragraphs.
    sentences: usize,
    /// Whether a part is marked as not proved by machine.
    by_hand: bool,
}

/// A cited clause, and the name of the citing item.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Citation {
    id: String,
    /// The sentences of the clause that a lemma states, counted from 1: `[KEY-7](1, 2)`.
    sentences: Vec<usize>,
    cover: Cover,
    by: String,
}

/// The clauses of a text. A clause begins with `**[ID] Title.** *Kind.*`, and ends at the next clause.
fn clauses(text: &str) -> Vec<Clause> {
    let text = format!("\n{text}");
    let heads = text.split("\n**[").skip(1).filter_map(|clause| clause.split_once("] "));
    let clause = |(id, rest): (&str, &str)| {
        let (title, rest) = rest.split_once(".**").unwrap_or((rest, ""));
        let found = Kind::ALL.iter().find_map(|(kind, name)| Some((*kind, rest.strip_prefix(&format!(" *{name}.*"))?)));
        let statement = found.and_then(|(_, text)| text.split("\n\n").next()).unwrap_or_default();
        let words: Vec<_> = rest.split_whitespace().collect();
        Clause {
            id: id.to_owned(),
            kind: found.map(|(kind, _)| kind),
            title: title.to_owned(),
            sentences: sentences(statement),
            by_hand: ["*By hand:*", "*Tested:*"].iter().any(|mark| words.join(" ").contains(mark)),
        }
    };
    heads.map(clause).collect()
}

/// Number of sentences of a text, without parentheses.
fn sentences(text: &str) -> usize {
    let mut depth = 0_u32;
    let outside: String = text
        .chars()
        .filter(|&c| {
            depth = depth.saturating_sub(u32::from(c == ')')) + u32::from(c == '(');
            depth == 0 && c != ')'
        })
        .collect();
    let words: Vec<_> = outside.split_whitespace().collect();
    1 + words.windows(2).filter(|pair| pair[0].ends_with('.') && pair[1].starts_with(char::is_uppercase)).count()
}

/// Ids in brackets, one or several: capitals, a hyphen, a number. Numbers of sentences may follow in parentheses.
fn cited(line: &str) -> impl Iterator<Item = (&str, Vec<usize>)> {
    let is_id = |id: &str| {
        id.split_once('-').is_some_and(|(name, number)| {
            !name.is_empty()
                && name.bytes().all(|byte| byte.is_ascii_uppercase())
                && !number.is_empty()
                && number.bytes().all(|byte| byte.is_ascii_digit())
        })
    };
    let inside = line.split('[').skip(1).filter_map(|rest| rest.split_once(']'));
    inside.filter(move |(list, _)| list.split(", ").all(is_id)).flat_map(|(list, behind)| {
        let numbers = behind.strip_prefix('(').and_then(|rest| rest.split_once(')')).map_or("", |(numbers, _)| numbers);
        let sentences: Vec<_> = numbers.split(", ").filter_map(|number| number.parse().ok()).collect();
        list.split(", ").map(move |id| (id, sentences.clone()))
    })
}

/// The citations of a file. Tests and proofs are named by the item of the citation, or by the file if the citation is
/// in its heading.
fn citations(file: &str, text: &str, cover: Cover) -> Vec<Citation> {
    let lines: Vec<_> = text.lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        for (id, sentences) in cited(line) {
            let item = match cover {
                Cover::Source => None,
                _ if line.starts_with("//!") => None,
                // The clauses of a lemma are next to its name.
                Cover::Smt => lines[..=at].iter().rev().find_map(|line| quoted(line)),
                Cover::Suite => None,
                // The clauses of a harness are before it, in a list.
                Cover::Harness => {
                    lines[at..].iter().find(|line| !line.trim_start().starts_with("//")).and_then(|line| word(line))
                }
                Cover::Rocq | Cover::Test => lines[at..].iter().find_map(|line| name_of_item(line)),
            };
            let by = item.map_or_else(|| file.to_owned(), |item| format!("{file}: {item}"));
            found.push(Citation { id: id.to_owned(), sentences, cover, by });
        }
    }
    found
}

/// The name that a line declares.
fn name_of_item(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let words = ["fn ", "struct ", "enum ", "Theorem ", "Lemma ", "Corollary ", "Example "];
    word(words.iter().find_map(|word| line.strip_prefix(word))?)
}

fn word(line: &str) -> Option<&str> {
    line.trim_start()
        .split(|c: char| !c.is_alphanumeric() && c != '_' && c != '\'')
        .next()
        .filter(|name| !name.is_empty())
}

/// The first string of a line, unless it is a list of clauses.
fn quoted(line: &str) -> Option<&str> {
    line.split('"').nth(1).filter(|text| !text.is_empty() && !text.starts_with('['))
}

/// Returns the faults, and the coverage as a text.
fn judge(clauses: &[Clause], citations: &[Citation]) -> (Vec<String>, String) {
    let (mut wrong, mut text) = (Vec::new(), String::new());
    let mut known = BTreeSet::new();
    for clause in clauses {
        let Clause { id, kind, title, .. } = clause;
        if !known.insert(id.as_str()) {
            wrong.push(format!("{id} occurs twice in the specification"));
        }
        let mine: BTreeSet<_> = citations.iter().filter(|citation| citation.id == *id).collect();
        let covers = mine.iter().map(|citation| citation.cover).collect();
        match kind {
            None => wrong.push(format!("{id} has no kind")),
            Some(kind) if !kind.is_covered(&covers) => {
                wrong.push(format!("{id}, of kind {kind:?}, is covered by {covers:?} alone"));
            }
            Some(kind) => {
                wrong.extend(overclaims(clause, *kind, &mine));
                writeln!(text, "{id} {title} ({kind:?})").unwrap();
                for Citation { cover, by, .. } in mine {
                    writeln!(text, "    {:7} {by}", format!("{cover:?}").to_lowercase()).unwrap();
                }
            }
        }
    }
    for Citation { id, by, .. } in citations {
        if !known.contains(id.as_str()) {
            wrong.push(format!("{by} cites {id}, which is not in the specification"));
        }
    }
    (wrong, text)
}

/// Claims of a clause about its proofs that its lemmas contradict.
fn overclaims(clause: &Clause, kind: Kind, mine: &BTreeSet<&Citation>) -> Vec<String> {
    let Clause { id, sentences, by_hand, .. } = clause;
    let lemmas: Vec<_> = mine.iter().filter(|citation| citation.cover.is_proof()).collect();
    let states = |number| lemmas.iter().any(|lemma| lemma.sentences.contains(&number));
    let mut wrong = Vec::new();
    match kind {
        Kind::Theorem if *by_hand => wrong.push(format!("{id} is a theorem, and has a part by hand")),
        // The lemmas of a clause with one sentence state that sentence.
        Kind::Theorem if *sentences > 1 => {
            let missing = (1..=*sentences).filter(|&number| !states(number));
            wrong.extend(missing.map(|number| format!("{id} is a theorem, and no lemma states its sentence {number}")));
        }
        Kind::TheoremInPart if !by_hand => {
            wrong.push(format!("{id} is a theorem in part, and says of no part that it is by hand"));
        }
        Kind::Argument if !lemmas.is_empty() => {
            wrong.push(format!("{id} is an argument, and {} states a part", lemmas[0].by));
        }
        _ => {}
    }
    let beyond = lemmas.iter().filter(|lemma| lemma.sentences.iter().any(|number| !(1..=*sentences).contains(number)));
    wrong.extend(beyond.map(|lemma| format!("{} states a sentence that {id} does not have", lemma.by)));
    wrong
}

fn all_clauses() -> Vec<Clause> {
    files("spec", "md").iter().flat_map(|file| clauses(&read(file))).collect()
}

fn all_citations() -> Vec<Citation> {
    let mut all = Vec::new();
    let mut of = |file: &Path, text: &str, cover| all.extend(citations(&file.display().to_string(), text, cover));
    for file in sources() {
        let text = read(&file);
        let (source, tests) = text.split_once("#[cfg(test)]\nmod tests {").unwrap_or((&text, ""));
        let is_test = file.file_stem().is_some_and(|stem| stem == "tests");
        of(&file, source, if is_test { Cover::Test } else { Cover::Source });
        of(&file, tests, Cover::Test);
    }
    for file in files("examples", "rs") {
        of(&file, &read(&file), Cover::Source);
    }
    let tests = files("crates", "rs")
        .into_iter()
        .filter(|file| file.components().nth(2) == Some(Component::Normal("tests".as_ref())));
    for file in files("tests", "rs")
        .into_iter()
        .chain(tests)
        .filter(|file| !file.ends_with("coverage.rs") && !file.ends_with("coverage/tests.rs"))
    {
        of(&file, &read(&file), Cover::Test);
    }
    for file in ["rs", "wgsl"].into_iter().flat_map(kernels) {
        let cover = if file.starts_with("gpu-check/tests") { Cover::Test } else { Cover::Source };
        of(&file, &read(&file), cover);
    }
    for file in files("spec/rocq", "v") {
        of(&file, &read(&file), Cover::Rocq);
    }
    for file in files("proofs/smt/src", "rs") {
        of(&file, &read(&file), Cover::Smt);
    }
    for file in files("proofs/src", "rs") {
        of(&file, &read(&file), Cover::Harness);
    }
    let mut cases = BTreeMap::<_, u32>::new();
    for (profile, case) in author::suite().cases() {
        for id in &case.clauses {
            *cases.entry((id.clone(), profile.name())).or_default() += 1;
        }
    }
    let cite = |((id, profile), count)| Citation {
        id,
        sentences: Vec::new(),
        cover: Cover::Suite,
        by: format!("{profile}: {count} cases"),
    };
    all.extend(cases.into_iter().map(cite));
    all
}

/// The texts of the GPU kernels, and of the programs that run and test them.
fn kernels(ending: &str) -> Vec<PathBuf> {
    ["src", "wgsl", "tests"].iter().flat_map(|folder| files(&format!("gpu-check/{folder}"), ending)).collect()
}

/// Clauses about implementations without a case in the suite, with reasons.
const NOT_ASKED: [(&[&str], &str); 9] = [
    (&["KEY-7"], "follows from KEY-2 to KEY-4"),
    (
        &["STACK-1", "IMPLICIT-1", "IMPLICIT-2", "IMPLICIT-3", "SPARSE-1", "SPARSE-2", "AFRA-1"],
        "a method; TRAVERSE-1 has the observable result",
    ),
    (&["HASHONLY-1", "LAINE-1", "GLASSNER-1"], "a method; TRAVERSE-1 has the observable result"),
    (&["STATE-1"], "memory is not observable"),
    (&["HASH-2", "HASH-8"], "a choice of this library: tables of any size and construction are right"),
    (&["PAUSE-6"], "a format of this library"),
    (&["HASH-10", "DISJOINT-5"], "about an interface, not about results"),
    (&["PAUSE-7"], "follows from PAUSE-4"),
    (&["CONF-1", "CONF-4"], "about the suite itself"),
];

/// [CONF-1]
#[test]
fn every_clause_that_can_be_asked_has_a_case() {
    let cited: BTreeSet<_> =
        all_citations().into_iter().filter(|it| it.cover == Cover::Suite).map(|it| it.id).collect();
    let texts = ["spec/traversal.md", "spec/hash.md", "spec/state.md", "spec/conformance.md"];
    let mut asked: Vec<_> = texts.iter().flat_map(|text| clauses(&read(Path::new(text)))).map(|it| it.id).collect();
    asked.extend(["EXACT-1", "DET-1"].map(ToOwned::to_owned));
    let excused: Vec<_> = NOT_ASKED.iter().flat_map(|(ids, _)| ids.iter().copied()).collect();
    for id in &asked {
        let is_excused = excused.contains(&id.as_str());
        assert_ne!(cited.contains(id), is_excused, "{id}: has a case, or a reason for having none, not both");
    }
    assert!(excused.iter().all(|id| asked.iter().any(|it| it == id)), "{excused:?}");
}

#[test]
fn every_clause_is_covered_as_its_kind_requires() {
    let (wrong, text) = judge(&all_clauses(), &all_citations());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    fs::write(Path::new(env!("CARGO_TARGET_TMPDIR")).join("coverage.txt"), text).unwrap();
}

#[test]
fn the_table_of_theorems_has_them_all() {
    let table = read(Path::new("proofs/README.md"));
    let is_there = |clause: &Clause| table.contains(&format!("\n| {} | ", clause.id));
    let theorems = all_clauses().into_iter().filter(|clause| clause.kind == Some(Kind::Theorem));
    let missing: Vec<_> = theorems.filter(|clause| !is_there(clause)).map(|clause| clause.id).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Every proof has a clause: no theorem is missing in the specification.
#[test]
fn every_proof_file_cites_a_clause() {
    let cited: BTreeMap<_, _> = all_citations().into_iter().map(|citation| (citation.by, citation.cover)).collect();
    let silent = |folder: &str, ending: &str| {
        let cites = |file: &PathBuf| cited.keys().any(|by| by.starts_with(&file.display().to_string()));
        files(folder, ending).into_iter().filter(|file| !cites(file)).collect::<Vec<_>>()
    };
    // Exceptions: evaluations, generated by programs that cannot name a clause at each; operations printed from the
    // library's source, without proofs; and extraction.
    let evaluated =
        ["Cases.v", "Suite.v", "Vectors.v", "exact/Arithmetic.v", "exact/Operations.v", "extract/Extract.v"]
            .map(|file| Path::new("spec/rocq").join(file));
    assert_eq!(silent("spec/rocq", "v"), evaluated);
}

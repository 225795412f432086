//! Targets of the conformance suite, for implementations and for runners.

use arbitrary::Unstructured;
use serde_json::{Map, Value};
use stackless_suite::{
    Answer, Expect, Hello, Implementation, Level, Library, Profile, Reply, Strength, Suite, SuiteCase, SuiteError,
    VERSION, Waivers, author, judge, serve,
};

use super::draw::patched;
use super::{right, said};
use stackless_bvh::generate::Source;

/// Answers a line of a runner: any text, or a changed case of the suite. Every answer is well-formed.
pub(crate) fn requests(bytes: &[u8]) {
    let line = if bytes.first() == Some(&b'{') { bytes.to_vec() } else { changed(&mut Unstructured::new(bytes)) };
    let mut said = Vec::new();
    let served = serve(&mut Library::default(), &line[..], &mut said);
    if served.is_ok() {
        for line in said.split(|&byte| byte == b'\n').filter(|line| !line.is_empty()) {
            let is_one = serde_json::from_slice::<Reply>(line).is_ok() || serde_json::from_slice::<Hello>(line).is_ok();
            assert!(is_one, "{}", line.escape_ascii());
        }
    }
}

/// Judges a case and an answer, each arbitrary text or a changed valid one. A right answer must pass.
pub(crate) fn answers(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    let profiles = some_profiles();
    let profile = &profiles[source.below(profiles.len() as u64) as usize];
    let case = &profile.cases[source.below(profile.cases.len() as u64) as usize];
    let mut library = Library::default();
    let hello = library.hello();
    let answer = library.answer(profile.level, &profile.profile, &case.input);
    right(judge(case, &hello, &answer), &case.id);
    let case = patched(&mut source, right(serde_json::to_vec(case), "a case"));
    let answer = patched(&mut source, right(serde_json::to_vec(&Reply { seq: 0, answer }), "an answer"));
    let (case, reply) = (serde_json::from_slice::<SuiteCase>(&case), serde_json::from_slice::<Reply>(&answer));
    if let (Ok(case), Ok(Reply { answer: Answer::Result(_) | Answer::Reject(_), .. })) = (&case, &reply) {
        let _ = judge(case, &hello, &reply.expect("just looked at").answer);
    }
}

/// Names of profiles. Few changed bytes make a path of them.
const NAMES: [&str; 6] = ["u64", "../u32", "u32/../../x", "", "U32", "u32\\u0000"];

/// Reads the files of a small suite and a list of waivers, changed. An accepted suite has its files within its folder,
/// and survives a round trip.
pub(crate) fn suite_files(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    let mut files = small_suite().files();
    let waivers = br#"[{"id":"key/u32/child-left","reason":"known"}]"#.to_vec();
    for text in files.iter_mut().map(|(_, text)| text) {
        *text = String::from_utf8_lossy(&patched(&mut source, text.clone().into_bytes())).into_owned();
    }
    let waivers = patched(&mut source, waivers);
    if source.below(2) == 1 {
        let name = NAMES[source.below(NAMES.len() as u64) as usize];
        for (path, text) in &mut files {
            (*path, *text) = (path.replace("u32", name), text.replace("u32", name));
        }
    }
    match read(&files) {
        Ok(suite) => {
            let files = suite.files();
            for (path, _) in &files {
                let is_plain = |part: &str| part.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'.'));
                assert!(path.split('/').all(|part| is_plain(part) && part != ".." && !part.is_empty()), "{path:?}");
                assert_eq!(files.iter().filter(|(other, _)| other == path).count(), 1, "{path} is written twice");
            }
            assert_eq!(right(read(&files), "files of an accepted suite"), suite);
        }
        Err(refusal) => said(refusal),
    }
    if let Err(refusal) = Waivers::parse(&String::from_utf8_lossy(&waivers)) {
        said(refusal);
    }
}

fn read(files: &[(String, String)]) -> Result<Suite, SuiteError> {
    Suite::read(|file| {
        let found = files.iter().find(|(path, _)| path == file);
        found.map(|(_, text)| text.clone()).ok_or_else(|| std::io::ErrorKind::NotFound.into())
    })
}

/// Returns two profiles with a case each, which need no generation.
fn small_suite() -> Suite {
    let case = |profile: &str| SuiteCase {
        id: format!("key/{profile}/child-left"),
        clauses: vec!["KEY-1".to_owned()],
        strength: Strength::Must,
        features: Vec::new(),
        why: "the left child".to_owned(),
        input: Map::new(),
        expect: Expect::Valid(true),
    };
    let profile = |name: &str| Profile {
        suite: VERSION.to_owned(),
        level: Level::Key,
        profile: name.to_owned(),
        cases: vec![case(name)],
    };
    Suite { profiles: ["u32", "u64"].map(profile).to_vec() }
}

fn changed(source: &mut Unstructured<'_>) -> Vec<u8> {
    let profiles = some_profiles();
    let Profile { level, profile, cases, .. } = &profiles[source.below(profiles.len() as u64) as usize];
    let case = &cases[source.below(cases.len() as u64) as usize];
    patched(source, line(*level, profile, &case.input))
}

fn line(level: Level, profile: &str, input: &Map<String, Value>) -> Vec<u8> {
    let request = serde_json::json!({ "cmd": "case", "seq": 0, "level": level, "profile": profile, "input": input });
    request.to_string().into_bytes()
}

/// Returns the small cases, generated once.
pub(crate) fn some_profiles() -> &'static [Profile] {
    static PROFILES: std::sync::OnceLock<Vec<Profile>> = std::sync::OnceLock::new();
    PROFILES.get_or_init(|| {
        let mut profiles = author::suite().profiles;
        for profile in &mut profiles {
            profile.cases.retain(|case| serde_json::to_string(case).is_ok_and(|text| text.len() < 2000));
        }
        profiles.retain(|profile| !profile.cases.is_empty());
        profiles
    })
}

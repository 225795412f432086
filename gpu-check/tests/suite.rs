//! Kernels as implementations of the conformance suite: the cases that each kernel passes, and the bugs that the suite
//! detects.

use std::sync::LazyLock;
use std::time::Duration;

use gpu_check::Gpu;
use gpu_check::kernel::Kernel;
use gpu_check::planted::{self, SHADERS, Shader, ShownBy};
use gpu_check::suite::Adapter;
use stackless_suite::{Implementation as _, Profile, Runner, Suite, SuiteCase, Waivers, judge};

/// Loaded once, because every bug runs a part of it.
static SUITE: LazyLock<Suite> = LazyLock::new(|| Suite::shipped().unwrap());

/// The number of cases that a kernel passes, by its full name. It fails no case, and names no other profiles.
const PASSED: [(&str, usize); 29] = [
    ("stack", 1128),
    ("stack-workgroup", 1128),
    ("stack-t0", 1014),
    ("laine-0", 1370),
    ("laine-1", 1370),
    ("laine-4", 1370),
    ("laine-8", 1370),
    ("afra", 1413),
    ("hashed-printed", 1413),
    ("hashed", 1413),
    ("hashed-disjoint", 1601),
    ("stack-persistent", 1128),
    // Another order: no traces.
    ("stack-speculative", 309),
    ("laine-0/64", 1369),
    ("laine-1/64", 1369),
    ("laine-4/64", 1369),
    ("laine-8/64", 1369),
    ("afra/64", 1412),
    ("hashed-printed/64", 1819),
    ("hashed/64", 1819),
    ("hashed-disjoint/64", 2007),
    ("laine-0/96", 1085),
    ("laine-1/96", 1085),
    ("laine-4/96", 1085),
    ("laine-8/96", 1085),
    ("afra/96", 1128),
    ("hashed-printed/96", 1535),
    ("hashed/96", 1535),
    ("hashed-disjoint/96", 1723),
];

fn command(arguments: &[&str]) -> Vec<String> {
    [env!("CARGO_BIN_EXE_gpu-check")].iter().chain(arguments).map(ToString::to_string).collect()
}

fn runner(suite: &Suite, command: Vec<String>) -> Runner<'_> {
    Runner {
        command,
        suite,
        waivers: Waivers::default(),
        timeout: Duration::from_mins(2),
        budget: Duration::from_mins(30),
        window: 64,
        fail_fast: false,
        passes_errors: true,
    }
}

/// The cases of a profile for a clause.
fn about(profile: &str, clause: &str) -> Suite {
    let is_about = |case: &&SuiteCase| case.clauses.iter().any(|it| it == clause);
    let asked = SUITE.profiles.iter().filter(|asked| asked.name() == profile);
    let profiles = asked.map(|asked| Profile {
        suite: asked.suite.clone(),
        profile: asked.profile.clone(),
        cases: asked.cases.iter().filter(is_about).cloned().collect(),
        ..*asked
    });
    Suite { profiles: profiles.collect() }
}

/// Number of cases that a kernel with a bug fails.
fn failed(gpu: &Gpu, bug: &'static Shader, suite: &Suite) -> usize {
    let mut adapter =
        Adapter::new(gpu, planted::by_name(bug.asked.as_ref().unwrap_or(&bug.kernel)).unwrap(), Some(bug)).unwrap();
    let hello = adapter.hello();
    let mut failed = 0;
    for (profile, case) in suite.cases() {
        assert!(hello.profiles.contains(&profile.name()), "{}: {}", bug.name, profile.name());
        if case.features.iter().all(|feature| hello.features.contains(feature)) {
            let answer = adapter.answer(profile.level, &profile.profile, &case.input);
            failed += usize::from(judge(case, &hello, &answer).is_err());
        }
    }
    failed
}

#[test]
fn every_kernel_conforms_in_what_it_names() {
    let suite = &*SUITE;
    let cases = suite.cases().count();
    assert_eq!(cases, 4870);
    let kernels: Vec<_> = (1..=3).flat_map(Kernel::all).map(|kernel| kernel.full_name()).collect();
    assert_eq!(kernels, PASSED.map(|(kernel, _)| kernel));
    let passed = PASSED.map(|(kernel, _)| {
        let report = runner(suite, command(&["suite", "--kernel", kernel])).run(|_| {}).unwrap();
        let bad: Vec<_> = report.verdicts.iter().filter(|verdict| verdict.outcome.is_bad()).take(3).collect();
        assert!(bad.is_empty() && report.is_conforming(), "{kernel}: {:?} {bad:#?}", report.faults);
        assert_eq!(report.count("pass") + report.count("not-asked"), cases, "{kernel}");
        (kernel, report.count("pass"))
    });
    assert_eq!(passed, PASSED);
}

#[test]
#[ignore = "takes minutes; `.ci/run planted` runs it weekly"]
fn planted_bugs_fail_cases_of_their_clauses() {
    let gpu = Gpu::open(None).unwrap();
    for bug in &*SHADERS {
        let Some(profile) = &bug.profile else { continue };
        // For certain results, and for the method of a traversal, no case cites the clause itself.
        let clause = match (bug.by, &bug.passes) {
            (ShownBy::Exact, _) | (ShownBy::Rays, Some(_)) => "EXACT-1",
            (ShownBy::Tapes, Some(_)) => "ORACLE-1",
            (_, None) => &bug.clause,
        };
        let failed = failed(&gpu, bug, &about(profile, clause));
        assert_eq!(failed == 0, bug.passes.is_some(), "{bug:?} fails {failed}");
    }
}

/// Kernels with bugs are adapters, too.
#[test]
fn a_planted_bug_is_an_adapter() {
    let suite = about("key/u64", "TRAIL-3");
    let bug = "zeros of the second word without those of the first";
    let report = runner(&suite, command(&["suite", "--kernel", "hashed/64", "--planted", bug])).run(|_| {}).unwrap();
    assert!(report.hello.name.contains(bug) && !report.is_conforming());
}

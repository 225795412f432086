//! Kernels as implementations that the conformance suite asks: what each passes, and which mistakes the suite sees.

use std::time::Duration;

use gpu_check::Gpu;
use gpu_check::kernel::Kernel;
use gpu_check::planted::{self, BAND_BUGS, BUGS, RAY_BUGS};
use gpu_check::suite::Adapter;
use stackless_suite::{Implementation as _, RunError, Runner, Suite, Waivers, author, judge};

/// Cases that a kernel passes, by its full name. It fails none; all others it does not name.
const PASSED: [(&str, usize); 29] = [
    ("stack", 964),
    ("stack-workgroup", 964),
    ("stack-t0", 862),
    ("laine-0", 1199),
    ("laine-1", 1199),
    ("laine-4", 1199),
    ("laine-8", 1199),
    ("afra", 1241),
    ("hashed-printed", 1241),
    ("hashed", 1241),
    ("hashed-disjoint", 1439),
    ("stack-persistent", 964),
    // In another order: no traces.
    ("stack-speculative", 236),
    ("laine-0/64", 1198),
    ("laine-1/64", 1198),
    ("laine-4/64", 1198),
    ("laine-8/64", 1198),
    ("afra/64", 1240),
    ("hashed-printed/64", 1647),
    ("hashed/64", 1647),
    ("hashed-disjoint/64", 1845),
    ("laine-0/96", 922),
    ("laine-1/96", 922),
    ("laine-4/96", 922),
    ("laine-8/96", 922),
    ("afra/96", 964),
    ("hashed-printed/96", 1371),
    ("hashed/96", 1371),
    ("hashed-disjoint/96", 1569),
];

/// Where the mistakes of [`planted`] show: the kernel, if it is not the mistake's own, profile, and a clause.
const SEEN: [(&str, &str, &str, &str); 46] = [
    ("the key is shifted by one level too many", "", "trace/script", "TRAIL-4"),
    ("the trail is shifted by one level too few", "", "trace/script", "TRAIL-4"),
    ("the trail is not toggled", "", "trace/script", "TRAIL-4"),
    ("the key is not toggled", "", "trace/script", "TRAIL-4"),
    ("the address in the table of displacements is not extended by its sign", "", "trace/script", "HASHED-1"),
    ("direct addresses are taken for displacements", "", "trace/complete", "HASHED-1"),
    ("the key is not reduced", "", "trace/script", "HASHED-1"),
    // Most of the keys of `hashed` have direct addresses.
    ("the sum is not reduced", "hashed/64", "hash/lookup", "HASH-1"),
    ("the wrong displacement", "", "trace/complete", "HASHED-1"),
    ("no bijection where the plain hash fails", "", "trace/script", "HASHED-1"),
    ("the register is kept after it is used", "", "trace/script", "REGISTER-1"),
    ("the register holds the wrong child", "", "trace/script", "REGISTER-1"),
    ("the grand uncle is taken before the uncle", "", "trace/complete", "UNCLE-1"),
    ("the uncle counts as postponed when the sibling is", "", "trace/complete", "UNCLE-1"),
    ("leaves are taken to name two nodes, and the table holds the keys for three", "", "trace/complete", "HASH-3"),
    ("the register is not emptied when its node is masked", "", "trace/disjoint", "DISJOINT-3"),
    ("the register is filled before the mask", "", "trace/disjoint", "DISJOINT-3"),
    ("the second trail is not shifted", "", "trace/disjoint", "DISJOINT-1"),
    ("intervals that touch count as disjoint", "", "trace/disjoint", "DISJOINT-1"),
    ("a hit beyond its leaf's box masks", "", "trace/disjoint", "DISJOINT-2"),
    ("a missed child is preferred (H Algorithm 1 as printed)", "", "trace/tape", "ORDER-1"),
    ("ties go right", "", "trace/complete", "ORDER-1"),
    ("any hit does not end the search", "", "trace/complete", "ORACLE-1"),
    ("a node that begins where the hit is is dropped", "", "trace/distance", "ORACLE-3"),
    // A case of `trace` is one lane.
    ("lanes share a stack", "", "ray/grid", "EXACT-1"),
    ("the last result is not written", "", "trace/complete", "TRAVERSE-1"),
    ("the leaf that was put aside is forgotten", "", "ray/grid", "EXACT-1"),
    ("the climb stops one level short", "", "trace/complete", "TRAVERSE-1"),
    ("the climb takes siblings for parents", "", "trace/complete", "TRAVERSE-1"),
    ("the ring is one too long", "", "trace/complete", "TRAVERSE-1"),
    ("no carry into the second word", "", "key/u64", "TRAIL-6"),
    ("the second word is shifted into the first by one bit too few", "", "key/u64", "TRAIL-4"),
    ("zeros of the second word without those of the first", "", "key/u64", "TRAIL-3"),
    ("the bit between the words is lost on descending", "", "key/u64", "KEY-2"),
    ("the remainder of the low word alone", "", "hash/function", "HASH-1"),
    ("a carry is lost in the product", "", "hash/function", "HASH-1"),
    ("the third word has no zeros", "", "trace/script", "TRAIL-3"),
    ("near planes are not chosen by the direction", "", "ray/grid", "EXACT-1"),
    ("a plane of a box bounds a ray that lies in it", "", "ray/grid", "EXACT-1"),
    ("the planes of the two boxes are exchanged", "", "ray/grid", "EXACT-1"),
    ("boxes end where the best hit is, not after it", "", "ray/exact", "EXACT-1"),
    ("of equal hits the last triangle counts", "", "ray/grid", "EXACT-1"),
    ("a hit where the ray begins is left out", "", "ray/grid", "EXACT-1"),
    ("edges do not belong to triangles", "", "ray/grid", "EXACT-1"),
    ("triangles are seen from one side", "", "ray/grid", "EXACT-1"),
    ("a postponed box is taken to begin later than it does", "", "ray/grid", "EXACT-1"),
];

/// The others, the profile where they would show, and why they cannot. `tapes` and `rays` show them.
const NOT_SEEN: [(&str, &str, &str); 5] = [
    (
        "a child that is culled at the pop level is replaced by its sibling",
        "trace/tape",
        "searches that change while it restarts are asked only of who decides once",
    ),
    ("the bits below the level stay", "trace/tape", "they are set only where decisions have changed"),
    ("keys are cut one bit too early", "trace/script", "no tree of up to 95 edges has lookups of more than 64 bits"),
    ("the length is not folded in", "trace/script", "the same"),
    ("zeros keep their sign", "ray/grid", "zeros of either sign are equal in the suite"),
];

fn command(arguments: &[&str]) -> Vec<String> {
    [env!("CARGO_BIN_EXE_gpu-check")].iter().chain(arguments).map(ToString::to_string).collect()
}

fn runner(suite: &Suite, command: Vec<String>) -> Runner<'_> {
    Runner { command, suite, waivers: Waivers::default(), timeout: Duration::from_mins(2), window: 64 }
}

/// The cases of a profile that are about a clause.
fn about(profile: &str, clause: &str) -> Suite {
    let mut suite = author::suite();
    suite.profiles.retain(|asked| asked.name() == profile);
    for asked in &mut suite.profiles {
        asked.cases.retain(|case| case.clauses.iter().any(|it| it == clause));
    }
    suite
}

/// How many cases a kernel with a mistake fails.
fn failed(gpu: &Gpu, bug: &str, kernel: &str, suite: &Suite) -> usize {
    let bug = planted::named(bug).unwrap();
    let kernel = if kernel.is_empty() { bug.kernel } else { kernel };
    let mut adapter = Adapter::new(gpu, planted::by_name(kernel).unwrap(), Some(bug)).unwrap();
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
    let suite = author::suite();
    assert_eq!(suite.cases().count(), 3588);
    let kernels: Vec<_> = (1..=3).flat_map(Kernel::all).map(|kernel| kernel.full_name()).collect();
    assert_eq!(kernels, PASSED.map(|(kernel, _)| kernel));
    for (kernel, passed) in PASSED {
        let report = runner(&suite, command(&["suite", "--kernel", kernel])).run(|_| {}).unwrap();
        let bad: Vec<_> = report.verdicts.iter().filter(|verdict| verdict.outcome.is_bad()).take(3).collect();
        assert!(bad.is_empty() && report.is_conforming(), "{kernel}: {:?} {bad:#?}", report.faults);
        assert_eq!((report.count("pass"), report.count("unsupported")), (passed, 3588 - passed), "{kernel}");
    }
}

#[test]
fn planted_bugs_fail_cases_of_their_clauses() {
    let gpu = Gpu::open(None).unwrap();
    let mut all: Vec<_> = BUGS.iter().chain(RAY_BUGS).map(|bug| bug.name).collect();
    let mut listed: Vec<_> = SEEN.iter().map(|row| row.0).chain(NOT_SEEN.iter().map(|row| row.0)).collect();
    all.sort_unstable();
    listed.sort_unstable();
    assert_eq!(listed, all);
    let is_seen =
        |bug: &str, kernel: &str, profile: &str, clause: &str| failed(&gpu, bug, kernel, &about(profile, clause)) > 0;
    let missed: Vec<_> = SEEN.iter().filter(|row| !is_seen(row.0, row.1, row.2, row.3)).collect();
    assert!(missed.is_empty(), "{missed:#?}");
    for (bug, profile, why) in NOT_SEEN {
        let clause = if profile == "ray/grid" { "EXACT-1" } else { "ORACLE-1" };
        assert!(!is_seen(bug, "", profile, clause), "{bug}: {why}");
    }
}

/// Each bound of [BAND-2], [BAND-3] and [BAND-4], and each doubt of [BAND-5], is needed.
#[test]
fn bugs_in_what_is_certain_fail_exact_rays() {
    let gpu = Gpu::open(None).unwrap();
    let suite = about("ray/exact", "EXACT-1");
    let missed: Vec<_> =
        BAND_BUGS.iter().map(|bug| bug.name).filter(|bug| failed(&gpu, bug, "", &suite) == 0).collect();
    assert_eq!(missed, [""; 0]);
}

/// The mistakes are adapters too.
#[test]
fn a_planted_bug_is_an_adapter() {
    let suite = about("key/u64", "TRAIL-3");
    let bug = "zeros of the second word without those of the first";
    let report = runner(&suite, command(&["suite", "--kernel", "hashed/64", "--planted", bug])).run(|_| {}).unwrap();
    assert!(report.hello.name.contains(bug) && !report.is_conforming());
}

#[test]
fn without_an_adapter_nothing_is_answered() {
    let suite = author::suite();
    match runner(&suite, command(&["--adapter", "none of this name", "suite"])).run(|_| {}) {
        Err(RunError::Hello { what, .. }) => assert!(what.contains("exit status: 3"), "{what}"),
        other => panic!("{other:?}"),
    }
}

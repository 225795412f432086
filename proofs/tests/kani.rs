//! `kani.sh --judge`, on output in the format of Kani 0.68 (`cbmc_property_renderer.rs` and `harness_runner.rs` of its driver).

use std::path::Path;
use std::process::Command;
use std::{env, fs, process};

const OUTPUT: &str = include_str!("kani.txt");

/// The output of the binary `list`, whose names alone matter here.
const LIST: &str = "swaps_u32\tswaps_u32_twin\t2\ncounter_u32\tcounter_u32_twin\t2\n";

/// Returns the report about an output; `Err` if it is not accepted.
fn judge(name: &str, list: &str, output: &str) -> Result<String, String> {
    let folder = env::temp_dir().join(format!("kani-{}-{name}", process::id()));
    fs::create_dir(&folder).unwrap();
    let [list, output] = [("list", list), ("log", output)].map(|(file, text)| {
        fs::write(folder.join(file), text).unwrap();
        folder.join(file)
    });
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("kani.sh");
    let judged = Command::new(script).arg("--judge").args([list, output]).output().unwrap();
    fs::remove_dir_all(folder).unwrap();
    let said = String::from_utf8(judged.stdout).unwrap();
    if judged.status.success() { Ok(said) } else { Err(said) }
}

#[test]
fn an_output_without_faults_is_accepted() {
    assert_eq!(judge("right", LIST, OUTPUT).unwrap(), "2 harnesses and their twins, 0 faults\n");
}

/// One harness, its twin, or one of their lines is invalid.
#[test]
fn each_fault_of_an_output_is_seen() {
    // The whole output of one harness except its lines `from` to `to`.
    let without = |name: &str, from: &str, to: &str| {
        let (before, rest) = OUTPUT.split_once(&format!("{name}...\n")).unwrap();
        let (kept, rest) = rest.split_once(from).unwrap();
        let (_, after) = rest.split_once('\n').unwrap();
        format!("{before}{name}...\n{kept}{to}\n{after}")
    };
    let (claim, end) = ("Failed Checks: the claim of the harness", "VERIFICATION:-");
    let covers = "** 2 of 2 cover";
    let cases = [
        (without("swaps_u32", end, "VERIFICATION:- FAILED"), "swaps_u32: not verified"),
        (
            without("swaps_u32", covers, " ** 1 of 2 cover properties satisfied (1 unreachable)"),
            "swaps_u32: not all covers",
        ),
        (without("counter_u32", covers, ""), "counter_u32: not all covers"),
        // The description of the claim is still at its check.
        (
            without("swaps_u32_twin", claim, "Failed Checks: attempt to subtract with overflow"),
            "swaps_u32_twin: its claim",
        ),
        (without("counter_u32_twin", claim, ""), "counter_u32_twin: its claim did not fail"),
        (
            without(
                "counter_u32_twin",
                end,
                "VERIFICATION:- FAILED (encountered failures other than panics, which were unexpected)",
            ),
            "counter_u32_twin: not verified",
        ),
        (
            OUTPUT.replace("Checking harness bits::counter_u32...", "Checking harness bits::other..."),
            "counter_u32: not verified",
        ),
        (
            OUTPUT.split_once("Checking harness bits::counter_u32_twin").unwrap().0.to_owned(),
            "counter_u32_twin: not verified",
        ),
    ];
    for (i, (output, fault)) in cases.iter().enumerate() {
        let said = judge(&i.to_string(), LIST, output).expect_err(fault);
        assert!(said.contains(fault), "{fault}: {said}");
        assert!(
            said.lines().all(|line| line.starts_with(fault.split(':').next().unwrap()) || line.ends_with("faults")),
            "{said}"
        );
    }
    judge("none", "", "No proof harnesses (functions with #[kani::proof]) were found to verify.\n").unwrap_err();
}

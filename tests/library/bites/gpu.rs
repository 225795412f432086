//! The bugs of the kernels in `gpu-check`, which is a package of its own: that each is caught is a test of that
//! package.

use std::fmt::Write as _;

use stackless_check::planted::SHADERS;

const HEAD: &str = "
## Kernels of gpu-check

A test of that package runs each and wants it seen: in searches along tapes over 1,024 trees, in 2,000 rays into each
made scene, or in rays of the suite that are answered exactly. In how many it is seen differs from device to device;
`cargo run --release -- planted` says it for one. As an implementation it fails cases of a profile of the suite.

| bug | breaks | kernel | gpu-check | profile |
|---|---|---|---|---|
";

/// A part of `tests/PLANTED.md`.
pub(crate) fn table() -> String {
    let mut text = HEAD.to_owned();
    for bug in SHADERS {
        let (name, clause, kernel, by) = (bug.name, bug.clause, bug.kernel, bug.by.name());
        let asked = if bug.asked == kernel { String::new() } else { format!(" by `{}`", bug.asked) };
        let profile = match bug.passes {
            None => format!("`{}`{asked}", bug.profile),
            Some(why) => format!("{}{why}", super::table::NO),
        };
        writeln!(text, "| {name} | {clause} | {kernel} | {by} | {profile} |").unwrap();
    }
    writeln!(text, "\n{} bugs.", SHADERS.len()).unwrap();
    text
}

//! One planted bug, whose name the environment variable `PLANTED` has; without it, prints the names of all and of the
//! controls.
#![no_main]

use std::{env, process};

use stackless_fuzz::planted::{Bug, bugs, controls};

thread_local!(static BUG: Bug = named());

libfuzzer_sys::fuzz_target!(init: print_names(), |bytes: &[u8]| BUG.with(|bug| bug.run(bytes)));

fn print_names() {
    if env::var_os("PLANTED").is_none() {
        bugs().iter().for_each(|bug| println!("bug {}", bug.name()));
        controls().iter().for_each(|control| println!("control {}", control.name()));
        process::exit(0);
    }
}

fn named() -> Bug {
    let name = env::var("PLANTED").unwrap_or_default();
    let found = bugs().into_iter().chain(controls()).find(|bug| bug.name() == name);
    found.unwrap_or_else(|| panic!("no planted bug has the name {name:?}"))
}

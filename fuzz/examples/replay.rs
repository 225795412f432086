//! Runs inputs through their targets, without a fuzzer: `replay FOLDER...`, each with a folder of inputs for every
//! target.
//!
//! Coverage is measured with this program. `replay TARGET FILE` runs a finding.

use std::path::Path;
use std::{env, fs};

fn main() {
    let arguments: Vec<_> = env::args().skip(1).collect();
    if let [target, file] = &arguments[..]
        && stackless_fuzz::TARGETS.iter().any(|known| known.name == target)
    {
        return stackless_fuzz::run(target, &fs::read(file).expect("a file"));
    }
    for folder in &arguments {
        for target in stackless_fuzz::TARGETS {
            let files = fs::read_dir(Path::new(folder).join(target.name)).into_iter().flatten();
            let inputs: Vec<_> = files.filter_map(|file| fs::read(file.ok()?.path()).ok()).collect();
            inputs.iter().for_each(|bytes| stackless_fuzz::run(target.name, bytes));
            println!("{folder}: {} inputs of {}", inputs.len(), target.name);
        }
    }
}

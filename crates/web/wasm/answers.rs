//! The expected content of the page, by the native library. `answers FILE...` prints JSON, by scene, for the named
//! examples and files. `tests/web` compares.

use std::ffi::OsString;
use std::path::Path;

use serde_json::{Map, json};
use stackless_web::{Example, SIDE, Scene, Totals};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut answers = Map::new();
    for argument in std::env::args_os().skip(1) {
        let (name, scene) = open(&argument)?;
        let (mut totals, mut pictures) = (Totals::default(), [START; 2]);
        for y in 0..SIDE {
            let row = scene.row(y, &mut totals);
            hash(&mut pictures[0], &row.exact);
            hash(&mut pictures[1], &row.inexact);
        }
        let pictures = pictures.map(|digest| format!("{digest:08x}"));
        answers.insert(name, json!({ "totals": totals, "pictures": pictures }));
    }
    println!("{}", json!(answers));
    Ok(())
}

fn open(argument: &OsString) -> Result<(String, Scene), Box<dyn std::error::Error>> {
    let path = Path::new(argument);
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let is_example = Example::ALL.iter().any(|example| example.name == name);
    let scene = if is_example { Scene::example(&name)? } else { Scene::read(&name, &std::fs::read(path)?)? };
    Ok((name, scene))
}

/// The hash of Fowler, Noll and Vo in 32 bits, which JavaScript can compute.
const START: u32 = 0x811c_9dc5;

fn hash(digest: &mut u32, bytes: &[u8]) {
    for &byte in bytes {
        *digest = (*digest ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    }
}

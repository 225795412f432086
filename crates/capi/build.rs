//! Sets the name and the version of the shared library, by which programs find it, and writes the functions in single
//! precision: those in double precision, with other names and types.

use std::fs::{read_to_string, write};
use std::io;
use std::path::Path;

/// The names in double precision, and in single precision. An underscore and a letter end a function's name.
const NAMES: [(&str, &str); 5] =
    [("f64", "f32"), ("DVec3", "Vec3"), ("_d(", "_f("), ("_d`", "_f`"), ("double precision", "single precision")];

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let [major, minor] = [env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR")];
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libstackless.so.{major}.{minor}");
    }
    println!("cargo::rerun-if-changed=src/double");
    println!("cargo::rerun-if-changed=src/double.rs");
    let mut single = String::new();
    // One file: a module in place of each file.
    for line in read_to_string("src/double.rs")?.lines().filter(|line| !line.starts_with("//!")) {
        let module = line.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(';'));
        single += &module.map_or(Ok(line.to_owned()), |module| {
            read_to_string(format!("src/double/{module}.rs")).map(|text| format!("pub mod {module} {{\n{text}}}\n"))
        })?;
    }
    let single = NAMES.iter().fold(single, |text, (double, single)| text.replace(double, single));
    let folder = std::env::var("OUT_DIR").map_err(io::Error::other)?;
    write(Path::new(&folder).join("single.rs"), single)
}

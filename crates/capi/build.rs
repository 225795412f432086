//! Sets the name and the version of the shared library, by which programs find it.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let [major, minor] = [env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR")];
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libstackless.so.{major}.{minor}");
    }
}

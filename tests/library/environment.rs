//! Threads whose floats are not those of IEEE 754: this program runs itself with a library before it that sets them.
#![cfg(all(target_arch = "x86_64", target_os = "linux", feature = "parallel"))]

use std::path::{Path, PathBuf};
use std::process::Command;

use stackless_bvh::bvh::{BuildError, Bvh, FileError, RefitError, WideBvh, WideError};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Ball, BallError, EnvironmentError, Ray, RayError, check_environment};
use stackless_bvh::glam::Vec3;
use stackless_bvh::trace::{BinaryTracer, Tracer};

/// Bits of the control register, and what is wrong then.
const MODES: [(&str, Result<(), EnvironmentError>); 6] = [
    ("0", Ok(())),
    // Results below the least normal number are zero; such arguments are zero.
    ("8000", Err(EnvironmentError::Subnormals)),
    ("0040", Err(EnvironmentError::Subnormals)),
    // Down, up, towards zero.
    ("2000", Err(EnvironmentError::Rounding)),
    ("4000", Err(EnvironmentError::Rounding)),
    ("6000", Err(EnvironmentError::Rounding)),
];

/// `[ENV-1]`
#[test]
fn unfit_threads_are_refused() {
    let Some(library) = compiled() else {
        println!("SKIPPED: no cc");
        return;
    };
    for (bits, _) in MODES {
        run(&library, "environment::entrances_refuse", &format!("{bits} 0"));
        run(&library, "environment::helpers_refuse", &format!("0 0 {bits}"));
    }
}

/// Runs one of the tests below with these bits, of the thread that runs it, the next one, and all others.
fn run(library: &Path, test: &str, bits: &str) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", test, "--ignored"]).env("LD_PRELOAD", library).env("FLOATS", bits);
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("1 passed"), "{test} {bits}: {text}");
}

fn compiled() -> Option<PathBuf> {
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/library/floats.c");
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join("floats.so");
    let flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-O1", "-shared", "-fPIC", source, "-o"];
    let output = Command::new("cc").args(flags).arg(&library).output().ok()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(library)
}

/// What the bits do that are set for one of the threads.
fn expected(thread: usize) -> Result<(), EnvironmentError> {
    let bits = std::env::var("FLOATS").unwrap();
    let bits = bits.split(' ').nth(thread).unwrap();
    MODES.into_iter().find(|(mode, _)| *mode == bits).unwrap().1
}

/// All that this thread makes for itself.
#[test]
#[ignore = "`unfit_threads_are_refused` runs it with bits set"]
fn entrances_refuse() {
    let expected = expected(0);
    assert_eq!(check_environment(), expected);
    let mesh = procedural::soup(1, 100);
    // Made by another thread, which is well.
    let make = || {
        let bvh = Bvh::build(&mesh).unwrap();
        (WideBvh::build(&mesh).unwrap(), bvh)
    };
    let (mut wide, mut bvh) = std::thread::scope(|scope| scope.spawn(make).join().unwrap());
    let (wide_bytes, bytes) = (wide.to_bytes(), bvh.to_bytes());
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let tracer = Tracer::new(&wide);
    match expected {
        Ok(()) => {
            let Ok(ray) = ray else { panic!("{ray:?}") };
            assert!(tracer.closest_parallel(&[ray]).is_ok() && Bvh::build(&mesh).is_ok() && bvh.refit(&mesh).is_ok());
        }
        Err(error) => {
            assert_eq!(ray, Err(RayError::Environment(error)));
            assert_eq!(Ball::around(Vec3::ZERO), Err(BallError::Environment(error)));
            assert_eq!(tracer.closest_parallel(&[]), Err(error));
            assert_eq!(Bvh::build(&mesh).unwrap_err(), BuildError::Environment(error));
            assert_eq!(WideBvh::<8>::of(&bvh).unwrap_err(), WideError::Environment(error));
            assert_eq!(WideBvh::<8>::from_bytes(&wide_bytes).unwrap_err(), FileError::Environment(error));
            assert_eq!(<Bvh>::from_bytes(&bytes).unwrap_err(), FileError::Environment(error));
            assert_eq!(bvh.refit(&mesh), Err(RefitError::Environment(error)));
            assert_eq!(wide.refit(&mesh), Err(RefitError::Environment(error)));
        }
    }
}

/// All that other threads help with, where they are the unfit ones.
#[test]
#[ignore = "`unfit_threads_are_refused` runs it with bits set"]
fn helpers_refuse() {
    let expected = expected(2);
    let mesh = procedural::soup(1, 10_000);
    let well = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let (bvh, wide) = well.install(|| (Bvh::build(&mesh).unwrap(), WideBvh::build(&mesh).unwrap()));
    let (binary, tracer) = (BinaryTracer::new(&bvh), Tracer::new(&wide));
    let rays = procedural::rays(&mesh, 1, 5000);
    let balls: Vec<_> = rays.iter().map(|ray| Ball::around(ray.origin()).unwrap()).collect();
    assert_eq!(Bvh::build(&mesh).map(|_| ()), expected.map_err(BuildError::Environment));
    assert_eq!(WideBvh::<8>::of(&bvh).map(|_| ()), expected.map_err(WideError::Environment));
    assert_eq!(
        [
            binary.closest_parallel(&rays).map(|_| ()),
            binary.any_parallel(&rays).map(|_| ()),
            binary.any_hit_parallel(&rays).map(|_| ()),
            binary.all_parallel(&rays).map(|_| ()),
            binary.nearest_parallel(&balls).map(|_| ()),
            tracer.closest_parallel(&rays).map(|_| ()),
            tracer.any_parallel(&rays).map(|_| ()),
            tracer.any_hit_parallel(&rays).map(|_| ()),
            tracer.all_parallel(&rays).map(|_| ()),
            tracer.crossings_parallel(&rays).map(|_| ()),
            tracer.nearest_parallel(&balls).map(|_| ()),
        ],
        [expected; 11]
    );
}

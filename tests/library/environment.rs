//! Threads whose float modes differ from IEEE 754. This program runs itself with a preloaded library that sets them.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use stackless_bvh::bvh::wide::WideOptions;
use stackless_bvh::bvh::{BuildError, BuildOptions, Bvh, SahOptions, WideBvh, WideError};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{
    AffineMap, Ball, Ends, EnvironmentError, ExactPoint, ExactRay, Mesh, Ray, RayError, check_environment,
};
use stackless_bvh::glam::Vec3;
use stackless_bvh::trace::{Assembly, BinaryTracer, Instance, MeshQueries, Object, RayQueries, Tracer};

/// Bits of the control register, and the resulting error.
const MODES: [(&str, Result<(), EnvironmentError>); 6] = [
    ("0", Ok(())),
    // Results below the least normal number become zero, or such arguments do.
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

/// Runs one of the tests below with these bits, on its thread, the next one, or all remaining threads.
fn run(library: &Path, test: &str, bits: &str) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", test, "--ignored"]).env("LD_PRELOAD", library).env("FLOATS", bits);
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("1 passed"), "{test} {bits}: {text}");
}

fn compiled() -> Option<PathBuf> {
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/library/floats.c");
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join("floats.so");
    let flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-O1", "-shared", "-fPIC", source, "-o"];
    let output = Command::new("cc").args(flags).arg(&library).output().ok()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(library)
}

/// Returns the effect of bits that are set for one of the threads.
fn expected(thread: usize) -> Result<(), EnvironmentError> {
    let bits = std::env::var("FLOATS").unwrap();
    let bits = bits.split(' ').nth(thread).unwrap();
    MODES.into_iter().find(|(mode, _)| *mode == bits).unwrap().1
}

/// Builds an object on the current thread.
type Make = fn(&Well) -> Result<(), String>;

/// Objects built on a valid thread.
struct Well {
    mesh: Mesh,
    bvh: Bvh,
    wide: WideBvh,
    point: ExactPoint,
    assembly: (Assembly, Object),
    /// As bytes.
    stored: [Vec<u8>; 2],
}

impl Well {
    fn new() -> Self {
        let mesh = procedural::soup(1, 100);
        let (bvh, wide) = (Bvh::build(&mesh).unwrap(), WideBvh::build(&mesh).unwrap());
        let stored = [bvh.to_bytes(), wide.to_bytes()];
        let mut assembly = Assembly::new();
        let object = assembly.add_mesh(bvh.clone());
        Self { mesh, bvh, wide, point: ExactPoint::new(Vec3::ONE).unwrap(), assembly: (assembly, object), stored }
    }
}

/// Returns the message of an error. All errors pass that of the environment through.
fn told<A, E: ToString>(made: Result<A, E>) -> Result<(), String> {
    made.map(drop).map_err(|error| error.to_string())
}

/// Functions that build objects from numbers, and must fail on an invalid thread: constructors by file, then methods.
const CHECKED: [(&str, Make); 25] = [
    ("bvh/build/mod.rs: median", |well| told(Bvh::median(&well.mesh, 2))),
    ("bvh/build/mod.rs: sah", |well| told(Bvh::sah(&well.mesh, SahOptions::default()))),
    ("bvh/build/mod.rs: build", |well| told(Bvh::build(&well.mesh))),
    ("bvh/bytes.rs: from_bytes", |well| told(<Bvh>::from_bytes(&well.stored[0]))),
    ("bvh/wide/bytes.rs: from_bytes", |well| told(WideBvh::<8>::from_bytes(&well.stored[1]))),
    ("bvh/wide/collapse.rs: build", |well| told(WideBvh::<8>::build(&well.mesh))),
    ("bvh/wide/collapse.rs: of", |well| told(WideBvh::<8>::of(&well.bvh))),
    ("bvh/wide/collapse.rs: with_options", |well| told(WideBvh::<8>::with_options(&well.bvh, &WideOptions::default()))),
    ("geom/affine.rs: new", |_| told(AffineMap::<f32>::new(*AffineMap::IDENTITY.rows()))),
    ("geom/affine.rs: translation", |_| told(AffineMap::translation(Vec3::ONE))),
    ("geom/ball.rs: around", |_| told(Ball::around(Vec3::ZERO))),
    ("geom/ball.rs: new", |_| told(Ball::new(Vec3::ZERO, 1.0))),
    ("geom/exact_ray.rs: new", |_| told(ExactPoint::new(Vec3::ZERO))),
    ("geom/mesh.rs: new", |well| told(Mesh::new(well.mesh.vertices().to_vec(), well.mesh.triangles().to_vec()))),
    ("geom/ray.rs: collect", |_| {
        let rays = Ray::collect([(Vec3::ZERO, Vec3::X, 0.0, 1.0)]);
        told(rays.map_err(|(_, error)| error))
    }),
    ("geom/ray.rs: new", |_| told(Ray::new(Vec3::ZERO, Vec3::X))),
    ("geom/ray.rs: within", |_| told(Ray::within(Vec3::ZERO, Vec3::X, 0.0, 1.0))),
    ("trace/binary.rs: of", |well| told(<BinaryTracer>::of(&well.mesh))),
    ("trace/tracer.rs: of", |well| told(Tracer::of(&well.mesh))),
    ("ExactPoint::toward", |well| told(well.point.toward(&well.point, Ends::Open).or_else(of_same_point))),
    ("Assembly::add_group", |well| {
        let (mut assembly, object) = well.assembly.clone();
        let instances = vec![Instance { object, affine: AffineMap::IDENTITY }];
        told(assembly.add_group(instances, &BuildOptions::default()))
    }),
    ("Bvh::refit", |well| told(well.bvh.clone().refit(&well.mesh))),
    ("WideBvh::refit", |well| told(well.wide.clone().refit(&well.mesh))),
    ("WideBvh::optimize", |well| told(well.wide.clone().optimize())),
    ("Tracer::closest_parallel", |well| told(Tracer::new(&well.wide).closest_parallel(&[]))),
];

/// The error of equal points is detected after that of the thread.
fn of_same_point(error: RayError) -> Result<ExactRay, RayError> {
    if error == RayError::ZeroDirection { Ok(ExactRay::from(&Ray::new(Vec3::ZERO, Vec3::X)?)) } else { Err(error) }
}

/// Constructors without a check, and the reasons.
const UNCHECKED: &[(&str, &[&str])] = &[
    (
        "prepares what it is given for queries: a ray or a ball, or a hierarchy or a mesh, all of which are checked",
        &[
            "geom/enclosed_ray.rs: exact",
            "geom/exact_ray.rs: met",
            "geom/kernel/exact/enclosed.rs: new",
            "geom/lanes/block.rs: of",
            "geom/lanes/boxes.rs: new",
            "geom/lanes/enclosed.rs: new",
            "geom/lanes/leaf.rs: new",
            "geom/lanes/leaf.rs: none",
            "geom/lanes/triangles.rs: enclosed",
            "geom/lanes/triangles.rs: new",
            "geom/slabs/enclosed.rs: of",
            "trace/binary.rs: new",
            "trace/binary.rs: planned",
            "trace/binary.rs: with_method",
            "trace/binary.rs: with_tests",
            "trace/boundary.rs: of",
            "trace/continuation.rs: new",
            "trace/crossings.rs: new",
            "trace/kernel_bvhs.rs: new",
            "trace/instances.rs: new",
            "trace/instances.rs: with_methods",
            "trace/nearest.rs: new",
            "trace/nearest/several.rs: new",
            "trace/next.rs: new",
            "trace/plan.rs: new",
            "trace/plan.rs: wide",
            "trace/search.rs: new",
            "trace/solid.rs: new",
            "trace/tracer.rs: new",
            "trace/tracer.rs: with_method",
            "trace/truth.rs: new",
            "trace/winding.rs: new",
        ],
    ),
    (
        "is arithmetic on numbers, as a sum is: a part of what the checked ones do, for callers who check for themselves",
        &[
            "geom/aabb.rs: of",
            "geom/frame.rs: around",
            "geom/lanes/point.rs: new",
            "geom/nearest.rs: new",
            "geom/nearest.rs: within",
            "geom/nearest/foot.rs: of",
            "geom/region.rs: of",
            "geom/region.rs: within",
        ],
    ),
    (
        "computes nothing with floats",
        &[
            "bvh/build/mod.rs: fine",
            "bvh/wide/mod.rs: empty",
            "geom/enclosed_ray.rs: new",
            "geom/frame.rs: new",
            "geom/interval.rs: between",
            "geom/interval.rs: exact",
            "geom/kernel/exact/accumulator.rs: new",
            "trace/instances/assembly.rs: new",
            "trace/plan/choice.rs: for_needs",
            "trace/query.rs: over",
        ],
    ),
];

/// Every new constructor is either checked and tested by `entrances_refuse`, or listed with a reason. `[ENV-1]`
#[test]
fn all_constructors_are_known() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let mut found = BTreeSet::new();
    for module in ["geom", "bvh", "trace"] {
        collect(&source.join(module), &source, &mut found);
    }
    let checked = CHECKED.iter().map(|(name, _)| *name).filter(|name| name.contains(".rs: "));
    let known: BTreeSet<_> = checked.chain(UNCHECKED.iter().flat_map(|(_, names)| *names).copied()).collect();
    let found: BTreeSet<_> = found.iter().map(String::as_str).collect();
    assert!(found.is_subset(&known), "not known: {:?}", found.difference(&known));
    assert!(known.is_subset(&found), "not there: {:?}", known.difference(&found));
}

/// Collects the public functions in a folder that take no `self` and return one.
fn collect(folder: &Path, source: &Path, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, source, found);
            continue;
        }
        let file = path.strip_prefix(source).unwrap().display().to_string();
        let text = std::fs::read_to_string(&path).unwrap();
        for function in text.split("\n    pub ").skip(1).filter(|_| !file.ends_with("tests.rs")) {
            let head = function.split('{').next().unwrap_or_default();
            let Some((_, head)) = head.split_once("fn ") else { continue };
            let (Some((name, rest)), Some((_, result))) = (head.split_once(['(', '<']), head.rsplit_once("->")) else {
                continue;
            };
            let takes_self = rest.split([',', ')']).next().is_some_and(|first| first.contains("self"));
            let gives_self = ["Self", "Bvh<P::Shape>", "Result<Object"].iter().any(|made| result.contains(made));
            if gives_self && !takes_self {
                found.insert(format!("{file}: {name}"));
            }
        }
    }
}

/// Checks the objects that the current thread builds.
#[test]
#[ignore = "`unfit_threads_are_refused` runs it with bits set"]
fn entrances_refuse() {
    let expected = expected(0);
    assert_eq!(check_environment(), expected);
    // Built by another, valid thread.
    let well = std::thread::scope(|scope| scope.spawn(Well::new).join().unwrap());
    let expected = expected.map_err(|error| error.to_string());
    for (name, make) in CHECKED {
        assert_eq!(make(&well), expected, "{name}");
    }
}

/// Checks the work that other threads do, if those are invalid.
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

//! The worst known cases, in `tests/data/worst`. Each file has the name of the most expensive traversal or of the
//! failing test, and the count. Traversals agree with their oracle on the trees, and the exact tests with rational
//! arithmetic on the rays.

use std::fs;
use std::path::{Path, PathBuf};

use glam::Vec3;
use serde_json::Value;
use stackless_bvh::generate::stress::StressCase;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::{KernelName, SlabsName};
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{Battery, Replay, Stress, Verdict};

/// Returns the name and path of each file.
fn files() -> impl Iterator<Item = (String, PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/worst");
    let paths = fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("a file").path());
    paths.map(|path| (path.file_stem().expect("a name").to_string_lossy().into_owned(), path))
}

/// Reads a file of triangles and rays; `None` for a tree.
fn rays(path: &Path) -> Option<StressCase> {
    let value: Value = serde_json::from_str(&fs::read_to_string(path).expect("a text")).expect("JSON");
    let triangles: Vec<[[f32; 3]; 3]> = serde_json::from_value(value.get("triangles")?.clone()).expect("triangles");
    let rays: Vec<[[f32; 3]; 2]> = serde_json::from_value(value["rays"].clone()).expect("rays");
    let corners = triangles.as_flattened().iter().copied().map(Vec3::from).collect();
    let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = Mesh::new(corners, indices).expect("a mesh");
    let rays = rays.iter().map(|&[origin, direction]| Ray::new(origin.into(), direction.into()).expect("a ray"));
    Some(StressCase { name: "worst", about: "found by a search", mesh, rays: rays.collect(), closed: false })
}

/// [CONF-1]
#[test]
fn all_traversals_agree_on_the_worst_trees() {
    let mut trees = 0;
    for (name, path) in files().filter(|(_, path)| rays(path).is_none()) {
        trees += 1;
        let case = Replay::load(&path).expect("a replay").case().expect("a case");
        let mut battery = Battery::new(&case, &Method::ALL);
        for method in Method::ALL {
            for word in WordName::ALL {
                let verdict = battery.check(method, word);
                assert!(!matches!(verdict, Verdict::Differs(_)), "{name}: {method} {word}: {verdict:?}");
            }
        }
    }
    assert_eq!(trees, 14);
}

/// The exact tests are right, and the test in the file's name fails. [CONF-2] [EXACT-1]
#[test]
fn only_the_exact_tests_are_right_about_the_worst_rays() {
    let [mut cases, mut wrong] = [0; 2];
    for (name, case) in files().filter_map(|(name, path)| Some((name, rays(&path)?))) {
        cases += 1;
        let stress = Stress::new(&case).expect("a hierarchy");
        let errors = |tests| stress.run(tests, &Method::ALL).expect("a depth that u64 carries");
        for kernel in [KernelName::Exact, KernelName::ExactFromSingle] {
            let errors = errors((kernel, SlabsName::Directed));
            assert!(errors.is_none() && errors.rays > 0, "{name}: {kernel}: {errors:?}");
        }
        let kernel = KernelName::ALL.into_iter().find(|kernel| name.ends_with(kernel.name()));
        let tests = kernel.map(|kernel| (kernel, SlabsName::Directed));
        for tests in tests.into_iter().chain((name == "boxes-plain").then_some((KernelName::Exact, SlabsName::Plain))) {
            wrong += 1;
            assert!(!errors(tests).is_none(), "{name}: {tests:?} is right");
        }
    }
    assert_eq!((cases, wrong), (18, 13));
}

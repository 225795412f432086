//! Tests of loading files, and helpers for the tests of the readers.

use super::*;
use glam::DVec3;
use std::fs;
use std::path::PathBuf;

/// A folder for one test, removed at its end.
pub(super) struct Folder(PathBuf);

impl Folder {
    pub(super) fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("stackless-{}-{test}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(super) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).ok();
    }
}

/// `SplitMix64` (Steele, Lea & Flood 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    pub(super) fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }
}

/// Changes, removes and duplicates bytes of a valid file, in every second case only from `body` on. The reader must
/// return a mesh or a one-line message.
pub(super) fn survives_corruption(valid: &[u8], body: usize, format: MeshFormat, seeds: u64) {
    let (mut meshes, mut refusals) = (0, 0);
    for seed in 0..seeds {
        let mut random = Random(seed);
        let mut bytes = valid.to_vec();
        let first = if seed % 2 == 0 { 0 } else { body };
        for _ in 0..=random.below(4) {
            let at = first.min(bytes.len() - 1) + random.below(bytes.len().saturating_sub(first).max(1));
            match random.below(6) {
                0 => bytes.truncate(at + 1),
                1 if bytes.len() > 1 => drop(bytes.remove(at)),
                2 => bytes.insert(at, b"0123456789 -.e\n\\/"[random.below(17)]),
                3 => bytes[at] ^= 1 << random.below(8),
                4 => bytes[at] = [0, 0x7F, 0x80, 0xFF][random.below(4)],
                _ => bytes.extend_from_within(at..),
            }
        }
        match check_mesh_file(&bytes, format) {
            Ok(is_mesh) => *if is_mesh { &mut meshes } else { &mut refusals } += 1,
            Err(fault) => panic!("seed {seed}: {fault}"),
        }
    }
    // Both outcomes must occur often. Otherwise the changes would have no effect, or break every file.
    assert!(meshes > seeds / 50 && refusals > seeds / 50, "{meshes} meshes, {refusals} refusals");
}

fn data(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", "..", "tests", "data", name].iter().collect()
}

fn refusal(path: &Path) -> String {
    load::<Vec3>(path).unwrap_err().to_string()
}

#[test]
fn both_formats_give_the_same_cube() {
    let cube = load::<Vec3>(&data("cube.ply")).unwrap().mesh;
    assert_eq!((cube.vertices().len(), cube.triangles().len()), (8, 12));
    assert_eq!(cube.triangles()[..4], [[0, 3, 2], [0, 2, 1], [4, 5, 6], [4, 6, 7]]);
    assert_eq!(load::<Vec3>(&data("cube.obj")).unwrap().mesh, cube);
}

#[test]
fn the_extension_may_be_in_capitals_and_must_be_known() {
    let folder = Folder::new("extension");
    for name in ["cube.PLY", "cube.Obj"] {
        fs::copy(data(&name.to_lowercase()), folder.file(name)).unwrap();
        assert_eq!(load::<Vec3>(&folder.file(name)).unwrap().mesh, load::<Vec3>(&data("cube.ply")).unwrap().mesh);
    }
    for (name, found) in [
        ("a.off", "extension \"off\""),
        ("a.ply.gz", "extension \"gz\""),
        ("ply", "no extension"),
        (".ply", "no extension"),
        ("a.", "extension \"\""),
    ] {
        assert_eq!(refusal(name.as_ref()), format!("{name}: {found}, expected .ply, .obj, .stl, .gltf or .glb"));
    }
}

#[test]
fn an_unreadable_file_is_named() {
    let folder = Folder::new("unreadable");
    let missing = folder.file("missing.ply");
    let begin = format!("{}: cannot be read: ", missing.display());
    assert!(refusal(&missing).starts_with(&begin), "{}", refusal(&missing));

    let directory = folder.file("directory.obj");
    fs::create_dir(&directory).unwrap();
    let begin = format!("{}: cannot be read: ", directory.display());
    assert!(refusal(&directory).starts_with(&begin), "{}", refusal(&directory));
}

#[test]
fn a_message_is_one_line_that_begins_with_the_file() {
    let folder = Folder::new("message");
    let path = folder.file("flat.obj");
    fs::write(&path, "v 0 0 0\nf 1 1\n").unwrap();
    let few = "1 face with fewer than 3 corners was skipped, the first in line 2";
    let message = format!("{}: no triangles, expected at least one; {few}", path.display());
    assert_eq!(refusal(&path), message);
    fs::write(&path, "").unwrap();
    assert_eq!(refusal(&path), format!("{}: no triangles, expected at least one", path.display()));
    assert_eq!(
        refusal("two\nlines.s\nl".as_ref()),
        "two\\nlines.s\\nl: extension \"s\\nl\", expected .ply, .obj, .stl, .gltf or .glb"
    );
}

#[test]
fn coordinates_that_are_rounded_are_counted() {
    let folder = Folder::new("rounded");
    let read = |kind: &str, x: &str| {
        let path = folder.file("mesh.ply");
        let header = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty {kind} x\nproperty {kind} y\nproperty {kind} z\n"
        );
        let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        std::fs::write(&path, format!("{header}{faces}{x} 0 0\n0 {x} 0\n0 0 0.5\n3 0 1 2\n")).unwrap();
        let loaded = load::<Vec3>(&path).unwrap();
        (loaded.rounding.rounded, loaded.note(&path).map(|note| note.replace(&path.display().to_string(), "FILE")))
    };
    let said =
        |count, most| Some(format!("FILE: {count} of 9 numbers were rounded to single precision, by at most {most}"));
    assert_eq!(read("float", "0.1"), (2, said(2, "2.9e-9 of the scene's size")));
    assert_eq!(read("double", "0.25"), (0, None));
    for kind in ["float", "double"] {
        assert_eq!(read(kind, "6400000.1"), (2, said(2, "1.2e-8 of the scene's size")));
        // The file of the last call.
        let double = load::<DVec3>(&folder.file("mesh.ply")).unwrap();
        assert_eq!((double.rounding.rounded, double.mesh.vertices()[0]), (2, DVec3::X * 6_400_000.1));
    }
}

/// The header declares as much data as the sparse file seems to have. No data is read.
#[cfg(unix)]
#[test]
fn a_file_of_holes_costs_nothing() {
    let folder = Folder::new("holes");
    let path = folder.file("holes.ply");
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 2147483647\nproperty float x\nproperty float y\n\
                  property float z\nend_header\n";
    std::fs::write(&path, header).unwrap();
    std::fs::File::options()
        .write(true)
        .open(&path)
        .unwrap()
        .set_len(header.len() as u64 + 12 * 2_147_483_647)
        .unwrap();
    let error = load::<Vec3>(&path).unwrap_err();
    assert!(matches!(error, SceneError::Size { .. }), "{error}");
    assert!(error.to_string().contains("holes.ply: more than 4294967296 bytes"), "{error}");
}

/// A file without a size is read up to the limit.
#[cfg(unix)]
#[test]
fn an_endless_file_ends() {
    assert_eq!(read_bytes(Path::new("/dev/zero"), 1000).unwrap(), None);
    assert_eq!(read_bytes(Path::new("/dev/null"), 1000).unwrap(), Some(Vec::new()));
}

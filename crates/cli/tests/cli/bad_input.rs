//! Bad input: exit code 2, one line with the place of the error, and no output files.

use std::path::Path;

use super::support::{Folder, data, stackless};

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                      element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const CORNERS: &str = "0 0 0\n1 0 0\n0 1 0\n";
const RAY: &str = "0,0,-1,0,0,1,0,inf\n";

/// Invalid mesh files, and texts that the error must contain.
fn meshes() -> Vec<(&'static str, Vec<u8>, Vec<&'static str>)> {
    let ply = |body: &str| format!("{HEADER}{body}").into_bytes();
    let header = |from: &str, to: &str| format!("{}{CORNERS}3 0 1 2\n", HEADER.replace(from, to)).into_bytes();
    let binary = |bytes: usize| {
        let mut file = HEADER.replace("ascii", "binary_little_endian").into_bytes();
        for number in [0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            file.extend(number.to_le_bytes());
        }
        file.push(3);
        file.extend([0_i32, 1, 2].iter().flat_map(|index| index.to_le_bytes()));
        file.truncate(file.len() - bytes);
        file
    };
    vec![
        ("empty.ply", vec![], vec!["line 1"]),
        ("garbage.ply", vec![0xff; 300], vec!["line 1"]),
        ("header.ply", HEADER.replace("end_header\n", "").into_bytes(), vec!["line 8", "ends"]),
        ("body.ply", ply("0 0 0\n1 0 0\n"), vec!["vertex 2 (of 3)", "ends"]),
        ("vertex.ply", ply("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), vec!["line 11", "vertex 1 (of 3)"]),
        ("face.ply", ply(CORNERS), vec!["face 0 (of 1)", "ends"]),
        ("binary.ply", binary(1), vec!["face 0 (of 1)", "ends"]),
        ("binary_vertex.ply", binary(14), vec!["vertex 2 (of 3)", "ends"]),
        ("nan.ply", ply("0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), vec!["line 11", "vertex 1", "coordinate y"]),
        ("inf.ply", ply("0 0 0\n1 0 0\n0 1 -inf\n3 0 1 2\n"), vec!["line 12", "vertex 2", "coordinate z"]),
        ("great.ply", ply("0 0 0\n1e309 0 0\n0 1 0\n3 0 1 2\n"), vec!["line 11", "coordinate x"]),
        ("index.ply", ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), vec!["line 13", "face 0", "vertex index 3"]),
        ("negative.ply", ply("0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n"), vec!["line 13", "face 0", "-1"]),
        (
            "two.ply",
            ply("0 0 0\n1 0 0\n0 1 0\n2 0 1\n"),
            vec!["no triangles", "fewer than 3 corners", "line 13, face 0"],
        ),
        ("no_faces.ply", header("element face 1", "element face 0"), vec!["after the last element"]),
        ("vertices.ply", header("vertex 3", "vertex 4000000000000"), vec!["line 3", "4000000000000"]),
        ("faces.ply", header("face 1", "face 18446744073709551615"), vec!["line 7", "18446744073709551615"]),
        ("more.ply", header("face 1", "face 99999999999999999999999"), vec!["line 7"]),
        ("list.ply", ply("0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"), vec!["line 13", "face 0"]),
        ("empty.obj", vec![], vec!["no triangles"]),
        ("vertices.obj", b"v 0 0 0\nv 1 0 0\n".to_vec(), vec!["no triangles"]),
        ("nan.obj", b"v 0 0 0\nv 1 NaN 0\nf 1 2 1\n".to_vec(), vec!["line 2"]),
        ("index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n".to_vec(), vec!["line 4", "4"]),
        ("zero.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n".to_vec(), vec!["line 4", "0"]),
        ("back.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n".to_vec(), vec!["line 4", "-4"]),
        (
            "two.obj",
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2\n".to_vec(),
            vec!["no triangles", "fewer than 3 corners", "line 5"],
        ),
        ("cut.obj", b"v 0 0 0\nv 1 0\n".to_vec(), vec!["line 2"]),
        ("cut.stl", b"solid\nfacet\nouter loop\nvertex 0 0 0\n".to_vec(), vec!["line 4", "the file ends"]),
        ("short.stl", vec![0; 83], vec!["line 1", "expected solid, or 80 bytes"]),
        ("many.stl", vec![0xff; 84], vec!["triangle 0 (of 4294967295)", "the file ends"]),
        ("cut.gltf", b"{\"asset\":".to_vec(), vec!["line 1: column 9: EOF while parsing a value"]),
        ("cut.glb", b"glTF\x02\0\0\0\0\0\0\0".to_vec(), vec!["the document", "12 bytes"]),
        ("mesh.off", b"OFF\n".to_vec(), vec!["\"off\"", ".ply, .obj"]),
        ("mesh", b"v 0 0 0\n".to_vec(), vec![".ply, .obj"]),
    ]
}

/// Runs `trace` with a new and with an existing output, and checks the files.
fn trace_must_fail(mesh: &Path, rays: &Path, naming: &[&str]) {
    let folder = Folder::new();
    let (new, old) = (folder.path("new.csv"), folder.file("old.csv", "what was there"));
    for out in [&new, &old] {
        stackless("trace", &[mesh, Path::new("--rays"), rays, Path::new("-o"), out]).fails_naming(naming);
    }
    assert_eq!(folder.names(), ["old.csv"]);
    assert_eq!(std::fs::read_to_string(&old).unwrap(), "what was there");
}

fn check_must_fail(mesh: &Path, naming: &[&str]) {
    let folder = Folder::new();
    // The good scene is not checked before the bad scene fails.
    let cube = data("cube.ply");
    stackless("check --json", &[&folder.path("new.json"), &cube, mesh]).fails_naming(naming);
    stackless("bench --json", &[&folder.path("new.json"), &cube, mesh]).fails_naming(naming);
    assert!(folder.names().is_empty());
}

#[test]
fn what_is_not_a_mesh() {
    let folder = Folder::new();
    let rays = folder.file("rays.csv", RAY);
    for (name, content, mut naming) in meshes() {
        let mesh = folder.file(name, content);
        naming.push(name);
        trace_must_fail(&mesh, &rays, &naming);
        check_must_fail(&mesh, &naming);
    }
    for name in ["missing.ply", "missing.obj"] {
        trace_must_fail(&folder.path(name), &rays, &[name, "cannot be read"]);
        check_must_fail(&folder.path(name), &[name, "cannot be read"]);
    }
    std::fs::create_dir(folder.path("folder.ply")).unwrap();
    trace_must_fail(&folder.path("folder.ply"), &rays, &["folder.ply", "cannot be read"]);
    // Valid input succeeds, so the failures are not caused by this test.
    let mesh = folder.file("good.ply", format!("{HEADER}{CORNERS}3 0 1 2\n"));
    stackless("trace -o", &[&folder.path("out.csv"), &mesh, Path::new("--rays"), &rays]).passes();
    stackless("check --count 10", &[&mesh]).passes();
}

#[test]
fn what_are_no_rays() {
    let folder = Folder::new();
    let (cube, names) = (data("cube.ply"), "ox,oy,oz,dx,dy,dz,tmin,tmax\n");
    let with_names = |line: &str| format!("{names}{RAY}{line}\n{RAY}");
    for (text, naming) in [
        (String::new(), "no rays"),
        (names.to_owned(), "no rays"),
        ("# only a comment\n\n".to_owned(), "no rays"),
        (with_names("0,0,-1,0,0,0,0,inf"), "line 3: direction is zero"),
        (with_names("0,0,-1,0,-0.0,1e-400,0,inf"), "line 3: direction is zero"),
        (with_names("nan,0,-1,0,0,1,0,inf"), "line 3: column ox"),
        (with_names("0,0,-1,0,0,NaN,0,inf"), "line 3: column dz"),
        (with_names("0,0,-1,inf,0,1,0,inf"), "line 3: column dx"),
        (with_names("0,0,-1,0,0,1,0,nan"), "line 3: column tmax"),
        (with_names("0,0,-1,0,0,1,inf,inf"), "line 3: column tmin"),
        (with_names("0,0,-1,0,0,1,2,1"), "line 3: tmin 2"),
        (with_names("0,0,-1,0,0,1,-1,1"), "line 3: tmin -1"),
        (with_names("0,0,-1,0,0,1,0"), "line 3: 7 columns"),
        (with_names("0,0,-1,0,0,1,0,1,"), "line 3: 9 columns"),
        (with_names("0,0,-1,0,,1,0,1"), "line 3: column dy"),
        (with_names("0,0,-1,0,zero,1,0,1"), "line 3: column dy"),
        (with_names(names.trim()), "line 3"),
    ] {
        let rays = folder.file("rays.csv", text);
        trace_must_fail(&cube, &rays, &["rays.csv: ", naming]);
    }
    trace_must_fail(&cube, &folder.path("missing.csv"), &["missing.csv", "cannot be read"]);
}

#[test]
fn an_output_that_cannot_be_written() {
    let folder = Folder::new();
    let (cube, rays, out) = (data("cube.ply"), folder.file("rays.csv", RAY), folder.path("missing/out.csv"));
    let run = stackless("trace -o", &[&out, &cube, Path::new("--rays"), &rays]);
    run.fails_naming(&["missing/out.csv", "cannot be written"]);
    let run = stackless("check --trees 1 --method stack --json", &[&out]);
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.stderr.starts_with("error: ") && run.stderr.lines().count() == 1, "{run:?}");
    assert!(run.stderr.contains("missing/out.csv"), "{run:?}");
    assert_eq!(folder.names(), ["rays.csv"]);
}

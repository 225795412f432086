//! Small files, one for each feature and each mistake of the formats, with the expected mesh or message.

use std::path::Path;

use glam::DVec3;
use stackless_scene::{Loaded, MeshFormat, check_mesh_file, load};

/// The mesh or the message for each file in `files`. `UPDATE=1` writes it.
const OUTCOMES: &str = include_str!("files.txt");

/// Describes the corners of each triangle, the faces unless they equal the triangles, the parts and the notes.
fn describe(loaded: &Loaded<DVec3>) -> Vec<String> {
    let corners = |i| loaded.mesh.triangle(i).map(|DVec3 { x, y, z }| format!("{x},{y},{z}")).join(" ");
    let mut lines: Vec<_> = (0..loaded.mesh.triangles().len()).map(corners).collect();
    if loaded.faces.iter().enumerate().any(|(i, face)| i != *face as usize) {
        lines.push(format!("faces {:?}", loaded.faces));
    }
    lines.extend(loaded.parts.iter().map(|part| format!("from triangle {} on: {:?}", part.first, part.name)));
    let note = loaded.note("note".as_ref());
    lines.extend(note.iter().flat_map(|note| note.split("; ")).map(str::to_owned));
    lines
}

fn outcome(path: &Path) -> Vec<String> {
    match load::<DVec3>(path) {
        Ok(loaded) => describe(&loaded),
        Err(error) => vec![error.to_string().replace(&path.display().to_string(), "refused")],
    }
}

#[test]
fn every_kind_of_file_is_read_or_refused_with_the_reason() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let mut paths: Vec<_> =
        std::fs::read_dir(tests.join("files")).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let mut found = Vec::new();
    for path in paths {
        let name = path.file_name().unwrap().to_str().unwrap();
        found.push(format!("{name}\n  {}\n", outcome(&path).join("\n  ")));
        let format = match path.extension().unwrap().to_str() {
            Some("ply") => MeshFormat::Ply,
            Some("obj") => MeshFormat::Obj,
            Some("stl") => MeshFormat::Stl,
            _ => MeshFormat::Gltf,
        };
        check_mesh_file(&std::fs::read(&path).unwrap(), format).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    }
    let found = found.concat();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(tests.join("files.txt"), found).unwrap();
        return;
    }
    for (found, expected) in found.lines().zip(OUTCOMES.lines()) {
        assert_eq!(found, expected);
    }
    assert_eq!(found.len(), OUTCOMES.len());
}

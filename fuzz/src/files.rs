//! Targets of the readers of text.

use arbitrary::Unstructured;
use stackless_bvh::traverse::Method;
use stackless_check::{Case, Replay};
use stackless_scene::{MeshFormat, check_mesh_file, check_row_file};

use super::draw::patched;
use super::{right, said, traversals};

/// Reads a PLY file.
pub(crate) fn ply(bytes: &[u8]) {
    mesh(bytes, MeshFormat::Ply);
}

/// Reads an OBJ file.
pub(crate) fn obj(bytes: &[u8]) {
    mesh(bytes, MeshFormat::Obj);
}

/// Reads an STL file.
pub(crate) fn stl(bytes: &[u8]) {
    mesh(bytes, MeshFormat::Stl);
}

/// Reads a glTF file.
pub(crate) fn gltf(bytes: &[u8]) {
    mesh(bytes, MeshFormat::Gltf);
}

fn mesh(bytes: &[u8], format: MeshFormat) {
    right(check_mesh_file(bytes, format), bytes.escape_ascii());
}

/// Reads a file of rays.
pub(crate) fn rays(bytes: &[u8]) {
    right(check_row_file(bytes), bytes.escape_ascii());
}

/// Reads a case as JSON: any text, or a changed valid case. An accepted case is valid and survives a round trip.
pub(crate) fn replay(bytes: &[u8]) {
    let text = if bytes.first() == Some(&b'{') {
        bytes.to_vec()
    } else {
        let mut source = Unstructured::new(bytes);
        let case = Case::draw(&mut source, 6);
        patched(&mut source, text(&case).into_bytes())
    };
    let Ok(replay) = serde_json::from_slice::<Replay>(&text) else { return };
    let case = match (replay.case(), replay.methods(), replay.words()) {
        (Ok(case), Ok(_), Ok(_)) => case,
        (case, methods, words) => {
            return case.err().into_iter().chain(methods.err()).chain(words.err()).for_each(said);
        }
    };
    let back = serde_json::from_str::<Replay>(&self::text(&case)).map(|replay| replay.case());
    assert!(matches!(&back, Ok(Ok(back)) if *back == case), "{back:?} instead of {case:?}");
    if case.size() <= 64 {
        traversals::check(&case, &Method::ALL);
    }
}

fn text(case: &Case) -> String {
    let replay = Replay {
        children: case.tree.to_children(),
        cells: case.tape.cells().to_vec(),
        any: case.any,
        octant: case.octant,
        methods: Vec::new(),
        word: None,
        fault: None,
    };
    right(serde_json::to_string(&replay), "JSON")
}

use super::*;
use glam::Vec3;

const TEXT: &str = "solid two\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n \
                    endfacet\n facet normal 0 0 1\n  outer loop\n   vertex 1 0 0\n   vertex 1 1 0\n   vertex -0 1 0\n  \
                    endloop\n endfacet\nendsolid two\n";

/// Encodes the two triangles of `TEXT` in binary.
fn binary(header: &str) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, 0);
    bytes.extend(2_u32.to_le_bytes());
    for corners in [[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [1.0, 1.0], [-0.0, 1.0]]] {
        let numbers = [0.0, 0.0, 1.0].into_iter().chain(corners.into_iter().flat_map(|[x, y]| [x, y, 0.0]));
        bytes.extend(numbers.flat_map(|number: f32| number.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

#[test]
fn texts_and_binary_files_hold_the_same_triangles() {
    let nameless = TEXT.replace(" two", "");
    let several =
        TEXT.replace(" facet normal 0 0 1\n  outer loop\n   vertex 1", "endsolid\nsolid\nfacet\nouter loop\nvertex 1");
    for bytes in [TEXT.into(), nameless.into(), several.into(), binary("anything"), binary("solid which is none\n")] {
        let mesh = read_stl::<Vec3>(&bytes).unwrap().mesh;
        assert_eq!(mesh.triangles(), [[0, 1, 2], [1, 3, 2]], "{}", bytes.escape_ascii());
        assert_eq!(mesh.vertices(), [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)]);
    }
}

#[test]
fn what_is_cut_or_wrong_is_refused_where_it_is() {
    for (good, is_text) in [(TEXT.as_bytes().to_vec(), true), (binary("x"), false), (binary("solid"), false)] {
        for end in 0..good.len() {
            let read = read_stl::<Vec3>(&good[..end]);
            // Truncated text may lack the name after its last word. Truncated numbers do not occur in this file.
            assert!(read.is_err() || is_text && end >= TEXT.find("endsolid").unwrap() + "endsolid".len(), "{end}");
        }
    }
    let refusal = |bytes: &[u8]| read_stl::<Vec3>(bytes).unwrap_err().to_string();
    assert_eq!(refusal(b""), "line 1: found 0 bytes, expected solid, or 80 bytes and the number of triangles");
    let mut many = binary("x");
    many[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(refusal(&many), "triangle 2 (of 4294967295): the file ends, expected more triangles");
    many[80..84].copy_from_slice(&1_u32.to_le_bytes());
    let loaded = read_stl::<Vec3>(&many).unwrap();
    assert_eq!(loaded.mesh.triangles().len(), 1);
    let said = "50 bytes after the last triangle were skipped, the first at byte 134";
    assert_eq!(loaded.notes.iter().map(ToString::to_string).collect::<Vec<_>>(), [said]);
    for (from, to, message) in [
        ("vertex 1 1 0", "vertex 1 1", "line 12: found the end of the line, expected 3 coordinates"),
        (
            "vertex 1 1 0",
            "vertex 1 nan 0",
            "line 12: coordinate y is NaN, expected a finite number in single precision",
        ),
        ("vertex 1 1 0", "vertex 1 1 0 0", "line 12: found \"0\", expected the end of the line"),
        ("  endloop", "  vertex 0 0 0", "line 7: found \"vertex\", expected endloop"),
        ("endsolid two", "", "line 16: the file ends, expected facet or endsolid"),
    ] {
        assert_eq!(refusal(TEXT.replacen(from, to, 1).as_bytes()), message);
    }
}

/// A file with a binary length is never treated as text with other line ends, even if it looks like text.
#[test]
fn a_binary_file_may_look_like_a_text() {
    let mut bytes = b"solid".to_vec();
    bytes.resize(HEADER - 4, b' ');
    bytes.extend(1_u32.to_le_bytes());
    bytes.extend([b'1'; TRIANGLE]);
    assert!(bytes.is_ascii() && !is_text(&bytes));
    assert_eq!(crate::check_mesh_file(&bytes, crate::MeshFormat::Stl), Ok(true));
    let text = b"solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    assert_eq!(crate::check_mesh_file(text, crate::MeshFormat::Stl), Ok(true));
}

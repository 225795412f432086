use crate::ply::tests::{QUAD, refusal};

#[test]
fn a_bad_header_is_named_by_its_line() {
    let huge = "element vertex 4000000000";
    let cases = [
        ("ply", "PLY", "line 1: found \"PLY\", expected \"ply\""),
        ("ascii", "ebcdic", "line 2: found \"ebcdic\", expected ascii, binary_little_endian or binary_big_endian"),
        ("1.0", "2.0", "line 2: found \"format ascii 2.0\", expected a statement of a PLY 1.0 header"),
        (
            "format ascii 1.0",
            "",
            "line 9: found no format, expected one of ascii, binary_little_endian, \
            binary_big_endian",
        ),
        ("element vertex 4", "format ascii 1.0", "line 3: found \"format ascii 1.0\", expected one format only"),
        ("element vertex 4", "", "line 4: found \"property float x\", expected an element before its properties"),
        ("element vertex", "element vertices", "line 9: found the end of the header, expected element vertex"),
        ("element face", "element faces", "line 9: found the end of the header, expected element face or tristrips"),
        ("element face", "element vertex", "line 7: found a second element vertex, expected one only"),
        ("element vertex 4", "element vertex -4", "line 3: found \"-4\", expected a count up to 2147483647"),
        ("element vertex 4", huge, "line 3: found \"4000000000\", expected a count up to 2147483647"),
        (
            "element vertex 4",
            "element vertex",
            "line 3: found \"element vertex\", expected a statement of a PLY 1.0 \
            header",
        ),
        ("float z", "float w", "line 9: found the end of the header, expected scalar property z of element vertex"),
        (
            "float y",
            "list uchar float y",
            "line 9: found the end of the header, expected scalar property y of \
            element vertex",
        ),
        ("float z", "float y", "line 6: found a second property y, expected one only"),
        ("float z", "real z", "line 6: found \"real\", expected a type such as uchar, int or float"),
        ("uchar int", "uchar bool", "line 8: found \"bool\", expected a type such as uchar, int or float"),
        (
            "vertex_index",
            "corners",
            "line 9: found the end of the header, expected list property vertex_indices or \
            vertex_index of element face",
        ),
        ("end_header", "end_headers", "line 9: found \"end_headers\", expected a statement of a PLY 1.0 header"),
        (
            "1.0",
            "1.0 \u{7}and much more than fits into a line, even into a long one of a message",
            "line 2: found \"format ascii 1.0 \\u{7}and much \
            more than fits into a line, even into a long one of a\"..., expected a statement of a PLY 1.0 header",
        ),
    ];
    for (old, new, message) in cases {
        assert_eq!(refusal(QUAD.replacen(old, new, 1)), message);
    }
    assert_eq!(refusal(""), "line 1: found \"\", expected \"ply\"");
    let end = QUAD.find("end_header").unwrap();
    assert_eq!(refusal(&QUAD[..end]), "line 8: the file ends, expected \"end_header\"");
}

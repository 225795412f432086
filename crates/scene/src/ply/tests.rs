use super::*;
use crate::MeshFormat;
use crate::tests::survives_corruption;
use glam::Vec3;
use stackless_bvh::geom::Mesh;

/// All features of a header: other elements before, between and after, skipped scalars and lists, all lengths of type
/// names, polygons, a degenerate face and an unused vertex.
const RICH: &str = "ply
format ascii 1.0
comment made by hand
obj_info nothing
element camera 1
property list uchar float matrix
property double fov
element marker 5
element vertex 6
property uchar red
property double z
property float32 x
property list short uint16 bones
property float64 y
element edge 2
property int32 a
property uint8 b
element face 4
property int8 flags
property list uint16 uint32 vertex_indices
property list uchar double texcoord
element tail 1
property ushort last
end_header
3 1.5 -2 1e-3 0.25
255 0.5 1 0 -1
0 0.5 2 2 7 65535 -1
1 0.5 3 1 9 0.1
2 -1e-50 4 0 1e-46
3 16777217 5 0 1.000000059604644775390625
4 0 6 0 0
-7 200
8 0
-1 3 0 1 2 0
0 5 4 3 2 1 0 2 0.5 0.25
127 3 1 1 2 0
1 4 0 1 2 4 1 1
65535
";

pub(super) const QUAD: &str = "ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_index
end_header
0 0 0
1 0 0
1 1 0
0 1 0.5
4 0 1 2 3
3 0 1 2
";

/// Converts the body of the file to binary.
fn encode(ascii: &str, big_endian: bool) -> Vec<u8> {
    let name = if big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let (header, body) = ascii.split_once("end_header\n").unwrap();
    let mut bytes = format!("{}end_header\n", header.replace("ascii", name)).into_bytes();
    let mut words = body.split_ascii_whitespace();
    let mut put = |scalar: &str| {
        let word = words.next().unwrap();
        let mut number = match scalar {
            "char" | "int8" => word.parse::<i8>().unwrap().to_le_bytes().to_vec(),
            "uchar" | "uint8" => word.parse::<u8>().unwrap().to_le_bytes().to_vec(),
            "short" | "int16" => word.parse::<i16>().unwrap().to_le_bytes().to_vec(),
            "ushort" | "uint16" => word.parse::<u16>().unwrap().to_le_bytes().to_vec(),
            "int" | "int32" => word.parse::<i32>().unwrap().to_le_bytes().to_vec(),
            "uint" | "uint32" => word.parse::<u32>().unwrap().to_le_bytes().to_vec(),
            "float" | "float32" => word.parse::<f32>().unwrap().to_le_bytes().to_vec(),
            _ => word.parse::<f64>().unwrap().to_le_bytes().to_vec(),
        };
        if big_endian {
            number.reverse();
        }
        bytes.extend(number);
        word
    };
    for element in header.split("element ").skip(1) {
        let mut lines = element.lines();
        let (_, count) = lines.next().unwrap().split_once(' ').unwrap();
        let properties: Vec<Vec<&str>> = lines.map(|line| line.split(' ').collect()).collect();
        for _ in 0..count.parse().unwrap() {
            for property in &properties {
                match property[..] {
                    ["property", "list", length, item, _] => {
                        for _ in 0..put(length).parse().unwrap() {
                            put(item);
                        }
                    }
                    ["property", scalar, _] => drop(put(scalar)),
                    _ => {}
                }
            }
        }
    }
    bytes
}

/// Returns the offset of the body.
fn body(bytes: &[u8]) -> usize {
    bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11
}

fn read(text: &str) -> Mesh {
    read_ply::<Vec3>(text.as_bytes()).unwrap().mesh
}

pub(super) fn refusal(bytes: impl AsRef<[u8]>) -> String {
    read_ply::<Vec3>(bytes.as_ref()).unwrap_err().to_string()
}

/// Returns the messages for ascii and for binary. Both binary orders must agree.
fn refusals(ascii: &str) -> (String, String) {
    let binary = refusal(encode(ascii, false));
    assert_eq!(refusal(encode(ascii, true)), binary);
    (refusal(ascii), binary)
}

#[test]
fn all_encodings_give_the_same_mesh() {
    let mesh = read(RICH);
    assert_eq!(mesh.vertices()[1].to_array(), [2.0, -1.0, 0.5]);
    assert_eq!(mesh.vertices()[3].to_array(), [4.0, 0.0, -0.0]);
    assert_eq!(mesh.vertices()[4].to_array(), [5.0, 1.0, 16_777_216.0]);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [4, 3, 2], [4, 2, 1], [4, 1, 0], [1, 1, 2], [0, 1, 2], [0, 2, 4]]);
    for text in [RICH, QUAD] {
        for big_endian in [false, true] {
            assert_eq!(read_ply::<Vec3>(&encode(text, big_endian)).unwrap().mesh, read(text));
        }
    }
}

#[test]
fn every_type_serves_as_coordinate_length_and_index() {
    for (old, new) in [("char", "int8"), ("short", "int16"), ("int", "int32"), ("float", "float32")] {
        let unsigned = [format!("u{old}"), format!("u{new}")];
        let types = [old.to_owned(), new.to_owned()].into_iter().chain(unsigned);
        for name in types.filter(|name| !name.starts_with("ufloat")).chain(["double".to_owned()]) {
            let text = QUAD.replace("0.5", "5").replace("float", &name);
            let text = text.replace("uchar int", &format!("{name} {name}"));
            assert_eq!(read(&text), read(&QUAD.replace("0.5", "5")), "{name}");
            assert_eq!(read_ply::<Vec3>(&encode(&text, true)).unwrap().mesh, read(&text), "{name}");
        }
    }
}

#[test]
fn coordinates_are_rounded_once() {
    // Just above the midpoint between 1 and the next float. As a double it would be the midpoint, which rounds to even.
    let text = QUAD.replacen("0 0 0", "1.000000059604644775390625000001 .5 -5.", 1);
    assert_eq!(read(&text).vertices()[0].to_array(), [1.000_000_1, 0.5, -5.0]);
    assert_eq!(read(&text.replace("float", "double")), read(&text));
}

#[test]
fn polygons_fan_out_in_place() {
    assert_eq!(read(QUAD).triangles(), [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
}

#[test]
fn faces_may_come_first() {
    let face = "element face 2\nproperty list uchar int vertex_index\n";
    let text = QUAD.replace(face, "").replace("element vertex", &format!("{face}element vertex"));
    let (header, body) = text.split_once("end_header\n").unwrap();
    let (vertices, faces) = body.split_at(body.find("4 0").unwrap());
    assert_eq!(read(&format!("{header}end_header\n{faces}{vertices}")), read(QUAD));
}

#[test]
fn lines_end_in_any_way() {
    for end in ["\r\n", "\r", " \n", "\n\n"] {
        assert_eq!(read(&QUAD.replace('\n', end)), read(QUAD), "{end:?}");
    }
    assert_eq!(read(QUAD.trim_end()), read(QUAD));
    for text in [QUAD.to_owned(), QUAD.replace('\n', "\r")] {
        assert_eq!(read(&format!("\u{feff}{text}")), read(QUAD));
    }
    let marked = [b"\xEF\xBB\xBF", &*encode(QUAD, true)].concat();
    assert_eq!(read_ply::<Vec3>(&marked).unwrap().mesh, read(QUAD));

    // The first coordinate begins with the byte of a line feed, which does not belong to the header.
    let ascii = QUAD.replacen("0 0 0", &format!("{:e} 0 0", f32::from_bits(0x0A)), 1);
    let binary = encode(&ascii, false);
    let (header, body) = binary.split_at(body(&binary));
    assert_eq!(body[0], b'\n');
    for end in ["\n", "\r\n", "\r"] {
        let header = str::from_utf8(header).unwrap().replace('\n', end);
        assert_eq!(read_ply::<Vec3>(&[header.as_bytes(), body].concat()).unwrap().mesh, read(&ascii), "{end:?}");
    }
}

#[test]
fn a_bad_number_is_named_by_its_element() {
    let cases = [
        (
            "1 1 0\n",
            "1 nan 0\n",
            12,
            "vertex 2 (of 4): coordinate y is NaN, expected a finite number in single precision",
        ),
        (
            "0 0 0\n",
            "0 0 -inf\n",
            10,
            "vertex 0 (of 4): coordinate z is -inf, expected a finite number in single precision",
        ),
        (
            "3 0 1 2\n",
            "3 0 1 4\n",
            15,
            "face 1 (of 2): vertex index 4 is out of range, expected a whole number from 0, less than 4",
        ),
        (
            "1 2 3\n",
            "1 -1 3\n",
            14,
            "face 0 (of 2): vertex index -1 is out of range, expected a whole number from 0, less than 4",
        ),
    ];
    for (old, new, line, message) in cases {
        let (ascii, binary) = refusals(&QUAD.replacen(old, new, 1));
        assert_eq!(binary, message);
        assert_eq!(ascii, format!("line {line}, {message}"));
    }
    let doubles = QUAD.replace("float", "double");
    let (ascii, binary) = refusals(&doubles.replacen("1 0 0\n", "1e300 0 0\n", 1));
    assert_eq!(binary, "vertex 1 (of 4): coordinate x is 1e300, expected a finite number in single precision");
    assert_eq!(ascii, format!("line 11, {binary}"));
    let (_, binary) = refusals(&QUAD.replace("uchar int", "char double").replace("2 3\n", "2.5 3\n"));
    assert_eq!(binary, "face 0 (of 2): vertex index 2.5 is out of range, expected a whole number from 0, less than 4");
    let (_, binary) = refusals(&QUAD.replace("uchar int", "char int").replace("3 0 1 2\n", "-3 0 1 2\n"));
    assert_eq!(binary, "face 1 (of 2): found list length -3, expected a whole number from 0");
}

#[test]
fn a_bad_line_is_named() {
    let cases = [
        ("1 1 0\n", "1 1\n", "line 12, vertex 2 (of 4): found the end of the line, expected a float"),
        ("1 1 0\n", "1 1 0 7\n", "line 12, vertex 2 (of 4): found \"7\", expected the end of the line"),
        ("1 1 0\n", "1 1,0 0\n", "line 12, vertex 2 (of 4): found \"1,0\", expected a float"),
        ("4 0 1 2 3", "4 0 1 2", "line 14, face 0 (of 2): found the end of the line, expected an int"),
        ("4 0 1 2 3", "4 0 1 2.5 3", "line 14, face 0 (of 2): found \"2.5\", expected an int"),
        ("4 0 1 2 3", "256 0 1 2 3", "line 14, face 0 (of 2): found \"256\", expected a uchar"),
        ("4 0 1 2 3\n", "", "line 14, face 1 (of 2): the file ends, expected more elements"),
    ];
    for (old, new, message) in cases {
        assert_eq!(refusal(QUAD.replacen(old, new, 1)), message);
    }
    let latin1 = [QUAD.split_once("0 0 0").unwrap().0.as_bytes(), b"\xE9 0 0\n"].concat();
    assert_eq!(refusal(latin1), "line 10, vertex 0 (of 4): found \"\u{fffd} 0 0\", expected numbers");
}

#[test]
fn a_mesh_without_triangles_is_refused() {
    let text = QUAD.replace("face 2", "face 0").replace("4 0 1 2 3\n3 0 1 2\n", "");
    let message = "no triangles, expected at least one".to_owned();
    assert_eq!(refusals(&text), (message.clone(), message));
}

#[test]
fn more_than_promised_is_refused() {
    let fewer = QUAD.replace("face 2", "face 1");
    assert_eq!(refusal(&fewer), "after the last element: found 7 bytes, expected the end of the file");
    let binary = encode(QUAD, false);
    let text = String::from_utf8_lossy(&binary).into_owned();
    let fewer = [&binary[..text.find("face 2").unwrap() + 5], b"1", &binary[text.find("face 2").unwrap() + 6..]];
    assert_eq!(refusal(fewer.concat()), "after the last element: found 13 bytes, expected the end of the file");
    assert_eq!(read_ply::<Vec3>(&[&binary[..], b" \r\n"].concat()).unwrap().mesh, read(QUAD));
}

#[test]
fn every_truncation_of_a_binary_file_is_an_error() {
    for text in [RICH, QUAD] {
        for big_endian in [false, true] {
            let bytes = encode(text, big_endian);
            for length in 0..bytes.len() {
                assert!(read_ply::<Vec3>(&bytes[..length]).is_err(), "{length}");
            }
        }
    }
    let bytes = encode(QUAD, false);
    let message = "face 1 (of 2): the file ends, expected more elements";
    assert_eq!(refusal(&bytes[..bytes.len() - 1]), message);
    assert_eq!(refusal(&bytes[..bytes.len() - 13 - 17 - 1]), "vertex 3 (of 4): the file ends, expected more elements");
}

#[test]
fn absurd_counts_are_refused_at_once_and_take_no_memory() {
    assert_eq!(capacity(10, 1000), 10);
    assert_eq!(capacity(u64::MAX, 1000), 333);
    for (old, new) in [("vertex 4", "vertex 2000000000"), ("face 2", "face 2000000000")] {
        assert!(refusal(QUAD.replace(old, new)).contains(" (of 2000000000): "));
        for big_endian in [false, true] {
            let mut bytes = encode(QUAD, big_endian);
            let at = bytes.windows(old.len()).position(|w| w == old.as_bytes()).unwrap();
            bytes.splice(at..at + old.len(), new.bytes());
            assert!(refusal(bytes).ends_with(" (of 2000000000): the file ends, expected more elements"));
        }
    }
    let mut long = encode(&QUAD.replace("uchar int", "uint int"), false);
    let length = long.len() - 16;
    long[length..length + 4].fill(0xFF);
    assert_eq!(refusal(long), "face 1 (of 2): the file ends, expected more elements");
    let long = QUAD.replace("uchar int", "uint int").replace("3 0 1 2", "4294967295 0 1 2");
    assert_eq!(refusal(long), "line 15, face 1 (of 2): found the end of the line, expected an int");
    let nothing = QUAD.replace("element vertex", "element nothing 18446744073709551615\nelement vertex");
    assert_eq!(read(&nothing), read(QUAD));
}

#[test]
fn corrupted_files_never_panic() {
    for valid in [RICH.into(), QUAD.into(), encode(RICH, false), encode(QUAD, false), encode(QUAD, true)] {
        survives_corruption(&valid, body(&valid), MeshFormat::Ply, 2_000);
    }
}

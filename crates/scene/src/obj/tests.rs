use super::*;
use crate::tests::{Random, survives_corruption};
use crate::{MeshFormat, Note};
use glam::Vec3;
use stackless_bvh::geom::Mesh;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn mesh(bytes: &[u8]) -> Result<Mesh, ReadError> {
    read_obj::<Vec3>(bytes).map(|loaded| loaded.mesh)
}

fn triangles(text: &str) -> Vec<[u32; 3]> {
    mesh(text.as_bytes()).unwrap().triangles().to_vec()
}

fn refusal(text: &str) -> String {
    read_obj::<Vec3>(text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn corners_come_in_every_form() {
    for face in ["1 2 3", "1/7 2/8 3/9", "1//7 2//8 3//9", "1/7/1 2/-8/2 3/9/3", "-3 -2/1 -1//1", "1/ 2/ 3//"] {
        assert_eq!(triangles(&format!("{TRIANGLE}f {face}\n")), [[0, 1, 2]], "{face}");
    }
}

#[test]
fn polygons_fan_out_in_place() {
    let text = format!("{TRIANGLE}v 1 1 0\nv 2 2 0\nf 1 2 3\nf 5 4 3 2 1\nf 3 2 1\n");
    assert_eq!(triangles(&text), [[0, 1, 2], [4, 3, 2], [4, 2, 1], [4, 1, 0], [2, 1, 0]]);
}

#[test]
fn negative_numbers_count_back_from_the_vertices_so_far() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nf -3 -2 -1\nf 1 -1 2\n";
    assert_eq!(triangles(text), [[0, 1, 2], [1, 2, 3], [0, 3, 1]]);
}

#[test]
fn a_corner_may_point_ahead() {
    assert_eq!(triangles(&format!("f 1 2 3\n{TRIANGLE}")), [[0, 1, 2]]);
    assert_eq!(
        refusal(&format!("f 1 2 3\nf 1 2 4\nf 5 1 2\n{TRIANGLE}")),
        "line 2: vertex index 4 is out of range, expected 1 to 3 or -3 to -1"
    );
}

#[test]
fn white_space_comments_and_continuations_do_not_matter() {
    let plain = format!("{TRIANGLE}f 1 2 3\n");
    let variants = [
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.replace('\n', "\r\r\n"),
        format!("# a comment\r{plain}"),
        format!("\u{feff}{plain}"),
        format!("\u{feff}{}", plain.replace('\n', "\r")),
        plain.replace("\nf ", "\nfo "),
        plain.replace(' ', " \\\r "),
        plain.replace('\n', " # f 1 1 9\n"),
        plain.replace(' ', " \\\n "),
        plain.replace(' ', " \\\r\n\t"),
        plain.replace("\nf ", " # C:\\\n \tf\t"),
        plain.trim_end().to_owned(),
        format!("mtllib \u{e9}.mtl\no x\ng\ns off\nusemtl y\nvn 0 0 nan\nvt 1\n{plain}"),
        plain.replace("1 0 0", "1 0 0 1.0 0.5 0.5 0.5"),
    ];
    for text in variants {
        let loaded = read_obj::<Vec3>(text.as_bytes()).unwrap();
        assert_eq!((Ok(loaded.mesh), loaded.notes), (mesh(plain.as_bytes()), Vec::new()), "{text}");
    }
    let mut latin1 = b"# \xE9\no \xE9\\\n\xFF\n".to_vec();
    latin1.extend_from_slice(plain.as_bytes());
    assert_eq!(mesh(&latin1), mesh(plain.as_bytes()));
}

#[test]
fn what_the_format_does_not_have_is_counted() {
    let skipped = |text: &str| read_obj::<Vec3>(text.as_bytes()).unwrap().notes;
    let plain = format!("{TRIANGLE}f 1 2 3\n");
    assert_eq!(skipped(&plain), []);
    let kind = NoteKind::UnknownStatement;
    let of = |count, line, word: &str| vec![Note { kind, count, first: format!("in line {line}: {word}") }];
    assert_eq!(skipped(&format!("o a\rs off\rV 0 0 0\r{plain}")), of(1, 3, "\"V\""));
    assert_eq!(skipped(&format!("vt 1\n{plain}vx 1\n\nfacet 1 2 3\n")), of(2, 6, "\"vx\""));
    // A byte order mark is valid only at the beginning of the file.
    assert_eq!(skipped(&format!("\n\u{feff}g\n{plain}")), of(1, 2, "\"\\u{feff}g\""));
    let long = "x".repeat(100_000);
    assert!(skipped(&format!("{long}\n{plain}"))[0].to_string().len() < 200);
}

#[test]
fn coordinates_are_the_nearest_floats() {
    // Just above the midpoint between 1 and the next float. Rounding to a double first would then round down.
    let text = "v 1.000000059604644775390625000001 .5 -5.\nf 1 1 1\n";
    let mesh = self::mesh(text.as_bytes()).unwrap();
    assert_eq!(mesh.vertices()[0].to_array(), [1.000_000_1, 0.5, -5.0]);

    let mut random = Random(1);
    for _ in 0..10_000 {
        let value = f32::from_bits(random.next() as u32);
        if value.is_finite() {
            let text = format!("v {value} {value:e} {value:?}\nf 1 1 1\n");
            let mesh = self::mesh(text.as_bytes()).unwrap();
            assert_eq!(mesh.vertices()[0].to_array().map(f32::to_bits), [value.to_bits(); 3], "{text}");
        }
    }
}

#[test]
fn each_error_names_its_line() {
    let cases = [
        ("", "no triangles, expected at least one"),
        (TRIANGLE, "no triangles, expected at least one"),
        ("\nv 0 0\n", "line 2: found the end of the line, expected 3 coordinates"),
        ("v 0 0 x,1\n", "line 1: found \"x,1\", expected a number"),
        ("v \\\n0 \\\n0 \\\nx\n", "line 1: found \"x\", expected a number"),
        ("# a\nv 0 nan 0\nf 1 1 1", "line 2: coordinate y is NaN, expected a finite number in single precision"),
        ("v 0 0 -inf\nf 1 1 1", "line 1: coordinate z is -inf, expected a finite number in single precision"),
        ("v 1e39 0 0\nf 1 1 1", "line 1: coordinate x is 1e39, expected a finite number in single precision"),
        (
            "v 0 0 0\nf 1 1\nf\n",
            "no triangles, expected at least one; 2 faces with fewer than 3 corners were skipped, the first in line 2",
        ),
        ("f 1 1 1\n", "line 1: vertex index 1 is out of range, expected a vertex before the face"),
        ("f -1 1 1\n", "line 1: vertex index -1 is out of range, expected a vertex before the face"),
        ("v 0 0 0\n\nf 1 0 1\n", "line 3: vertex index 0 is out of range, expected 1 to 1 or -1 to -1"),
        ("v 0 0 0\nf 1 1 2\n", "line 2: vertex index 2 is out of range, expected 1 to 1 or -1 to -1"),
        ("v 0 0 0\nf 1 1 -2\n", "line 2: vertex index -2 is out of range, expected 1 to 1 or -1 to -1"),
        ("v 0 0 0\nf 1 1 1.5\n", "line 2: found \"1.5\", expected a corner as in a, a/b, a//c or a/b/c"),
        ("v 0 0 0\nf 1 1 /1\n", "line 2: found \"/1\", expected a corner as in a, a/b, a//c or a/b/c"),
        ("v 0 0 0\nf 1 1 1/x\n", "line 2: found \"1/x\", expected a corner as in a, a/b, a//c or a/b/c"),
        ("v 0 0 0\nf 1 1 1/1/1/1\n", "line 2: found \"1/1/1/1\", expected a corner as in a, a/b, a//c or a/b/c"),
    ];
    for (text, message) in cases {
        assert_eq!(refusal(text), message, "{text}");
    }
    for number in [1 << 31, 1 << 32, i64::MAX, i64::MIN] {
        let message = format!("line 2: vertex index {number} is out of range, expected 1 to 1 or -1 to -1");
        assert_eq!(refusal(&format!("v 0 0 0\nf {number} 1 1\n")), message);
    }
}

#[test]
fn corrupted_files_never_panic() {
    let valid = format!("# two\n{TRIANGLE}v 1 1 \\\n 0.5e-3\nf 1/1/1 2//2 3/3 -1\nf 3 2 1\n");
    survives_corruption(valid.as_bytes(), 0, MeshFormat::Obj, 5_000);
}

use super::*;
use crate::Rounding;
use crate::tests::Folder;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use glam::{DVec3, Vec3};

/// Describes two nodes, one below the other, that both have the mesh of one triangle with the bytes `buffer`.
fn document(buffer: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"mesh":0,"children":[1],"translation":[10,0,0],"scale":[2,2,2]}},{{"mesh":0,"translation":[0,0,1]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
        {{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],
        "buffers":[{{{buffer}"byteLength":42}}]}}"#
    )
}

fn triangle() -> Vec<u8> {
    let corners = [0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    corners.iter().flat_map(|x| x.to_le_bytes()).chain([0_u16, 1, 2].iter().flat_map(|i| i.to_le_bytes())).collect()
}

fn embedded() -> String {
    document(&format!(r#""uri":"data:application/octet-stream;base64,{}","#, BASE64_STANDARD.encode(triangle())))
}

fn binary() -> Vec<u8> {
    let pad = |mut part: Vec<u8>, with: u8| {
        part.resize(part.len().next_multiple_of(4), with);
        part
    };
    let parts = [(*b"JSON", pad(document("").into_bytes(), b' ')), (*b"BIN\0", pad(triangle(), 0))];
    let chunks: Vec<u8> =
        parts.iter().flat_map(|(kind, part)| [&(part.len() as u32).to_le_bytes()[..], kind, part].concat()).collect();
    [b"glTF", &2_u32.to_le_bytes()[..], &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
}

#[test]
fn nodes_move_their_meshes_and_those_below() {
    let folder = Folder::new("gltf");
    std::fs::write(folder.file("a b.bin"), triangle()).unwrap();
    let place = folder.file("a b.bin");
    let beside = document(r#""uri":"a%20b.bin","#);
    for bytes in [embedded().into_bytes(), binary(), beside.into_bytes()] {
        let mesh = read_gltf::<Vec3>(&bytes, place.parent()).unwrap().mesh;
        assert_eq!(mesh.triangles(), [[0, 1, 2], [3, 4, 5]]);
        let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * 2.0);
        let corner = Vec3::new(10.0, 0.0, 0.0);
        assert_eq!(mesh.vertices(), [corner, corner + x, corner + y, corner + z, corner + z + x, corner + z + y]);
    }
}

/// The document's decimals are not exact in single precision.
#[test]
fn nodes_are_read_in_double_precision_and_what_they_round_is_counted() {
    fn read<V: Position>(changes: &[(&str, &str)]) -> Loaded<V> {
        let change = |text: String, (from, to): &(&str, &str)| {
            assert_eq!(text.matches(from).count(), 1, "{from}");
            text.replace(from, to)
        };
        read_gltf(changes.iter().fold(embedded(), change).as_bytes(), None).unwrap()
    }
    let counts = |rounding: Rounding| (rounding.rounded, rounding.numbers);
    // Coordinates without rounding are not counted.
    assert_eq!(counts(read::<Vec3>(&[]).rounding), (0, 18));
    let far = [("[10,0,0]", "[691607.1,0.25,0]")];
    let loaded = read::<DVec3>(&far);
    assert_eq!(loaded.mesh.vertices()[1], DVec3::new(691_607.1 + 2.0, 0.25, 0.0));
    assert_eq!(counts(loaded.rounding), (6, 18));
    assert!((1e-11..2e-10).contains(&loaded.rounding.moved), "{:?}", loaded.rounding);
    let single = read::<Vec3>(&far);
    assert_eq!((single.mesh.vertices()[1].x, counts(single.rounding)), (691_609.1, (6, 18)));
    assert!((0.02..0.03).contains(&single.rounding.moved), "{:?}", single.rounding);
    // A rotation by 90 degrees about z, with the decimals of an inexact quaternion.
    let turn = [(r#""scale":[2,2,2]"#, r#""rotation":[0,0,0.7071068,0.7071068]"#)];
    let loaded = read::<DVec3>(&turn);
    let half: f64 = "0.7071068".parse().unwrap();
    let sine = 2.0 * half * half;
    let off = (loaded.mesh.vertices()[1] - DVec3::new(10.0 + (1.0 - sine), sine, 0.0)).length();
    assert!(off < 1e-15, "{off:e}");
    // Rounding affects all x and y except at the two corners on the axis. No z is rounded.
    assert_eq!(counts(loaded.rounding), (8, 18));
    assert!(loaded.rounding.moved > 1e-17 && loaded.rounding.moved < 4e-15, "{:?}", loaded.rounding);
    let matrix = [(r#""translation":[10,0,0],"scale":[2,2,2]"#, r#""matrix":[2,0,0,0,0,2,0,0,0,0,2,0,10,0,0,1]"#)];
    let (loaded, same) = (read::<DVec3>(&matrix), read::<DVec3>(&[]));
    assert_eq!((loaded.mesh, loaded.rounding), (same.mesh, same.rounding));
}

#[test]
fn strips_and_fans_are_triangles_and_points_are_not() {
    let with = |mode: &str| {
        let text = embedded().replace(r#""indices":1"#, mode);
        read_gltf::<Vec3>(text.as_bytes(), None)
            .map(|loaded| loaded.mesh.triangles().to_vec())
            .map_err(|error| error.to_string())
    };
    for mode in [r#""mode":4"#, r#""mode":5"#, r#""mode":6"#] {
        assert_eq!(with(mode).unwrap(), [[0, 1, 2], [3, 4, 5]], "{mode}");
    }
    assert!(with(r#""mode":0"#).unwrap_err().contains("no triangles"));
}

#[test]
fn what_is_not_read_is_counted() {
    let note = |changes: &[(&str, &str)]| {
        let text = changes.iter().fold(embedded(), |text, (from, to)| {
            assert_eq!(text.matches(from).count(), 1, "{from}");
            text.replace(from, to)
        });
        read_gltf::<Vec3>(text.as_bytes(), None).unwrap().note("a.gltf".as_ref())
    };
    assert_eq!(note(&[]), None);
    let lines = (r#""indices":1}"#, r#""indices":1},{"attributes":{"POSITION":0},"mode":1}"#);
    let morphs = (r#""indices":1"#, r#""indices":1,"targets":[{"POSITION":0}]"#);
    let skin = (r#"{"mesh":0,"children""#, r#"{"skin":0,"mesh":0,"children""#);
    let skins = (r#""asset":"#, r#""skins":[{"joints":[1]}],"asset":"#);
    assert_eq!(
        note(&[lines]).unwrap(),
        "a.gltf: 2 primitives of points or lines were skipped, the first in node 0 (of 2)"
    );
    assert_eq!(
        note(&[lines, morphs, skin, skins]).unwrap(),
        "a.gltf: 1 skin was not applied, the first in node 0 (of 2); 2 sets of morph targets were not applied, the first \
         in node 0 (of 2); 2 primitives of points or lines were skipped, the first in node 0 (of 2)"
    );
}

#[test]
fn what_is_cut_or_wrong_is_refused_in_one_line() {
    for good in [embedded().into_bytes(), binary()] {
        for end in 0..good.len() {
            let message = read_gltf::<Vec3>(&good[..end], None).unwrap_err().to_string();
            assert!(!message.contains('\n') && message.len() < 400, "{message}");
        }
        for at in 0..good.len() {
            for byte in [0, b'9', b'-', 0xff] {
                let mut changed = good.clone();
                changed[at] = byte;
                let message =
                    read_gltf::<Vec3>(&changed, None).map_or_else(|error| error.to_string(), |_| String::new());
                assert!(!message.contains('\n') && message.len() < 400, "{message}");
            }
        }
    }
    for (from, to, message) in [
        (
            r#""children":[1]"#,
            r#""children":[0]"#,
            "node 0 (of 2): found a node below two others, expected one above each",
        ),
        (
            r#""count":3,"type":"VEC3""#,
            r#""count":4,"type":"VEC3""#,
            "accessor 0 beyond buffer view 0, expected an end within its 36 bytes",
        ),
        (r#""count":3,"type":"VEC3""#, r#""count":18446744073709551615,"type":"VEC3""#, "node 0 (of 2): "),
        (r#""count":3,"type":"SCALAR""#, r#""count":2,"type":"SCALAR""#, "found 2 corners, expected three for each"),
        (r#""byteOffset":36"#, r#""byteOffset":30"#, "vertex index"),
        (r#""byteLength":42"#, r#""byteLength":43"#, "buffer 0 (of 1): found 42 bytes, expected 43"),
        (r#""scale":[2,2,2]"#, r#""scale":[3e38,2,2]"#, ""),
        (r#""translation":[10,0,0]"#, r#""translation":[3e38,0,0],"rotation":[0,0,0,1]"#, ""),
        (r#""scenes":[{"nodes":[0]}]"#, r#""scenes":[]"#, "the document: found no scene, expected scene 0"),
        (r#""version":"2.0""#, r#""version":"3.0""#, "the document: found version \"3.0\", expected glTF 2.0"),
    ] {
        let text = embedded().replace(from, to);
        let error = read_gltf::<Vec3>(text.as_bytes(), None).map_or_else(|error| error.to_string(), |_| String::new());
        assert!(error.contains(message), "{from} {to}: {error}");
    }
    for uri in ["../x.bin", "/etc/hostname", "file:///etc/hostname", "http://a/b"] {
        let text = document(&format!(r#""uri":"{uri}","#));
        let error = read_gltf::<Vec3>(text.as_bytes(), Some(Path::new("."))).unwrap_err().to_string();
        assert!(error.contains("expected the name of a file in the folder of this one"), "{error}");
    }
}

//! Writes the seeds of all targets: `seeds FOLDER`.
//!
//! The seeds are valid files of each format, of every kind. Targets that read choices from any bytes get a few inputs
//! of various lengths. The seeds are equal on every machine.

use std::fmt::Write;
use std::path::Path;
use std::{env, fs, io};

use arbitrary::Unstructured;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::generate::{Rng, Source, procedural};
use stackless_bvh::geom::Mesh;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{Case, Fault, Replay};
use stackless_fuzz::{TARGETS, Target};

fn main() -> io::Result<()> {
    let folder = env::args().nth(1).unwrap_or_else(|| "seeds".into());
    for target in TARGETS {
        let folder = Path::new(&folder).join(target.name);
        fs::create_dir_all(&folder)?;
        for (i, seed) in seeds(target).iter().enumerate() {
            fs::write(folder.join(format!("{i:02}")), seed)?;
        }
    }
    Ok(())
}

fn seeds(target: Target) -> Vec<Vec<u8>> {
    let mesh = procedural::soup(1, 3);
    match target.name {
        "ply" => vec![ascii(&mesh), binary(&mesh, true), binary(&mesh, false), polygons()],
        "obj" => vec![
            obj(&mesh),
            b"# text\nv 0 0 0 1\nv 1 0 0\r\nvt 0 0\nv 1 1 0\nv 0 1e-3 .5\nvn 0 0 1\ng a\ns off\nf 1/1/1 2//1 3/1 4\nf -4 -3 -2\n"
                .to_vec(),
        ],
        "stl" => vec![
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e-3 .5\nendloop\nendfacet\nendsolid a\n"
                .to_vec(),
            stl(&mesh),
        ],
        "gltf" => vec![gltf("", ""), gltf(r#","indices":1"#, ""), gltf(r#","mode":5"#, r#","scale":[2,2,2]"#)],
        "rays" => vec![
            b"ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,0,1,0,0,0,inf\n# two\n\n1e-3,-0,.5,-1,2,3,0.25,4\n".to_vec(),
            b" 0 , 0 , 0 , 1 , 0 , 0 , 0 , 1 \r\n".to_vec(),
        ],
        "replay" => {
            let random = random(target, &[16, 64]);
            let cases = random.iter().map(|bytes| json(&Case::draw(&mut Unstructured::new(bytes), 5)));
            // Invalid trees: empty, with a missing child, with a duplicate child, and with a node without a parent.
            let not_trees = ["[]", "[[1,2]]", "[[1,1],null]", "[null,null]"];
            let not_trees = not_trees.map(|tree| format!("{{\"children\":{tree},\"cells\":[]}}").into_bytes());
            cases.chain(random.clone()).chain(not_trees).collect()
        }
        "bvh_bytes" => {
            // After the choices: the fourth kind uses all bytes unchanged.
            let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
            let whole = [&[3; 1][..], &[1; 159], &bvh.to_bytes()].concat();
            random(target, &[100, 170, 180, 200, 220]).into_iter().chain([whole]).collect()
        }
        _ => random(target, &[0, 6, 12, 24, 48, 72, 96, 120, 160, 200, 240, 300]),
    }
}

fn random(target: Target, lengths: &[usize]) -> Vec<Vec<u8>> {
    let name = target.name.bytes().fold(0, |seed: u64, byte| seed << 5 ^ seed >> 3 ^ u64::from(byte));
    let mut rng = Rng::new(name);
    let lengths = lengths.iter().filter(|&&length| length <= target.longest);
    lengths.map(|&length| (0..length).map(|_| rng.below(256) as u8).collect()).collect()
}

fn json(case: &Case) -> Vec<u8> {
    let fault = Fault::Endless { visits: 1 };
    serde_json::to_vec(&Replay::of(case, Method::Hashed, WordName::U64, &fault)).expect("a text")
}

fn header(mesh: &Mesh, format: &str) -> String {
    let (vertices, faces) = (mesh.vertices().len(), mesh.triangles().len());
    format!(
        "ply\nformat {format} 1.0\ncomment a seed\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn ascii(mesh: &Mesh) -> Vec<u8> {
    let mut text = header(mesh, "ascii");
    for v in mesh.vertices() {
        let _ = writeln!(text, "{} {} {}", v.x, v.y, v.z);
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text.into_bytes()
}

fn binary(mesh: &Mesh, is_little: bool) -> Vec<u8> {
    let mut bytes = header(mesh, if is_little { "binary_little_endian" } else { "binary_big_endian" }).into_bytes();
    let word = |word: u32| if is_little { word.to_le_bytes() } else { word.to_be_bytes() };
    bytes.extend(mesh.vertices().iter().flat_map(|v| v.to_array()).flat_map(|x| word(x.to_bits())));
    for corners in mesh.triangles() {
        bytes.push(3);
        bytes.extend(corners.iter().flat_map(|&corner| word(corner)));
    }
    bytes
}

/// Encodes numbers of every type, other elements and other lists, and a polygon.
fn polygons() -> Vec<u8> {
    b"ply\rformat ascii 1.0\robj_info x\relement other 1\rproperty list short uint a\rproperty double b\rproperty ushort c\r\
      element vertex 4\rproperty double z\rproperty char y\rproperty short x\rproperty uchar red\r\
      element face 1\rproperty list int uint vertex_index\rproperty int8 d\rend_header\r\
      2 7 8 .5 9\r0 0 0 1\r0 1 0 2\r1e-2 1 1 3\r-0 0 1 4\r4 0 1 2 3 -7\r"
        .to_vec()
}

fn stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for triangle in mesh.triangles() {
        bytes.extend([0; 12]);
        let corners = triangle.iter().flat_map(|&corner| mesh.vertices()[corner as usize].to_array());
        bytes.extend(corners.flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

/// Encodes two nodes that share one mesh, a triangle, with these members of the primitive and of the upper node.
fn gltf(primitive: &str, node: &str) -> Vec<u8> {
    // Corners 0 0 0, 1 0 0, 0 1 0 as floats, indices 0 1 2 as bytes.
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC";
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"children":[1]{node}}},{{"mesh":0,"translation":[0,0,1]}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}{primitive}}}]}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},{{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}}],"bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":3}}],"buffers":[{{"uri":"data:;base64,{data}","byteLength":39}}]}}"#
    )
    .into_bytes()
}

fn obj(mesh: &Mesh) -> Vec<u8> {
    let mut text = String::new();
    for v in mesh.vertices() {
        let _ = writeln!(text, "v {} {} {}", v.x, v.y, v.z);
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text.into_bytes()
}

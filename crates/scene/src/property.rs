//! The property bodies of file readers: any bytes give a valid mesh or valid rows, or a one-line message.

use std::borrow::Cow;
use std::fmt::{Debug, Write};

use crate::stl;
use crate::text::{MARK, as_utf8};
use crate::{Format, Loaded, Point, Position, ReadError, Row, read_gltf, read_obj, read_ply, read_rows_from, read_stl};
use glam::{DVec3, Vec3};
use stackless_bvh::geom::{Mesh, Ray};

/// A fault of a reader.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileFault {
    /// The message has several lines, or is longer than a terminal's screen.
    #[error("not a message of one line: {0:?}")]
    Message(String),
    /// The result has more elements than the file has bytes.
    #[error("{elements} vertices, triangles or rows from {bytes} bytes")]
    Size {
        /// Number of elements read.
        elements: usize,
        /// Number of bytes.
        bytes: usize,
    },
    /// The result is invalid, or changes when it is written as text and read again.
    #[error("what was read is not valid, or does not come back: {0}")]
    Changed(String),
}

/// The maximum length of a message, in bytes.
const LONGEST: usize = 2000;

/// A mesh format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// [`read_ply`].
    Ply,
    /// [`read_obj`].
    Obj,
    /// [`read_stl`].
    Stl,
    /// [`read_gltf`], with all buffers in the file.
    Gltf,
}

impl MeshFormat {
    fn read<V: Position>(self, bytes: &[u8]) -> Result<Loaded<V>, ReadError> {
        match self {
            Self::Ply => read_ply(bytes),
            Self::Obj => read_obj(bytes),
            Self::Stl => read_stl(bytes),
            Self::Gltf => read_gltf(bytes, None),
        }
    }

    /// Returns the file as other editors would write it.
    fn rewritten(self, bytes: &[u8]) -> Vec<Vec<u8>> {
        match self {
            // In UTF-16, byte order marks and line ends have other bytes.
            Self::Obj | Self::Stl if matches!(as_utf8(bytes), Cow::Owned(_)) => Vec::new(),
            // The bytes after the header may be binary.
            Self::Ply => rewritten(bytes, false),
            Self::Obj => rewritten(bytes, true),
            Self::Stl if stl::is_text(bytes) => rewritten(bytes, true),
            Self::Stl | Self::Gltf => Vec::new(),
        }
    }
}

/// Reads a mesh. An accepted mesh is written as OBJ and as PLY, and must survive the round trip bit for bit.
///
/// Returns whether the mesh is accepted.
///
/// # Errors
/// The first fault.
pub fn check_mesh_file(bytes: &[u8], format: MeshFormat) -> Result<bool, FileFault> {
    let loaded = match format.read(bytes) {
        Ok(loaded) => loaded,
        Err(error) => return message(error.to_string()),
    };
    if let Some(note) = loaded.note("FILE".as_ref()) {
        message(note)?;
    }
    let mesh = &loaded.mesh;
    let elements = mesh.vertices().len() + mesh.triangles().len();
    // The nodes of a glTF file repeat its meshes.
    if elements >= bytes.len() && format != MeshFormat::Gltf {
        return Err(FileFault::Size { elements, bytes: bytes.len() });
    }
    let double = format.read::<DVec3>(bytes).map_err(|error| FileFault::Changed(error.to_string()))?;
    if !is_near(&loaded, &double) {
        return Err(FileFault::Changed(format!("{mesh:?}, and {:?} in double precision", double.mesh)));
    }
    for written in format.rewritten(bytes) {
        let same = format.read(&written);
        if !same.is_ok_and(|same| is_same(&same.mesh, mesh)) {
            return Err(FileFault::Changed(format!("not the same as {}", written.escape_ascii())));
        }
    }
    for back in [read_obj(as_obj(mesh).as_bytes()), read_ply(as_ply(mesh).as_bytes())] {
        let back = back.map_err(|error| FileFault::Changed(error.to_string()))?.mesh;
        if !is_same(&back, mesh) {
            return Err(FileFault::Changed(format!("{back:?} instead of {mesh:?}")));
        }
    }
    Ok(true)
}

/// Returns whether both meshes have the same faces with the same rounded corners. Text is rounded twice here, which may
/// give an adjacent float.
fn is_near(single: &Loaded, double: &Loaded<DVec3>) -> bool {
    // If rounding moves its corners, a polygon may have another triangulation.
    fn corners(triangles: &[[u32; 3]]) -> Vec<u32> {
        let mut corners = triangles.as_flattened().to_vec();
        if triangles.len() > 1 {
            corners.sort_unstable();
            corners.dedup();
        }
        corners
    }
    let near = |a: f32, b: f32| a == b || a.next_up() == b || a.next_down() == b;
    let mut first = 0;
    single.faces == double.faces
        && single.parts == double.parts
        && single.faces.chunk_by(|a, b| a == b).all(|face| {
            let triangles = first..first + face.len();
            first = triangles.end;
            let pairs = corners(&single.mesh.triangles()[triangles.clone()])
                .into_iter()
                .zip(corners(&double.mesh.triangles()[triangles]))
                .map(|(a, b)| (single.mesh.vertices()[a as usize], double.mesh.vertices()[b as usize]));
            pairs.into_iter().all(|(a, b)| (0..3).all(|axis| near(a[axis], b[axis] as f32)))
        })
}

fn is_same(a: &Mesh, b: &Mesh) -> bool {
    bits(a) == bits(b) && a.triangles() == b.triangles()
}

/// Reads rays and points in each format. Accepted rows are written, and must survive the round trip.
///
/// Returns whether any format accepts the bytes.
///
/// # Errors
/// The first fault.
pub fn check_row_file(bytes: &[u8]) -> Result<bool, FileFault> {
    let mut is_accepted = false;
    for format in Format::ALL {
        is_accepted |= check_row_file_as(bytes, format, |ray: &Ray| {
            let (o, d) = (ray.origin(), ray.direction());
            vec![o.x, o.y, o.z, d.x, d.y, d.z, ray.tmin(), ray.tmax()]
        })?;
        is_accepted |= check_row_file_as(bytes, format, |Point(point): &Point<Vec3>| point.to_array().to_vec())?;
    }
    Ok(is_accepted)
}

fn check_row_file_as<R: Row + Debug>(
    bytes: &[u8],
    format: Format,
    numbers: impl Fn(&R) -> Vec<f32>,
) -> Result<bool, FileFault> {
    let read = |bytes: &[u8], format| read_rows_from::<R>(bytes, "rows", format);
    let rows = match read(bytes, format) {
        Ok(loaded) => loaded.rows,
        Err(error) => return message(error.to_string()),
    };
    if rows.len() >= bytes.len() {
        return Err(FileFault::Size { elements: rows.len(), bytes: bytes.len() });
    }
    let rewritten = if format == Format::Npy { Vec::new() } else { rewritten(bytes, true) };
    for written in rewritten {
        let same = read(&written, format).is_ok_and(|same| format!("{:?}", same.rows) == format!("{rows:?}"));
        if !same {
            return Err(FileFault::Changed(format!("not the same as {}", written.escape_ascii())));
        }
    }
    let text = rows.iter().fold(String::new(), |mut text, row| {
        let words: Vec<_> = numbers(row).iter().map(|x| format!("{x:?}")).collect();
        let _ = writeln!(text, "{}", words.join(","));
        text
    });
    match read(text.as_bytes(), Format::Csv) {
        Ok(back) if format!("{:?}", back.rows) == format!("{rows:?}") => Ok(true),
        back => Err(FileFault::Changed(format!("{back:?} instead of {rows:?}"))),
    }
}

/// Returns the file as other editors would write it: with a byte order mark, and, if it is text, with other line ends.
fn rewritten(bytes: &[u8], is_text: bool) -> Vec<Vec<u8>> {
    let mut written = Vec::new();
    if !bytes.starts_with(MARK) {
        written.push([MARK, bytes].concat());
    }
    if is_text && !bytes.contains(&b'\r') {
        let lines: Vec<_> = bytes.split(|&byte| byte == b'\n').collect();
        written.extend([&b"\r\n"[..], b"\r"].map(|end| lines.join(end)));
    }
    written
}

fn message(message: String) -> Result<bool, FileFault> {
    let is_one_line = !message.contains(['\n', '\r']) && message.len() < LONGEST;
    if is_one_line { Ok(false) } else { Err(FileFault::Message(message)) }
}

fn bits(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.vertices().iter().map(|vertex| vertex.to_array().map(f32::to_bits)).collect()
}

fn as_obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    for v in mesh.vertices() {
        let _ = writeln!(text, "v {:?} {:?} {:?}", v.x, v.y, v.z);
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

fn as_ply(mesh: &Mesh) -> String {
    let (vertices, faces) = (mesh.vertices().len(), mesh.triangles().len());
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    );
    for v in mesh.vertices() {
        let _ = writeln!(text, "{:?} {:?} {:?}", v.x, v.y, v.z);
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

//! The document of a glTF file: its fields that concern triangles.

use std::borrow::Cow;
use std::path::{Component, Path};

use base64::prelude::{BASE64_STANDARD, Engine as _};
use serde::Deserialize;

use super::placed::Node;
use crate::error::{Fault, Place, ReadError};
use crate::text::{as_utf8, of_json, quote};
use crate::{MOST_BYTES, read_bytes};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    asset: Asset,
    #[serde(default)]
    pub(super) extensions_used: Vec<String>,
    #[serde(default)]
    extensions_required: Vec<String>,
    scene: Option<usize>,
    #[serde(default)]
    scenes: Vec<Scene>,
    #[serde(default)]
    pub(super) nodes: Vec<Node>,
    #[serde(default)]
    pub(super) meshes: Vec<Mesh>,
    #[serde(default)]
    pub(super) accessors: Vec<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: Vec<View>,
    #[serde(default)]
    buffers: Vec<Buffer>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

#[derive(Deserialize)]
struct Scene {
    #[serde(default)]
    nodes: Vec<usize>,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<usize>,
    #[serde(default = "triangles")]
    pub(super) mode: u32,
    #[serde(default)]
    pub(super) targets: Vec<serde::de::IgnoredAny>,
}

/// The default mode of a primitive.
fn triangles() -> u32 {
    4
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct Attributes {
    pub(super) position: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<Box<Sparse>>,
}

#[derive(Deserialize)]
pub(super) struct Sparse {
    pub(super) count: usize,
    pub(super) indices: Values,
    pub(super) values: Values,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Values {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    /// Only for indices.
    #[serde(default)]
    pub(super) component_type: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Buffer {
    uri: Option<String>,
    byte_length: usize,
}

/// The parts of a file: the document and the bytes of its buffers.
pub(super) type Parts<'a> = (Document, Vec<Cow<'a, [u8]>>);

/// Reads the document and all buffers.
pub(super) fn read<'a>(bytes: &'a [u8], folder: Option<&Path>) -> Result<Parts<'a>, ReadError> {
    let whole = |fault: Fault| fault.at(Place::Document);
    let (text, binary) = if bytes.starts_with(b"glTF") {
        let (text, binary) = chunks(bytes).map_err(whole)?;
        (Cow::Borrowed(text), binary)
    } else {
        (as_utf8(bytes), None)
    };
    let document: Document = serde_json::from_slice(&text)
        .map_err(|error| Fault::Json { what: of_json(&error) }.at_line(error.line() as u64))?;
    document.check().map_err(whole)?;
    let count = document.buffers.len();
    let buffers = document.buffers.iter().enumerate().map(|(index, buffer)| {
        let binary = binary.filter(|_| index == 0);
        buffer.read(binary, folder).map_err(|fault| fault.at(Place::of("buffer", index, count)))
    });
    let buffers = buffers.collect::<Result<_, _>>()?;
    Ok((document, buffers))
}

/// Splits a `.glb` file into its document and its binary chunk.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    let number = |at: usize| bytes.get(at..)?.first_chunk().map(|number| u32::from_le_bytes(*number) as usize);
    if number(4) != Some(2) {
        let found = number(4).map_or("no version".into(), |version| format!("version {version}"));
        return Err(Fault::unexpected(found, "version 2 of binary glTF"));
    }
    let length = number(8).unwrap_or(0);
    if length != bytes.len() {
        let expected = format!("{length}, as its header says");
        return Err(Fault::unexpected(format!("{} bytes", bytes.len()), expected));
    }
    let chunk = |at: usize| {
        let end = at.checked_add(8)?.checked_add(number(at)?)?;
        Some((bytes.get(at + 4..at + 8)?, bytes.get(at + 8..end)?, end))
    };
    let Some((b"JSON", text, end)) = chunk(12) else {
        return Err(Fault::unexpected("no chunk of JSON", "one after the header"));
    };
    // Other chunks are extensions.
    let binary = chunk(end.next_multiple_of(4)).filter(|(kind, ..)| *kind == b"BIN\0");
    Ok((text, binary.map(|(_, data, _)| data)))
}

/// Parts of the names of extensions that are supported or do not affect the positions of triangles.
const HARMLESS: [&str; 14] = [
    "_materials_",
    "_texture_",
    "_lights_",
    "_image_",
    "KHR_animation_pointer",
    "KHR_audio",
    "KHR_mesh_quantization",
    "KHR_techniques_webgl",
    "KHR_xmp",
    "EXT_mesh_gpu_instancing",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "MPEG_media",
];

/// Returns whether an extension is supported or does not affect the positions of triangles.
pub(super) fn is_known(extension: &str) -> bool {
    HARMLESS.iter().any(|part| extension.contains(part))
}

impl Document {
    fn check(&self) -> Result<(), Fault> {
        let version = &self.asset.version;
        if version != "2" && !version.starts_with("2.") {
            return Err(Fault::unexpected(format!("version {}", quote(version)), "glTF 2.0"));
        }
        match self.extensions_required.iter().find(|name| !is_known(name)) {
            None => Ok(()),
            Some(name) => {
                let expected = "an extension that is read, or that says nothing of where triangles are";
                Err(Fault::unexpected(format!("the required extension {}", quote(name)), expected))
            }
        }
    }

    /// Returns the nodes of the default scene, or of the first one.
    pub(super) fn roots(&self) -> Result<&[usize], Fault> {
        Ok(&entry(&self.scenes, self.scene.unwrap_or(0), "scene")?.nodes)
    }
}

/// Returns an entry of the document.
pub(super) fn entry<'a, T>(all: &'a [T], index: usize, name: &str) -> Result<&'a T, Fault> {
    all.get(index).ok_or_else(|| match all.len() {
        0 => Fault::unexpected(format!("no {name}"), format!("{name} {index}")),
        count => Fault::unexpected(format!("{name} {index}"), format!("a number less than {count}")),
    })
}

impl Buffer {
    /// Reads the bytes of the buffer, which may be followed by more.
    fn read<'a>(&self, binary: Option<&'a [u8]>, folder: Option<&Path>) -> Result<Cow<'a, [u8]>, Fault> {
        let bytes = match self.uri.as_deref() {
            None => Cow::Borrowed(binary.ok_or_else(|| Fault::unexpected("no data", "a uri or the binary part"))?),
            Some(uri) => Cow::Owned(match uri.strip_prefix("data:") {
                Some(data) => {
                    let base64 = data.split_once(";base64,").map(|(_, base64)| base64);
                    let bytes = base64.and_then(|base64| BASE64_STANDARD.decode(base64).ok());
                    bytes.ok_or_else(|| Fault::unexpected(quote(uri), "data in base64"))?
                }
                None => read_beside(uri, folder)?,
            }),
        };
        if bytes.len() < self.byte_length {
            return Err(Fault::unexpected(format!("{} bytes", bytes.len()), format!("{}", self.byte_length)));
        }
        Ok(match bytes {
            Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[..self.byte_length]),
            Cow::Owned(mut bytes) => {
                bytes.truncate(self.byte_length);
                Cow::Owned(bytes)
            }
        })
    }
}

/// Reads a file that a document names. Paths outside the document's folder are rejected.
fn read_beside(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, Fault> {
    let name = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    let is_below = Path::new(&*name).components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    let folder = folder.filter(|_| is_below && !name.contains(':'));
    let folder = folder.ok_or_else(|| Fault::unexpected(quote(uri), "the name of a file in the folder of this one"))?;
    match read_bytes(&folder.join(&*name), MOST_BYTES) {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err(Fault::unexpected(format!("{} of more than {MOST_BYTES} bytes", quote(uri)), "fewer")),
        Err(error) => Err(Fault::unexpected(format!("{}: {error}", quote(uri)), "a file that can be read")),
    }
}

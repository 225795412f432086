//! `NumPy` arrays (NEP 1: A simple file format for `NumPy` arrays).
//!
//! By hand: of the format, rays and hits take a line of header and plain numbers. `npyz` 0.9 brings 16 crates for it, a
//! generator of parsers among them.

use std::io::{self, BufRead, Read as _, Write};
use std::path::Path;

use serde::Deserialize;

use super::{COLUMNS, HitRow, LoadedRays, RayFault, RayFileError, UNBOUNDED};
use crate::float::{Float, Position, nan};
use crate::number::Number;
use crate::text::quote;

const MAGIC: &[u8] = b"\x93NUMPY";

/// Longest header, in bytes: those of arrays of numbers take about a hundred.
const LONGEST: u64 = 1 << 16;

const WANTED: &str = "an array of shape (n, 6) or (n, 8), dtype <f4 or <f8, in C order";

#[derive(Deserialize)]
struct Header {
    descr: String,
    fortran_order: bool,
    shape: Vec<u64>,
}

pub(super) fn read<V: Position>(reader: &mut impl BufRead, file: &Path) -> Result<LoadedRays<V>, RayFileError> {
    let failed = |error| RayFileError::Io { file: file.into(), error };
    let refused = |found: String, expected| RayFileError::Array { file: file.into(), found, expected };
    let mut start = Vec::new();
    reader.take(8).read_to_end(&mut start).map_err(failed)?;
    let Some([major, minor]) = start.strip_prefix(MAGIC).and_then(<[u8]>::first_chunk) else {
        return Err(refused(quote(&String::from_utf8_lossy(&start)), "an array as numpy.save writes it"));
    };
    let length_bytes = match (major, minor) {
        (1, 0) => 2,
        (2 | 3, 0) => 4,
        _ => return Err(refused(format!("version {major}.{minor}"), "version 1.0, 2.0 or 3.0 of NPY")),
    };
    let mut length = [0; 4];
    reader.read_exact(&mut length[..length_bytes]).map_err(failed)?;
    let length = u64::from(u32::from_le_bytes(length));
    if length > LONGEST {
        return Err(refused(format!("a header of {length} bytes"), WANTED));
    }
    let mut text = Vec::new();
    reader.take(length).read_to_end(&mut text).map_err(failed)?;
    let text = String::from_utf8_lossy(&text);
    let header = parse(&text).ok_or_else(|| refused(quote(text.trim()), WANTED))?;
    let (bytes, rows, columns) = match (header.descr.as_str(), &header.shape[..], header.fortran_order) {
        ("<f4", &[rows, columns @ (6 | 8)], false) => (4, rows, columns as usize),
        ("<f8", &[rows, columns @ (6 | 8)], false) => (8, rows, columns as usize),
        _ => return Err(refused(quote(text.trim()), WANTED)),
    };
    debug_assert!([UNBOUNDED, COLUMNS.len()].contains(&columns));
    // No count is believed before its bytes are there.
    let mut loaded = LoadedRays::new();
    let mut row = vec![0; bytes * columns];
    for number in 0..rows {
        let at = |fault| RayFileError::Line { file: file.into(), format: super::Format::Npy, number, fault };
        match reader.read_exact(&mut row) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                return Err(at(RayFault::Ends { expected: rows }));
            }
            read => read.map_err(failed)?,
        }
        let numbers: Vec<_> = row.chunks_exact(bytes).map(|bytes| Number::of(number_of(bytes))).collect();
        loaded.push(&numbers).map_err(at)?;
    }
    if !reader.fill_buf().map_err(failed)?.is_empty() {
        return Err(refused("more bytes".to_owned(), "the end of the file after the last row"));
    }
    Ok(loaded)
}

/// The number in 4 or 8 bytes.
fn number_of(bytes: &[u8]) -> f64 {
    match *bytes {
        [a, b, c, d] => f32::from_le_bytes([a, b, c, d]).into(),
        [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => f64::NAN,
    }
}

/// Reads a header, which is a Python literal: of such arrays it is JSON but for its brackets, quotes and commas.
fn parse(text: &str) -> Option<Header> {
    let compact: String = text.split_ascii_whitespace().collect();
    let json = compact.replace('\'', "\"").replace('(', "[").replace(')', "]");
    let json = json.replace("False", "false").replace("True", "true").replace(",]", "]").replace(",}", "}");
    serde_json::from_str(&json).ok()
}

pub(super) fn write<F: Float>(
    mut writer: impl Write,
    hits: impl ExactSizeIterator<Item = HitRow<F>>,
) -> io::Result<()> {
    let mut header = format!(
        "{{'descr': [('prim', '<i8'), ('t', '{0}'), ('u', '{0}'), ('v', '{0}')], \
         'fortran_order': False, 'shape': ({1},), }}",
        F::DTYPE,
        hits.len()
    );
    // With magic, version and length it ends where a multiple of 64 bytes does, so that arrays can be mapped.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    header.push_str(&" ".repeat(length - header.len() - 1));
    writer.write_all(MAGIC)?;
    writer.write_all(&[1, 0])?;
    writer.write_all(&(length as u16).to_le_bytes())?;
    writeln!(writer, "{header}")?;
    for hit in hits {
        let (prim, t, u, v) = hit.map_or((-1, F::INFINITY, nan(), nan()), |(prim, t, u, v)| (i64::from(prim), t, u, v));
        writer.write_all(&prim.to_le_bytes())?;
        for number in [t, u, v] {
            writer.write_all(number.bytes().as_ref())?;
        }
    }
    Ok(())
}

//! `NumPy` arrays (NEP 1: A simple file format for `NumPy` arrays).
//!
//! Implemented here, because rows and tables need only a header line and plain numbers. `npyz` 0.9 would add 16 crates,
//! including a parser generator.

use std::io::{self, BufRead, Read as _, Write};
use std::path::Path;

use serde::Deserialize;

use super::{Cell, Column, LoadedRows, Number, Row, RowFault, RowFileError};
use crate::float::Float;
use crate::text::quote;

const MAGIC: &[u8] = b"\x93NUMPY";

/// The maximum length of a header, in bytes. Headers of numeric arrays take about a hundred.
const LONGEST: u64 = 1 << 16;

#[derive(Deserialize)]
struct Header {
    descr: String,
    fortran_order: bool,
    shape: Vec<u64>,
}

pub(super) fn read<R: Row>(reader: &mut impl BufRead, file: &Path) -> Result<LoadedRows<R>, RowFileError> {
    let wanted = R::KIND.array();
    let failed = |error| RowFileError::Io { file: file.into(), error };
    let refused = |found: String, expected| RowFileError::Array { file: file.into(), found, expected };
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
        return Err(refused(format!("a header of {length} bytes"), wanted));
    }
    let mut text = Vec::new();
    reader.take(length).read_to_end(&mut text).map_err(failed)?;
    let text = String::from_utf8_lossy(&text);
    let header = parse(&text).ok_or_else(|| refused(quote(text.trim()), wanted))?;
    let (bytes, rows, columns) = match (header.descr.as_str(), &header.shape[..], header.fortran_order) {
        ("<f4", &[rows, columns], false) if R::KIND.allows(columns as usize) => (4, rows, columns as usize),
        ("<f8", &[rows, columns], false) if R::KIND.allows(columns as usize) => (8, rows, columns as usize),
        _ => return Err(refused(quote(text.trim()), wanted)),
    };
    // No count is trusted before its bytes are there.
    let mut loaded = LoadedRows::new();
    let mut row = vec![0; bytes * columns];
    for number in 0..rows {
        let at = |fault| RowFileError::Line { file: file.into(), format: super::Format::Npy, number, fault };
        match reader.read_exact(&mut row) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                return Err(at(RowFault::Ends { expected: rows }));
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

/// Decodes a number of 4 or 8 bytes.
fn number_of(bytes: &[u8]) -> f64 {
    match *bytes {
        [a, b, c, d] => f32::from_le_bytes([a, b, c, d]).into(),
        [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => f64::NAN,
    }
}

/// Parses a header, which is a Python literal. For these arrays it differs from JSON only in brackets, quotes and
/// commas.
fn parse(text: &str) -> Option<Header> {
    let compact: String = text.split_ascii_whitespace().collect();
    let json = compact.replace('\'', "\"").replace('(', "[").replace(')', "]");
    let json = json.replace("False", "false").replace("True", "true").replace(",]", "]").replace(",}", "}");
    serde_json::from_str(&json).ok()
}

pub(super) fn write<F: Float, const N: usize>(
    mut writer: impl Write,
    columns: [Column; N],
    rows: impl ExactSizeIterator<Item = [Cell<F>; N]>,
) -> io::Result<()> {
    let fields = columns.map(|column| match column {
        Column::Integer(name) => format!("('{name}', '<i8')"),
        Column::Number(name, _) => format!("('{name}', '{}')", F::DTYPE),
        Column::Word(name, letters) => format!("('{name}', '<U{letters}')"),
    });
    let (fields, count) = (fields.join(", "), rows.len());
    let mut header = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({count},), }}");
    // Magic, version, length and header end at a multiple of 64 bytes, so arrays can be mapped into memory.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    header.push_str(&" ".repeat(length - header.len() - 1));
    writer.write_all(MAGIC)?;
    writer.write_all(&[1, 0])?;
    writer.write_all(&(length as u16).to_le_bytes())?;
    writeln!(writer, "{header}")?;
    for row in rows {
        for (column, cell) in columns.into_iter().zip(row) {
            match column {
                Column::Integer(_) => {
                    let integer = if let Cell::Integer(integer) = cell { integer } else { -1 };
                    writer.write_all(&integer.to_le_bytes())?;
                }
                Column::Number(_, missing) => {
                    let number = if let Cell::Number(number) = cell { number } else { F::rounded(missing) };
                    writer.write_all(number.bytes().as_ref())?;
                }
                Column::Word(_, letters) => {
                    // In UTF-32, padded with zeros.
                    let word = if let Cell::Word(word) = cell { word } else { "" };
                    for letter in word.chars().map(u32::from).chain(std::iter::repeat(0)).take(letters) {
                        writer.write_all(&letter.to_le_bytes())?;
                    }
                }
            }
        }
    }
    Ok(())
}

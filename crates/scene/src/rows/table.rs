//! Tables of answers.

use std::io::{self, Write};

use super::{Format, csv, json_lines, npy};
use crate::float::Float;

/// A column of a table.
#[derive(Clone, Copy, Debug)]
pub enum Column {
    /// Integers.
    Integer(&'static str),
    /// Numbers, with the value for missing ones in an array: infinity or NaN.
    Number(&'static str, f64),
    /// Words, with the length of the longest one in letters.
    Word(&'static str, usize),
}

impl Column {
    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Integer(name) | Self::Number(name, _) | Self::Word(name, _) => name,
        }
    }
}

/// A value in a table.
#[derive(Clone, Copy, Debug)]
pub enum Cell<F = f32> {
    /// A value in a column of integers.
    Integer(i64),
    /// A value in a column of numbers.
    Number(F),
    /// A value in a column of words, in ASCII.
    Word(&'static str),
    /// No value: empty in comma-separated values, null in JSON.
    Missing,
}

/// Writes a table, one row per answer.
///
/// A number written as text reads back as the same float, with the least number of digits for that. In an array a row
/// is a record, missing integers are -1, and missing words are empty.
///
/// ```
/// use stackless_scene::{Cell, Column, Format, write_table};
///
/// let (columns, mut file) = ([Column::Integer("prim"), Column::Number("t", f64::INFINITY)], Vec::new());
/// let rows = [[Cell::Integer(3), Cell::Number(0.5_f32)], [Cell::Integer(-1), Cell::Missing]];
/// write_table(&mut file, columns, rows.into_iter(), Format::Csv)?;
/// assert_eq!(file, b"prim,t\n3,0.5\n-1,\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// The errors of the writer.
pub fn write_table<F: Float, const N: usize>(
    writer: impl Write,
    columns: [Column; N],
    rows: impl ExactSizeIterator<Item = [Cell<F>; N]>,
    format: Format,
) -> io::Result<()> {
    match format {
        Format::Csv => csv::write(writer, columns, rows),
        Format::JsonLines => json_lines::write(writer, columns, rows),
        Format::Npy => npy::write(writer, columns, rows),
    }
}

#[cfg(test)]
pub(super) mod tests;

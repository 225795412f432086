//! Files of rays, points and answers: comma-separated values, JSON lines, `NumPy` arrays.

mod csv;
mod json_lines;
mod kind;
mod npy;
mod table;

pub use kind::{Kind, Point, Row};
pub use table::{Cell, Column, write_table};

use super::Rounding;
use super::float::{Float, is_finite};
use super::number::Number;
use super::text::{one_line, quote};
use stackless_bvh::geom::RayError;
use std::fmt;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The maximum length of a line, in bytes. Eight numbers take a few hundred.
const LONGEST: usize = 4096;

/// The format of a file of rays, points or answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values: a ray is `ox,oy,oz,dx,dy,dz,tmin,tmax`, a point `x,y,z`, a hit `prim,t,u,v`.
    #[default]
    Csv,
    /// One object per line: a ray is `{"origin":[..],"direction":[..],"tmin":0,"tmax":null}`, a point
    /// `{"point":[..]}`, a hit `{"prim":0,"t":1.0,"u":0.5,"v":0.5}`.
    JsonLines,
    /// A `NumPy` array: rays are rows of 6 or 8 floats, points rows of 3, answers records with named fields.
    Npy,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Csv, Self::JsonLines, Self::Npy];

    /// Returns the name, which is also the extension of files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::JsonLines => "jsonl",
            Self::Npy => "npy",
        }
    }

    /// Returns the format of a file's extension; `None` without an extension.
    ///
    /// # Errors
    /// [`UnknownFormat`]: the extension is unknown.
    pub fn of(path: &Path) -> Result<Option<Self>, UnknownFormat> {
        let parse = |extension: &std::ffi::OsStr| {
            let extension = extension.to_string_lossy().to_ascii_lowercase();
            extension.parse().map_err(|_| UnknownFormat(format!("{}: extension {}", one_line(path), quote(&extension))))
        };
        path.extension().map(parse).transpose()
    }
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        let found = Self::ALL.into_iter().find(|format| format.name() == name || format.other_name() == Some(name));
        found.ok_or_else(|| UnknownFormat(format!("found {}", quote(name))))
    }
}

impl Format {
    /// Returns another common extension.
    fn other_name(self) -> Option<&'static str> {
        (self == Self::JsonLines).then_some("ndjson")
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An unknown name or extension.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}, expected csv, jsonl or npy")]
pub struct UnknownFormat(String);

/// Errors of reading rays or points. The message is one line that begins with the file.
#[derive(Debug, thiserror::Error)]
pub enum RowFileError {
    /// The file is missing or cannot be read.
    #[error("{}: cannot be read: {error}", one_line(.file))]
    Io {
        /// The file.
        file: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
    /// The file has no rows.
    #[error("{}: no {}, expected at least one {}", one_line(.file), .kind.plural(), .kind.row(*.format))]
    Empty {
        /// The file.
        file: PathBuf,
        /// The kind of row.
        kind: Kind,
        /// The format of the file.
        format: Format,
    },
    /// A line or a row is invalid.
    #[error("{}: {} {number}: {fault}", one_line(.file), if *.format == Format::Npy { "row" } else { "line" })]
    Line {
        /// The file.
        file: PathBuf,
        /// The format of the file.
        format: Format,
        /// Number of the line, counted from 1, or of the row, counted from 0.
        number: u64,
        /// The fault.
        fault: RowFault,
    },
    /// The bytes before the rows are invalid.
    #[error("{}: found {found}, expected {expected}", one_line(.file))]
    Array {
        /// The file.
        file: PathBuf,
        /// The text found, shortened.
        found: String,
        /// The expected text.
        expected: &'static str,
    },
}

/// Faults of a line or a row.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowFault {
    /// The line is longer than any row.
    #[error("more than {LONGEST} bytes, expected a {}", .0.row(*.1))]
    Length(Kind, Format),
    /// The number of columns is wrong.
    #[error("{found} columns, expected {}: {}", kind.expected(*.first), .kind.columns().join(","))]
    Columns {
        /// The kind of row.
        kind: Kind,
        /// Number of columns found.
        found: usize,
        /// Number of columns in the first row.
        first: Option<usize>,
    },
    /// A column is not a valid number.
    #[error("column {column}: found {found}, expected {expected} in {precision} precision")]
    Number {
        /// The name of the column.
        column: &'static str,
        /// The text found, shortened.
        found: String,
        /// The expected text.
        expected: &'static str,
        /// The precision: `single` or `double`.
        precision: &'static str,
    },
    /// The line is not a valid JSON object.
    #[error("{found}, expected a {}", .kind.row(Format::JsonLines))]
    Object {
        /// The kind of row.
        kind: Kind,
        /// A description of the fault.
        found: String,
    },
    /// The file is truncated.
    #[error("the file ends, expected {expected} rows")]
    Ends {
        /// Number of rows in the array.
        expected: u64,
    },
    /// The numbers are not a valid ray.
    #[error(transparent)]
    Ray(#[from] RayError),
}

/// The rays or points of a file.
#[derive(Clone, Debug)]
pub struct LoadedRows<R> {
    /// The rows, at least one.
    pub rows: Vec<R>,
    /// The number of rounded numbers, and bounds of their errors.
    pub rounding: Rounding,
}

impl<R: Row> LoadedRows<R> {
    /// Returns the note for the user, one line that begins with the file; `None` if nothing was rounded. `size` is the
    /// [`size`](super::size) of the scene for these rows.
    pub fn note(&self, file: &Path, size: f64) -> Option<String> {
        let rounded = self.rounding.note::<R::Real>(size)?;
        Some(format!("{}: {rounded}", one_line(file)))
    }
}

/// Reads rays or points from a file. `R` is [`Ray`](stackless_bvh::geom::Ray) or [`Point`].
///
/// - Comma-separated values: a line of rays is `ox,oy,oz,dx,dy,dz,tmin,tmax`, and a line of points is `x,y,z`. The
///   first line may contain these names. If the first line of numbers omits the last two columns, all lines must, and
///   intervals are from 0 to infinity. Blank lines and lines that begin with `#` are skipped.
/// - JSON lines: a ray has `origin` and `direction`, and optionally `tmin` and `tmax`, where null means infinity. A
///   point is `{"point":[x,y,z]}`.
/// - `NumPy` arrays: rows of 6 or 8 numbers for rays and of 3 for points (`<f4` or `<f8`).
///
/// A line of text ends with a line feed, a carriage return, or both characters, and has at most 4 KiB. A byte order
/// mark is ignored. Numbers are rounded to the precision of `R`; only `tmax` may be infinite.
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_scene::{Format, Point, read_rows_from};
///
/// let points = read_rows_from::<Point<Vec3>>(&b"x,y,z\n1,2,3\n"[..], "points.csv", Format::Csv)?;
/// assert_eq!(points.rows, [Point(Vec3::new(1.0, 2.0, 3.0))]);
/// # Ok::<(), stackless_scene::RowFileError>(())
/// ```
///
/// # Errors
/// [`RowFileError`]. For an invalid line it names line and column.
pub fn read_rows<R: Row>(path: &Path, format: Format) -> Result<LoadedRows<R>, RowFileError> {
    let file = File::open(path).map_err(|error| RowFileError::Io { file: path.into(), error })?;
    read_rows_from(BufReader::new(file), path, format)
}

/// Reads rays or points from any reader, like [`read_rows`]. `name` replaces the file in errors.
///
/// # Errors
/// The errors of [`read_rows`].
pub fn read_rows_from<R: Row>(
    mut reader: impl BufRead,
    name: impl AsRef<Path>,
    format: Format,
) -> Result<LoadedRows<R>, RowFileError> {
    let file = name.as_ref();
    let loaded = match format {
        Format::Csv => {
            let mut first = None;
            lines(&mut reader, file, format, |line| csv::read::<R>(line, &mut first))?
        }
        Format::JsonLines => lines(&mut reader, file, format, json_lines::read::<R>)?,
        Format::Npy => npy::read(&mut reader, file)?,
    };
    if loaded.rows.is_empty() {
        return Err(RowFileError::Empty { file: file.into(), kind: R::KIND, format });
    }
    Ok(loaded)
}

/// The numbers of a row: of all columns, or without the optional ones.
type Numbers<R> = Vec<Number<<R as Row>::Real>>;

/// Reads a file line by line. `read` returns `None` for a line without a row.
fn lines<R: Row>(
    reader: &mut impl BufRead,
    file: &Path,
    format: Format,
    mut read: impl FnMut(&str) -> Result<Option<Numbers<R>>, RowFault>,
) -> Result<LoadedRows<R>, RowFileError> {
    let (mut loaded, mut bytes) = (LoadedRows::new(), Vec::new());
    for number in 1.. {
        if !read_line(reader, &mut bytes).map_err(|error| RowFileError::Io { file: file.into(), error })? {
            break;
        }
        let at = |fault| RowFileError::Line { file: file.into(), format, number, fault };
        if bytes.len() > LONGEST {
            return Err(at(RowFault::Length(R::KIND, format)));
        }
        if number == 1 && [&b"\xFF\xFE"[..], b"\xFE\xFF"].iter().any(|mark| bytes.starts_with(mark)) {
            let (found, expected) = ("a text in UTF-16".into(), "one in UTF-8");
            return Err(RowFileError::Array { file: file.into(), found, expected });
        }
        let content = if number == 1 { super::text::without_mark(&bytes) } else { &bytes };
        let text = String::from_utf8_lossy(content);
        let text = text.trim();
        if !text.is_empty() && !text.starts_with('#') {
            read(text).and_then(|numbers| numbers.map_or(Ok(()), |numbers| loaded.push(&numbers))).map_err(at)?;
        }
    }
    Ok(loaded)
}

/// Reads a line without its line end, and only the beginning of a line that is too long. Returns `false` at the end.
fn read_line(reader: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<bool> {
    line.clear();
    let mut is_end = true;
    while line.len() <= LONGEST {
        let available = reader.fill_buf()?;
        if available.is_empty() {
            return Ok(!is_end);
        }
        is_end = false;
        let end = available.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let taken = end.unwrap_or(available.len()).min(LONGEST + 1 - line.len());
        line.extend_from_slice(&available[..taken]);
        let Some(end) = end.filter(|&end| end == taken) else {
            reader.consume(taken);
            continue;
        };
        let is_return = available[end] == b'\r';
        reader.consume(end + 1);
        if is_return && reader.fill_buf()?.first() == Some(&b'\n') {
            reader.consume(1);
        }
        break;
    }
    Ok(true)
}

impl<R: Row> LoadedRows<R> {
    fn new() -> Self {
        Self { rows: Vec::new(), rounding: Rounding::default() }
    }

    /// Adds a row with these numbers.
    fn push(&mut self, numbers: &[Number<R::Real>]) -> Result<(), RowFault> {
        for (number, column) in numbers.iter().zip(R::KIND.columns()) {
            check(*number, column, || match number.error {
                f64::INFINITY => "a number out of range".into(),
                _ => number.value.into().to_string(),
            })?;
        }
        self.rows.push(R::new(numbers, &mut self.rounding)?);
        Ok(())
    }
}

/// Rejects numbers that are invalid in every column, or in this one.
fn check<F: Float>(number: Number<F>, column: &'static str, found: impl FnOnce() -> String) -> Result<(), RowFault> {
    let may_be_infinite = column == "tmax";
    if is_finite(number.value) || may_be_infinite && number == Number::exact(F::INFINITY) {
        return Ok(());
    }
    let (found, precision) = (found(), F::PRECISION);
    let expected = if may_be_infinite { "a number or inf" } else { "a finite number" };
    Err(RowFault::Number { column, found, expected, precision })
}

#[cfg(test)]
mod tests;

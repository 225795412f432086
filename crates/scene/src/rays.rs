//! Rays to trace and hits found, in files: comma-separated values, JSON lines, `NumPy` arrays.

mod csv;
mod json_lines;
mod npy;

use super::Rounding;
use super::float::{Float, Position, is_finite};
use super::number::Number;
use super::text::{one_line, quote};
use glam::Vec3;
use stackless_bvh::geom::{Ray, RayError, Real as _};
use std::fmt;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Names of the columns, in order. The last two may be missing.
const COLUMNS: [&str; 8] = ["ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"];

/// How many numbers a ray has without its interval, which then has no end.
const UNBOUNDED: usize = 6;

/// Longest line, in bytes: eight numbers take a few hundred.
const LONGEST: usize = 4096;

/// How rays and hits stand in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values: a ray is `ox,oy,oz,dx,dy,dz,tmin,tmax`, a hit `prim,t,u,v`.
    #[default]
    Csv,
    /// An object a line: a ray is `{"origin":[..],"direction":[..],"tmin":0,"tmax":null}`, a hit
    /// `{"prim":0,"t":1.0,"u":0.5,"v":0.5}`.
    JsonLines,
    /// A `NumPy` array: rays are rows of 6 or 8 floats, hits records of `prim`, `t`, `u`, `v`.
    Npy,
}

impl Format {
    /// All.
    pub const ALL: [Self; 3] = [Self::Csv, Self::JsonLines, Self::Npy];

    /// Its name, which is also the extension of its files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::JsonLines => "jsonl",
            Self::Npy => "npy",
        }
    }

    /// What the extension of a file says; `None` without one.
    ///
    /// # Errors
    /// [`UnknownFormat`]: another extension.
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
    /// Another extension that is in use.
    fn other_name(self) -> Option<&'static str> {
        (self == Self::JsonLines).then_some("ndjson")
    }

    /// What a ray looks like.
    fn row(self) -> String {
        match self {
            Self::Csv => format!("line of {}", COLUMNS.join(",")),
            Self::JsonLines => r#"line like {"origin":[0,0,0],"direction":[0,0,1],"tmin":0,"tmax":null}"#.to_owned(),
            Self::Npy => "row of 6 or 8 numbers".to_owned(),
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name or an extension of no format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}, expected csv, jsonl or npy")]
pub struct UnknownFormat(String);

/// Why a file holds no rays. One line that begins with the file.
#[derive(Debug, thiserror::Error)]
pub enum RayFileError {
    /// The file is missing or cannot be read.
    #[error("{}: cannot be read: {error}", one_line(.file))]
    Io {
        /// The file.
        file: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// There is not one ray.
    #[error("{}: no rays, expected at least one {}", one_line(.file), .format.row())]
    Empty {
        /// The file.
        file: PathBuf,
        /// What it was read as.
        format: Format,
    },
    /// A line or a row is not a ray.
    #[error("{}: {} {number}: {fault}", one_line(.file), if *.format == Format::Npy { "row" } else { "line" })]
    Line {
        /// The file.
        file: PathBuf,
        /// What it was read as.
        format: Format,
        /// Number of the line, counted from 1, or of the row, counted from 0.
        number: u64,
        /// What is wrong.
        fault: RayFault,
    },
    /// What stands before the rows is not that of an array of rays.
    #[error("{}: found {found}, expected {expected}", one_line(.file))]
    Array {
        /// The file.
        file: PathBuf,
        /// What stands there, shortened.
        found: String,
        /// What should.
        expected: &'static str,
    },
}

/// Why a line or a row is not a ray.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RayFault {
    /// It is longer than any ray.
    #[error("more than {LONGEST} bytes, expected a {}", .0.row())]
    Length(Format),
    /// Too many or too few columns.
    #[error("{found} columns, expected {expected}: {}", COLUMNS.join(","))]
    Columns {
        /// How many there are.
        found: usize,
        /// How many there should be: as in the first line.
        expected: &'static str,
    },
    /// A column is not such a number as it should be.
    #[error("column {column}: found {found}, expected {expected} in {precision} precision")]
    Number {
        /// Name of the column.
        column: &'static str,
        /// What stands there, shortened.
        found: String,
        /// What should.
        expected: &'static str,
        /// What is read: `single` or `double`.
        precision: &'static str,
    },
    /// It is not such an object as it should be.
    #[error("{found}, expected a {}", Format::JsonLines.row())]
    Object {
        /// What is wrong with it.
        found: String,
    },
    /// The file is cut off.
    #[error("the file ends, expected {expected} rows")]
    Ends {
        /// How many the array has.
        expected: u64,
    },
    /// The numbers are not a ray.
    #[error(transparent)]
    Ray(#[from] RayError),
}

/// The rays of a file.
#[derive(Clone, Debug)]
pub struct LoadedRays<V: Position = Vec3> {
    /// The rays, at least one.
    pub rays: Vec<Ray<V>>,
    /// How many numbers were rounded, and by how much.
    pub rounding: Rounding,
}

impl<V: Position> LoadedRays<V> {
    /// Returns the note for the user: one line that begins with the file. `None` if all was taken as it is. `size` is the
    /// [`size`](super::size) of the scene that the rays are for.
    pub fn note(&self, file: &Path, size: f64) -> Option<String> {
        let rounded = self.rounding.note::<V::Real>(size)?;
        Some(format!("{}: {rounded}", one_line(file)))
    }
}

/// Reads rays from a file.
///
/// Of comma-separated values each line is `ox,oy,oz,dx,dy,dz,tmin,tmax`, in all lines without the last two if so in the
/// first: then an interval is from 0 to infinity. These names may stand above the rays. Blank lines and lines that begin
/// with `#` are skipped. A line ends with a line feed, a carriage return, or both, and is at most 4 KiB long; a byte order
/// mark does not count.
///
/// Of JSON lines each is an object with `origin` and `direction`, and perhaps `tmin` and `tmax`, where null is infinity. A
/// `NumPy` array has rows of 6 or 8 numbers (`<f4` or `<f8`). Numbers are rounded to what is read; only `tmax` may be
/// infinite.
///
/// # Errors
/// [`RayFileError`]; for a bad line it names line and column.
pub fn read_rays<V: Position>(path: &Path, format: Format) -> Result<LoadedRays<V>, RayFileError> {
    let file = File::open(path).map_err(|error| RayFileError::Io { file: path.into(), error })?;
    read_rays_from(BufReader::new(file), path, format)
}

/// As [`read_rays`], from any reader; `name` stands for the file in errors.
///
/// # Errors
/// As [`read_rays`].
pub fn read_rays_from<V: Position>(
    mut reader: impl BufRead,
    name: impl AsRef<Path>,
    format: Format,
) -> Result<LoadedRays<V>, RayFileError> {
    let file = name.as_ref();
    let loaded = match format {
        Format::Csv => lines(&mut reader, file, format, csv::Reader::default())?,
        Format::JsonLines => lines(&mut reader, file, format, json_lines::Reader)?,
        Format::Npy => npy::read(&mut reader, file)?,
    };
    if loaded.rays.is_empty() { Err(RayFileError::Empty { file: file.into(), format }) } else { Ok(loaded) }
}

/// Reads a line.
trait LineReader<V: Position> {
    /// Adds the ray in it, if it is not there for something else.
    fn read(&mut self, line: &str, loaded: &mut LoadedRays<V>) -> Result<(), RayFault>;
}

fn lines<V: Position>(
    reader: &mut impl BufRead,
    file: &Path,
    format: Format,
    mut each: impl LineReader<V>,
) -> Result<LoadedRays<V>, RayFileError> {
    let (mut loaded, mut bytes) = (LoadedRays::new(), Vec::new());
    for number in 1.. {
        if !read_line(reader, &mut bytes).map_err(|error| RayFileError::Io { file: file.into(), error })? {
            break;
        }
        let at = |fault| RayFileError::Line { file: file.into(), format, number, fault };
        if bytes.len() > LONGEST {
            return Err(at(RayFault::Length(format)));
        }
        if number == 1 && [&b"\xFF\xFE"[..], b"\xFE\xFF"].iter().any(|mark| bytes.starts_with(mark)) {
            let (found, expected) = ("a text in UTF-16".into(), "one in UTF-8");
            return Err(RayFileError::Array { file: file.into(), found, expected });
        }
        let content = if number == 1 { super::text::without_mark(&bytes) } else { &bytes };
        let text = String::from_utf8_lossy(content);
        let text = text.trim();
        if !text.is_empty() && !text.starts_with('#') {
            each.read(text, &mut loaded).map_err(at)?;
        }
    }
    Ok(loaded)
}

/// Reads a line without what ends it, and of one that is too long no more than shows it. `false` at the end.
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

impl<V: Position> LoadedRays<V> {
    fn new() -> Self {
        Self { rays: Vec::new(), rounding: Rounding::default() }
    }

    /// Adds the ray of these numbers: of all columns, or of those without the interval.
    fn push(&mut self, numbers: &[Number<V::Real>]) -> Result<(), RayFault> {
        for (number, column) in numbers.iter().zip(COLUMNS) {
            check(*number, column, || match number.error {
                f64::INFINITY => "a number out of range".into(),
                _ => number.value.into().to_string(),
            })?;
        }
        let point = |first: usize| V::from_components([0, 1, 2].map(|axis| numbers[first + axis].value));
        let interval = numbers.get(6..8).map(|ends| (ends[0].value, ends[1].value));
        let (tmin, tmax) = interval.unwrap_or((V::Real::default(), V::Real::INFINITY));
        let ray = Ray::within(point(0), point(3), tmin, tmax)?;
        self.rounding.ray(numbers, &ray);
        self.rays.push(ray);
        Ok(())
    }
}

/// Refuses what no column, or not this one, may be.
fn check<F: Float>(number: Number<F>, column: &'static str, found: impl FnOnce() -> String) -> Result<(), RayFault> {
    let may_be_infinite = column == "tmax";
    if is_finite(number.value) || may_be_infinite && number == Number::exact(F::INFINITY) {
        return Ok(());
    }
    let (found, precision) = (found(), F::PRECISION);
    let expected = if may_be_infinite { "a number or inf" } else { "a finite number" };
    Err(RayFault::Number { column, found, expected, precision })
}

/// What a ray hits: the triangle's index in the mesh, distance, and weights of its second and third corner.
pub type HitRow<F = f32> = Option<(u32, F, F, F)>;

/// Writes what each ray hits, in order.
///
/// `prim` is the triangle's index in the mesh, or -1 for a miss; then the other columns are empty, null, or as in
/// `stackless_bvh` for Python infinite and not a number. A number reads back as the very same float: as text it has as
/// few digits as that takes.
///
/// # Errors
/// Those of the writer.
pub fn write_hits<F: Float>(
    writer: impl Write,
    hits: impl ExactSizeIterator<Item = HitRow<F>>,
    format: Format,
) -> io::Result<()> {
    match format {
        Format::Csv => csv::write(writer, hits),
        Format::JsonLines => json_lines::write(writer, hits),
        Format::Npy => npy::write(writer, hits),
    }
}

#[cfg(test)]
mod tests;

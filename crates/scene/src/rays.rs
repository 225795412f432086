//! Rays to trace and hits found, as comma-separated values.

use super::text::{one_line, quote, without_mark};
use glam::Vec3;
use stackless_bvh::geom::{Ray, RayError};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

/// Names of the columns, in order.
const COLUMNS: [&str; 8] = ["ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"];

/// Longest line, in bytes: eight numbers take a few hundred.
const LONGEST: usize = 4096;

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
    #[error("{}: no rays, expected at least one line of {}", one_line(.file), COLUMNS.join(","))]
    Empty {
        /// The file.
        file: PathBuf,
    },
    /// A line is not a ray.
    #[error("{}: line {line}: {fault}", one_line(.file))]
    Line {
        /// The file.
        file: PathBuf,
        /// Number of the line, counted from 1.
        line: u64,
        /// What is wrong.
        fault: RayFault,
    },
}

/// Why a line is not a ray.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RayFault {
    /// It is longer than any ray.
    #[error("more than {LONGEST} bytes, expected {}", COLUMNS.join(","))]
    Length,
    /// Too many or too few columns.
    #[error("{found} columns, expected {}: {}", COLUMNS.len(), COLUMNS.join(","))]
    Columns {
        /// How many there are.
        found: usize,
    },
    /// A column is not such a number as it should be.
    #[error("column {column}: found {found}, expected {expected}")]
    Number {
        /// Name of the column.
        column: &'static str,
        /// What stands there, shortened.
        found: String,
        /// What should.
        expected: &'static str,
    },
    /// The numbers are not a ray.
    #[error(transparent)]
    Ray(#[from] RayError),
}

/// Reads rays from a file of comma-separated values, one a line: `ox,oy,oz,dx,dy,dz,tmin,tmax`.
///
/// These names may stand above the rays. Blank lines and lines that begin with `#` are skipped. A line ends with a line
/// feed, a carriage return, or both, and is at most 4 KiB long; a byte order mark does not count. Numbers are rounded to
/// single precision; only `tmax` may be `inf`.
///
/// # Errors
/// [`RayFileError`]; for a bad line it names line and column.
pub fn read_rays(path: &Path) -> Result<Vec<Ray>, RayFileError> {
    let file = File::open(path).map_err(|error| RayFileError::Io { file: path.into(), error })?;
    read_rays_from(BufReader::new(file), path)
}

/// As [`read_rays`], from any reader; `name` stands for the file in errors.
///
/// # Errors
/// As [`read_rays`].
pub fn read_rays_from(mut reader: impl BufRead, name: impl AsRef<Path>) -> Result<Vec<Ray>, RayFileError> {
    let file = || name.as_ref().to_path_buf();
    let mut rays = Vec::new();
    let mut names_may_follow = true;
    let mut bytes = Vec::new();
    for line in 1.. {
        if !read_line(&mut reader, &mut bytes).map_err(|error| RayFileError::Io { file: file(), error })? {
            break;
        }
        let at = |fault| RayFileError::Line { file: file(), line, fault };
        if bytes.len() > LONGEST {
            return Err(at(RayFault::Length));
        }
        let content = if line == 1 { without_mark(&bytes) } else { &bytes };
        let text = String::from_utf8_lossy(content);
        let text = text.trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        if !(names_may_follow && text.split(',').map(str::trim).eq(COLUMNS)) {
            rays.push(parse(text).map_err(at)?);
        }
        names_may_follow = false;
    }
    if rays.is_empty() { Err(RayFileError::Empty { file: file() }) } else { Ok(rays) }
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

fn parse(line: &str) -> Result<Ray, RayFault> {
    let found = line.split(',').count();
    if found != COLUMNS.len() {
        return Err(RayFault::Columns { found });
    }
    let mut numbers = [0.0; COLUMNS.len()];
    for ((number, word), column) in numbers.iter_mut().zip(line.split(',')).zip(COLUMNS) {
        *number = parse_number(word.trim(), column)?;
    }
    let [ox, oy, oz, dx, dy, dz, tmin, tmax] = numbers;
    Ok(Ray::within(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz), tmin, tmax)?)
}

fn parse_number(word: &str, column: &'static str) -> Result<f32, RayFault> {
    let may_be_infinite = column == "tmax";
    match word.parse::<f32>() {
        Ok(number) if number.is_finite() || may_be_infinite && number == f32::INFINITY => Ok(number),
        _ => {
            let expected = if may_be_infinite { "a number or inf" } else { "a finite number" };
            Err(RayFault::Number { column, found: quote(word), expected })
        }
    }
}

/// Writes what each ray hits, in order, one a line: the columns `prim,t,u,v`.
///
/// `prim` is the triangle's index in the mesh; `-1` and empty columns mean a miss. A number reads back as the very
/// same float: it is printed with as few digits as that takes.
///
/// # Errors
/// Those of the writer.
pub fn write_hits(mut writer: impl Write, hits: impl Iterator<Item = Option<(u32, f32, f32, f32)>>) -> io::Result<()> {
    writeln!(writer, "prim,t,u,v")?;
    for hit in hits {
        match hit {
            Some((prim, t, u, v)) => writeln!(writer, "{prim},{t:?},{u:?},{v:?}")?,
            None => writeln!(writer, "-1,,,")?,
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;

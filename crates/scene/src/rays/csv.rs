//! Comma-separated values.

use std::io::{self, Write};

use super::{COLUMNS, HitRow, LineReader, LoadedRays, RayFault, UNBOUNDED, check};
use crate::float::{Float, Position, nan};
use crate::number::Number;
use crate::text::quote;

/// Reads a ray a line. The first line says how many columns all have.
#[derive(Default)]
pub(super) struct Reader {
    columns: Option<usize>,
}

impl<V: Position> LineReader<V> for Reader {
    fn read(&mut self, line: &str, loaded: &mut LoadedRays<V>) -> Result<(), RayFault> {
        let found = line.split(',').count();
        let is_first = self.columns.is_none();
        let is_fit = self.columns.map_or([UNBOUNDED, COLUMNS.len()].contains(&found), |columns| found == columns);
        if !is_fit {
            return Err(RayFault::Columns { found, expected: self.expected() });
        }
        self.columns = Some(found);
        if is_first && line.split(',').map(str::trim).eq(COLUMNS.into_iter().take(found)) {
            return Ok(());
        }
        let mut numbers = [Number::default(); COLUMNS.len()];
        for ((number, word), column) in numbers.iter_mut().zip(line.split(',')).zip(COLUMNS) {
            let word = word.trim();
            // What is no number is not finite either.
            *number = Number::parse(word).unwrap_or(Number::exact(nan()));
            check(*number, column, || quote(word))?;
        }
        loaded.push(&numbers[..found])
    }
}

impl Reader {
    fn expected(&self) -> &'static str {
        match self.columns {
            None => "6 or 8",
            Some(UNBOUNDED) => "6 as above",
            Some(_) => "8 as above",
        }
    }
}

pub(super) fn write<F: Float>(mut writer: impl Write, hits: impl Iterator<Item = HitRow<F>>) -> io::Result<()> {
    writeln!(writer, "prim,t,u,v")?;
    for hit in hits {
        match hit {
            Some((prim, t, u, v)) => writeln!(writer, "{prim},{t:?},{u:?},{v:?}")?,
            None => writeln!(writer, "-1,,,")?,
        }
    }
    Ok(())
}

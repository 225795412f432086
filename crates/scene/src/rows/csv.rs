//! Comma-separated values.

use std::io::{self, Write};

use super::{Cell, Column, Number, Numbers, Row, RowFault, check};
use crate::float::{Float, nan};
use crate::text::quote;

/// Reads a line. The first one, which may have names, determines the number of columns.
pub(super) fn read<R: Row>(line: &str, first: &mut Option<usize>) -> Result<Option<Numbers<R>>, RowFault> {
    let (kind, found) = (R::KIND, line.split(',').count());
    if first.map_or_else(|| !kind.allows(found), |columns| found != columns) {
        return Err(RowFault::Columns { kind, found, first: *first });
    }
    let is_first = first.replace(found).is_none();
    let words = || line.split(',').map(str::trim);
    if is_first && words().eq(kind.columns().iter().copied().take(found)) {
        return Ok(None);
    }
    let number = |(word, column): (&str, &&'static str)| {
        // A word that is not a number is treated as one that is not finite.
        let number = Number::parse(word).unwrap_or(Number::exact(nan()));
        check(number, column, || quote(word)).map(|()| number)
    };
    words().zip(kind.columns()).map(number).collect::<Result<_, _>>().map(Some)
}

pub(super) fn write<F: Float, const N: usize>(
    mut writer: impl Write,
    columns: [Column; N],
    rows: impl Iterator<Item = [Cell<F>; N]>,
) -> io::Result<()> {
    writeln!(writer, "{}", columns.map(Column::name).join(","))?;
    for row in rows {
        for (i, cell) in row.into_iter().enumerate() {
            if i > 0 {
                writer.write_all(b",")?;
            }
            match cell {
                Cell::Integer(integer) => write!(writer, "{integer}")?,
                Cell::Number(number) => write!(writer, "{number:?}")?,
                Cell::Word(word) => writer.write_all(word.as_bytes())?,
                Cell::Missing => {}
            }
        }
        writeln!(writer)?;
    }
    Ok(())
}

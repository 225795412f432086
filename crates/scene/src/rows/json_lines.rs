//! JSON lines.

use std::io::{self, Write};

use serde::Serialize;

use super::{Cell, Column, Numbers, Row, RowFault};
use crate::float::Float;
use crate::text::of_json;

pub(super) fn read<R: Row>(line: &str) -> Result<Option<Numbers<R>>, RowFault> {
    R::of_json(line).map(Some).map_err(|error| RowFault::Object { kind: R::KIND, found: of_json(&error) })
}

pub(super) fn write<F: Float, const N: usize>(
    mut writer: impl Write,
    columns: [Column; N],
    rows: impl Iterator<Item = [Cell<F>; N]>,
) -> io::Result<()> {
    for row in rows {
        for (i, (column, cell)) in columns.into_iter().zip(row).enumerate() {
            write!(writer, "{}\"{}\":", if i == 0 { '{' } else { ',' }, column.name())?;
            serde_json::to_writer(&mut writer, &cell)?;
        }
        writeln!(writer, "}}")?;
    }
    Ok(())
}

impl<F: Float> Serialize for Cell<F> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Integer(integer) => integer.serialize(serializer),
            Self::Number(number) => number.serialize(serializer),
            Self::Word(word) => word.serialize(serializer),
            Self::Missing => serializer.serialize_unit(),
        }
    }
}

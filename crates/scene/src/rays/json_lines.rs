//! JSON lines.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};
use stackless_bvh::geom::Real as _;

use super::{COLUMNS, HitRow, LineReader, LoadedRays, RayFault, UNBOUNDED};
use crate::float::{Float, Position};
use crate::number::Number;
use crate::text::of_json;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound = "F: Float")]
struct RayLine<F> {
    origin: [Number<F>; 3],
    direction: [Number<F>; 3],
    #[serde(default)]
    tmin: Number<F>,
    /// JSON has no infinity.
    tmax: Option<Number<F>>,
}

#[derive(Serialize)]
struct HitLine<F> {
    prim: i64,
    t: Option<F>,
    u: Option<F>,
    v: Option<F>,
}

pub(super) struct Reader;

impl<V: Position> LineReader<V> for Reader {
    fn read(&mut self, line: &str, loaded: &mut LoadedRays<V>) -> Result<(), RayFault> {
        let RayLine { origin: [ox, oy, oz], direction: [dx, dy, dz], tmin, tmax } =
            serde_json::from_str(line).map_err(|error| RayFault::Object { found: of_json(&error) })?;
        let columns = if (tmin, tmax) == (Number::default(), None) { UNBOUNDED } else { COLUMNS.len() };
        let tmax = tmax.unwrap_or(Number::exact(V::Real::INFINITY));
        loaded.push(&[ox, oy, oz, dx, dy, dz, tmin, tmax][..columns])
    }
}

pub(super) fn write<F: Float>(mut writer: impl Write, hits: impl Iterator<Item = HitRow<F>>) -> io::Result<()> {
    for hit in hits {
        let line = match hit {
            Some((prim, t, u, v)) => HitLine { prim: prim.into(), t: Some(t), u: Some(u), v: Some(v) },
            None => HitLine { prim: -1, t: None, u: None, v: None },
        };
        serde_json::to_writer(&mut writer, &line)?;
        writeln!(writer)?;
    }
    Ok(())
}

//! The kinds of rows: rays and points.

use serde::Deserialize;
use stackless_bvh::geom::{Ray, Real as _};

use super::{Format, Number, RowFault};
use crate::Rounding;
use crate::float::{Float, Position};

/// A kind of row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An origin, a direction, and optionally an interval.
    Ray,
    /// Three coordinates.
    Point,
}

impl Kind {
    /// Returns the columns, in order.
    pub const fn columns(self) -> &'static [&'static str] {
        match self {
            Self::Ray => &["ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"],
            Self::Point => &["x", "y", "z"],
        }
    }

    /// Returns the number of required columns.
    pub(super) const fn least(self) -> usize {
        match self {
            Self::Ray => 6,
            Self::Point => 3,
        }
    }

    pub(super) fn allows(self, columns: usize) -> bool {
        columns == self.least() || columns == self.columns().len()
    }

    /// Describes the expected number of columns, with or without a first row.
    pub(super) fn expected(self, first: Option<usize>) -> String {
        match (first, self.least(), self.columns().len()) {
            (Some(first), least, all) if least < all => format!("{first} as above"),
            (_, least, all) if least < all => format!("{least} or {all}"),
            (_, _, all) => all.to_string(),
        }
    }

    pub(super) const fn plural(self) -> &'static str {
        match self {
            Self::Ray => "rays",
            Self::Point => "points",
        }
    }

    /// Describes the shape and type of an array of such rows.
    pub(super) const fn array(self) -> &'static str {
        match self {
            Self::Ray => "an array of shape (n, 6) or (n, 8), dtype <f4 or <f8, in C order",
            Self::Point => "an array of shape (n, 3), dtype <f4 or <f8, in C order",
        }
    }

    /// Describes a row.
    pub(super) fn row(self, format: Format) -> String {
        match (format, self) {
            (Format::Csv, _) => format!("line of {}", self.columns().join(",")),
            (Format::JsonLines, Self::Ray) => {
                r#"line like {"origin":[0,0,0],"direction":[0,0,1],"tmin":0,"tmax":null}"#.to_owned()
            }
            (Format::JsonLines, Self::Point) => r#"line like {"point":[0,0,0]}"#.to_owned(),
            (Format::Npy, _) => format!("row of {} numbers", self.expected(None)),
        }
    }
}

/// A row of a file: a [`Ray`] or a [`Point`].
pub trait Row: Sized + sealed::Sealed<Self::Real> {
    /// The type of numbers: `f32` or `f64`.
    type Real: Float;
    /// The kind of row.
    const KIND: Kind;
}

/// A query point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<V>(pub V);

mod sealed {
    use super::{Number, Rounding, RowFault};

    /// Construction of rows.
    pub trait Sealed<F>: Sized {
        /// Builds a row from all columns or the required ones, and counts the rounded numbers.
        #[expect(private_interfaces, reason = "only this crate makes rows")]
        fn new(numbers: &[Number<F>], rounding: &mut Rounding) -> Result<Self, RowFault>;

        /// Reads the numbers of a JSON object.
        #[expect(private_interfaces, reason = "only this crate makes rows")]
        fn of_json(line: &str) -> serde_json::Result<Vec<Number<F>>>;
    }
}

impl<V: Position> Row for Ray<V> {
    type Real = V::Real;
    const KIND: Kind = Kind::Ray;
}

#[expect(private_interfaces, reason = "only this crate makes rows")]
impl<V: Position> sealed::Sealed<V::Real> for Ray<V> {
    fn new(numbers: &[Number<V::Real>], rounding: &mut Rounding) -> Result<Self, RowFault> {
        let interval = numbers.get(6..8).map(|ends| (ends[0].value, ends[1].value));
        let (tmin, tmax) = interval.unwrap_or((V::Real::default(), V::Real::INFINITY));
        let ray = Self::within(vector(&numbers[..3]), vector(&numbers[3..6]), tmin, tmax)?;
        rounding.ray(numbers, &ray);
        Ok(ray)
    }

    fn of_json(line: &str) -> serde_json::Result<Vec<Number<V::Real>>> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields, bound = "F: Float")]
        struct Line<F> {
            origin: [Number<F>; 3],
            direction: [Number<F>; 3],
            #[serde(default)]
            tmin: Number<F>,
            /// JSON cannot represent infinity.
            tmax: Option<Number<F>>,
        }

        let Line { origin, direction, tmin, tmax } = serde_json::from_str(line)?;
        let is_bounded = (tmin, tmax) != (Number::default(), None);
        let interval = [tmin, tmax.unwrap_or(Number::exact(V::Real::INFINITY))];
        Ok(origin.into_iter().chain(direction).chain(interval.into_iter().filter(|_| is_bounded)).collect())
    }
}

impl<V: Position> Row for Point<V> {
    type Real = V::Real;
    const KIND: Kind = Kind::Point;
}

#[expect(private_interfaces, reason = "only this crate makes rows")]
impl<V: Position> sealed::Sealed<V::Real> for Point<V> {
    fn new(numbers: &[Number<V::Real>], rounding: &mut Rounding) -> Result<Self, RowFault> {
        for &number in numbers {
            rounding.coordinate(number);
        }
        Ok(Self(vector(numbers)))
    }

    fn of_json(line: &str) -> serde_json::Result<Vec<Number<V::Real>>> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields, bound = "F: Float")]
        struct Line<F> {
            point: [Number<F>; 3],
        }

        let Line { point } = serde_json::from_str(line)?;
        Ok(point.into())
    }
}

fn vector<V: Position>(numbers: &[Number<V::Real>]) -> V {
    V::from_components([0, 1, 2].map(|axis| numbers[axis].value))
}

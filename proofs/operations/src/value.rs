//! Partially known values: expressions of numbers, in the shapes of Rust values.

use std::rc::Rc;

use crate::source::Place;

pub(crate) type Result<T> = std::result::Result<T, String>;

/// The format of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Single,
    Double,
}

/// An expression for a number or a truth value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expr {
    /// A parameter, or a name from a `let`.
    Name(String),
    /// An integer times a power of two.
    Constant(i128, i32),
    /// A literal of unknown format.
    Literal(String),
    /// A count.
    Number(i128),
    True,
    False,
    /// An operation in the arithmetic of a format, which may still be unknown.
    Op(&'static str, Option<Format>, Vec<Self>),
    /// A function that is defined earlier, or unknown; operands with their formats.
    Call(String, Vec<(Option<Format>, Self)>),
    If(Box<[Self; 3]>),
}

/// A value with one or more names: the parts of a function's result.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Let {
    pub(crate) names: Vec<String>,
    pub(crate) value: Expr,
    /// `None` for a truth value, or several parts.
    pub(crate) format: Option<Format>,
    /// Whether the source names it. Operands of functions are named if they are used more than once.
    pub(crate) is_written: bool,
}

/// A value.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// A number. The format of a literal may still be unknown.
    Real(Option<Format>, Expr),
    Bool(Expr),
    Int(i128),
    /// An unknown integer.
    Count(Expr),
    /// An optional truth value or number, in its form in Rocq.
    Maybe(Expr),
    /// An optional value: whether it exists, and its value.
    Option(Expr, Box<Self>),
    /// Whether the selected lane is in a set of lanes.
    Lane(Expr),
    /// Rows of lanes, one after the other, with the selected lane of each.
    Rows(Vec<Self>),
    /// The bits of a number.
    Bits(Format, Bits),
    /// An integer of some bits, the lowest bit first.
    Mask(Vec<Expr>),
    /// A tuple or an array.
    List(Vec<Self>),
    /// Elements that exist under a condition.
    Filtered(Vec<(Expr, Self)>),
    Struct(String, Vec<(String, Self)>),
    Range(Box<[Self; 2]>),
    Closure(Rc<Closure>),
    /// A function, by its type's name and its own name.
    Function(String, String),
    Unit,
    /// An unsupported value, which is an error only if it is used.
    Unknown(String),
}

/// Bits of a number `x`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Bits {
    /// All bits, as an integer, plus a number.
    Plus(Expr, i128),
    /// The sign bit, at its place.
    Sign(Expr),
    /// All bits of the first, with the sign bit combined with the second's by exclusive or.
    Xor(Expr, Expr),
    /// The bits of the exponent.
    Exponent(Expr),
    /// All bits except the sign, as an integer, plus a number.
    Magnitude(Expr, i128),
    /// All bits except the sign, as an integer, plus a number, and at most those of infinity.
    Capped(Expr, i128),
    /// All bits except the sign and a number of the lowest bits.
    Cleared(Expr, i128),
}

/// A closure, with its visible variables.
#[derive(Clone, Debug)]
pub(crate) struct Closure {
    pub(crate) inputs: Vec<syn::Pat>,
    pub(crate) body: syn::Expr,
    pub(crate) seen: Vec<(String, Value)>,
    pub(crate) place: Place,
}

impl Expr {
    pub(crate) fn op(name: &'static str, format: Option<Format>, of: impl IntoIterator<Item = Self>) -> Self {
        Self::Op(name, format, of.into_iter().collect())
    }

    pub(crate) fn is_atom(&self) -> bool {
        matches!(
            self,
            Self::Name(_) | Self::Constant(..) | Self::Literal(_) | Self::True | Self::False | Self::Number(_)
        ) || matches!(self, Self::Op(_, _, of) if of.is_empty())
            || matches!(self, Self::Call(_, of) if of.is_empty())
    }

    pub(crate) fn not(self) -> Self {
        match self {
            Self::True => Self::False,
            Self::False => Self::True,
            Self::Op("negb", None, mut of) if of.len() == 1 => of.remove(0),
            other => Self::op("negb", None, [other]),
        }
    }

    pub(crate) fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::True, other) => other,
            (Self::False, _) => Self::False,
            (this, Self::True) => this,
            (this, other) => Self::op("andb", None, [this, other]),
        }
    }

    pub(crate) fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::False, other) => other,
            (Self::True, _) => Self::True,
            (this, Self::False) => this,
            (this, other) => Self::op("orb", None, [this, other]),
        }
    }

    /// Selects one of two by a condition.
    pub(crate) fn choose(&self, yes: &Self, no: &Self) -> Self {
        match self {
            Self::True => yes.clone(),
            Self::False => no.clone(),
            _ if yes == no => yes.clone(),
            _ => Self::If(Box::new([self.clone(), yes.clone(), no.clone()])),
        }
    }

    /// Sets all unknown formats.
    pub(crate) fn settle(&self, format: Format) -> Result<Self> {
        Ok(match self {
            Self::Literal(digits) => {
                let number = match format {
                    Format::Single => digits.parse::<f32>().map(f64::from),
                    Format::Double => digits.parse::<f64>(),
                };
                constant(number.map_err(|error| format!("{digits}: {error}"))?)?
            }
            Self::Op(name, None, of) if !is_logic(name) => {
                let of = of.iter().map(|x| x.settle(format)).collect::<Result<_>>()?;
                Self::Op(name, Some(format), of)
            }
            Self::If(of) => {
                let [condition, yes, no] = &**of;
                Self::If(Box::new([condition.clone(), yes.settle(format)?, no.settle(format)?]))
            }
            // The parts of a number with a known format have that format.
            other => other.clone(),
        })
    }
}

/// Converts a finite double to an integer times a power of two.
pub(crate) fn constant(number: f64) -> Result<Expr> {
    if !number.is_finite() || number.is_sign_negative() {
        return Err(format!("a literal that is no positive number: {number}"));
    }
    if number == 0.0 {
        return Ok(Expr::Constant(0, 0));
    }
    let (bits, exponent) = (number.to_bits() & ((1 << 52) - 1), number.to_bits() >> 52);
    let mut whole = i128::from(if exponent == 0 { bits } else { bits | 1 << 52 });
    let mut power = i32::try_from(exponent.max(1)).map_err(|error| error.to_string())? - 1075;
    while whole % 2 == 0 {
        (whole, power) = (whole / 2, power + 1);
    }
    Ok(Expr::Constant(whole, power))
}

/// Returns whether an operation has no format.
fn is_logic(name: &str) -> bool {
    matches!(name, "andb" | "orb" | "negb" | "xorb" | "widen" | "narrow" | "S" | "element")
}

impl Value {
    /// Returns the kind, for messages.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Real(..) => "a number",
            Self::Bool(_) => "a truth value",
            Self::Int(_) => "an integer",
            Self::Count(_) => "a count",
            Self::Maybe(_) | Self::Option(..) => "what may be missing",
            Self::Lane(_) => "a set of lanes",
            Self::Rows(_) => "rows of lanes",
            Self::Bits(..) => "bits of a number",
            Self::Mask(_) => "a mask",
            Self::List(_) => "a list",
            Self::Filtered(_) => "a filtered list",
            Self::Struct(..) => "a struct",
            Self::Range(_) => "a range",
            Self::Closure(_) | Self::Function(..) => "a function",
            Self::Unit => "nothing",
            Self::Unknown(_) => "something unknown",
        }
    }

    /// Returns the name of its type, for finding operators and methods.
    pub(crate) fn type_name(&self) -> String {
        match self {
            Self::Real(Some(Format::Single), _) => "f32".into(),
            Self::Real(Some(Format::Double), _) => "f64".into(),
            Self::Struct(name, _) => name.clone(),
            other => other.kind().into(),
        }
    }

    /// Replaces the expression of a value.
    pub(crate) fn with(&self, x: &Expr) -> Result<Self> {
        Ok(match self {
            Self::Real(format, _) => Self::Real(*format, x.clone()),
            Self::Bool(_) => Self::Bool(x.clone()),
            Self::Count(_) => Self::Count(x.clone()),
            Self::Maybe(_) => Self::Maybe(x.clone()),
            other => return Err(format!("{} in a result", other.kind())),
        })
    }

    /// Visits its expressions in order. `to` may replace each.
    pub(crate) fn leaves(&self, name: &str, to: &mut impl FnMut(&str, &Self) -> Result<Self>) -> Result<Self> {
        let under = |field: &str| if field == "0" { name.to_owned() } else { format!("{name}_{field}") };
        Ok(match self {
            Self::List(of) => Self::List(
                of.iter().enumerate().map(|(at, x)| x.leaves(&format!("{name}_{at}"), to)).collect::<Result<_>>()?,
            ),
            Self::Struct(kind, fields) => {
                let fields = fields.iter().map(|(field, x)| Ok((field.clone(), x.leaves(&under(field), to)?)));
                Self::Struct(kind.clone(), fields.collect::<Result<_>>()?)
            }
            Self::Option(is_there, x) => match to(&format!("{name}_is"), &Self::Bool(is_there.clone()))? {
                Self::Bool(is_there) => Self::Option(is_there, Box::new(x.leaves(name, to)?)),
                other => return Err(format!("a condition that is {}", other.kind())),
            },
            leaf => to(name, leaf)?,
        })
    }

    /// Selects one of two values of equal shape by a condition.
    pub(crate) fn choose(condition: &Expr, yes: &Self, no: &Self) -> Result<Self> {
        match (condition, yes, no) {
            (Expr::True, ..) => return Ok(yes.clone()),
            (Expr::False, ..) => return Ok(no.clone()),
            _ => {}
        }
        Ok(match (yes, no) {
            (Self::Real(a, x), Self::Real(b, y)) => {
                let format = same_format(*a, *b)?;
                let settle = |e: &Expr| format.map_or_else(|| Ok(e.clone()), |format| e.settle(format));
                Self::Real(format, condition.choose(&settle(x)?, &settle(y)?))
            }
            (Self::Bool(x), Self::Bool(y)) => Self::Bool(condition.choose(x, y)),
            (Self::Int(x), Self::Int(y)) if x == y => yes.clone(),
            (Self::Int(_) | Self::Count(_), Self::Int(_) | Self::Count(_)) => {
                Self::Count(condition.choose(&yes.count()?, &no.count()?))
            }
            (Self::Maybe(x), Self::Maybe(y)) => Self::Maybe(condition.choose(x, y)),
            (Self::Option(a, x), Self::Option(b, y)) => {
                Self::Option(condition.choose(a, b), Box::new(Self::choose(condition, x, y)?))
            }
            (Self::Option(a, x), no) if no.is_none() => Self::Option(condition.clone().and(a.clone()), x.clone()),
            (yes, Self::Option(b, y)) if yes.is_none() => {
                Self::Option(condition.clone().not().and(b.clone()), y.clone())
            }
            (Self::Unit, Self::Unit) => Self::Unit,
            (Self::List(x), Self::List(y)) if x.len() == y.len() => {
                Self::List(x.iter().zip(y).map(|(x, y)| Self::choose(condition, x, y)).collect::<Result<_>>()?)
            }
            (Self::Struct(kind, x), Self::Struct(other, y)) if kind == other && x.len() == y.len() => {
                let fields = x.iter().zip(y).map(|((name, x), (same, y))| {
                    if name != same {
                        return Err(format!("{name} is not {same}"));
                    }
                    Ok((name.clone(), Self::choose(condition, x, y)?))
                });
                Self::Struct(kind.clone(), fields.collect::<Result<_>>()?)
            }
            (x, y) => return Err(format!("either {} or {}", x.kind(), y.kind())),
        })
    }

    /// Returns the count.
    pub(crate) fn count(&self) -> Result<Expr> {
        match self {
            Self::Int(x) if *x >= 0 => Ok(Expr::Number(*x)),
            Self::Count(x) => Ok(x.clone()),
            other => Err(format!("{} as a count", other.kind())),
        }
    }

    /// Returns whether it is certainly missing.
    fn is_none(&self) -> bool {
        matches!(self, Self::Maybe(Expr::Call(name, _)) if name == "None")
    }

    /// Returns whether both values are certainly equal.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Real(a, x), Self::Real(b, y)) => a == b && x == y,
            (Self::Bool(x), Self::Bool(y)) | (Self::Count(x), Self::Count(y)) | (Self::Maybe(x), Self::Maybe(y)) => {
                x == y
            }
            (Self::Int(x), Self::Int(y)) => x == y,
            (Self::Unit, Self::Unit) => true,
            (Self::List(x), Self::List(y)) => x.len() == y.len() && x.iter().zip(y).all(|(x, y)| x.is_same(y)),
            (Self::Struct(a, x), Self::Struct(b, y)) => {
                a == b && x.len() == y.len() && x.iter().zip(y).all(|((a, x), (b, y))| a == b && x.is_same(y))
            }
            (Self::Option(a, x), Self::Option(b, y)) => a == b && x.is_same(y),
            (Self::Closure(x), Self::Closure(y)) => Rc::ptr_eq(x, y),
            (Self::Bits(a, x), Self::Bits(b, y)) => a == b && x == y,
            (Self::Mask(x), Self::Mask(y)) => x == y,
            (Self::Range(x), Self::Range(y)) => x.iter().zip(&**y).all(|(x, y)| x.is_same(y)),
            (Self::Function(a, x), Self::Function(b, y)) => a == b && x == y,
            (Self::Unknown(x), Self::Unknown(y)) => x == y,
            _ => false,
        }
    }
}

/// Returns the common format of two operands.
pub(crate) fn same_format(a: Option<Format>, b: Option<Format>) -> Result<Option<Format>> {
    match (a, b) {
        (Some(a), Some(b)) if a != b => Err("numbers of two formats".into()),
        (a, b) => Ok(a.or(b)),
    }
}

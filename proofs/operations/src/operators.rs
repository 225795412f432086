//! Rust's operators and methods on numbers, truth values, integers and bits.

use syn::BinOp;

use crate::value::{Bits, Expr, Format, Value, constant, same_format};

/// Applies an operator to two values that are not structs.
pub(crate) fn binary(op: &BinOp, left: &Value, right: &Value) -> Result<Value, String> {
    match (left, right) {
        (Value::Real(a, x), Value::Real(b, y)) => real(op, same_format(*a, *b)?, x, y),
        (Value::Bool(x), Value::Bool(y)) => logic(op, x.clone(), y.clone()),
        (Value::Int(x), Value::Int(y)) => integer(op, *x, *y),
        (Value::Count(x), Value::Int(y)) => count(op, x, *y).map(Value::Count),
        (Value::Lane(x), Value::Int(15)) if matches!(op, BinOp::BitAnd(_)) => Ok(Value::Lane(x.clone())),
        (Value::Bits(format, x), y) => bits(op, *format, x, y),
        (Value::Mask(x), y) => mask(op, x, y),
        _ => Err(format!("an operator on {} and {}", left.kind(), right.kind())),
    }
}

fn real(op: &BinOp, format: Option<Format>, x: &Expr, y: &Expr) -> Result<Value, String> {
    let settle = |e: &Expr| format.map_or_else(|| Ok(e.clone()), |format| e.settle(format));
    let (x, y) = (settle(x)?, settle(y)?);
    let number = |name, x, y| Ok(Value::Real(format, Expr::op(name, format, [x, y])));
    if let BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_) | BinOp::Div(_) = op {
        return match op {
            BinOp::Add(_) => number("plus", x, y),
            BinOp::Sub(_) => number("minus", x, y),
            BinOp::Mul(_) => number("times", x, y),
            _ => number("over", x, y),
        };
    }
    if format.is_none() {
        return Err("a comparison of literals".into());
    }
    let truth = |name, x, y| Expr::op(name, format, [x, y]);
    Ok(Value::Bool(match op {
        BinOp::Lt(_) => truth("less", x, y),
        BinOp::Le(_) => truth("at_most", x, y),
        BinOp::Gt(_) => truth("less", y, x),
        BinOp::Ge(_) => truth("at_most", y, x),
        BinOp::Eq(_) => truth("equal", x, y),
        BinOp::Ne(_) => truth("equal", x, y).not(),
        _ => return Err("an operator that numbers do not have".into()),
    }))
}

fn logic(op: &BinOp, x: Expr, y: Expr) -> Result<Value, String> {
    Ok(Value::Bool(match op {
        BinOp::And(_) | BinOp::BitAnd(_) => x.and(y),
        BinOp::Or(_) | BinOp::BitOr(_) => x.or(y),
        BinOp::BitXor(_) | BinOp::Ne(_) => Expr::op("xorb", None, [x, y]),
        BinOp::Eq(_) => Expr::op("xorb", None, [x, y]).not(),
        _ => return Err("an operator that truth values do not have".into()),
    }))
}

fn integer(op: &BinOp, x: i128, y: i128) -> Result<Value, String> {
    let shift = || u32::try_from(y).map_err(|_| "a shift by less than 0".to_owned());
    let truth = |is: bool| Ok(Value::Bool(if is { Expr::True } else { Expr::False }));
    let result = match op {
        BinOp::Add(_) => x.checked_add(y),
        BinOp::Sub(_) => x.checked_sub(y),
        BinOp::Mul(_) => x.checked_mul(y),
        BinOp::Div(_) => x.checked_div(y),
        BinOp::Rem(_) => x.checked_rem(y),
        BinOp::BitAnd(_) => Some(x & y),
        BinOp::BitOr(_) => Some(x | y),
        BinOp::BitXor(_) => Some(x ^ y),
        BinOp::Shl(_) => x.checked_shl(shift()?),
        BinOp::Shr(_) => x.checked_shr(shift()?),
        BinOp::Eq(_) => return truth(x == y),
        BinOp::Ne(_) => return truth(x != y),
        BinOp::Lt(_) => return truth(x < y),
        BinOp::Le(_) => return truth(x <= y),
        BinOp::Gt(_) => return truth(x > y),
        BinOp::Ge(_) => return truth(x >= y),
        _ => None,
    };
    result.map(Value::Int).ok_or_else(|| "an operation on integers".into())
}

/// Adds one, or applies an operation to each possible count.
fn count(op: &BinOp, x: &Expr, y: i128) -> Result<Expr, String> {
    match (x, integer(op, if let Expr::Number(x) = x { *x } else { 0 }, y)) {
        (Expr::Number(_), Ok(Value::Int(result))) => Ok(Expr::Number(result)),
        (Expr::If(of), _) => {
            let [condition, yes, no] = &**of;
            Ok(Expr::If(Box::new([condition.clone(), count(op, yes, y)?, count(op, no, y)?])))
        }
        _ => Err("a count in another way than is understood".into()),
    }
}

/// Operates on the bits of a number. Only operations with a meaning for the number are supported.
fn bits(op: &BinOp, format: Format, x: &Bits, y: &Value) -> Result<Value, String> {
    let (sign, exponent) = match format {
        Format::Single => (1 << 31, 0x7f80_0000),
        Format::Double => (1 << 63, 0x7ff << 52),
    };
    let found = match (op, x, y) {
        (BinOp::Add(_), Bits::Plus(x, by), Value::Int(more)) => Bits::Plus(x.clone(), by + more),
        (BinOp::Sub(_), Bits::Plus(x, by), Value::Int(less)) => Bits::Plus(x.clone(), by - less),
        (BinOp::BitAnd(_), Bits::Plus(x, 0), Value::Int(only)) if *only == sign => Bits::Sign(x.clone()),
        (BinOp::BitAnd(_), Bits::Plus(x, 0), Value::Int(only)) if *only == exponent => Bits::Exponent(x.clone()),
        (BinOp::BitXor(_), Bits::Plus(x, 0), Value::Bits(same, Bits::Sign(y))) if *same == format => {
            Bits::Xor(x.clone(), y.clone())
        }
        (BinOp::BitAnd(_), Bits::Plus(x, 0), Value::Int(only)) if *only == sign - 1 => Bits::Magnitude(x.clone(), 0),
        (BinOp::Add(_), Bits::Magnitude(x, by), Value::Int(more)) => Bits::Magnitude(x.clone(), by + more),
        // The original sign.
        (BinOp::BitOr(_), Bits::Capped(x, by), Value::Bits(same, Bits::Sign(y))) if *same == format && x == y => {
            Bits::Plus(x.clone(), *by)
        }
        (BinOp::BitAnd(_), Bits::Plus(x, 0), Value::Int(only)) if matches!(sign - *only, 2 | 4 | 8) => {
            Bits::Cleared(x.clone(), i128::from((sign - *only).trailing_zeros()))
        }
        (BinOp::BitOr(_), Bits::Cleared(..), Value::Bits(..)) => {
            return Ok(Value::Unknown("a number with the bits of another".into()));
        }
        _ => return Err("bits of a number in another way than is understood".into()),
    };
    Ok(Value::Bits(format, found))
}

/// Returns the number with these bits.
pub(crate) fn from_bits(format: Format, value: &Value) -> Result<Value, String> {
    let known = Some(format);
    let number = match value {
        Value::Int(bits) => {
            let wrong = |_| format!("no bits of a number: {bits}");
            constant(match format {
                Format::Single => f64::from(f32::from_bits(u32::try_from(*bits).map_err(wrong)?)),
                Format::Double => f64::from_bits(u64::try_from(*bits).map_err(wrong)?),
            })?
        }
        Value::Bits(same, bits) if *same == format => match bits {
            Bits::Plus(x, 0) => x.clone(),
            Bits::Plus(x, by) => Expr::op("shifted", known, [Expr::Constant(*by, 0), x.clone()]),
            Bits::Xor(x, y) => {
                let sign = Expr::op("is_negative", known, [y.clone()]);
                sign.choose(&Expr::op("opposite", known, [x.clone()]), x)
            }
            Bits::Exponent(x) => Expr::op("power", known, [x.clone()]),
            Bits::Cleared(x, by) => Expr::op("cleared", known, [Expr::Constant(*by, 0), x.clone()]),
            Bits::Sign(_) | Bits::Magnitude(..) | Bits::Capped(..) => return Err("a number of some bits".into()),
        },
        other => return Err(format!("a number made of {}", other.kind())),
    };
    Ok(Value::Real(known, number))
}

/// A mask is known bit by bit.
fn mask(op: &BinOp, x: &[Expr], y: &Value) -> Result<Value, String> {
    let bit = |of: &[Expr], at: usize| of.get(at).cloned().unwrap_or(Expr::False);
    match (op, y) {
        (BinOp::BitOr(_), Value::Mask(y)) => {
            let bits = (0..x.len().max(y.len())).map(|at| bit(x, at).or(bit(y, at)));
            Ok(Value::Mask(bits.collect()))
        }
        (BinOp::Shl(_), Value::Int(by)) => {
            let by = usize::try_from(*by).map_err(|error| error.to_string())?;
            Ok(Value::Mask(std::iter::repeat_n(Expr::False, by).chain(x.iter().cloned()).collect()))
        }
        (BinOp::BitAnd(_), Value::Int(only)) if *only >= 0 => {
            let bits = x.iter().enumerate().map(|(at, x)| if only >> at & 1 == 1 { x.clone() } else { Expr::False });
            Ok(Value::Mask(bits.collect()))
        }
        (BinOp::Eq(_) | BinOp::Ne(_), Value::Int(other)) if *other >= 0 && other >> x.len() == 0 => {
            let bits =
                x.iter().enumerate().map(|(at, x)| if other >> at & 1 == 1 { x.clone() } else { x.clone().not() });
            let equal = bits.fold(Expr::True, Expr::and);
            Ok(Value::Bool(if matches!(op, BinOp::Eq(_)) { equal } else { equal.not() }))
        }
        _ => Err("a mask in another way than is understood".into()),
    }
}

/// Calls a method of a number.
pub(crate) fn method(x: &Expr, format: Option<Format>, name: &str, with: &[Value]) -> Result<Value, String> {
    let known = format.ok_or_else(|| format!("{name} of a literal"))?;
    let number = |e| Ok(Value::Real(format, e));
    let other = || match with {
        [Value::Real(other, y)] => same_format(format, *other).and_then(|_| y.settle(known)),
        _ => Err(format!("{name} with {} operands", with.len())),
    };
    match (name, with.len()) {
        ("abs", 0) => number(Expr::op("absolute", format, [x.clone()])),
        ("sqrt", 0) => number(Expr::op("root", format, [x.clone()])),
        ("recip", 0) => number(Expr::op("over", format, [Expr::Constant(1, 0), x.clone()])),
        // For numbers except NaN, and up to the sign of zero, which Rust leaves open. See the tests.
        ("max", 1) => other().and_then(|y| number(Expr::op("less", format, [y.clone(), x.clone()]).choose(x, &y))),
        ("min" | "min_precise", 1) => {
            other().and_then(|y| number(Expr::op("less", format, [x.clone(), y.clone()]).choose(x, &y)))
        }
        ("simd_lt", 1) => other().map(|y| Value::Bool(Expr::op("less", format, [x.clone(), y]))),
        ("simd_gt", 1) => other().map(|y| Value::Bool(Expr::op("less", format, [y, x.clone()]))),
        ("simd_le", 1) => other().map(|y| Value::Bool(Expr::op("at_most", format, [x.clone(), y]))),
        ("next_up", 0) => number(Expr::op("after", format, [x.clone()])),
        ("next_down", 0) => number(Expr::op("before", format, [x.clone()])),
        ("is_finite", 0) => Ok(Value::Bool(Expr::op("is_finite", format, [x.clone()]))),
        ("to_bits", 0) => Ok(Value::Bits(known, Bits::Plus(x.clone(), 0))),
        _ => Err(format!("the method {name} of a number")),
    }
}

/// Returns the number of a type's constant.
pub(crate) fn constant_of(format: Format, name: &str) -> Result<Value, String> {
    let (digits, greatest) = match format {
        Format::Single => (24, 128),
        Format::Double => (53, 1024),
    };
    let infinity = || Expr::op("infinity", Some(format), []);
    let number = match name {
        "INFINITY" => infinity(),
        "NEG_INFINITY" => Expr::op("opposite", Some(format), [infinity()]),
        "NAN" => Expr::op("not_a_number", Some(format), []),
        "EPSILON" => Expr::Constant(1, 1 - digits),
        "MAX" => Expr::Constant((1 << digits) - 1, greatest - digits),
        "MIN_POSITIVE" => Expr::Constant(1, 2 - greatest),
        _ => return Err(format!("the constant {name} of a number")),
    };
    Ok(Value::Real(Some(format), number))
}

/// Converts a number, for `as` and `from`.
pub(crate) fn convert(value: &Value, to: Format) -> Result<Value, String> {
    let number = match (value, to) {
        (Value::Int(x), _) if (0..1 << 24).contains(x) => Expr::Constant(*x, 0),
        (Value::Int(x), Format::Double) if (0..=1 << 53).contains(x) => Expr::Constant(*x, 0),
        (Value::Real(Some(from), x), _) if *from == to => x.clone(),
        (Value::Real(Some(_), x), Format::Double) => Expr::op("widen", None, [x.clone()]),
        (Value::Real(Some(_), x), Format::Single) => Expr::op("narrow", None, [x.clone()]),
        _ => return Err(format!("{} as a number", value.kind())),
    };
    Ok(Value::Real(Some(to), number))
}

//! The shapes of values: their parts and their names.

use std::collections::BTreeSet;

use syn::Lit;

use crate::source::{Place, module_of, text};
use crate::value::{Expr, Format, Result, Value};

/// Returns the expressions of a value.
pub(crate) fn numbers(value: &Value) -> Vec<(Option<Format>, Expr)> {
    let mut found = Vec::new();
    let each = value.leaves("", &mut |_, leaf| {
        match leaf {
            Value::Real(format, x) => found.push((*format, x.clone())),
            Value::Bool(x) | Value::Count(x) | Value::Maybe(x) => {
                found.push((None, x.clone()));
            }
            _ => {}
        }
        Ok(leaf.clone())
    });
    drop(each);
    found
}

/// Converts an optional number to its form in Rocq. Other values do not change.
pub(crate) fn maybe(value: Value) -> Value {
    match value {
        Value::Option(is_there, x) => match *x {
            Value::Real(format, x) => {
                let some = Expr::Call("Some".into(), vec![(format, x)]);
                Value::Maybe(is_there.choose(&some, &Expr::Call("None".into(), Vec::new())))
            }
            x => Value::Option(is_there, Box::new(x)),
        },
        other => other,
    }
}

pub(crate) fn name_of_constant(place: &Place, name: &str) -> String {
    let module = module_of(&place.file);
    let stem = module.rsplit('/').next().unwrap_or_default();
    let of = if place.owner.is_empty() { stem } else { &place.owner };
    format!("{of}_{name}")
}

/// Returns a name that Rocq does not reserve.
pub(crate) fn free(name: &str) -> String {
    let kept = matches!(
        name,
        "by" | "end"
            | "with"
            | "at"
            | "exists"
            | "left"
            | "right"
            | "single"
            | "double"
            | "less"
            | "over"
            | "plus"
            | "minus"
            | "times"
            | "power"
            | "equal"
    );
    if kept { format!("{name}_") } else { name.to_owned() }
}

/// Returns an unreserved name that is not in use.
pub(crate) fn fresh(taken: &mut BTreeSet<String>, name: &str) -> String {
    let name = free(name);
    let mut fresh = name.clone();
    let mut times = 1;
    while !taken.insert(fresh.clone()) {
        times += 1;
        fresh = format!("{name}'{times}");
    }
    fresh
}

pub(crate) fn literal_of(literal: &Lit) -> Result<Value> {
    match literal {
        Lit::Int(digits) if matches!(digits.suffix(), "" | "u64") => {
            digits.base10_parse().map(Value::Int).map_err(|error| error.to_string())
        }
        Lit::Float(digits) if digits.suffix().is_empty() => {
            Ok(Value::Real(None, Expr::Literal(digits.base10_digits().to_owned())))
        }
        Lit::Bool(truth) => Ok(Value::Bool(if truth.value { Expr::True } else { Expr::False })),
        _ => Err(format!("not understood: {}", text(literal))),
    }
}

pub(crate) fn member(value: &Value, name: &str) -> Result<Value> {
    let part = match value {
        Value::Struct(_, fields) => fields.iter().find(|(field, _)| field == name).map(|(_, value)| value),
        Value::List(of) => name.parse::<usize>().ok().and_then(|at| of.get(at)),
        _ => None,
    };
    match part {
        Some(Value::Unknown(what)) => Err(format!("nothing is known of {what}")),
        Some(part) => Ok(part.clone()),
        None => Err(format!("{name} of {}", value.kind())),
    }
}

/// Returns an element of a list, or a component of a vector.
pub(crate) fn element<'v>(value: &'v Value, at: &Value) -> Result<&'v Value> {
    let Value::Int(at) = at else { return Err(format!("an index that is {}", at.kind())) };
    let at = usize::try_from(*at).map_err(|error| error.to_string())?;
    let part = match value {
        Value::List(of) => of.get(at),
        Value::Struct(name, fields) if matches!(name.as_str(), "Vec3" | "DVec3" | "Vec4") => {
            fields.get(at).map(|(_, value)| value)
        }
        _ => None,
    };
    part.ok_or_else(|| format!("element {at} of {}", value.kind()))
}

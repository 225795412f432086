//! Runs functions of the source on unknown numbers, statement by statement.
//!
//! It supports the constructs that the kernels use. Every other construct is an error, so nothing is claimed about code
//! that was not understood.

use std::collections::{BTreeMap, BTreeSet};

use syn::Pat;

use crate::shapes::{fresh, maybe, member, numbers};
use crate::source::{Function, Place, Source, last_name, text};
use crate::value::{Expr, Format, Let, Result, Value};

/// A function that is printed.
pub(crate) struct Printed {
    pub(crate) place: Place,
    pub(crate) name: String,
    /// Its name in Rocq.
    pub(crate) as_: String,
    /// Whether each of its parameters' numbers is used.
    pub(crate) uses: Vec<bool>,
}

/// Reads one function.
pub(crate) struct Reader<'s> {
    pub(crate) source: &'s Source,
    /// The values of generic parameters.
    pub(crate) known: &'s [(&'s str, &'s str)],
    /// Functions that are called by their names in Rocq.
    pub(crate) printed: &'s [Printed],
    pub(crate) lets: Vec<Let>,
    pub(crate) taken: BTreeSet<String>,
    /// New names of operands that the source names later.
    pub(crate) renamed: BTreeMap<String, String>,
    /// Constants used, with their places.
    pub(crate) constants: Vec<(Place, String)>,
    /// Conditions of early returns: `?` requires them in the function being run.
    pub(crate) asked: Vec<Expr>,
    depth: u32,
}

/// The variables visible to a function's code.
#[derive(Clone)]
pub(crate) struct Frame {
    pub(crate) place: Place,
    pub(crate) seen: Vec<(String, Value)>,
}

impl<'s> Reader<'s> {
    pub(crate) fn new(source: &'s Source, known: &'s [(&'s str, &'s str)], printed: &'s [Printed]) -> Self {
        let (lets, taken, renamed, constants) = (Vec::new(), BTreeSet::new(), BTreeMap::new(), Vec::new());
        Self { source, known, printed, lets, taken, renamed, constants, asked: Vec::new(), depth: 0 }
    }

    /// Runs a function. Returns its result, and the new value of its first parameter.
    pub(crate) fn call(&mut self, function: &Function, arguments: &[Value]) -> Result<(Value, Value)> {
        if function.inputs.len() != arguments.len() {
            return Err(format!("{} takes {} operands", function.name, function.inputs.len()));
        }
        if self.depth > 60 {
            return Err(format!("{} calls itself", function.name));
        }
        let printed = self.printed.iter().find(|other| other.place == function.place && other.name == function.name);
        let outside =
            printed.map(|_| (self.lets.clone(), self.taken.clone(), self.renamed.clone(), self.constants.len()));
        self.depth += 1;
        let asked_outside = std::mem::take(&mut self.asked);
        let mut frame = Frame { place: function.place.clone(), seen: Vec::new() };
        for (input, argument) in function.inputs.iter().zip(arguments) {
            match input {
                syn::FnArg::Receiver(_) => {
                    let argument = self.name("self", argument, false)?;
                    frame.seen.push(("self".into(), argument));
                }
                syn::FnArg::Typed(typed) => {
                    let argument = self.typed(argument, &typed.ty)?;
                    self.bind(&mut frame, &typed.pat, &argument, false)?;
                }
            }
        }
        let value = self.statements(&mut frame, &function.body.stmts, true);
        let value = value.map_err(|error| format!("{}: {error}", function.name))?;
        let value = function.output.as_ref().map_or_else(|| Ok(value.clone()), |ty| self.typed(&value, ty))?;
        self.depth -= 1;
        let asked = std::mem::replace(&mut self.asked, asked_outside);
        let value = asked.into_iter().rev().try_fold(value, |value, is_there| match value {
            Value::Option(also, x) => Ok(Value::Option(is_there.and(also), x)),
            other => Err(format!("a question in a function that gives {}", other.kind())),
        })?;
        let value = if printed.is_some() || self.depth == 0 { maybe(value) } else { value };
        if let (Some(printed), Some((lets, taken, renamed, constants))) = (printed, outside) {
            // It was run only to get the shape of its result.
            (self.lets, self.taken, self.renamed) = (lets, taken, renamed);
            self.constants.truncate(constants);
            return Ok((self.call_printed(printed, arguments, &value)?, Value::Unit));
        }
        Ok((value, frame.seen.first().map_or(Value::Unit, |(_, first)| first.clone())))
    }

    /// Calls a function by name, with a result of this shape.
    fn call_printed(&mut self, printed: &Printed, arguments: &[Value], shape: &Value) -> Result<Value> {
        let arguments = arguments.iter().map(|x| self.name("operand", x, false)).collect::<Result<Vec<_>>>()?;
        let all: Vec<_> = arguments.iter().flat_map(numbers).collect();
        if all.len() != printed.uses.len() {
            return Err(format!("{} with {} numbers", printed.as_, all.len()));
        }
        let used = all.into_iter().zip(&printed.uses).filter(|(_, is_used)| **is_used).map(|(x, _)| x);
        let call = Expr::Call(printed.as_.clone(), used.collect());
        let count = numbers(shape).len();
        if count == 1 {
            return shape.leaves("", &mut |_, leaf| leaf.with(&call));
        }
        let names = match self.lets.iter().find(|other| other.value == call) {
            Some(same) => same.names.clone(),
            None => (0..count).map(|_| fresh(&mut self.taken, &printed.name)).collect(),
        };
        if !self.lets.iter().any(|other| other.value == call) {
            self.lets.push(Let { names: names.clone(), value: call, format: None, is_written: false });
        }
        let mut names = names.into_iter();
        shape.leaves("", &mut |_, leaf| match leaf {
            Value::Real(..) | Value::Bool(_) | Value::Maybe(_) | Value::Count(_) => {
                leaf.with(&Expr::Name(names.next().ok_or("a name is missing")?))
            }
            other => Ok(other.clone()),
        })
    }

    /// Sets unknown formats of numbers to that of a type, if it has one.
    pub(crate) fn typed(&self, value: &Value, ty: &syn::Type) -> Result<Value> {
        Ok(match (value, ty) {
            (_, syn::Type::Reference(ty)) => self.typed(value, &ty.elem)?,
            (Value::Real(None, x), _) => match self.format(ty) {
                Some(format) => Value::Real(Some(format), x.settle(format)?),
                None => value.clone(),
            },
            (Value::List(of), syn::Type::Array(ty)) => {
                Value::List(of.iter().map(|x| self.typed(x, &ty.elem)).collect::<Result<_>>()?)
            }
            (Value::List(of), syn::Type::Tuple(ty)) if of.len() == ty.elems.len() => {
                Value::List(of.iter().zip(&ty.elems).map(|(x, ty)| self.typed(x, ty)).collect::<Result<_>>()?)
            }
            _ => value.clone(),
        })
    }

    /// Returns the format of a type.
    pub(crate) fn format(&self, ty: &syn::Type) -> Option<Format> {
        match self.known_as(&text(ty)).as_str() {
            "f32" => Some(Format::Single),
            "f64" => Some(Format::Double),
            _ => None,
        }
    }

    /// Replaces a type or a constant by its known value.
    pub(crate) fn known_as(&self, name: &str) -> String {
        self.known.iter().find(|(from, _)| *from == name).map_or_else(|| name.to_owned(), |(_, to)| (*to).to_owned())
    }

    /// Replaces a type or a constant by its known value in the code of this type.
    pub(crate) fn known_in(&self, owner: &str, name: &str) -> String {
        let own = format!("{owner}::{name}");
        let found = self.known.iter().find(|(from, _)| *from == own);
        found.map_or_else(|| self.known_as(name), |(_, to)| (*to).to_owned())
    }

    /// Names the unnamed numbers of a value.
    pub(crate) fn name(&mut self, name: &str, value: &Value, is_written: bool) -> Result<Value> {
        value.leaves(name, &mut |name, leaf| {
            Ok(match leaf {
                Value::Real(Some(format), x) => {
                    Value::Real(Some(*format), self.named(name, x, Some(*format), is_written))
                }
                Value::Bool(x) => Value::Bool(self.named(name, x, None, is_written)),
                other => other.clone(),
            })
        })
    }

    fn named(&mut self, name: &str, x: &Expr, format: Option<Format>, is_written: bool) -> Expr {
        if let Expr::Name(own) = x
            && is_written
            && let Some(operand) = self.lets.iter_mut().find(|other| other.names.contains(own) && !other.is_written)
        {
            operand.is_written = operand.names.len() == 1;
            if !self.renamed.contains_key(own) {
                let written = fresh(&mut self.taken, name);
                self.renamed.insert(own.clone(), written);
            }
        }
        if x.is_atom() {
            return x.clone();
        }
        if let Some(same) = self.lets.iter().find(|other| other.value == *x && other.names.len() == 1) {
            let own = Expr::Name(same.names[0].clone());
            return if is_written { self.named(name, &own, format, true) } else { own };
        }
        let fresh = fresh(&mut self.taken, name);
        self.lets.push(Let { names: vec![fresh.clone()], value: x.clone(), format, is_written });
        Expr::Name(fresh)
    }

    /// Binds the names of a pattern.
    pub(crate) fn bind(&mut self, frame: &mut Frame, pattern: &Pat, value: &Value, is_written: bool) -> Result<()> {
        match (pattern, value) {
            (Pat::Ident(ident), _) if ident.subpat.is_none() => {
                let name = ident.ident.to_string();
                let value = self.name(&name, value, is_written)?;
                frame.seen.push((name, value));
                Ok(())
            }
            (Pat::Wild(_), _) => Ok(()),
            (Pat::Reference(inner), _) => self.bind(frame, &inner.pat, value, is_written),
            (Pat::Paren(inner), _) => self.bind(frame, &inner.pat, value, is_written),
            (Pat::Type(typed), _) => {
                let value = self.typed(value, &typed.ty)?;
                self.bind(frame, &typed.pat, &value, is_written)
            }
            (Pat::Tuple(syn::PatTuple { elems, .. }) | Pat::Slice(syn::PatSlice { elems, .. }), Value::List(of))
                if elems.len() == of.len() =>
            {
                elems.iter().zip(of).try_for_each(|(pattern, value)| self.bind(frame, pattern, value, is_written))
            }
            (Pat::TupleStruct(inner), Value::Struct(_, fields)) if inner.elems.len() == fields.len() => {
                let mut both = inner.elems.iter().zip(fields);
                both.try_for_each(|(pattern, (_, value))| self.bind(frame, pattern, value, is_written))
            }
            (Pat::Struct(inner), Value::Struct(..)) => inner.fields.iter().try_for_each(|field| {
                let value = member(value, &text(&field.member))?;
                self.bind(frame, &field.pat, &value, is_written)
            }),
            _ => Err(format!("not understood: the pattern {} for {}", text(pattern), value.kind())),
        }
    }
}

/// Returns the value of a parameter: its shape, with names for its numbers.
pub(crate) fn unknown(reader: &Reader<'_>, ty: &syn::Type, owner: &str, name: &str) -> Result<Value> {
    if let Some(format) = reader.format(ty) {
        return Ok(Value::Real(Some(format), Expr::Name(name.into())));
    }
    let list = |of: Vec<(usize, &syn::Type)>| {
        let each = of.into_iter().map(|(at, ty)| unknown(reader, ty, owner, &format!("{name}_{at}")));
        Ok(Value::List(each.collect::<Result<_>>()?))
    };
    match ty {
        syn::Type::Reference(ty) => unknown(reader, &ty.elem, owner, name),
        syn::Type::Tuple(ty) => list(ty.elems.iter().enumerate().collect()),
        syn::Type::Array(ty) => match text(&ty.len).parse::<usize>() {
            Ok(len @ 0..=64) => list((0..len).map(|at| (at, &*ty.elem)).collect()),
            _ => Err(format!("not understood: {}", text(ty))),
        },
        syn::Type::Path(_) => {
            let short = reader.known_in(owner, &last_name(ty));
            let short = if short == "Self" { owner } else { &short };
            if let Some((_, alias)) = reader.source.aliases.iter().find(|(name, _)| name == short) {
                return unknown(reader, alias, owner, name);
            }
            match short {
                "bool" if reader.known_as(name) == "false" => return Ok(Value::Bool(Expr::False)),
                "bool" => return Ok(Value::Bool(Expr::Name(name.into()))),
                "i32" | "u32" | "unknown" => return Ok(Value::Unknown(name.into())),
                "simd" => return Ok(Value::Unit),
                "f32" => return Ok(Value::Real(Some(Format::Single), Expr::Name(name.into()))),
                // The begin of a row of four: that of the upper planes, or that of the lower ones.
                "side" => {
                    let either = [Expr::Name(name.into()), Expr::Number(4), Expr::Number(0)];
                    return Ok(Value::Count(Expr::If(Box::new(either))));
                }
                _ => {}
            }
            let fields = reader.source.structure(short)?.fields.iter().map(|(field, ty)| {
                let under = if field == "0" { name.to_owned() } else { format!("{name}_{field}") };
                Ok((field.clone(), unknown(reader, ty, short, &under)?))
            });
            Ok(Value::Struct(short.into(), fields.collect::<Result<_>>()?))
        }
        _ => Err(format!("not understood: {}", text(ty))),
    }
}

//! Resolution of names, and calls of functions, closures and methods.

use syn::Expr as Rust;

use crate::operators;
use crate::reader::{Frame, Reader};
use crate::shapes::name_of_constant;
use crate::source::text;
use crate::value::{Bits, Expr, Format, Result, Value};

impl Reader<'_> {
    /// Returns the value of a name.
    pub(crate) fn path(&mut self, frame: &mut Frame, path: &syn::Path) -> Result<Value> {
        let name = text(path);
        if let Some((_, value)) = frame.seen.iter().rev().find(|(seen, _)| *seen == name) {
            return match value {
                Value::Unknown(what) => Err(format!("nothing is known of {what}")),
                value => Ok(value.clone()),
            };
        }
        match self.known_as(&name).as_str() {
            "true" => return Ok(Value::Bool(Expr::True)),
            "false" => return Ok(Value::Bool(Expr::False)),
            "None" => return Ok(Value::Maybe(Expr::Call("None".into(), Vec::new()))),
            number if let Ok(number) = number.parse() => return Ok(Value::Int(number)),
            _ => {}
        }
        let Some((owner, name)) = name.rsplit_once("::") else {
            return self.constant(frame, "", &name);
        };
        let owner = self.type_name(frame, owner);
        match owner.as_str() {
            "f32" => return operators::constant_of(Format::Single, name),
            "f64" => return operators::constant_of(Format::Double, name),
            _ => {}
        }
        if name.chars().all(|c| c.is_uppercase() || c == '_') {
            return self.constant(frame, &owner, name);
        }
        Ok(Value::Function(owner, name.into()))
    }

    /// Returns a constant. A number keeps its name.
    fn constant(&mut self, frame: &Frame, owner: &str, name: &str) -> Result<Value> {
        let constant = self.source.constant(&frame.place.file, owner, name);
        let constant = match (constant, owner) {
            (Ok(constant), _) => constant.clone(),
            // A function without a path.
            (Err(_), "") if self.source.function(&frame.place.file, name).is_ok() => {
                return Ok(Value::Function(String::new(), name.into()));
            }
            (Err(error), _) => return Err(error),
        };
        let mut inside = Frame { place: constant.place.clone(), seen: Vec::new() };
        let value = self.eval(&mut inside, &constant.value)?;
        let value = self.typed(&value, &constant.ty)?;
        if let Value::Real(Some(format), x) = &value
            && !x.is_atom()
        {
            self.constants.push((constant.place.clone(), name.into()));
            return Ok(Value::Real(Some(*format), Expr::Call(name_of_constant(&constant.place, name), Vec::new())));
        }
        Ok(value)
    }

    pub(crate) fn type_name(&self, frame: &Frame, name: &str) -> String {
        let name = if name == "Self" { &frame.place.owner } else { name };
        self.known_in(&frame.place.owner, name.split("::").last().unwrap_or(name))
    }

    /// Calls a function that is given by a path or is a value.
    pub(crate) fn call_path(&mut self, frame: &mut Frame, path: &Rust, arguments: &[Value]) -> Result<Value> {
        let Rust::Path(path) = path else { return Err(format!("not understood: {}", text(path))) };
        let name = text(&path.path);
        if let Some((_, function)) = frame.seen.iter().rev().find(|(seen, _)| *seen == name) {
            let function = function.clone();
            return self.apply(frame, &function, arguments);
        }
        let Some((owner, method)) = name.rsplit_once("::") else {
            if self.known_as(&name) == "unknown" {
                return Ok(Value::Unknown(name));
            }
            if name == "Self" || self.source.structure(&name).is_ok() {
                let fields = arguments.iter().enumerate().map(|(at, value)| (at.to_string(), value.clone()));
                return self.structure(&self.type_name(frame, &name), fields.collect());
            }
            return self.apply(frame, &Value::Function(String::new(), name), arguments);
        };
        let owner = self.type_name(frame, owner);
        self.apply(frame, &Value::Function(owner, method.into()), arguments)
    }

    /// Calls a function that is a value.
    fn apply(&mut self, frame: &mut Frame, function: &Value, arguments: &[Value]) -> Result<Value> {
        match function {
            Value::Closure(closure) => {
                if closure.inputs.len() != arguments.len() {
                    return Err("a closure with other operands".into());
                }
                let mut inside = Frame { place: closure.place.clone(), seen: closure.seen.clone() };
                for (input, argument) in closure.inputs.iter().zip(arguments) {
                    self.bind(&mut inside, input, argument, false)?;
                }
                let value = self.always(|reader| reader.eval(&mut inside, &closure.body))?;
                // It would have to change outer variables.
                let changed = closure.seen.iter().zip(&inside.seen).any(|((_, x), (_, y))| !x.is_same(y));
                if changed { Err("a closure that changes something".into()) } else { Ok(value) }
            }
            Value::Function(owner, name) => match (owner.as_str(), name.as_str(), arguments) {
                ("f32", "from_bits", [Value::Unknown(_)]) => Ok(arguments[0].clone()),
                ("f32", "from_bits", [bits]) => operators::from_bits(Format::Single, bits),
                ("f64", "from_bits", [bits]) => operators::from_bits(Format::Double, bits),
                // Each lane separately.
                ("f32", "splat" | "load_array" | "load_array_ref" | "from_slice", [_, lane]) => Ok(lane.clone()),
                ("", "Some", [Value::Bool(x)]) => Ok(Value::Maybe(Expr::Call("Some".into(), vec![(None, x.clone())]))),
                ("", "Some", [x]) => Ok(Value::Option(Expr::True, Box::new(x.clone()))),
                ("f64", "from", [value]) => operators::convert(value, Format::Double),
                ("u32", "from", [Value::Bool(bit)]) => Ok(Value::Mask(vec![bit.clone()])),
                ("u64", "from", [Value::Int(x)]) if *x >= 0 => Ok(Value::Int(*x)),
                ("", name, _) => {
                    let function = self.source.function(&frame.place.file, name)?.clone();
                    Ok(self.call(&function, arguments)?.0)
                }
                (owner, name, _) => {
                    // A trait's function is the implementation for its operand's type.
                    let own = self.source.method(owner, name, "").or_else(|error| match arguments {
                        [first, ..] => self.source.method(&first.type_name(), name, "").map_err(|_| error),
                        [] => Err(error),
                    });
                    let function = own?.clone();
                    Ok(self.call(&function, arguments)?.0)
                }
            },
            other => Err(format!("a call of {}", other.kind())),
        }
    }

    pub(crate) fn method(&mut self, frame: &mut Frame, on: Value, name: &str, with: &[Value]) -> Result<Value> {
        match (&on, name, with) {
            // A library function on lanes.
            (Value::Real(Some(format), _), ..) if let Ok(function) = self.source.method(lanes(*format), name, "") => {
                let function = function.clone();
                let arguments = std::iter::once(on.clone()).chain(with.iter().cloned()).collect::<Vec<_>>();
                Ok(self.call(&function, &arguments)?.0)
            }
            (Value::Real(format, x), ..) => {
                let named = self.name("x", &Value::Real(*format, x.clone()), false)?;
                let Value::Real(_, x) = named else { return Err("a number that is none".into()) };
                let with = with.iter().map(|y| self.name("y", y, false)).collect::<Result<Vec<_>>>()?;
                operators::method(&x, *format, name, &with)
            }
            (Value::Bits(format, Bits::Plus(x, by)), "wrapping_add_signed", [Value::Int(more)]) => {
                Ok(Value::Bits(*format, Bits::Plus(x.clone(), by + more)))
            }
            (Value::Bits(format, Bits::Magnitude(x, by)), "min", [most]) => {
                match operators::from_bits(*format, most)? {
                    Value::Real(_, Expr::Op("infinity", ..)) => Ok(Value::Bits(*format, Bits::Capped(x.clone(), *by))),
                    _ => Err("bits of a number in another way than is understood".into()),
                }
            }
            (Value::Bool(x), "to_bitmask", []) => Ok(Value::Lane(x.clone())),
            (Value::List(of), "as_flattened", []) => Ok(Value::Rows(of.clone())),
            (Value::Rows(rows), "iter", []) => {
                let lists = rows.iter().map(|row| match row {
                    Value::List(of) => Ok(of.clone()),
                    other => Err(format!("a row that is {}", other.kind())),
                });
                Ok(Value::List(lists.collect::<Result<Vec<_>>>()?.concat()))
            }
            (Value::Unknown(_), "to_bits", []) | (Value::List(_), "into_iter" | "iter" | "copied", []) => Ok(on),
            (Value::List(of), "map", [function]) => Ok(Value::List(
                of.iter().map(|x| self.apply(frame, function, std::slice::from_ref(x))).collect::<Result<_>>()?,
            )),
            (Value::List(of), "all" | "any", [function]) => {
                let mut all = if name == "all" { Expr::True } else { Expr::False };
                for x in of {
                    match self.apply(frame, function, std::slice::from_ref(x))? {
                        Value::Bool(x) if name == "all" => all = all.and(x),
                        Value::Bool(x) => all = all.or(x),
                        other => return Err(format!("{name} of {}", other.kind())),
                    }
                }
                Ok(Value::Bool(all))
            }
            (Value::List(of), "filter", [function]) => {
                let mut found = Vec::new();
                for x in of {
                    match self.apply(frame, function, std::slice::from_ref(x))? {
                        Value::Bool(condition) => found.push((condition, x.clone())),
                        other => return Err(format!("{name} by {}", other.kind())),
                    }
                }
                Ok(Value::Filtered(found))
            }
            (Value::Filtered(of), "map", [function]) => {
                let each = of.iter().map(|(condition, x)| {
                    Ok((condition.clone(), self.apply(frame, function, std::slice::from_ref(x))?))
                });
                Ok(Value::Filtered(each.collect::<Result<_>>()?))
            }
            (Value::Filtered(of), "fold", [start, function]) => {
                of.iter().try_fold(start.clone(), |before, (condition, x)| {
                    let after = self.apply(frame, function, &[before.clone(), x.clone()])?;
                    self.name("fold", &Value::choose(condition, &after, &before)?, false)
                })
            }
            (Value::Bool(condition), "then_some", [x]) => Ok(Value::Option(condition.clone(), Box::new(x.clone()))),
            // Unused values are permitted.
            (Value::Bool(condition), "then", [function]) => {
                Ok(Value::Option(condition.clone(), Box::new(self.apply(frame, function, &[])?)))
            }
            (Value::Option(is_there, x), "filter", [function]) => {
                match self.apply(frame, function, std::slice::from_ref(x))? {
                    Value::Bool(is_left) => Ok(Value::Option(is_there.clone().and(is_left), x.clone())),
                    other => Err(format!("{name} by {}", other.kind())),
                }
            }
            (Value::Range(ends), "contains", [x]) => {
                let not_before = operators::binary(&syn::parse_quote!(<=), &ends[0], x)?;
                let not_after = operators::binary(&syn::parse_quote!(<=), x, &ends[1])?;
                operators::binary(&syn::parse_quote!(&&), &not_before, &not_after)
            }
            (Value::Struct(owner, _), ..) => {
                let function = self.source.method(owner, name, "")?.clone();
                let arguments = std::iter::once(on.clone()).chain(with.iter().cloned()).collect::<Vec<_>>();
                Ok(self.call(&function, &arguments)?.0)
            }
            _ => Err(format!("the method {name} of {}", on.kind())),
        }
    }
}

/// Returns the type of four numbers.
const fn lanes(format: Format) -> &'static str {
    match format {
        Format::Single => "f32x4",
        Format::Double => "f64x4",
    }
}

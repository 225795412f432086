//! Runs functions of the source on unknown numbers, statement by statement.
//!
//! What is understood is what the kernels use. All else is an error, so that nothing is said of what was not understood.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use syn::{Block, Expr as Rust, Lit, Pat, Stmt, UnOp};

use crate::operators;
use crate::source::{Function, Place, Source, last_name, module_of, text};
use crate::value::{Closure, Expr, Format, Value};

pub(crate) type Result<T> = std::result::Result<T, String>;

/// What has a name, or several: the parts of what a function gives.
pub(crate) struct Let {
    pub(crate) names: Vec<String>,
    pub(crate) value: Expr,
    /// None of a truth value, a sum, or several parts.
    pub(crate) format: Option<Format>,
    /// Whether the source names it. Operands of functions are named where they are used more than once.
    pub(crate) is_written: bool,
}

/// A function that is printed.
pub(crate) struct Printed {
    pub(crate) place: Place,
    pub(crate) name: String,
    /// Its name in Rocq.
    pub(crate) as_: String,
    /// Which of its parameters' numbers it uses.
    pub(crate) uses: Vec<bool>,
}

/// Reads one function.
pub(crate) struct Reader<'s> {
    pub(crate) source: &'s Source,
    /// Functions that are not looked into, with their names in Rocq.
    pub(crate) opaque: &'s [(&'s str, &'s str)],
    /// What is known of generic parameters.
    pub(crate) known: &'s [(&'s str, &'s str)],
    /// Functions that are called by their names in Rocq.
    pub(crate) printed: &'s [Printed],
    pub(crate) lets: Vec<Let>,
    pub(crate) taken: BTreeSet<String>,
    /// Names of operands that the source has named later.
    pub(crate) renamed: BTreeMap<String, String>,
    /// Constants that were met, with their places.
    pub(crate) constants: Vec<(Place, String)>,
    depth: u32,
}

/// What the code of a function sees.
#[derive(Clone)]
pub(crate) struct Frame {
    place: Place,
    seen: Vec<(String, Value)>,
}

impl<'s> Reader<'s> {
    pub(crate) fn new(
        source: &'s Source,
        opaque: &'s [(&'s str, &'s str)],
        known: &'s [(&'s str, &'s str)],
        printed: &'s [Printed],
    ) -> Self {
        let (lets, taken, renamed, constants) = (Vec::new(), BTreeSet::new(), BTreeMap::new(), Vec::new());
        Self { source, opaque, known, printed, lets, taken, renamed, constants, depth: 0 }
    }

    /// Runs a function; what it gives, and what becomes of its first parameter.
    pub(crate) fn call(&mut self, function: &Function, arguments: &[Value]) -> Result<(Value, Value)> {
        if function.inputs.len() != arguments.len() {
            return Err(format!("{} takes {} operands", function.name, function.inputs.len()));
        }
        if self.depth > 60 {
            return Err(format!("{} calls itself", function.name));
        }
        let printed = self.printed.iter().find(|other| other.place == function.place && other.name == function.name);
        let outside = printed.map(|_| (self.lets.len(), self.taken.clone(), self.constants.len()));
        self.depth += 1;
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
        if let (Some(printed), Some((lets, taken, constants))) = (printed, outside) {
            // It was run for the shape of what it gives.
            self.lets.truncate(lets);
            self.taken = taken;
            self.constants.truncate(constants);
            return Ok((self.call_printed(printed, arguments, &value)?, Value::Unit));
        }
        Ok((value, frame.seen.first().map_or(Value::Unit, |(_, first)| first.clone())))
    }

    /// A call by name of a function that gives something of this shape.
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
            Value::Real(..) | Value::Bool(_) | Value::State(_) => {
                leaf.with(&Expr::Name(names.next().ok_or("a name is missing")?))
            }
            other => Ok(other.clone()),
        })
    }

    /// Numbers of unknown format have that of a type, where it says one.
    fn typed(&self, value: &Value, ty: &syn::Type) -> Result<Value> {
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

    /// The format that a type is of.
    pub(crate) fn format(&self, ty: &syn::Type) -> Option<Format> {
        match self.known_as(&text(ty)).as_str() {
            "f32" => Some(Format::Single),
            "f64" => Some(Format::Double),
            _ => None,
        }
    }

    /// A type or a constant that is known here by another name.
    pub(crate) fn known_as(&self, name: &str) -> String {
        self.known.iter().find(|(from, _)| *from == name).map_or_else(|| name.to_owned(), |(_, to)| (*to).to_owned())
    }

    /// Names the numbers of a value that have none yet.
    fn name(&mut self, name: &str, value: &Value, is_written: bool) -> Result<Value> {
        value.leaves(name, &mut |name, leaf| {
            Ok(match leaf {
                Value::Real(Some(format), x) => {
                    Value::Real(Some(*format), self.named(name, x, Some(*format), is_written))
                }
                Value::Bool(x) => Value::Bool(self.named(name, x, None, is_written)),
                Value::State(x) => Value::State(self.named(name, x, None, is_written)),
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
    fn bind(&mut self, frame: &mut Frame, pattern: &Pat, value: &Value, is_written: bool) -> Result<()> {
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
                let both = inner.elems.iter().zip(fields);
                both.map(|(pattern, (_, value))| self.bind(frame, pattern, value, is_written)).collect()
            }
            (Pat::Struct(inner), Value::Struct(..)) => inner.fields.iter().try_for_each(|field| {
                let value = member(value, &text(&field.member))?;
                self.bind(frame, &field.pat, &value, is_written)
            }),
            _ => Err(format!("not understood: the pattern {} for {}", text(pattern), value.kind())),
        }
    }

    /// Runs statements; the value of the last one. In a function's own block a branch may return early.
    fn statements(&mut self, frame: &mut Frame, statements: &[Stmt], is_function: bool) -> Result<Value> {
        let mut last = Value::Unit;
        for (at, statement) in statements.iter().enumerate() {
            last = Value::Unit;
            match statement {
                Stmt::Local(local) if local.attrs.is_empty() => {
                    let init =
                        local.init.as_ref().filter(|init| init.diverge.is_none()).ok_or("a let without a value")?;
                    let value = self.eval(frame, &init.expr)?;
                    self.bind(frame, &local.pat, &value, true)?;
                }
                Stmt::Expr(Rust::If(branch), _) if is_function && returned(&branch.then_branch).is_some() => {
                    let condition = self.condition(frame, &branch.cond)?;
                    let (mut early, mut later) = (frame.clone(), frame.clone());
                    if branch.else_branch.is_some() {
                        return Err("a return with an else".into());
                    }
                    let [before @ .., _] = &branch.then_branch.stmts[..] else { return Err("an empty branch".into()) };
                    self.statements(&mut early, before, false)?;
                    let yes = match returned(&branch.then_branch) {
                        Some(Some(value)) => self.eval(&mut early, value)?,
                        _ => Value::Unit,
                    };
                    let no = self.statements(&mut later, &statements[at + 1..], true)?;
                    self.merge(frame, &condition, &early, &later)?;
                    return Value::choose(&condition, &yes, &no);
                }
                Stmt::Expr(expr, None) => last = self.eval(frame, expr)?,
                Stmt::Expr(expr, Some(_)) => {
                    self.eval(frame, expr)?;
                }
                other => return Err(format!("not understood: {}", text(other))),
            }
        }
        Ok(last)
    }

    /// After a branch, what the variables are.
    fn merge(&mut self, frame: &mut Frame, condition: &Expr, yes: &Frame, no: &Frame) -> Result<()> {
        for (at, (name, value)) in frame.seen.iter_mut().enumerate() {
            let (yes, no) = (&yes.seen[at].1, &no.seen[at].1);
            *value = if yes.is_same(no) {
                yes.clone()
            } else {
                let either = Value::choose(condition, yes, no)?;
                self.name(name, &either, true)?
            };
        }
        Ok(())
    }

    fn block(&mut self, frame: &mut Frame, block: &Block) -> Result<Value> {
        let outside = frame.seen.len();
        let value = self.statements(frame, &block.stmts, false)?;
        frame.seen.truncate(outside);
        Ok(value)
    }

    fn condition(&mut self, frame: &mut Frame, expr: &Rust) -> Result<Expr> {
        match self.eval(frame, expr)? {
            Value::Bool(Expr::True) => Ok(Expr::True),
            Value::Bool(Expr::False) => Ok(Expr::False),
            Value::Bool(condition) => match self.name("test", &Value::Bool(condition), false)? {
                Value::Bool(named) => Ok(named),
                other => Err(format!("a condition that is {}", other.kind())),
            },
            other => Err(format!("a condition that is {}", other.kind())),
        }
    }

    /// The value of an expression.
    fn eval(&mut self, frame: &mut Frame, expr: &Rust) -> Result<Value> {
        match expr {
            Rust::Paren(inner) => self.eval(frame, &inner.expr),
            Rust::Group(inner) => self.eval(frame, &inner.expr),
            Rust::Reference(inner) => self.eval(frame, &inner.expr),
            Rust::Unary(unary) => {
                let value = self.eval(frame, &unary.expr)?;
                self.unary(&unary.op, value)
            }
            Rust::Lit(literal) => literal_of(&literal.lit),
            Rust::Path(path) => self.path(frame, &path.path),
            Rust::Tuple(syn::ExprTuple { elems, .. }) | Rust::Array(syn::ExprArray { elems, .. }) => {
                Ok(Value::List(elems.iter().map(|x| self.eval(frame, x)).collect::<Result<_>>()?))
            }
            Rust::Repeat(repeat) => match (self.eval(frame, &repeat.expr)?, self.eval(frame, &repeat.len)?) {
                (value, Value::Int(times @ 0..=64)) => Ok(Value::List((0..times).map(|_| value.clone()).collect())),
                _ => Err(format!("not understood: {}", text(expr))),
            },
            Rust::Range(range) => match (&range.start, &range.end) {
                (Some(start), Some(end)) => {
                    let (start, end) = (self.eval(frame, start)?, self.eval(frame, end)?);
                    match (start, end, &range.limits) {
                        (Value::Int(start), Value::Int(end), syn::RangeLimits::HalfOpen(_)) => {
                            Ok(Value::List((start..end).map(Value::Int).collect()))
                        }
                        (start, end, syn::RangeLimits::Closed(_)) => Ok(Value::Range(Box::new([start, end]))),
                        _ => Err(format!("not understood: {}", text(expr))),
                    }
                }
                _ => Err(format!("not understood: {}", text(expr))),
            },
            Rust::Field(field) => {
                let value = self.eval(frame, &field.base)?;
                member(&value, &text(&field.member))
            }
            Rust::Index(index) => {
                let (value, at) = (self.eval(frame, &index.expr)?, self.eval(frame, &index.index)?);
                element(&value, &at).cloned()
            }
            Rust::Cast(cast) => {
                let value = self.eval(frame, &cast.expr)?;
                self.cast(value, &cast.ty)
            }
            Rust::Binary(binary) => self.binary(frame, binary),
            Rust::Assign(assign) => {
                let value = self.eval(frame, &assign.right)?;
                let name =
                    text(&*assign.left).chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
                let value = self.name(&name, &value, true)?;
                self.assign(frame, &assign.left, value)?;
                Ok(Value::Unit)
            }
            Rust::Block(block) if block.label.is_none() => self.block(frame, &block.block),
            Rust::If(branch) => self.branch(frame, branch),
            Rust::ForLoop(turn) if turn.label.is_none() => self.turns(frame, turn),
            Rust::Closure(closure) => Ok(Value::Closure(Rc::new(Closure {
                inputs: closure.inputs.iter().cloned().collect(),
                body: (*closure.body).clone(),
                seen: frame.seen.clone(),
                place: frame.place.clone(),
            }))),
            Rust::Struct(made) if made.rest.is_none() => {
                let name = self.type_name(frame, &text(&made.path));
                let fields = made.fields.iter().map(|field| {
                    let value = self.eval(frame, &field.expr)?;
                    Ok((text(&field.member), value))
                });
                let fields = fields.collect::<Result<Vec<_>>>()?;
                self.structure(&name, fields)
            }
            Rust::Call(call) => {
                let arguments = call.args.iter().map(|x| self.eval(frame, x)).collect::<Result<Vec<_>>>()?;
                self.call_path(frame, &call.func, &arguments)
            }
            Rust::MethodCall(call) => {
                let arguments = call.args.iter().map(|x| self.eval(frame, x)).collect::<Result<Vec<_>>>()?;
                let on = self.eval(frame, &call.receiver)?;
                self.method(frame, &call.receiver, on, &call.method.to_string(), &arguments)
            }
            _ => Err(format!("not understood: {}", text(expr))),
        }
    }

    /// A struct has the fields of its declaration, in that order, and numbers of their formats.
    fn structure(&self, name: &str, mut fields: Vec<(String, Value)>) -> Result<Value> {
        let declared = &self.source.structure(name)?.fields;
        if declared.len() != fields.len() {
            return Err(format!("{name} with {} fields", fields.len()));
        }
        let in_order = declared.iter().map(|(field, ty)| {
            let at =
                fields.iter().position(|(name, _)| name == field).ok_or_else(|| format!("{name} without {field}"))?;
            let (field, value) = fields.swap_remove(at);
            Ok((field, self.typed(&value, ty)?))
        });
        Ok(Value::Struct(name.into(), in_order.collect::<Result<_>>()?))
    }

    fn unary(&mut self, op: &UnOp, value: Value) -> Result<Value> {
        match (op, value) {
            (UnOp::Deref(_), value) => Ok(value),
            (UnOp::Not(_), Value::Bool(x)) => Ok(Value::Bool(x.not())),
            (UnOp::Neg(_), Value::Int(x)) => Ok(Value::Int(-x)),
            (UnOp::Neg(_), Value::Real(format, x)) => Ok(Value::Real(format, Expr::op("opposite", format, [x]))),
            (_, value) => Err(format!("an operator on {}", value.kind())),
        }
    }

    fn binary(&mut self, frame: &mut Frame, binary: &syn::ExprBinary) -> Result<Value> {
        let left = self.eval(frame, &binary.left)?;
        let right = self.eval(frame, &binary.right)?;
        let Value::Struct(owner, _) = &left else {
            return operators::binary(&binary.op, &left, &right).map_err(|error| format!("{}: {error}", text(binary)));
        };
        let name = match binary.op {
            syn::BinOp::Add(_) => "add",
            syn::BinOp::Sub(_) => "sub",
            syn::BinOp::Mul(_) => "mul",
            syn::BinOp::Div(_) => "div",
            syn::BinOp::BitAnd(_) => "bitand",
            syn::BinOp::BitOr(_) => "bitor",
            _ => return Err(format!("not understood: {}", text(binary))),
        };
        let function = match &right {
            Value::Real(None, _) => ["f32", "f64"].iter().find_map(|ty| self.source.method(owner, name, ty).ok()),
            other => self.source.method(owner, name, &other.type_name()).ok(),
        };
        let function = function.ok_or_else(|| format!("{owner}::{name} of {}", right.type_name()))?.clone();
        Ok(self.call(&function, &[left, right])?.0)
    }

    fn cast(&mut self, value: Value, ty: &syn::Type) -> Result<Value> {
        if let Some(format) = self.format(ty) {
            return operators::convert(&value, format);
        }
        let most = match text(ty).as_str() {
            "i32" => i128::from(i32::MAX),
            "u32" => i128::from(u32::MAX),
            "u64" => i128::from(u64::MAX),
            other => return Err(format!("a cast to {other}")),
        };
        match value {
            Value::Int(x) if (0..=most).contains(&x) => Ok(value),
            other => Err(format!("a cast of {}", other.kind())),
        }
    }

    /// Changes a variable, or a part of one.
    fn assign(&mut self, frame: &mut Frame, to: &Rust, value: Value) -> Result<()> {
        match to {
            Rust::Paren(inner) => self.assign(frame, &inner.expr, value),
            Rust::Path(path) => {
                let name = text(path);
                let variable = frame.seen.iter_mut().rev().find(|(seen, _)| *seen == name);
                variable.ok_or_else(|| format!("nothing is known of {name}"))?.1 = value;
                Ok(())
            }
            Rust::Index(index) => {
                let (whole, at) = (self.eval(frame, &index.expr)?, self.eval(frame, &index.index)?);
                match (whole, at) {
                    (Value::List(mut of), Value::Int(at)) => {
                        let part = usize::try_from(at).ok().and_then(|at| of.get_mut(at));
                        *part.ok_or_else(|| format!("beyond the end: {}", text(to)))? = value;
                        self.assign(frame, &index.expr, Value::List(of))
                    }
                    _ => Err(format!("not understood: {}", text(to))),
                }
            }
            _ => Err(format!("not understood: {}", text(to))),
        }
    }

    fn branch(&mut self, frame: &mut Frame, branch: &syn::ExprIf) -> Result<Value> {
        let otherwise = branch.else_branch.as_ref().map(|(_, otherwise)| &**otherwise);
        let (mut yes, mut no) = (frame.clone(), frame.clone());
        let is_of_machine = matches!(&*branch.cond, Rust::Macro(call) if text(&call.mac.path) == "cfg");
        let condition = if is_of_machine { Expr::True } else { self.condition(frame, &branch.cond)? };
        // What is not reached need not be understood.
        let [value, other] = [
            if condition == Expr::False { Value::Unit } else { self.block(&mut yes, &branch.then_branch)? },
            match otherwise {
                Some(otherwise) if is_of_machine || condition != Expr::True => self.eval(&mut no, otherwise)?,
                _ => Value::Unit,
            },
        ];
        if is_of_machine {
            if !value.is_same(&other) || !yes.seen.iter().zip(&no.seen).all(|((_, x), (_, y))| x.is_same(y)) {
                return Err(format!("it depends on the machine: {}", text(branch)));
            }
            return Ok(value);
        }
        self.merge(frame, &condition, &yes, &no)?;
        Value::choose(&condition, &value, &other)
    }

    fn turns(&mut self, frame: &mut Frame, turn: &syn::ExprForLoop) -> Result<Value> {
        let over = match self.eval(frame, &turn.expr)? {
            Value::List(of) => of.into_iter().map(|x| (Expr::True, x)).collect(),
            Value::Filtered(of) => of,
            other => return Err(format!("a loop over {}", other.kind())),
        };
        for (condition, value) in over {
            let outside = frame.seen.len();
            let (mut inside, without) = (frame.clone(), frame.clone());
            self.bind(&mut inside, &turn.pat, &value, false)?;
            self.block(&mut inside, &turn.body)?;
            inside.seen.truncate(outside);
            self.merge(frame, &condition, &inside, &without)?;
        }
        Ok(Value::Unit)
    }

    /// What a name stands for.
    fn path(&mut self, frame: &mut Frame, path: &syn::Path) -> Result<Value> {
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

    /// A constant: a number keeps its name, others are what they are.
    fn constant(&mut self, frame: &Frame, owner: &str, name: &str) -> Result<Value> {
        let constant = self.source.constant(&frame.place.file, owner, name);
        let constant = match (constant, owner) {
            (Ok(constant), _) => constant.clone(),
            // A function by its name alone.
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

    fn type_name(&self, frame: &Frame, name: &str) -> String {
        let name = if name == "Self" { &frame.place.owner } else { name };
        self.known_as(name.split("::").last().unwrap_or(name))
    }

    /// Calls a function that is given by a path or is a value.
    fn call_path(&mut self, frame: &mut Frame, path: &Rust, arguments: &[Value]) -> Result<Value> {
        let Rust::Path(path) = path else { return Err(format!("not understood: {}", text(path))) };
        let name = text(&path.path);
        if let Some((_, function)) = frame.seen.iter().rev().find(|(seen, _)| *seen == name) {
            let function = function.clone();
            return self.apply(frame, &function, arguments);
        }
        let Some((owner, method)) = name.rsplit_once("::") else {
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
                let value = self.eval(&mut inside, &closure.body)?;
                // It would have to change what is outside.
                let changed = closure.seen.iter().zip(&inside.seen).any(|((_, x), (_, y))| !x.is_same(y));
                if changed { Err("a closure that changes something".into()) } else { Ok(value) }
            }
            Value::Function(owner, name) => match (owner.as_str(), name.as_str(), arguments) {
                ("f32", "from_bits", [bits]) => operators::from_bits(Format::Single, bits),
                ("f64", "from_bits", [bits]) => operators::from_bits(Format::Double, bits),
                ("f64", "from", [value]) => operators::convert(value, Format::Double),
                ("u32", "from", [Value::Bool(bit)]) => Ok(Value::Mask(vec![bit.clone()])),
                ("u64", "from", [Value::Int(x)]) if *x >= 0 => Ok(Value::Int(*x)),
                ("", name, _) => {
                    let function = self.source.function(&frame.place.file, name)?.clone();
                    Ok(self.call(&function, arguments)?.0)
                }
                (owner, name, _) => {
                    // A trait's function is that of its operand's type.
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

    fn method(&mut self, frame: &mut Frame, at: &Rust, on: Value, name: &str, with: &[Value]) -> Result<Value> {
        match (&on, name, with) {
            (Value::Real(format, x), ..) => {
                let named = self.name("x", &Value::Real(*format, x.clone()), false)?;
                let Value::Real(_, x) = named else { return Err("a number that is none".into()) };
                let with = with.iter().map(|y| self.name("y", y, false)).collect::<Result<Vec<_>>>()?;
                operators::method(&x, *format, name, &with)
            }
            (Value::Bits(format, crate::value::Bits::Plus(x, by)), "wrapping_add_signed", [Value::Int(more)]) => {
                Ok(Value::Bits(*format, crate::value::Bits::Plus(x.clone(), by + more)))
            }
            (Value::List(_), "into_iter" | "iter" | "copied", []) => Ok(on),
            (Value::List(of), "map", [function]) => {
                Ok(Value::List(of.iter().map(|x| self.apply(frame, function, &[x.clone()])).collect::<Result<_>>()?))
            }
            (Value::List(of), "all" | "any", [function]) => {
                let mut all = if name == "all" { Expr::True } else { Expr::False };
                for x in of {
                    match self.apply(frame, function, &[x.clone()])? {
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
                    match self.apply(frame, function, &[x.clone()])? {
                        Value::Bool(condition) => found.push((condition, x.clone())),
                        other => return Err(format!("{name} by {}", other.kind())),
                    }
                }
                Ok(Value::Filtered(found))
            }
            (Value::Range(ends), "contains", [x]) => {
                let not_before = operators::binary(&syn::parse_quote!(<=), &ends[0], x)?;
                let not_after = operators::binary(&syn::parse_quote!(<=), x, &ends[1])?;
                operators::binary(&syn::parse_quote!(&&), &not_before, &not_after)
            }
            (Value::State(state), ..) => {
                let (_, as_) = self
                    .opaque
                    .iter()
                    .find(|(opaque, _)| *opaque == name)
                    .ok_or_else(|| format!("{name} of a state"))?;
                let operands = std::iter::once((None, state.clone())).chain(with.iter().flat_map(numbers)).collect();
                let new = Value::State(Expr::Call((*as_).into(), operands));
                let new = self.name("sum", &new, true)?;
                self.assign(frame, at, new)?;
                Ok(Value::Unit)
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

/// The expressions of a value.
pub(crate) fn numbers(value: &Value) -> Vec<(Option<Format>, Expr)> {
    let mut found = Vec::new();
    let each = value.leaves("", &mut |_, leaf| {
        match leaf {
            Value::Real(format, x) => found.push((*format, x.clone())),
            Value::Bool(x) | Value::State(x) => found.push((None, x.clone())),
            _ => {}
        }
        Ok(leaf.clone())
    });
    drop(each);
    found
}

pub(crate) fn name_of_constant(place: &Place, name: &str) -> String {
    let module = module_of(&place.file);
    let stem = module.rsplit('/').next().unwrap_or_default();
    let of = if place.owner.is_empty() { stem } else { &place.owner };
    format!("{of}_{name}")
}

/// A name that is not taken, and that Rocq does not keep for itself.
pub(crate) fn fresh(taken: &mut BTreeSet<String>, name: &str) -> String {
    let kept = matches!(
        name,
        "by" | "end"
            | "with"
            | "at"
            | "exists"
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
    let name = if kept { format!("{name}_") } else { name.to_owned() };
    let mut fresh = name.clone();
    let mut times = 1;
    while !taken.insert(fresh.clone()) {
        times += 1;
        fresh = format!("{name}'{times}");
    }
    fresh
}

/// What a block returns, if that is how it ends.
fn returned(block: &Block) -> Option<Option<&Rust>> {
    match block.stmts.last() {
        Some(Stmt::Expr(Rust::Return(returned), _)) => Some(returned.expr.as_deref()),
        _ => None,
    }
}

fn literal_of(literal: &Lit) -> Result<Value> {
    match literal {
        Lit::Int(digits) if digits.suffix().is_empty() => {
            digits.base10_parse().map(Value::Int).map_err(|error| error.to_string())
        }
        Lit::Float(digits) if digits.suffix().is_empty() => {
            Ok(Value::Real(None, Expr::Literal(digits.base10_digits().to_owned())))
        }
        Lit::Bool(truth) => Ok(Value::Bool(if truth.value { Expr::True } else { Expr::False })),
        _ => Err(format!("not understood: {}", text(literal))),
    }
}

fn member(value: &Value, name: &str) -> Result<Value> {
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

/// An element of a list, or a component of a vector.
fn element<'v>(value: &'v Value, at: &Value) -> Result<&'v Value> {
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

/// The value that a parameter has: its shape, with names for its numbers.
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
            let short = reader.known_as(&last_name(ty));
            let short = if short == "Self" { owner } else { &short };
            if let Some((_, alias)) = reader.source.aliases.iter().find(|(name, _)| name == short) {
                return unknown(reader, alias, owner, name);
            }
            match short {
                "bool" => return Ok(Value::Bool(Expr::Name(name.into()))),
                "Sum" => return Ok(Value::State(Expr::Name(name.into()))),
                "i32" | "u32" | "usize" => return Ok(Value::Unknown(name.into())),
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

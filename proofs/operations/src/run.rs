//! Statements and expressions.

use std::rc::Rc;

use syn::{Block, Expr as Rust, Stmt, UnOp};

use crate::operators;
use crate::reader::{Frame, Reader};
use crate::shapes::{element, literal_of, member};
use crate::source::text;
use crate::value::{Closure, Expr, Result, Value};

impl Reader<'_> {
    /// Runs statements. Returns the value of the last one. In the block of a function, a branch may return early.
    pub(crate) fn statements(&mut self, frame: &mut Frame, statements: &[Stmt], is_function: bool) -> Result<Value> {
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
                // The compiler checks it.
                Stmt::Expr(Rust::Const(_), Some(_)) => {}
                // Attributes may remove it.
                Stmt::Expr(expr, _) if text(expr).starts_with('#') => {
                    return Err(format!("not understood: {}", text(expr)));
                }
                Stmt::Expr(Rust::If(branch), _) if is_function && is_returned(&branch.then_branch) => {
                    let condition = self.condition(frame, &branch.cond)?;
                    if condition == Expr::False {
                        continue;
                    }
                    let (mut early, mut later) = (frame.clone(), frame.clone());
                    if branch.else_branch.is_some() {
                        return Err("a return with an else".into());
                    }
                    let [before @ .., Stmt::Expr(Rust::Return(end), _)] = &branch.then_branch.stmts[..] else {
                        return Err("a branch that does not end with a return".into());
                    };
                    self.always(|reader| reader.statements(&mut early, before, false))?;
                    let yes = match &end.expr {
                        Some(value) => self.always(|reader| reader.eval(&mut early, value))?,
                        None => Value::Unit,
                    };
                    let no = self.always(|reader| reader.statements(&mut later, &statements[at + 1..], true))?;
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

    /// Merges the variables after a branch.
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

    pub(crate) fn block(&mut self, frame: &mut Frame, block: &Block) -> Result<Value> {
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

    /// Runs code that is conditional, so it must not use `?`.
    pub(crate) fn always<T>(&mut self, run: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        let before = self.asked.len();
        let value = run(self)?;
        if self.asked.len() == before { Ok(value) } else { Err("a question that is not always asked".into()) }
    }

    /// Evaluates an expression.
    pub(crate) fn eval(&mut self, frame: &mut Frame, expr: &Rust) -> Result<Value> {
        match expr {
            Rust::Paren(inner) => self.eval(frame, &inner.expr),
            Rust::Group(inner) => self.eval(frame, &inner.expr),
            Rust::Reference(inner) => self.eval(frame, &inner.expr),
            Rust::Unary(unary) => {
                let value = self.eval(frame, &unary.expr)?;
                match (unary.op, &value) {
                    (UnOp::Neg(_), Value::Struct(..)) => self.method(frame, value, "neg", &[]),
                    (op, _) => unary_of(op, value),
                }
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
            Rust::Range(range) => self.range(frame, range),
            Rust::Field(field) => {
                let value = self.eval(frame, &field.base)?;
                member(&value, &text(&field.member))
            }
            Rust::Index(index) => {
                let value = self.eval(frame, &index.expr)?;
                if let Rust::Range(range) = &*index.index {
                    return self.slice(frame, value, range);
                }
                let at = self.eval(frame, &index.index)?;
                element(&value, &at).cloned()
            }
            Rust::Cast(cast) => {
                let value = self.eval(frame, &cast.expr)?;
                self.cast(value, &cast.ty)
            }
            Rust::Binary(binary) if matches!(binary.op, syn::BinOp::AddAssign(_)) => {
                let (left, right) = (self.eval(frame, &binary.left)?, self.eval(frame, &binary.right)?);
                let sum = operators::binary(&syn::parse_quote!(+), &left, &right)?;
                self.assign(frame, &binary.left, sum)?;
                Ok(Value::Unit)
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
            Rust::If(branch) => self.always(|reader| reader.branch(frame, branch)),
            Rust::ForLoop(turn) if turn.label.is_none() => self.always(|reader| reader.turns(frame, turn)),
            Rust::Closure(closure) => Ok(Value::Closure(Rc::new(Closure {
                inputs: closure.inputs.iter().cloned().collect(),
                body: (*closure.body).clone(),
                seen: frame.seen.clone(),
                place: frame.place.clone(),
            }))),
            Rust::Struct(made) => {
                let name = self.type_name(frame, &text(&made.path));
                let fields = made.fields.iter().map(|field| {
                    let value = self.eval(frame, &field.expr)?;
                    Ok((text(&field.member), value))
                });
                let mut fields = fields.collect::<Result<Vec<_>>>()?;
                if let Some(rest) = &made.rest {
                    let Value::Struct(_, others) = self.eval(frame, rest)? else { return Err("fields of none".into()) };
                    fields
                        .extend(others.into_iter().filter(|(x, _)| made.fields.iter().all(|y| text(&y.member) != *x)));
                }
                self.structure(&name, fields)
            }
            Rust::Try(question) => match self.eval(frame, &question.expr)? {
                Value::Option(is_there, x) => {
                    self.asked.push(is_there);
                    Ok(*x)
                }
                other => Err(format!("a question of {}", other.kind())),
            },
            Rust::Call(call) => {
                let arguments = call.args.iter().map(|x| self.eval(frame, x)).collect::<Result<Vec<_>>>()?;
                self.call_path(frame, &call.func, &arguments)
            }
            Rust::MethodCall(call) => {
                let arguments = call.args.iter().map(|x| self.eval(frame, x)).collect::<Result<Vec<_>>>()?;
                let on = self.eval(frame, &call.receiver)?;
                self.method(frame, on, &call.method.to_string(), &arguments)
            }
            _ => Err(format!("not understood: {}", text(expr))),
        }
    }

    /// Builds a struct with the fields of its declaration, in that order, and with numbers of their formats.
    pub(crate) fn structure(&self, name: &str, mut fields: Vec<(String, Value)>) -> Result<Value> {
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

    fn binary(&mut self, frame: &mut Frame, binary: &syn::ExprBinary) -> Result<Value> {
        let left = self.eval(frame, &binary.left)?;
        // The second operand may be skipped.
        let right = self.always(|reader| reader.eval(frame, &binary.right))?;
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

    fn range(&mut self, frame: &mut Frame, range: &syn::ExprRange) -> Result<Value> {
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return Err(format!("not understood: {}", text(range)));
        };
        match (self.eval(frame, start)?, self.eval(frame, end)?, &range.limits) {
            (Value::Int(start), Value::Int(end), syn::RangeLimits::HalfOpen(_)) => {
                Ok(Value::List((start..end).map(Value::Int).collect()))
            }
            (start, end, syn::RangeLimits::Closed(_)) => Ok(Value::Range(Box::new([start, end]))),
            _ => Err(format!("not understood: {}", text(range))),
        }
    }

    /// Selects one of several rows.
    fn slice(&mut self, frame: &mut Frame, of: Value, range: &syn::ExprRange) -> Result<Value> {
        let ends = (&range.start, &range.end, &range.limits);
        match (of, ends) {
            (Value::Rows(rows), (Some(start), Some(end), syn::RangeLimits::HalfOpen(_)))
                if text(&**end) == format!("{}+A", text(&**start)) =>
            {
                match (self.eval(frame, start)?, &rows[..]) {
                    (Value::Count(Expr::If(of)), [lower, upper]) => match &*of {
                        [side, Expr::Number(4), Expr::Number(0)] => Value::choose(side, upper, lower),
                        [side, Expr::Number(0), Expr::Number(4)] => Value::choose(side, lower, upper),
                        _ => Err(format!("not understood: {}", text(range))),
                    },
                    _ => Err(format!("not understood: {}", text(range))),
                }
            }
            _ => Err(format!("not understood: {}", text(range))),
        }
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
            Value::Lane(_) => Ok(value),
            other => Err(format!("a cast of {}", other.kind())),
        }
    }

    /// Assigns to a variable, or to a part of one.
    pub(crate) fn assign(&mut self, frame: &mut Frame, to: &Rust, value: Value) -> Result<()> {
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
            Rust::Field(field) => match self.eval(frame, &field.base)? {
                Value::Struct(name, mut fields) => {
                    let part = fields.iter_mut().find(|(name, _)| *name == text(&field.member));
                    part.ok_or_else(|| format!("not understood: {}", text(to)))?.1 = value;
                    self.assign(frame, &field.base, Value::Struct(name, fields))
                }
                other => Err(format!("a part of {}", other.kind())),
            },
            _ => Err(format!("not understood: {}", text(to))),
        }
    }

    fn branch(&mut self, frame: &mut Frame, branch: &syn::ExprIf) -> Result<Value> {
        let otherwise = branch.else_branch.as_ref().map(|(_, otherwise)| &**otherwise);
        let (mut yes, mut no) = (frame.clone(), frame.clone());
        let is_of_machine = matches!(&*branch.cond, Rust::Macro(call) if text(&call.mac.path) == "cfg");
        let condition = if is_of_machine { Expr::True } else { self.condition(frame, &branch.cond)? };
        // Unreachable code need not be supported.
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
}

fn unary_of(op: UnOp, value: Value) -> Result<Value> {
    match (op, value) {
        (UnOp::Deref(_), value) => Ok(value),
        (UnOp::Not(_), Value::Bool(x)) => Ok(Value::Bool(x.not())),
        (UnOp::Not(_), Value::Lane(x)) => Ok(Value::Lane(x.not())),
        (UnOp::Neg(_), Value::Int(x)) => Ok(Value::Int(-x)),
        (UnOp::Neg(_), Value::Real(format, x)) => Ok(Value::Real(format, Expr::op("opposite", format, [x]))),
        (_, value) => Err(format!("an operator on {}", value.kind())),
    }
}

/// Returns whether a block ends with a return.
fn is_returned(block: &Block) -> bool {
    matches!(block.stmts.last(), Some(Stmt::Expr(Rust::Return(_), _)))
}

//! An interpreter of straight-line Rust from the library's files, on unknown values.
//!
//! It supports the constructs that the library uses: `let`, assignment, operators, casts, `if` with a value, calls of
//! other functions, early returns of `false`, and the cursors' operations on nodes and marks. Every other construct is
//! an error. No statement is skipped, so nothing is proved about code that was not understood.
//!
//! A node is represented by its key, as in `spec/rocq`: a parent is a shift, a sibling a toggled bit, and a layout
//! returns the key.

use std::collections::BTreeMap;

use syn::{BinOp, Block, Expr, Lit, RangeLimits, Stmt, UnOp};
use z3::ast::Bool;

use crate::source::{Source, Type, pattern, text};
use crate::word::{require, take_required};

/// Runs functions of a source. Values are bound to expressions by their text without spaces.
pub(crate) struct Machine<'s, N> {
    source: &'s Source,
    values: BTreeMap<String, N>,
    /// Type of the words `W`.
    word: Type,
    /// Whether the function has returned early, for the conditions so far.
    pub(crate) returned: Vec<N>,
    /// The type of `self`.
    owner: &'s str,
    /// The number of iterations of each loop.
    pub(crate) loops: Vec<N>,
}

impl<'s, N: Number> Machine<'s, N> {
    /// Starts with these values.
    pub(crate) fn new(source: &'s Source, word: Type, values: impl IntoIterator<Item = (&'static str, N)>) -> Self {
        let values = values.into_iter().map(|(text, value)| (text.to_owned(), value)).collect();
        Self { source, values, word, returned: Vec::new(), owner: "", loops: Vec::new() }
    }

    /// Selects the type of `self`.
    pub(crate) fn of(mut self, owner: &'s str) -> Self {
        self.owner = owner;
        self
    }

    /// Returns the current value of an expression.
    pub(crate) fn value(&self, text: &str) -> Result<N, String> {
        self.values.get(text).cloned().ok_or_else(|| format!("nothing is known of {text}"))
    }

    /// Runs a body with the current values. Returns its value, if any.
    pub(crate) fn run(&mut self, body: &Block) -> Result<Option<N>, String> {
        let mut last = None;
        for statement in &body.stmts {
            // Unreachable statements have no requirements.
            let returned = self.returned.iter().map(N::is_true).collect::<Result<Vec<_>, _>>()?;
            let before = take_required();
            last = self.step(statement)?;
            let here = take_required().into_iter().map(|required| Bool::or(&[&returned[..], &[required]].concat()));
            before.into_iter().chain(here.collect::<Vec<_>>()).for_each(require);
        }
        Ok(last)
    }

    /// Runs a function of the source with only these values.
    pub(crate) fn call(&self, name: &str, arguments: &[N]) -> Result<N, String> {
        let function = self.source.function(name)?;
        if function.parameters.len() != arguments.len() {
            return Err(format!("{name} takes {} parameters", function.parameters.len()));
        }
        let mut inside = Machine::new(self.source, self.word, []);
        inside.values.extend(function.parameters.iter().cloned().zip(arguments.iter().cloned()));
        inside.run(&function.body)?.ok_or_else(|| format!("{name} has no value"))
    }

    /// Runs one statement. Returns its value if it is the last one of a block with a value.
    pub(crate) fn step(&mut self, statement: &Stmt) -> Result<Option<N>, String> {
        match statement {
            Stmt::Local(local) => {
                let init = local.init.as_ref().filter(|init| init.diverge.is_none()).ok_or("a let without a value")?;
                let value = self.eval(&init.expr, None)?;
                self.values.insert(pattern(&local.pat), value);
                Ok(None)
            }
            Stmt::Expr(Expr::Assign(assign), _) => {
                let value = self.eval(&assign.right, None)?;
                self.values.insert(place(&assign.left), value);
                Ok(None)
            }
            Stmt::Expr(Expr::Binary(binary), Some(_)) => {
                let op = assigning(&binary.op)?;
                let value = self.binary(op, &binary.left, &binary.right, None)?;
                self.values.insert(place(&binary.left), value);
                Ok(None)
            }
            Stmt::Expr(Expr::If(branch), _) if text(&branch.then_branch) == "{returnfalse;}" => {
                let condition = self.eval(&branch.cond, None)?;
                self.returned.push(condition);
                Ok(None)
            }
            Stmt::Expr(Expr::ForLoop(climb), _) => self.climb(climb).map(|()| None),
            Stmt::Expr(Expr::MethodCall(call), Some(_)) if text(&call.receiver) == "self.marks" => {
                self.mark(call).map(|()| None)
            }
            Stmt::Expr(expr, None) => self.eval(expr, None).map(Some),
            other => Err(format!("not understood: {}", text(other))),
        }
    }

    /// Runs `for _ in 0..n { x = self.tree.parent(x); }`. By induction on n, the result is x shifted by n, which must
    /// be less than its width.
    fn climb(&mut self, climb: &syn::ExprForLoop) -> Result<(), String> {
        let (Expr::Range(range), [Stmt::Expr(Expr::Assign(assign), Some(_))]) = (&*climb.expr, &climb.body.stmts[..])
        else {
            return Err(format!("not understood: {}", text(climb)));
        };
        let (from, node) = (text(&range.start), place(&assign.left));
        let is_climb = text(&assign.right) == format!("self.tree.parent({node})");
        let (true, "0", RangeLimits::HalfOpen(_), Some(end)) = (is_climb, &*from, range.limits, &range.end) else {
            return Err(format!("not understood: {}", text(climb)));
        };
        let times = self.eval(end, Some(self.word))?;
        let above = self.value(&node)?.binary(Op::Shr, &times)?;
        self.loops.push(times);
        self.values.insert(node, above);
        Ok(())
    }

    /// Runs the operations of [`Disjoint`](stackless_bvh::traverse::Disjoint) on the second trail.
    fn mark(&mut self, call: &syn::ExprMethodCall) -> Result<(), String> {
        let function = self.source.function(&format!("Disjoint::{}", call.method))?;
        let arguments = call.args.iter().map(|argument| self.eval(argument, None)).collect::<Result<Vec<_>, _>>()?;
        if function.parameters.len() != arguments.len() {
            return Err(format!("{} takes {} parameters", call.method, function.parameters.len()));
        }
        let mut inside = Self::new(self.source, self.word, [("self.0", self.value("self.marks")?)]);
        inside.values.extend(function.parameters.into_iter().zip(arguments));
        inside.run(&function.body)?;
        self.values.insert("self.marks".into(), inside.value("self.0")?);
        Ok(())
    }

    /// Evaluates an expression. Literals have the expected type.
    pub(crate) fn eval(&mut self, expr: &Expr, expected: Option<Type>) -> Result<N, String> {
        let name = text(expr);
        if let Some(value) = self.values.get(&name) {
            return Ok(value.clone());
        }
        match expr {
            Expr::Paren(inner) => self.eval(&inner.expr, expected),
            Expr::Reference(inner) => self.eval(&inner.expr, expected),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => self.eval(&unary.expr, expected),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => self.eval(&unary.expr, expected)?.not(),
            Expr::Lit(literal) => Self::literal(&literal.lit, expected),
            Expr::Cast(cast) => {
                let to = Type::named(&text(&*cast.ty))?;
                Ok(self.eval(&cast.expr, Some(to))?.cast(to))
            }
            Expr::Binary(binary) => self.binary(operator(&binary.op)?, &binary.left, &binary.right, expected),
            Expr::If(branch) => {
                let (_, otherwise) = branch.else_branch.as_ref().ok_or("an if without an else")?;
                let condition = self.eval(&branch.cond, None)?;
                let yes = self.block(&branch.then_branch)?;
                let no = self.eval(otherwise, expected)?;
                condition.select(&yes, &no)
            }
            Expr::Block(block) => self.block(&block.block),
            Expr::Path(_) => self.constant(&name),
            Expr::Call(call) => self.call_by_name(&text(&*call.func), &call.args.iter().collect::<Vec<_>>()),
            Expr::MethodCall(call) => {
                self.method(&call.receiver, &call.method.to_string(), &call.args.iter().collect::<Vec<_>>(), expected)
            }
            _ => Err(format!("not understood: {name}")),
        }
    }

    /// Evaluates a block without outer effects.
    fn block(&self, block: &Block) -> Result<N, String> {
        if !block.stmts.iter().all(|statement| matches!(statement, Stmt::Local(_) | Stmt::Expr(_, None))) {
            return Err(format!("not understood: {}", text(block)));
        }
        let (source, word, values) = (self.source, self.word, self.values.clone());
        let (returned, owner, loops) = (Vec::new(), self.owner, Vec::new());
        let mut inside = Self { source, values, word, returned, owner, loops };
        inside.run(block)?.ok_or_else(|| "a block without a value".into())
    }

    fn literal(literal: &Lit, expected: Option<Type>) -> Result<N, String> {
        match literal {
            Lit::Int(value) => {
                let named = Some(value.suffix()).filter(|suffix| !suffix.is_empty()).map(Type::named).transpose()?;
                let ty = named.or(expected).ok_or_else(|| format!("a literal of no known type: {value}"))?;
                value.base10_parse().map(|value| N::literal(value, ty)).map_err(|error| error.to_string())
            }
            Lit::Bool(value) => Ok(N::literal(value.value.into(), Type::unsigned(1))),
            _ => Err(format!("not understood: {}", text(literal))),
        }
    }

    fn constant(&mut self, name: &str) -> Result<N, String> {
        if let Some(ty) = name.strip_suffix("::MAX") {
            return Type::named(ty).map(|ty| N::literal(ty.max(), ty));
        }
        let (ty, value) = self.source.constant(name)?;
        self.eval(&value, Some(ty))
    }

    fn call_by_name(&mut self, name: &str, arguments: &[&Expr]) -> Result<N, String> {
        match (name, arguments) {
            ("W::zero", []) => Ok(N::literal(0, self.word)),
            ("W::one", []) => Ok(N::literal(1, self.word)),
            ("W::from_bit", [value]) => Ok(self.eval(value, None)?.cast(self.word)),
            // An address is represented by its word.
            ("Node::from_bits", [value]) => self.eval(value, None),
            ("take" | "core::mem::take", [from]) => {
                let value = self.eval(from, None)?;
                self.values.remove(text(from).trim_start_matches("&mut"));
                Ok(value)
            }
            (_, [value]) if name.ends_with("::from") => {
                let to = Type::named(name.trim_end_matches("::from"))?;
                Ok(self.eval(value, None)?.cast(to))
            }
            _ => {
                let values =
                    arguments.iter().map(|argument| self.eval(argument, None)).collect::<Result<Vec<_>, _>>()?;
                self.call(name, &values)
            }
        }
    }

    fn method(&mut self, on: &Expr, name: &str, with: &[&Expr], expected: Option<Type>) -> Result<N, String> {
        if let Some(node) = self.node(on, name, with)? {
            return Ok(node);
        }
        let op = match (name, with) {
            ("wrapping_add", [_]) => Op::WrappingAdd,
            ("wrapping_sub", [_]) => Op::WrappingSub,
            ("wrapping_mul", [_]) => Op::WrappingMul,
            ("min", [_]) => Op::Min,
            ("and", [_]) => Op::And,
            ("or", [_]) => Op::Or,
            ("xor", [_]) => Op::Xor,
            ("shr", [_]) => Op::Shr,
            (_, []) => {
                let value = self.eval(on, expected)?;
                let ty = value.ty();
                return match name {
                    "cast_signed" => Ok(value.cast(Type { signed: true, ..ty })),
                    "cast_unsigned" => Ok(value.cast(Type { signed: false, ..ty })),
                    "trailing_zeros" => value.trailing_zeros(),
                    "clone" => Ok(value),
                    "shl1" | "shr1" | "is_zero" | "is_all_ones" => {
                        let mut word = Self::new(self.source, ty, [("self", value)]);
                        word.run(&self.source.word_method(name)?)?.ok_or_else(|| format!("{name} has no value"))
                    }
                    _ => Err(format!("not understood: {name}")),
                };
            }
            _ => return Err(format!("not understood: {name}")),
        };
        let argument = with.first().ok_or_else(|| format!("{name} takes an argument"))?;
        self.binary(op, on, argument, expected)
    }

    /// Evaluates a method of a tree, a layout or the cursor itself on nodes and keys.
    fn node(&mut self, on: &Expr, name: &str, with: &[&Expr]) -> Result<Option<N>, String> {
        let node = match (&*text(on), name, with) {
            ("self.tree", "parent", [node]) => self.eval(node, None)?.binary(Op::Shr, &N::literal(1, self.word))?,
            ("self.tree", "sibling", [node]) => self.eval(node, None)?.binary(Op::Xor, &N::literal(1, self.word))?,
            ("self.tree", "child", [node, side]) => {
                let (node, side) = (self.eval(node, None)?, self.eval(side, None)?);
                node.binary(Op::Shl, &N::literal(1, self.word))?.binary(Op::Or, &side)?
            }
            ("self.layout", "node", [key]) => self.eval(key, None)?,
            ("self", "current_key", []) => {
                let body = self.source.function(&format!("{}::current_key", self.owner))?.body;
                self.block(&body)?
            }
            _ => return Ok(None),
        };
        Ok(Some(node))
    }

    fn binary(&mut self, op: Op, left: &Expr, right: &Expr, expected: Option<Type>) -> Result<N, String> {
        let literal = |expr: &Expr| matches!(expr, Expr::Lit(_));
        let (left, right) = if literal(left) && !literal(right) {
            let right = self.eval(right, expected)?;
            (self.eval(left, Some(right.ty()))?, right)
        } else {
            let left = self.eval(left, expected)?;
            let ty = left.ty();
            (left, self.eval(right, Some(ty))?)
        };
        if left.ty() != right.ty() {
            return Err(format!("{op:?} of two types"));
        }
        left.binary(op, &right)
    }
}

fn operator(op: &BinOp) -> Result<Op, String> {
    Ok(match op {
        BinOp::Add(_) => Op::Add,
        BinOp::Sub(_) => Op::Sub,
        BinOp::Mul(_) => Op::Mul,
        BinOp::Div(_) => Op::Div,
        BinOp::BitAnd(_) => Op::And,
        BinOp::BitOr(_) => Op::Or,
        BinOp::BitXor(_) => Op::Xor,
        BinOp::Shl(_) => Op::Shl,
        BinOp::Shr(_) => Op::Shr,
        BinOp::Eq(_) => Op::Equal,
        BinOp::Ne(_) => Op::Unequal,
        _ => return Err(format!("not understood: {}", text(op))),
    })
}

fn assigning(op: &BinOp) -> Result<Op, String> {
    Ok(match op {
        BinOp::BitAndAssign(_) => Op::And,
        BinOp::BitOrAssign(_) => Op::Or,
        BinOp::BitXorAssign(_) => Op::Xor,
        _ => return Err(format!("not understood: {}", text(op))),
    })
}

/// An operator on two numbers. `Add` and `Mul` must not overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Op {
    Add,
    Mul,
    Div,
    Sub,
    And,
    Or,
    Xor,
    Shl,
    Shr,
    WrappingAdd,
    WrappingSub,
    WrappingMul,
    Min,
    Equal,
    Unequal,
}

/// A kind of unknown numbers.
pub(crate) trait Number: Clone {
    fn literal(value: u128, ty: Type) -> Self;
    fn ty(&self) -> Type;
    fn is_true(&self) -> Result<Bool, String>;
    fn cast(&self, to: Type) -> Self;
    fn binary(&self, op: Op, other: &Self) -> Result<Self, String>;
    fn not(&self) -> Result<Self, String>;
    fn trailing_zeros(&self) -> Result<Self, String>;
    /// Selects one of two by a truth value.
    fn select(&self, yes: &Self, no: &Self) -> Result<Self, String>;
}

/// Returns the place of an assignment: `*counter` is `counter`.
fn place(expr: &Expr) -> String {
    text(expr).trim_start_matches('*').to_owned()
}

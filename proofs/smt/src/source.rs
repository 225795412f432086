//! The library's straight-line functions that are no generics: read from its files, and run on unknowns.
//!
//! What is understood is what they use: `let`, assignment, operators, casts, `if` with a value, calls of each other. All
//! else is an error, so that a function that changes beyond it is not proved by mistake.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::visit::{self, Visit};
use syn::{BinOp, Block, Expr, Lit, Pat, Stmt, UnOp};
use z3::ast::Bool;

use crate::word::{require, take_required};

/// The files that functions are taken from.
const FILES: &[&str] = &[
    include_str!("../../../src/hash/modulo.rs"),
    include_str!("../../../src/hash/address.rs"),
    include_str!("../../../src/hash/perfect.rs"),
    include_str!("../../../src/hash/mod.rs"),
    include_str!("../../../src/traverse/marks.rs"),
    include_str!("../../../src/traverse/sparse.rs"),
    include_str!("../../../src/traverse/implicit_a.rs"),
    include_str!("../../../src/traverse/implicit_b.rs"),
];

/// An integer type; one unsigned bit is a truth value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Type {
    pub(crate) width: u32,
    pub(crate) signed: bool,
}

impl Type {
    /// Unsigned, of so many bits.
    pub(crate) const fn unsigned(width: u32) -> Self {
        Self { width, signed: false }
    }

    fn named(name: &str) -> Result<Self, String> {
        let (sign, width) = name.split_at(name.len().min(1));
        let width = if width == "size" { Ok(64) } else { width.parse() };
        match (sign, width) {
            ("u" | "i", Ok(width)) => Ok(Self { width, signed: sign == "i" }),
            _ => Err(format!("no integer type: {name}")),
        }
    }

    fn max(self) -> u128 {
        u128::MAX >> (u128::BITS - self.width + u32::from(self.signed))
    }
}

/// What two numbers are put together by. `Add` and `Mul` must not overflow.
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

/// Unknown numbers of some kind.
pub(crate) trait Number: Clone {
    fn literal(value: u128, ty: Type) -> Self;
    fn ty(&self) -> Type;
    fn is_true(&self) -> Result<Bool, String>;
    fn cast(&self, to: Type) -> Self;
    fn binary(&self, op: Op, other: &Self) -> Result<Self, String>;
    fn not(&self) -> Result<Self, String>;
    fn trailing_zeros(&self) -> Result<Self, String>;
    /// One of two, by a truth value.
    fn select(&self, yes: &Self, no: &Self) -> Result<Self, String>;
}

/// The library's files, parsed.
pub(crate) struct Source(Vec<syn::File>);

impl Source {
    /// As they are.
    pub(crate) fn library() -> Result<Self, String> {
        Self::parse(FILES.iter().map(ToString::to_string))
    }

    /// With a slip: `from`, which must stand in them once, replaced by `to`.
    pub(crate) fn with(from: &str, to: &str) -> Result<Self, String> {
        let found: usize = FILES.iter().map(|text| text.matches(from).count()).sum();
        if found != 1 {
            return Err(format!("the slip's text {from:?} stands in the files {found} times"));
        }
        Self::parse(FILES.iter().map(|text| text.replace(from, to)))
    }

    fn parse(files: impl Iterator<Item = String>) -> Result<Self, String> {
        files.map(|text| syn::parse_file(&text).map_err(|error| error.to_string())).collect::<Result<_, _>>().map(Self)
    }

    /// A function, by its name if that is one of its own, else by its type's too: `wrap`, `Reciprocal::of_u32`, or `::prune`
    /// where there is no type.
    pub(crate) fn function(&self, name: &str) -> Result<Function, String> {
        let mut finder = Finder { name, owner: String::new(), found: Vec::new(), constants: BTreeMap::new() };
        self.0.iter().for_each(|file| finder.visit_file(file));
        match <[_; 1]>::try_from(finder.found) {
            Ok([function]) => Ok(function),
            Err(found) => Err(format!("{} functions are named {name}", found.len())),
        }
    }

    fn constant(&self, name: &str) -> Option<(Type, Expr)> {
        let mut finder = Finder { name: "", owner: String::new(), found: Vec::new(), constants: BTreeMap::new() };
        self.0.iter().for_each(|file| finder.visit_file(file));
        finder.constants.remove(name)
    }
}

/// A function's parameters and body.
#[derive(Clone)]
pub(crate) struct Function {
    parameters: Vec<String>,
    pub(crate) body: Block,
}

struct Finder<'n> {
    name: &'n str,
    owner: String,
    found: Vec<Function>,
    constants: BTreeMap<String, (Type, Expr)>,
}

impl Finder<'_> {
    fn meet(&mut self, signature: &syn::Signature, body: &Block) {
        let name = signature.ident.to_string();
        if name == self.name || format!("{}::{name}", self.owner) == self.name {
            let parameters = signature.inputs.iter().filter_map(|input| match input {
                syn::FnArg::Typed(typed) => Some(pattern(&typed.pat)),
                syn::FnArg::Receiver(_) => None,
            });
            self.found.push(Function { parameters: parameters.collect(), body: body.clone() });
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.meet(&item.sig, &item.block);
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if let syn::Type::Path(path) = &*item.self_ty {
            self.owner = path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
        }
        visit::visit_item_impl(self, item);
        self.owner.clear();
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.meet(&item.sig, &item.block);
    }

    fn visit_item_const(&mut self, item: &'ast syn::ItemConst) {
        if let Ok(ty) = Type::named(&text(&*item.ty)) {
            self.constants.insert(item.ident.to_string(), (ty, (*item.expr).clone()));
        }
    }
}

/// Runs functions of a source on values that expressions are bound to, by their text without spaces.
pub(crate) struct Machine<'s, N> {
    source: &'s Source,
    values: BTreeMap<String, N>,
    /// Type of the words `W`.
    word: Type,
    /// Whether the function has returned early, by the conditions so far.
    pub(crate) returned: Vec<N>,
    /// Starts of the statements that have no effect here.
    ignored: &'s [&'s str],
}

impl<'s, N: Number> Machine<'s, N> {
    /// With these values.
    pub(crate) fn new(source: &'s Source, word: Type, values: impl IntoIterator<Item = (&'static str, N)>) -> Self {
        let values = values.into_iter().map(|(text, value)| (text.to_owned(), value)).collect();
        Self { source, values, word, returned: Vec::new(), ignored: &[] }
    }

    /// Passes over the statements that start so.
    pub(crate) fn ignoring(mut self, ignored: &'s [&'s str]) -> Self {
        self.ignored = ignored;
        self
    }

    /// The value that an expression is bound to now.
    pub(crate) fn value(&self, text: &str) -> Result<N, String> {
        self.values.get(text).cloned().ok_or_else(|| format!("nothing is known of {text}"))
    }

    /// Runs a body with the values bound so far; its value, if it has one.
    pub(crate) fn run(&mut self, body: &Block) -> Result<Option<N>, String> {
        let mut last = None;
        for statement in &body.stmts {
            // Nothing is required of statements that are not reached.
            let returned = self.returned.iter().map(N::is_true).collect::<Result<Vec<_>, _>>()?;
            let before = take_required();
            last = self.step(statement)?;
            let here = take_required().into_iter().map(|required| Bool::or(&[&returned[..], &[required]].concat()));
            before.into_iter().chain(here.collect::<Vec<_>>()).for_each(require);
        }
        Ok(last)
    }

    /// Runs a function of the source on these values alone.
    pub(crate) fn call(&self, name: &str, arguments: &[N]) -> Result<N, String> {
        let function = self.source.function(name)?;
        if function.parameters.len() != arguments.len() {
            return Err(format!("{name} takes {} parameters", function.parameters.len()));
        }
        let mut inside = Machine::new(self.source, self.word, []);
        inside.values.extend(function.parameters.iter().cloned().zip(arguments.iter().cloned()));
        inside.run(&function.body)?.ok_or_else(|| format!("{name} has no value"))
    }

    /// Runs one statement; its value, where it is the last one of a block with a value.
    pub(crate) fn step(&mut self, statement: &Stmt) -> Result<Option<N>, String> {
        if self.ignored.iter().any(|start| text(statement).starts_with(start)) {
            return Ok(None);
        }
        match statement {
            Stmt::Local(local) => {
                let init = local.init.as_ref().ok_or("a let without a value")?;
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
                let op = operator(&binary.op)?;
                let value = self.binary(op, &binary.left, &binary.right, None)?;
                self.values.insert(place(&binary.left), value);
                Ok(None)
            }
            Stmt::Expr(Expr::If(branch), _) if text(&branch.then_branch) == "{returnfalse;}" => {
                let condition = self.eval(&branch.cond, None)?;
                self.returned.push(condition);
                Ok(None)
            }
            Stmt::Expr(expr, None) => self.eval(expr, None).map(Some),
            other => Err(format!("not understood: {}", text(other))),
        }
    }

    /// The value of an expression; literals have the expected type.
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
            Expr::Lit(literal) => match (&literal.lit, expected) {
                (Lit::Int(value), Some(ty)) => {
                    value.base10_parse().map(|value| N::literal(value, ty)).map_err(|error| error.to_string())
                }
                (Lit::Bool(value), _) => Ok(N::literal(value.value.into(), Type::unsigned(1))),
                _ => Err(format!("a literal of no known type: {name}")),
            },
            Expr::Cast(cast) => {
                let to = Type::named(&text(&*cast.ty))?;
                Ok(self.eval(&cast.expr, Some(to))?.cast(to))
            }
            Expr::Binary(binary) => self.binary(operator(&binary.op)?, &binary.left, &binary.right, expected),
            Expr::If(branch) => {
                let (_, otherwise) = branch.else_branch.as_ref().ok_or("an if without an else")?;
                let condition = self.eval(&branch.cond, None)?;
                let yes = self.run(&branch.then_branch)?.ok_or("a branch without a value")?;
                let no = self.eval(otherwise, expected)?;
                condition.select(&yes, &no)
            }
            Expr::Block(block) => self.run(&block.block)?.ok_or_else(|| "a block without a value".into()),
            Expr::Path(_) => self.constant(&name),
            Expr::Call(call) => self.call_by_name(&text(&*call.func), &call.args.iter().collect::<Vec<_>>()),
            Expr::MethodCall(call) => {
                self.method(&call.receiver, &call.method.to_string(), &call.args.iter().collect::<Vec<_>>(), expected)
            }
            _ => Err(format!("not understood: {name}")),
        }
    }

    fn constant(&mut self, name: &str) -> Result<N, String> {
        if let Some(ty) = name.strip_suffix("::MAX") {
            return Type::named(ty).map(|ty| N::literal(ty.max(), ty));
        }
        let (ty, value) = self.source.constant(name).ok_or_else(|| format!("nothing is known of {name}"))?;
        self.eval(&value, Some(ty))
    }

    fn call_by_name(&mut self, name: &str, arguments: &[&Expr]) -> Result<N, String> {
        match (name, arguments) {
            ("W::zero", []) => Ok(N::literal(0, self.word)),
            ("W::one", []) => Ok(N::literal(1, self.word)),
            // What an address is made of is the word itself, and what is taken is the value.
            ("Node::from_bits" | "take" | "core::mem::take", [value]) => self.eval(value, None),
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
                    "shl1" => value.binary(Op::Shl, &N::literal(1, ty)),
                    "shr1" => value.binary(Op::Shr, &N::literal(1, ty)),
                    "cast_signed" => Ok(value.cast(Type { signed: true, ..ty })),
                    "cast_unsigned" => Ok(value.cast(Type { signed: false, ..ty })),
                    "trailing_zeros" => value.trailing_zeros(),
                    "is_zero" => value.binary(Op::Equal, &N::literal(0, ty)),
                    "is_all_ones" => {
                        let next = value.binary(Op::WrappingAdd, &N::literal(1, ty))?;
                        value.binary(Op::And, &next)?.binary(Op::Equal, &N::literal(0, ty))
                    }
                    _ => Err(format!("not understood: {name}")),
                };
            }
            _ => return Err(format!("not understood: {name}")),
        };
        let (Some(argument), left) = (with.first(), on) else { return Err(format!("{name} takes an argument")) };
        self.binary(op, left, argument, expected)
    }

    fn binary(&mut self, op: Op, left: &Expr, right: &Expr, expected: Option<Type>) -> Result<N, String> {
        let literal = |expr: &Expr| matches!(expr, Expr::Lit(_));
        let (left, right) = if literal(left) && !literal(right) {
            let right = self.eval(right, expected)?;
            (self.eval(left, expected.or(Some(right.ty())))?, right)
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
        BinOp::Add(_) | BinOp::AddAssign(_) => Op::Add,
        BinOp::Sub(_) | BinOp::SubAssign(_) => Op::Sub,
        BinOp::Mul(_) | BinOp::MulAssign(_) => Op::Mul,
        BinOp::Div(_) | BinOp::DivAssign(_) => Op::Div,
        BinOp::BitAnd(_) | BinOp::BitAndAssign(_) => Op::And,
        BinOp::BitOr(_) | BinOp::BitOrAssign(_) => Op::Or,
        BinOp::BitXor(_) | BinOp::BitXorAssign(_) => Op::Xor,
        BinOp::Shl(_) | BinOp::ShlAssign(_) => Op::Shl,
        BinOp::Shr(_) | BinOp::ShrAssign(_) => Op::Shr,
        BinOp::Eq(_) => Op::Equal,
        BinOp::Ne(_) => Op::Unequal,
        _ => return Err(format!("not understood: {}", text(op))),
    })
}

/// Tokens without spaces.
pub(crate) fn text(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string().split_whitespace().collect()
}

/// What is assigned to: `*counter` is `counter`.
fn place(expr: &Expr) -> String {
    text(expr).trim_start_matches('*').to_owned()
}

/// The name that a pattern binds.
fn pattern(pat: &Pat) -> String {
    match pat {
        Pat::Type(typed) => pattern(&typed.pat),
        Pat::Ident(ident) => ident.ident.to_string(),
        other => text(other),
    }
}

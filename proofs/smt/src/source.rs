//! The library's straight-line functions without a [`Word`](stackless_bvh::key::Word) parameter, read from its files.

use std::rc::Rc;

use quote::ToTokens;
use syn::visit::{self, Visit};
use syn::{Block, Expr, Pat};

/// The files of functions, by the names of their modules.
const FILES: &[(&str, &str)] = &[
    ("modulo", include_str!("../../../src/hash/modulo.rs")),
    ("address", include_str!("../../../src/hash/address.rs")),
    ("perfect", include_str!("../../../src/hash/perfect.rs")),
    ("hash", include_str!("../../../src/hash/mod.rs")),
    ("marks", include_str!("../../../src/traverse/marks.rs")),
    ("sparse", include_str!("../../../src/traverse/sparse.rs")),
    ("implicit_a", include_str!("../../../src/traverse/implicit_a.rs")),
    ("implicit_b", include_str!("../../../src/traverse/implicit_b.rs")),
    ("trail", include_str!("../../../src/trail.rs")),
    ("swap", include_str!("../../../src/swap.rs")),
];

/// The methods of words, in a macro for all word types.
const WORDS: &str = include_str!("../../../src/key/word.rs");

thread_local! {
    /// The parsed files. About a hundred slips change one file each.
    static PARSED: Vec<Result<Rc<syn::File>, String>> = FILES.iter().map(|(_, text)| parse(text)).collect();
}

/// The library's files, parsed.
pub(crate) struct Source {
    files: Vec<(&'static str, Rc<syn::File>)>,
    words: String,
}

impl Source {
    /// Returns the files unchanged.
    pub(crate) fn library() -> Result<Self, String> {
        Self::changed(str::to_owned)
    }

    /// Returns the files with a slip: `from`, which must occur once, is replaced by `to`.
    pub(crate) fn with(from: &str, to: &str) -> Result<Self, String> {
        let texts = FILES.iter().map(|(_, text)| *text).chain([WORDS]);
        let found: usize = texts.map(|text| text.matches(from).count()).sum();
        if found != 1 {
            return Err(format!("the slip's text {from:?} stands in the files {found} times"));
        }
        Self::changed(|text| text.replace(from, to))
    }

    fn changed(change: impl Fn(&str) -> String) -> Result<Self, String> {
        let file = |(i, (module, text)): (usize, &(&'static str, &str))| {
            let changed = change(text);
            let file = if changed == *text { PARSED.with(|parsed| parsed[i].clone()) } else { parse(&changed) };
            Ok((*module, file?))
        };
        let files = FILES.iter().enumerate().map(file).collect::<Result<_, String>>()?;
        Ok(Self { files, words: change(WORDS) })
    }

    /// Returns the body of a method of words without further arguments.
    pub(crate) fn word_method(&self, name: &str) -> Result<Block, String> {
        let head = format!("fn {name}(");
        let bodies = self.words.split(&head).skip(1).filter_map(|rest| {
            let (parameters, rest) = rest.split_once(')')?;
            let (returned, rest) = rest.split_once('{')?;
            let takes_itself = matches!(parameters, "self" | "&self") && !returned.contains(';');
            takes_itself.then(|| rest.split_once('}').map(|(body, _)| format!("{{{body}}}"))).flatten()
        });
        let body = only(name, bodies.collect())?;
        syn::parse_str(&body).map_err(|error| format!("{name}: {error}"))
    }

    /// Finds a function: by its name if that is unique, otherwise with its type (`wrap`, `Reciprocal::of_u32`, or
    /// `::prune` without a type), or with its module (`trail::child`).
    pub(crate) fn function(&self, name: &str) -> Result<Function, String> {
        only(name, self.find(name).functions)
    }

    /// Finds a constant of the modules by its name.
    pub(crate) fn constant(&self, name: &str) -> Result<(Type, Expr), String> {
        only(name, self.find(name).constants)
    }

    fn find<'n>(&self, name: &'n str) -> Finder<'n> {
        let mut finder =
            Finder { name, module: "", owner: String::new(), functions: Vec::new(), constants: Vec::new() };
        for (module, file) in &self.files {
            finder.module = module;
            finder.visit_file(file);
        }
        finder
    }
}

fn parse(text: &str) -> Result<Rc<syn::File>, String> {
    syn::parse_file(text).map(Rc::new).map_err(|error| error.to_string())
}

fn only<T>(name: &str, found: Vec<T>) -> Result<T, String> {
    match <[_; 1]>::try_from(found) {
        Ok([item]) => Ok(item),
        Err(found) => Err(format!("{name} is the name of {} items", found.len())),
    }
}

/// An integer type. One unsigned bit is a truth value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Type {
    pub(crate) width: u32,
    pub(crate) signed: bool,
}

impl Type {
    /// Returns the unsigned type of a width.
    pub(crate) const fn unsigned(width: u32) -> Self {
        Self { width, signed: false }
    }

    /// Finds a type by its name; `usize` has 64 bits.
    pub(crate) fn named(name: &str) -> Result<Self, String> {
        let (sign, width) = name.split_at(name.len().min(1));
        let width = if width == "size" { Ok(64) } else { width.parse() };
        match (sign, width) {
            ("u" | "i", Ok(width)) => Ok(Self { width, signed: sign == "i" }),
            _ => Err(format!("no integer type: {name}")),
        }
    }

    pub(crate) fn max(self) -> u128 {
        u128::MAX >> (u128::BITS - self.width + u32::from(self.signed))
    }
}

/// A function's parameters and body.
#[derive(Clone)]
pub(crate) struct Function {
    pub(crate) parameters: Vec<String>,
    pub(crate) body: Block,
}

struct Finder<'n> {
    name: &'n str,
    module: &'static str,
    owner: String,
    functions: Vec<Function>,
    constants: Vec<(Type, Expr)>,
}

impl Finder<'_> {
    fn meet(&mut self, signature: &syn::Signature, body: &Block) {
        let name = signature.ident.to_string();
        let is_free = self.owner.is_empty() && format!("{}::{name}", self.module) == self.name;
        if name == self.name || format!("{}::{name}", self.owner) == self.name || is_free {
            let parameters = signature.inputs.iter().filter_map(|input| match input {
                syn::FnArg::Typed(typed) => Some(pattern(&typed.pat)),
                syn::FnArg::Receiver(_) => None,
            });
            self.functions.push(Function { parameters: parameters.collect(), body: body.clone() });
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
        if let Ok(ty) = Type::named(&text(&*item.ty))
            && item.ident == self.name
        {
            self.constants.push((ty, (*item.expr).clone()));
        }
    }
}

/// Returns the body for the case `Some`: the arm `Some(name)` of its `match`, or the block of its `if let`.
pub(crate) fn where_some(body: &Block, name: &str) -> Result<Expr, String> {
    struct Arms {
        pattern: String,
        found: Vec<Expr>,
    }
    impl<'ast> Visit<'ast> for Arms {
        fn visit_arm(&mut self, arm: &'ast syn::Arm) {
            if text(&arm.pat) == self.pattern && arm.guard.is_none() {
                self.found.push((*arm.body).clone());
            }
        }

        fn visit_expr_if(&mut self, branch: &'ast syn::ExprIf) {
            if text(&branch.cond).starts_with(&format!("let{}=", self.pattern)) {
                let block = branch.then_branch.clone();
                self.found.push(Expr::Block(syn::ExprBlock { attrs: Vec::new(), label: None, block }));
            }
            visit::visit_expr_if(self, branch);
        }
    }
    let mut arms = Arms { pattern: format!("Some({name})"), found: Vec::new() };
    arms.visit_block(body);
    only(&arms.pattern, arms.found)
}

/// Returns tokens without spaces.
pub(crate) fn text(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string().split_whitespace().collect()
}

/// Returns the name that a pattern binds.
pub(crate) fn pattern(pat: &Pat) -> String {
    match pat {
        Pat::Type(typed) => pattern(&typed.pat),
        Pat::Ident(ident) => ident.ident.to_string(),
        other => text(other),
    }
}

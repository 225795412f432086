//! Edits of the source: the place of a bug's text, and a file with several bugs compiled in.
//!
//! The body of a function with bugs selects one of several bodies at run time:
//!
//! ```text
//! { match crate::planted::bug() { 17 => { body with edit 17 }, 23 => { body with edit 23 }, _ => { body } } }
//! ```
//!
//! Closures of two bodies have two types. So if a function returns `impl Trait`, only the smallest expression around
//! the edit is selected.

use std::fmt::Write as _;
use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::bug::Bug;

/// Reasons why an edit cannot be applied.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum EditError {
    #[error("the file is not Rust: {0}")]
    Source(String),
    #[error("old occurs {0} times, expected once")]
    Count(usize),
    #[error("no function is called {0}")]
    NoFunction(String),
    #[error("old is in no function's body")]
    Outside,
    #[error("new is equal to old")]
    Unchanged,
    #[error("the file with new in it is not Rust: {0}")]
    Result(String),
}

/// A file of the library, parsed.
pub(crate) struct Source<'s> {
    text: &'s str,
    functions: Vec<Function>,
}

/// A function that is not nested in another function.
struct Function {
    names: Vec<String>,
    body: Range<usize>,
    /// `const`, which is incompatible with a choice at run time.
    constness: Option<Range<usize>>,
    /// `#[inline(always)]`. Inlining a function with several bodies into another such function would create copies for
    /// all pairs.
    inline: Option<Range<usize>>,
    /// Expressions of the body, if the function returns `impl Trait`.
    expressions: Option<Vec<Range<usize>>>,
}

/// A bug with its place in a file.
pub(crate) struct Edit<'b> {
    number: usize,
    at: Range<usize>,
    new: &'b str,
    /// The text that has a second version.
    unit: Range<usize>,
}

impl<'s> Source<'s> {
    pub(crate) fn parse(text: &'s str) -> Result<Self, EditError> {
        let file = syn::parse_file(text).map_err(|error| EditError::Source(error.to_string()))?;
        let mut collector = Collector { functions: Vec::new(), owner: None };
        collector.visit_file(&file);
        Ok(Self { text, functions: collector.functions })
    }

    /// Finds the text of a bug, and parses the resulting file.
    pub(crate) fn edit<'b>(&self, number: usize, bug: &'b Bug) -> Result<Edit<'b>, EditError> {
        if bug.old == bug.new {
            return Err(EditError::Unchanged);
        }
        let of_name = |name: &String| {
            let functions: Vec<_> = self.functions.iter().filter(|function| function.names.contains(name)).collect();
            if functions.is_empty() { Err(EditError::NoFunction(name.clone())) } else { Ok(functions) }
        };
        let named = bug.function.as_ref().map(of_name).transpose()?;
        let is_named = |at: usize| {
            named.as_ref().is_none_or(|functions| functions.iter().any(|function| function.body.contains(&at)))
        };
        let mut places = self.text.match_indices(&bug.old).map(|(at, _)| at).filter(|&at| is_named(at));
        let (Some(start), more) = (places.next(), places.count()) else { return Err(EditError::Count(0)) };
        if more > 0 {
            return Err(EditError::Count(1 + more));
        }
        let at = start..start + bug.old.len();
        let holds = |range: &Range<usize>| range.start <= at.start && at.end <= range.end;
        let function = self.functions.iter().find(|it| holds(&it.body)).ok_or(EditError::Outside)?;
        let smallest = |expressions: &Vec<Range<usize>>| {
            expressions.iter().filter(|range| holds(range)).min_by_key(|range| range.len()).cloned()
        };
        let unit = match &function.expressions {
            Some(expressions) => smallest(expressions).ok_or(EditError::Outside)?,
            None => function.body.clone(),
        };
        let edited = [&self.text[..at.start], &bug.new, &self.text[at.end..]].concat();
        syn::parse_file(&edited).map_err(|error| EditError::Result(error.to_string()))?;
        Ok(Edit { number, at, new: &bug.new, unit })
    }

    /// The file with all edits compiled in.
    pub(crate) fn with(&self, edits: &[Edit<'_>]) -> String {
        let dropped = self.no_longer_const(edits).chain(self.no_longer_inline(edits));
        let mut replaced: Vec<_> = dropped.map(|range| (range, String::new())).collect();
        for edit in edits {
            if !replaced.iter().any(|(range, _)| *range == edit.unit) {
                let of_unit: Vec<_> = edits.iter().filter(|other| other.unit == edit.unit).collect();
                replaced.push((edit.unit.clone(), self.choice(&edit.unit, &of_unit)));
            }
        }
        replaced.sort_by_key(|(range, _)| range.start);
        let (mut text, mut done) = (String::new(), 0);
        for (range, new) in replaced {
            // An expression within another replaced expression. `check` refuses two such bugs.
            if range.start >= done {
                text.push_str(&self.text[done..range.start]);
                text.push_str(&new);
                done = range.end;
            }
        }
        text + &self.text[done..]
    }

    /// The positions of `const` of the edited functions, and of their callers in this file.
    fn no_longer_const(&self, edits: &[Edit<'_>]) -> impl Iterator<Item = Range<usize>> {
        let is_edited = |it: &&Function| edits.iter().any(|edit| it.body.contains(&edit.at.start));
        let mut dropped: Vec<_> = self.functions.iter().filter(is_edited).collect();
        let mut next = 0;
        while let Some(callee) = dropped.get(next).copied() {
            next += 1;
            for caller in self.functions.iter().filter(|it| it.constness.is_some()) {
                let is_known = dropped.iter().any(|it| it.body == caller.body);
                if !is_known && calls(&self.text[caller.body.clone()], &callee.names[0]) {
                    dropped.push(caller);
                }
            }
        }
        dropped.into_iter().filter_map(|function| function.constness.clone())
    }

    fn no_longer_inline(&self, edits: &[Edit<'_>]) -> impl Iterator<Item = Range<usize>> {
        let is_edited = |it: &&Function| edits.iter().any(|edit| it.body.contains(&edit.at.start));
        self.functions.iter().filter(is_edited).filter_map(|function| function.inline.clone())
    }

    fn choice(&self, unit: &Range<usize>, edits: &[&Edit<'_>]) -> String {
        let mut text = String::from("{ match crate::planted::bug() {\n");
        for Edit { number, at, new, .. } in edits {
            let (before, after) = (&self.text[unit.start..at.start], &self.text[at.end..unit.end]);
            let _ = writeln!(text, "{number} => {{ {before}{new}{after} }}");
        }
        text + &format!("_ => {{ {} }} }} }}", &self.text[unit.clone()])
    }
}

/// Whether a body calls a function of this name, of any type.
fn calls(body: &str, name: &str) -> bool {
    body.match_indices(name).any(|(at, _)| {
        let after = &body[at + name.len()..];
        let is_word = body[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_');
        !is_word && (after.starts_with('(') || after.starts_with("::<"))
    })
}

impl Edit<'_> {
    /// Whether the texts of two edits overlap, so that only one of them could be compiled in.
    pub(crate) fn overlaps(&self, other: &Edit<'_>) -> bool {
        self.unit != other.unit && self.unit.start < other.unit.end && other.unit.start < self.unit.end
    }
}

struct Collector {
    functions: Vec<Function>,
    /// The type of the surrounding `impl` block.
    owner: Option<String>,
}

impl Collector {
    fn add(&mut self, attributes: &[syn::Attribute], signature: &syn::Signature, body: &syn::Block) {
        let name = signature.ident.to_string();
        let qualified = self.owner.as_ref().map(|owner| format!("{owner}::{name}"));
        let mut hidden = Hidden(false);
        hidden.visit_return_type(&signature.output);
        let expressions = hidden.0.then(|| {
            let mut expressions = Expressions(Vec::new());
            expressions.visit_block(body);
            expressions.0
        });
        self.functions.push(Function {
            names: [Some(name), qualified].into_iter().flatten().collect(),
            body: body.span().byte_range(),
            inline: attributes.iter().find(|it| is_inline_always(it)).map(|it| it.span().byte_range()),
            constness: signature.constness.map(|token| token.span().byte_range()),
            expressions,
        });
    }
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        let name = match &*item.self_ty {
            syn::Type::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
            _ => None,
        };
        let outer = std::mem::replace(&mut self.owner, name);
        visit::visit_item_impl(self, item);
        self.owner = outer;
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.add(&item.attrs, &item.sig, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.add(&item.attrs, &item.sig, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(body) = &item.default {
            self.add(&item.attrs, &item.sig, body);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if item.ident != "tests" {
            visit::visit_item_mod(self, item);
        }
    }
}

fn is_inline_always(attribute: &syn::Attribute) -> bool {
    attribute.path().is_ident("inline") && attribute.parse_args::<syn::Ident>().is_ok_and(|how| how == "always")
}

/// Whether a type names `impl Trait`.
struct Hidden(bool);

impl Visit<'_> for Hidden {
    fn visit_type_impl_trait(&mut self, _: &syn::TypeImplTrait) {
        self.0 = true;
    }
}

/// The positions of all expressions that can be wrapped.
struct Expressions(Vec<Range<usize>>);

impl<'ast> Visit<'ast> for Expressions {
    fn visit_expr(&mut self, expression: &'ast syn::Expr) {
        self.0.push(expression.span().byte_range());
        visit::visit_expr(self, expression);
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    const FILE: &str = "struct A;\nimpl A {\n    const fn f(x: u32) -> u32 {\n        x + 1\n    }\n    #[inline(always)] fn g(x: u32) -> u32 { x + 1 }\n    #[inline(always)] fn k(x: u32) -> u32 { x * 3 }\n}\n\
        fn h(x: u32) -> impl Fn() -> u32 { move || x - 2 }\n";

    fn bug(function: Option<&str>, old: &str, new: &str) -> Bug {
        Bug {
            name: "b".into(),
            clause: "A-1".into(),
            file: "f.rs".into(),
            function: function.map(Into::into),
            old: old.into(),
            new: new.into(),
            survives: None,
            listed_in: PathBuf::new(),
        }
    }

    fn refusal(function: Option<&str>, old: &str, new: &str) -> Option<EditError> {
        Source::parse(FILE).unwrap().edit(1, &bug(function, old, new)).err()
    }

    #[test]
    fn an_edit_that_does_not_apply_is_refused() {
        assert_eq!(refusal(None, "x + 1", "x + 2"), Some(EditError::Count(2)));
        assert_eq!(refusal(Some("f"), "x + 1", "x + 2"), None);
        assert_eq!(refusal(Some("A::f"), "x + 1", "x + 2"), None);
        assert_eq!(refusal(Some("f"), "x + 7", "x + 2"), Some(EditError::Count(0)));
        assert_eq!(refusal(Some("B::f"), "x + 1", "x"), Some(EditError::NoFunction("B::f".into())));
        assert_eq!(refusal(None, "struct A", "struct B"), Some(EditError::Outside));
        assert_eq!(refusal(Some("f"), "x + 1", "x + 1"), Some(EditError::Unchanged));
        assert!(matches!(refusal(Some("f"), "x + 1", "x + "), Some(EditError::Result(_))));
        assert!(matches!(Source::parse("fn ("), Err(EditError::Source(_))));
    }

    #[test]
    fn callers_of_edited_functions_are_no_longer_const() {
        let file = "const fn f() -> u32 { 1 }\nconst fn g() -> u32 { f() }\nconst fn h() -> u32 { self_f() }\nconst fn self_f() -> u32 { 2 }\n";
        let source = Source::parse(file).unwrap();
        let bug = bug(Some("f"), "1", "2");
        let text = source.with(&[source.edit(1, &bug).unwrap()]);
        assert_eq!(text.matches("const fn").count(), 2, "{text}");
    }

    #[test]
    fn all_bugs_of_a_file_are_compiled_in() {
        let source = Source::parse(FILE).unwrap();
        let bugs = [
            bug(Some("f"), "x + 1", "x"),
            bug(Some("f"), "+ 1", "- 1"),
            bug(None, "x - 2", "x - 3"),
            bug(None, "x * 3", "x"),
        ];
        let edits: Vec<_> = (1..).zip(&bugs).map(|(number, bug)| source.edit(number, bug).unwrap()).collect();
        let text = source.with(&edits);
        syn::parse_file(&text).unwrap();
        assert!(!text.contains("const fn"), "{text}");
        assert!(text.contains("1 => { {\n        x\n    } }") && text.contains("x - 1"), "{text}");
        assert!(text.contains("move || { match crate::planted::bug() {\n3 => { x - 3 }"), "{text}");
        assert!(text.contains("#[inline(always)] fn g(x: u32) -> u32 { x + 1 }"), "{text}");
        assert!(text.contains("\n     fn k(x: u32) -> u32 { match"), "{text}");
    }
}

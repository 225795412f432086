//! Loops whose count is not known.

use syn::{Block, Pat};

use crate::print::{renamed, tidy};
use crate::reader::{Frame, Reader, Result};
use crate::shapes::fresh;
use crate::value::{Expr, Format, Let, Loop, Value};

/// A variable of a loop: its name, its format, and what it is before.
type Variable = (String, Option<Format>, Expr);

impl Reader<'_> {
    /// A loop over the counts below one. A turn is run on unknown variables to see which of them it changes, and again
    /// on these.
    pub(crate) fn counted(&mut self, frame: &mut Frame, pattern: &Pat, body: &Block, count: Expr) -> Result<Value> {
        let (taken, constants) = (self.taken.clone(), self.constants.len());
        let all = |_: usize| true;
        let (_, ends, _, _) = self.turn(frame, pattern, body, &all)?;
        let is_changed: Vec<bool> = ends.iter().map(|(before, after)| !before.is_same(after)).collect();
        self.taken = taken;
        self.constants.truncate(constants);

        let (index, ends, variables, lets) = self.turn(frame, pattern, body, &|at| is_changed[at])?;
        let changed = ends.iter().zip(&is_changed).filter(|(_, is_changed)| **is_changed);
        let end = changed.map(|((_, after), _)| expression(after)).collect::<Result<Vec<_>>>()?;
        let (mut lets, mut end) = (lets, end.into_iter().map(|(format, x)| (x, format)).collect::<Vec<_>>());
        renamed(&self.renamed, &mut lets, &mut end);
        let (lets, end) = tidy(lets, end);
        let names = variables.iter().map(|(name, ..)| name.clone()).collect();
        let start = variables.iter().map(|(_, format, x)| (*format, x.clone())).collect();
        let after: Vec<String> = variables.iter().map(|(name, ..)| fresh(&mut self.taken, base(name))).collect();
        let value = Expr::Loop(Box::new(Loop { count, index, names, start, lets, end }));
        self.lets.push(Let { names: after.clone(), value, format: None, is_written: true });

        let (mut at, mut after) = (0, after.into_iter());
        for (name, value) in &mut frame.seen {
            *value = value.leaves(name, &mut |_, leaf| {
                at += 1;
                if !is_changed[at - 1] {
                    return Ok(leaf.clone());
                }
                unknown(leaf, Expr::Name(after.next().ok_or("a variable without a name")?))
            })?;
        }
        Ok(Value::Unit)
    }

    /// One turn. The name of its number; of all parts of variables what they are before and after; those that got
    /// names; and what it names.
    #[expect(clippy::type_complexity, reason = "it is used in two places")]
    fn turn(
        &mut self,
        frame: &Frame,
        pattern: &Pat,
        body: &Block,
        is_unknown: &dyn Fn(usize) -> bool,
    ) -> Result<(String, Vec<(Value, Value)>, Vec<Variable>, Vec<Let>)> {
        let outside = std::mem::take(&mut self.lets);
        let mut inside = frame.clone();
        let (mut variables, mut before) = (Vec::new(), Vec::new());
        for (name, value) in &mut inside.seen {
            *value = value.leaves(name, &mut |name, leaf| {
                let mut leaf = leaf.clone();
                if is_unknown(before.len())
                    && let Ok((format, x)) = expression(&leaf)
                {
                    let own = fresh(&mut self.taken, name);
                    leaf = unknown(&leaf, Expr::Name(own.clone()))?;
                    variables.push((own, format, x));
                }
                before.push(leaf.clone());
                Ok(leaf)
            })?;
        }
        let count = inside.seen.len();
        let index = match pattern {
            Pat::Ident(ident) => fresh(&mut self.taken, &ident.ident.to_string()),
            _ => return Err("a loop over a pattern".into()),
        };
        self.bind(&mut inside, pattern, &Value::Count(Expr::Name(index.clone())), false)?;
        self.block(&mut inside, body)?;
        inside.seen.truncate(count);
        let mut after = Vec::new();
        for (name, value) in &inside.seen {
            value.leaves(name, &mut |_, leaf| {
                after.push(leaf.clone());
                Ok(leaf.clone())
            })?;
        }
        if before.len() != after.len() {
            return Err("a loop that changes a shape".into());
        }
        let lets = std::mem::replace(&mut self.lets, outside);
        Ok((index, before.into_iter().zip(after).collect(), variables, lets))
    }

    /// The sum of the first elements of an array, one added after the other to -0.
    pub(crate) fn sum(&mut self, format: Format, array: Expr, count: Expr) -> Value {
        let [index, name, sum] = ["i", "sum", "sum"].map(|name| fresh(&mut self.taken, name));
        let element = Expr::op("element", None, [array, Expr::Name(index.clone())]);
        let end = Expr::op("plus", Some(format), [Expr::Name(name.clone()), element]);
        let start = Expr::op("opposite", Some(format), [Expr::Constant(0, 0)]);
        let (start, end, lets) = (vec![(Some(format), start)], vec![(end, Some(format))], Vec::new());
        let value = Expr::Loop(Box::new(Loop { count, index, names: vec![name], start, lets, end }));
        self.lets.push(Let { names: vec![sum.clone()], value, format: Some(format), is_written: true });
        Value::Real(Some(format), Expr::Name(sum))
    }
}

/// A part of a variable as an expression; integers are counts.
fn expression(leaf: &Value) -> Result<(Option<Format>, Expr)> {
    match leaf {
        Value::Real(Some(format), x) => Ok((Some(*format), x.clone())),
        Value::Bool(x) | Value::Array(_, x) => Ok((None, x.clone())),
        other => Ok((None, other.count()?)),
    }
}

fn unknown(leaf: &Value, name: Expr) -> Result<Value> {
    if matches!(leaf, Value::Int(_)) { Ok(Value::Count(name)) } else { leaf.with(&name) }
}

/// A name without the number that makes it fresh.
fn base(name: &str) -> &str {
    name.split('\'').next().unwrap_or(name)
}

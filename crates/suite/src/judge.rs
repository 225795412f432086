//! Checks of answers.

use core::fmt;

use serde_json::{Map, Value};

use super::ask::{Ask, Build};
use super::author::{depth_if_tree, folds, keys_of, levels_if_tree};
use super::bits::Bits;
use super::text::{Shown, parse_floats};
use super::{Answer, Expect, Feature, Hello, Near, NearHit, SuiteCase};

/// A fault of an answer. Long text is shortened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// The implementation answers that it does not support a case that it has declared to support.
    Unsupported(String),
    /// The answer is a result, but a rejection is expected.
    NotRejected(String),
    /// The answer is a rejection, but a result is expected.
    Rejected(String),
    /// The code of the rejection is wrong.
    Code {
        /// The expected code.
        expected: String,
        /// The code found.
        found: String,
    },
    /// A field is missing.
    Missing(String),
    /// A field is unknown.
    Unknown(String),
    /// A field or one of its elements has a wrong value.
    Differs {
        /// The name of the field, and the index of the element.
        at: String,
        /// The expected value.
        expected: String,
        /// The value found.
        found: String,
    },
    /// A table is wrong.
    Table(String),
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unsupported(why) => {
                write!(f, "unsupported ({}), though profile and features were named", Shown(why))
            }
            Self::NotRejected(code) => write!(f, "answered, expected the rejection '{code}'"),
            Self::Rejected(code) => write!(f, "rejected as '{}', expected an answer", Shown(code)),
            Self::Code { expected, found } => write!(f, "rejected as '{}', expected '{expected}'", Shown(found)),
            Self::Missing(field) => write!(f, "no field '{field}'"),
            Self::Unknown(field) => write!(f, "unknown field '{}'", Shown(field)),
            Self::Differs { at, expected, found } => write!(f, "{at}: {}, expected {}", Shown(found), Shown(expected)),
            Self::Table(what) => write!(f, "the table is wrong: {}", Shown(what)),
        }
    }
}

impl std::error::Error for Flaw {}

/// Checks the answer of an implementation with these features and limits. `[CONF-1]` `[CONF-3]`
///
/// # Errors
/// The first flaw.
pub fn judge(case: &SuiteCase, hello: &Hello, answer: &Answer) -> Result<(), Flaw> {
    let has = |feature| hello.features.contains(&feature);
    let expect = if is_too_deep(case, hello) { &Expect::Reject("too-deep".to_owned()) } else { &case.expect };
    let result = match (expect, answer) {
        (_, Answer::Unsupported(why)) => return Err(Flaw::Unsupported(why.clone())),
        (Expect::Reject(expected), Answer::Reject(found)) if expected == found => return Ok(()),
        (Expect::Reject(expected), Answer::Reject(found)) => {
            return Err(Flaw::Code { expected: expected.clone(), found: found.clone() });
        }
        (Expect::Reject(expected), Answer::Result(_)) => return Err(Flaw::NotRejected(expected.clone())),
        (_, Answer::Reject(code)) => return Err(Flaw::Rejected(code.clone())),
        (_, Answer::Result(result)) => result,
    };
    let expected = match expect {
        Expect::Result(expected) => expected,
        Expect::Near(near) => return judge_near(near, result),
        _ => return judge_table(case, result),
    };
    let mut known: Vec<_> = expected.keys().map(String::as_str).collect();
    for (name, expected) in expected {
        if name == "trails" && !has(Feature::Trails) {
            continue;
        }
        let found = result.get(name).ok_or_else(|| Flaw::Missing(name.clone()))?;
        if name == "hits" {
            let plain = |hits| plain_hits(hits, has(Feature::Weights));
            compare(name, &plain(expected), &plain(found))?;
        } else {
            compare(name, expected, found)?;
        }
    }
    let is_binary = !case.input.contains_key("slots");
    if let (Some(events), Some(trails), true) = (expected.get("events"), expected.get("trails"), is_binary) {
        let states = States::of(events, trails);
        for (feature, name) in [(Feature::Counters, "counters"), (Feature::Registers, "registers")] {
            if !has(feature) {
                continue;
            }
            known.push(name);
            let found = result.get(name).ok_or_else(|| Flaw::Missing(name.to_owned()))?;
            match feature {
                Feature::Counters => compare(name, &states.counters(), found)?,
                _ => states.judge_registers(found)?,
            }
        }
    }
    match result.keys().find(|name| !known.contains(&name.as_str())) {
        Some(name) => Err(Flaw::Unknown(name.clone())),
        None => Ok(()),
    }
}

/// Returns whether the case's tree exceeds the implementation's declared limits.
fn is_too_deep(case: &SuiteCase, hello: &Hello) -> bool {
    let is_walk = case.id.starts_with("trace/") || case.id.starts_with("resume/");
    if !is_walk || matches!(case.expect, Expect::Reject(_)) {
        return false;
    }
    let (limit, depth) = match Ask::of(&case.input) {
        Ok(Ask::Trace(walk) | Ask::Resume(walk) | Ask::ResumeDisjoint(walk) | Ask::ResumeKey(walk)) => {
            (hello.limits.max_depth, depth_if_tree(&walk.children))
        }
        Ok(Ask::TraceWide(walk) | Ask::ResumeWide(walk)) => {
            let limit = hello.limits.wide.and_then(|wide| wide.of(walk.slots.into()));
            (limit, levels_if_tree(walk.slots, &walk.children))
        }
        _ => (None, None),
    };
    limit.zip(depth).is_some_and(|(limit, depth)| depth > limit)
}

/// Reports the first element that differs.
fn compare(name: &str, expected: &Value, found: &Value) -> Result<(), Flaw> {
    if expected == found {
        return Ok(());
    }
    let differs = |at: String, expected: Option<&Value>, found: Option<&Value>| {
        let text = |value: Option<&Value>| value.map_or("nothing".to_owned(), ToString::to_string);
        Err(Flaw::Differs { at, expected: text(expected), found: text(found) })
    };
    if let (Value::Array(expected), Value::Array(found)) = (expected, found) {
        for i in 0..expected.len().max(found.len()) {
            if expected.get(i) != found.get(i) {
                return differs(format!("{name}[{i}]"), expected.get(i), found.get(i));
            }
        }
    }
    differs(name.to_owned(), Some(expected), Some(found))
}

/// Returns hits in the form for comparing: with unsigned zeros, and with weights only if they are compared.
fn plain_hits(hits: &Value, has_weights: bool) -> Value {
    let Value::Array(hits) = hits else { return hits.clone() };
    let plain = |hit: &Value| {
        let Value::Object(fields) = hit else { return hit.clone() };
        let wanted = fields.iter().filter(|(name, _)| has_weights || !matches!(name.as_str(), "u" | "v"));
        let unsigned = |value: &Value| if value == "80000000" { Value::from("00000000") } else { value.clone() };
        Value::Object(wanted.map(|(name, value)| (name.clone(), unsigned(value))).collect())
    };
    hits.iter().map(plain).collect()
}

/// Checks that each hit is an accepted triangle at a distance within the tolerance.
fn judge_near(near: &Near, result: &Map<String, Value>) -> Result<(), Flaw> {
    if let Some(name) = result.keys().find(|name| *name != "hits") {
        return Err(Flaw::Unknown(name.clone()));
    }
    let found = result.get("hits").and_then(Value::as_array).ok_or_else(|| Flaw::Missing("hits".to_owned()))?;
    let is_near = |expected: &NearHit, found: &Map<String, Value>| {
        let place = |text: &str| parse_floats(text).map(|[t]: [f32; 1]| t.to_bits());
        let prim = found.get("prim").and_then(Value::as_u64);
        let off = place(&expected.t).zip(found.get("t").and_then(Value::as_str).and_then(place));
        prim.is_some_and(|prim| expected.prims.iter().any(|&one| u64::from(one) == prim))
            && off.is_some_and(|(a, b)| a.abs_diff(b) <= near.ulps)
    };
    for i in 0..near.hits.len().max(found.len()) {
        let is_right = match (near.hits.get(i), found.get(i)) {
            (Some(None), Some(Value::Null)) => true,
            (Some(Some(expected)), Some(Value::Object(found))) => is_near(expected, found),
            _ => false,
        };
        if !is_right {
            let expected = match near.hits.get(i) {
                Some(Some(NearHit { t, prims })) => format!("prim of {prims:?}, t {t} within {} ulp", near.ulps),
                Some(None) => "null".to_owned(),
                None => "nothing".to_owned(),
            };
            let found = found.get(i).map_or("nothing".to_owned(), ToString::to_string);
            return Err(Flaw::Differs { at: format!("hits[{i}]"), expected, found });
        }
    }
    Ok(())
}

/// Keys and trails, which determine the rest of the state.
struct States {
    /// Key and trail at each visit, with equal lengths.
    visits: Vec<(Bits, Bits)>,
}

impl States {
    fn of(events: &Value, trails: &Value) -> Self {
        fn texts(list: &Value) -> impl Iterator<Item = &str> {
            list.as_array().into_iter().flatten().filter_map(Value::as_str)
        }
        let keys = texts(events).filter_map(|event| {
            let (_, key) = event.split_once(' ').filter(|(kind, _)| *kind != "backtrack")?;
            Bits::of_hex(key)
        });
        let visit = |(key, trail): (Bits, &str)| {
            let trail = Bits::of_hex(trail)?.of_length(key.0.len())?;
            Some((key, trail))
        };
        Self { visits: keys.zip(texts(trails)).filter_map(visit).collect() }
    }

    /// Computes the counters: the complement of the trail below the depth, and a one above. `[TRAIL-6]`
    fn counters(&self) -> Value {
        let below = |trail: &Bits| Bits(trail.0.iter().skip(1).copied().collect()).complement();
        self.visits.iter().map(|(_, trail)| Bits([vec![true], below(trail).0].concat()).hex()).collect()
    }

    /// Checks that registers are unset or the next node, and never unset while the sibling is postponed. `[REGISTER-1]`
    fn judge_registers(&self, found: &Value) -> Result<(), Flaw> {
        let none = Vec::new();
        let found = found.as_array().unwrap_or(&none);
        for (i, (key, trail)) in self.visits.iter().enumerate() {
            let next = (!trail.is_zero()).then(|| lowest_postponed(key, trail).hex());
            let register = found.get(i).ok_or_else(|| Flaw::Missing(format!("registers[{i}]")))?;
            let may_be_unset = trail.0.last() != Some(&true);
            let is_right = match (register, &next) {
                (Value::Null, _) => may_be_unset,
                (Value::String(key), Some(next)) => key == next,
                _ => false,
            };
            if !is_right {
                let expected = match (next, may_be_unset) {
                    (Some(next), false) => format!("\"{next}\""),
                    (Some(next), true) => format!("\"{next}\" or null"),
                    (None, _) => "null".to_owned(),
                };
                return Err(Flaw::Differs { at: format!("registers[{i}]"), expected, found: register.to_string() });
            }
        }
        match found.get(self.visits.len()) {
            Some(register) => {
                let at = format!("registers[{}]", self.visits.len());
                Err(Flaw::Differs { at, expected: "nothing".to_owned(), found: register.to_string() })
            }
            None => Ok(()),
        }
    }
}

/// Removes the bits below the lowest one of the trail, and goes to the sibling there. `[TRAIL-4]`
fn lowest_postponed(key: &Bits, trail: &Bits) -> Bits {
    key.clone().without(trail.trailing(false)).flip_last()
}

/// Checks that a table leads each key of the tree to its node. `[HASH-9]`
fn judge_table(case: &SuiteCase, result: &Map<String, Value>) -> Result<(), Flaw> {
    let wrong = |what: String| Err(Flaw::Table(what));
    let Ok(Ask::Build(Build { children, reach, sizes })) = Ask::of(&case.input) else {
        return wrong("nobody has asked for one".to_owned());
    };
    let Some(depth) = depth_if_tree(&children) else { return wrong("the children are no tree".to_owned()) };
    // Only long keys are folded. A deep tree may have no hashed long keys.
    let (may_fold, must_fold) = (depth >= u64::BITS, folds(&children, reach));
    let is_known =
        |name: &str| matches!(name, "displacements" | "cells" | "seed" | "bits") || name == "fold" && may_fold;
    if let Some(name) = result.keys().find(|name| !is_known(name)) {
        return Err(Flaw::Unknown(name.clone()));
    }
    let fold = match result.get("fold") {
        Some(seed) => seed.as_str().and_then(word),
        None if must_fold => return Err(Flaw::Missing("fold".to_owned())),
        None => Some(0),
    };
    let Some(fold) = fold else { return wrong("fold: not a word of 64 bits".to_owned()) };
    let words = |name: &str| -> Result<Vec<u32>, Flaw> {
        let list = result.get(name).and_then(Value::as_array).ok_or_else(|| Flaw::Missing(name.to_owned()))?;
        let words = list.iter().map(|text| u32::try_from(word(text.as_str()?)?).ok()).collect::<Option<_>>();
        words.ok_or_else(|| Flaw::Table(format!("{name}: not all are words of 32 bits")))
    };
    let (displacements, cells) = (words("displacements")?, words("cells")?);
    let (d, h) = (displacements.len() as u64, cells.len() as u64);
    if !displacements.len().is_power_of_two() || h % 2 == 0 {
        return wrong(format!("D = {d}, H = {h}"));
    }
    if sizes.is_some_and(|sizes| sizes.map(u64::from) != [d, h]) {
        return wrong(format!("D = {d}, H = {h}, expected {sizes:?}"));
    }
    let mix = match (result.get("seed"), result.get("bits")) {
        (None, None) => None,
        (Some(seed), Some(bits)) if sizes.is_none() => {
            let seed = seed.as_str().and_then(word);
            let bits = bits.as_u64().filter(|bits| [32, 64].contains(bits));
            let (Some(seed), Some(bits)) = (seed, bits) else { return wrong("seed or bits".to_owned()) };
            Some((seed, bits == 32))
        }
        _ => return wrong("a seed where none is allowed, or without bits".to_owned()),
    };
    for (key, node) in keys_of(&children, reach, fold) {
        let mixed = mix.map_or(key, |(seed, narrow)| super::author::mixed(key, seed, narrow));
        let displacement = displacements[(mixed % d) as usize];
        let found = if displacement >> 31 == 1 {
            displacement
        } else {
            cells[((mixed % h + u64::from(displacement) % h) % h) as usize]
        };
        if found != node {
            return wrong(format!("the key {key:x} leads to {found:x}, expected {node:x}"));
        }
    }
    Ok(())
}

fn word(digits: &str) -> Option<u64> {
    Bits::of_hex(digits)?.number()
}

//! One JSON object a line: what a runner writes, and what an implementation answers.

use std::io::{self, BufRead, Write};

use serde::de::Error as _;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::text::{object, parse, read_line};
use super::{Feature, Level, Profile, SuiteCase};

/// Version of the protocol.
pub const PROTOCOL: u32 = 1;

/// What a runner writes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "cmd", rename_all = "kebab-case")]
pub(super) enum Request {
    Hello { protocol: u32 },
    Case { seq: u64, level: Level, profile: String, input: Map<String, Value> },
    Bye,
}

/// What an implementation says of itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// Version of the protocol.
    pub protocol: u32,
    /// Its name.
    pub name: String,
    /// Its version.
    #[serde(default)]
    pub version: String,
    /// What it answers: `level/profile`.
    pub profiles: Vec<String>,
    /// What it has beyond that.
    #[serde(default)]
    pub features: Vec<Feature>,
    /// What it carries.
    #[serde(default)]
    pub limits: Limits,
}

impl Hello {
    /// Reads a line, as `schema/hello.json` has it.
    pub(super) fn parse(line: &str) -> serde_json::Result<Self> {
        let hello = parse(line)?;
        let limits = hello.get("limits");
        let wide = limits.and_then(|limits| limits.get("wide"));
        let objects: Option<Vec<_>> =
            [Some(&hello), limits, wide].into_iter().flatten().map(Value::as_object).collect();
        // What is null was not left out.
        if objects.is_none_or(|objects| objects[1..].iter().any(|limits| limits.values().any(Value::is_null))) {
            return Err(serde_json::Error::custom("expected objects, and whole numbers as limits"));
        }
        serde_json::from_value(hello)
    }

    /// Whether a case is put to the implementation: it has named the profile, has the features, and carries nodes of so
    /// many slots.
    pub fn asks_for(&self, profile: &Profile, case: &SuiteCase) -> bool {
        let slots = case.input.get("slots").and_then(Value::as_u64);
        let carries = |slots| self.limits.wide.is_none_or(|wide| wide.of(slots).is_some());
        self.profiles.contains(&profile.name())
            && case.features.iter().all(|feature| self.features.contains(feature))
            && slots.is_none_or(carries)
    }
}

/// Limits of an implementation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Deepest tree, in edges.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_depth: Option<u32>,
    /// Wide trees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wide: Option<WideLimits>,
}

/// The greatest level of an inner node, by the slots of a node. Trees of other slots are not carried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WideLimits {
    /// Of trees of 2 slots a node.
    #[serde(default, rename = "2", skip_serializing_if = "Option::is_none")]
    pub of_2: Option<u32>,
    /// Of trees of 4 slots a node.
    #[serde(default, rename = "4", skip_serializing_if = "Option::is_none")]
    pub of_4: Option<u32>,
    /// Of trees of 8 slots a node.
    #[serde(default, rename = "8", skip_serializing_if = "Option::is_none")]
    pub of_8: Option<u32>,
}

impl WideLimits {
    /// Of trees of so many slots a node.
    pub const fn of(self, slots: u64) -> Option<u32> {
        match slots {
            2 => self.of_2,
            4 => self.of_4,
            8 => self.of_8,
            _ => None,
        }
    }
}

/// The answer to a case, with the case's number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Fields")]
pub struct Reply {
    /// Of the case.
    pub seq: u64,
    /// What is answered.
    #[serde(flatten)]
    pub answer: Answer,
}

impl Reply {
    /// Reads a line, as `schema/reply.json` has it.
    pub(super) fn parse(line: &str) -> serde_json::Result<Self> {
        let reply = parse(line)?;
        if !reply.is_object() {
            return Err(serde_json::Error::custom("expected an object"));
        }
        serde_json::from_value(reply)
    }
}

/// A reply as it is written: one of the three is there. Other fields are nobody's.
#[derive(Deserialize)]
struct Fields {
    seq: u64,
    result: Option<Map<String, Value>>,
    reject: Option<String>,
    unsupported: Option<String>,
}

impl TryFrom<Fields> for Reply {
    type Error = &'static str;

    fn try_from(Fields { seq, result, reject, unsupported }: Fields) -> Result<Self, Self::Error> {
        let answer = match (result, reject, unsupported) {
            (Some(result), None, None) => Answer::Result(result),
            (None, Some(code), None) => Answer::Reject(code),
            (None, None, Some(why)) => Answer::Unsupported(why),
            _ => return Err("expected one of result, reject and unsupported"),
        };
        Ok(Self { seq, answer })
    }
}

/// What is answered to a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// The result.
    Result(Map<String, Value>),
    /// The input is rejected, with a code.
    Reject(String),
    /// It is not answered, and why.
    Unsupported(String),
}

impl Answer {
    /// A result of these fields.
    pub(super) fn of<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Self {
        Self::Result(object(fields))
    }
}

/// Whoever answers cases.
pub trait Implementation {
    /// What it is and has.
    fn hello(&self) -> Hello;

    /// Answers a case.
    fn answer(&mut self, level: Level, profile: &str, input: &Map<String, Value>) -> Answer;
}

/// Answers a runner until it says `bye` or goes away: a conformance adapter is `serve(&mut mine, stdin, stdout)`.
///
/// # Errors
/// A line that is not of the protocol or longer than 64 MiB, or a reader or writer that fails.
pub fn serve(
    implementation: &mut impl Implementation,
    mut input: impl BufRead,
    mut output: impl Write,
) -> io::Result<()> {
    while let Some(line) = read_line(&mut input)? {
        let text = match serde_json::from_str(&line).map_err(io::Error::other)? {
            Request::Hello { .. } => serde_json::to_string(&implementation.hello()),
            Request::Case { seq, level, profile, input } => {
                serde_json::to_string(&Reply { seq, answer: implementation.answer(level, &profile, &input) })
            }
            Request::Bye => break,
        };
        writeln!(output, "{}", text.map_err(io::Error::other)?)?;
        output.flush()?;
    }
    Ok(())
}

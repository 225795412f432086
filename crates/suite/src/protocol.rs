//! The protocol: one JSON object per line, for requests of the runner and replies of the implementation.

use std::io::{self, BufRead, Write};

use serde::de::Error as _;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::text::{object, parse_json, read_line};
use super::{Feature, Level, Profile, SuiteCase};

/// Version of the protocol.
pub const PROTOCOL: u32 = 1;

/// A request of the runner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "cmd", rename_all = "kebab-case")]
pub(super) enum Request {
    Hello { protocol: u32 },
    Case { seq: u64, level: Level, profile: String, input: Map<String, Value> },
    Bye,
}

/// The declarations of an implementation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// Version of the protocol.
    pub protocol: u32,
    /// Its name.
    pub name: String,
    /// Its version.
    #[serde(default)]
    pub version: String,
    /// The supported profiles, as `level/profile`.
    pub profiles: Vec<String>,
    /// The supported features.
    #[serde(default)]
    pub features: Vec<Feature>,
    /// The limits of the supported trees.
    #[serde(default)]
    pub limits: Limits,
}

impl Hello {
    /// Parses a line in the format of `schema/hello.json`.
    pub(super) fn parse(line: &str) -> serde_json::Result<Self> {
        let hello = parse_json(line)?;
        let limits = hello.get("limits");
        let wide = limits.and_then(|limits| limits.get("wide"));
        let objects: Option<Vec<_>> =
            [Some(&hello), limits, wide].into_iter().flatten().map(Value::as_object).collect();
        // The schema excludes null, but optional fields accept it.
        if objects.is_none_or(|objects| objects[1..].iter().any(|limits| limits.values().any(Value::is_null))) {
            return Err(serde_json::Error::custom("expected objects, and whole numbers as limits"));
        }
        serde_json::from_value(hello)
    }

    /// Returns whether the implementation supports a case: it has declared the profile, the features and the number of
    /// slots.
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
    /// Limits of wide trees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wide: Option<WideLimits>,
}

/// The greatest level of an inner node, by the number of slots. Trees with other numbers of slots are not supported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WideLimits {
    /// Trees with 2 slots.
    #[serde(default, rename = "2", skip_serializing_if = "Option::is_none")]
    pub of_2: Option<u32>,
    /// Trees with 4 slots.
    #[serde(default, rename = "4", skip_serializing_if = "Option::is_none")]
    pub of_4: Option<u32>,
    /// Trees with 8 slots.
    #[serde(default, rename = "8", skip_serializing_if = "Option::is_none")]
    pub of_8: Option<u32>,
}

impl WideLimits {
    /// Returns the limit for a number of slots.
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
    /// The number of the case.
    pub seq: u64,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
}

impl Reply {
    /// Parses a line in the format of `schema/reply.json`.
    pub(super) fn parse(line: &str) -> serde_json::Result<Self> {
        let reply = parse_json(line)?;
        if !reply.is_object() {
            return Err(serde_json::Error::custom("expected an object"));
        }
        serde_json::from_value(reply)
    }
}

/// A reply in JSON. Exactly one of the three answers is present, and no other fields.
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

/// The answer to a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// The result.
    Result(Map<String, Value>),
    /// The input is rejected, with a code.
    Reject(String),
    /// The case is not supported, with the reason.
    Unsupported(String),
}

impl Answer {
    /// Builds a result with these fields.
    pub(super) fn of<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Self {
        Self::Result(object(fields))
    }
}

/// An implementation that answers cases.
pub trait Implementation {
    /// Returns its declarations.
    fn hello(&self) -> Hello;

    /// Answers a case.
    fn answer(&mut self, level: Level, profile: &str, input: &Map<String, Value>) -> Answer;
}

/// Answers a runner until it sends `bye` or closes the input. A conformance adapter is `serve(&mut mine, stdin,
/// stdout)`.
///
/// # Errors
/// A line that violates the protocol or is longer than 64 MiB, or a reader or writer that fails.
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

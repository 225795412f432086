//! Cases, and files of them.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use stackless_bvh::name::named;

/// Version of the suite, as in `spec/suite/VERSION`.
pub const VERSION: &str = "2.1.0";

/// The subject of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// Bit functions of keys, trails and counters.
    Key,
    /// The perfect hash.
    Hash,
    /// Traversals of trees, without geometry.
    Trace,
    /// Traversals that resume from a state.
    Resume,
    /// Rays and triangles.
    Ray,
}

impl Level {
    /// All levels.
    pub const ALL: [Self; 5] = [Self::Key, Self::Hash, Self::Trace, Self::Resume, Self::Ray];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Key => "key",
            Self::Hash => "hash",
            Self::Trace => "trace",
            Self::Resume => "resume",
            Self::Ray => "ray",
        }
    }
}

named!(Level);

/// Optional features of an implementation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// Reports the trail at each visit.
    Trails,
    /// Reports J's counter at each visit.
    Counters,
    /// Reports the register at each visit.
    Registers,
    /// Decides once, at the visit, even if decisions change: it never repeats a query on its way down from the root.
    Changing,
    /// Reports the weights of a hit.
    Weights,
}

impl Feature {
    /// All features.
    pub const ALL: [Self; 5] = [Self::Trails, Self::Counters, Self::Registers, Self::Changing, Self::Weights];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trails => "trails",
            Self::Counters => "counters",
            Self::Registers => "registers",
            Self::Changing => "changing",
            Self::Weights => "weights",
        }
    }

    /// Returns a description.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Trails => "gives the trail at each visit",
            Self::Counters => "gives J's counter at each visit",
            Self::Registers => "gives the register of the most recently postponed node at each visit",
            Self::Changing => {
                "decides once, at the visit, also where decisions change: never asks again on the way down from \
                 the root"
            }
            Self::Weights => "gives the weights of a hit",
        }
    }
}

named!(Feature);

/// The strength of a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strength {
    /// Required for conformance.
    Must,
    /// Recommended.
    May,
}

/// A case. Its input is an [`Ask`](super::Ask).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SuiteCase {
    /// The permanent id: `level/profile/name`.
    pub id: String,
    /// The clauses that it tests.
    pub clauses: Vec<String>,
    /// The strength of the requirement.
    pub strength: Strength,
    /// The required features.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<Feature>,
    /// The reason for the case, in one line.
    pub why: String,
    /// The input.
    pub input: Map<String, Value>,
    /// The expected answer.
    pub expect: Expect,
}

impl SuiteCase {
    /// Returns the size: the number of elements of all lists of its input. Files are not sorted by size.
    pub fn size(&self) -> usize {
        fn elements(value: &Value) -> usize {
            match value {
                Value::Array(list) => list.len() + list.iter().map(elements).sum::<usize>(),
                _ => 0,
            }
        }
        self.input.values().map(elements).sum()
    }
}

/// An expected answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Expect {
    /// This result.
    Result(Map<String, Value>),
    /// A rejection with this code.
    Reject(String),
    /// Closest hits, with a tolerance of the distances.
    Near(Near),
    /// Any valid answer.
    Valid(bool),
}

/// Closest hits with a tolerance for rounding.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Near {
    /// The tolerance of distances, in ulps.
    pub ulps: u32,
    /// The hit of each ray.
    pub hits: Vec<Option<NearHit>>,
}

/// A hit at this distance, of any of these triangles.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearHit {
    /// The bits of the distance, rounded once.
    pub t: String,
    /// The accepted triangles.
    pub prims: Vec<u32>,
}

/// The cases of one file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Version of the suite.
    pub suite: String,
    /// The level of its cases.
    pub level: Level,
    /// The name within the level.
    pub profile: String,
    /// The cases.
    pub cases: Vec<SuiteCase>,
}

impl Profile {
    /// Returns `level/profile`.
    pub fn name(&self) -> String {
        format!("{}/{}", self.level, self.profile)
    }
}

/// All cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Suite {
    /// Files, in order.
    pub profiles: Vec<Profile>,
}

impl Suite {
    /// Returns each case with its profile.
    pub fn cases(&self) -> impl Iterator<Item = (&Profile, &SuiteCase)> {
        self.profiles.iter().flat_map(|profile| profile.cases.iter().map(move |case| (profile, case)))
    }
}

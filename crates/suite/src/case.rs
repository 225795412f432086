//! Cases, and files of them.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use stackless_bvh::name::named;

/// Version of the suite, as in `spec/suite/VERSION`.
pub const VERSION: &str = "2.1.0";

/// What a case is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// Bit functions of keys, trails and counters.
    Key,
    /// The perfect hash.
    Hash,
    /// Traversals of trees, without geometry.
    Trace,
    /// Traversals that are taken up from a state.
    Resume,
    /// Rays and triangles.
    Ray,
}

impl Level {
    /// All levels.
    pub const ALL: [Self; 5] = [Self::Key, Self::Hash, Self::Trace, Self::Resume, Self::Ray];

    /// The name.
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

/// What an implementation may have beyond its profiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// It gives the trail at each visit.
    Trails,
    /// It gives J's counter at each visit.
    Counters,
    /// It gives the register at each visit.
    Registers,
    /// It decides once, at the visit, also where decisions change: it never asks again on its way down from the root.
    Changing,
    /// It gives the weights of a hit.
    Weights,
}

impl Feature {
    /// All features.
    pub const ALL: [Self; 5] = [Self::Trails, Self::Counters, Self::Registers, Self::Changing, Self::Weights];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trails => "trails",
            Self::Counters => "counters",
            Self::Registers => "registers",
            Self::Changing => "changing",
            Self::Weights => "weights",
        }
    }

    /// What it means.
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

/// How much a case weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strength {
    /// Who fails it does not conform.
    Must,
    /// It is advised.
    May,
}

/// A case. Its input is an [`Ask`](super::Ask).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SuiteCase {
    /// Permanent: `level/profile/name`.
    pub id: String,
    /// What it is about.
    pub clauses: Vec<String>,
    /// How much it weighs.
    pub strength: Strength,
    /// What it needs beyond its profile.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<Feature>,
    /// One line.
    pub why: String,
    /// What is asked.
    pub input: Map<String, Value>,
    /// What is to be answered.
    pub expect: Expect,
}

impl SuiteCase {
    /// How much there is to look at: the elements of all lists of its input. Files are not in this order.
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

/// What is to be answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Expect {
    /// This.
    Result(Map<String, Value>),
    /// A rejection with this code.
    Reject(String),
    /// Closest hits whose distances may be off a little.
    Near(Near),
    /// Anything that is right.
    Valid(bool),
}

/// Closest hits as far as rounding leaves them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Near {
    /// How many floats a distance may be off.
    pub ulps: u32,
    /// Of each ray.
    pub hits: Vec<Option<NearHit>>,
}

/// A hit of which any triangle will do that is at this distance.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearHit {
    /// The bits of the distance, rounded once.
    pub t: String,
    /// Triangles.
    pub prims: Vec<u32>,
}

/// The cases of one file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Version of the suite.
    pub suite: String,
    /// What its cases are about.
    pub level: Level,
    /// Its name, within the level.
    pub profile: String,
    /// The cases.
    pub cases: Vec<SuiteCase>,
}

impl Profile {
    /// `level/profile`.
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
    /// Each case with its profile.
    pub fn cases(&self) -> impl Iterator<Item = (&Profile, &SuiteCase)> {
        self.profiles.iter().flat_map(|profile| profile.cases.iter().map(move |case| (profile, case)))
    }
}

//! The inputs of cases.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use stackless_bvh::generate::Cell;

/// The children of each node, `null` for a leaf; node 0 is the root.
pub type Children = Vec<Option<[u32; 2]>>;

/// The children of each node of a wide tree, from slot 0 on.
pub type WideChildren = Vec<Option<Vec<u32>>>;

/// An operation with its input. `spec/suite/INTERPRETING.md` defines the answers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "op", rename_all = "kebab-case", deny_unknown_fields)]
#[allow(missing_docs, reason = "spec/suite/INTERPRETING.md describes each field")]
pub enum Ask {
    Child { key: String, right: bool },
    Parent { key: String },
    Sibling { key: String },
    LevelStart { key: String },
    Depth { key: String },
    Descend { trail: String, both: bool },
    Levels { trail: String },
    Backtrack { key: String, trail: String },
    Counter { trail: String, depth: u32 },
    CounterLevels { counter: String, depth: u32 },
    Swap { index: String, mask: String },
    Cell { key: String, displacements: u32, cells: u32, displacement: u32 },
    Mix { key: String, seed: String, bits: u32 },
    Fold { key: String, seed: String },
    Encode { leaf: bool, index: u32 },
    Decode { word: String },
    HashedKeys { children: Children, reach: [u32; 2] },
    HashedKeysWide { slots: u32, children: WideChildren },
    Lookup(LookupTable),
    Build(Build),
    Trace(Walk),
    Resume(Walk),
    ResumeDisjoint(Walk),
    ResumeKey(Walk),
    TraceWide(WideWalk),
    ResumeWide(WideWalk),
    Ray(Rays),
}

impl Ask {
    /// Decodes the input of a case.
    ///
    /// # Errors
    /// An unknown operation, or a field that is missing, unknown or of another type.
    pub fn of(input: &Map<String, Value>) -> serde_json::Result<Self> {
        Self::deserialize(input)
    }
}

/// A table for lookups of keys.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "spec/suite/INTERPRETING.md describes each field")]
pub struct LookupTable {
    pub displacements: Vec<String>,
    pub cells: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bits: Option<u32>,
    pub keys: Vec<String>,
}

/// A tree for hashing keys.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "spec/suite/INTERPRETING.md describes each field")]
pub struct Build {
    pub children: Children,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reach: Option<[u32; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sizes: Option<[u32; 2]>,
}

/// A tree, a search, and its start.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "spec/suite/INTERPRETING.md describes each field")]
pub struct Walk {
    pub children: Children,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub script: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<Vec<Cell>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub any: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub octant: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trail: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub marks: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hit: Option<Best>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<Start>,
}

/// A wide tree, a search, and its start.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "spec/suite/INTERPRETING.md describes each field")]
pub struct WideWalk {
    pub slots: u32,
    pub children: WideChildren,
    pub ranks: Vec<Option<Vec<Option<u32>>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hits: Option<Vec<Option<u32>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub any: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sorted: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trail: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hit: Option<Best>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<Start>,
}

/// The best hit of a search over cells: its distance, and the number of the leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "said above")]
pub struct Best {
    pub t: u32,
    pub node: u32,
}

/// The first step after resuming a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// Visits its node.
    Visit,
    /// Backtracks from its node, a leaf.
    Backtrack,
}

/// Triangles and rays.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "spec/suite/INTERPRETING.md describes each field")]
pub struct Rays {
    pub vertices: Vec<String>,
    pub triangles: Vec<[u32; 3]>,
    pub rays: Vec<String>,
    pub query: Query,
}

/// The kind of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Query {
    /// The closest hit.
    Closest,
    /// Whether there is any hit.
    Any,
    /// The parity of the number of crossings.
    Parity,
}

//! Plans: the tracer for a query, and the parts that a query on a scene does not need.

mod choice;

pub use choice::{Choice, Need};

use crate::bvh::{BuildOptions, Bvh, Degenerate};
use crate::traverse::{Method, Test, WordName};
use crate::tree::Topology;

/// The kind of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QueryKind {
    /// Whether there is a hit.
    Any,
    /// Distance and triangle of the closest hit.
    Distance,
    /// The closest hit with its weights.
    Hit,
    /// All hits.
    All,
}

/// The parts of a hit that its plan requests
/// ([`BinaryTracer::partial_hits_each`](super::BinaryTracer::partial_hits_each)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartialHit<R = f32> {
    /// Index of the triangle in the mesh; for any-hit queries, of the triangle met first.
    pub prim: u32,
    /// Distance along the ray, unless omitted.
    pub t: Option<R>,
    /// Weights of the triangle's second and third corner, unless omitted.
    pub weights: Option<[R; 2]>,
}

/// A part that takes time or memory, and that not every query on every scene needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// Keys of 128 bits.
    LongKeys,
    /// Tables of other traversals than the selected one: parents, uncles, all keys, skip pointers, the implicit layout.
    OtherTables,
    /// The second trail, which lets a hit prune the nodes behind it.
    SecondTrail,
    /// Each node's own box, in addition to the pair in its parent.
    OwnBoxes,
    /// Distance and weights of a hit, if the caller does not need them.
    Weights,
    /// Triangles that no ray can meet.
    Degenerate,
    /// The detection of triangles that are met again in another leaf.
    Repeats,
}

impl Part {
    /// All parts.
    pub const ALL: [Self; 7] = [
        Self::LongKeys,
        Self::OtherTables,
        Self::SecondTrail,
        Self::OwnBoxes,
        Self::Weights,
        Self::Degenerate,
        Self::Repeats,
    ];

    /// Returns the name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::LongKeys => "keys of 128 bits",
            Self::OtherTables => "tables of other traversals",
            Self::SecondTrail => "second trail",
            Self::OwnBoxes => "own boxes",
            Self::Weights => "weights",
            Self::Degenerate => "degenerate triangles",
            Self::Repeats => "watch for repeats",
        }
    }
}

/// Whether a part is omitted, and the reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decision {
    /// The part.
    pub part: Part,
    /// Whether it is omitted.
    pub skipped: bool,
    /// The reason, in words with the figures of the scene.
    pub reason: String,
}

/// The parts that queries of a kind need on a binary hierarchy, and the parts that they omit. [`Choice`] decides
/// whether to use a binary hierarchy. The plan does not change the answers.
///
/// ```
/// use stackless_bvh::bvh::{Bvh, SahOptions};
/// use stackless_bvh::generate::procedural;
/// use stackless_bvh::trace::{QueryKind, Part, Plan};
/// use stackless_bvh::traverse::Method;
///
/// let bvh = Bvh::sah(&procedural::strands(1, 100), SahOptions::default())?;
/// let plan = Plan::new(&bvh, Method::Hashed, QueryKind::Any);
/// assert!(plan.skips(Part::LongKeys) && plan.skips(Part::Weights));
/// for decision in plan.decisions() {
///     println!("{}: {}", decision.part.name(), decision.reason);
/// }
/// # Ok::<(), stackless_bvh::bvh::BuildError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    method: Method,
    word: WordName,
    ask: QueryKind,
    decisions: Vec<Decision>,
}

impl Plan {
    /// Creates a plan from one pass over a hierarchy.
    pub fn new<S>(bvh: &Bvh<S>, method: Method, ask: QueryKind) -> Self {
        let word = WordName::narrowest(bvh.depth());
        let decisions: Vec<_> = Part::ALL.map(|part| decide(part, bvh, method, ask)).into();
        let prunes_for_nothing = method.test() == Test::Disjoint && matches!(ask, QueryKind::Any | QueryKind::All);
        let method = if prunes_for_nothing { method.without_pruning() } else { method };
        Self { method, word, ask, decisions }
    }

    /// Returns this plan with an omitted part restored, to measure its cost.
    #[must_use]
    pub fn with(mut self, part: Part) -> Self {
        for decision in &mut self.decisions {
            decision.skipped &= decision.part != part;
        }
        if part == Part::LongKeys && self.word != WordName::Grow {
            self.word = WordName::U128;
        }
        if part == Part::SecondTrail {
            self.method = self.method.with_second_trail().unwrap_or(self.method);
        }
        self
    }

    /// Returns this plan with no part omitted.
    #[must_use]
    pub fn with_everything(self) -> Self {
        Part::ALL.into_iter().fold(self, Self::with)
    }

    /// Returns the decisions, in the order of [`Part::ALL`].
    pub fn decisions(&self) -> &[Decision] {
        &self.decisions
    }

    /// Returns whether a part is omitted.
    pub fn skips(&self, part: Part) -> bool {
        self.decisions.iter().any(|decision| decision.part == part && decision.skipped)
    }

    /// Returns options with the plan's decision on triangles that no ray can meet: the builder omits them.
    pub fn options(&self, options: BuildOptions) -> BuildOptions {
        let degenerate = if self.skips(Part::Degenerate) { Degenerate::LeftOut } else { Degenerate::Kept };
        BuildOptions { degenerate, ..options }
    }

    /// Returns the kind of query.
    pub fn ask(&self) -> QueryKind {
        self.ask
    }

    /// Returns the traversal.
    pub fn method(&self) -> Method {
        self.method
    }

    /// Returns the word of the keys.
    pub fn word(&self) -> WordName {
        self.word
    }
}

fn decide<S>(part: Part, bvh: &Bvh<S>, method: Method, ask: QueryKind) -> Decision {
    let depth = bvh.depth();
    let (skipped, reason) = match part {
        Part::LongKeys => match WordName::narrowest(depth) {
            word @ (WordName::U32 | WordName::U64) => (true, format!("{depth} levels fit in {word}")),
            word => (false, format!("{depth} levels need {word}")),
        },
        Part::OtherTables => (true, format!("{method} alone runs")),
        Part::SecondTrail => match (method.test(), ask) {
            (Test::Disjoint, QueryKind::Distance | QueryKind::Hit) => (false, format!("{method} prunes by it")),
            (_, QueryKind::Any) => (true, "the first hit ends the search".to_owned()),
            (_, QueryKind::All) => (true, "a hit ends nothing".to_owned()),
            _ => (true, format!("{method} visits what a hit has left behind, and turns back there")),
        },
        Part::OwnBoxes => match method.test() {
            Test::Disjoint if bvh.duplicates() > 0 => {
                (false, format!("{method} asks whether hits are in their leaves' boxes"))
            }
            Test::Children | Test::Disjoint | Test::Distance => {
                (true, format!("{method} tests both children at their parent"))
            }
            Test::NodeLeftFirst | Test::NodeBySign => (false, format!("{method} tests each node at its visit")),
        },
        Part::Weights => match ask {
            QueryKind::Any => (true, "whether there is a hit takes no division".to_owned()),
            QueryKind::Distance => (true, "nobody asks for them".to_owned()),
            QueryKind::Hit | QueryKind::All => (false, "they are asked for".to_owned()),
        },
        Part::Degenerate => match bvh.dropped() {
            0 => (false, "none is left out of the hierarchy".to_owned()),
            dropped => (true, format!("{dropped} triangles have no area")),
        },
        Part::Repeats => match (bvh.duplicates(), ask) {
            (0, _) => (true, "each triangle is in one leaf".to_owned()),
            (_, QueryKind::All) => (false, format!("{} references are to triangles of other leaves", bvh.duplicates())),
            _ => (true, "a second meeting changes nothing".to_owned()),
        },
    };
    Decision { part, skipped, reason }
}

#[cfg(test)]
mod tests;

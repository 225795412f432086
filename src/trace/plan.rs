//! Plans: the tracer for a query, and the parts that a query on a scene does not need.

mod choice;

pub use choice::{Choice, Need};

use crate::bvh::{BuildOptions, Bvh, Degenerate, WideBvh};
use crate::geom::Region;
use crate::geom::lanes::Precision;
use crate::traverse::{Method, Test, WordName};
use crate::tree::Topology;
use crate::wide;

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

/// One row each: the name in tables, and a description.
macro_rules! parts {
    ($($variant:ident: $name:literal, $help:literal;)*) => {
        /// A part that takes time or memory, and that not every query on every scene needs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Part {
            $(#[doc = $help] $variant,)*
        }

        impl Part {
            /// All parts.
            pub const ALL: [Self; [$(Self::$variant),*].len()] = [$(Self::$variant),*];

            /// Returns the name in tables.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }
        }
    };
}
parts! {
    LongKeys: "keys of 128 bits", "Keys of 128 bits, in binary hierarchies.";
    SecondTrail: "second trail", "The second trail, which lets a hit prune the nodes behind it, in binary hierarchies.";
    OwnBoxes: "own boxes", "Each node's own box, in addition to the pair in its parent, in binary hierarchies.";
    Hash: "perfect hash", "The perfect hash of the keys of ancestors.";
    Weights: "weights", "Distance and weights of a hit, if the caller does not need them.";
    Degenerate: "degenerate triangles", "Triangles that no ray can meet.";
    Repeats: "watch for repeats", "The detection of triangles that are met again in another leaf.";
    ExactTests: "exact tests of all", "The exact test of each triangle, without the filter, in wide hierarchies.";
    Entries: "entries of all rays", "Box tests from the entry of a ray into the scene, in wide hierarchies.";
}

/// Whether a part is omitted, and the reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decision {
    /// The part.
    pub part: Part,
    /// Whether it is omitted.
    pub skipped: bool,
    /// Whether it could be omitted, and is [restored](Plan::with) to measure its cost.
    pub restored: bool,
    /// The reason, in words with the figures of the scene.
    pub reason: String,
}

/// The parts that queries of a kind need on a hierarchy, and the parts that they omit. [`Tracer::plan`] has the plan of
/// the default tracer; [`Choice`] decides which tracer to use.
///
/// Each tracer decides as its plan does, and obeys restored parts. The plan does not change the answers.
///
/// ```
/// use stackless_bvh::generate::procedural;
/// use stackless_bvh::trace::{Part, QueryKind, Tracer};
///
/// let tracer = Tracer::of(&procedural::strands(1, 100))?;
/// let plan = tracer.plan(QueryKind::Any);
/// assert!(plan.skips(Part::Hash) && plan.skips(Part::Weights));
/// for decision in plan.decisions() {
///     println!("{}: {}", decision.part.name(), decision.reason);
/// }
/// # Ok::<(), stackless_bvh::bvh::WideError>(())
/// ```
///
/// [`Tracer::plan`]: super::Tracer::plan
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    decisions: Vec<Decision>,
}

/// Whether a part is omitted, and the reason.
type Verdict = (bool, String);

impl Plan {
    /// Creates the plan of a [`BinaryTracer`](super::BinaryTracer).
    pub fn new<S>(bvh: &Bvh<S>, method: Method, ask: QueryKind) -> Self {
        Self::of(|part| match part {
            Part::LongKeys => Some(long_keys(bvh.depth())),
            Part::SecondTrail => Some(second_trail(method, ask)),
            Part::OwnBoxes => Some(own_boxes(method, bvh.duplicates())),
            Part::Hash => Some(hash(method.name(), method.needs_hash())),
            _ => common(part, ask, bvh.dropped(), bvh.duplicates()),
        })
    }

    /// Creates the plan of a [`Tracer`](super::Tracer).
    pub fn wide<V: Precision>(bvh: &WideBvh<8, V>, method: wide::Method, ask: QueryKind) -> Self {
        let (region, dropped, duplicates) = (bvh.region(), bvh.dropped(), bvh.duplicates());
        Self::of(|part| match part {
            Part::Hash => Some(hash(method.name(), method.needs_hash())),
            Part::ExactTests => Some(range(V::can_filter(region), region, "the filter")),
            Part::Entries => Some(range(V::has_near_rays(region), region, "box tests from the origins of near rays")),
            _ => common(part, ask, dropped, duplicates),
        })
    }

    fn of(decide: impl Fn(Part) -> Option<Verdict>) -> Self {
        let decision = |part| decide(part).map(|(skipped, reason)| Decision { part, skipped, restored: false, reason });
        Self { decisions: Part::ALL.into_iter().filter_map(decision).collect() }
    }

    /// Returns this plan with an omitted part restored, to measure its cost.
    #[must_use]
    pub fn with(mut self, part: Part) -> Self {
        for decision in self.decisions.iter_mut().filter(|decision| decision.part == part && decision.skipped) {
            (decision.skipped, decision.restored) = (false, true);
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

    /// Returns whether a part could be omitted, and is restored.
    pub fn restores(&self, part: Part) -> bool {
        self.decisions.iter().any(|decision| decision.part == part && decision.restored)
    }

    /// Returns options with the plan's decision on triangles that no ray can meet: the builder omits them.
    pub fn options(&self, options: BuildOptions) -> BuildOptions {
        let degenerate = if self.skips(Part::Degenerate) { Degenerate::LeftOut } else { Degenerate::Kept };
        BuildOptions { degenerate, ..options }
    }

    /// Returns a hierarchy with the restored parts that are properties of its region:
    /// [`ExactTests`](Part::ExactTests) and [`Entries`](Part::Entries).
    #[must_use]
    pub fn on<V: Precision>(&self, mut bvh: WideBvh<8, V>) -> WideBvh<8, V> {
        if self.restores(Part::ExactTests) {
            bvh.map_region(|region| region.reaching(2.0 * V::MOST_OFF));
        }
        if self.restores(Part::Entries) {
            bvh.map_region(Region::without_near_rays);
        }
        bvh
    }
}

fn long_keys(depth: u32) -> Verdict {
    match WordName::narrowest(depth) {
        word @ (WordName::U32 | WordName::U64) => (true, format!("{depth} levels fit in {word}")),
        word => (false, format!("{depth} levels need {word}")),
    }
}

fn second_trail(method: Method, ask: QueryKind) -> Verdict {
    match (method.test(), ask) {
        (Test::Disjoint, QueryKind::Distance | QueryKind::Hit) => (false, format!("{method} prunes by it")),
        (_, QueryKind::Any) => (true, "the first hit ends the search".to_owned()),
        (_, QueryKind::All) => (true, "a hit ends nothing".to_owned()),
        _ => (true, format!("{method} visits the nodes behind a hit, and turns back there")),
    }
}

fn own_boxes(method: Method, duplicates: usize) -> Verdict {
    match method.test() {
        Test::Disjoint if duplicates > 0 => (false, format!("{method} asks whether hits are in their leaves' boxes")),
        Test::Children | Test::Disjoint | Test::Distance => {
            (true, format!("{method} tests both children at their parent"))
        }
        Test::NodeLeftFirst | Test::NodeBySign => (false, format!("{method} tests each node at its visit")),
    }
}

fn hash(method: &str, is_needed: bool) -> Verdict {
    (!is_needed, format!("{method} {} ancestors by their keys", if is_needed { "finds" } else { "does not find" }))
}

/// Decides on an exception for scenes that are too large or too small.
fn range(is_usual: bool, region: &Region, what: &str) -> Verdict {
    let verb = if is_usual { "allow" } else { "do not allow" };
    (is_usual, format!("coordinates up to {:.1e} {verb} {what}", region.reach()))
}

/// Decides on parts of all tracers.
fn common(part: Part, ask: QueryKind, dropped: usize, duplicates: usize) -> Option<Verdict> {
    Some(match part {
        Part::Weights => match ask {
            QueryKind::Any => (true, "whether there is a hit takes no division".to_owned()),
            QueryKind::Distance => (true, "nobody asks for them".to_owned()),
            QueryKind::Hit | QueryKind::All => (false, "they are asked for".to_owned()),
        },
        Part::Degenerate => match dropped {
            0 => (false, "none is left out of the hierarchy".to_owned()),
            dropped => (true, format!("{dropped} triangles have no area")),
        },
        Part::Repeats => match (duplicates, ask) {
            (0, _) => (true, "each triangle is in one leaf".to_owned()),
            (_, QueryKind::All) => (false, format!("{duplicates} references are to triangles of other leaves")),
            _ => (true, "a second meeting changes nothing".to_owned()),
        },
        _ => return None,
    })
}

#[cfg(test)]
pub(super) mod tests;

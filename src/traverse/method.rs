//! The properties of traversals in the [table](super::Method).

use alloc::format;
use alloc::string::String;

use super::{Method, Unsupported, WordName};
use crate::key::{Grow, KeyWord};
use crate::order::Pruning;
use crate::tree::Recorded;

/// The tests of a traversal at a visit, and its order of the children. They determine its oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// Both children at their parent's visit, in any order.
    Children,
    /// As `Children`; postponed nodes that are disjoint from the found candidate are skipped. `[ORACLE-2]`
    Disjoint,
    /// As `Children`; postponed nodes that begin beyond the end of the search are skipped. `[ORACLE-3]`
    Distance,
    /// The node itself at its visit; left before right.
    NodeLeftFirst,
    /// The node itself at its visit; the near child by the sign of the ray's direction first.
    NodeBySign,
}

impl Test {
    /// All tests.
    pub const ALL: [Self; 5] = [Self::Children, Self::Disjoint, Self::Distance, Self::NodeLeftFirst, Self::NodeBySign];

    /// Returns the pruning of postponed nodes.
    pub const fn pruning(self) -> Pruning {
        match self {
            Self::Disjoint => Pruning::Disjoint,
            Self::Distance => Pruning::Distance,
            _ => Pruning::Never,
        }
    }
}

/// The tables that a traversal needs, in addition to the tree and its links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Nothing.
    Nothing,
    /// A perfect hash of the keys that records do not reach. `[HASH-3]`
    ReachedKeys,
    /// A perfect hash of all keys.
    AllKeys,
    /// The implicit layout, or a map instead.
    Layout,
    /// The addresses of a complete tree.
    Complete,
    /// A table of all keys, with chains.
    Chains,
    /// Skip pointers, left before right.
    Skips,
    /// Skip pointers for each octant of directions.
    SkipsBySign,
}

impl Need {
    /// Returns a short description.
    const fn text(self) -> &'static str {
        match self {
            Self::Nothing => "",
            Self::ReachedKeys => "perfect hash of a sixth of the keys",
            Self::AllKeys => "perfect hash of all keys",
            Self::Layout => "implicit layout",
            Self::Complete => "a complete tree",
            Self::Chains => "chained table of all keys",
            Self::Skips => "skip pointers",
            Self::SkipsBySign => "eight sets of skip pointers",
        }
    }
}

/// The words in the state.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Words {
    /// None.
    None,
    /// Words of any type.
    Any,
    /// Words of a fixed width: aligned to a highest bit, which a growing word lacks.
    Fixed,
}

/// The capabilities of the cursor.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Takes decisions on both children at their parent.
    ByParent,
    /// As `ByParent`, with repeated queries on the way down from the root.
    Restarting,
    /// As `ByParent`, and can be paused.
    Pausing,
    /// Takes tests of nodes at their visit, in a fixed order.
    ByNode,
}

/// A row of the table.
pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) by: &'static str,
    pub(super) clause: &'static str,
    pub(super) help: &'static str,
    pub(super) test: Test,
    pub(super) links: Recorded,
    pub(super) need: Need,
    pub(super) words: Words,
    pub(super) kind: Kind,
    pub(super) without: Method,
}

impl Default for Method {
    /// The ray tracer's default: it runs on any tree. `benches/README.md` has the reasons for the choice.
    fn default() -> Self {
        Self::Afra
    }
}

impl Method {
    /// Returns the name.
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// Returns the publication, with the section.
    pub const fn by(self) -> &'static str {
        self.row().by
    }

    /// Returns the clause of the specification that defines it.
    pub const fn clause(self) -> &'static str {
        self.row().clause
    }

    /// Returns a description in one sentence.
    pub const fn help(self) -> &'static str {
        self.row().help
    }

    /// Returns whether it finds nodes by a perfect hash of their keys.
    pub const fn needs_hash(self) -> bool {
        matches!(self.needs(), Need::ReachedKeys | Need::AllKeys)
    }

    /// Returns its test.
    pub const fn test(self) -> Test {
        self.row().test
    }

    /// Returns the links that it expects in the records, in addition to the children; without them it needs a separate
    /// table.
    pub const fn wants_recorded(self) -> Recorded {
        self.row().links
    }

    /// Returns the tables that it needs, in addition to the tree and its links.
    pub const fn needs(self) -> Need {
        self.row().need
    }

    /// Returns whether its state is of constant size and can be paused ([`Pause`](super::Pause)).
    pub const fn can_pause(self) -> bool {
        matches!(self.row().kind, Kind::Pausing)
    }

    /// Returns this traversal without pruning: for unordered searches.
    #[must_use]
    pub const fn without_pruning(self) -> Self {
        self.row().without
    }

    /// Returns this traversal with a second trail, if that exists.
    pub fn with_second_trail(self) -> Option<Self> {
        let prunes_as_this = |other: &Self| other.without_pruning() == self && *other != self && other.can_pause();
        Self::ALL.into_iter().find(prunes_as_this)
    }

    /// Returns whether it queries the visitor again on the way down from the root. Then its trace is the oracle's only
    /// if the answers do not change.
    pub const fn restarts(self) -> bool {
        matches!(self.row().kind, Kind::Restarting)
    }

    /// Returns whether its state has words, and so has several widths. Traversals without words run once.
    pub const fn has_words(self) -> bool {
        !matches!(self.row().words, Words::None)
    }

    /// Returns whether it exists for this word.
    pub fn exists_for<W: KeyWord>(self) -> bool {
        W::WIDTH.is_some() || self.row().words != Words::Fixed
    }

    pub(super) fn fits<W: KeyWord>(self) -> Result<(), Unsupported> {
        if self.exists_for::<W>() { Ok(()) } else { Err(Unsupported::NoSuchWord { word: W::NAME }) }
    }

    /// Computes [`state_bytes`](Self::state_bytes) for a word that is known only at run time.
    pub fn state_bytes_in(self, word: WordName, depth: u32) -> usize {
        match word {
            WordName::U32 => self.state_bytes::<u32>(depth),
            WordName::U64 => self.state_bytes::<u64>(depth),
            WordName::U128 => self.state_bytes::<u128>(depth),
            WordName::Grow => self.state_bytes::<Grow>(depth),
        }
    }

    /// Returns all traversals as a table in Markdown: the README's.
    pub fn markdown() -> String {
        let head = "| name | by | additional requirements | bytes of state, 32-bit keys |\n|---|---|---|---:|\n";
        Self::ALL.into_iter().fold(String::from(head), |table, method| table + &method.markdown_row())
    }

    fn markdown_row(self) -> String {
        let links = match self.wants_recorded() {
            Recorded::Nothing => "",
            Recorded::ParentSibling => "parent, sibling",
            Recorded::Uncles => "uncle, grand uncle",
        };
        let order = match self.test() {
            Test::Disjoint | Test::Distance => "children in the order of distance",
            Test::NodeBySign => "order by sign",
            Test::Children | Test::NodeLeftFirst => "",
        };
        let needs = [links, self.needs().text(), order].into_iter().filter(|need| !need.is_empty());
        let needs = needs.fold(String::new(), |all, need| if all.is_empty() { need.into() } else { all + "; " + need });
        let [bytes, deeper] = [0, 1].map(|depth| self.state_bytes::<u32>(depth));
        let a_level = if deeper > bytes { format!(" + {} a level", deeper - bytes) } else { String::new() };
        format!("| `{}` | {} | {needs} | {bytes}{a_level} |\n", self.name(), self.by())
    }
}

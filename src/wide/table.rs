//! The table of traversals of wide trees.

use super::keys::asked_keys;
use super::links::{Hashed, Parents, Recorded};
use super::pending::Pending;
use super::pending_store::{Ranked, Trail};
use super::restart::Restart;
use super::search::Search;
use super::stack::{Memory, Stack};
use super::tree::Topology;
use super::{Cursor, traverse};
use crate::event::Recorder;
use crate::hash::{BuildError, PerfectHash};
use crate::key::TooDeep;
use crate::name::named;

/// `state`: bytes by the slots of a node and the tree's levels.
macro_rules! traversals {
    ($($variant:ident {
        name: $name:literal, by: $by:literal, clause: $clause:literal,
        help: $help:literal,
        state: |$a:pat_param, $levels:pat_param| $state:expr,
    })*) => {
        /// A traversal of wide trees.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Method {
            $(#[doc = $help] $variant,)*
        }

        impl Method {
            /// All traversals, in the order of the tables.
            pub const ALL: [Self; [$(Self::$variant),*].len()] = [$(Self::$variant),*];

            /// Returns the name.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Returns the publication.
            pub const fn by(self) -> &'static str {
                match self { $(Self::$variant => $by,)* }
            }

            /// Returns the clause that defines it.
            pub const fn clause(self) -> &'static str {
                match self { $(Self::$variant => $clause,)* }
            }

            /// Returns a description in one or two sentences.
            pub const fn help(self) -> &'static str {
                match self { $(Self::$variant => $help,)* }
            }

            /// Returns the bytes of its state for one ray, in a tree of `A` children per node and this number of
            /// levels: 4 for each variable, 8 for a child with its rank. `[WIDE-20]`
            pub const fn state_bytes<const A: usize>(self, levels: usize) -> usize {
                match self { $(Self::$variant => { let ($a, $levels) = (A, levels); $state })* }
            }
        }

        named!(Method);
    };
}
traversals! {
    Stack {
        name: "wide-stack", by: "the textbook", clause: "WSTACK-1",
        help: "Pushes postponed children with their ranks, the greatest first.",
        state: |a, levels| 8 + 8 * ((a - 1) * (levels + 1) + 1),
    }
    Trail {
        name: "wide-trail", by: "after Áfra & Szirmay-Kalos 2014", clause: "WTRAIL-1",
        help: "A trail of pending sets; finds the ancestor by parents, and queries it again for the order.",
        state: |_, _| 4 + 4 + 16 + 8,
    }
    Recorded {
        name: "wide-record", by: "this project", clause: "WRECORD-1",
        help: "A pending set and the next two children for each level; the node's record names its ancestors.",
        state: |_, levels| 4 + 4 + 2 * 8 + Ranked::bytes(levels),
    }
    Hashed {
        name: "wide-hashed", by: "this project, after Binder & Keller 2016", clause: "WHASHED-1",
        help: "`wide-record` with a key; a perfect hash finds the ancestor.",
        state: |_, levels| 4 + 4 + 8 + 2 * 8 + Ranked::bytes(levels),
    }
    Restart0 {
        name: "wide-restart-0", by: "Vaidyanathan et al. 2019", clause: "WRESTART-1",
        help: "The number of the child for each level; restarts at the root to find the next child.",
        state: |_, _| 4 + 3 * 4 + 16,
    }
    Restart1 {
        name: "wide-restart-1", by: "Vaidyanathan et al. 2019", clause: "WRESTART-1",
        help: "The number of the child for each level, and a short stack.",
        state: |_, _| 4 + 3 * 4 + 16 + 8 + 16,
    }
    Restart2 {
        name: "wide-restart-2", by: "Vaidyanathan et al. 2019", clause: "WRESTART-1",
        help: "The number of the child for each level, and a short stack.",
        state: |_, _| 4 + 3 * 4 + 16 + 8 + 2 * 16,
    }
    Restart4 {
        name: "wide-restart-4", by: "Vaidyanathan et al. 2019", clause: "WRESTART-1",
        help: "The number of the child for each level, and a short stack.",
        state: |_, _| 4 + 3 * 4 + 16 + 8 + 4 * 16,
    }
    Restart8 {
        name: "wide-restart-8", by: "Vaidyanathan et al. 2019", clause: "WRESTART-1",
        help: "The number of the child for each level, and a short stack.",
        state: |_, _| 4 + 3 * 4 + 16 + 8 + 8 * 16,
    }
}

/// The fastest traversal that needs no memory except its state.
impl Default for Method {
    fn default() -> Self {
        Self::Recorded
    }
}

impl Method {
    /// Returns whether it needs the [hash](Tables::hash).
    pub const fn needs_hash(self) -> bool {
        matches!(self, Self::Hashed)
    }

    /// Returns whether it starts again at the root, and so needs ranks that do not decrease on the way down.
    /// `[WRESTART-1]`
    pub const fn restarts(self) -> bool {
        matches!(self, Self::Restart0 | Self::Restart1 | Self::Restart2 | Self::Restart4 | Self::Restart8)
    }

    /// Returns the number of entries of the short stack of a traversal that restarts.
    const fn short_stack(self) -> usize {
        match self {
            Self::Restart1 => 1,
            Self::Restart2 => 2,
            Self::Restart4 => 4,
            Self::Restart8 => 8,
            _ => 0,
        }
    }

    /// Calls a function with this traversal: the only conversion from a name to a cursor.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    #[inline(always)]
    pub fn dispatch<'t, const A: usize, T: Topology<A> + 't, X: Context<'t, A, T>>(
        self,
        context: X,
    ) -> Result<X::Output, Unsupported> {
        match self {
            Self::Stack => context.run(|from| Ok(Stack::new(from.tree, &mut from.memory.stack))),
            Self::Trail => context.run(|from| Ok(Pending::new(from.tree, Trail::<u128>::default(), Parents)?)),
            Self::Recorded => Self::recorded(context),
            Self::Hashed => context.run(|from| {
                let link = Hashed::new(from.tables.hash()?);
                Ok(Pending::new(from.tree, &mut from.memory.ranked, link)?)
            }),
            // One copy for all.
            Self::Restart0 | Self::Restart1 | Self::Restart2 | Self::Restart4 | Self::Restart8 => {
                context.run(|from| Ok(Restart::new(from.tree, self.short_stack())?))
            }
        }
    }

    /// Calls [`dispatch`](Self::dispatch) for [`Recorded`](Self::Recorded), without copies for other traversals.
    #[inline(always)]
    pub(crate) fn recorded<'t, const A: usize, T: Topology<A> + 't, X: Context<'t, A, T>>(
        context: X,
    ) -> Result<X::Output, Unsupported> {
        context.run(|from| Ok(Pending::new(from.tree, &mut from.memory.ranked, Recorded)?))
    }

    /// Runs a search to its end, with new memory.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    pub fn run<const A: usize, T: Topology<A>>(
        self,
        tree: &T,
        tables: &Tables,
        search: &mut impl Search<A>,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unsupported> {
        self.run_in(Supply { tree, tables, memory: &mut Scratch::default() }, search, recorder)
    }

    /// Runs a search as [`run`](Self::run) does, with memory that is reused between searches.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    pub fn run_in<const A: usize, T: Topology<A>>(
        self,
        from: Supply<'_, T>,
        search: &mut impl Search<A>,
        recorder: &mut impl Recorder,
    ) -> Result<(), Unsupported> {
        self.dispatch(Run { from, search, recorder })
    }
}

/// The source of a cursor.
#[derive(Debug)]
pub struct Supply<'t, T> {
    /// The tree.
    pub tree: &'t T,
    /// The tables of the tree.
    pub tables: &'t Tables,
    /// Memory of the cursor.
    pub memory: &'t mut Scratch,
}

/// A generic function of a traversal that is selected at run time: [`Method::dispatch`].
///
/// It receives the constructor of the cursor, so it can make several.
pub trait Context<'t, const A: usize, T: 't> {
    /// The result.
    type Output;

    /// Calls the function.
    ///
    /// # Errors
    /// Those of `start`.
    fn run<C: Cursor<A>>(
        self,
        start: impl Fn(Supply<'t, T>) -> Result<C, Unsupported>,
    ) -> Result<Self::Output, Unsupported>;
}

struct Run<'t, 'a, T, S, R> {
    from: Supply<'t, T>,
    search: &'a mut S,
    recorder: &'a mut R,
}

impl<'t, const A: usize, T: Topology<A>, S: Search<A>, R: Recorder> Context<'t, A, T> for Run<'t, '_, T, S, R> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<A>>(self, start: impl Fn(Supply<'t, T>) -> Result<C, Unsupported>) -> Result<(), Unsupported> {
        let tree = self.from.tree;
        traverse(tree, start(self.from)?, self.search, self.recorder);
        Ok(())
    }
}

/// Tables of traversals, in addition to a tree.
#[derive(Clone, Debug)]
pub struct Tables {
    hash: Result<PerfectHash, Unsupported>,
}

impl Tables {
    /// No tables: [`Method::Hashed`] is unsupported.
    pub const NONE: Self = Self { hash: Err(Unsupported::NoTable) };

    /// Builds the tables of a tree.
    pub fn new<const A: usize>(tree: &impl Topology<A>) -> Self {
        let limit = (u64::BITS - 1) / A.trailing_zeros();
        let levels = tree.levels();
        if levels > limit {
            return Self { hash: Err(TooDeep { depth: levels, limit, word: "a key of 64 bits" }.into()) };
        }
        Self { hash: PerfectHash::of_keys(&asked_keys(tree)).map_err(Unsupported::NoHash) }
    }

    /// Builds the tables that one traversal needs.
    pub fn of<const A: usize>(method: Method, tree: &impl Topology<A>) -> Self {
        if method.needs_hash() { Self::new(tree) } else { Self::NONE }
    }

    /// Returns the perfect hash of the keys that a traversal can look up. `[WIDE-16]`
    ///
    /// # Errors
    /// [`Unsupported`] if there is none.
    #[inline(always)]
    pub fn hash(&self) -> Result<&PerfectHash, Unsupported> {
        self.hash.as_ref().map_err(|unfit| *unfit)
    }

    /// Returns the bytes of the tables.
    pub fn bytes(&self) -> usize {
        self.hash.as_ref().map_or(0, |hash| hash.header().bytes())
    }
}

/// The reason why a traversal does not support a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsupported {
    /// The tree has too many levels.
    TooDeep(TooDeep),
    /// The table of keys is missing.
    NoTable,
    /// The perfect hash cannot be built.
    NoHash(BuildError),
}

impl From<TooDeep> for Unsupported {
    fn from(error: TooDeep) -> Self {
        Self::TooDeep(error)
    }
}

impl core::fmt::Display for Unsupported {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooDeep(TooDeep { depth, limit, word }) => {
                write!(f, "inner nodes reach level {depth}, and {word} carries {limit} levels")
            }
            Self::NoTable => f.write_str("the table of keys was not made"),
            Self::NoHash(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Unsupported {}

/// Memory that traversals reuse one after the other.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    stack: Memory,
    ranked: Ranked,
}

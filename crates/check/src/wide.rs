//! Checks of wide-tree traversals against their oracle.

use std::fmt;

use stackless_bvh::event::{Recorder, State, Trace};
use stackless_bvh::generate::{Source, WideSearch, WideTape, wide_shape, wide_tree};
use stackless_bvh::hash::PerfectHash;
use stackless_bvh::internals::wide::{Context, Ranked, Scratch, StateView, Supply};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::Flow;
use stackless_bvh::tree::Node;
use stackless_bvh::wide;
use stackless_bvh::wide::{
    Cursor, Hashed, Link, Method, Next, Parents, Pending, PendingStore, Recorded, Tables, Topology, Trail, Tree,
    Unsupported, Wanted, oracle,
};

/// A wide tree and a search through it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WideCase<const A: usize> {
    /// The tree.
    pub tree: Tree<A>,
    /// The answers of the search.
    pub tape: WideTape<A>,
    /// Whether children are ordered by rank instead of leaves first.
    pub is_sorted: bool,
}

/// A traversal that visits other nodes than the oracle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WideFault {
    /// The traversal.
    pub traversal: String,
    /// Number of the first visit that differs.
    pub visit: usize,
    /// The oracle's node, or `None` after its end.
    pub expected: Option<Node>,
    /// The traversal's node, or `None` after its end.
    pub found: Option<Node>,
}

impl fmt::Display for WideFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { traversal, visit, expected, found } = self;
        write!(f, "{traversal}: visit {visit} is of {found:?}, expected {expected:?}")
    }
}

impl std::error::Error for WideFault {}

impl<const A: usize> WideCase<A> {
    /// Draws a case with at most these numbers of leaves, of inner nodes with one child, and of distances.
    pub fn draw(source: &mut impl Source, leaves: u32, chain: u32, distances: u32) -> Self {
        let leaves = 1 + source.below(u64::from(leaves)) as u32;
        let chain = source.below(u64::from(chain) + 1) as u32;
        let tree = wide_tree(&wide_shape::<A>(source, leaves, chain));
        Self::with_tree(source, tree, distances)
    }

    /// Draws a case for a given tree.
    pub fn with_tree(source: &mut impl Source, tree: Tree<A>, distances: u32) -> Self {
        let mut tape = WideTape::draw(source, &tree, distances);
        if source.below(4) == 1 {
            let leaves: Vec<Node> = tree.nodes().filter(|node| node.is_leaf()).collect();
            if !leaves.is_empty() {
                tape = tape.stopping_at(leaves[source.below(leaves.len() as u64) as usize]);
            }
        }
        Self { tree, tape, is_sorted: source.below(4) != 1 }
    }

    /// Returns the search, before its first step. `SORTED` must equal [`is_sorted`](Self::is_sorted).
    pub fn search<const SORTED: bool>(&self) -> WideSearch<'_, A, SORTED> {
        WideSearch::new(&self.tape)
    }

    /// Returns the oracle's visits.
    pub fn expected(&self) -> Vec<Node> {
        fn visits<const A: usize, const SORTED: bool>(case: &WideCase<A>) -> Vec<Node> {
            let mut trace = Trace::default();
            oracle::traverse(&case.tree, &mut WideSearch::<A, SORTED>::new(&case.tape), &mut trace);
            trace.nodes().to_vec()
        }
        if self.is_sorted { visits::<A, true>(self) } else { visits::<A, false>(self) }
    }

    /// Compares all traversals of the table with the oracle, and all combinations of storing pending nodes with
    /// returning to an ancestor. Returns the number of comparisons. `[WIDE-7]`
    ///
    /// # Errors
    /// The first traversal that differs, or that wrongly refuses a tree.
    pub fn check(&self) -> Result<u32, WideFault> {
        let (expected, tables) = (self.expected(), Tables::new(&self.tree));
        let mut count = 0;
        for method in Method::ALL {
            if method.restarts() && self.is_sorted && !self.tape.is_monotone() {
                continue;
            }
            count += u32::from(self.compare(method.name(), &expected, |watch| {
                let memory = &mut Scratch::default();
                method.dispatch(Watched { watch, from: Supply { tree: &self.tree, tables: &tables, memory } })
            })?);
        }
        let hash = tables.hash().ok();
        count += self.check_kept("32 bits", Trail::<u32>::default, &expected, hash)?;
        count += self.check_kept("64 bits", Trail::<u64>::default, &expected, hash)?;
        count += self.check_kept("128 bits", Trail::<u128>::default, &expected, hash)?;
        count += self.check_kept("ranks", Ranked::default, &expected, hash)?;
        Ok(count)
    }

    fn check_kept<K: PendingStore<A>>(
        &self,
        name: &str,
        kept: impl Fn() -> K,
        expected: &[Node],
        hash: Option<&PerfectHash>,
    ) -> Result<u32, WideFault> {
        let by_parents = self.check_pending(&format!("{name}, parents"), kept(), Parents, expected)?;
        let by_records = self.check_pending(&format!("{name}, records"), kept(), Recorded, expected)?;
        let link = hash.map(Hashed::new);
        let by_hash =
            link.map(|link| self.check_pending(&format!("{name}, hash"), kept(), link, expected)).transpose()?;
        Ok(u32::from(by_parents) + u32::from(by_records) + u32::from(by_hash == Some(true)))
    }

    fn check_pending<K: PendingStore<A>, L: Link<A>>(
        &self,
        name: &str,
        kept: K,
        link: L,
        expected: &[Node],
    ) -> Result<bool, WideFault> {
        self.compare(name, expected, |watch| {
            watch.run(&mut Pending::new(&self.tree, kept, link)?);
            Ok(())
        })
    }

    /// Compares one traversal. Returns `false` if it refuses the tree because of its levels.
    ///
    /// # Errors
    /// The traversal visits other nodes, or wrongly refuses the tree.
    pub fn compare(
        &self,
        name: &str,
        expected: &[Node],
        run: impl FnOnce(&mut Watch<'_, A>) -> Result<(), Unsupported>,
    ) -> Result<bool, WideFault> {
        let mut watch = Watch { case: self, seen: Vec::new(), most: expected.len() + 1 };
        match run(&mut watch) {
            Err(Unsupported::TooDeep(error)) if error.depth == self.tree.levels() && error.depth > error.limit => {
                Ok(false)
            }
            ran => {
                let seen = if ran.is_ok() { watch.seen } else { Vec::new() };
                let differs = (0..expected.len().max(seen.len())).find(|&i| expected.get(i) != seen.get(i));
                differs.map_or(Ok(true), |visit| {
                    let [expected, found] = [expected, &seen].map(|nodes| nodes.get(visit).copied());
                    Err(WideFault { traversal: name.to_owned(), visit, expected, found })
                })
            }
        }
    }
}

/// Runs cursors over a case and records their visits.
#[derive(Debug)]
pub struct Watch<'c, const A: usize> {
    case: &'c WideCase<A>,
    seen: Vec<Node>,
    most: usize,
}

impl<const A: usize> Watch<'_, A> {
    /// Runs a cursor to its end, twice: both runs must be equal.
    pub fn run(&mut self, cursor: &mut impl Cursor<A>) {
        self.run_over(&self.case.tree, cursor);
    }

    /// Runs a cursor to its end like [`run`](Self::run), with the leaves of another tree.
    pub fn run_over(&mut self, tree: &impl Topology<A>, cursor: &mut impl Cursor<A>) {
        let (case, most) = (self.case, self.most);
        let once = |cursor: &mut _| {
            if case.is_sorted {
                visits(tree, &mut WideSearch::<A, true>::new(&case.tape), cursor, most)
            } else {
                visits(tree, &mut WideSearch::<A, false>::new(&case.tape), cursor, most)
            }
        };
        let first = once(cursor);
        cursor.reset(tree);
        self.seen = if first == once(cursor) { first.unwrap_or_default() } else { Vec::new() };
    }
}

/// Returns the nodes that a cursor visits, at most `most + 1`; `None` for an endless loop without visits.
pub(crate) fn visits<const A: usize>(
    tree: &impl Topology<A>,
    search: &mut impl wide::Search<A>,
    cursor: &mut impl Cursor<A>,
    most: usize,
) -> Option<Vec<Node>> {
    let (mut visits, cursor) = (Visits { seen: Vec::new(), most }, &mut Followed(cursor));
    if visits.visit::<u64>(cursor.node(), || State::of(cursor.node())) == Flow::Stop {
        return Some(visits.seen);
    }
    // No node is queried more often than it has descendants.
    for _ in 0..(most as u64 + 2) * u64::from(tree.levels() + 2) * A as u64 {
        let wanted = search.ask(cursor.node());
        if !wide::advance(tree, cursor, wanted, search, &mut visits) {
            return Some(visits.seen);
        }
    }
    None
}

/// Checks that a cursor that returns along its path is at the parent of each child that it names. The stored address of
/// the child could hide a wrong parent, so the visits end at the first one. `[WIDE-15]`
#[derive(Debug)]
struct Followed<'c, C>(&'c mut C);

impl<C> Followed<'_, C> {
    fn look<const A: usize>(&self, tree: &impl Topology<A>, next: Next) -> Next
    where
        C: Cursor<A>,
    {
        // A stack stores nothing per level, and a restart does not return along the path.
        let goes_back = matches!(self.0.words(0), Some(StateView::Trail { .. } | StateView::Ranked { .. }));
        let is_at_parent = |child| (0..A as u32).any(|slot| tree.child(self.0.node(), slot) == child);
        match next {
            Next::Child(child) if goes_back && !is_at_parent(child) => Next::End,
            _ => next,
        }
    }
}

impl<const A: usize, C: Cursor<A>> Cursor<A> for Followed<'_, C> {
    const RESTARTS: bool = C::RESTARTS;

    fn reset(&mut self, tree: &impl Topology<A>) {
        self.0.reset(tree);
    }

    fn node(&self) -> Node {
        self.0.node()
    }

    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: wide::Search<A>,
    {
        let next = self.0.choose(tree, wanted, search);
        self.look(tree, next)
    }

    fn next<T: Topology<A>, S: wide::Search<A>>(&mut self, tree: &T, search: &mut S) -> Next {
        let next = self.0.next(tree, search);
        self.look(tree, next)
    }

    fn enter(&mut self, node: Node) {
        self.0.enter(node);
    }

    fn shortened(&mut self) {
        self.0.shortened();
    }

    fn is_restarting(&self) -> bool {
        self.0.is_restarting()
    }
}

struct Visits {
    seen: Vec<Node>,
    most: usize,
}

impl Recorder for Visits {
    fn visit<W: KeyWord>(&mut self, node: Node, _: impl FnOnce() -> State<W>) -> Flow {
        self.seen.push(node);
        if self.seen.len() > self.most { Flow::Stop } else { Flow::Continue }
    }
}

struct Watched<'t, 'w, 'c, const A: usize> {
    watch: &'w mut Watch<'c, A>,
    from: Supply<'t, Tree<A>>,
}

impl<'t, const A: usize> Context<'t, A, Tree<A>> for Watched<'t, '_, '_, A> {
    type Output = ();

    fn run<C: Cursor<A>>(
        self,
        start: impl Fn(Supply<'t, Tree<A>>) -> Result<C, Unsupported>,
    ) -> Result<(), Unsupported> {
        self.watch.run(&mut start(self.from)?);
        Ok(())
    }
}

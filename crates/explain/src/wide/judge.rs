//! Comparison of a recording of a wide tree with the oracle's.

use super::observe::{self, Back, LevelState, Log, Seen};
use super::places::{Places, name};
use crate::{By, ExplainError, HashLookup, Next};
use stackless_bvh::internals::wide::StateView;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Method, Search, Tables, Topology, Tree, is_beyond};

/// The oracle's run, and lookups of the tree's nodes.
#[derive(Debug)]
pub(super) struct Judge<'a, const A: usize> {
    pub(super) tree: &'a Tree<A>,
    pub(super) method: Method,
    pub(super) places: &'a Places,
    tables: &'a Tables,
    is_sorted: bool,
    oracle: Vec<Seen>,
    /// The postponed nodes at each visit; `None` if the oracle's visits do not match its answers.
    postponed: Option<Vec<Postponed>>,
    /// By node number: the wanted children with their ranks, in their order.
    wanted: Vec<Vec<(Node, u32)>>,
}

/// The oracle's postponed nodes with their ranks. The last one is visited next.
type Postponed = Vec<(Node, u32)>;

impl<'a, const A: usize> Judge<'a, A> {
    pub(super) fn new<S: Search<A>>(
        tree: &'a Tree<A>,
        search: S,
        method: Method,
        places: &'a Places,
        tables: &'a Tables,
    ) -> Self {
        let log = Log::new(places);
        observe::run_oracle(tree, search, &log);
        let (oracle, end) = log.into_steps();
        let mut wanted = vec![Vec::new(); places.len()];
        for seen in &oracle {
            wanted[seen.node.index()] = seen.wanted.clone().unwrap_or_default();
        }
        let postponed = postponed::<A>(tree.root(), &oracle, end, S::SORTED);
        Self { tree, method, places, tables, is_sorted: S::SORTED, oracle, postponed, wanted }
    }

    /// Returns whether ranks decrease anywhere on the way down.
    pub(super) fn is_falling(&self) -> bool {
        let begin = |rank: u32| rank & !(A as u32 - 1);
        let all = || self.wanted.iter().flatten();
        let falls = |&(node, rank): &(Node, u32)| {
            self.wanted[node.index()].iter().any(|&(_, below)| begin(below) < begin(rank))
        };
        self.is_sorted && all().any(falls)
    }

    /// Returns the oracle's postponed nodes at each step. Every visit must equal the oracle's, and the stored state
    /// must describe exactly these nodes.
    ///
    /// On the way down after a restart, the next node is still postponed.
    pub(super) fn compare(&self, steps: &[Seen]) -> Result<Vec<Postponed>, ExplainError> {
        let Some(postponed) = &self.postponed else {
            return Err(self.differs(0, "the way of its oracle", "that of its answers", "another"));
        };
        let visits: Vec<&Seen> = steps.iter().filter(|seen| !seen.is_restarting).collect();
        for (visit, (seen, expected)) in visits.iter().zip(&self.oracle).enumerate() {
            self.compare_visit(visit, seen, expected, &postponed[visit])?;
        }
        if visits.len() != self.oracle.len() {
            let [expected, found] = [self.oracle.len(), visits.len()].map(|count| count.to_string());
            return Err(self.differs(visits.len().min(self.oracle.len()), "the number of visits", expected, found));
        }
        let mut rest = self.oracle.iter().zip(postponed).peekable();
        let of_step = |seen: &Seen| {
            if !seen.is_restarting {
                return rest.next().map_or_else(Vec::new, |(_, postponed)| postponed.clone());
            }
            rest.peek().map_or_else(Vec::new, |(next, postponed)| {
                let own = self.rank(next.node).map(|rank| (next.node, rank));
                postponed.iter().copied().chain(own).collect()
            })
        };
        Ok(steps.iter().map(of_step).collect())
    }

    fn compare_visit(
        &self,
        visit: usize,
        seen: &Seen,
        expected: &Seen,
        postponed: &[(Node, u32)],
    ) -> Result<(), ExplainError> {
        let differs = |what, expected: String, found: String| Err(self.differs(visit, what, expected, found));
        if seen.node != expected.node {
            return differs("the node", self.name(expected.node), self.name(seen.node));
        }
        if seen.wanted != expected.wanted {
            return differs("the answer", format!("{:?}", expected.wanted), format!("{:?}", seen.wanted));
        }
        if let Some(key) = seen.key.filter(|&key| u128::from(key) != self.places.key(seen.node)) {
            return differs("the key", format!("{:b}", self.places.key(seen.node)), format!("{key:b}"));
        }
        let mut path = self.places.ancestors(seen.node);
        path.reverse();
        path.push(seen.node);
        for (level, kept) in seen.levels.iter().enumerate() {
            self.compare_level([path[level], path[level + 1]], seen.end, kept, postponed)
                .or_else(|(what, expected, found)| differs(what, expected, found))?;
        }
        Ok(())
    }

    /// Compares the stored state of a node on the path, and the child where the path continues.
    fn compare_level(
        &self,
        [node, child]: [Node; 2],
        end: u32,
        kept: &LevelState,
        postponed: &[(Node, u32)],
    ) -> Result<(), (&'static str, String, String)> {
        let wanted = &self.wanted[node.index()];
        let (mut open, mut beyond) = (0_u32, 0_u32);
        for &(child, rank) in wanted {
            let slot = 1 << self.slot(child);
            beyond |= if self.is_beyond(rank, end) { slot } else { 0 };
            open |= if postponed.iter().any(|&(node, _)| node == child) { slot } else { 0 };
        }
        let sets = |pending: u32| {
            if (open ^ pending) & !beyond == 0 {
                return Ok(());
            }
            let [expected, found] = [open, pending].map(group::<A>);
            Err(("the pending set", expected, found))
        };
        match kept.words {
            StateView::Trail { pending, is_dirty } => {
                sets(pending)?;
                // Without an order no child is beyond the end, and the bit is unused.
                if self.is_sorted && is_dirty != kept.has_changed {
                    return Err(("the dirty bit", kept.has_changed.to_string(), is_dirty.to_string()));
                }
            }
            StateView::Ranked { pending, is_open, ranks } => {
                sets(pending)?;
                if is_open.is_some_and(|is_open| is_open != (pending != 0)) {
                    return Err(("the summary bit", (pending != 0).to_string(), (pending == 0).to_string()));
                }
                let of_set = |&&(child, _): &&(Node, u32)| pending >> self.slot(child) & 1 == 1;
                let least = wanted.iter().filter(of_set).map(|&(_, rank)| rank);
                if let Some((expected, found)) =
                    least.zip(ranks).take_while(|&(_, found)| found != 0).find(|(expected, found)| expected != found)
                {
                    return Err(("a rank", expected.to_string(), found.to_string()));
                }
            }
            StateView::Number { number, is_last } => {
                let named = |&&(child, _): &&(Node, u32)| self.is_sorted || !child.is_leaf();
                let place = wanted.iter().filter(named).position(|&(other, _)| other == child);
                if place != Some(number as usize) {
                    return Err(("the number", format!("{place:?}"), number.to_string()));
                }
                if is_last && open & !beyond != 0 {
                    return Err(("what is left", group::<A>(open), "nothing".to_owned()));
                }
            }
        }
        Ok(())
    }

    fn differs(
        &self,
        visit: usize,
        what: &'static str,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> ExplainError {
        let (method, expected, found) = (self.method.name(), expected.into(), found.into());
        ExplainError::Differs { method, visit, what, expected, found }
    }

    /// Returns the number of existing ancestors that the method reads from a record.
    pub(super) fn links(&self) -> u32 {
        let most = self.tree.levels();
        match self.method {
            Method::Trail => most.min(1),
            Method::Recorded => most.min(A as u32),
            _ => 0,
        }
    }

    pub(super) fn next(&self, seen: &Seen, following: &Seen) -> Next {
        let node = following.node;
        let descends = seen.wanted.iter().flatten().any(|&(child, _)| child == node);
        let mut way: Vec<Node> = seen.backs.iter().flat_map(|back| back.read.iter().copied()).collect();
        way.dedup();
        way.retain(|&read| Some(read) != seen.backs.first().map(|back| back.from));
        let depth = |node: Node| self.places.depth(node);
        let lookup = seen.backs.iter().rev().find_map(|back| self.lookup(back));
        Next {
            node: number(node),
            levels: (!descends && !following.is_restarting).then(|| depth(seen.node).saturating_sub(depth(node))),
            by: if descends { By::Child } else { self.source(seen, following) },
            lookup: if descends { None } else { lookup },
            way: if descends { Vec::new() } else { way.into_iter().map(number).collect() },
        }
    }

    /// Returns the source of a postponed node's address.
    fn source(&self, seen: &Seen, following: &Seen) -> By {
        let has_gone = seen.backs.iter().any(|back| back.from != back.to);
        match self.method {
            _ if following.is_restarting => By::Restart,
            Method::Trail if has_gone => By::Climb,
            Method::Recorded if has_gone => By::Ancestor,
            Method::Hashed if has_gone => By::Table,
            Method::Trail | Method::Recorded | Method::Hashed => By::Parent,
            _ => By::Stack,
        }
    }

    /// Returns the lookup of a backtrack, if a table was used.
    pub(super) fn lookup(&self, back: &Back) -> Option<HashLookup> {
        let (key, hash) = (back.key?, self.tables.hash().ok()?);
        (back.from != back.to).then(|| HashLookup::of(hash, &key, number))
    }

    pub(super) fn is_beyond(&self, rank: u32, end: u32) -> bool {
        self.is_sorted && is_beyond::<A>(rank, end)
    }

    pub(super) const fn is_sorted(&self) -> bool {
        self.is_sorted
    }

    fn slot(&self, node: Node) -> u32 {
        self.places.key(node) as u32 & (A as u32 - 1)
    }

    fn rank(&self, node: Node) -> Option<u32> {
        self.wanted.iter().flatten().find_map(|&(child, rank)| (child == node).then_some(rank))
    }

    pub(super) fn name(&self, node: Node) -> String {
        name::<A>(self.places.key(node))
    }

    /// Returns the name of the node with a number.
    pub(super) fn name_of(&self, number: u32) -> String {
        self.places.keys().nth(number as usize).map_or_else(String::new, name::<A>)
    }
}

/// Returns the number of a node on pages.
pub(super) fn number(node: Node) -> u32 {
    node.index() as u32
}

/// Formats a set of slots as digits, slot 0 last.
pub(super) fn group<const A: usize>(set: u32) -> String {
    format!("{set:0A$b}")
}

/// Computes the postponed nodes at each visit. An answer postpones its children, and a visit is of the last postponed
/// node that is not beyond the end; otherwise the result is `None`.
fn postponed<const A: usize>(root: Node, steps: &[Seen], end: u32, is_sorted: bool) -> Option<Vec<Postponed>> {
    let is_left_out = |rank, end| is_sorted && is_beyond::<A>(rank, end);
    let mut stack = vec![(root, 0)];
    let mut all = Vec::with_capacity(steps.len());
    for seen in steps {
        loop {
            let (node, rank) = stack.pop()?;
            if node == seen.node {
                break;
            }
            if !is_left_out(rank, seen.end) {
                return None;
            }
        }
        all.push(stack.clone());
        stack.extend(seen.wanted.iter().flatten().rev());
    }
    let stopped = steps.last().is_some_and(|seen| seen.stops);
    (stopped || stack.iter().all(|&(_, rank)| is_left_out(rank, end))).then_some(all)
}

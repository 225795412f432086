//! Comparison of a recording with the oracle's.

use super::lookup::binary;
use super::observe::{self, LinkTable, Log, Seen, Word};
use super::{By, ExplainError, Next, slot};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::internals::traverse::Need;
use stackless_bvh::order::{Descent, Flow, Pruning};
use stackless_bvh::traverse::Method;
use stackless_bvh::tree::{Keys, Node, Parents, Recorded, Topology, Tree};
use stackless_check::{Case, Expected, Fault, Visit, Watch};

/// The oracle's run on a case, and lookups of the tree's nodes.
#[derive(Debug)]
pub(super) struct Judge<'a> {
    pub(super) tree: &'a Tree,
    pub(super) method: Method,
    keys: Keys,
    parents: Parents,
    pub(super) links: LinkTable,
    /// `None` if the oracle's visits do not match its decisions.
    expected: Option<Vec<Visit>>,
}

impl<'a> Judge<'a> {
    pub(super) fn new(case: &'a Case, method: Method) -> Self {
        let tree = &case.tree;
        let log = Log::default();
        observe::run_oracle(case, method, &log);
        let expected = visits(tree, method.test().pruning(), &log.into_steps());
        let (keys, parents, links) = (Keys::of(tree), Parents::of(tree), LinkTable::of(tree, method));
        Self { tree, method, keys, parents, links, expected }
    }

    /// Returns the oracle's postponed nodes at each visit, restarts included. Every visit must equal the oracle's, and
    /// every word must describe exactly these nodes.
    ///
    /// On the way down after a restart, the next node is still postponed.
    pub(super) fn compare(&self, steps: &[Seen]) -> Result<Vec<Vec<Node>>, ExplainError> {
        let Some(expected) = &self.expected else {
            return Err(self.differs(
                0,
                "the way of its oracle",
                "that of its decisions".to_owned(),
                "another".to_owned(),
            ));
        };
        let (visits, restarts) = (Expected::Visits(expected), self.method.restarts());
        let mut watch = Watch::new(self.tree, &self.keys, &self.parents, visits, u64::MAX, restarts);
        for seen in steps {
            if watch.visit(seen.state.node, || seen.state) == Flow::Stop {
                break;
            }
            if !seen.state.is_restarting {
                watch.decided(seen.descent);
            }
        }
        watch.finish().map_err(|fault| self.told(fault, expected, steps))?;
        let mut all: Vec<Vec<Node>> = Vec::with_capacity(steps.len());
        let mut rest = expected.iter().peekable();
        for seen in steps {
            let is_passed = seen.state.is_restarting;
            let next = if is_passed { rest.peek().copied() } else { rest.next() };
            let postponed = next.map(|visit| {
                let pending = is_passed.then_some(visit.node);
                visit.postponed.iter().copied().chain(pending).collect()
            });
            all.push(postponed.unwrap_or_default());
        }
        Ok(all)
    }

    fn differs(&self, visit: usize, what: &'static str, expected: String, found: String) -> ExplainError {
        ExplainError::Differs { method: self.method.name(), visit, what, expected, found }
    }

    /// Adds the differing words to a fault.
    fn told(&self, fault: Fault, expected: &[Visit], steps: &[Seen]) -> ExplainError {
        let states: Vec<_> = steps.iter().map(|seen| &seen.state).filter(|state| !state.is_restarting).collect();
        let word = |visit: usize, word: fn(&State<Word>) -> Option<Word>| {
            states.get(visit).and_then(|state| word(state)).as_ref().map(binary)
        };
        let postponed = |visit: usize| expected.get(visit).map_or(&[][..], |visit| &visit.postponed);
        let none = || "none".to_owned();
        let (visit, what, expected, found) = match fault {
            Fault::Node { visit, expected: Some(expected), found } => {
                (visit, "the node", self.name(expected), self.name(found))
            }
            Fault::Node { visit, expected: None, .. } | Fault::Early { visits: visit, .. } => {
                (visit, "the number of visits", expected.len().to_string(), states.len().to_string())
            }
            Fault::Decision { visit, expected, found } => {
                (visit, "the decision", format!("{expected:?}"), format!("{found:?}"))
            }
            Fault::Key { visit, node } => {
                (visit, "the key", binary(&self.key(node)), word(visit, |state| state.key).unwrap_or_else(none))
            }
            Fault::Trail { visit, node } => {
                let (trail, counter) = self.words(node, postponed(visit));
                let found = [
                    ("the trail", trail, word(visit, |state| state.trail)),
                    ("the counter", counter, word(visit, |state| state.counter)),
                ];
                let differing = found.into_iter().find_map(|(what, expected, found)| {
                    Some((what, expected, found?)).filter(|(_, expected, found)| expected != found)
                });
                let (what, expected, found) = differing.unwrap_or_else(|| ("the second trail", none(), none()));
                (visit, what, expected, found)
            }
            Fault::Register { visit, found } => {
                let next = postponed(visit).last();
                (visit, "the register", next.map_or_else(none, |&next| self.name(next)), self.name(found))
            }
            fault => (states.len(), "the way", "its oracle's".to_owned(), fault.to_string()),
        };
        self.differs(visit, what, expected, found)
    }

    pub(super) fn key(&self, node: Node) -> u128 {
        self.keys.key(self.tree.slot(node))
    }

    /// Returns the node's key in decimal.
    pub(super) fn name(&self, node: Node) -> String {
        self.key(node).to_string()
    }

    pub(super) fn key_of(&self, slot: u32) -> u128 {
        self.keys.key(slot as usize)
    }

    /// Returns the [`name`](Self::name) of the node in a slot.
    pub(super) fn name_of(&self, slot: u32) -> String {
        self.key_of(slot).to_string()
    }

    /// Returns the wanted children, the first one first.
    pub(super) fn wanted(&self, node: Node, descent: Option<Descent>) -> Vec<Node> {
        let Some(descent) = descent.filter(|descent| !descent.is_neither()) else { return Vec::new() };
        let first = descent.first();
        let sides = [Some(first), descent.postpones().then(|| first.other())];
        sides.into_iter().flatten().map(|side| self.tree.child(node, side)).collect()
    }

    pub(super) fn next(&self, seen: &Seen, following: &State<Word>, wanted: &[Node]) -> Next {
        let (node, descends) = (following.node, wanted.contains(&following.node));
        // A climb reads some records more than once.
        let mut way = seen.read.clone();
        way.dedup();
        way.retain(|&read| read != seen.state.node);
        let by = if descends {
            By::Child
        } else if seen.lookup.is_some() {
            By::Table
        } else {
            self.source(seen, following, way.is_empty())
        };
        let depth = |node: Node| self.keys.depth(self.tree.slot(node));
        Next {
            node: slot(self.tree, node),
            levels: (!descends && !following.is_restarting).then(|| depth(seen.state.node).saturating_sub(depth(node))),
            by,
            lookup: seen.lookup.clone(),
            way: if descends { Vec::new() } else { way.iter().map(|&node| slot(self.tree, node)).collect() },
        }
    }

    /// Returns the source of a postponed node's address, unless it is the perfect hash.
    fn source(&self, seen: &Seen, following: &State<Word>, stayed: bool) -> By {
        match (self.method.wants_recorded(), self.method.needs()) {
            (Recorded::Uncles, _) => {
                let links = self.links.of_node(self.tree, seen.state.node);
                let is_link = |index: usize| links.get(index) == Some(&Some(following.node));
                match () {
                    () if seen.state.register == Some(following.node) => By::Register,
                    () if stayed && is_link(0) => By::Uncle,
                    () if stayed && is_link(1) => By::GrandUncle,
                    () => By::Climb,
                }
            }
            (Recorded::ParentSibling, _) => By::Climb,
            (_, Need::Skips | Need::SkipsBySign) => By::Skip,
            _ if following.is_restarting => By::Restart,
            _ if self.method.restarts() || self.method.without_pruning() == Method::Stack => By::Stack,
            _ => By::Key,
        }
    }

    /// Returns the trail and the counter that describe exactly these postponed nodes.
    fn words(&self, mut node: Node, stack: &[Node]) -> (String, String) {
        let mut bits = Vec::new();
        while node != self.tree.root() {
            let [parent, sibling] = self.parents.row(self.tree, node);
            bits.push(stack.contains(&sibling));
            node = parent;
        }
        let digits = |ones: bool| bits.iter().rev().map(move |&bit| if bit == ones { '1' } else { '0' });
        let trail: String = digits(true).skip_while(|&digit| digit == '0').collect();
        let counter = std::iter::once('1').chain(digits(false)).collect();
        (if trail.is_empty() { "0".to_owned() } else { trail }, counter)
    }
}

/// Computes the oracle's postponed nodes at each visit. A decision postpones the second child, and a visit is of the
/// first child or of the last postponed node; otherwise the result is `None`.
///
/// If pruning is allowed, a node is omitted when a hit comes before it, or when it would be visited.
fn visits(tree: &Tree, pruning: Pruning, steps: &[Seen]) -> Option<Vec<Visit>> {
    let mut stack: Vec<(Node, bool)> = Vec::new();
    let (mut all, mut entered) = (Vec::with_capacity(steps.len()), Some(tree.root()));
    for Seen { state, descent, found, .. } in steps {
        while entered != Some(state.node) {
            let (postponed, _) = stack.pop()?;
            if postponed != state.node && pruning != Pruning::Distance {
                return None;
            }
            entered = Some(postponed);
        }
        let postponed = stack.iter().map(|&(node, _)| node).collect();
        all.push(Visit { node: state.node, descent: *descent, postponed });
        entered = None;
        if let Some(descent) = descent.filter(|descent| !descent.is_neither()) {
            let first = descent.first();
            entered = Some(tree.child(state.node, first));
            if descent.postpones() {
                stack.push((tree.child(state.node, first.other()), descent.is_disjoint()));
            }
        }
        if found.prunes && pruning == Pruning::Disjoint {
            stack.retain(|&(_, is_disjoint)| !is_disjoint);
        }
    }
    let stopped = steps.last().is_some_and(|seen| seen.found.stops);
    (stopped || pruning == Pruning::Distance || stack.is_empty()).then_some(all)
}

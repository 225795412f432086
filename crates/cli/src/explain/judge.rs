//! A recording beside the oracle's.

use super::observe::{self, LinkTable, Log, Seen};
use super::{By, ExplainError, Next, Step, slot, text};
use stackless_bvh::order::{Descent, Pruning};
use stackless_bvh::traverse::{Method, Need};
use stackless_bvh::tree::{Keys, Node, Parents, Recorded, Topology, Tree};
use stackless_check::Case;

/// What the oracle of a traversal does on a case, and what the tree says of its nodes.
#[derive(Debug)]
pub(super) struct Judge<'a> {
    pub(super) tree: &'a Tree,
    pub(super) method: Method,
    keys: Keys,
    parents: Parents,
    links: LinkTable,
    expected: Vec<Seen>,
    /// For each of its visits, the postponed nodes, the last one of which comes next.
    stacks: Option<Vec<Vec<Node>>>,
}

impl<'a> Judge<'a> {
    pub(super) fn new(case: &'a Case, method: Method) -> Self {
        let tree = &case.tree;
        let log = Log::default();
        observe::run_oracle(case, method, &log);
        let expected = log.into_steps();
        let stacks = stacks(tree, method.test().pruning(), &expected);
        let (keys, parents, links) = (Keys::of(tree), Parents::of(tree), LinkTable::of(tree, method));
        Self { tree, method, keys, parents, links, expected, stacks }
    }

    /// The oracle's postponed nodes at each visit, restarts included, if every visit is the oracle's and every word
    /// names just these nodes. `[TRAIL-1]` `[TRAIL-6]` `[REGISTER-1]`
    ///
    /// On the way down again the node that comes next is still postponed.
    pub(super) fn compare(&self, steps: &[Seen]) -> Result<Vec<Vec<Node>>, ExplainError> {
        let differs = |visit, what, expected: String, found: String| {
            Err(ExplainError::Differs { method: self.method, visit, what, expected, found })
        };
        let visits: Vec<&Seen> = steps.iter().filter(|seen| !seen.restart).collect();
        let Some(stacks) = &self.stacks else {
            return differs(0, "the way of its oracle", "that of its decisions".to_owned(), "another".to_owned());
        };
        for (visit, ((seen, expected), stack)) in visits.iter().zip(&self.expected).zip(stacks).enumerate() {
            let node = |node: Option<Node>| node.map_or_else(|| "none".to_owned(), |node| self.name(node));
            if seen.node != expected.node {
                return differs(visit, "the node", self.name(expected.node), self.name(seen.node));
            }
            if seen.descent != expected.descent {
                return differs(
                    visit,
                    "the decision",
                    format!("{:?}", expected.descent),
                    format!("{:?}", seen.descent),
                );
            }
            let (trail, counter) = self.words(seen.node, stack);
            let key = text::binary(&self.key(seen.node));
            for (what, expected, found) in [
                ("the key", key, &seen.key),
                ("the trail", trail, &seen.trail),
                ("the counter", counter, &seen.counter),
            ] {
                if let Some(found) = found.as_ref().filter(|found| **found != expected) {
                    return differs(visit, what, expected, found.clone());
                }
            }
            let next = stack.last().copied();
            if seen.register.is_some() && seen.register != next {
                return differs(visit, "the register", node(next), node(seen.register));
            }
        }
        if visits.len() != self.expected.len() {
            let counts = [self.expected.len(), visits.len()].map(|count| count.to_string());
            let [expected, found] = counts;
            return differs(visits.len().min(self.expected.len()), "the number of visits", expected, found);
        }
        let mut all: Vec<Vec<Node>> = Vec::with_capacity(steps.len());
        let mut rest = visits.iter().zip(stacks).peekable();
        for seen in steps {
            let next = if seen.restart { rest.peek().copied() } else { rest.next() };
            let postponed = next.map(|(visit, stack)| {
                let pending = seen.restart.then_some(visit.node);
                stack.iter().copied().chain(pending).collect()
            });
            all.push(postponed.unwrap_or_default());
        }
        Ok(all)
    }

    /// A visit as it is shown.
    pub(super) fn step(&self, steps: &[Seen], visit: usize, stack: &[Node]) -> Step {
        let (seen, following) = (&steps[visit], steps.get(visit + 1));
        let wanted = self.wanted(seen.node, seen.descent);
        let next = following.map(|following| self.next(seen, following, wanted.contains(&following.node)));
        let (text, clauses) = text::of(self, seen, next.as_ref());
        let slots = |nodes: &[Node]| nodes.iter().map(|&node| slot(self.tree, node)).collect();
        let links = self.links.of_node(self.tree, seen.node);
        Step {
            node: slot(self.tree, seen.node),
            restart: seen.restart,
            key: seen.key.clone(),
            trail: seen.trail.clone(),
            counter: seen.counter.clone(),
            disjoint: seen.disjoint.clone(),
            register: seen.register.map(|node| slot(self.tree, node)),
            links: links.into_iter().map(|link| link.map(|node| slot(self.tree, node))).collect(),
            stack: slots(stack),
            decision: seen.descent.map(text::decision),
            wanted: slots(&wanted),
            hit: seen.found.hit,
            next,
            text,
            clauses,
        }
    }

    pub(super) fn key(&self, node: Node) -> u128 {
        self.keys.key(self.tree.slot(node))
    }

    /// The node's key in decimal.
    pub(super) fn name(&self, node: Node) -> String {
        self.key(node).to_string()
    }

    pub(super) fn key_of(&self, slot: u32) -> u128 {
        self.keys.key(slot as usize)
    }

    /// The same as [`name`](Self::name), for a slot.
    pub(super) fn name_of(&self, slot: u32) -> String {
        self.key_of(slot).to_string()
    }

    /// The children that a decision wants, the first one first.
    pub(super) fn wanted(&self, node: Node, descent: Option<Descent>) -> Vec<Node> {
        let Some(descent) = descent.filter(|descent| !descent.is_neither()) else { return Vec::new() };
        let first = descent.first();
        let sides = [Some(first), descent.postpones().then(|| first.other())];
        sides.into_iter().flatten().map(|side| self.tree.child(node, side)).collect()
    }

    fn next(&self, seen: &Seen, following: &Seen, descends: bool) -> Next {
        let node = following.node;
        // A climb reads a record more than once.
        let mut way = seen.read.clone();
        way.dedup();
        way.retain(|&read| read != seen.node);
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
            levels: (!descends && !following.restart).then(|| depth(seen.node).saturating_sub(depth(node))),
            by,
            lookup: seen.lookup.clone(),
            way: if descends { Vec::new() } else { way.iter().map(|&node| slot(self.tree, node)).collect() },
        }
    }

    /// Where the address of a postponed node comes from, if not from the perfect hash.
    fn source(&self, seen: &Seen, following: &Seen, stayed: bool) -> By {
        match (self.method.wants_recorded(), self.method.needs()) {
            (Recorded::Uncles, _) => {
                let links = self.links.of_node(self.tree, seen.node);
                let is_link = |index: usize| links.get(index) == Some(&Some(following.node));
                match () {
                    () if seen.register == Some(following.node) => By::Register,
                    () if stayed && is_link(0) => By::Uncle,
                    () if stayed && is_link(1) => By::GrandUncle,
                    () => By::Climb,
                }
            }
            (Recorded::ParentSibling, _) => By::Climb,
            (_, Need::Skips | Need::SkipsBySign) => By::Skip,
            _ if following.restart => By::Restart,
            _ if self.method.restarts() || self.method.without_pruning() == Method::Stack => By::Stack,
            _ => By::Key,
        }
    }

    /// Trail and counter that name just these postponed nodes.
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

/// The postponed nodes at each visit of the oracle, which keeps them in its recursion: a decision postpones the second
/// child, and a visit that is not of the first child is of the last one of them. `None` if it is not.
///
/// A node is left out, where that is allowed, when a hit comes before it, or when its turn comes.
fn stacks(tree: &Tree, pruning: Pruning, steps: &[Seen]) -> Option<Vec<Vec<Node>>> {
    let mut stack: Vec<(Node, bool)> = Vec::new();
    let (mut all, mut entered) = (Vec::with_capacity(steps.len()), Some(tree.root()));
    for seen in steps {
        while entered != Some(seen.node) {
            let (postponed, _) = stack.pop()?;
            if postponed != seen.node && pruning != Pruning::Distance {
                return None;
            }
            entered = Some(postponed);
        }
        all.push(stack.iter().map(|&(node, _)| node).collect());
        entered = None;
        if let Some(descent) = seen.descent.filter(|descent| !descent.is_neither()) {
            let first = descent.first();
            entered = Some(tree.child(seen.node, first));
            if descent.postpones() {
                stack.push((tree.child(seen.node, first.other()), descent.is_disjoint()));
            }
        }
        if seen.found.prunes && pruning == Pruning::Disjoint {
            stack.retain(|&(_, is_disjoint)| !is_disjoint);
        }
    }
    let stopped = steps.last().is_some_and(|seen| seen.found.stops);
    (stopped || pruning == Pruning::Distance || stack.is_empty()).then_some(all)
}

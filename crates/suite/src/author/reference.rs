//! The reference for visits of a search: a recursion over child indices, with a list of the postponed nodes of the
//! path.

use crate::ask::{Best, Children};
use crate::bits::Bits;
use stackless_bvh::generate::Cell;

/// The decisions of a search.
#[derive(Clone, Copy, Debug)]
pub(super) enum Search<'a> {
    /// A character for each node.
    Script(&'a [u8]),
    /// A small scene.
    Cells { cells: &'a [Cell], any: bool, rule: Rule },
}

/// When nodes are tested, and which nodes are pruned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// Children at their parent.
    Children,
    /// Children at their parent. Marked second children are pruned after a hit.
    Disjoint,
    /// Children at their parent. Nodes beyond the best hit are pruned.
    Distance,
    /// Nodes at their visit, left first.
    NodeLeft,
    /// Nodes at their visit, in the order of the octant.
    NodeSign(u8),
}

/// The state at a visit, before it.
#[derive(Clone, Debug)]
pub(super) struct Visit {
    pub(super) node: u32,
    pub(super) key: Bits,
    pub(super) trail: Bits,
    pub(super) marks: Bits,
    pub(super) best: Option<Best>,
    /// Trail and best hit after the visit of a leaf.
    pub(super) after: Option<(Bits, Option<Best>)>,
    /// Number of events before the visit, including a backtrack to it.
    pub(super) events: usize,
}

/// A run of the reference.
#[derive(Debug)]
pub(super) struct Reference<'a> {
    pub(super) children: &'a Children,
    search: Search<'a>,
    /// Key of the current node. The first bit is the root's.
    key: Vec<bool>,
    /// For each bit of the key: the begin of the postponed sibling, if it is postponed.
    postponed: Vec<Option<u32>>,
    /// For each bit of the key: whether the descent was marked.
    marks: Vec<bool>,
    /// Nodes of the path.
    path: Vec<u32>,
    /// Depth of the last visited node.
    depth: usize,
    pub(super) best: Option<Best>,
    pub(super) events: Vec<String>,
    pub(super) visits: Vec<Visit>,
}

/// Whether the search has been stopped.
type Stopped = bool;

impl<'a> Reference<'a> {
    /// Runs a search from the root to its end.
    pub(super) fn run(children: &'a Children, search: Search<'a>) -> Self {
        let root = Bits::root();
        let zero = Bits::zeros(1);
        Self::resume(children, search, &root, &zero, &zero, None, true)
    }

    /// Resumes from a state. Trail and marks have a bit for each bit of the key. The node is to be visited, or its
    /// visit is over.
    pub(super) fn resume(
        children: &'a Children,
        search: Search<'a>,
        key: &Bits,
        trail: &Bits,
        marks: &Bits,
        best: Option<Best>,
        visit: bool,
    ) -> Self {
        let mut path = vec![0];
        for &right in &key.0[1..] {
            let node = path.last().and_then(|&node: &u32| children[node as usize]);
            path.push(node.map_or(0, |pair| pair[usize::from(right)]));
        }
        let mut reference = Self {
            children,
            search,
            key: key.0.clone(),
            postponed: trail.0.iter().map(|&bit| bit.then_some(0)).collect(),
            marks: marks.0.clone(),
            path,
            depth: key.0.len() - 1,
            best,
            events: Vec::new(),
            visits: Vec::new(),
        };
        let _: Stopped = reference.go_on(visit);
        reference.events.push("end".to_owned());
        reference
    }

    fn go_on(&mut self, visit: bool) -> Stopped {
        if visit && self.visit() {
            return true;
        }
        while self.key.len() > 1 {
            if self.turn_back() {
                return true;
            }
            self.leave();
        }
        false
    }

    /// Visits the sibling of the current node if it is still postponed.
    fn turn_back(&mut self) -> Stopped {
        let last = self.key.len() - 1;
        let Some(begins) = self.postponed[last].take() else { return false };
        if self.rule() == Rule::Distance && self.best.is_some_and(|best| begins > best.t) {
            return false;
        }
        let right = !self.key[last];
        let Some(pair) = self.children[self.path[last - 1] as usize] else { return false };
        (self.key[last], self.marks[last]) = (right, false);
        self.path[last] = pair[usize::from(right)];
        self.events.push(format!("backtrack {} {}", self.key().hex(), self.depth - last));
        self.visit()
    }

    fn visit(&mut self) -> Stopped {
        let node = self.path[self.path.len() - 1];
        let (key, depth) = (self.key(), self.key.len() - 1);
        self.depth = depth;
        let trail = self.trail();
        let (marks, events) = (Bits(self.marks.clone()), self.events.len());
        let children = self.children[node as usize];
        let kind = if children.is_some() { "enter" } else { "leaf" };
        self.events.push(format!("{kind} {}", key.hex()));
        self.visits.push(Visit { node, key, trail, marks, best: self.best, after: None, events });
        let Some(pair) = children else {
            let (stopped, at) = (self.leaf(node), self.visits.len() - 1);
            self.visits[at].after = Some((self.trail(), self.best));
            return stopped;
        };
        let Some(Decision { right, postpones, marked }) = self.decide(node, pair) else { return false };
        let begins = self.cell(pair[usize::from(!right)]).map_or(0, |cell| cell.enter);
        self.key.push(right);
        self.postponed.push(postpones.then_some(begins));
        self.marks.push(marked);
        self.path.push(pair[usize::from(right)]);
        let stopped = self.visit() || self.turn_back();
        if !stopped {
            self.leave();
        }
        stopped
    }

    fn leave(&mut self) {
        self.key.pop();
        self.postponed.pop();
        self.marks.pop();
        self.path.pop();
    }

    fn key(&self) -> Bits {
        Bits(self.key.clone())
    }

    fn trail(&self) -> Bits {
        Bits(self.postponed.iter().map(Option::is_some).collect())
    }

    fn rule(&self) -> Rule {
        match self.search {
            Search::Script(_) => Rule::Children,
            Search::Cells { rule, .. } => rule,
        }
    }

    fn cell(&self, node: u32) -> Option<&'a Cell> {
        match self.search {
            Search::Script(_) => None,
            Search::Cells { cells, .. } => Some(&cells[node as usize]),
        }
    }

    fn is_wanted(&self, node: u32) -> bool {
        self.cell(node).is_some_and(|cell| !cell.miss && self.best.is_none_or(|best| cell.enter <= best.t))
    }

    fn decide(&self, node: u32, pair: [u32; 2]) -> Option<Decision> {
        let one = |right| Decision { right, postpones: false, marked: false };
        let both = |right| Decision { right, postpones: true, marked: false };
        let (cells, rule) = match self.search {
            Search::Script(script) => {
                return match script[node as usize] {
                    b'l' => Some(one(false)),
                    b'r' => Some(one(true)),
                    b'L' => Some(both(false)),
                    b'R' => Some(both(true)),
                    _ => None,
                };
            }
            Search::Cells { cells, rule, .. } => (cells, rule),
        };
        match rule {
            Rule::NodeLeft => self.is_wanted(node).then(|| both(false)),
            Rule::NodeSign(octant) => self.is_wanted(node).then(|| both(octant >> cells[node as usize].axis & 1 == 1)),
            Rule::Children | Rule::Disjoint | Rule::Distance => {
                let [left, right] = pair.map(|child| &cells[child as usize]);
                match pair.map(|child| self.is_wanted(child)) {
                    [false, false] => None,
                    [true, false] => Some(one(false)),
                    [false, true] => Some(one(true)),
                    [true, true] => {
                        let right_first =
                            right.enter < left.enter || right.enter == left.enter && cells[node as usize].right_first;
                        let (first, second) = if right_first { (right, left) } else { (left, right) };
                        let marked = first.exit.is_some_and(|exit| exit < second.enter);
                        Some(Decision { marked: marked && rule == Rule::Disjoint, ..both(right_first) })
                    }
                }
            }
        }
    }

    fn leaf(&mut self, node: u32) -> Stopped {
        let (cells, any, rule) = match self.search {
            Search::Script(script) => return script[node as usize] == b'!',
            Search::Cells { cells, any, rule } => (cells, any, rule),
        };
        let cell = &cells[node as usize];
        let counts = match rule {
            Rule::NodeLeft | Rule::NodeSign(_) => self.is_wanted(node),
            Rule::Children | Rule::Disjoint | Rule::Distance => !cell.miss,
        };
        let hit = cell.hit.filter(|_| counts).map(|t| Best { t, node });
        if let Some(hit) = hit.filter(|&hit| self.best.is_none_or(|best| hit < best)) {
            self.best = Some(hit);
            if any {
                return true;
            }
        }
        let is_found = self.best.is_some_and(|best| best.node == node && cell.exit.is_none_or(|exit| best.t <= exit));
        if rule == Rule::Disjoint && is_found {
            for (postponed, marked) in self.postponed.iter_mut().zip(&self.marks) {
                *postponed = postponed.filter(|_| !marked);
            }
        }
        false
    }
}

#[derive(Clone, Copy, Debug)]
struct Decision {
    right: bool,
    postpones: bool,
    marked: bool,
}

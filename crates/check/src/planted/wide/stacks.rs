//! A stack, and a restart trail with a short stack, with a mistake.

use super::links::Records;
use super::{Bug, sorted};
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Cursor, Next, Search, Topology, Wanted};

/// The child of a rank is postponed.
#[derive(Clone, Copy, Debug)]
struct Entry {
    level: usize,
    rank: u32,
    node: Node,
    is_last: bool,
}

fn is_beyond<const A: usize>(bug: Bug, rank: u32, end: u32) -> bool {
    let begin = rank & !(A as u32 - 1);
    match bug {
        Bug::PoppedNotCompared => false,
        Bug::PoppedEqualDropped => begin >= end,
        _ => begin > end,
    }
}

/// All postponed children.
#[derive(Debug)]
pub(super) struct Stack<'t, const A: usize> {
    tree: &'t Records<'t, A>,
    node: Node,
    entries: Vec<(u32, Node)>,
}

impl<'t, const A: usize> Stack<'t, A> {
    pub(super) fn new(tree: &'t Records<'t, A>) -> Self {
        Self { tree, node: tree.root(), entries: Vec::new() }
    }
}

impl<const A: usize> Cursor<A> for Stack<'_, A> {
    fn reset(&mut self, _: &impl Topology<A>) {
        self.node = self.tree.root();
        self.entries.clear();
    }

    fn node(&self) -> Node {
        self.node
    }

    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>,
    {
        let bug = self.tree.bug;
        if wanted.set == 0 {
            return self.next(tree, search);
        }
        let ranks = sorted::<A, S>(wanted);
        let child = |rank: u32| tree.child(self.node, rank & (A as u32 - 1));
        let mut others: Vec<_> = ranks[1..].iter().map(|&rank| (rank, child(rank))).collect();
        match bug {
            Bug::RankOfFirstPushed => others.iter_mut().for_each(|entry| entry.0 = ranks[0]),
            Bug::RankOfLastPushed => others.iter_mut().for_each(|entry| entry.0 = ranks[ranks.len() - 1]),
            Bug::LastNotPushed if others.len() > 2 => others.truncate(2),
            _ => {}
        }
        if bug != Bug::LeastPushedFirst {
            others.reverse();
        }
        self.entries.extend(others);
        Next::Child(child(ranks[0]))
    }

    fn next<T: Topology<A>, S: Search<A>>(&mut self, _: &T, search: &mut S) -> Next {
        let bug = self.tree.bug;
        while let Some((rank, node)) = self.entries.pop() {
            if !S::SORTED || !is_beyond::<A>(bug, rank, search.end()) {
                return Next::Child(node);
            }
            if bug == Bug::PoppedBeyondEnds {
                return Next::End;
            }
        }
        Next::End
    }

    fn enter(&mut self, node: Node) {
        self.node = node;
    }
}

/// How the node was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    Down,
    Again,
    Along,
}

/// For each level the number of the child that was named last, and whether it is the last one; two postponed children.
#[derive(Debug)]
pub(super) struct Restart<'t, const A: usize> {
    tree: &'t Records<'t, A>,
    node: Node,
    at: usize,
    done: Vec<(usize, bool)>,
    step: Step,
    stack: Vec<Entry>,
}

/// Entries of the short stack.
const ENTRIES: usize = 2;

impl<'t, const A: usize> Restart<'t, A> {
    pub(super) fn new(tree: &'t Records<'t, A>) -> Self {
        Self { tree, node: tree.root(), at: 0, done: vec![(0, false)], step: Step::Down, stack: Vec::new() }
    }

    const fn level(&self) -> usize {
        self.done.len() - 1
    }

    fn push(&mut self, entry: Entry) {
        if self.stack.len() == ENTRIES {
            if self.tree.bug == Bug::NewestLost {
                return;
            }
            self.stack.remove(0);
        }
        self.stack.push(entry);
    }

    fn name(&mut self, number: usize, is_last: bool) {
        let level = self.level();
        self.done[level] = (number, is_last);
    }

    fn finish(&mut self) {
        let level = self.level();
        self.done[level].1 = true;
    }

    fn take<S: Search<A>>(&mut self, wanted: Wanted<S::Ranks>, number: usize) -> Option<Node> {
        let ranks = sorted::<A, S>(wanted);
        let first = *ranks.get(number)?;
        let last = ranks.len() - 1;
        let child = |rank: u32| self.tree.child(self.node, rank & (A as u32 - 1));
        let entry = |i: usize| Entry { level: self.level(), rank: ranks[i], node: child(ranks[i]), is_last: i == last };
        let (node, others): (_, Vec<_>) = (child(first), (number + 1..=last).rev().map(entry).collect());
        for entry in others {
            self.push(entry);
        }
        let is_last = if self.tree.bug == Bug::FinishedEarly { number + 1 >= last } else { number == last };
        self.name(number, is_last);
        Some(node)
    }

    fn back<S: Search<A>>(&mut self, search: &S) -> Option<Node> {
        let bug = self.tree.bug;
        self.step = Step::Down;
        loop {
            while self.done.last()?.1 {
                self.done.pop();
            }
            let Some(entry) = self.stack.pop() else {
                self.step = Step::Again;
                return Some(self.tree.root());
            };
            if entry.level > self.level() && bug != Bug::EntryOfFinished {
                continue;
            }
            if S::SORTED && is_beyond::<A>(bug, entry.rank, search.end()) {
                self.finish();
            } else {
                let number = self.done.last()?.0;
                self.name(number + usize::from(bug != Bug::NumberNotCounted), entry.is_last);
                return Some(entry.node);
            }
        }
    }
}

impl<const A: usize> Cursor<A> for Restart<'_, A> {
    const RESTARTS: bool = true;

    fn reset(&mut self, _: &impl Topology<A>) {
        *self = Self::new(self.tree);
    }

    fn node(&self) -> Node {
        self.node
    }

    fn choose<T, S>(&mut self, tree: &T, wanted: Wanted<S::Ranks>, search: &mut S) -> Next
    where
        T: Topology<A>,
        S: Search<A>,
    {
        let bug = self.tree.bug;
        let done = self.done.last().map_or(0, |&(number, _)| number);
        if self.step != Step::Down && self.at < self.level() {
            let ranks = sorted::<A, S>(wanted);
            let number = self.done[self.at].0;
            if let Some(&rank) = ranks.get(if bug == Bug::PathANumberShort { number.saturating_sub(1) } else { number })
            {
                self.step = Step::Along;
                return Next::Child(self.tree.child(self.node, rank & (A as u32 - 1)));
            }
            self.done.truncate(self.at + 1);
            self.finish();
            return self.next(tree, search);
        }
        let number = match (self.step, bug) {
            (Step::Down, _) => 0,
            (_, Bug::RestartRepeats) => done,
            (_, Bug::RestartSkips) => done + 2,
            _ => done + 1,
        };
        self.step = Step::Down;
        if let Some(child) = self.take::<S>(wanted, number) {
            return Next::Child(child);
        }
        self.finish();
        self.next(tree, search)
    }

    fn next<T: Topology<A>, S: Search<A>>(&mut self, _: &T, search: &mut S) -> Next {
        self.back(search).into()
    }

    fn enter(&mut self, node: Node) {
        self.node = node;
        match self.step {
            Step::Again => self.at = 0,
            Step::Along => self.at += 1,
            Step::Down => self.done.push((0, false)),
        }
    }

    fn is_restarting(&self) -> bool {
        self.step != Step::Down && self.tree.bug != Bug::RestartVisits
    }
}

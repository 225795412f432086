//! A traversal by key, trail, register and parent references, as one would write it from the papers, and the mistakes
//! that one would make on the way.

use stackless_bvh::event::State;
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Node, Parents, Topology, Tree};

/// A mistake in [`Textbook`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bug {
    /// None: the control.
    None,
    /// No test for the end: a trail of 0 is backtracked like any other.
    NoExit,
    /// The trail's lowest bit stays set, so that the sibling seems postponed again.
    TrailNotToggled,
    /// The key stays that of the ancestor, and not of its sibling.
    KeyNotToggled,
    /// The climb is one level short.
    ShiftShort,
    /// The climb is one level too long.
    ShiftLong,
    /// The trail is shifted by a level less than the key.
    TrailShiftShort,
    /// A child that is not wanted counts as postponed.
    BothForOne,
    /// A postponed child is not noted.
    NoneForBoth,
    /// A descent to an only child forgets what was postponed above.
    OnlyChildForgets,
    /// Backtracking returns to the near child's side.
    NearTwice,
    /// Backtracking passes over the most recently postponed child.
    SkipsPostponed,
    /// The last postponed child is taken for the end.
    StopsOneShort,
    /// The child that was postponed first comes first.
    OldestFirst,
    /// Far before near.
    WrongOrder,
    /// The sibling's address where the uncle comes next.
    SiblingForUncle,
    /// The key does not move on backtracking.
    StaleKey,
    /// Every child gets the left child's key.
    LeftKeys,
    /// The key is cut to 4 bits, in trees that are deeper.
    NarrowKey,
    /// The trail is cut to 2 bits, in trees that are deeper.
    NarrowTrail,
    /// The register gets the near child.
    RegisterOfNear,
    /// The register is not cleared when it has been used.
    RegisterKept,
    /// The trail begins with a bit, as if the root had a sibling.
    TrailAboveRoot,
    /// Backtracking clears the trail's bit and does not shift.
    TrailNotShifted,
    /// The counter is shown without its leading one.
    CounterWithoutStart,
    /// The end is where the key, shifted by as many bits as the word has, is that of the root: processors do not shift it.
    ShiftByWord,
    /// The sibling is the neighbour in the array, as in a heap.
    AddressToggled,
    /// It starts again at the end, and again.
    Endless,
}

/// Key, trail, register and address of one node.
pub(super) struct Textbook<'t> {
    tree: &'t Tree,
    parents: Parents,
    bug: Bug,
    node: Node,
    key: u64,
    trail: u64,
    register: Option<Node>,
    restarting: bool,
}

impl<'t> Textbook<'t> {
    pub(super) fn new(tree: &'t Tree, bug: Bug) -> Self {
        let trail = u64::from(bug == Bug::TrailAboveRoot);
        let parents = Parents::of(tree);
        Self { tree, parents, bug, node: tree.root(), key: 1, trail, register: None, restarting: false }
    }

    fn level_start(&self) -> u64 {
        1 << self.key.max(1).ilog2()
    }
}

impl Cursor for Textbook<'_> {
    type Word = u64;

    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<u64> {
        let start = self.level_start();
        let counter = self.trail ^ (start - 1);
        // Where the key itself is wrong on purpose, so would be all that is derived from it.
        let shown = !matches!(self.bug, Bug::KeyNotToggled | Bug::StaleKey | Bug::NarrowKey);
        State {
            node: self.node,
            key: Some(self.key),
            trail: Some(self.trail),
            counter: shown.then_some(if self.bug == Bug::CounterWithoutStart { counter } else { start | counter }),
            disjoint: None,
            register: self.register,
            is_restarting: self.restarting,
        }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        let bug = self.bug;
        let swapped = bug == Bug::WrongOrder && descent.postpones();
        let side = if swapped { descent.first().other() } else { descent.first() };
        let [near, far] = [side, side.other()].map(|side| self.tree.child(self.node, side));
        let both = match bug {
            Bug::BothForOne => true,
            Bug::NoneForBoth => false,
            _ => descent.postpones(),
        };
        if both {
            self.register = Some(if bug == Bug::RegisterOfNear { near } else { far });
        } else if bug == Bug::OnlyChildForgets {
            (self.trail, self.register) = (0, None);
        }
        self.node = near;
        self.key = self.key << 1 | u64::from(side.is_right() && bug != Bug::LeftKeys);
        self.trail = self.trail << 1 | u64::from(both);
        match bug {
            Bug::NarrowKey => self.key &= 0xf,
            Bug::NarrowTrail => self.trail &= 0x3,
            _ => {}
        }
        true
    }

    fn backtrack(&mut self) -> bool {
        let bug = self.bug;
        if bug == Bug::SkipsPostponed {
            self.trail &= self.trail.wrapping_sub(1);
        }
        let is_last = bug == Bug::StopsOneShort && self.trail.is_power_of_two();
        if self.trail == 0 && bug == Bug::Endless {
            (self.node, self.key, self.register, self.restarting) = (self.tree.root(), 1, None, true);
            return true;
        }
        if self.trail == 0 && !matches!(bug, Bug::NoExit | Bug::ShiftByWord) || is_last {
            return false;
        }
        let levels = match bug {
            Bug::ShiftShort => self.trail.trailing_zeros().saturating_sub(1),
            Bug::ShiftLong => self.trail.trailing_zeros() + 1,
            Bug::OldestFirst => self.trail.ilog2(),
            Bug::ShiftByWord => self.trail.trailing_zeros() % u64::BITS,
            _ => self.trail.trailing_zeros().min(63),
        };
        let climbed = if bug == Bug::SiblingForUncle && levels == 1 { 0 } else { levels };
        let ancestor = (0..climbed).fold(self.node, |node, _| self.parents.row(self.tree, node)[0]);
        let sibling = self.parents.row(self.tree, ancestor)[1];
        let neighbour = || self.tree.node(self.tree.slot(ancestor) as u32 ^ 1).unwrap_or(self.tree.root());
        self.node = match bug {
            Bug::NearTwice => ancestor,
            Bug::AddressToggled => neighbour(),
            _ => sibling,
        };
        self.key = match bug {
            Bug::KeyNotToggled | Bug::NearTwice => self.key >> levels,
            Bug::StaleKey => self.key,
            _ => self.key >> levels ^ 1,
        };
        self.trail = match bug {
            Bug::TrailNotToggled => self.trail >> levels,
            Bug::TrailShiftShort => self.trail >> levels.saturating_sub(1) & !1,
            Bug::TrailNotShifted => self.trail & (self.trail - 1),
            _ => self.trail >> levels ^ 1,
        };
        if bug != Bug::RegisterKept {
            self.register = None;
        }
        true
    }
}

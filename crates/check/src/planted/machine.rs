//! A traversal by key, trail and register, as one would write it from the papers, and the mistakes that one would make
//! on the way.

use stackless_bvh::event::State;
use stackless_bvh::generate::Tape;
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::order::{Descent, Side};
use stackless_bvh::traverse::Cursor;
use stackless_bvh::tree::{Keys, Node, Parents, Reach, Topology, Tree, Uncles};

/// What is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Text {
    /// Key, trail and register, and a climb along parents.
    Climb,
    /// Algorithm 1 of Binder & Keller 2016: uncles fill the register, and keys that they do not reach are looked up.
    Algorithm1,
    /// The same with the second trail of Section 2.3.
    SecondTrail,
    /// And put aside and taken up by key and trail alone before each step, as in Section 2.4.
    Resumed,
}

/// The mistakes, and the list of them: in which texts each is made, and the clauses that it breaks there.
macro_rules! bugs {
    ($($(#[$what:meta])* $bug:ident: $($text:ident $clause:literal),*;)*) => {
        /// A mistake in [`Machine`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Bug {
            /// None: the control.
            None,
            $($(#[$what])* $bug,)*
        }

        pub(super) const BUGS: &[(Text, Bug, &str)] = &[$($((Text::$text, Bug::$bug, $clause),)*)*];
    };
}

bugs! {
    /// No test for the end: a trail of 0 is backtracked like any other.
    NoExit: Climb "TRAIL-3";
    /// The trail's lowest bit stays set, so that the sibling seems postponed again.
    TrailNotToggled: Climb "TRAIL-4";
    /// The key stays that of the ancestor, and not of its sibling.
    KeyNotToggled: Climb "TRAIL-4";
    /// The climb is one level short.
    ShiftShort: Climb "TRAIL-4";
    /// The climb is one level too long.
    ShiftLong: Climb "TRAIL-4";
    /// The trail is shifted by a level less than the key.
    TrailShiftShort: Climb "TRAIL-4";
    /// A child that is not wanted counts as postponed.
    BothForOne: Climb "TRAIL-2";
    /// A postponed child is not noted.
    NoneForBoth: Climb "TRAIL-2";
    /// A descent to an only child forgets what was postponed above.
    OnlyChildForgets: Climb "TRAIL-2";
    /// Backtracking returns to the near child's side.
    NearTwice: Climb "TRAIL-4";
    /// Backtracking passes over the most recently postponed child.
    SkipsPostponed: Climb "TRAIL-3";
    /// The last postponed child is taken for the end.
    StopsOneShort: Climb "TRAIL-3";
    /// The child that was postponed first comes first.
    OldestFirst: Climb "TRAIL-3";
    /// Far before near.
    WrongOrder: Climb "ORDER-1";
    /// The sibling's address where the uncle comes next.
    SiblingForUncle: Climb "REGISTER-1";
    /// The key does not move on backtracking.
    StaleKey: Climb "TRAIL-4";
    /// Every child gets the left child's key.
    LeftKeys: Climb "KEY-2";
    /// The key is cut to 4 bits, in trees that are deeper.
    NarrowKey: Climb "DEPTH-1";
    /// The trail is cut to 2 bits, in trees that are deeper.
    NarrowTrail: Climb "DEPTH-1";
    /// The register gets the near child.
    RegisterOfNear: Climb "REGISTER-1";
    /// The register is filled from the leaf's record before the mask is applied.
    FillBeforeMask: SecondTrail "DISJOINT-3";
    /// The register keeps a node that has been visited, or that the mask has taken from the trail.
    RegisterKept: Climb "REGISTER-2", SecondTrail "DISJOINT-3";
    /// The register is emptied after every hit: the sibling, which no record names, is lost.
    RegisterLost: SecondTrail "DISJOINT-3";
    /// The trail begins with a bit, as if the root had a sibling.
    TrailAboveRoot: Climb "TRAIL-1";
    /// Backtracking clears the trail's bit and does not shift.
    TrailNotShifted: Climb "TRAIL-4";
    /// The counter is shown without its leading one.
    CounterWithoutStart: Climb "SPARSE-1";
    /// The end is where the key, shifted by as many bits as the word has, is that of the root: processors do not shift
    /// it.
    ShiftByWord: Climb "TRAIL-3";
    /// The sibling is the neighbour in the array, as in a heap.
    AddressToggled: Climb "TRAIL-4";
    /// It starts again at the end, and again.
    Endless: ;
    /// The mask is taken for what its name says.
    MaskInverted: SecondTrail "DISJOINT-1";
    /// The mask does not move with the trail on a descent.
    MaskNotShifted: SecondTrail "DISJOINT-1";
    /// The mask does not move with the trail on backtracking.
    MaskLeftBehind: SecondTrail "DISJOINT-1";
    /// The register is filled after resuming though the sibling is postponed, which comes before the uncle.
    NoGuard: Resumed "PAUSE-3";
    /// `closest` is computed from missed boxes too.
    ClosestOfMissed: Algorithm1 "ORDER-1";
    /// The last `else` belongs to the nearest `if`.
    DanglingElse: Algorithm1 "HASHED-1";
    /// `done` is -1, which is also the address of the first leaf.
    DoneIsMinusOne: Algorithm1 "TRAIL-3";
    /// A tree of any depth, in words of 8 bits.
    AnyDepth: Algorithm1 "DEPTH-1";
}

/// Key, trail, mask, register and address of one node. `PRUNES`: it has the mask.
pub(super) struct Machine<'t, const PRUNES: bool> {
    tree: &'t Tree,
    tape: &'t Tape,
    text: Text,
    bug: Bug,
    parents: Parents,
    uncles: Uncles,
    /// By slot: whether the table has the key.
    known: Vec<bool>,
    node: Node,
    key: u64,
    trail: u64,
    /// 1: not disjoint.
    mask: u64,
    register: Option<Node>,
    restarting: bool,
}

impl<'t, const PRUNES: bool> Machine<'t, PRUNES> {
    pub(super) fn new(tree: &'t Tree, tape: &'t Tape, text: Text, bug: Bug) -> Self {
        let key_set = if text == Text::SecondTrail { KeySet::Exact(Reach::ALGORITHM_1) } else { KeySet::All };
        Self {
            tree,
            tape,
            text,
            bug,
            parents: Parents::of(tree),
            uncles: Uncles::of(tree),
            known: key_set.slots(tree),
            node: tree.root(),
            key: 1,
            trail: u64::from(bug == Bug::TrailAboveRoot),
            mask: 0,
            register: None,
            restarting: false,
        }
    }

    /// Fills the register from the node's record.
    fn load(&mut self) {
        if self.text == Text::Climb {
            return;
        }
        if self.text == Text::Resumed {
            self.register = None;
            if self.trail & 1 == 1 && self.bug != Bug::NoGuard {
                return;
            }
        }
        if self.register.is_none() && self.trail & 6 != 0 {
            let [uncle, grand_uncle, _] = self.uncles.row(self.tree, self.node);
            self.register = Some(if self.trail & 2 != 0 { uncle } else { grand_uncle });
        }
    }

    /// The node so many levels up and over.
    fn climb(&self, levels: u32) -> Node {
        let levels = if self.bug == Bug::SiblingForUncle && levels == 1 { 0 } else { levels };
        let ancestor = (0..levels).fold(self.node, |node, _| self.parents.row(self.tree, node)[0]);
        match self.bug {
            Bug::NearTwice => ancestor,
            Bug::AddressToggled => self.tree.node(self.tree.slot(ancestor) as u32 ^ 1).unwrap_or(self.tree.root()),
            _ => self.parents.row(self.tree, ancestor)[1],
        }
    }

    /// The node of the key; another one, here the root, where the table does not have it.
    fn look_up(&self) -> Node {
        let found = Keys::walk(self.tree, &self.key).filter(|&node| self.known[self.tree.slot(node)]);
        let found = found.unwrap_or(self.tree.root());
        if self.bug != Bug::DanglingElse {
            return found;
        }
        let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::PrintedHashed };
        let is_direct = PerfectHash::build(self.tree, options).is_ok_and(|table| table.is_direct(&self.key));
        match (is_direct, found.is_leaf()) {
            // d < 0 and an inner node: as meant.
            (true, false) => found,
            // d < 0 and a leaf: on to the other table, with the leaf for a displacement.
            (true, true) => self.tree.root(),
            // Not direct: nothing is done, and the address stays what it was.
            (false, _) => self.node,
        }
    }

    fn is_first_leaf(&self) -> bool {
        let nodes = (0..self.tree.node_count() as u32).filter_map(|index| self.tree.node(index));
        nodes.into_iter().find(|node| node.is_leaf()) == Some(self.node)
    }
}

impl<const PRUNES: bool> Cursor for Machine<'_, PRUNES> {
    type Word = u64;
    const PRUNES: bool = PRUNES;

    fn node(&self) -> Node {
        self.node
    }

    fn state(&self) -> State<u64> {
        let is_climb = self.text == Text::Climb;
        // Where the key itself is wrong on purpose, so would be all that is derived from it.
        let has_counter = is_climb && !matches!(self.bug, Bug::KeyNotToggled | Bug::StaleKey | Bug::NarrowKey);
        let start = 1 << self.key.max(1).ilog2();
        let shown = if self.bug == Bug::CounterWithoutStart { 0 } else { start };
        State {
            key: Some(self.key),
            trail: (!PRUNES).then_some(self.trail),
            counter: has_counter.then_some(shown | self.trail ^ (start - 1)),
            register: self.register.filter(|_| is_climb),
            is_restarting: self.restarting,
            ..State::of(self.node)
        }
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.load();
        let (bug, both) = (self.bug, descent.postpones());
        let is_right_closer = self.tape.cells()[self.tree.slot(self.node)].right_first;
        let first = match bug {
            Bug::WrongOrder if both => descent.first().other(),
            // "if not hitL or closest = R": right whenever the right box is closer, hit or not.
            Bug::ClosestOfMissed if !both && is_right_closer => Side::Right,
            _ => descent.first(),
        };
        let [near, far] = [first, first.other()].map(|side| self.tree.child(self.node, side));
        let both = both && bug != Bug::NoneForBoth || bug == Bug::BothForOne;
        if both {
            self.register = Some(if bug == Bug::RegisterOfNear { near } else { far });
        } else if bug == Bug::OnlyChildForgets {
            (self.trail, self.register) = (0, None);
        }
        let (key_bits, trail_bits) = match bug {
            Bug::NarrowKey => (0xf, u64::MAX),
            Bug::NarrowTrail => (u64::MAX, 0x3),
            Bug::AnyDepth => (0xff, 0xff),
            _ => (u64::MAX, u64::MAX),
        };
        self.node = near;
        self.key = (self.key << 1 | u64::from(first.is_right() && bug != Bug::LeftKeys)) & key_bits;
        self.trail = (self.trail << 1 | u64::from(both)) & trail_bits;
        let overlap = u64::from(descent.is_disjoint() == (bug == Bug::MaskInverted));
        self.mask = if bug == Bug::MaskNotShifted { self.mask | overlap } else { self.mask << 1 | overlap };
        true
    }

    fn prune(&mut self) {
        let is_lowest_gone = self.trail & self.trail.wrapping_neg() & self.mask == 0;
        if is_lowest_gone && self.bug != Bug::RegisterKept || self.bug == Bug::RegisterLost {
            self.register = None;
        }
        if self.bug == Bug::FillBeforeMask {
            self.load();
        }
        self.trail &= self.mask;
    }

    fn backtrack(&mut self) -> bool {
        let bug = self.bug;
        self.load();
        if bug == Bug::SkipsPostponed {
            self.trail &= self.trail.wrapping_sub(1);
        }
        if self.trail == 0 && bug == Bug::Endless {
            (self.node, self.key, self.register, self.restarting) = (self.tree.root(), 1, None, true);
            return true;
        }
        let is_last = bug == Bug::StopsOneShort && self.trail.is_power_of_two();
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
        if bug != Bug::MaskLeftBehind {
            self.mask >>= levels;
        }
        if self.text == Text::Climb {
            self.node = self.climb(levels);
            self.register = self.register.filter(|_| bug == Bug::RegisterKept);
        } else {
            self.node = self.register.take().unwrap_or_else(|| self.look_up());
        }
        bug != Bug::DoneIsMinusOne || !self.is_first_leaf()
    }
}

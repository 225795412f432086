//! Traversals of wide trees with a mistake: small copies, as one would write them from the clauses.

mod kept;
mod links;
mod pending;
mod stacks;

use self::kept::{Ranked, Trail};
use self::links::{ByKey, ByRecord, Climb, Records};
use self::pending::Pending;
use self::stacks::{Restart, Stack};
use super::draw::Draw;
use super::layers::{Instead, Mistake};
use crate::WideCase;
use crate::wide::{Watch, visits};
use stackless_bvh::generate::Source;
use stackless_bvh::key::TooDeep;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{self, Cursor, Ranks, Search, Topology, Tree, Unfit, Wanted};

/// What is copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Text {
    /// A trail, by parents.
    Trail,
    /// Ranks, by parents.
    Ranked,
    /// Ranks, by references in the record.
    ByRecord,
    /// Ranks, by keys.
    ByKey,
    /// A stack.
    Stack,
    /// Restarts, with a short stack of two entries.
    Restart,
    /// The library's own, by references, over a tree that is described wrongly.
    Library,
    /// The library's own with a trail of 32 bits, over such a tree.
    Narrow,
}

macro_rules! of {
    ($text:expr, $bug:expr, $clause:literal, $name:literal) => {
        Mistake::new($name, $clause, |draw| fault(draw, $text, $bug), Instead::Wide(WidePlanted($text, $bug)))
    };
}

/// The mistakes, and the list of them: where each is made, the clause that it breaks, and what it is called.
macro_rules! bugs {
    ($($text:ident $bug:ident $clause:literal $name:literal;)*) => {
        /// A mistake.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum Bug {
            /// None: the control.
            None,
            $($bug,)*
        }

        const COUNT: usize = [$($name),*].len();

        pub(super) const MISTAKES: [Mistake; COUNT] = [$(of!(Text::$text, Bug::$bug, $clause, $name)),*];
    };
}

bugs! {
    Trail ZerosNotDivided "WIDE-11" "zeros of the trail are taken for levels";
    Trail ZerosRoundedUp "WIDE-11" "zeros of the trail are divided and rounded up";
    Trail FarthestGroup "WIDE-11" "the group farthest up comes first";
    Trail GroupNarrow "WIDE-11" "the pending set is cut to A - 1 bits";
    Trail RestShort "WIDE-11" "the group stays in the trail";
    Trail RestLong "WIDE-11" "the trail is shifted by a group too many";
    Trail LevelsShort "WIDE-11" "the ancestor is a level short of the group";
    Trail GroupShiftShort "WIDE-10" "the trail of a child is shifted by A - 1 bits";
    Trail NothingPushed "WIDE-10" "pending children are not noted in the trail";
    Trail PendingAboveRoot "WIDE-10" "the trail of the root is 1";
    Trail TakenStaysPending "WIDE-11" "a child that is taken stays pending";
    Trail EnteredStaysPending "WIDE-10" "the slot that is entered is pushed with the others";
    Trail StaleNotSet "WIDE-18" "that the end has changed is not noted";
    Trail StaleHereOnly "WIDE-18" "that the end has changed is noted for the present node alone";
    Trail StaleAboveOnly "WIDE-18" "that the end has changed is noted for the nodes above alone";
    Trail StaleShiftedTwice "WIDE-18" "dirty bits are shifted by two on the way down";
    Trail StaleShiftShort "WIDE-18" "dirty bits are shifted by one too few on the way back";
    Trail StaleAllCleared "WIDE-18" "a question clears the dirty bits of all levels";
    Trail StaleIgnored "WIDE-18" "a single child is taken though the end has changed";
    Trail NeverAskedAgain "WIDE-18" "pending children are taken by slot, and nothing is asked again";
    Trail AnswerNotMasked "WIDE-18" "what is answered again is not cut to the pending set";
    Trail LastSlotFirst "WIDE-6" "without an order the last slot comes first";
    Trail NodeLeftBehind "WIDE-11" "the node stays where it is on the way back";
    Trail ParentsShort "WIDE-15" "the climb along parents is a level short";
    Trail ParentsLong "WIDE-15" "the climb along parents is a level too long";
    Ranked SummaryOfEmpty "WIDE-17" "the summary has levels without pending children";
    Ranked SummaryOfKnown "WIDE-17" "the summary has levels with known ranks only";
    Ranked SummaryNotCleared "WIDE-17" "the summary bit is not cleared";
    Ranked LowestSummary "WIDE-17" "the lowest summary bit is the level to go back to";
    Ranked LevelNotRestored "WIDE-17" "the level is not restored on the way back";
    Ranked SetsJoined "WIDE-17" "pending sets are joined with those of before";
    Ranked RanksOfBefore "WIDE-17" "where no rank is known that of another node stays";
    Ranked PushedRankExchanged "WIDE-17" "the two ranks are pushed in the wrong order";
    Ranked SecondThirdExchanged "WIDE-17" "ranks of the second and the third are exchanged";
    Ranked ThirdForSecond "WIDE-17" "the third is taken for the second";
    Ranked SecondTwice "WIDE-17" "the second comes twice";
    Ranked FirstForSecond "WIDE-17" "the rank of the first is kept for the second";
    Ranked ChildOfFirstKept "WIDE-17" "beside the rank of the second is the address of the first";
    Ranked ChildOfSecondKept "WIDE-17" "beside the rank of the third is the address of the second";
    Ranked RanksNotMoved "WIDE-17" "the rank of a child that is taken stays the next one";
    Ranked OrderOfSlots "WIDE-5" "children come in the order of their slots";
    Ranked GreatestFirst "WIDE-5" "the greatest rank comes first";
    Ranked FirstTwoExchanged "WIDE-5" "the second comes before the first";
    Ranked ThirdCompared "WIDE-17" "a level is dropped if its third is beyond";
    Ranked KeptRankNotCleared "WIDE-3" "slots count where a level's rank is compared with the end";
    Ranked KeptEqualDropped "WIDE-3" "a level that begins at the end is dropped";
    Ranked BeyondEnds "WIDE-17" "a level that is beyond ends the search";
    Ranked BeyondDropsTwo "WIDE-17" "a level that is beyond takes the one above with it";
    Ranked EqualIsBeyond "WIDE-3" "a child that begins at the end is beyond";
    Ranked RankNotCleared "WIDE-3" "slots count where a child's rank is compared with the end";
    Ranked NotCompared "WIDE-3" "a child whose rank is known is not compared with the end";
    ByRecord NotRepeated "WIDE-15" "beyond A levels the last reference is taken";
    ByRecord FarNotFollowed "WIDE-15" "beyond A levels only the rest is climbed";
    ByRecord FarCountsLess "WIDE-15" "a step of A levels counts one less";
    ByKey KeyShiftLong "WIDE-9" "the key of a child is shifted by B + 1 bits";
    ByKey KeyShiftByOne "WIDE-9" "the key of a child is shifted by one bit";
    ByKey SlotLost "WIDE-9" "the slot is lost from the key of a child";
    ByKey SlotsFromOne "WIDE-9" "slots count from 1 in keys";
    ByKey KeyShiftByLevels "WIDE-9" "the key of an ancestor is shifted by levels and not by B levels";
    ByKey KeyLeftBehind "WIDE-15" "the key stays that of the node below";
    ByKey KeyNotReset "WIDE-9" "the next search begins with the key of the last one";
    ByKey KeysOfPairsMissing "WIDE-16" "nodes with one other child are not hashed";
    ByKey KeysBesideLeavesMissing "WIDE-16" "nodes with one inner child are not hashed";
    Stack LeastPushedFirst "WSTACK-1" "the least rank is pushed first";
    Stack PoppedNotCompared "WSTACK-1" "what is popped is not compared with the end";
    Stack PoppedEqualDropped "WIDE-3" "what is popped and begins at the end is dropped";
    Stack RankOfFirstPushed "WSTACK-1" "the rank of the first child is pushed with all";
    Stack RankOfLastPushed "WSTACK-1" "the rank of the last child is pushed with all";
    Stack LastNotPushed "WSTACK-1" "of more than three children the last are lost";
    Stack PoppedBeyondEnds "WSTACK-1" "an entry that is beyond ends the search";
    Restart RestartVisits "WRESTART-1" "what is passed on the way down again is visited";
    Restart RestartRepeats "WRESTART-1" "a restart names the last child again";
    Restart RestartSkips "WRESTART-1" "a restart passes over a child that is not done";
    Restart FinishedEarly "WRESTART-1" "a level is taken for done when one child is left";
    Restart EntryOfFinished "WRESTART-1" "an entry of a finished level is taken";
    Restart NumberNotCounted "WRESTART-1" "an entry of the short stack does not count as done";
    Restart NewestLost "WRESTART-1" "a full short stack loses the newest entry";
    Restart PathANumberShort "WRESTART-1" "the path goes by the child before";
    Library LeavesInSlotOrder "WIDE-6" "without an order leaves do not come first";
    Library RecordsANodeShort "WIDE-15" "references begin with the node itself";
    Library RecordsANodeLong "WIDE-15" "references begin with the parent's parent";
    Library RecordsBackwards "WIDE-15" "references begin with the farthest";
    Library LastRecordMissing "WIDE-15" "the last reference is missing";
    Narrow LevelsSaidShort "WIDE-14" "a tree of one level more than the trail has is not refused";
}

pub(super) const CONTROLS: [Mistake; 8] = [
    of!(Text::Trail, Bug::None, "WTRAIL-1", "a trail, copied"),
    of!(Text::Ranked, Bug::None, "WIDE-17", "ranks, copied"),
    of!(Text::ByRecord, Bug::None, "WRECORD-1", "references, copied"),
    of!(Text::ByKey, Bug::None, "WHASHED-1", "keys, copied"),
    of!(Text::Stack, Bug::None, "WSTACK-1", "a stack, copied"),
    of!(Text::Restart, Bug::None, "WRESTART-1", "a restart trail, copied"),
    of!(Text::Library, Bug::None, "WRECORD-1", "references over a wrapped tree"),
    of!(Text::Narrow, Bug::None, "WIDE-14", "a trail of 32 bits over a wrapped tree"),
];

fn fault(draw: &mut Draw<'_>, text: Text, bug: Bug) -> Option<String> {
    if text == Text::Narrow {
        // The trail of 32 bits has 4 levels of eight children.
        return differs(&WideCase::<8>::draw(draw, 64, 8, 60), text, bug);
    }
    match draw.below(3) {
        0 => differs(&WideCase::<4>::draw(draw, 24, 8, 12), text, bug),
        1 => differs(&WideCase::<8>::draw(draw, 40, 8, 30), text, bug),
        _ => differs(&WideCase::<2>::draw(draw, 16, 4, 8), text, bug),
    }
}

fn differs<const A: usize>(case: &WideCase<A>, text: Text, bug: Bug) -> Option<String> {
    // What is too deep is no mistake.
    if WidePlanted(text, bug).fits(&case.tree).is_err() {
        return None;
    }
    if text == Text::Restart && case.is_sorted && !case.tape.is_monotone() {
        return None;
    }
    let expected = case.expected();
    let fault = case.compare(&format!("{bug:?}"), &expected, |watch| run(&case.tree, text, bug, watch)).err()?;
    Some(format!("{fault}\n{case:?}"))
}

/// A copy with a mistake, or, as a control, without one.
#[derive(Clone, Copy, Debug)]
pub struct WidePlanted(Text, Bug);

impl WidePlanted {
    /// The greatest level of an inner node that it carries, in trees of so many slots a node.
    pub const fn carries(self, slots: u32) -> u32 {
        match self.0 {
            Text::Trail => u128::BITS / slots,
            Text::Narrow => u32::BITS / slots,
            _ => 32,
        }
    }

    /// Whether it carries a tree. The library refuses for itself.
    fn fits<const A: usize>(self, tree: &Tree<A>) -> Result<(), TooDeep> {
        let (depth, limit) = (tree.levels(), self.carries(A as u32));
        if depth <= limit || matches!(self.0, Text::Library | Text::Narrow) {
            Ok(())
        } else {
            Err(TooDeep { depth, limit, word: "a copy" })
        }
    }

    /// The nodes that its second search visits, one more than `most` at the most: a cursor is made for one search after
    /// the other. `None` where it asks for ever.
    ///
    /// # Errors
    /// The tree has too many levels.
    pub fn visits<const A: usize, S: Search<A>>(
        self,
        tree: &Tree<A>,
        search: impl Fn() -> S,
        most: usize,
    ) -> Result<Option<Vec<Node>>, Unfit> {
        let Self(text, bug) = self;
        self.fits(tree)?;
        let mut second = Second { search, most, seen: None };
        run(tree, text, bug, &mut second)?;
        Ok(second.seen)
    }
}

/// Runs a cursor twice, and notes what it visits the second time.
struct Second<F> {
    search: F,
    most: usize,
    seen: Option<Vec<Node>>,
}

/// Whoever runs a cursor.
trait Run<const A: usize> {
    fn run(&mut self, tree: &impl Topology<A>, cursor: &mut impl Cursor<A>);
}

impl<const A: usize> Run<A> for Watch<'_, A> {
    fn run(&mut self, tree: &impl Topology<A>, cursor: &mut impl Cursor<A>) {
        self.run_over(tree, cursor);
    }
}

impl<const A: usize, S: Search<A>, F: Fn() -> S> Run<A> for Second<F> {
    fn run(&mut self, tree: &impl Topology<A>, cursor: &mut impl Cursor<A>) {
        for _ in 0..2 {
            cursor.reset(tree);
            self.seen = visits(tree, &mut (self.search)(), cursor, self.most);
        }
    }
}

fn run<const A: usize>(tree: &Tree<A>, text: Text, bug: Bug, to: &mut impl Run<A>) -> Result<(), Unfit> {
    let records = &Records { tree, bug };
    match text {
        Text::Trail => to.run(records, &mut Pending::new(records, Trail::new(bug), Climb(bug))),
        Text::Ranked => to.run(records, &mut Pending::new(records, Ranked::new(bug), Climb(bug))),
        Text::ByRecord => to.run(records, &mut Pending::new(records, Ranked::new(bug), ByRecord(bug))),
        Text::ByKey => to.run(records, &mut Pending::new(records, Ranked::new(bug), ByKey::of(tree, bug))),
        Text::Stack => to.run(records, &mut Stack::new(records)),
        Text::Restart => to.run(records, &mut Restart::new(records)),
        Text::Library => {
            to.run(records, &mut wide::Pending::new(records, wide::Ranked::default(), wide::Recorded)?);
        }
        Text::Narrow => match wide::Pending::new(records, wide::Trail::<u32>::default(), wide::Parents) {
            Ok(mut cursor) => to.run(records, &mut cursor),
            // It refuses the tree, whatever number of levels it takes it to have.
            Err(error) => return Err(TooDeep { depth: tree.levels(), ..error }.into()),
        },
    }
    Ok(())
}

/// The wanted children's ranks, in the order in which they come.
fn sorted<const A: usize, S: Search<A>>(wanted: Wanted<S::Ranks>) -> Vec<u32> {
    let slots = (0..A as u32).filter(|slot| wanted.set >> slot & 1 == 1);
    let mut ranks: Vec<_> = slots.map(|slot| if S::SORTED { wanted.ranks.rank(slot) } else { slot }).collect();
    ranks.sort_unstable();
    ranks
}

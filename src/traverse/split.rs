//! Depth beyond a word: a tree is cut every few levels, and each piece is traversed in a word that carries it.
//!
//! Binder & Keller 2016, Section 3: "instances also can be used to extend traversal depth at the cost of just a few
//! registers". A node at a cut is a leaf of the piece above it and the root of the piece below. Key and trail of the
//! piece below start again there. The state of the piece above waits, at that node, until the piece below is done. Only
//! pieces on the path from the root to the node wait, so the state is that of one traversal for each `levels` edges of
//! depth: [`Cuts::state_bytes`].
//!
//! References out of a piece are never followed. A climb (by parents, uncles) uses the trail of the piece, which has no
//! bit at or above the depth of the node below the cut. So the links of the whole tree serve all pieces. Lookups by
//! keys have a table for each piece: [`Cuts::tables`].

mod cuts;

pub use cuts::{Cuts, Piece, PieceTable};

use alloc::vec::Vec;
use core::fmt::Debug;
use core::mem::replace;

use super::Cursor;
use crate::event::State;
use crate::key::{self, Grow, KeyWord, Word};
use crate::order::Descent;
use crate::tree::{Node, Topology};

/// A traversal, piece by piece, by cursors of one type. `[DEPTH-4]`
///
/// ```
/// use stackless_bvh::generate::{Family, Kind, Rng, Search, Tape};
/// use stackless_bvh::traverse::{Afra, Cuts, Split, Stack, traverse};
/// use stackless_bvh::tree::{Linked, Topology};
///
/// let mut rng = Rng::new(1);
/// let tree = Family::Comb.tree(&mut rng, 1001);
/// let tape = Tape::draw(&mut rng, &tree, Kind::Shrinking);
/// let linked = Linked::parents(&tree);
/// let cuts = Cuts::every(31, &linked);
///
/// let (mut waiting, mut search) = (Vec::new(), Search::new(&tree, &tape, false));
/// assert!(Afra::<u32, _>::new(&linked).is_err());
/// let split = Split::new(&cuts, &mut waiting, Afra::<u32, _>::new)?;
/// traverse(split, &mut search, &mut ());
///
/// let mut reference = Search::new(&tree, &tape, false);
/// traverse(Stack::new(&tree, &mut Vec::new()), &mut reference, &mut ());
/// assert_eq!(search.outcome, reference.outcome);
/// # Ok::<(), stackless_bvh::traverse::Unsupported>(())
/// ```
#[derive(Debug)]
pub struct Split<'m, 'c, T, C, F> {
    cuts: &'c Cuts<'c, T>,
    start: F,
    /// The cursor in the piece of the current node.
    cursor: C,
    /// The cursors in the pieces above, the root's first, each at the root of the piece below.
    waiting: &'m mut Vec<C>,
}

impl<'m, 'c, T, C, F, E> Split<'m, 'c, T, C, F>
where
    T: Topology,
    C: Cursor,
    F: Fn(&'c Piece<'c, T>) -> Result<C, E>,
{
    /// Starts at the root. `start` makes a cursor at the root of a piece. The caller owns the memory for the waiting
    /// states: traversals can share it.
    ///
    /// All pieces report the same [`depth`](Topology::depth), so the constructors of cursors accept all pieces or none.
    /// If `start` refused one after it accepted the first, its nodes would be skipped (and debug builds would panic).
    ///
    /// # Errors
    /// Those of `start`, for example if the cursor's word does not carry the levels between cuts.
    #[inline]
    pub fn new(cuts: &'c Cuts<'c, T>, waiting: &'m mut Vec<C>, start: F) -> Result<Self, E> {
        waiting.clear();
        let cursor = start(cuts.top())?;
        Ok(Self { cuts, start, cursor, waiting })
    }

    /// Returns whether the current node is the root of the current piece: only cursors that restart return to it.
    #[inline]
    fn is_back_at_cut(&self) -> bool {
        C::RESTARTS && self.waiting.last().is_some_and(|above| above.node() == self.cursor.node())
    }
}

impl<'c, T, C, F, E> Cursor for Split<'_, 'c, T, C, F>
where
    T: Topology,
    C: Cursor,
    F: Fn(&'c Piece<'c, T>) -> Result<C, E>,
    E: Debug,
{
    type Word = Grow;
    const RESTARTS: bool = C::RESTARTS;
    const PRUNES: bool = C::PRUNES;

    #[inline]
    fn node(&self) -> Node {
        self.cursor.node()
    }

    /// Key and counter are those of the whole tree. The trail is the piece's.
    fn state(&self) -> State<Grow> {
        let State { node, trail, register, is_restarting, .. } = self.cursor.state();
        State {
            node,
            key: joined(self.waiting, &self.cursor, |state| state.key),
            trail: trail.map(|trail| append(Grow::zero(), &trail, trail.bit_length())),
            counter: joined(self.waiting, &self.cursor, |state| state.counter),
            disjoint: None,
            register,
            is_restarting,
        }
    }

    #[inline(always)]
    fn descend(&mut self, descent: Descent) -> bool {
        if let Some(piece) = self.cuts.below(self.cursor.node())
            && !self.is_back_at_cut()
        {
            let below = (self.start)(piece);
            debug_assert!(below.is_ok(), "{:?} refuses a piece after another", below.err());
            let Ok(below) = below else { return false };
            self.waiting.push(replace(&mut self.cursor, below));
        }
        self.cursor.descend(descent)
    }

    #[inline(always)]
    fn backtrack(&mut self) -> bool {
        while !self.cursor.backtrack() {
            match self.waiting.pop() {
                Some(above) => self.cursor = above,
                None => return false,
            }
        }
        true
    }

    /// In all pieces: nodes postponed above are pruned too.
    fn prune(&mut self) {
        self.waiting.iter_mut().chain([&mut self.cursor]).for_each(Cursor::prune);
    }
}

/// Returns a key or counter of the whole tree: a leading one, and those of the pieces one after the other without
/// theirs.
fn joined<C: Cursor>(waiting: &[C], current: &C, part: impl Fn(State<C::Word>) -> Option<C::Word>) -> Option<Grow> {
    waiting.iter().chain([current]).try_fold(key::root(), |whole, cursor| {
        let part = part(cursor.state())?;
        Some(append(whole, &part, key::depth(&part)))
    })
}

/// Adds the lowest `count` bits of another word below those of the first.
fn append<W: KeyWord>(whole: Grow, part: &W, count: u32) -> Grow {
    let bit = |at| part.clone().shr(at).low_bits() & 1 == 1;
    (0..count).rev().fold(whole, |whole, at| key::child(whole, Grow::from_bit(bit(at))))
}

#[cfg(test)]
mod tests;

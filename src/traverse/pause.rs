//! Pausing and resuming traversals.
//!
//! A stackless traversal has a state of a few words (Binder & Keller 2016, Section 2.4). [`Paused`] is that state, with
//! the addresses of the traversal. Without addresses, key and trail suffice ([`KeyTrail`]): a walk down along the key's
//! bits, or a table of all keys, finds the address. A search can also resume from the key alone, if it allows unwanted
//! and repeated nodes ([`KeyOnly`]); so can a search that starts at a node instead of the root.

use core::fmt;

use super::{Cursor, traverse_pruned};
use crate::event::Recorder;
use crate::hash::{KeyMap, Lookup};
use crate::key::{self, KeyWord};
use crate::order::{Pruned, Repeatable};
use crate::trail;
use crate::tree::{Keys, Node, Topology};

/// The next action of a stopped traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Next {
    /// Visit its node: it was stopped before the visit.
    Visit,
    /// Backtrack: its node, a leaf, has been processed.
    Backtrack,
}

/// A cursor that can be paused.
pub trait Pause: Cursor {
    /// Returns the state; `next` is the result of [`traverse_pruned`].
    fn put_aside(&self, next: Next) -> Paused<Self::Word>;

    /// Restores a state of any traversal of the same tree in the same word. `[PAUSE-1]`
    ///
    /// Every part must be correct; [`States`](super::States) checks states from other sources.
    ///
    /// # Errors
    /// [`Incomplete`] with the missing part. Then nothing has changed.
    fn take_up(&mut self, paused: Paused<Self::Word>) -> Result<(), Incomplete>;
}

impl<C: Pause> Pause for &mut C {
    fn put_aside(&self, next: Next) -> Paused<C::Word> {
        (**self).put_aside(next)
    }

    fn take_up(&mut self, paused: Paused<C::Word>) -> Result<(), Incomplete> {
        (**self).take_up(paused)
    }
}

/// The state of a traversal, with addresses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Paused<W> {
    /// The node.
    pub node: Node,
    /// The most recently postponed node, if a register holds it. For traversals with a register, it must be present if
    /// bit 0 of the trail is set.
    pub register: Option<Node>,
    /// The node's key, if the traversal has it.
    pub key: Option<W>,
    /// The trail. For a traversal that counts, the complement of its counter.
    pub trail: W,
    /// The second trail, if there is one: 1 where the siblings are disjoint.
    pub disjoint: Option<W>,
    /// The first action.
    pub next: Next,
}

/// The missing part of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Incomplete {
    /// The key.
    Key,
    /// The address of the postponed sibling.
    Register,
}

impl fmt::Display for Incomplete {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Key => "the state has no key",
            Self::Register => "the sibling is postponed, and the state does not have its address",
        })
    }
}

impl core::error::Error for Incomplete {}

/// A key that no node of the tree has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoSuchKey;

impl fmt::Display for NoSuchKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no node of the tree has this key")
    }
}

impl core::error::Error for NoSuchKey {}

/// Finds the nodes of a state without addresses.
pub trait Locate<W> {
    /// Returns the node with this key, if there is one.
    fn locate(&self, key: &W) -> Option<Node>;
}

/// Finds nodes by walking down from the root along the key's bits.
#[derive(Debug)]
pub struct ByWalk<'t, T>(pub &'t T);

impl<W: KeyWord, T: Topology> Locate<W> for ByWalk<'_, T> {
    fn locate(&self, key: &W) -> Option<Node> {
        Keys::walk(self.0, key)
    }
}

/// Finds nodes in a table, which must have the keys of all nodes: only for states that are known to be correct, because
/// other keys give wrong nodes.
#[derive(Debug)]
pub struct ByTable<L>(pub L);

impl<W, L: Lookup<W>> Locate<W> for ByTable<L> {
    fn locate(&self, key: &W) -> Option<Node> {
        Some(self.0.node(key))
    }
}

impl<W: KeyWord> Locate<W> for KeyMap {
    fn locate(&self, key: &W) -> Option<Node> {
        self.get(key)
    }
}

/// The state of a traversal without addresses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyTrail<W> {
    /// The node's key.
    pub key: W,
    /// The trail.
    pub trail: W,
    /// The second trail, if there is one.
    pub disjoint: Option<W>,
    /// The first action.
    pub next: Next,
}

impl<W: KeyWord> KeyTrail<W> {
    /// Returns the state with its addresses: the node, and the most recently postponed one. `[PAUSE-2]`
    ///
    /// # Errors
    /// [`NoSuchKey`] if the tree has no such nodes, or the trail has bits above the root.
    pub fn locate(self, nodes: &impl Locate<W>) -> Result<Paused<W>, NoSuchKey> {
        let Self { key, trail, disjoint, next } = self;
        if [Some(&trail), disjoint.as_ref()].into_iter().flatten().any(|bits| bits.bit_length() > key::depth(&key)) {
            return Err(NoSuchKey);
        }
        let node = nodes.locate(&key).ok_or(NoSuchKey)?;
        let register = if trail.is_zero() {
            None
        } else {
            let (postponed, _) = trail::backtrack(key.clone(), trail.clone());
            Some(nodes.locate(&postponed).ok_or(NoSuchKey)?)
        };
        Ok(Paused { node, register, key: Some(key), trail, disjoint, next })
    }
}

impl<W: KeyWord> Paused<W> {
    /// Returns the state without addresses; `None` if it has no key.
    pub fn key_trail(self) -> Option<KeyTrail<W>> {
        Some(KeyTrail { key: self.key?, trail: self.trail, disjoint: self.disjoint, next: self.next })
    }
}

/// Resumes a paused traversal. Returns what [`traverse_pruned`] returns. Pass a search without pruning as
/// [`Unpruned`](crate::order::Unpruned), and a cursor that may pause again by `&mut`.
///
/// # Errors
/// [`Incomplete`], before the first step.
pub fn resume<C: Pause>(
    mut cursor: C,
    paused: Paused<C::Word>,
    search: &mut impl Pruned,
    recorder: &mut impl Recorder,
) -> Result<Option<Next>, Incomplete> {
    let next = paused.next;
    cursor.take_up(paused)?;
    if next == Next::Backtrack && !cursor.backtrack() {
        return Ok(None);
    }
    Ok(traverse_pruned(cursor, search, recorder))
}

/// A node from which a search visits its subtree, then its sibling's, its uncle's and so on up to the root's other
/// child. `[PAUSE-4]`
///
/// This is the state of a traversal when only the key is kept: the wanted nodes and the visited nodes are unknown. So
/// it is not a [`Paused`] state, and only searches that allow repeated and unwanted nodes can resume from it.
///
/// ```compile_fail,E0277
/// # use stackless_bvh::bvh::Bvh;
/// # use stackless_bvh::geom::Ray;
/// # use stackless_bvh::internals::geom::kernel::Exact;
/// # use stackless_bvh::internals::geom::slabs::Directed;
/// # use stackless_bvh::internals::trace::AllHitsQuery;
/// # use stackless_bvh::traverse::{KeyOnly, Pause, revisit};
/// // All hits would be counted twice.
/// fn all_hits(bvh: &Bvh, ray: &Ray, cursor: impl Pause<Word = u64>, from: KeyOnly<u64>) {
///     let mut search = AllHitsQuery::<Exact, Directed>::new(bvh, ray);
///     let _ = revisit(cursor, from, &mut search, &mut ());
/// }
/// ```
///
/// With `Closest::new(bvh, ray)` for the search it compiles:
///
/// ```
/// # use stackless_bvh::bvh::Bvh;
/// # use stackless_bvh::geom::Ray;
/// # use stackless_bvh::internals::trace::Closest;
/// # use stackless_bvh::traverse::{KeyOnly, Pause, revisit};
/// fn closest_hit(bvh: &Bvh, ray: &Ray, cursor: impl Pause<Word = u64>, from: KeyOnly<u64>) {
///     let mut search = Closest::new(bvh, ray);
///     let _ = revisit(cursor, from, &mut search, &mut ());
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyOnly<W>(Paused<W>);

impl<W: KeyWord> KeyOnly<W> {
    /// Returns the key.
    pub fn key(&self) -> Option<&W> {
        self.0.key.as_ref()
    }

    /// Creates the state of a key. Each level sets one bit of the trail. `[PAUSE-5]`
    ///
    /// # Errors
    /// [`NoSuchKey`].
    pub fn locate(key: W, next: Next, nodes: &impl Locate<W>) -> Result<Self, NoSuchKey> {
        if key.is_zero() {
            return Err(NoSuchKey);
        }
        let trail = key::level_start(&key).wrapping_sub(&W::one());
        KeyTrail { key, trail, disjoint: None, next }.locate(nodes).map(Self)
    }
}

/// Resumes a search from a node, as described at [`KeyOnly`]. Returns what [`traverse_pruned`] returns.
///
/// # Errors
/// [`Incomplete`], before the first step.
pub fn revisit<C: Pause>(
    cursor: C,
    from: KeyOnly<C::Word>,
    search: &mut (impl Repeatable + Pruned),
    recorder: &mut impl Recorder,
) -> Result<Option<Next>, Incomplete> {
    resume(cursor, from.0, search, recorder)
}

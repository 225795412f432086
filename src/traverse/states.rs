//! Encoding of states as bytes, with checks.

use alloc::vec::Vec;
use core::fmt;

use super::{Next, Paused};
use crate::hash::{AddressBounds, checksum, mix};
use crate::key::{self, Grow, KeyWord, Word};
use crate::trail::{self, is_pending};
use crate::tree::{Keys, Node, Topology, for_each_parent};

const MAGIC: [u8; 4] = *b"SBVP";
const VERSION: u8 = 1;
/// Magic, version, flags, bytes of a word; the tree; node and register.
const HEADER_BYTES: usize = 10 + 8 + 8;
const CHECKSUM_BYTES: usize = 8;
/// Flags: the parts that are present, and the next action.
const KEY: u8 = 1;
const REGISTER: u8 = 2;
const DISJOINT: u8 = 4;
const BACKTRACK: u8 = 8;

/// Writes and reads the states of traversals of one tree.
///
/// It reads only states of this tree, and refuses all other bytes. The bytes have a hash of the tree's structure. A
/// checksum detects damage. Every part is checked against the tree, so even bytes with a forged checksum are accepted
/// only if a traversal could be in this state. `[PAUSE-6]`
///
/// All numbers are little-endian: `SBVP`, version (1 byte), flags (1; bit 0 key, 1 register, 2 second trail, 3
/// backtrack next), bytes of a word (4), the tree (8), node (4), register (4, or 0), trail, key and second trail as
/// flagged (a word each), checksum (8).
///
/// ```
/// use stackless_bvh::traverse::{Afra, Next, Pause, StateError, States};
/// use stackless_bvh::tree::{Recorded, Tree};
///
/// let tree = Tree::new(&[Some([1, 2]), None, None])?.with_links(Recorded::ParentSibling);
/// let states = States::of(&tree);
/// let paused = Afra::<u32, _>::new(&tree)?.put_aside(Next::Visit);
/// let bytes = states.to_bytes(&paused);
/// assert_eq!(bytes.len(), states.bytes(&paused));
/// assert_eq!(states.from_bytes(&bytes), Ok(paused));
///
/// let other = Tree::new(&[Some([2, 1]), None, None])?;
/// assert_eq!(States::of(&other).from_bytes::<u32>(&bytes), Err(StateError::Tree));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct States<'t, T> {
    tree: &'t T,
    keys: Keys,
    bounds: AddressBounds,
    fingerprint: u64,
}

/// Errors of [`States::from_bytes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateError {
    /// The magic number is invalid, or there are too few bytes.
    Magic,
    /// The version of the format is not supported.
    Version {
        /// Its number.
        version: u8,
    },
    /// The state is of a traversal in another word.
    WordBytes {
        /// Bytes of the requested word.
        expected: u32,
        /// Bytes of the state's word.
        found: u32,
    },
    /// The length does not match the header.
    Length {
        /// Expected number of bytes.
        expected: usize,
        /// Actual number of bytes.
        found: usize,
    },
    /// The checksum is wrong: the bytes are damaged.
    Checksum,
    /// An unknown flag is set.
    Flags {
        /// All flags.
        flags: u8,
    },
    /// The state is of another tree.
    Tree,
    /// The tree has no such node.
    Node(Node),
    /// The key is not that of the node.
    Key,
    /// The trail, or the second trail, has bits above the root.
    Trail,
    /// The register does not address the most recently postponed node, or is missing if that is the sibling.
    Register,
    /// An inner node is marked as processed like a leaf.
    Backtrack,
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Magic => f.write_str("not a paused state: it does not begin with SBVP"),
            Self::Version { version } => write!(f, "version {version} of the format, expected {VERSION}"),
            Self::WordBytes { expected, found } => write!(f, "words of {found} bytes, expected {expected}"),
            Self::Length { expected, found } => write!(f, "{found} bytes, expected {expected}"),
            Self::Checksum => f.write_str("the checksum is wrong"),
            Self::Flags { flags } => write!(f, "unknown flags in {flags:#010b}"),
            Self::Tree => f.write_str("the state is of another tree"),
            Self::Node(node) => write!(f, "the tree has no {node:?}"),
            Self::Key => f.write_str("the key is not that of the node"),
            Self::Trail => f.write_str("a trail has bits above the root"),
            Self::Register => f.write_str("the register does not address the most recently postponed node"),
            Self::Backtrack => f.write_str("an inner node cannot have been looked into as a leaf"),
        }
    }
}

impl core::error::Error for StateError {}

impl<'t, T: Topology> States<'t, T> {
    /// Prepares a tree, in time and memory linear in its size.
    pub fn of(tree: &'t T) -> Self {
        let mut fingerprint = mix(u64::from(tree.root().to_bits()));
        for_each_parent(tree, |parent, children| {
            for node in [parent].into_iter().chain(children) {
                fingerprint = mix(fingerprint ^ u64::from(node.to_bits())).wrapping_add(1);
            }
        });
        Self { tree, keys: Keys::of(tree), bounds: AddressBounds::of(tree), fingerprint }
    }

    /// Returns the size of a state in bytes: the same at every step of a traversal with these parts.
    pub fn bytes<W: KeyWord>(&self, paused: &Paused<W>) -> usize {
        self.length::<W>(flags(paused))
    }

    /// Encodes a state. A traversal without a register does not have the address of a postponed sibling; this function
    /// looks it up, so that any other traversal can resume from the bytes. `[PAUSE-3]`
    pub fn to_bytes<W: KeyWord>(&self, paused: &Paused<W>) -> Vec<u8> {
        let register = paused.register.or_else(|| self.sibling(paused.node).filter(|_| is_pending(&paused.trail)));
        let flags = flags(paused) | if register.is_some() { REGISTER } else { 0 };
        let mut bytes = Vec::with_capacity(self.length::<W>(flags));
        bytes.extend(MAGIC);
        bytes.extend([VERSION, flags]);
        bytes.extend((self.word_bytes::<W>() as u32).to_le_bytes());
        bytes.extend(self.fingerprint.to_le_bytes());
        bytes.extend(paused.node.to_bits().to_le_bytes());
        bytes.extend(register.map_or(0, Node::to_bits).to_le_bytes());
        for word in [Some(&paused.trail), paused.key.as_ref(), paused.disjoint.as_ref()].into_iter().flatten() {
            let mut rest = word.clone();
            for _ in 0..self.word_bytes::<W>() {
                bytes.push(rest.low_bits() as u8);
                rest = (0..8).fold(rest, |rest, _| rest.shr1());
            }
        }
        bytes.extend(checksum(&bytes).to_le_bytes());
        bytes
    }

    /// Decodes a state.
    ///
    /// # Errors
    /// [`StateError`].
    pub fn from_bytes<W: KeyWord>(&self, bytes: &[u8]) -> Result<Paused<W>, StateError> {
        let Some(&[version, flags]) = bytes.strip_prefix(&MAGIC).and_then(<[u8]>::first_chunk) else {
            return Err(StateError::Magic);
        };
        if version != VERSION {
            return Err(StateError::Version { version });
        }
        if flags & !(KEY | REGISTER | DISJOINT | BACKTRACK) != 0 {
            return Err(StateError::Flags { flags });
        }
        // Before the length is checked, there are bytes for magic, version and flags.
        let number = |at: usize| u32::from_le_bytes(bytes[at..].first_chunk().copied().unwrap_or_default());
        let (expected, found) = (self.word_bytes::<W>() as u32, number(6));
        if expected != found {
            return Err(StateError::WordBytes { expected, found });
        }
        let expected = self.length::<W>(flags);
        if expected != bytes.len() {
            return Err(StateError::Length { expected, found: bytes.len() });
        }
        let (content, stored) = bytes.split_at(bytes.len() - CHECKSUM_BYTES);
        if stored != checksum(content).to_le_bytes() {
            return Err(StateError::Checksum);
        }
        if (u64::from(number(14)) << 32 | u64::from(number(10))) != self.fingerprint {
            return Err(StateError::Tree);
        }
        let mut words = content[HEADER_BYTES..].chunks_exact(self.word_bytes::<W>()).map(word_of);
        let mut word = |wanted: bool| if wanted { words.next() } else { None };
        let trail = word(true).unwrap_or_default();
        let (key, disjoint) = (word(flags & KEY != 0), word(flags & DISJOINT != 0));
        let register = (flags & REGISTER != 0).then(|| Node::from_bits(number(22)));
        let next = if flags & BACKTRACK == 0 { Next::Visit } else { Next::Backtrack };
        let paused = Paused { node: Node::from_bits(number(18)), register, key, trail, disjoint, next };
        self.check(&paused)?;
        if paused.register.is_none() && is_pending(&paused.trail) {
            return Err(StateError::Register);
        }
        Ok(paused)
    }

    /// Checks that a traversal of this tree can be in a state.
    ///
    /// # Errors
    /// [`StateError`] for the part that does not fit the tree.
    pub fn check<W: KeyWord>(&self, paused: &Paused<W>) -> Result<(), StateError> {
        let Paused { node, register, key, trail, disjoint, next } = paused;
        if !self.bounds.contains(*node) {
            return Err(StateError::Node(*node));
        }
        let slot = self.tree.slot(*node);
        // A leaf may have the index of an inner node. (Traversals without a key carry trees that are a level deeper
        // than their word's keys.)
        let true_key: Grow = self.keys.key(slot);
        if Keys::walk(self.tree, &true_key) != Some(*node) {
            return Err(StateError::Node(*node));
        }
        let depth = self.keys.depth(slot);
        if key.as_ref().is_some_and(|key| !self.keys.is(slot, key)) {
            return Err(StateError::Key);
        }
        if [Some(trail), disjoint.as_ref()].into_iter().flatten().any(|bits| bits.bit_length() > depth) {
            return Err(StateError::Trail);
        }
        if *next == Next::Backtrack && !node.is_leaf() {
            return Err(StateError::Backtrack);
        }
        let postponed = || Keys::walk(self.tree, &key::sibling(true_key.clone().shr(trail::levels(trail))));
        if register.is_some() && (trail.is_zero() || *register != postponed()) {
            return Err(StateError::Register);
        }
        Ok(())
    }

    /// Returns the sibling of a node; `None` for the root, and for an address that is no node of the tree.
    fn sibling(&self, node: Node) -> Option<Node> {
        let slot = self.bounds.contains(node).then(|| self.tree.slot(node))?;
        let key: Grow = self.keys.key(slot);
        if key::depth(&key) == 0 { None } else { Keys::walk(self.tree, &key::sibling(key)) }
    }

    fn length<W: KeyWord>(&self, flags: u8) -> usize {
        let words = 1 + (flags & (KEY | DISJOINT)).count_ones() as usize;
        HEADER_BYTES + words * self.word_bytes::<W>() + CHECKSUM_BYTES
    }

    /// Returns the bytes of a word: for a growing word those of the longest key of the tree.
    fn word_bytes<W: KeyWord>(&self) -> usize {
        W::WIDTH.unwrap_or(self.tree.depth() + 1).div_ceil(8) as usize
    }
}

fn flags<W>(paused: &Paused<W>) -> u8 {
    let flag = |is_set: bool, flag: u8| if is_set { flag } else { 0 };
    flag(paused.key.is_some(), KEY)
        | flag(paused.register.is_some(), REGISTER)
        | flag(paused.disjoint.is_some(), DISJOINT)
        | flag(paused.next == Next::Backtrack, BACKTRACK)
}

fn word_of<W: KeyWord>(bytes: &[u8]) -> W {
    let bits = bytes.iter().rev().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1 == 1));
    bits.fold(W::zero(), |word, bit| word.shl1().or(&W::from_bit(bit)))
}

#[cfg(test)]
mod tests;

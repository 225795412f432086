//! From keys to addresses in a tree of any depth.

use crate::hash::{KeyMap, Lookup};
use crate::key::KeyWord;
use crate::tree::{Implicit, Node, Topology};

/// The implicit layout of a tree, or a map from all keys if the layout would be too large.
#[derive(Debug)]
pub enum Layout {
    /// The layout.
    Implicit(Implicit),
    /// The map.
    Map(KeyMap),
}

impl Layout {
    pub(super) fn of(tree: &impl Topology, implicit_depth: u32) -> Self {
        let implicit = if tree.depth() <= implicit_depth { Implicit::of(tree).ok() } else { None };
        implicit.map_or_else(|| Self::Map(KeyMap::of(tree)), Self::Implicit)
    }

    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Implicit(layout) => layout.bytes(),
            Self::Map(map) => map.bytes(),
        }
    }
}

impl<W: KeyWord> Lookup<W> for Layout {
    #[inline]
    fn node(&self, key: &W) -> Node {
        match self {
            Self::Implicit(layout) => layout.node(key),
            Self::Map(map) => map.node(key),
        }
    }
}

//! The implicit layout: the address of a node is its key minus one.
//!
//! Barringer & Akenine-Möller (2013, Section 2) store depth `d` at addresses `2^d - 1` to `2^(d+1) - 2` and leave gaps
//! where the tree has no nodes: "it is enough to allocate the address space for them". This layout works likewise: a
//! plain vector for shallow trees, and for other trees reserved virtual memory, where only the touched pages exist.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::{Node, Topology};

/// A tree in level order, with gaps.
#[derive(Debug)]
pub struct Implicit {
    cells: Cells,
    /// Pages of 4 KiB that hold nodes.
    pages: usize,
}

/// One 32-bit cell per address: the node's bits plus one, 0 in a gap (like untouched memory).
#[derive(Debug)]
enum Cells {
    Plain(Vec<u32>),
    #[cfg(feature = "std")]
    Reserved(memmap2::MmapMut),
}

/// Errors of [`Implicit::of`].
#[derive(Debug)]
pub enum ImplicitError {
    /// The address space would be larger than this crate reserves.
    TooDeep {
        /// Depth of the tree, in edges.
        depth: u32,
        /// Greatest supported depth.
        limit: u32,
    },
    /// The system refused to reserve the address space.
    #[cfg(feature = "std")]
    Reserve {
        /// Requested bytes.
        bytes: usize,
        /// The system's error.
        source: std::io::Error,
    },
}

impl fmt::Display for ImplicitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooDeep { depth, limit } => {
                write!(f, "the tree is {depth} edges deep, and the implicit layout is made for at most {limit}")
            }
            #[cfg(feature = "std")]
            Self::Reserve { bytes, source } => {
                write!(f, "the implicit layout needs {bytes} bytes of address space: {source}")
            }
        }
    }
}

impl core::error::Error for ImplicitError {}

impl Implicit {
    /// Greatest supported depth: 16 GiB of address space with `std`, 128 MiB of memory without.
    pub const LIMIT: u32 = if cfg!(feature = "std") { 31 } else { 24 };

    /// Moves a tree to its predetermined addresses.
    ///
    /// # Errors
    /// [`ImplicitError`], if a tree is too deep or address space is short.
    pub fn of(tree: &impl Topology) -> Result<Self, ImplicitError> {
        let depth = tree.depth();
        if depth > Self::LIMIT {
            return Err(ImplicitError::TooDeep { depth, limit: Self::LIMIT });
        }
        let mut cells = Cells::for_depth(depth)?;
        let mut pending = vec![(tree.root(), 0_usize)];
        let array = cells.as_mut_slice();
        let mut is_touched = vec![false; array.len().div_ceil(PAGE_CELLS)];
        while let Some((node, address)) = pending.pop() {
            array[address] = node.to_bits() + 1;
            is_touched[address / PAGE_CELLS] = true;
            if !node.is_leaf() {
                let [left, right] = tree.children(node);
                pending.extend([(left, 2 * address + 1), (right, 2 * address + 2)]);
            }
        }
        Ok(Self { cells, pages: is_touched.into_iter().filter(|&is_touched| is_touched).count() })
    }

    /// Returns the memory of the pages that hold nodes, in bytes; the address space in between uses no memory.
    pub fn bytes(&self) -> usize {
        self.pages * PAGE_CELLS * size_of::<u32>()
    }

    /// Returns its cells: for many lookups.
    #[inline]
    pub fn cells(&self) -> ImplicitCells<'_> {
        ImplicitCells(self.cells.as_slice())
    }

    /// Returns the node at an address; `None` in a gap and beyond the last level.
    #[inline]
    pub fn at(&self, address: usize) -> Option<Node> {
        self.cells().at(address)
    }
}

/// The cells of an [`Implicit`] layout. Their location is resolved once, not for each node.
#[derive(Clone, Copy, Debug)]
pub struct ImplicitCells<'t>(&'t [u32]);

impl ImplicitCells<'_> {
    /// Computes [`Implicit::at`].
    #[inline]
    pub fn at(&self, address: usize) -> Option<Node> {
        let cell = *self.0.get(address)?;
        cell.checked_sub(1).map(Node::from_bits)
    }
}

/// Deepest tree for which the plain vector (64 KiB) is preferred.
#[cfg(feature = "std")]
const PLAIN: u32 = 13;

/// Cells in a page of 4 KiB.
const PAGE_CELLS: usize = 1024;

impl Cells {
    #[cfg(feature = "std")]
    fn for_depth(depth: u32) -> Result<Self, ImplicitError> {
        if depth <= PLAIN {
            return Ok(Self::Plain(vec![0; 2 << depth]));
        }
        let bytes = 8 << depth;
        let reserved = memmap2::MmapOptions::new().len(bytes).no_reserve_swap().map_anon();
        reserved.map(Self::Reserved).map_err(|source| ImplicitError::Reserve { bytes, source })
    }

    #[cfg(not(feature = "std"))]
    #[allow(clippy::unnecessary_wraps, reason = "the other form of this function can fail")]
    fn for_depth(depth: u32) -> Result<Self, ImplicitError> {
        Ok(Self::Plain(vec![0; 2 << depth]))
    }

    #[inline]
    fn as_slice(&self) -> &[u32] {
        match self {
            Self::Plain(cells) => cells,
            #[cfg(feature = "std")]
            Self::Reserved(map) => bytemuck::cast_slice(map),
        }
    }

    fn as_mut_slice(&mut self) -> &mut [u32] {
        match self {
            Self::Plain(cells) => cells,
            #[cfg(feature = "std")]
            Self::Reserved(map) => bytemuck::cast_slice_mut(map),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Family;
    use crate::tree::Tree;

    fn comb(depth: u32) -> Tree {
        Family::comb(depth, |_| true)
    }

    #[test]
    fn addresses_are_keys_minus_one_with_gaps_between() {
        for depth in [0, 1, 5, 13, 14, Implicit::LIMIT] {
            let tree = comb(depth);
            let layout = Implicit::of(&tree).unwrap();
            // The first 10 levels share a page; each level below has both its nodes in another page.
            assert_eq!(layout.bytes(), 4096 * (1 + depth.saturating_sub(9) as usize));
            // The comb leans right: the inner node at depth d has key 2^(d+1) - 1, its left child is a leaf.
            for d in 0..depth {
                let key = (2_usize << d) - 1;
                assert_eq!(layout.at(key - 1), tree.node(2 * d));
                assert_eq!(layout.at(2 * key - 1), tree.node(2 * d + 1));
                assert_eq!(layout.at(4 * key - 1), None);
            }
        }
        assert!(matches!(Implicit::of(&comb(32)), Err(ImplicitError::TooDeep { depth: 32, limit: Implicit::LIMIT })));
    }

    #[test]
    fn deep_trees_take_address_space_and_others_memory() {
        for (depth, is_plain) in [(0, true), (PLAIN, true), (PLAIN + 1, false)] {
            assert_eq!(matches!(Cells::for_depth(depth), Ok(Cells::Plain(_))), is_plain, "{depth}");
        }
        let error = Implicit::of(&comb(32)).unwrap_err();
        let text = "the tree is 32 edges deep, and the implicit layout is made for at most 31";
        assert_eq!(std::string::ToString::to_string(&error), text);
    }
}

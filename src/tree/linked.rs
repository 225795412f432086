//! A tree with tables of links.

use core::borrow::Borrow;

use super::{Links, Node, Reach, Recorded, Topology, Uncles};

/// A tree with tables of the links that its own records do not have: for many traversals of one tree.
///
/// The traversals use the first `INNER` uncles in records of inner nodes, and the first `LEAF` in those of leaves (1 to
/// 3, otherwise it does not compile).
///
/// ```
/// use stackless_bvh::traverse::{Afra, Unsupported};
/// use stackless_bvh::tree::{Linked, Recorded, Tree};
///
/// let tree = Tree::new(&[Some([1, 2]), None, None])?;
/// assert_eq!(Afra::<u32, _>::new(&tree).err(), Some(Unsupported::NoLinks(Recorded::ParentSibling)));
/// assert!(Afra::<u32, _>::new(&Linked::parents(&tree)).is_ok());
/// assert!(Afra::<u32, _>::new(&tree.with_links(Recorded::ParentSibling)).is_ok());
/// # Ok::<(), stackless_bvh::tree::TreeError>(())
/// ```
#[derive(Debug)]
pub struct Linked<'t, T, const INNER: u32 = 2, const LEAF: u32 = 2, L = Links> {
    tree: &'t T,
    links: L,
}

impl<'t, T: Topology> Linked<'t, T> {
    /// Adds parents and siblings to a tree.
    pub fn parents(tree: &'t T) -> Self {
        Self::naming(tree, &[Recorded::ParentSibling])
    }

    /// Adds uncles and grand uncles to a tree.
    pub fn uncles(tree: &'t T) -> Self {
        Self::naming(tree, &[Recorded::Uncles])
    }

    /// Adds parents, siblings, uncles and grand uncles to a tree.
    pub fn both(tree: &'t T) -> Self {
        Self::naming(tree, &[Recorded::ParentSibling, Recorded::Uncles])
    }

    /// Adds the listed links to a tree.
    pub fn naming(tree: &'t T, what: &[Recorded]) -> Self {
        Self { tree, links: Links::of(tree, what) }
    }
}

impl<'t, T, L: Borrow<Links>> Linked<'t, T, 2, 2, L> {
    /// Combines a tree with its tables.
    #[inline]
    pub const fn over(tree: &'t T, links: L) -> Self {
        Self { tree, links }
    }
}

impl<'t, T: Topology, const INNER: u32, const LEAF: u32> Linked<'t, T, INNER, LEAF> {
    /// Adds uncles to a tree, up to the reach of this type.
    pub fn reaching(tree: &'t T) -> Self {
        Self { tree, links: Links { parents: None, uncles: Some(Uncles::of(tree)) } }
    }

    /// Returns the tree itself.
    pub fn tree(&self) -> &'t T {
        self.tree
    }

    /// Returns the memory of the tables, in bytes.
    pub fn bytes(&self) -> usize {
        self.links.bytes()
    }
}

impl<T: Topology, const INNER: u32, const LEAF: u32, L: Borrow<Links>> Topology for Linked<'_, T, INNER, LEAF, L> {
    const REACH: Reach = match Reach::new(INNER, LEAF) {
        Some(reach) => reach,
        None => panic!("a record reaches from 1 to 3"),
    };

    crate::topology_of!(tree);

    fn recorded(&self) -> Recorded {
        self.tree.recorded()
    }

    #[inline(always)]
    fn links(&self, node: Node) -> [Node; 2] {
        self.tree.links(node)
    }

    fn names(&self, what: Recorded) -> bool {
        match what {
            Recorded::ParentSibling if self.links.borrow().parents.is_some() => true,
            Recorded::Uncles if self.links.borrow().uncles.is_some() => true,
            _ => self.tree.names(what),
        }
    }

    #[inline(always)]
    fn parent(&self, node: Node) -> Node {
        match &self.links.borrow().parents {
            Some(table) => table.row(self.tree, node)[0],
            None => self.tree.parent(node),
        }
    }

    #[inline(always)]
    fn sibling(&self, node: Node) -> Node {
        match &self.links.borrow().parents {
            Some(table) => table.row(self.tree, node)[1],
            None => self.tree.sibling(node),
        }
    }

    #[inline(always)]
    fn uncles(&self, node: Node) -> [Node; 3] {
        match &self.links.borrow().uncles {
            Some(table) => table.row(self.tree, node),
            None => self.tree.uncles(node),
        }
    }
}

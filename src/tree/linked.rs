//! A tree with its links beside it.

use core::borrow::Borrow;

use super::{Links, Node, Reach, Recorded, Topology, Uncles};

/// A tree with tables of the links that its own records do not name: for many traversals of one tree.
///
/// Records of inner nodes are taken to name the first `INNER` of the uncles, and those of leaves the first `LEAF` (1
/// to 3, else it does not compile).
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
    /// The tree, with parents and siblings.
    pub fn parents(tree: &'t T) -> Self {
        Self::naming(tree, &[Recorded::ParentSibling])
    }

    /// The tree, with uncles and grand uncles.
    pub fn uncles(tree: &'t T) -> Self {
        Self::naming(tree, &[Recorded::Uncles])
    }

    /// The tree, with all of these.
    pub fn both(tree: &'t T) -> Self {
        Self::naming(tree, &[Recorded::ParentSibling, Recorded::Uncles])
    }

    /// The tree, with what is listed.
    pub fn naming(tree: &'t T, what: &[Recorded]) -> Self {
        Self { tree, links: Links::of(tree, what) }
    }
}

impl<'t, T, L: Borrow<Links>> Linked<'t, T, 2, 2, L> {
    /// The tree, with tables that were made for it.
    #[inline]
    pub const fn over(tree: &'t T, links: L) -> Self {
        Self { tree, links }
    }
}

impl<'t, T: Topology, const INNER: u32, const LEAF: u32> Linked<'t, T, INNER, LEAF> {
    /// The tree, with uncles as far as this type says.
    pub fn reaching(tree: &'t T) -> Self {
        Self { tree, links: Links { parents: None, uncles: Some(Uncles::of(tree)) } }
    }

    /// The tree itself.
    pub fn tree(&self) -> &'t T {
        self.tree
    }

    /// Memory of the tables, in bytes.
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

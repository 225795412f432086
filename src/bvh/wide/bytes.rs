//! Wide hierarchies as bytes: spec/bvh-file.md, from `[FILE-6]` on.

use super::{WideBvh, WideBvhError, WideNode, name_ancestors};
use crate::bvh::bytes::{FileError, VERSION, numbers, opened};
use crate::bvh::least::Least;
use crate::geom::lanes::Block;
use crate::geom::{Aabb, Region};
use crate::hash::checksum;

const MAGIC: &str = "SBVHWIDE";
/// Version, slots, levels, inner nodes, blocks, triangles, repeated references.
const HEADER_WORDS: usize = 7;
/// Nine coordinates and an index for each of four triangles.
const BLOCK_WORDS: usize = 40;

/// Why bytes are not a [`WideBvh`].
pub type WideBvhFileError = FileError<WideBvhError>;

impl<const A: usize> WideBvh<A> {
    /// The hierarchy as bytes, fewer than [`bytes`](Self::bytes) says, with a checksum.
    /// `[FILE-6]` `[FILE-7]` `[FILE-4]`
    ///
    /// ```
    /// use stackless_bvh::{bvh::WideBvh, generate::procedural};
    ///
    /// let bvh = WideBvh::build(&procedural::soup(1, 100))?;
    /// let bytes = bvh.to_bytes();
    /// let back = WideBvh::<8>::from_bytes(&bytes)?;
    /// assert_eq!((back.nodes(), back.blocks()), (bvh.nodes(), bvh.blocks()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_bytes(&self) -> Vec<u8> {
        let Self { nodes, blocks, levels, triangles, duplicates, .. } = self;
        let counts = [nodes.len(), blocks.len(), *triangles, *duplicates].map(|count| count as u32);
        let mut bytes = Vec::with_capacity(file_bytes::<A>(counts[0], counts[1]) as usize);
        bytes.extend(MAGIC.bytes());
        let mut write = |words: &[u32]| bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        write(&[VERSION, A as u32, *levels]);
        write(&counts);
        for WideNode { planes, children, .. } in nodes {
            planes.as_flattened().iter().for_each(|planes| write(&planes.map(f32::to_bits)));
            write(children);
        }
        for Block { corners, prims, .. } in blocks {
            corners.as_flattened().iter().for_each(|row| write(&row.map(f32::to_bits)));
            write(prims);
        }
        bytes.extend(checksum(&bytes).to_le_bytes());
        bytes
    }

    /// The hierarchy that these bytes are, sound in itself: all that [`validate`](Self::validate) checks without a mesh
    /// has been checked, so that queries end and their answers are right for the triangles that it holds. `[FILE-8]`
    ///
    /// Nothing is allocated before the length is known to be right, and then in proportion to it. The checksum finds
    /// damage, not intent. As with [`Bvh::from_bytes`](crate::bvh::Bvh::from_bytes), bytes can be made up that take
    /// long to check.
    ///
    /// # Errors
    /// [`WideBvhFileError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WideBvhFileError> {
        let (header, body) = opened(bytes, MAGIC, |&[_, slots, _, nodes, blocks, ..]: &[u32; HEADER_WORDS]| {
            if slots as usize != A {
                return Err(FileError::Field { name: "slots", value: slots });
            }
            Ok(file_bytes::<A>(nodes, blocks))
        })?;
        let [_, _, levels, node_count, _, triangles, duplicates] = header;
        let (nodes, blocks) = body.split_at(node_count as usize * node_bytes::<A>());
        let mut nodes: Vec<_> = nodes.chunks_exact(node_bytes::<A>()).map(read_node).collect();
        let blocks = blocks.chunks_exact(4 * BLOCK_WORDS).map(read_block).collect();
        name_ancestors(&mut nodes);
        let own = |node: &WideNode<A>| (0..A as u32).map(|slot| node.child_box(slot)).fold(Aabb::EMPTY, Aabb::union);
        let region = match nodes.first() {
            Some(root) if root.children != [0; A] => Region::of(&own(root)),
            _ => *Self::empty().region(),
        };
        let (triangles, duplicates) = (triangles as usize, duplicates as usize);
        let wide = Self { nodes, blocks, region, levels, triangles, duplicates, least: Least::default() };
        wide.check(None)?;
        Ok(wide)
    }
}

/// Bytes of a file with these counts.
const fn file_bytes<const A: usize>(nodes: u32, blocks: u32) -> u64 {
    let fixed = MAGIC.len() + 4 * HEADER_WORDS + size_of::<u64>();
    fixed as u64 + nodes as u64 * node_bytes::<A>() as u64 + blocks as u64 * (4 * BLOCK_WORDS as u64)
}

/// Six planes and an address for each slot.
const fn node_bytes<const A: usize>() -> usize {
    4 * 7 * A
}

/// A node, without ancestors and without the set of its leaves.
fn read_node<const A: usize>(bytes: &[u8]) -> WideNode<A> {
    let mut rows = bytes.chunks_exact(4 * A).map(|row| numbers::<4, A>(row).map(u32::from_le_bytes));
    let mut next = || rows.next().unwrap_or([0; A]);
    let planes = std::array::from_fn(|_| std::array::from_fn(|_| next().map(f32::from_bits)));
    WideNode { planes, children: next(), ancestors: [0; A] }
}

fn read_block(bytes: &[u8]) -> Block {
    let mut rows = bytes.chunks_exact(16).map(|row| numbers::<4, 4>(row).map(u32::from_le_bytes));
    let mut next = || rows.next().unwrap_or([0; 4]);
    let corners = std::array::from_fn(|_| std::array::from_fn(|_| next().map(f32::from_bits)));
    let mut block = Block { corners, prims: next(), ..Block::EMPTY };
    for lane in 0..4 {
        let prim = block.prims[lane];
        if prim != Block::NONE {
            block.set(lane, &block.triangle(lane), prim);
        }
    }
    block
}

#[cfg(test)]
mod tests;

//! Wide hierarchies as bytes: spec/bvh-file.md, from `[FILE-6]` on.

use super::{WideBvh, WideBvhError, WideNode, name_ancestors};
use crate::bvh::bytes::{FileError, Stored, VERSION, frame_bytes, numbers, opened, read_frame, write_frame};
use crate::bvh::least::Least;
use crate::geom::lanes::{Block, Precision};
use crate::geom::{Aabb, Region};
use crate::hash::checksum;

const MAGIC: &str = "SBVHWIDE";
/// Version, slots and kind of coordinates, levels, inner nodes, blocks, triangles, repeated references.
const HEADER_WORDS: usize = 7;
/// Added to the number of slots in double precision.
const DOUBLE: u32 = 256;

/// Errors of [`WideBvh::from_bytes`].
pub type WideBvhFileError = FileError<WideBvhError>;

impl<const A: usize, V: Precision + Stored> WideBvh<A, V> {
    /// Encodes the hierarchy, with a checksum. The size is below [`bytes`](Self::bytes). `[FILE-6]` `[FILE-7]`
    /// `[FILE-4]`
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
        let Self { nodes, blocks, region, levels, triangles, duplicates, .. } = self;
        let counts = [nodes.len(), blocks.len(), *triangles, *duplicates].map(|count| count as u32);
        let mut bytes = Vec::with_capacity(file_bytes::<A, V>(counts[0], counts[1]) as usize);
        bytes.extend(MAGIC.bytes());
        let write = |bytes: &mut Vec<u8>, words: &[u32]| bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        write(&mut bytes, &[VERSION, slots::<A, V>(), *levels]);
        write(&mut bytes, &counts);
        write_frame::<V>(region.frame(), &mut bytes);
        for WideNode { planes, children, .. } in nodes {
            planes.as_flattened().iter().for_each(|planes| write(&mut bytes, &planes.map(f32::to_bits)));
            write(&mut bytes, children);
        }
        for Block { corners, prims, .. } in blocks {
            corners.as_flattened().as_flattened().iter().for_each(|&x| V::write_real(x, &mut bytes));
            write(&mut bytes, prims);
        }
        bytes.extend(checksum(&bytes).to_le_bytes());
        bytes
    }

    /// Decodes a hierarchy and checks that it is sound. It makes all checks of [`validate`](Self::validate) that need
    /// no mesh: queries end, and their answers are correct for the triangles in it. `[FILE-8]`
    ///
    /// The decoder allocates nothing before it has checked the length, and then in proportion to it. The checksum
    /// detects damage, not deliberate changes. As for [`Bvh::from_bytes`](crate::bvh::Bvh::from_bytes), the check can
    /// take long for bytes that are designed to be slow.
    ///
    /// # Errors
    /// [`WideBvhFileError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, WideBvhFileError> {
        let (header, body) = opened(bytes, MAGIC, |&[_, slots, _, nodes, blocks, ..]: &[u32; HEADER_WORDS]| {
            if slots & !DOUBLE != A as u32 {
                return Err(FileError::Field { name: "slots", value: slots });
            }
            let (expected, found) = (V::REAL_BYTES, if slots & DOUBLE == 0 { 4 } else { 8 });
            if found == expected {
                Ok(file_bytes::<A, V>(nodes, blocks))
            } else {
                Err(FileError::Numbers { expected, found })
            }
        })?;
        let [_, _, levels, node_count, _, triangles, duplicates] = header;
        let (frame, body) = body.split_at(frame_bytes::<V>());
        let frame = read_frame::<V>(frame).map_err(|value| FileError::Field { name: "exponent", value })?;
        let (nodes, blocks) = body.split_at(node_count as usize * node_bytes::<A>());
        let mut nodes: Vec<_> = nodes.chunks_exact(node_bytes::<A>()).map(read_node).collect();
        let blocks = blocks.chunks_exact(block_bytes::<V>()).map(read_block).collect();
        name_ancestors(&mut nodes, |i| i as u32);
        let own = |node: &WideNode<A>| (0..A as u32).map(|slot| node.child_box(slot)).fold(Aabb::EMPTY, Aabb::union);
        let region = match nodes.first() {
            Some(root) if root.children != [0; A] => Region::within(frame, &own(root)),
            _ => Region::within(frame, Self::empty().region().bounds()),
        };
        let (triangles, duplicates) = (triangles as usize, duplicates as usize);
        let wide = Self { nodes, blocks, region, levels, triangles, duplicates, least: Least::default() };
        wide.check(None)?;
        Ok(wide)
    }
}

/// Returns the size of a file with these counts in bytes.
const fn file_bytes<const A: usize, V: Stored>(nodes: u32, blocks: u32) -> u64 {
    let fixed = MAGIC.len() + 4 * HEADER_WORDS + frame_bytes::<V>() + size_of::<u64>();
    fixed as u64 + nodes as u64 * node_bytes::<A>() as u64 + blocks as u64 * block_bytes::<V>() as u64
}

/// Returns the slots of a node, with the precision of triangles.
const fn slots<const A: usize, V: Stored>() -> u32 {
    if V::REAL_BYTES == 4 { A as u32 } else { A as u32 + DOUBLE }
}

/// Nine coordinates and an index for each of four triangles.
const fn block_bytes<V: Stored>() -> usize {
    4 * (9 * V::REAL_BYTES as usize + 4)
}

/// Six planes and an address for each slot.
const fn node_bytes<const A: usize>() -> usize {
    4 * 7 * A
}

/// Reads a node, without ancestors and without the set of its leaves.
fn read_node<const A: usize>(bytes: &[u8]) -> WideNode<A> {
    let mut rows = bytes.chunks_exact(4 * A).map(|row| numbers::<4, A>(row).map(u32::from_le_bytes));
    let mut next = || rows.next().unwrap_or([0; A]);
    let planes = std::array::from_fn(|_| std::array::from_fn(|_| next().map(f32::from_bits)));
    WideNode { planes, children: next(), ancestors: [0; A] }
}

fn read_block<V: Precision + Stored>(bytes: &[u8]) -> Block<V> {
    let mut block = Block::EMPTY;
    let (corners, prims) = bytes.split_at(36 * V::REAL_BYTES as usize);
    let reals = corners.chunks_exact(V::REAL_BYTES as usize).map(V::read_real);
    block.corners.as_flattened_mut().as_flattened_mut().iter_mut().zip(reals).for_each(|(x, read)| *x = read);
    block.prims = numbers(prims).map(u32::from_le_bytes);
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

//! Hierarchies as bytes: the format of spec/bvh-file.md.

use std::array;

use glam::{DVec3, Vec3};

use super::least::Least;
use super::{Bvh, BvhError, BvhNode, BvhTree, Leaf, LeafTriangle, validate};
use crate::geom::{Aabb, EnvironmentError, Frame, Region, Triangle, Vector, check_environment};
use crate::hash::checksum;
use crate::tree::{Node, Recorded};

const MAGIC: &str = "SBVHTREE";
pub(super) const VERSION: u32 = 2;
/// Magic, 10 words, 6 planes.
const HEADER_BYTES: usize = 8 + 10 * 4 + 6 * 4;
const NODE_BYTES: usize = 64;
const LEAF_BYTES: usize = 16;
/// The frame of hierarchies in double precision: origin and exponent.
const FRAME_BYTES: usize = 3 * 8 + 4;

/// The values of `recorded` in a file, by position.
const RECORDED: [Recorded; 3] = [Recorded::Nothing, Recorded::ParentSibling, Recorded::Uncles];

/// Errors of decoding; `E` is the validation error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError<E> {
    /// The length does not match the header or its counts.
    #[error("{found} bytes, expected {expected}")]
    Length {
        /// Expected number of bytes.
        expected: u64,
        /// Actual number of bytes.
        found: usize,
    },
    /// The magic number is invalid.
    #[error("not such a hierarchy: it does not begin with {0}")]
    Magic(&'static str),
    /// The version of the format is not supported.
    #[error("version {version} of the format, expected {VERSION}")]
    Version {
        /// Its number.
        version: u32,
    },
    /// Coordinates of corners have another precision.
    #[error("coordinates of {found} bytes, expected {expected}")]
    Numbers {
        /// Bytes of a requested coordinate.
        expected: u32,
        /// Bytes of a coordinate by the header.
        found: u32,
    },
    /// The bytes have changed since they were written.
    #[error("the checksum is {found:#018x}, not {stored:#018x}")]
    Checksum {
        /// The checksum at the end of the file.
        stored: u64,
        /// The checksum of the bytes before it.
        found: u64,
    },
    /// A field of the header has an invalid value.
    #[error("header: {name} is {value}")]
    Field {
        /// Its name.
        name: &'static str,
        /// The number.
        value: u32,
    },
    /// The bytes encode an unsound hierarchy.
    #[error(transparent)]
    Unsound(#[from] E),
    /// This thread's floating-point arithmetic is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(EnvironmentError),
}

/// Errors of [`Bvh::from_bytes`].
pub type BvhFileError = FileError<BvhError>;

/// A corner that can be stored: [`Vec3`] or [`DVec3`].
pub trait Stored: Vector {
    /// Bytes of a coordinate, little-endian; a corner has three coordinates.
    const REAL_BYTES: u32;

    /// Whether boxes are in a [`Frame`] that is also written.
    const HAS_FRAME: bool;

    /// Appends the bytes of a coordinate.
    fn write_real(x: Self::Real, bytes: &mut Vec<u8>);

    /// Reads the coordinate at the start of these bytes. Missing bytes count as zeros.
    fn read_real(bytes: &[u8]) -> Self::Real;

    /// Appends the bytes of a corner.
    fn write(self, bytes: &mut Vec<u8>) {
        self.components().into_iter().for_each(|x| Self::write_real(x, bytes));
    }

    /// Reads the corner at the start of these bytes. Missing bytes count as zeros.
    fn read(bytes: &[u8]) -> Self {
        let mut reals = bytes.chunks(Self::REAL_BYTES as usize).map(Self::read_real);
        Self::from_components(array::from_fn(|_| reals.next().unwrap_or_default()))
    }
}

impl<V: Stored> Bvh<Triangle<V>> {
    /// Encodes the hierarchy, with a checksum. The size is about [`bytes`](Self::bytes). `[FILE-1]` `[FILE-2]`
    /// `[FILE-3]`
    ///
    /// ```
    /// use stackless_bvh::bvh::{Bvh, SahOptions};
    /// use stackless_bvh::generate::procedural;
    ///
    /// let bvh = Bvh::sah(&procedural::soup(1, 100), SahOptions::default())?;
    /// let bytes = bvh.to_bytes();
    /// let back: Bvh = Bvh::from_bytes(&bytes)?;
    /// assert_eq!(back.triangles(), bvh.triangles());
    /// assert_eq!(back.to_bytes(), bytes);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_bytes(&self) -> Vec<u8> {
        let Self { dropped, duplicates, bounds, region, tree, triangles, least: _ } = self;
        let BvhTree { root, depth, recorded, nodes, axes, leaves } = tree;
        let recorded = RECORDED.iter().position(|known| known == recorded).unwrap_or_default();
        let words = [VERSION, V::REAL_BYTES, recorded as u32, root.to_bits(), *depth];
        let counts = [nodes.len(), leaves.len(), triangles.len(), *dropped, *duplicates].map(|count| count as u32);
        let [node_count, leaf_count, triangle_count, ..] = counts;

        let mut bytes = Vec::with_capacity(file_bytes::<V>(node_count, leaf_count, triangle_count) as usize);
        bytes.extend(MAGIC.bytes());
        bytes.extend(words.into_iter().chain(counts).flat_map(u32::to_le_bytes));
        for corner in [bounds.lo, bounds.hi] {
            corner.write(&mut bytes);
        }
        write_frame::<V>(region.frame(), &mut bytes);
        for BvhNode { planes, children, links } in nodes {
            bytes.extend(planes.as_flattened().iter().flat_map(|plane| plane.to_le_bytes()));
            bytes.extend([children, links].into_iter().flatten().flat_map(|node| node.to_bits().to_le_bytes()));
        }
        for &Leaf { first, count, links: [a, b] } in leaves {
            bytes.extend([first, count, a.to_bits(), b.to_bits()].into_iter().flat_map(u32::to_le_bytes));
        }
        for LeafTriangle { shape: Triangle(corners), prim } in triangles {
            for corner in corners {
                corner.write(&mut bytes);
            }
            bytes.extend(prim.to_le_bytes());
        }
        bytes.extend(axes);
        bytes.extend(checksum(&bytes).to_le_bytes());
        bytes
    }

    /// Decodes a hierarchy and checks that it is sound. It makes all checks of [`validate`](super::validate()) that
    /// need no mesh: queries end, and their answers are correct for the triangles in it. `[FILE-5]`
    ///
    /// [`validate`](super::validate()) checks whether these are the triangles of a given mesh. The decoder allocates
    /// nothing before it has checked the length, and then in proportion to it. The checksum detects damage, not
    /// deliberate changes.
    ///
    /// If triangles are divided, rational arithmetic checks that their boxes cover them. This check can take long for
    /// bytes that are designed to be slow.
    ///
    /// # Errors
    /// [`BvhFileError`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BvhFileError> {
        let field = |name, value| BvhFileError::Field { name, value };
        let (header, body) = opened(bytes, MAGIC, |&[_, found, _, _, _, nodes, leaves, triangles, ..]: &[u32; 16]| {
            let expected = V::REAL_BYTES;
            if found != expected {
                return Err(BvhFileError::Numbers { expected, found });
            }
            Ok(file_bytes::<V>(nodes, leaves, triangles))
        })?;
        let [_, _, recorded, root, depth, nodes, leaves, triangles, dropped, duplicates, bounds @ ..] = header;
        let recorded = *RECORDED.get(recorded as usize).ok_or(field("recorded", recorded))?;
        if dropped > Node::MAX_INDEX {
            return Err(field("dropped", dropped));
        }

        // The length is that of all these parts.
        let (frame, mut body) = body.split_at(frame_bytes::<V>());
        let frame = read_frame::<V>(frame).map_err(|exponent| field("exponent", exponent))?;
        let mut take = |count: u32, size: usize| {
            let (taken, rest) = body.split_at(count as usize * size);
            body = rest;
            taken.chunks_exact(size)
        };
        let [x, y, z, end_x, end_y, end_z] = bounds.map(f32::from_bits);
        let bounds = Aabb { lo: Vec3::new(x, y, z), hi: Vec3::new(end_x, end_y, end_z) };
        let nodes_read = take(nodes, NODE_BYTES).map(read_node).collect();
        let leaves = take(leaves, LEAF_BYTES).map(read_leaf).collect();
        let triangles = take(triangles, triangle_bytes::<V>()).map(read_triangle).collect();
        let axes = take(nodes, 1).flatten().copied().collect();
        let tree = BvhTree { root: Node::from_bits(root), depth, recorded, nodes: nodes_read, axes, leaves };
        let (dropped, duplicates) = (dropped as usize, duplicates as usize);
        let bvh = Self {
            dropped,
            duplicates,
            bounds,
            region: Region::within(frame, &bounds),
            tree,
            triangles,
            least: Least::default(),
        };
        validate::check(&bvh)?;
        Ok(bvh)
    }
}

impl Stored for Vec3 {
    const REAL_BYTES: u32 = 4;
    const HAS_FRAME: bool = false;

    #[inline]
    fn write_real(x: f32, bytes: &mut Vec<u8>) {
        bytes.extend(x.to_le_bytes());
    }

    #[inline]
    fn read_real(bytes: &[u8]) -> f32 {
        let [x] = numbers(bytes).map(f32::from_le_bytes);
        x
    }
}

impl Stored for DVec3 {
    const REAL_BYTES: u32 = 8;
    const HAS_FRAME: bool = true;

    #[inline]
    fn write_real(x: f64, bytes: &mut Vec<u8>) {
        bytes.extend(x.to_le_bytes());
    }

    #[inline]
    fn read_real(bytes: &[u8]) -> f64 {
        let [x] = numbers(bytes).map(f64::from_le_bytes);
        x
    }
}

/// Returns the words of the header, the version first, and the body, of a file with correct length and checksum. The
/// header determines the length.
pub(super) fn opened<'b, E, const WORDS: usize>(
    bytes: &'b [u8],
    magic: &'static str,
    length: impl Fn(&[u32; WORDS]) -> Result<u64, FileError<E>>,
) -> Result<([u32; WORDS], &'b [u8]), FileError<E>> {
    check_environment().map_err(FileError::Environment)?;
    let header_bytes = magic.len() + 4 * WORDS;
    let wrong_length = |expected| FileError::Length { expected, found: bytes.len() };
    let too_short = || wrong_length((header_bytes + size_of::<u64>()) as u64);
    let (content, stored) = bytes.split_last_chunk().ok_or_else(too_short)?;
    let (header, body) = content.split_at_checked(header_bytes).ok_or_else(too_short)?;
    let words = header.strip_prefix(magic.as_bytes()).ok_or(FileError::Magic(magic))?;
    let words = numbers(words).map(u32::from_le_bytes);
    if words[0] != VERSION {
        return Err(FileError::Version { version: words[0] });
    }
    let expected = length(&words)?;
    if bytes.len() as u64 != expected {
        return Err(wrong_length(expected));
    }
    let (stored, found) = (u64::from_le_bytes(*stored), checksum(content));
    if stored == found { Ok((words, body)) } else { Err(FileError::Checksum { stored, found }) }
}

/// Returns the size of a file with these counts in bytes.
fn file_bytes<V: Stored>(nodes: u32, leaves: u32, triangles: u32) -> u64 {
    let of = |count: u32, size: usize| u64::from(count) * size as u64;
    let fixed = HEADER_BYTES + frame_bytes::<V>() + size_of::<u64>();
    fixed as u64 + of(nodes, NODE_BYTES + 1) + of(leaves, LEAF_BYTES) + of(triangles, triangle_bytes::<V>())
}

const fn triangle_bytes<V: Stored>() -> usize {
    9 * V::REAL_BYTES as usize + 4
}

pub(super) const fn frame_bytes<V: Stored>() -> usize {
    if V::HAS_FRAME { FRAME_BYTES } else { 0 }
}

pub(super) fn write_frame<V: Stored>(frame: &Frame, bytes: &mut Vec<u8>) {
    if V::HAS_FRAME {
        frame.origin().write(bytes);
        bytes.extend(frame.exponent().to_le_bytes());
    }
}

/// Reads the frame. The error is the invalid exponent, also if the origin is not finite.
pub(super) fn read_frame<V: Stored>(bytes: &[u8]) -> Result<Frame, u32> {
    if !V::HAS_FRAME {
        return Ok(Frame::IDENTITY);
    }
    let (origin, exponent) = bytes.split_at(FRAME_BYTES - 4);
    let [exponent] = numbers(exponent).map(u32::from_le_bytes);
    Frame::new(DVec3::read(origin), exponent as i32).ok_or(exponent)
}

fn read_node(bytes: &[u8]) -> BvhNode {
    let [planes @ .., left, right, a, b] = numbers::<_, 16>(bytes).map(u32::from_le_bytes);
    let planes = planes.map(f32::from_bits);
    BvhNode {
        planes: array::from_fn(|axis| array::from_fn(|plane| planes[4 * axis + plane])),
        children: [left, right].map(Node::from_bits),
        links: [a, b].map(Node::from_bits),
    }
}

fn read_leaf(bytes: &[u8]) -> Leaf {
    let [first, count, a, b] = numbers(bytes).map(u32::from_le_bytes);
    Leaf { first, count, links: [a, b].map(Node::from_bits) }
}

fn read_triangle<V: Stored>(bytes: &[u8]) -> LeafTriangle<Triangle<V>> {
    let mut corners = bytes.chunks_exact(3 * V::REAL_BYTES as usize);
    let shape = Triangle(array::from_fn(|_| V::read(corners.next().unwrap_or_default())));
    let [prim] = numbers(corners.remainder()).map(u32::from_le_bytes);
    LeafTriangle { shape, prim }
}

/// Reads the numbers at the start of these bytes. Missing bytes count as zeros.
#[inline]
pub(super) fn numbers<const SIZE: usize, const COUNT: usize>(bytes: &[u8]) -> [[u8; SIZE]; COUNT] {
    let (numbers, _) = bytes.as_chunks();
    array::from_fn(|i| numbers.get(i).copied().unwrap_or([0; SIZE]))
}

#[cfg(test)]
pub(super) mod tests;

//! A hierarchy of eight children in the format of kernels: records of 128 bytes, with boxes of six bytes.
//!
//! A box is in bytes, as in Ylitie, Karras & Laine 2017. Each plane is a number of steps from the least corner of all
//! boxes of its node. A step is a power of two for each axis. Planes are rounded outwards by the arithmetic of the
//! device, so the tested box contains the original box (`wgsl/eight/search_ray.wgsl`).

use stackless_bvh::bvh::wide::{WideNode, WideOptions};
use stackless_bvh::bvh::{BuildOptions, WideBvh};
use stackless_bvh::geom::{Mesh, Triangle};
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Tables, Topology as _};

use crate::kernel::SLOTS;
use crate::layout::{HashTables, TableHead, push_leaf};
use crate::{Gpu, GpuError};

/// Words of an inner node.
const WORDS: usize = 32;
/// Start of the words for the search, after children and ancestors.
const SEARCH_AT: usize = 2 * SLOTS;
/// The maximum byte.
const MOST_STEPS: u32 = 255;
/// Exponents of steps in the format of a float. A step is at least 2^-62, so no sum of a corner and steps is below the
/// least normal number unless the corner is.
const EXPONENTS: std::ops::RangeInclusive<u32> = 65..=254;

/// The hierarchy of eight children over a mesh that kernels trace fastest. Its leaves are small, because a lane tests
/// triangles one by one.
///
/// # Errors
/// [`GpuError::Data`] for too many nodes or triangles.
pub fn hierarchy(mesh: &Mesh) -> Result<WideBvh, GpuError> {
    let data = |error: &dyn std::fmt::Display| GpuError::Data(error.to_string());
    let binary = BuildOptions::fine().build(mesh).map_err(|error| data(&error))?;
    let options = WideOptions { max_leaf: 4, ..WideOptions::default() };
    WideBvh::with_options(&binary, &options).map_err(|error| data(&error))
}

/// A hierarchy with its words for kernels.
#[derive(Debug)]
pub struct Eight {
    bvh: WideBvh,
    /// Inner nodes, in the order of the hierarchy.
    nodes: Vec<u32>,
    /// Triangles, in the format of binary hierarchies.
    leaves: Vec<u32>,
}

/// A hierarchy on the device, with the table of `wide-hashed`.
#[derive(Debug)]
pub(super) struct OnDevice {
    pub(super) records: Eight,
    /// Nodes, leaves, displacements and cells.
    pub(super) buffers: [wgpu::Buffer; 4],
    pub(super) head: TableHead,
}

impl OnDevice {
    pub(super) fn new(gpu: &Gpu, bvh: WideBvh) -> Result<Self, GpuError> {
        let records = Eight::new(bvh);
        let mut tables = HashTables::default();
        let built = Tables::new(&records.bvh);
        let hash = built.hash().map_err(|unfit| GpuError::Data(unfit.to_string()))?;
        let head = tables.add_hash(hash, address);
        let buffers = [
            gpu.buffer("wide nodes", &records.nodes)?,
            gpu.buffer("wide leaves", &records.leaves)?,
            gpu.buffer("displacements", &tables.displacements)?,
            gpu.buffer("cells", &tables.cells)?,
        ];
        Ok(Self { records, buffers, head })
    }
}

/// The address of an inner node, in pieces of 16 bytes.
fn address(node: Node) -> u32 {
    (WORDS / 4 * node.index()) as u32
}

impl Eight {
    /// Writes the records of a hierarchy.
    pub fn new(bvh: WideBvh) -> Self {
        let (mut nodes, mut leaves) = (Vec::with_capacity(WORDS * bvh.nodes().len()), Vec::new());
        for node in bvh.nodes() {
            let mut words = [0; WORDS];
            for slot in slots(node) {
                let child = node.child(slot);
                words[slot as usize] = if child.is_leaf() {
                    let offset = (leaves.len() / 4) as u32;
                    push_leaf(&mut leaves, triangles(&bvh, child));
                    !offset
                } else {
                    address(child)
                };
            }
            for up in 1..=SLOTS as u32 {
                words[SLOTS + up as usize - 1] = address(node.ancestor(up));
            }
            words[SEARCH_AT..].copy_from_slice(&boxes(node));
            nodes.extend(words);
        }
        Self { bvh, nodes, leaves }
    }

    /// The hierarchy.
    pub fn bvh(&self) -> &WideBvh {
        &self.bvh
    }

    /// The maximum level of an inner node.
    pub fn levels(&self) -> u32 {
        self.bvh.levels()
    }

    /// The triangles of a leaf, with their indices.
    pub fn triangles(&self, leaf: Node) -> impl Iterator<Item = (Triangle, u32)> + '_ {
        triangles(&self.bvh, leaf)
    }

    /// Lower and upper plane of the box in a slot, decoded from the words of the device.
    pub fn planes(&self, node: Node, slot: u32, axis: usize) -> [f32; 2] {
        let words = &self.nodes[WORDS * node.index() + SEARCH_AT..][..WORDS - SEARCH_AT];
        let (corner, step) = (f32::from_bits(words[axis]), step_of(words[3] >> (8 * axis) & 0xff));
        [0, 2].map(|side| {
            let four = words[4 + 4 * axis + side + slot as usize / 4];
            plane(corner, step, four >> (8 * (slot % 4)) & 0xff)
        })
    }
}

fn slots(node: &WideNode<SLOTS>) -> impl Iterator<Item = u32> {
    (0..SLOTS as u32).filter(|&slot| node.has_child(slot))
}

fn triangles(bvh: &WideBvh, leaf: Node) -> impl Iterator<Item = (Triangle, u32)> + '_ {
    let (blocks, count) = bvh.leaf(leaf);
    (0..count as usize).map(|i| (blocks[i / 4].triangle(i % 4), blocks[i / 4].prims[i % 4]))
}

/// The words for the search: the least corner, the exponents and the set of children, then the planes of each axis.
fn boxes(node: &WideNode<SLOTS>) -> [u32; WORDS - SEARCH_AT] {
    let mut words = [0; WORDS - SEARCH_AT];
    for axis in 0..3 {
        let of = |side: usize| slots(node).map(move |slot| node.planes[axis][side][slot as usize]);
        let (Some(corner), Some(top)) = (of(0).reduce(f32::min), of(1).reduce(f32::max)) else { break };
        let exponent = exponent(corner, top);
        let step = step_of(exponent);
        words[axis] = corner.to_bits();
        words[3] |= exponent << (8 * axis);
        for slot in slots(node) {
            let at = 4 + 4 * axis + slot as usize / 4;
            let [lower, upper] = node.planes[axis].map(|planes| planes[slot as usize]);
            words[at] |= steps_below(corner, step, lower) << (8 * (slot % 4));
            words[at + 2] |= steps_above(corner, step, upper) << (8 * (slot % 4));
        }
    }
    words[3] |= slots(node).fold(0, |set, slot| set | 1 << slot) << 24;
    words
}

/// The plane at this number of steps from the corner. The product is exact, so every kind of `fma` gives an equal
/// result.
fn plane(corner: f32, step: f32, steps: u32) -> f32 {
    steps as f32 * step + corner
}

fn step_of(exponent: u32) -> f32 {
    f32::from_bits(exponent << 23)
}

/// The exponent of the smallest step such that the last plane is at least `top`.
fn exponent(corner: f32, top: f32) -> u32 {
    let reaches = |&exponent: &u32| plane(corner, step_of(exponent), MOST_STEPS) >= top;
    EXPONENTS.into_iter().find(reaches).unwrap_or(*EXPONENTS.end())
}

/// Number of steps to the last plane that is at most `lower`, or to the plane before it. The quotient may be rounded to
/// an integer.
fn steps_below(corner: f32, step: f32, lower: f32) -> u32 {
    let mut steps = (((f64::from(lower) - f64::from(corner)) / f64::from(step)) as u32).min(MOST_STEPS);
    while steps > 0 && plane(corner, step, steps) > lower {
        steps -= 1;
    }
    steps
}

/// Number of steps to the first plane that is at least `upper`, or to the plane after it.
fn steps_above(corner: f32, step: f32, upper: f32) -> u32 {
    let mut steps = (((f64::from(upper) - f64::from(corner)) / f64::from(step)).ceil() as u32).min(MOST_STEPS);
    while steps < MOST_STEPS && plane(corner, step, steps) < upper {
        steps += 1;
    }
    steps
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use stackless_bvh::generate::procedural;

    use super::*;

    /// For coordinates near 0 and far from 0, and boxes without volume: every box contains the original box, and is at
    /// most two steps larger.
    #[test]
    fn boxes_of_bytes_hold_those_of_floats() {
        let soup = procedural::soup(1, 2000);
        let moves = [(1.0, Vec3::ZERO), (1e-6, Vec3::splat(3.0)), (1e9, Vec3::new(-4e10, 7.0, 0.0)), (0.0, Vec3::ONE)];
        let mut is_larger = 0;
        for (scale, by) in moves {
            let moved = soup.vertices().iter().map(|&v| v * scale + by).collect();
            let mesh = Mesh::new(moved, soup.triangles().to_vec()).unwrap();
            let records = Eight::new(hierarchy(&mesh).unwrap());
            for (i, node) in records.bvh().nodes().iter().enumerate() {
                let step = |axis: usize| step_of(records.nodes[WORDS * i + SEARCH_AT + 3] >> (8 * axis) & 0xff);
                for (slot, axis) in slots(node).flat_map(|slot| [0, 1, 2].map(|axis| (slot, axis))) {
                    let [lower, upper] = node.planes[axis].map(|planes| planes[slot as usize]);
                    let [below, above] = records.planes(Node::inner(i as u32), slot, axis);
                    assert!(below <= lower && upper <= above, "{below} {lower} {upper} {above}");
                    let rounding = upper.abs().max(lower.abs()) * f32::EPSILON;
                    assert!((lower - below).max(above - upper) <= 2.0 * step(axis) + rounding);
                    is_larger += usize::from(below < lower) + usize::from(upper < above);
                }
            }
        }
        assert!(is_larger > 10_000, "{is_larger}");
    }

    /// Planes so near to a multiple of the step that the quotient is rounded to an integer.
    #[test]
    fn a_quotient_that_is_rounded_is_mended() {
        let (corner, step) = (-f32::exp2(40.0), f32::exp2(33.0));
        assert_eq!([steps_below(corner, step, -1e-20), steps_below(corner, step, 0.0)], [127, 128]);
        assert_eq!([steps_above(corner, step, 1e-20), steps_above(corner, step, 0.0)], [129, 128]);
    }
}

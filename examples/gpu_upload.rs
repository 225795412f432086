//! A hierarchy as words for a GPU: nodes of 64 bytes with uncle and grand uncle, leaves, triangles, and the perfect
//! hash.
//!
//! `cargo run --release --example gpu_upload`. Kernels in WGSL that read such buffers, and the checks that hold them to
//! the oracle, are in `gpu-check`.

use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::generate::procedural;
use stackless_bvh::hash::{self, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::tree::{Reach, Recorded, Topology};

/// Buffers of 32-bit words, as they are uploaded.
#[derive(Debug, Default)]
struct Buffers {
    /// 16 words each: 12 planes, two children, uncle and grand uncle.
    nodes: Vec<u32>,
    /// First triangle, number of triangles, uncle and grand uncle.
    leaves: Vec<u32>,
    /// 9 coordinates and the index of the triangle in the mesh.
    triangles: Vec<u32>,
    displacements: Vec<u32>,
    cells: Vec<u32>,
}

/// Builds the buffers of a scene.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = procedural::strands(1, 100);
    let bvh = Bvh::sah(&mesh, SahOptions::default())?.with_links(Recorded::Uncles);
    let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::Tight };
    let table = PerfectHash::build(&bvh, options)?;
    // A table from another source, such as a GPU, is also certified in linear time.
    hash::certify(&table, &bvh, options.key_set)?;

    let mut buffers = Buffers::default();
    for node in bvh.nodes() {
        buffers.nodes.extend(node.planes.as_flattened().iter().map(|plane| plane.to_bits()));
        buffers.nodes.extend(node.children.iter().chain(&node.links).map(|node| node.to_bits()));
    }
    for leaf in bvh.leaves() {
        buffers.leaves.extend([leaf.first, leaf.count]);
        buffers.leaves.extend(leaf.links.iter().map(|node| node.to_bits()));
    }
    for held in bvh.triangles() {
        let corners = held.shape.0.iter().flat_map(glam::Vec3::to_array);
        buffers.triangles.extend(corners.map(f32::to_bits).chain([held.prim]));
    }
    buffers.displacements.extend(table.displacements());
    buffers.cells.extend(table.cells());

    let words = buffers.nodes.len() + buffers.leaves.len() + buffers.triangles.len();
    let of_table = buffers.displacements.len() + buffers.cells.len();
    println!("depth {}: {} bytes of tree, {} of table", bvh.depth(), 4 * words, 4 * of_table);
    assert_eq!(buffers.nodes.len(), 16 * bvh.nodes().len());
    Ok(())
}

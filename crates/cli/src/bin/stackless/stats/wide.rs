//! The hierarchy of eight children, which `trace` and `render` use.

use serde::Serialize;
use stackless_bvh::bvh::WideBvh;
use stackless_bvh::trace::Tracer;
use stackless_bvh::wide::{Method, Topology};

use super::timed;
use crate::build::Build;
use crate::input::Scene;
use crate::output::{Table, grouped, table};

#[derive(Serialize)]
pub(super) struct WideStats {
    /// How the binary hierarchy was built that it is made of.
    build: String,
    nodes: usize,
    /// Children of an inner node, mean.
    children: f64,
    /// Triangles of a leaf, mean.
    leaf_triangles: f64,
    /// Level of the deepest inner node.
    levels: u32,
    bytes: usize,
    bytes_per_triangle: f64,
    /// Of the binary hierarchy, on all threads.
    build_seconds: f64,
    /// From the binary hierarchy to this one, on all threads.
    collapse_seconds: f64,
    traversals: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    method: &'static str,
    state_bytes: usize,
    /// Of the tables that it needs.
    table_bytes: usize,
    table_seconds: f64,
}

pub(super) fn measure(scene: &Scene) -> Result<WideStats, Box<dyn std::error::Error>> {
    let build = Build::chosen_wide(None);
    let (fine, build_seconds) = timed(|| build.run_fine(scene));
    let fine = fine?;
    let (wide, collapse_seconds) = timed(|| WideBvh::<8>::of(&fine));
    let wide = wide?;
    let mut traversals = Vec::new();
    for method in Method::ALL {
        let (tracer, table_seconds) = timed(|| Tracer::with_method(&wide, method));
        let (state_bytes, table_bytes) = (method.state_bytes::<8>(wide.levels() as usize), tracer?.bytes());
        traversals.push(Row { method: method.name(), state_bytes, table_bytes, table_seconds });
    }
    let nodes = wide.nodes();
    let children: u32 = nodes.iter().map(|node| (0..8).map(|slot| u32::from(node.has_child(slot))).sum::<u32>()).sum();
    let leaves: u32 = nodes.iter().map(|node| node.leaves().count_ones()).sum();
    let references = fine.triangles().len() as f64;
    Ok(WideStats {
        build: build.to_string(),
        nodes: nodes.len(),
        children: f64::from(children) / nodes.len() as f64,
        leaf_triangles: references / f64::from(leaves.max(1)),
        levels: wide.levels(),
        bytes: wide.bytes(),
        bytes_per_triangle: wide.bytes() as f64 / scene.mesh.triangles().len() as f64,
        build_seconds,
        collapse_seconds,
        traversals,
    })
}

impl WideStats {
    pub(super) fn line(&self) -> String {
        format!(
            "eight children: {} inner nodes of {:.1}, leaves of {:.1} triangles, {} levels, {} bytes ({:.1} a triangle); {} in {:.1} ms, made wide in {:.1} ms",
            grouped(self.nodes as u64),
            self.children,
            self.leaf_triangles,
            self.levels + 1,
            grouped(self.bytes as u64),
            self.bytes_per_triangle,
            self.build,
            self.build_seconds * 1e3,
            self.collapse_seconds * 1e3
        )
    }

    pub(super) fn to_table(&self) -> Table {
        let row = |row: &Row| {
            let bytes = [row.state_bytes, row.table_bytes].map(|bytes| grouped(bytes as u64));
            let [state, tables] = bytes;
            vec![row.method.to_owned(), state, tables, format!("{:.2}", row.table_seconds * 1e3)]
        };
        table(&["of eight children", "bytes of state", "of tables", "ms"], 1, self.traversals.iter().map(row).collect())
    }
}

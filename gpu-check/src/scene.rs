//! A hierarchy and its rays on the device.

mod eight;

pub use eight::{Eight, hierarchy};

use std::fmt::Write as _;

use stackless_bvh::bvh::{Bvh, WideBvh};
use stackless_bvh::geom::Ray;
use stackless_bvh::tree::{Node, Topology as _};

use crate::kernel::{Kernel, Links, Record, Shape, Table, Traversal};
use crate::layout::{Addresses, HashTables, Records, TableHead, links, push_leaf};
use crate::model::{CLAMPED_RECIPROCAL, has_parallel, ray_words};
use crate::probe::Arithmetic;
use crate::{Gpu, GpuError};

/// Maximum magnitude of coordinates.
const MOST: f32 = (1_u64 << 40) as f32;
/// Minimum magnitude of nonzero numbers: they and their differences are then normal, or 0.
const LEAST: f32 = f32::from_bits((127 - 100) << 23);
/// Minimum and maximum magnitude of the largest component of a direction.
const DIRECTIONS: [f32; 2] = [1.0 / (1 << 20) as f32, (1 << 20) as f32];

/// A hierarchy of two children, and optionally one of eight, with records and tables for all kernels.
#[derive(Debug)]
pub struct Scene {
    /// By kind of link: nodes and leaves.
    records: [[wgpu::Buffer; 2]; 2],
    /// Printed and tight: displacements, cells, and parameters.
    tables: [([wgpu::Buffer; 2], TableHead); 2],
    root: u32,
    depth: u32,
    is_in_parts: bool,
    eight: Option<eight::OnDevice>,
}

/// A hierarchy in the format of one kernel.
#[derive(Debug)]
pub struct Placed<'a> {
    /// Nodes, leaves, displacements and cells.
    pub buffers: [&'a wgpu::Buffer; 4],
    /// Depth in edges; for eight children, in levels.
    pub depth: u32,
    head: &'a TableHead,
    root: u32,
}

/// The query of rays.
#[derive(Clone, Copy, Debug)]
pub struct Query<'a> {
    /// The parts of the search that test triangles.
    pub triangles: &'a str,
    /// Whether it is an any-hit query.
    pub any: bool,
    /// Whether some ray has a component that counts as 0.
    pub parallel: bool,
    /// Whether divisions need an additional step.
    pub refines: bool,
}

/// Möller & Trumbore's test in single precision.
pub const SINGLE: &str = include_str!("../wgsl/triangle_single.wgsl");

impl Scene {
    /// Uploads a hierarchy.
    ///
    /// # Errors
    /// [`GpuError::Data`] for unsupported coordinates; other errors of the device.
    pub fn new(gpu: &Gpu, bvh: &Bvh) -> Result<Self, GpuError> {
        if !takes(bvh) {
            return Err(GpuError::Data(format!("coordinates beyond {MOST}, or below {LEAST} and not 0")));
        }
        let pieces = |leaf: Node| 3 * bvh.leaf_triangles(leaf).len() as u32 + 1;
        let (addresses, inner, leaves) = Addresses::of(bvh, 0, 0, pieces);
        if 4 * u64::from(inner) >= 1 << 30 || u64::from(leaves) >= 1 << 30 {
            return Err(GpuError::Data("more nodes or triangles than addresses".to_owned()));
        }
        let mut records = Records::default();
        records.fill(bvh, &addresses);
        let mut upload = |kind| {
            records.link(bvh, &addresses, kind);
            Ok::<_, GpuError>([gpu.buffer("nodes", &records.nodes)?, gpu.buffer("leaves", &records.leaves)?])
        };
        let buffers = [upload(Links::Uncles)?, upload(Links::Parents)?];
        let table = |table| {
            let mut tables = HashTables::default();
            let head = tables.add(bvh, &addresses, table).map_err(|error| GpuError::Data(error.to_string()))?;
            let buffers = [gpu.buffer("displacements", &tables.displacements)?, gpu.buffer("cells", &tables.cells)?];
            Ok::<_, GpuError>((buffers, head))
        };
        Ok(Self {
            records: buffers,
            tables: [table(Table::Printed)?, table(Table::Tight)?],
            root: addresses.at(bvh, bvh.root()),
            depth: bvh.depth(),
            is_in_parts: bvh.duplicates() > 0,
            eight: None,
        })
    }

    /// Also uploads the hierarchy of eight children over the mesh.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn with_eight(self, gpu: &Gpu, bvh: WideBvh) -> Result<Self, GpuError> {
        Ok(Self { eight: Some(eight::OnDevice::new(gpu, bvh)?), ..self })
    }

    /// Depth of the hierarchy of two children, in edges.
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// The records of eight children.
    pub fn eight(&self) -> Option<&Eight> {
        self.eight.as_ref().map(|eight| &eight.records)
    }

    /// The hierarchy for a kernel. The kernel's words must support the depth. A kernel that prunes by leaves needs
    /// whole triangles in them. `[DISJOINT-5]` `[WIDE-14]`
    ///
    /// # Errors
    /// [`GpuError::Data`] with the reason why the kernel cannot be launched.
    pub fn placed(&self, kernel: &Kernel) -> Result<Placed<'_>, GpuError> {
        let refused = |why: String| Err(GpuError::Data(format!("{}: {why}", kernel.full_name())));
        let depth = match &self.eight {
            Some(eight) if kernel.is_wide() => eight.records.levels(),
            None if kernel.is_wide() => return refused("there is no hierarchy of eight children".to_owned()),
            _ => self.depth,
        };
        if let Some(limit) = kernel.depth_limit().filter(|&limit| limit < depth) {
            return refused(format!("the hierarchy is {depth} deep, and its words carry {limit}"));
        }
        if self.is_in_parts && kernel.traversal == Traversal::HashedDisjoint {
            return refused("leaves hold parts of triangles".to_owned());
        }
        if let Some(eight) = self.eight.as_ref().filter(|_| kernel.is_wide()) {
            return Ok(Placed { buffers: eight.buffers.each_ref(), depth, head: &eight.head, root: 0 });
        }
        let [nodes, leaves] = self.records[usize::from(kernel.links() == Links::Parents)].each_ref();
        let (tables, head) = &self.tables[usize::from(kernel.table() == Some(Table::Tight))];
        let [displacements, cells] = tables.each_ref();
        Ok(Placed { buffers: [nodes, leaves, displacements, cells], depth, head, root: self.root })
    }

    /// The text of a kernel for scenes of up to this depth. The kernel reads the [`head`](Placed::head) of each scene.
    pub fn source_for_any(gpu: &Gpu, kernel: &Kernel, query: Query<'_>, depth: u32) -> String {
        let head = [include_str!("../wgsl/head.wgsl"), include_str!("../wgsl/scene_read.wgsl")].concat();
        source(gpu, kernel, query, depth, head)
    }
}

impl Placed<'_> {
    /// The text of a kernel for this scene.
    pub fn source(&self, gpu: &Gpu, kernel: &Kernel, query: Query<'_>) -> String {
        let Self { head, root, depth, .. } = *self;
        let mut search = String::new();
        for (name, value) in [
            ("root", root),
            ("DIRECT_MASK", head.mask),
            ("DISPLACEMENTS_AT", head.displacements_at),
            ("TABLE_SIZE", head.size),
            ("CELLS_AT", head.cells_at),
        ] {
            let _ = writeln!(search, "const {name} = {value}u;");
        }
        for (name, value) in
            [("RECIPROCAL", head.reciprocal), ("SEED", head.mix.seed.unwrap_or(0)), ("FOLD_SEED", head.fold_seed)]
        {
            let _ = writeln!(search, "const {name} = vec2({}u, {}u);", value as u32, value >> 32);
        }
        for (name, value) in [("IS_SEEDED", head.mix.seed.is_some()), ("IS_NARROW", head.mix.narrow)] {
            let _ = writeln!(search, "const {name} = {value};");
        }
        search.push_str("fn begin_scene() {}\n");
        source(gpu, kernel, query, depth, search)
    }

    /// The words of this scene for kernels that are compiled for any scene. They follow the rays.
    pub const fn head(&self) -> [u32; 16] {
        self.head.words(self.root, 0)
    }
}

/// The text of a kernel, after the constants of its scene.
fn source(gpu: &Gpu, kernel: &Kernel, query: Query<'_>, depth: u32, mut search: String) -> String {
    let _ = writeln!(search, "const CLAMPED_RECIPROCAL = {}u;", CLAMPED_RECIPROCAL.to_bits());
    for (name, value) in [("ANY_HIT", query.any), ("HAS_PARALLEL", query.parallel), ("REFINES", query.refines)] {
        let _ = writeln!(search, "const {name} = {value};");
    }
    search.push_str(kernel.ray_search());
    search.push_str(query.triangles);
    kernel.source(Shape { depth, subgroups: gpu.has_subgroups() }, &search, Record::Nothing)
}

impl Query<'_> {
    /// The closest-hit or any-hit query of these rays, in single precision.
    ///
    /// # Errors
    /// [`GpuError::Feature`] for a device whose divisions have no model.
    pub fn single(arithmetic: &Arithmetic, rays: &[Ray], any: bool) -> Result<Self, GpuError> {
        let (parallel, refines) = (rays.iter().any(has_parallel), arithmetic.refines()?);
        Ok(Self { triangles: SINGLE, any, parallel, refines })
    }
}

/// Whether kernels support a hierarchy `[BAND-1]`: coordinates and planes that are 0 or from 2^-100 to 2^40.
pub fn takes(bvh: &Bvh) -> bool {
    // Planes of split triangles are not coordinates of corners.
    let planes = bvh.nodes().iter().flat_map(|node| node.planes).flatten();
    let corners = bvh.triangles().iter().flat_map(|held| held.shape.0).flat_map(|corner| corner.to_array());
    planes.chain(corners).all(is_taken)
}

/// Whether kernels support a ray `[BAND-1]`: an origin with such coordinates, a direction whose largest component is
/// within 2^-20 and 2^20, and no other number below 2^-100 except 0.
pub fn takes_ray(ray: &Ray) -> bool {
    let size = ray.direction().abs().max_element();
    let is_normal = |x: f32| x == 0.0 || x.abs() >= LEAST;
    let others = ray.direction().to_array().into_iter().chain([ray.tmin(), ray.tmax()]);
    ray.origin().to_array().into_iter().all(is_taken)
        && (DIRECTIONS[0]..=DIRECTIONS[1]).contains(&size)
        && others.into_iter().all(is_normal)
}

fn is_taken(x: f32) -> bool {
    x == 0.0 || (LEAST..=MOST).contains(&x.abs())
}

/// The words of rays.
///
/// # Errors
/// [`GpuError::Data`] for an unsupported ray.
pub fn rays_words(rays: &[Ray]) -> Result<Vec<u32>, GpuError> {
    let mut words = Vec::with_capacity(12 * rays.len());
    for (i, ray) in rays.iter().enumerate() {
        if !takes_ray(ray) {
            return Err(GpuError::Data(format!("ray {i}: beyond what kernels take")));
        }
        words.extend(ray_words(ray));
    }
    Ok(words)
}

impl Records {
    /// Writes boxes, children and triangles of a hierarchy.
    fn fill(&mut self, bvh: &Bvh, addresses: &Addresses) {
        self.nodes = vec![0; 16 * bvh.nodes().len()];
        self.leaves = Vec::new();
        for (i, node) in bvh.nodes().iter().enumerate() {
            let [[a0, a1, b0, b1], [c0, c1, d0, d1], [e0, e1, f0, f1]] = node.planes;
            let boxes = [a0, a1, c0, c1, b0, b1, d0, d1, e0, e1, f0, f1].map(f32::to_bits);
            let at = addresses.at(bvh, Node::inner(i as u32)) as usize * 4;
            self.nodes[at..at + 12].copy_from_slice(&boxes);
            let children = node.children.map(|child| addresses.at(bvh, child));
            self.nodes[at + 12..at + 14].copy_from_slice(&children);
        }
        let mut ordered: Vec<Node> = (0..bvh.leaves().len() as u32).map(Node::leaf).collect();
        ordered.sort_by_key(|&leaf| !addresses.at(bvh, leaf));
        for leaf in ordered {
            debug_assert_eq!(self.leaves.len(), 4 * !addresses.at(bvh, leaf) as usize);
            push_leaf(&mut self.leaves, bvh.leaf_triangles(leaf).iter().map(|held| (held.shape, held.prim)));
        }
    }

    /// Writes the links of a kind into records and terminators.
    fn link(&mut self, bvh: &Bvh, addresses: &Addresses, kind: Links) {
        let rows = links(bvh, addresses, kind);
        for i in 0..bvh.nodes().len() as u32 {
            let node = Node::inner(i);
            let at = addresses.at(bvh, node) as usize * 4 + 14;
            self.nodes[at..at + 2].copy_from_slice(&rows[bvh.slot(node)][..2]);
        }
        for i in 0..bvh.leaves().len() as u32 {
            let leaf = Node::leaf(i);
            let end = !addresses.at(bvh, leaf) as usize + 3 * bvh.leaf_triangles(leaf).len();
            self.leaves[4 * end + 1..4 * end + 4].copy_from_slice(&rows[bvh.slot(leaf)]);
        }
    }
}

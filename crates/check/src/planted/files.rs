//! Hierarchies as bytes, to be changed, and traced as they are: spec/bvh-file.md.

use glam::Vec3;

use super::layers::Hits;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::geom::{Aabb, Kernel, Mesh, Ray, Region, Slabs, Triangle};
use stackless_bvh::trace::Hit;
use stackless_bvh::tree::Node;

/// What an implementation answers with these tests.
pub(super) fn cast<K, B>(mesh: &Mesh, rays: &[Ray]) -> Option<Hits>
where
    K: Kernel<Vector = Vec3, Shape = Triangle>,
    B: Slabs<Vector = Vec3>,
{
    Some(File::of(&hierarchy(mesh)?).cast::<K, B>(rays))
}

/// A hierarchy with a triangle in each leaf, as an implementation has it that does not check what it has.
pub(super) fn hierarchy(mesh: &Mesh) -> Option<Bvh> {
    Bvh::sah(mesh, SahOptions { max_leaf: 1, ..SahOptions::default() }).ok()
}

/// A hierarchy as bytes, without the checksum: spec/bvh-file.md.
pub(super) struct File {
    pub(super) bytes: Vec<u8>,
    /// Numbers of inner nodes, leaves and triangles.
    pub(super) counts: [usize; 3],
}

pub(super) const ROOT: usize = 20;
pub(super) const DEPTH: usize = 24;
pub(super) const BOUNDS: usize = 48;
pub(super) const HEADER_BYTES: usize = 72;
pub(super) const PLANES_BYTES: usize = 48;

impl File {
    pub(super) fn of(bvh: &Bvh) -> Self {
        let mut bytes = bvh.to_bytes();
        bytes.truncate(bytes.len() - size_of::<u64>());
        Self { bytes, counts: [bvh.nodes().len(), bvh.leaves().len(), bvh.triangles().len()] }
    }

    /// Where the record of an inner node begins, that of a leaf, that of a triangle; of the first one where there are
    /// fewer.
    pub(super) fn node(&self, at: usize) -> usize {
        HEADER_BYTES + 64 * (at % self.counts[0].max(1))
    }

    pub(super) fn leaf(&self, at: usize) -> usize {
        HEADER_BYTES + 64 * self.counts[0] + 16 * (at % self.counts[1].max(1))
    }

    pub(super) fn triangle(&self, at: usize) -> usize {
        HEADER_BYTES + 64 * self.counts[0] + 16 * self.counts[1] + 40 * (at % self.counts[2].max(1))
    }

    pub(super) fn record(&self, node: Node) -> usize {
        if node.is_leaf() { self.leaf(node.index()) } else { self.node(node.index()) }
    }

    pub(super) fn word(&self, at: usize) -> u32 {
        self.bytes[at..].first_chunk().map_or(0, |&word| u32::from_le_bytes(word))
    }

    pub(super) fn set(&mut self, at: usize, word: u32) {
        self.bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    }

    pub(super) fn add(&mut self, at: usize, by: i32) {
        self.set(at, self.word(at).wrapping_add_signed(by));
    }

    /// Exchanges a word and the next one.
    pub(super) fn swap(&mut self, at: usize) {
        let (word, next) = (self.word(at), self.word(at + 4));
        self.set(at, next);
        self.set(at + 4, word);
    }

    pub(super) fn cut(&mut self) {
        self.bytes.pop();
    }

    pub(super) fn copy(&mut self, other: &Self, at: usize, bytes: usize) {
        self.bytes[at..at + bytes].copy_from_slice(&other.bytes[at..at + bytes]);
    }

    pub(super) fn children(&self, node: usize) -> [Node; 2] {
        [0, 4].map(|at| Node::from_bits(self.word(self.node(node) + PLANES_BYTES + at)))
    }

    /// What is found along rays with these tests, with nothing checked but that indices are within.
    pub(super) fn cast<K, B>(&self, rays: &[Ray]) -> Hits
    where
        K: Kernel<Vector = Vec3, Shape = Triangle>,
        B: Slabs<Vector = Vec3>,
    {
        let (closest, any) = rays.iter().map(|ray| (self.closest::<K, B>(ray), self.any::<K, B>(ray))).unzip();
        Hits { closest, any }
    }

    fn closest<K, B>(&self, ray: &Ray) -> Option<Hit>
    where
        K: Kernel<Vector = Vec3, Shape = Triangle>,
        B: Slabs<Vector = Vec3>,
    {
        let mut best: Option<(Hit, Triangle)> = None;
        self.walk::<K, B>(ray, &mut |kernel, triangle, prim| {
            let limit = best.map_or(ray.tmax(), |(hit, _)| hit.t);
            let is_first = |t: f32| {
                best.is_none_or(|(hit, other)| {
                    t < hit.t || t == hit.t && kernel.order((&triangle, prim), (&other, hit.prim)).is_lt()
                })
            };
            if let Some(t) = kernel.distance(&triangle, limit).filter(|&t| is_first(t)) {
                let [u, v] = kernel.weights(&triangle);
                best = Some((Hit { prim, t, u, v }, triangle));
            }
            best.map_or(ray.tmax(), |(hit, _)| hit.t)
        });
        best.map(|(hit, _)| hit)
    }

    fn any<K, B>(&self, ray: &Ray) -> bool
    where
        K: Kernel<Vector = Vec3, Shape = Triangle>,
        B: Slabs<Vector = Vec3>,
    {
        let mut is_blocked = false;
        self.walk::<K, B>(ray, &mut |kernel, triangle, _| {
            is_blocked |= kernel.blocks(&triangle);
            ray.tmax()
        });
        is_blocked
    }

    /// Shows the triangles of all leaves whose boxes a ray touches before it ends, which is what is answered last.
    fn walk<K, B>(&self, ray: &Ray, look: &mut dyn FnMut(&K, Triangle, u32) -> f32)
    where
        K: Kernel<Vector = Vec3, Shape = Triangle>,
        B: Slabs<Vector = Vec3>,
    {
        let floats = |at: usize| -> Vec3 { [0, 4, 8].map(|i| f32::from_bits(self.word(at + i))).into() };
        let bounds = Aabb { lo: floats(BOUNDS), hi: floats(BOUNDS + 12) };
        let region = Region::of(&bounds);
        let (kernel, slabs) = (K::new(ray, &region), B::new(ray, &region));
        let (mut end, mut pending) = (ray.tmax(), Vec::new());
        if slabs.one(&bounds, end).is_some() {
            pending.push((ray.tmin(), Node::from_bits(self.word(ROOT))));
        }
        while let Some((near, node)) = pending.pop() {
            let record = self.record(node);
            if near > end {
                continue;
            }
            if node.is_leaf() {
                let (first, count) = (self.word(record) as usize, self.word(record + 4) as usize);
                for at in (first..first + count).filter(|&at| at < self.counts[2]) {
                    let triangle = self.triangle(at);
                    let corners = [0, 12, 24].map(|i| floats(triangle + i));
                    end = look(&kernel, Triangle(corners), self.word(triangle + 36));
                }
                continue;
            }
            let planes = [0, 1, 2].map(|axis| [0, 4, 8, 12].map(|i| f32::from_bits(self.word(record + 16 * axis + i))));
            let found = slabs.pair(&planes, end);
            let children = self.children(node.index());
            pending.extend((0..2).filter(|&i| found.hit[i]).map(|i| (found.near[i], children[i])));
        }
    }
}

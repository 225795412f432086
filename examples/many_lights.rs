//! Many lights, sampled by importance: one traversal carries all samples, each to one light.
//!
//! At each node the samples are divided between the children in proportion to the possible contribution of each. A
//! child without samples is not entered. (Binder & Keller 2016 name many-light hierarchies as another use of their
//! traversal.)
//!
//! `cargo run --release --example many_lights`

use stackless_bvh::glam::Vec3;
use stackless_bvh::order::{Descent, Flow, Side, Visitor};
use stackless_bvh::traverse::{Uncle, traverse};
use stackless_bvh::tree::{Linked, Node, Topology, Tree};

/// A light, or the combination of all lights below a node: mean position and total power.
#[derive(Clone, Copy)]
struct Light {
    place: Vec3,
    power: f32,
}

impl Light {
    /// Returns its contribution at a point. Adding one prevents a light at the point from dominating.
    fn at(self, point: Vec3) -> f32 {
        self.power / (1.0 + self.place.distance_squared(point))
    }

    fn with(self, other: Self) -> Self {
        let power = self.power + other.power;
        Self { place: (self.place * self.power + other.place * other.power) / power, power }
    }
}

/// All lights in a complete tree. The children of node i are 2i + 1 and 2i + 2.
struct Hierarchy {
    tree: Tree,
    lights: Vec<Light>,
    point: Vec3,
}

impl Hierarchy {
    /// Returns the child for a sample, and its probability.
    fn choose(&self, node: Node, sample: u32) -> (Side, f32) {
        let [left, right] = self.tree.children(node).map(|child| self.lights[child.index()].at(self.point));
        let share = left / (left + right);
        if random(sample, node.index() as u32) < share { (Side::Left, share) } else { (Side::Right, 1.0 - share) }
    }
}

/// The choice of every sample: its light, and the probability.
type Chosen = Vec<Option<(usize, f32)>>;

/// All active samples. Those of a node wait until it is visited.
struct Samples<'a> {
    hierarchy: &'a Hierarchy,
    waiting: Vec<Vec<(u32, f32)>>,
    chosen: Chosen,
}

impl Visitor for Samples<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let children = self.hierarchy.tree.children(node).map(Node::index);
        for (sample, probability) in std::mem::take(&mut self.waiting[node.index()]) {
            let (side, share) = self.hierarchy.choose(node, sample);
            self.waiting[children[side as usize]].push((sample, probability * share));
        }
        let [left, right] = children.map(|child| self.waiting[child].len());
        Descent::new(left > 0, right > 0, right > left)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        for &(sample, probability) in &self.waiting[node.index()] {
            self.chosen[sample as usize] = Some((node.index(), probability));
        }
        Flow::Continue
    }
}

/// Returns a number from 0 to 1 for each sample at each node.
fn random(sample: u32, slot: u32) -> f32 {
    let mut x = (u64::from(sample) << 32 | u64::from(slot)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((x ^ x >> 31) >> 40) as f32 / (1 << 24) as f32
}

/// Runs 4096 samples for one point, with 1024 lights along a spiral.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (count, samples) = (1024_u32, 4096_u32);
    let inner = count - 1;
    let children = |i: u32| (i < inner).then_some([2 * i + 1, 2 * i + 2]);
    let tree = Tree::new(&(0..inner + count).map(children).collect::<Vec<_>>())?;
    let spiral = |i: u32| Vec3::new((i as f32 * 0.01).cos(), i as f32 * 0.005, (i as f32 * 0.01).sin());
    let leaf = |i: u32| Light { place: spiral(i) * 4.0, power: 1.0 + (i % 7) as f32 };
    let mut lights = vec![leaf(0); inner as usize];
    lights.extend((0..count).map(leaf));
    for i in (0..inner as usize).rev() {
        lights[i] = lights[2 * i + 1].with(lights[2 * i + 2]);
    }
    let hierarchy = Hierarchy { tree, lights, point: Vec3::new(0.0, 6.0, 0.0) };

    let mut waiting = vec![Vec::new(); hierarchy.lights.len()];
    waiting[0] = (0..samples).map(|sample| (sample, 1.0)).collect();
    let mut all = Samples { hierarchy: &hierarchy, waiting, chosen: vec![None; samples as usize] };
    let uncles = Linked::uncles(&hierarchy.tree);
    traverse(Uncle::<u32, _>::new(&uncles)?, &mut all, &mut ());

    // The plain loop: each sample descends from the root separately.
    let walk = |sample| {
        let (mut node, mut probability) = (hierarchy.tree.root(), 1.0);
        while !node.is_leaf() {
            let (side, share) = hierarchy.choose(node, sample);
            (node, probability) = (hierarchy.tree.child(node, side), probability * share);
        }
        Some((node.index(), probability))
    };
    assert_eq!(all.chosen, (0..samples).map(walk).collect::<Chosen>());

    let sent = |light: usize| hierarchy.lights[light].at(hierarchy.point);
    let estimate = all.chosen.iter().flatten().map(|&(light, probability)| sent(light) / probability).sum::<f32>();
    let truth: f32 = (inner as usize..hierarchy.lights.len()).map(sent).sum();
    println!("{} by {samples} samples, {truth} by all {count} lights", estimate / samples as f32);
    Ok(())
}

//! Culling of hidden objects: nodes behind all drawn objects are skipped.
//!
//! The traversal is front to back, so occluders are drawn before hidden objects. (Binder & Keller 2016 name occlusion
//! culling as another use of their traversal.)
//!
//! `cargo run --release --example hidden_objects`

use stackless_bvh::generate::Rng;
use stackless_bvh::order::{Descent, Flow, Visitor};
use stackless_bvh::traverse::{Uncle, traverse};
use stackless_bvh::tree::{Linked, Node, Topology, Tree};

/// Pixels along each edge of the screen.
const SIZE: usize = 64;

/// A rectangle parallel to the screen, or the part of the screen that contains all objects of a node, with its depth.
#[derive(Clone, Copy)]
struct Pane {
    lo: [usize; 2],
    hi: [usize; 2],
    depth: u32,
}

impl Pane {
    fn with(self, other: Self) -> Self {
        let lo = [0, 1].map(|axis| self.lo[axis].min(other.lo[axis]));
        let hi = [0, 1].map(|axis| self.hi[axis].max(other.hi[axis]));
        Self { lo, hi, depth: self.depth.min(other.depth) }
    }

    fn pixels(self) -> impl Iterator<Item = usize> {
        (self.lo[1]..self.hi[1]).flat_map(move |y| (self.lo[0]..self.hi[0]).map(move |x| y * SIZE + x))
    }
}

/// The screen: for each pixel the depth and the index of the nearest object so far.
type Screen = Vec<(u32, usize)>;

fn draw(screen: &mut Screen, object: usize, pane: Pane) {
    for pixel in pane.pixels() {
        screen[pixel] = screen[pixel].min((pane.depth, object));
    }
}

struct Scene {
    tree: Tree,
    /// The panes of all nodes: inner ones first, then the objects.
    panes: Vec<Pane>,
}

impl Scene {
    fn pane(&self, node: Node) -> Pane {
        self.panes[node.index()]
    }
}

struct Culling<'a> {
    scene: &'a Scene,
    screen: Screen,
    drawn: usize,
}

impl Culling<'_> {
    /// Returns whether the pane is visible at any pixel. At equal depth, the object with the lower index is visible.
    fn is_visible(&self, pane: Pane) -> bool {
        pane.pixels().any(|pixel| pane.depth <= self.screen[pixel].0)
    }
}

impl Visitor for Culling<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        // A postponed node may have been hidden since.
        if !self.is_visible(self.scene.pane(node)) {
            return Descent::NEITHER;
        }
        let [left, right] = self.scene.tree.children(node).map(|child| self.scene.pane(child));
        Descent::new(self.is_visible(left), self.is_visible(right), right.depth < left.depth)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let pane = self.scene.pane(node);
        if self.is_visible(pane) {
            draw(&mut self.screen, node.index(), pane);
            self.drawn += 1;
        }
        Flow::Continue
    }
}

/// Draws 1024 panes in a row, the last in front. Eight neighbours have similar depths, so some are hidden by panes of
/// equal depth.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = 1024;
    let mut rng = Rng::new(1);
    let mut number = |end: usize| (rng.bits() % end as u64) as usize;
    let objects: Vec<_> = (0..count)
        .map(|i| {
            let lo = [number(SIZE - 24), number(SIZE - 24)];
            Pane { lo, hi: lo.map(|lo| lo + 1 + number(24)), depth: (count - i + number(50)) as u32 / 8 }
        })
        .collect();
    let inner_count = count - 1;
    let children = |i: usize| (i < inner_count).then_some([2 * i as u32 + 1, 2 * i as u32 + 2]);
    let tree = Tree::new(&(0..inner_count + count).map(children).collect::<Vec<_>>())?;
    let mut panes = vec![objects[0]; inner_count];
    panes.extend(&objects);
    for i in (0..inner_count).rev() {
        panes[i] = panes[2 * i + 1].with(panes[2 * i + 2]);
    }
    let scene = Scene { tree, panes };

    let mut culling = Culling { scene: &scene, screen: vec![(u32::MAX, usize::MAX); SIZE * SIZE], drawn: 0 };
    let uncles = Linked::uncles(&scene.tree);
    traverse(Uncle::<u32, _>::new(&uncles)?, &mut culling, &mut ());

    // The plain loop: all objects are drawn.
    let mut screen = vec![(u32::MAX, usize::MAX); SIZE * SIZE];
    scene.panes.iter().enumerate().skip(inner_count).for_each(|(object, &pane)| draw(&mut screen, object, pane));
    assert_eq!(culling.screen, screen);
    println!("{} of {count} objects are drawn, the others are hidden", culling.drawn);
    assert!(culling.drawn < count / 2, "most are hidden");
    Ok(())
}

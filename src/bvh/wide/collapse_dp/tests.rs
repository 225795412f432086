use super::*;
use crate::bvh::{BuildOptions, WideBvh};
use crate::generate::procedural;

/// The least costs, by definition.
struct Costs64<'a> {
    draft: &'a Draft,
    options: WideOptions,
    slots: usize,
}

impl Costs64<'_> {
    /// Returns the least cost of a forest of at most this number of roots.
    fn forest(&self, node: &Record, roots: usize) -> f64 {
        let (area, count) = (f64::from(node.half_area()), node.count());
        let fewer = if roots > 1 { self.forest(node, roots - 1) } else { f64::INFINITY };
        let here = if roots > 1 {
            self.divided(node, roots)
        } else {
            let as_leaf = area * f64::from(self.options.block_cost) * f64::from(count.div_ceil(4));
            let as_leaf = if count <= self.options.max_leaf { as_leaf } else { f64::INFINITY };
            as_leaf.min(area * f64::from(self.options.node_cost) + self.divided(node, self.slots))
        };
        fewer.min(here)
    }

    fn divided(&self, node: &Record, roots: usize) -> f64 {
        if node.is_leaf() {
            return f64::INFINITY;
        }
        let [left, right] = self.draft.children(node);
        (1..roots).map(|k| self.forest(left, k) + self.forest(right, roots - k)).fold(f64::INFINITY, f64::min)
    }
}

fn cost<const A: usize>(wide: &WideBvh<A>, options: &WideOptions) -> f64 {
    let mut sum = f64::from(wide.region().bounds().half_area() * options.node_cost);
    for node in wide.nodes() {
        for slot in (0..A as u32).filter(|&slot| node.has_child(slot)) {
            let child = node.child(slot);
            let each = if child.is_leaf() {
                options.block_cost * wide.leaf(child).1.div_ceil(4) as f32
            } else {
                options.node_cost
            };
            sum += f64::from(node.child_box(slot).half_area() * each);
        }
    }
    sum
}

fn check<const A: usize>(n: usize, options: &WideOptions) {
    let mesh = procedural::soup(n as u64, n);
    let (draft, _) = BuildOptions::fine().draft(&mesh, &|_| ()).expect("a tree");
    let bvh = BuildOptions::fine().build(&mesh).expect("a tree");
    let wide = WideBvh::<A>::with_options(&bvh, options).expect("small enough");
    let costs = Costs64 { draft: &draft, options: *options, slots: A };
    let root = draft.node(0);
    // The root always becomes a node.
    let as_node = f64::from(root.half_area() * options.node_cost);
    let whole = costs.forest(root, 1);
    let expected =
        if CollapseDp::<A>::of(&draft, options).expect("memory").is_leaf(0) { whole + as_node } else { whole };
    let found = cost(&wide, options);
    assert!((found - expected).abs() < 1e-5 * expected, "{n} {A} {options:?}: {found} {expected}");
}

/// [BUILD-6]
#[test]
fn no_choice_of_roots_costs_less() {
    for n in 1..14 {
        for max_leaf in [1, 2, 8] {
            for (node_cost, block_cost) in [(1.0, 0.5), (1.0, 2.0), (0.1, 1.0)] {
                let options = WideOptions { node_cost, block_cost, max_leaf };
                check::<4>(n, &options);
                check::<8>(n, &options);
            }
        }
    }
}

//! The oracle omits no node that begins where the search ends.

use stackless_bvh::event::Trace;
use stackless_bvh::oracle;
use stackless_bvh::order::{Descent, Flow, Pruned, Pruning, Side, Visitor};
use stackless_bvh::traverse::{PruningStack, traverse_pruned};
use stackless_bvh::tree::{Node, Topology, Tree};

/// Its postponed child begins at one distance, and the search ends at another.
struct Ends {
    begins: u32,
    end: u32,
}

impl Visitor for Ends {
    fn inner(&mut self, _: Node) -> Descent {
        Descent::both(Side::Left)
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

impl Pruned for Ends {
    fn allows(&self, _: Pruning) -> bool {
        true
    }

    fn postponed(&self, _: Node, _: Descent) -> u32 {
        self.begins
    }

    fn end(&self) -> u32 {
        self.end
    }
}

/// [ORACLE-3]
#[test]
fn a_node_that_begins_at_the_end_is_visited() {
    let tree = Tree::new(&[Some([1, 2]), None, None]).unwrap();
    for (begins, end, visits) in [(4, 5, 3), (5, 5, 3), (6, 5, 2)] {
        let mut trace = Trace::default();
        let visitor = &mut Ends { begins, end };
        oracle::traverse_pruned(&tree, tree.root(), Pruning::Distance, visitor, &mut trace);
        assert_eq!(trace.nodes().len(), visits, "{begins} {end}");
        let mut by_stack = Trace::default();
        traverse_pruned(PruningStack::<_, true>::new(&tree, &mut Vec::new()), visitor, &mut by_stack);
        assert_eq!(by_stack, trace);
    }
}

use alloc::vec;

use super::*;
use crate::generate::Family;
use crate::order::{Descent, Flow, Side, Visitor};
use crate::tree::Tree;

/// Visits all leaves from right to left.
struct Leaves;

impl Visitor for Leaves {
    fn inner(&mut self, _: Node) -> Descent {
        Descent::both(Side::Right)
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

impl Pruned for Leaves {}

impl NodeTest for Leaves {
    fn accept(&mut self, _: Node) -> bool {
        true
    }
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

#[test]
fn lookups_in_the_table_of_another_tree_are_misses() {
    let (tree, other) = (Family::comb(9, |_| true), Family::comb(9, |_| false));
    let (axes, keys) = (vec![0; 19], Arc::new(Keys::of(&tree)));
    let run = |tables: &VerifiedTables<'_, Tree>| {
        tables.run::<u64, _>(Method::HashOnly, 0, &mut Vec::new(), &mut Leaves, &mut ()).map(|()| tables.misses())
    };
    let beside = |tree: &Tree| AuxTables::new(tree, &axes, &[Method::HashOnly], 0);
    let tables = Tables::verified(&tree, &axes, beside(&tree), Arc::clone(&keys));
    assert_eq!((run(&tables), run(&tables)), (Ok(0), Ok(0)));
    let tables = Tables::verified(&tree, &axes, beside(&other), keys);
    let Ok(misses) = run(&tables) else { panic!("it runs") };
    assert!(misses > 1, "{misses}");
    assert_eq!(run(&tables), Ok(2 * misses));
}

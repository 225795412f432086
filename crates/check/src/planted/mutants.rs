//! The traversals of the library, wrapped, one by one.

use stackless_bvh::order::{FixedOrder, Pruned};
use stackless_bvh::traverse::{Context, Cursor, Method, Supply, Tables, Unfit};
use stackless_bvh::tree::Tree;

use super::wrapped::{Mutation, Wrapped};
use super::{Planted, Watcher, drive};

/// Traversals that test children at their parent, with a mutation.
pub(super) fn mutants(mutation: Mutation) -> Vec<Planted> {
    use Method as M;
    let of = |method: Method| {
        let mutant =
            Planted::any(format!("{mutation:?} in {method}"), "ORDER-1", move |tree, tape, search, watcher| {
                let (tables, mut memory) = (Tables::new(tree, tape.axes(), &[method], 0), Vec::new());
                let linked = tables.tree();
                let from = tables.over(&linked, 0, &mut memory);
                // What is refused makes no visit.
                let _ = method.dispatch::<u64, _>(Mutated { mutation, tree, from, search, watcher });
            });
        if method.restarts() { mutant.restarting() } else { mutant }
    };
    let stackless = [M::Sparse, M::Afra, M::Uncle, M::Hashed];
    let implicit = [M::ImplicitA, M::ImplicitA1, M::ImplicitB, M::ImplicitB1];
    let others = [M::Glassner, M::Laine0, M::Laine2];
    [M::Stack].into_iter().chain(stackless).chain(implicit).chain(others).map(of).collect()
}

/// Runs a traversal with a mutation.
struct Mutated<'a, 'w, F> {
    mutation: Mutation,
    tree: &'a Tree,
    from: F,
    search: &'a mut dyn Pruned,
    watcher: &'a mut Watcher<'w>,
}

impl<'s, F: Supply<'s, u64>> Context<'s, u64> for Mutated<'_, '_, F> {
    type From = F;
    type Output = ();

    fn by_parent<C: Cursor>(self, start: impl Fn(F) -> Result<C, Unfit>) -> Result<(), Unfit> {
        drive(Wrapped::new(self.tree, start(self.from)?, self.mutation), self.search, self.watcher);
        Ok(())
    }

    /// None of those.
    fn by_node<C: Cursor, O: FixedOrder>(self, _: impl Fn(F) -> Result<(C, O), Unfit>) -> Result<(), Unfit> {
        Err(Unfit::NoTable)
    }
}

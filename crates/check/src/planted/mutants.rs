//! The traversals of this crate, told something else than what the visitor has said.

use stackless_bvh::event::State;
use stackless_bvh::hash::KeyMap;
use stackless_bvh::key::TooDeep;
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::{
    Afra, ByKey, Cursor, Glassner, Hashed, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine, Sparse, Stack, Uncle,
};
use stackless_bvh::tree::{Linked, Node};

use super::{Planted, drive};

/// One of this crate's traversals, told something else than what the visitor has said.
struct Mutant<C> {
    cursor: C,
    mutation: Mutation,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Mutation {
    None,
    FarFirst,
    FarLost,
    MissedWanted,
}

impl<C: Cursor> Cursor for Mutant<C> {
    type Word = C::Word;
    const RESTARTS: bool = C::RESTARTS;

    fn node(&self) -> Node {
        self.cursor.node()
    }

    fn state(&self) -> State<C::Word> {
        self.cursor.state()
    }

    fn descend(&mut self, descent: Descent) -> bool {
        let first = descent.first();
        self.cursor.descend(match self.mutation {
            Mutation::FarFirst if descent.postpones() => Descent::both(first.other()),
            Mutation::FarLost => Descent::only(first),
            Mutation::MissedWanted => Descent::both(first),
            _ => descent,
        })
    }

    fn backtrack(&mut self) -> bool {
        self.cursor.backtrack()
    }
}

/// Every traversal that tests children at their parent, with a mutation.
pub(super) fn mutants(mutation: Mutation) -> Vec<Planted> {
    macro_rules! mutants {
        ($($name:literal, |$tree:ident| $cursor:expr;)*) => {
            vec![$(Planted::any(format!("{mutation:?} in {}", $name), "ORDER-1", move |tree, _, visitor, watcher| {
                let $tree = tree;
                if let Ok(cursor) = $cursor {
                    drive(Mutant { cursor, mutation }, visitor, watcher);
                }
            })),*]
        };
    }
    let mut all = mutants![
        "stack", |tree| Ok::<_, TooDeep>(Stack::new(tree, &mut Vec::new()));
        "sparse", |tree| Sparse::<u64, _>::new(&Linked::parents(tree));
        "afra", |tree| Afra::<u64, _>::new(&Linked::parents(tree));
        "uncle", |tree| Uncle::<u64, _>::new(&Linked::uncles(tree));
        "hashed", |tree| Hashed::<u64, _, _>::new(&Linked::uncles(tree), KeyMap::of(tree));
        "implicit-a", |tree| ImplicitA::<u64, _>::new(tree, KeyMap::of(tree));
        "implicit-a1", |tree| ImplicitA1::<u64, _>::new(tree, KeyMap::of(tree));
        "implicit-b", |tree| ImplicitB::<u64, _>::new(tree, KeyMap::of(tree));
        "implicit-b1", |tree| ImplicitB1::<u64, _>::new(tree, KeyMap::of(tree));
        "glassner", |tree| ByKey::<u64, _>::new(tree, &Glassner::of(tree));
    ];
    let restarting = mutants![
        "laine-0", |tree| Laine::<0, u64, _>::new(tree);
        "laine-2", |tree| Laine::<2, u64, _>::new(tree);
    ];
    all.extend(restarting.into_iter().map(Planted::restarting));
    all
}

//! The traversals of this crate, told something else than what the visitor has said.

use stackless_bvh::event::State;
use stackless_bvh::hash::KeyMap;
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::{
    Afra, ByKey, Cursor, Glassner, Hashed, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine, Sparse, Stack, Uncle,
    traverse,
};
use stackless_bvh::tree::{Node, Parents, Uncles};

use super::Suspect;

/// One of this crate's traversals, told something else than what the visitor has said.
struct Mutant<C> {
    cursor: C,
    mutation: Mutation,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Mutation {
    None,
    FarFirst,
    FarLost,
    MissedWanted,
}

impl<C: State> State for Mutant<C> {
    type Word = C::Word;

    fn node(&self) -> Node {
        self.cursor.node()
    }
    fn key(&self) -> Option<C::Word> {
        self.cursor.key()
    }
    fn trail(&self) -> Option<C::Word> {
        self.cursor.trail()
    }
    fn counter(&self) -> Option<C::Word> {
        self.cursor.counter()
    }
    fn register(&self) -> Option<Node> {
        self.cursor.register()
    }
    fn is_restarting(&self) -> bool {
        self.cursor.is_restarting()
    }
}

impl<C: Cursor> Cursor for Mutant<C> {
    const RESTARTS: bool = C::RESTARTS;

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
pub(crate) fn mutants(mutation: Mutation, fault: &'static str) -> Vec<Suspect> {
    macro_rules! mutants {
        ($($name:literal, |$tree:ident| $cursor:expr;)*) => {
            vec![$(Suspect::new(format!("{mutation:?} in {}", $name), fault, move |case, search, watch| {
                let $tree = &case.tree;
                traverse(Mutant { cursor: $cursor, mutation }, search, watch);
            })),*]
        };
    }
    let mut suspects = mutants![
        "stack", |tree| Stack::new(tree, &mut Vec::new());
        "sparse", |tree| Sparse::<u64, _, _>::new(tree, &Parents::of(tree)).unwrap();
        "afra", |tree| Afra::<u64, _, _>::new(tree, &Parents::of(tree)).unwrap();
        "uncle", |tree| Uncle::<u64, _, _>::new(tree, &<Uncles>::of(tree)).unwrap();
        "hashed", |tree| Hashed::<u64, _, _, _>::new(tree, &<Uncles>::of(tree), KeyMap::of(tree)).unwrap();
        "implicit-a", |tree| ImplicitA::<u64, _>::new(tree, KeyMap::of(tree)).unwrap();
        "implicit-a1", |tree| ImplicitA1::<u64, _>::new(tree, KeyMap::of(tree)).unwrap();
        "implicit-b", |tree| ImplicitB::<u64, _>::new(tree, KeyMap::of(tree)).unwrap();
        "implicit-b1", |tree| ImplicitB1::<u64, _>::new(tree, KeyMap::of(tree)).unwrap();
        "glassner", |tree| ByKey::<u64, _>::new(tree, &Glassner::of(tree)).unwrap();
    ];
    let restarting = mutants![
        "laine-0", |tree| Laine::<0, u64, _>::new(tree).unwrap();
        "laine-2", |tree| Laine::<2, u64, _>::new(tree).unwrap();
    ];
    suspects.extend(restarting.into_iter().map(|suspect| Suspect { restarts: true, ..suspect }));
    suspects
}

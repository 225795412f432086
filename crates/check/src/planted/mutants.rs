//! The traversals of the library, wrapped, one by one.

use stackless_bvh::hash::KeyMap;
use stackless_bvh::key::TooDeep;
use stackless_bvh::traverse::{
    Afra, ByKey, Glassner, Hashed, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine, Sparse, Stack, Uncle,
};
use stackless_bvh::tree::Linked;

use super::wrapped::{Mutation, Wrapped};
use super::{Planted, drive};

/// Every traversal that tests children at their parent, with a mutation.
pub(super) fn mutants(mutation: Mutation) -> Vec<Planted> {
    macro_rules! mutants {
        ($($name:literal, |$tree:ident| $cursor:expr;)*) => {
            vec![$(Planted::any(format!("{mutation:?} in {}", $name), "ORDER-1", move |tree, _, visitor, watcher| {
                let $tree = tree;
                if let Ok(cursor) = $cursor {
                    drive(Wrapped::new(tree, cursor, mutation), visitor, watcher);
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

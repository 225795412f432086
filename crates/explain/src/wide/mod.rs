//! Step-by-step pages of wide-tree traversals. A set of slots takes the place of each bit of a binary trail.

mod judge;
mod observe;
mod places;
mod ray;
mod text;

pub use ray::of_ray;

use super::{ExplainError, Page, Recording, Table, clauses, recordings, refuse_large};
use judge::Judge;
use observe::Log;
use places::{Places, children};
use stackless_bvh::generate::{Rng, WideAnswer, WideTape, wide_tree};
use stackless_bvh::wide::{Method, Search, Tables, Tree};
use stackless_check::WideCase;

/// The default traversals of a page, in their order.
pub const USUAL: [Method; 6] =
    [Method::Recorded, Method::Hashed, Method::Trail, Method::Restart0, Method::Restart2, Method::Stack];

/// Records traversals of a search through a wide tree, like [`explain::page`](super::page).
///
/// ```
/// use stackless_explain::wide::{self, USUAL};
///
/// let example = wide::example();
/// let page = wide::page("an example", &example.tree, &example.search::<true>(), &USUAL)?;
/// assert!(page.to_html()?.contains("wide-record"));
/// # Ok::<(), stackless_explain::ExplainError>(())
/// ```
///
/// # Errors
/// [`ExplainError`], if the tree is too large, a traversal differs from its oracle, or none runs.
pub fn page<const A: usize, S: Search<A> + Clone>(
    title: &str,
    tree: &Tree<A>,
    search: &S,
    methods: &[Method],
) -> Result<Page, ExplainError> {
    let (methods, left_out) = recordings(methods, |method| record(tree, search, method))?;
    let places = Places::of(tree);
    let numbers = |node| children(tree, node).map(|(_, child)| judge::number(child)).collect();
    Ok(Page {
        title: title.to_owned(),
        children: tree.nodes().map(|node| (!node.is_leaf()).then(|| numbers(node))).collect(),
        keys: places.keys().map(|key| format!("{key:b}")).collect(),
        names: places.keys().map(places::name::<A>).collect(),
        key_bits: A.trailing_zeros(),
        trail_bits: A as u32,
        base: places::base::<A>(),
        clauses: clauses::named(&methods),
        methods,
        left_out,
    })
}

/// Runs a traversal over a wide tree. Compares each visit and the stored state with the oracle's. `[WIDE-7]`
/// `[WIDE-11]` `[WIDE-19]`
///
/// # Errors
/// [`ExplainError`].
pub fn record<const A: usize, S: Search<A> + Clone>(
    tree: &Tree<A>,
    search: &S,
    method: Method,
) -> Result<Recording, ExplainError> {
    let levels = stackless_bvh::wide::Topology::levels(tree);
    // A leaf may be a level below the last inner node, and its key needs a bit before the first level.
    refuse_large(tree.node_count(), levels + 1, 127 / A.trailing_zeros())?;
    let (places, tables) = (Places::of(tree), Tables::new(tree));
    let judge = Judge::new(tree, search.clone(), method, &places, &tables);
    if method.restarts() && judge.is_falling() {
        return Err(ExplainError::Falling { method });
    }
    let log = Log::new(&places);
    observe::run(tree, &tables, method, search.clone(), &log)?;
    let (steps, _) = log.into_steps();
    let postponed = judge.compare(&steps)?;
    let hash = tables.hash().ok().filter(|_| method.needs_hash());
    let link = |up: u32| -> &'static str { LINKS.get(up as usize).copied().unwrap_or_default() };
    Ok(Recording {
        method: method.name(),
        about: method.help(),
        clause: method.clause(),
        state_bytes: method.state_bytes::<A>(levels as usize),
        links: (0..judge.links()).map(link).collect(),
        table: hash.map(|hash| Table::of(hash, judge::number)),
        steps: (0..steps.len()).map(|at| judge.step(&steps, at, &postponed[at])).collect(),
    })
}

/// Names of linked ancestors.
const LINKS: [&str; 8] = ["parent", "2 up", "3 up", "4 up", "5 up", "6 up", "7 up", "8 up"];

/// Draws a wide tree with a search.
pub fn random<const A: usize>(seed: u64) -> WideCase<A> {
    WideCase::draw(&mut Rng::new(seed), 24, 4, 12)
}

/// Returns an example of a backtrack from the leaf with key 1252 to key 10, two levels up. The pending children of node
/// 12 are then beyond the hit in 1250. `[WIDE-17]`
pub fn example() -> WideCase<8> {
    let lists: [&[u32]; 4] = [&[1, 2, 3, 4, 5], &[6, 7, 8, 9, 10, 11], &[12, 13, 14], &[15, 16, 17]];
    let inner = [(0, lists[0]), (3, lists[1]), (11, lists[2]), (2, lists[3])];
    let mut shape = vec![None; 18];
    for (node, list) in inner {
        shape[node] = Some(list.to_vec());
    }
    let begins = [0, 2, 4, 1, 9, 3, 2, 0, 3, 4, 12, 5, 5, 0, 6, 6, 5, 7];
    let unwanted = [7, 13];
    let hits = [(12, 8), (16, 5)];
    let answer = |node: usize| WideAnswer {
        is_wanted: !unwanted.contains(&node),
        begin: begins[node] * 8,
        end: hits.iter().find(|&&(leaf, _)| leaf == node).map(|&(_, end)| end * 8),
    };
    let tree = wide_tree(&shape);
    let answers: Vec<_> = (0..shape.len()).map(answer).collect();
    WideCase { tape: WideTape::of(&tree, &answers), tree, is_sorted: true }
}

#[cfg(test)]
mod tests;

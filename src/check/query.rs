//! Queries whose traversal, word and tests are known only when the program runs.

use crate::bvh::Bvh;
use crate::geom::Ray;
use crate::key::KeyWord;
use crate::trace::Query;
use crate::traverse::{Method, Tables, Unfit, WithWord, WordName, with_word};
use crate::tree::Node;

/// Runs a query by a traversal in a word. `memory` is the stack's, kept between queries.
///
/// All kinds of queries share one body, so that not all traversals are compiled for each of them anew.
///
/// # Errors
/// [`Unfit`], before the first step.
pub fn run_query<S>(
    word: WordName,
    tables: &Tables<'_, Bvh<S>>,
    method: Method,
    ray: &Ray,
    memory: &mut Vec<Node>,
    query: &mut dyn Query,
) -> Result<(), Unfit> {
    with_word(word, Run { tables, method, ray, memory, query })
}

struct Run<'a, 't, S> {
    tables: &'a Tables<'t, Bvh<S>>,
    method: Method,
    ray: &'a Ray,
    memory: &'a mut Vec<Node>,
    query: &'a mut dyn Query,
}

impl<S> WithWord for Run<'_, '_, S> {
    type Output = Result<(), Unfit>;

    fn call<W: KeyWord>(mut self) -> Self::Output {
        self.tables.run::<W, _>(self.method, self.ray.octant(), self.memory, &mut self.query, &mut ())
    }
}

//! Wide walks as searches of the library.

use super::{Best, WideWalk};
use crate::own::text::hex;
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::key::{Grow, KeyWord, Word};
use stackless_bvh::order::Flow;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{self, Topology as _, Tree, TreeError, Wanted, child_key, is_beyond};

impl WideWalk {
    /// Returns the tree.
    ///
    /// # Errors
    /// [`TreeError`].
    pub fn tree<const A: usize>(&self) -> Result<Tree<A>, TreeError> {
        Tree::new(&self.children.iter().map(Option::as_deref).collect::<Vec<_>>())
    }

    /// Returns the search, before its first step; `None` if ranks or hits do not fit the tree.
    pub fn search<const A: usize, const SORTED: bool>(&self) -> Option<ScriptedSearch<'_, A, SORTED>> {
        let is_slot = |(slot, rank): (usize, &Option<u32>)| rank.is_none_or(|rank| rank as usize % A == slot);
        let fits = self.children.len() == self.ranks.len()
            && self.hits.as_ref().is_none_or(|hits| hits.len() == self.children.len())
            && self.children.iter().zip(&self.ranks).all(|(children, ranks)| match (children, ranks) {
                (None, None) => true,
                (Some(children), Some(ranks)) => children.len() == ranks.len() && ranks.iter().enumerate().all(is_slot),
                _ => false,
            });
        let fits = fits && self.is_sorted() == SORTED;
        fits.then(|| ScriptedSearch { walk: self, end: self.end.unwrap_or(u32::MAX), best: self.hit })
    }

    /// Returns whether children are ordered by rank. `[WIDE-5]` `[WIDE-6]`
    pub fn is_sorted(&self) -> bool {
        self.sorted.unwrap_or(true)
    }
}

/// A search with the decisions of a case.
#[derive(Clone, Debug)]
pub struct ScriptedSearch<'w, const A: usize, const SORTED: bool> {
    walk: &'w WideWalk,
    end: u32,
    best: Option<Best>,
}

impl<const A: usize, const SORTED: bool> ScriptedSearch<'_, A, SORTED> {
    /// Returns the best hit so far.
    pub const fn best(&self) -> Option<Best> {
        self.best
    }

    /// Returns the wanted children in these slots, with their ranks.
    pub fn of(&self, node: Node, slots: u32) -> Wanted<[u32; A]> {
        let told = self.walk.ranks.get(node.index()).and_then(Option::as_ref);
        let mut wanted = Wanted { set: 0, ranks: [0; A] };
        for (slot, rank) in told.into_iter().flatten().enumerate() {
            let Some(rank) = rank.filter(|_| slots >> slot & 1 == 1) else { continue };
            wanted.ranks[slot] = rank;
            wanted.set |= u32::from(!SORTED || !is_beyond::<A>(rank, self.end)) << slot;
        }
        wanted
    }
}

impl<const A: usize, const SORTED: bool> wide::Search<A> for ScriptedSearch<'_, A, SORTED> {
    const SORTED: bool = SORTED;
    type Ranks = [u32; A];

    fn ask(&mut self, node: Node) -> Wanted<[u32; A]> {
        self.of(node, u32::MAX)
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        let told = self.walk.hits.as_ref().and_then(|hits| hits.get(leaf.index()).copied().flatten());
        let hit = told.filter(|&t| t <= self.end).map(|t| Best { t, node: leaf.index() as u32 });
        let Some(hit) = hit else { return Flow::Continue };
        self.end = hit.t;
        self.best = Some(self.best.map_or(hit, |best| best.min(hit)));
        if self.walk.any == Some(true) { Flow::Stop } else { Flow::Continue }
    }

    fn end(&self) -> u32 {
        self.end
    }
}

/// Formats the trace of visits, which follow the last one of `before` or begin at the root. `[TRACE-1]` `[WIDE-7]`
pub fn wide_events<const A: usize>(tree: &Tree<A>, before: Option<Node>, visits: &[Node]) -> Vec<String> {
    let mut places = vec![Place { key: Grow::one(), level: 0, parent: None }; tree.node_count()];
    let mut open = vec![tree.root()];
    while let Some(node) = open.pop() {
        for slot in (0..A as u32).filter(|slot| tree.children(node) >> slot & 1 == 1) {
            let (child, above) = (tree.child(node, slot), &places[node.index()]);
            let bits = (0..u32::BITS).rev().map(|bit| slot >> bit & 1 == 1);
            let slot = bits.fold(Grow::zero(), |word, bit| word.shl1().or(&Grow::from_bit(bit)));
            let key = child_key::<A, Grow>(above.key.clone(), slot);
            places[child.index()] = Place { key, level: above.level + 1, parent: Some(node) };
            open.extend((!child.is_leaf()).then_some(child));
        }
    }
    let (mut events, mut before) = (Vec::new(), before);
    for &node in visits {
        let Place { key, level, parent } = &places[node.index()];
        let key = hex(key);
        if let Some(before) = before.filter(|&before| *parent != Some(before)) {
            events.push(format!("backtrack {key} {}", places[before.index()].level - level));
        }
        events.push(format!("{} {key}", if node.is_leaf() { "leaf" } else { "enter" }));
        before = Some(node);
    }
    events.push("end".to_owned());
    events
}

#[derive(Clone)]
struct Place {
    key: Grow,
    level: i64,
    parent: Option<Node>,
}

/// Records visits.
#[derive(Debug, Default)]
pub(crate) struct Noted(pub(crate) Vec<Node>);

impl Recorder for Noted {
    fn visit<W: KeyWord>(&mut self, node: Node, _: impl FnOnce() -> State<W>) -> Flow {
        self.0.push(node);
        Flow::Continue
    }
}

//! A traversal's state at a visit, kept.

use stackless_bvh::event::State;
use stackless_bvh::key::KeyWord;
use stackless_bvh::tree::Node;

/// What a traversal shows at a visit, in words of one width whatever its own are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snapshot<W = u64> {
    /// The node.
    pub node: Node,
    /// Its key.
    pub key: Option<W>,
    /// The trail.
    pub trail: Option<W>,
    /// The counter.
    pub counter: Option<W>,
    /// The second trail.
    pub disjoint: Option<W>,
    /// The register.
    pub register: Option<Node>,
    /// Whether the node is only passed again.
    pub is_restarting: bool,
}

impl<W> Snapshot<W> {
    /// Copies a state, with words as `word` has them.
    pub fn of<S: State>(state: &S, word: impl Fn(&S::Word) -> Option<W>) -> Self {
        let word = |own: Option<S::Word>| own.as_ref().and_then(&word);
        Self {
            node: state.node(),
            key: word(state.key()),
            trail: word(state.trail()),
            counter: word(state.counter()),
            disjoint: word(state.disjoint()),
            register: state.register(),
            is_restarting: state.is_restarting(),
        }
    }
}

impl<W: KeyWord> State for Snapshot<W> {
    type Word = W;

    fn node(&self) -> Node {
        self.node
    }

    fn key(&self) -> Option<W> {
        self.key.clone()
    }

    fn trail(&self) -> Option<W> {
        self.trail.clone()
    }

    fn counter(&self) -> Option<W> {
        self.counter.clone()
    }

    fn disjoint(&self) -> Option<W> {
        self.disjoint.clone()
    }

    fn register(&self) -> Option<Node> {
        self.register
    }

    fn is_restarting(&self) -> bool {
        self.is_restarting
    }
}

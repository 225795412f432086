//! The property body of states from elsewhere: what is accepted can be followed.

use super::pauses::{GoOn, PauseFault, Pauses, Start, Way, methods};
use stackless_bvh::event::Trace;
use stackless_bvh::key::KeyWord;
use stackless_bvh::traverse::{Method, Paused, Test};
use stackless_bvh::tree::Topology;

impl Pauses<'_> {
    /// Reads bytes as a state of the case's tree. Whatever they are, a state that is accepted is these bytes, and every
    /// traversal that takes it up visits what the oracle visits below the node and below all nodes that are postponed.
    /// Those with a second trail, which may be made up, visit no node twice. `[PAUSE-6]`
    ///
    /// Returns how many traversals have taken it up; `None` if it was refused.
    ///
    /// # Errors
    /// The first fault.
    pub fn follow<W: KeyWord>(&self, bytes: &[u8]) -> Result<Option<usize>, Box<PauseFault>> {
        let Ok(paused) = self.states.from_bytes::<W>(bytes) else { return Ok(None) };
        let fault = |method, what| PauseFault { method, way: Way::Bytes, visits: 0, next: paused.next, what };
        if self.states.to_bytes(&paused) != bytes {
            return Err(Box::new(fault(Method::Stack, format!("{paused:?} has other bytes"))));
        }
        let mut followed = 0;
        for method in methods() {
            followed += usize::from(self.follow_by(method, &paused).map_err(|what| Box::new(fault(method, what)))?);
        }
        Ok(Some(followed))
    }

    /// Whether a traversal takes a state up.
    fn follow_by<W: KeyWord>(&self, method: Method, paused: &Paused<W>) -> Result<bool, String> {
        let tree = &self.case.tree;
        let (mut trace, mut search) = (Trace::default(), self.search());
        let go_on = GoOn { from: Start::State(paused.clone()), search: &mut search, trace: &mut trace };
        // One that is too deep for the word, or that needs what the state does not have.
        if !matches!(self.tables.with_cursor::<W, _>(method, go_on), Ok(Ok(()))) {
            return Ok(false);
        }
        if trace.nodes().len() > tree.node_count() {
            return Err(format!("{} visits of {} nodes", trace.nodes().len(), tree.node_count()));
        }
        let slot = tree.slot(paused.node);
        if method.test() == Test::Children && W::carries(self.keys.depth(slot), 1).is_ok() {
            let mut search = self.search();
            let key = self.keys.key(slot);
            let expected = self.expected::<W>(&key, &paused.trail, paused.next, method, &mut search)?;
            if trace != expected {
                return Err(format!("visits {:?}, expected {:?}", trace.nodes(), expected.nodes()));
            }
        }
        Ok(true)
    }
}

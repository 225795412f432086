//! The property body of untrusted states: every accepted state can be resumed.

use super::pauses::{GoOn, PauseFault, Pauses, Start, Way, methods};
use stackless_bvh::event::Trace;
use stackless_bvh::key::KeyWord;
use stackless_bvh::traverse::{Method, Paused, Test};
use stackless_bvh::tree::Topology;

impl Pauses<'_> {
    /// Reads bytes as a state of the case's tree, and resumes it with every traversal. An accepted state encodes to
    /// these bytes again. Every traversal that resumes it visits the oracle's visits below the node and below all
    /// postponed nodes. Traversals with a second trail, which may be forged, visit no node twice. `[PAUSE-6]`
    ///
    /// Returns the number of traversals that resumed the state, or `None` if it was rejected.
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

    /// Returns whether a traversal resumes a state.
    fn follow_by<W: KeyWord>(&self, method: Method, paused: &Paused<W>) -> Result<bool, String> {
        let tree = &self.case.tree;
        let (mut trace, mut search) = (Trace::default(), self.search());
        let go_on = GoOn { from: Start::State(paused.clone()), search: &mut search, trace: &mut trace };
        // The state is too deep for the word, or incomplete for the traversal.
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

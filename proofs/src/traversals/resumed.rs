//! A cursor that is paused and resumed before every step.

use stackless_bvh::event::State;
use stackless_bvh::internals::traverse::ByTable;
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::{Cursor, Next, Pause, Paused, Unsupported};
use stackless_bvh::tree::Node;

use crate::shape::{Computed, Shape};

/// Resumes the last state in a new cursor at each step.
#[derive(Debug)]
pub(super) struct Resumed<C, F, P> {
    cursor: C,
    /// Builds a cursor at the root.
    start: F,
    /// Converts the state between the pause and resuming.
    keep: P,
}

impl<C: Pause, F: Fn() -> Result<C, Unsupported>, P: Fn(Paused<C::Word>) -> Option<Paused<C::Word>>> Resumed<C, F, P> {
    /// Starts at the root.
    ///
    /// # Errors
    /// The errors of `start`.
    pub(super) fn new(start: F, keep: P) -> Result<Self, Unsupported> {
        Ok(Self { cursor: start()?, start, keep })
    }

    fn resume(&mut self, next: Next) {
        let paused = (self.keep)(self.cursor.put_aside(next));
        let (Ok(mut cursor), Some(paused)) = ((self.start)(), paused) else { panic!("the state is lost") };
        assert!(paused.next == next && cursor.take_up(paused).is_ok());
        self.cursor = cursor;
    }
}

/// Keeps only key and trail, and finds the nodes again by their keys.
pub(super) fn by_key_and_trail(shape: Shape) -> impl Fn(Paused<u32>) -> Option<Paused<u32>> {
    move |paused| paused.key_trail()?.locate(&ByTable(Computed(shape))).ok()
}

impl<C: Pause, F: Fn() -> Result<C, Unsupported>, P: Fn(Paused<C::Word>) -> Option<Paused<C::Word>>> Cursor
    for Resumed<C, F, P>
{
    type Word = C::Word;
    const PRUNES: bool = C::PRUNES;

    fn node(&self) -> Node {
        self.cursor.node()
    }

    fn state(&self) -> State<C::Word> {
        self.cursor.state()
    }

    fn descend(&mut self, descent: Descent) -> bool {
        self.resume(Next::Visit);
        self.cursor.descend(descent)
    }

    fn backtrack(&mut self) -> bool {
        self.resume(Next::Backtrack);
        self.cursor.backtrack()
    }

    fn prune(&mut self) {
        self.cursor.prune();
    }
}

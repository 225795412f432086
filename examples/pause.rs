//! Rays in slices: a ray visits a few nodes, its state becomes bytes, and another traversal resumes it.
//!
//! Programs with a time limit, or with several machines, can thus interrupt a ray anywhere. The state has the same size
//! for any depth of the search.
//!
//! `cargo run --release --example pause`

use glam::Vec3;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::Ray;
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Flow, Unpruned};
use stackless_bvh::trace::{AllHits, BinaryTracer, RayQueries};
use stackless_bvh::traverse::{Afra, Next, Pause, Sparse, States, resume};
use stackless_bvh::tree::Node;

/// The number of visits that are left in a slice.
struct Budget(usize);

impl Recorder for Budget {
    fn visit<W: KeyWord>(&mut self, _: Node, _: impl FnOnce() -> State<W>) -> Flow {
        match self.0.checked_sub(1) {
            Some(left) => self.0 = left,
            None => return Flow::Stop,
        }
        Flow::Continue
    }
}

/// Collects all hits of a ray, twenty visits at a time, by two traversals in turn.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bvh = Bvh::build(&procedural::soup(1, 2000))?;
    let ray = Ray::new(Vec3::new(0.5, 0.5, -1.0), Vec3::Z)?;
    let states = States::of(&bvh);

    let mut hits = AllHits::new(&bvh, &ray);
    let mut bytes = states.to_bytes(&Afra::<u64, _>::new(&bvh)?.put_aside(Next::Visit));
    let (mut slices, size) = (0, bytes.len());
    loop {
        let (paused, budget) = (states.from_bytes(&bytes)?, &mut Budget(20));
        let state = if slices % 2 == 0 {
            let mut cursor = Afra::<u64, _>::new(&bvh)?;
            resume(&mut cursor, paused, &mut Unpruned(&mut hits), budget)?.map(|next| cursor.put_aside(next))
        } else {
            let mut cursor = Sparse::<u64, _>::new(&bvh)?;
            resume(&mut cursor, paused, &mut Unpruned(&mut hits), budget)?.map(|next| cursor.put_aside(next))
        };
        slices += 1;
        match state {
            Some(state) => bytes = states.to_bytes(&state),
            None => break,
        }
    }
    let hits = hits.into_hits();
    println!("{} hits in {slices} slices, with a state of {size} to {} bytes between them", hits.len(), bytes.len());

    // The slices find the hits of a whole traversal.
    assert!(slices > 2 && hits == BinaryTracer::new(&bvh).all(&ray));
    Ok(())
}

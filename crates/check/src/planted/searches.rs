//! Searches over rays with a mistake, against rational arithmetic; and a restart trail with one.

use glam::Vec3;

use super::draw::Draw;
use super::files::cast;
use super::kernels::{self, BelowLimit, Endless, OpenInterval};
use super::layers::{Instead, Mistake};
use super::slabs::{self, BeforeEnd};
use super::{Planted, drive};
use crate::{Case, check_tree};
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions};
use stackless_bvh::event::State;
use stackless_bvh::geom::Mesh;
use stackless_bvh::geom::kernel::{Exact, Moller32};
use stackless_bvh::geom::slabs::{Directed, Plain};
use stackless_bvh::geom::{Kernel, Slabs, Triangle};
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::{Cursor, Laine};
use stackless_bvh::tree::{Node, Tree};

pub(super) const MISTAKES: [Mistake; 7] = [
    of::<kernels::Spoilt<BelowLimit>, Directed>("of equal hits the first that is met", "DET-1"),
    of::<kernels::Spoilt<OpenInterval>, Directed>("an open interval", "EXACT-1"),
    of::<kernels::Spoilt<Endless>, Directed>("any hit, whatever the end of the ray", "EXACT-1"),
    of::<Exact, slabs::Spoilt<BeforeEnd>>("boxes that begin at the best hit are skipped", "DET-1"),
    of::<Exact, Plain>("boxes without padding", "BOX-2"),
    of::<Moller32, Directed>("triangles in single precision", "EXACT-1"),
    Mistake::new(
        "a restart takes a node that wants one child for done",
        "LAINE-1",
        |draw| restart(draw, true),
        Instead::Walk(|| restarted(true)),
    ),
];

pub(super) const CONTROLS: [Mistake; 2] = [
    of::<Exact, Directed>("the exact search", "DET-1"),
    Mistake::new(
        "a restart trail, wrapped",
        "LAINE-1",
        |draw| restart(draw, false),
        Instead::Walk(|| restarted(false)),
    ),
];

const fn of<K, B>(name: &'static str, clause: &'static str) -> Mistake
where
    K: Kernel<Vector = Vec3, Shape = Triangle>,
    B: Slabs<Vector = Vec3>,
{
    Mistake::new(name, clause, fault::<K, B>, Instead::Rays(cast::<K, B>))
}

fn fault<K, B>(draw: &mut Draw<'_>) -> Option<String>
where
    K: Kernel<Vector = Vec3, Shape = Triangle>,
    B: Slabs<Vector = Vec3>,
{
    let (mesh, rays) = draw.scene()?;
    let bvh = built(draw, &mesh)?;
    check_tree::<K, B, _>(&bvh, &mesh, &rays).err().map(|fault| fault.to_string())
}

/// A hierarchy by any builder.
pub(super) fn built(draw: &mut Draw<'_>, mesh: &Mesh) -> Option<Bvh> {
    let sah = SahOptions { max_leaf: draw.one_of([1, 2, 4]), ..SahOptions::default() };
    let options = BuildOptions { builder: draw.one_of(Builder::ALL), sah, ..BuildOptions::default() };
    options.build(mesh).ok()
}

fn restart(draw: &mut Draw<'_>, is_hasty: bool) -> Option<String> {
    let case = Case::draw(draw, Case::LEAVES);
    restarted(is_hasty).fault(&case).map(|fault| fault.to_string())
}

fn restarted(is_hasty: bool) -> Planted {
    let run = Planted::any("", "", move |tree, _, visitor, watcher| {
        if let Ok(laine) = Laine::new(tree) {
            drive(Hasty { laine, is_hasty }, visitor, watcher);
        }
    });
    run.restarting()
}

/// The restart trail. If hasty, it forgets that the interval may have been so short from the start that a node above the pop
/// level wanted one child, and takes that child for what the shorter interval has left of two.
struct Hasty<'t> {
    laine: Laine<'t, 0, u64, Tree>,
    is_hasty: bool,
}

impl State for Hasty<'_> {
    type Word = u64;

    fn node(&self) -> Node {
        self.laine.node()
    }

    fn is_restarting(&self) -> bool {
        self.laine.is_restarting()
    }
}

impl Cursor for Hasty<'_> {
    const RESTARTS: bool = true;

    fn descend(&mut self, descent: Descent) -> bool {
        let is_done = self.is_hasty && self.is_restarting() && !descent.postpones();
        !is_done && self.laine.descend(descent)
    }

    fn backtrack(&mut self) -> bool {
        self.laine.backtrack()
    }
}

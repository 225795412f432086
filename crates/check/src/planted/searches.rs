//! Searches over rays with a mistake, against rational arithmetic; and a restart trail with one.

use glam::Vec3;

use super::draw::Draw;
use super::files::cast;
use super::kernels::{self, BelowLimit, Endless, OpenInterval};
use super::layers::{Instead, Mistake};
use super::slabs::{self, BeforeEnd};
use super::wrapped::{Mutation, Wrapped};
use super::{Planted, drive};
use crate::{Case, check_tree};
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions};
use stackless_bvh::geom::kernel::{Exact, Moller32};
use stackless_bvh::geom::slabs::{Directed, Plain};
use stackless_bvh::geom::{Kernel, Mesh, Slabs, Triangle};
use stackless_bvh::traverse::Laine;

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
        |draw| restart(draw, Mutation::Hasty),
        Instead::Walk(|| restarted(Mutation::Hasty)),
    ),
];

pub(super) const CONTROLS: [Mistake; 2] = [
    of::<Exact, Directed>("the exact search", "DET-1"),
    Mistake::new(
        "a restart trail, wrapped",
        "LAINE-1",
        |draw| restart(draw, Mutation::None),
        Instead::Walk(|| restarted(Mutation::None)),
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

fn restart(draw: &mut Draw<'_>, mutation: Mutation) -> Option<String> {
    let case = Case::draw(draw, Case::LEAVES);
    restarted(mutation).fault(&case).map(|fault| fault.to_string())
}

fn restarted(mutation: Mutation) -> Planted {
    let run = Planted::any("", "", move |tree, _, visitor, watcher| {
        if let Ok(laine) = Laine::<0, u64, _>::new(tree) {
            drive(Wrapped::new(tree, laine, mutation), visitor, watcher);
        }
    });
    run.restarting()
}

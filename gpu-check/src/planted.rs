//! Planted bugs: each is one edit of a kernel's text that the comparison must detect.

use std::sync::LazyLock;

use serde::Deserialize;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::trace::{BinaryTracer, RayQueries};

use crate::kernel::Kernel;
use crate::made::{self, Made};
use crate::scene::{self, Query, Scene};
use crate::tapes::wide::WideBatch;
use crate::tapes::{self, Batch, Searches};
use crate::{Gpu, GpuError, probe, rays};

/// A bug in a kernel.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shader {
    /// A short, unique description.
    pub name: String,
    /// The clause that it breaks.
    pub clause: String,
    /// The kernel, by its full name.
    pub kernel: String,
    /// The original text.
    pub old: String,
    /// The planted text.
    pub new: String,
    /// The kind of test that detects it.
    pub by: ShownBy,
    /// The profile of the conformance suite that runs; none for kernels that do not run in the suite.
    pub profile: Option<String>,
    /// The kernel that answers the suite with this bug, if it is another one.
    pub asked: Option<String>,
    /// Why it passes the suite; `None` if it fails cases of its clause.
    pub passes: Option<String>,
}

/// The kind of test of `gpu-check` that detects a bug.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShownBy {
    /// Searches along tapes.
    Tapes,
    /// Rays through generated scenes.
    Rays,
    /// Rays of the suite that are answered exactly, or are left in doubt.
    Exact,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    bug: Vec<Shader>,
}

/// All bugs.
pub static SHADERS: LazyLock<Vec<Shader>> = LazyLock::new(|| {
    let list: List = toml::from_str(include_str!("planted/shaders.toml")).expect("a list of bugs");
    list.bug
});

/// The bugs of one kind of test.
pub fn shown_by(by: ShownBy) -> impl Iterator<Item = &'static Shader> {
    SHADERS.iter().filter(move |bug| bug.by == by)
}

/// Runs the ray kernel with the bug over the generated scenes. Returns the number of closest hits that differ from
/// rational arithmetic.
///
/// # Errors
/// The errors of [`hunt`].
pub fn hunt_rays(gpu: &Gpu, bug: &Shader) -> Result<usize, GpuError> {
    let kernel = kernel_of(bug)?;
    let arithmetic = probe::probe(gpu)?;
    let mut seen = 0;
    for made in Made::ALL {
        let data = |error: &dyn std::fmt::Display| GpuError::Data(error.to_string());
        let mesh = made.mesh(1).map_err(|error| data(&error))?;
        let bvh = Bvh::sah(&mesh, SahOptions::default()).map_err(|error| data(&error))?;
        let rays = made::rays(&mesh, 2000, 3);
        let mut on_device = Scene::new(gpu, &bvh)?;
        if kernel.is_wide() {
            on_device = on_device.with_eight(gpu, scene::hierarchy(&mesh)?)?;
        }
        let query = Query::single(&arithmetic, &rays, false)?;
        if !on_device.placed(&kernel)?.source(gpu, &kernel, query).contains(&bug.old) {
            return Err(GpuError::Data(format!("{}: nothing to change in {}", bug.name, bug.kernel)));
        }
        let found = rays::trace(gpu, &on_device, &kernel, query, &rays, &|text| text.replace(&bug.old, &bug.new))?;
        seen += rays::errors(&found, &BinaryTracer::new(&bvh).closest_parallel(&rays)?, false).differences;
    }
    Ok(seen)
}

/// The bug of this name.
///
/// # Errors
/// [`GpuError::Data`] for an unknown name.
pub fn named(name: &str) -> Result<&'static Shader, GpuError> {
    SHADERS.iter().find(|bug| bug.name == name).ok_or_else(|| GpuError::Data(format!("no mistake {name:?}")))
}

/// The kernel for trees of two children with this full name.
///
/// # Errors
/// [`GpuError::Data`] for an unknown name.
pub fn by_name(name: &str) -> Result<Kernel, GpuError> {
    let kernel = (1..=3).flat_map(Kernel::all).find(|kernel| kernel.full_name() == name);
    kernel.ok_or_else(|| GpuError::Data(format!("no kernel {name}")))
}

/// The kernel of a bug.
fn kernel_of(bug: &Shader) -> Result<Kernel, GpuError> {
    let wide = Kernel::wide().into_iter().find(|kernel| kernel.full_name() == bug.kernel);
    wide.map_or_else(|| by_name(&bug.kernel), Ok)
}

/// Runs the kernel with the bug, over trees of two children or wide trees. Returns the number of searches that reveal
/// the bug.
///
/// # Errors
/// [`GpuError`]; [`GpuError::Data`] if the edit does not apply.
pub fn hunt(gpu: &Gpu, (batch, wide): &(Batch, WideBatch), bug: &Shader) -> Result<usize, GpuError> {
    let kernel = kernel_of(bug)?;
    if kernel.is_wide() { hunt_along(gpu, wide, kernel, bug) } else { hunt_along(gpu, batch, kernel, bug) }
}

fn hunt_along(gpu: &Gpu, batch: &impl Searches, kernel: Kernel, bug: &Shader) -> Result<usize, GpuError> {
    let shape = crate::kernel::Shape { depth: 1, subgroups: false };
    let text = kernel.source(shape, kernel.tape_search(), crate::kernel::Record::Hash);
    if !text.contains(&bug.old) {
        return Err(GpuError::Data(format!("{}: nothing to change in {}", bug.name, bug.kernel)));
    }
    let report = tapes::compare(gpu, batch, &kernel, &|text| text.replace(&bug.old, &bug.new))?;
    Ok(report.mismatches)
}

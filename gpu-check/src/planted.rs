//! Planted bugs: one change of text each, which the comparison has to see.

mod shaders;

use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::trace::{BinaryTracer, RayQueries};

use crate::kernel::Kernel;
use crate::made::{self, Made};
use crate::scene::{self, Query, Scene};
use crate::tapes::wide::WideBatch;
use crate::tapes::{self, Batch, Searches};
use crate::{Gpu, GpuError, probe, rays};

pub use shaders::{SHADERS, Shader, ShownBy};

/// The mistakes that are shown by one of the tests.
pub fn shown_by(by: ShownBy) -> impl Iterator<Item = &'static Shader> {
    SHADERS.iter().filter(move |bug| bug.by == by)
}

/// Runs the ray kernel with the bug over the made scenes. The answer is how many closest hits are not those of rational
/// arithmetic.
///
/// # Errors
/// As [`hunt`].
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
        if !on_device.placed(&kernel)?.source(gpu, &kernel, query).contains(bug.from) {
            return Err(GpuError::Data(format!("{}: nothing to change in {}", bug.name, bug.kernel)));
        }
        let found = rays::trace(gpu, &on_device, &kernel, query, &rays, &|text| text.replace(bug.from, bug.to))?;
        seen += rays::errors(&found, &BinaryTracer::new(&bvh).closest_parallel(&rays)?, false).differences;
    }
    Ok(seen)
}

/// The mistake of a name.
///
/// # Errors
/// [`GpuError::Data`] if there is none.
pub fn named(name: &str) -> Result<&'static Shader, GpuError> {
    SHADERS.iter().find(|bug| bug.name == name).ok_or_else(|| GpuError::Data(format!("no mistake {name:?}")))
}

/// The kernel for trees of two children of a full name.
///
/// # Errors
/// [`GpuError::Data`] if there is none.
pub fn by_name(name: &str) -> Result<Kernel, GpuError> {
    let kernel = (1..=3).flat_map(Kernel::all).find(|kernel| kernel.full_name() == name);
    kernel.ok_or_else(|| GpuError::Data(format!("no kernel {name}")))
}

/// The kernel that a bug is in.
fn kernel_of(bug: &Shader) -> Result<Kernel, GpuError> {
    let wide = Kernel::wide().into_iter().find(|kernel| kernel.full_name() == bug.kernel);
    wide.map_or_else(|| by_name(bug.kernel), Ok)
}

/// Runs the kernel with the bug, over trees of two children or wide ones. The answer is how many searches show it.
///
/// # Errors
/// [`GpuError`]; [`GpuError::Data`] where the text has nothing to change.
pub fn hunt(gpu: &Gpu, (batch, wide): &(Batch, WideBatch), bug: &Shader) -> Result<usize, GpuError> {
    let kernel = kernel_of(bug)?;
    if kernel.is_wide() { hunt_along(gpu, wide, kernel, bug) } else { hunt_along(gpu, batch, kernel, bug) }
}

fn hunt_along(gpu: &Gpu, batch: &impl Searches, kernel: Kernel, bug: &Shader) -> Result<usize, GpuError> {
    let shape = crate::kernel::Shape { depth: 1, subgroups: false };
    let text = kernel.source(shape, kernel.tape_search(), crate::kernel::Record::Hash);
    if !text.contains(bug.from) {
        return Err(GpuError::Data(format!("{}: nothing to change in {}", bug.name, bug.kernel)));
    }
    let report = tapes::compare(gpu, batch, &kernel, &|text| text.replace(bug.from, bug.to))?;
    Ok(report.mismatches)
}

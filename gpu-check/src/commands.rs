//! What the commands do, and print.

use std::path::PathBuf;

use gpu_check::kernel::Kernel;
use gpu_check::made::{self, Made};
use gpu_check::scene::{Query, Scene};
use gpu_check::{Gpu, GpuError, planted, probe, rays, tapes};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::geom::Ray;
use stackless_bvh::scene;
use stackless_bvh::trace::Tracer;

pub(crate) fn tapes(gpu: &Gpu, trees: usize, seed: u64) -> Result<bool, GpuError> {
    const BATCH: usize = 4096;
    let mut good = true;
    for from in (0..trees).step_by(BATCH) {
        let batch = tapes::Batch::new(gpu, tapes::cases(BATCH.min(trees - from), seed.wrapping_add(from as u64)))?;
        for kernel in (1..=3).flat_map(Kernel::all) {
            let start = std::time::Instant::now();
            let report = tapes::compare(gpu, &batch, &kernel, &tapes::unchanged)?;
            let tapes::Report { name, compared, too_deep, mismatches, first } = report;
            let seconds = start.elapsed().as_secs_f32();
            println!("{name:20} {compared:6} searches, {too_deep:5} too deep, {mismatches} mismatches, {seconds:.1} s");
            if let Some(first) = first {
                println!("{first}");
            }
            good &= mismatches == 0;
        }
    }
    Ok(good)
}

pub(crate) fn planted(gpu: &Gpu, trees: usize) -> Result<bool, GpuError> {
    let batch = tapes::Batch::new(gpu, tapes::cases(trees, 1))?;
    let mut good = true;
    for bug in planted::BUGS {
        let seen = planted::hunt(gpu, &batch, bug)?;
        let verdict = if seen > 0 { "caught" } else { "NOT CAUGHT" };
        println!("{verdict}: {seen:5} searches, {:20} {}", bug.kernel, bug.name);
        good &= seen > 0;
    }
    Ok(good)
}

pub(crate) fn rays(gpu: &Gpu, files: &[PathBuf], count: usize) -> Result<bool, GpuError> {
    let data = |error: &dyn std::fmt::Display| GpuError::Data(error.to_string());
    let mut good = true;
    for made in Made::ALL.into_iter().filter(|_| files.is_empty()) {
        let mesh = made.mesh(1).map_err(|error| data(&error))?;
        let rays = made::rays(&mesh, count, 2);
        good &= compare(gpu, made.name(), &mesh, &rays, true)?;
    }
    for file in files {
        let mesh = scene::load(file).map_err(|error| data(&error))?;
        let rays = made::view(&mesh, count, 2);
        good &= compare(gpu, &file.display().to_string(), &mesh, &rays, false)?;
    }
    Ok(good)
}

/// All kernels on one scene. Where arithmetic is exact, hits must be those of the exact tracer.
fn compare(gpu: &Gpu, name: &str, mesh: &scene::Mesh, rays: &[Ray], is_exact: bool) -> Result<bool, GpuError> {
    let arithmetic = probe::probe(gpu)?;
    let bvh = Bvh::sah(mesh, SahOptions::default()).map_err(|error| GpuError::Data(error.to_string()))?;
    let on_device = Scene::new(gpu, &bvh)?;
    let truth = Tracer::new(&bvh).closest_parallel(rays);
    println!(
        "{name}: {} triangles, {} deep, {} rays, {arithmetic}",
        mesh.triangles().len(),
        on_device.depth(),
        rays.len()
    );
    let mut good = true;
    for any in [false, true] {
        let query = Query::single(&arithmetic, rays, any)?;
        for kernel in (1..=2).flat_map(Kernel::all) {
            if kernel.depth_limit().is_some_and(|limit| on_device.depth() > limit) {
                println!("{:20} too deep", kernel.full_name());
                continue;
            }
            let start = std::time::Instant::now();
            let found = rays::trace(gpu, &on_device, &kernel, query, rays)?;
            let seconds = start.elapsed().as_secs_f32();
            let expected = rays::model(&arithmetic, &bvh, &kernel, rays, any);
            let report = rays::compare(&kernel, &found, &expected, any, rays);
            let errors = rays::errors(&found, &truth, any);
            let query = if any { "any" } else { "closest" };
            println!("{:20} {query:8} {} mismatches, {errors}, {seconds:.1} s", kernel.full_name(), report.mismatches);
            if let Some(first) = report.first {
                println!("  {first}");
            }
            // In another order, roundings may decide otherwise which boxes are skipped.
            good &= report.mismatches == 0 || (!is_exact && !kernel.keeps_order());
            good &= !is_exact || errors.differences == 0;
        }
    }
    Ok(good)
}

//! The commands and their output.

use std::io::{stdin, stdout};
use std::path::{Path, PathBuf};
use std::time::Instant;

use gpu_check::bench::{self, Setting, Traffic};
use gpu_check::exact::{self, Settled};
use gpu_check::kernel::{Kernel, Table};
use gpu_check::made::{self, Made};
use gpu_check::planted::ShownBy;
use gpu_check::rays::Models;
use gpu_check::record::Record;
use gpu_check::scene::{self, Eight, Query, Scene};
use gpu_check::suite::{Adapter, Share};
use gpu_check::summary::Summary;
use gpu_check::tapes::wide::{self, WideBatch};
use gpu_check::tapes::{Searches, unchanged};
use gpu_check::{Gpu, GpuError, planted, probe, rays, tables, tapes};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::hash::PerfectHash;
use stackless_bvh::internals::trace::bounce;
use stackless_bvh::trace::{BinaryTracer, RayQueries};
use stackless_bvh::tree::Topology as _;
use stackless_suite::serve;

pub(crate) fn tapes(gpu: &Gpu, trees: usize, seed: u64) -> Result<bool, GpuError> {
    const BATCH: usize = 4096;
    let mut good = true;
    for from in (0..trees).step_by(BATCH) {
        let (count, seed) = (BATCH.min(trees - from), seed.wrapping_add(from as u64));
        let batch = tapes::Batch::new(gpu, tapes::cases(count, seed))?;
        for kernel in (1..=3).flat_map(Kernel::all) {
            good &= along_tapes(gpu, &batch, &kernel)?;
        }
        let batch = WideBatch::new(gpu, wide::cases(count, seed))?;
        for kernel in Kernel::wide() {
            good &= along_tapes(gpu, &batch, &kernel)?;
        }
    }
    Ok(good)
}

/// Prints a line of the table.
fn along_tapes(gpu: &Gpu, batch: &impl Searches, kernel: &Kernel) -> Result<bool, GpuError> {
    let start = Instant::now();
    let tapes::Report { name, compared, too_deep, visits, mismatches, first } =
        tapes::compare(gpu, batch, kernel, &unchanged)?;
    let seconds = start.elapsed().as_secs_f32();
    println!(
        "{name:20} {compared:6} searches, {visits:7} visits, {too_deep:5} too deep, {mismatches} mismatches, \
         {seconds:.1} s"
    );
    if let Some(first) = first {
        println!("{first}");
    }
    Ok(mismatches == 0)
}

pub(crate) fn planted(gpu: &Gpu, trees: usize) -> Result<bool, GpuError> {
    let batches = (tapes::Batch::new(gpu, tapes::cases(trees, 1))?, WideBatch::new(gpu, wide::cases(trees, 1))?);
    let mut good = true;
    for (by, what) in [(ShownBy::Tapes, "searches"), (ShownBy::Rays, "rays")] {
        for bug in planted::shown_by(by) {
            let seen = match by {
                ShownBy::Tapes => planted::hunt(gpu, &batches, bug)?,
                _ => planted::hunt_rays(gpu, bug)?,
            };
            let verdict = if seen > 0 { "caught" } else { "NOT CAUGHT" };
            println!("{verdict}: {seen:5} {what}, {:20} {}", bug.kernel, bug.name);
            good &= seen > 0;
        }
    }
    Ok(good)
}

/// Answers the lines on standard input.
pub(crate) fn suite(gpu: &Gpu, kernel: &str, planted: Option<&str>) -> Result<(), GpuError> {
    let bug = planted.map(planted::named).transpose()?;
    let mut adapter = Adapter::new(gpu, planted::by_name(kernel)?, bug)?;
    let served = serve(&mut adapter, stdin().lock(), stdout().lock());
    let Share { rays, certain } = adapter.share();
    if rays > 0 {
        eprintln!("ray/exact: the device was certain of {certain} of {rays} rays");
    }
    if let Some(error) = adapter.into_failure() {
        return Err(error);
    }
    served.map_err(data)
}

/// Loads the mesh of a file, and prints a note about skipped parts.
fn load(file: &Path) -> Result<Mesh, GpuError> {
    let loaded = stackless_scene::load(file).map_err(data)?;
    if let Some(note) = loaded.note(file) {
        eprintln!("{note}");
    }
    Ok(loaded.mesh)
}

pub(crate) fn rays(gpu: &Gpu, files: &[PathBuf], count: usize) -> Result<bool, GpuError> {
    let mut good = true;
    for made in Made::ALL.into_iter().filter(|_| files.is_empty()) {
        let mesh = made.mesh(1).map_err(data)?;
        let rays = made::rays(&mesh, count, 2);
        good &= compare(gpu, made.name(), &mesh, &rays, true)?;
    }
    for file in files {
        let mesh = load(file)?;
        let rays = made::view(&mesh, count, 2);
        good &= compare(gpu, &file.display().to_string(), &mesh, &rays, false)?;
    }
    Ok(good)
}

/// Meshes from files, or generated meshes, with their names.
fn meshes(files: &[PathBuf]) -> Result<Vec<(String, Mesh)>, GpuError> {
    if files.is_empty() {
        let made = Made::ALL.into_iter().map(|made| Ok((made.name().to_owned(), made.mesh(1).map_err(data)?)));
        let large = [("soup-20000", procedural::soup(1, 20_000)), ("strands-400", procedural::strands(1, 400))];
        return made.chain(large.map(|(name, mesh)| Ok((name.to_owned(), mesh)))).collect();
    }
    let load = |file: &PathBuf| Ok((file.display().to_string(), load(file)?));
    files.iter().map(load).collect()
}

fn data(error: impl std::fmt::Display) -> GpuError {
    GpuError::Data(error.to_string())
}

fn binary(mesh: &Mesh) -> Result<Bvh, GpuError> {
    Bvh::sah(mesh, SahOptions::default()).map_err(data)
}

/// Camera rays and their bounces.
fn mixed_rays(mesh: &Mesh, bvh: &Bvh, count: usize) -> Vec<Ray> {
    let mut rays = made::view(mesh, count / 2, 2);
    rays.extend(bounce(mesh, bvh, &rays, 3));
    rays
}

pub(crate) fn exact(gpu: &Gpu, files: &[PathBuf], count: usize) -> Result<bool, GpuError> {
    let arithmetic = probe::probe(gpu)?;
    let mut good = true;
    for (name, mesh) in meshes(files)? {
        let bvh = binary(&mesh)?;
        let on_device = Scene::new(gpu, &bvh)?;
        let rays = mixed_rays(&mesh, &bvh, count);
        let start = Instant::now();
        let truth = BinaryTracer::new(&bvh).closest_parallel(&rays)?;
        let exact_seconds = start.elapsed().as_secs_f64();
        for kernel in Kernel::all(Kernel::words_for(bvh.depth())) {
            if kernel.name != "hashed" {
                continue;
            }
            let factor = exact::EDGE_FACTOR;
            let settled = exact::closest(gpu, (&on_device, &bvh), &arithmetic, &kernel, &rays, factor)?;
            let wrong = settled.hits.iter().zip(&truth).filter(|(a, b)| a != b).count();
            let share = 100.0 * settled.uncertain as f64 / rays.len().max(1) as f64;
            let Settled { device_seconds, settle_seconds, .. } = settled;
            println!(
                "{name} {}: {} rays, {wrong} wrong, {share:.2} % in doubt; device {device_seconds:.2} s, then CPU \
                 {settle_seconds:.2} s; CPU alone {exact_seconds:.2} s",
                kernel.full_name(),
                rays.len()
            );
            good &= wrong == 0;
        }
    }
    Ok(good)
}

pub(crate) fn hash(gpu: &Gpu, files: &[PathBuf]) -> Result<bool, GpuError> {
    for (name, mesh) in meshes(files)? {
        let bvh = binary(&mesh)?;
        for table in [Table::Printed, Table::Tight] {
            let start = Instant::now();
            let on_cpu = PerfectHash::build(&bvh, table.options()).map_err(data)?;
            let cpu = start.elapsed().as_secs_f64() * 1e3;
            let built = tables::build(gpu, &bvh, table.options())?;
            let header = built.hash.header();
            let time = built.nanoseconds.map_or("no clock".to_owned(), |ns| format!("{:.2} ms", ns / 1e6));
            println!(
                "{name} {table:?}: {} nodes, {} keys, D = {}, H = {} (CPU {}), {} direct (CPU {}); device {time}, CPU \
                 {cpu:.2} ms; certified",
                bvh.node_count(),
                header.keys,
                header.displacements,
                header.cells.get(),
                on_cpu.header().cells.get(),
                header.direct,
                on_cpu.header().direct
            );
        }
    }
    Ok(true)
}

/// `folder` receives the record.
pub(crate) fn bench(gpu: &Gpu, scenes: &[PathBuf], setting: Setting, folder: Option<&Path>) -> Result<bool, GpuError> {
    let arithmetic = probe::probe(gpu)?;
    let (mut rows, mut traffics) = (Vec::new(), Vec::new());
    println!("{}", bench::HEADER);
    for (name, mesh) in meshes(scenes)? {
        let bvh = binary(&mesh)?;
        let name = Path::new(&name).file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().into_owned());
        bench::bench(gpu, &arithmetic, (&name, &mesh, &bvh), setting, &mut |said| match said {
            Ok(row) => {
                println!("{row}");
                rows.push(row.clone());
            }
            Err(traffic) => {
                let Traffic { children, nodes, triangles, leaves } = traffic;
                let bytes = traffic.bytes();
                let line = format!(
                    "# a ray: {nodes:.1} nodes of {children}, {triangles:.1} triangles, {leaves:.1} leaves, {bytes:.0} \
                     bytes and lookups"
                );
                println!("{line}");
                traffics.push(format!("{name}: {}", line.trim_start_matches("# ")));
            }
        })?;
    }
    let summary = Summary::of(&rows);
    println!("{summary}");
    if let Some(folder) = folder {
        let (device, arithmetic) = (gpu.name(), arithmetic.to_string());
        let record = Record { device, arithmetic, setting, rows: &rows, traffic: &traffics };
        println!("# record: {}", record.write(folder)?.display());
    }
    Ok(true)
}

/// Compares all kernels on one scene. If arithmetic is exact, hits must be those of the exact tracer.
fn compare(gpu: &Gpu, name: &str, mesh: &Mesh, rays: &[Ray], is_exact: bool) -> Result<bool, GpuError> {
    let arithmetic = probe::probe(gpu)?;
    let bvh = binary(mesh)?;
    let on_device = Scene::new(gpu, &bvh)?.with_eight(gpu, scene::hierarchy(mesh)?)?;
    let truth = BinaryTracer::new(&bvh).closest_parallel(rays)?;
    println!(
        "{name}: {} triangles, {} deep, {} levels of eight children, {} rays, {arithmetic}",
        mesh.triangles().len(),
        on_device.depth(),
        on_device.eight().map_or(0, Eight::levels),
        rays.len()
    );
    let mut good = true;
    for any in [false, true] {
        let query = Query::single(&arithmetic, rays, any)?;
        let mut models = Models::new(&arithmetic, (&bvh, on_device.eight()), rays, any);
        for kernel in (1..=2).flat_map(Kernel::all).chain(Kernel::wide()) {
            if let Err(refused) = on_device.placed(&kernel) {
                println!("not launched: {refused}");
                continue;
            }
            let start = Instant::now();
            let found = rays::trace(gpu, &on_device, &kernel, query, rays, &unchanged)?;
            let seconds = start.elapsed().as_secs_f32();
            let report = rays::compare(&kernel, &found, models.of(&kernel)?, any, rays);
            let errors = rays::errors(&found, &truth, any);
            let query = if any { "any" } else { "closest" };
            println!("{:20} {query:8} {} mismatches, {errors}, {seconds:.1} s", kernel.full_name(), report.mismatches);
            if let Some(first) = report.first {
                println!("  {first}");
            }
            // With another order, rounding may change which boxes are skipped.
            good &= report.mismatches == 0 || (!is_exact && !kernel.keeps_order());
            good &= !is_exact || errors.differences == 0;
        }
    }
    Ok(good)
}

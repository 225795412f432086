//! The checks of the command on the device that is here. Without one they fail: nothing has been checked then.

use std::process::Command;
use std::time::Duration;

use gpu_check::kernel::Kernel;
use gpu_check::made::{self, Made};
use gpu_check::scene::{Query, Scene};
use gpu_check::tapes::{Batch, cases, compare, unchanged};
use gpu_check::{Access, Checks, Gpu, GpuError, planted, probe, rays};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::trace::Tracer;

fn gpu() -> Gpu {
    Gpu::open(None).unwrap()
}

#[test]
fn every_kernel_has_the_events_of_the_oracle() {
    let gpu = gpu();
    let batch = Batch::new(&gpu, cases(2048, 1)).unwrap();
    for depth in [31, 32, 62, 63, 64] {
        assert!((0..batch.searches()).filter(|&i| batch.depth(i) == depth).count() >= 20, "{depth}");
    }
    for kernel in (1..=3).flat_map(Kernel::all) {
        let report = compare(&gpu, &batch, &kernel, &unchanged).unwrap();
        assert!(report.compared >= 3000, "{report:?}");
        assert_eq!(report.mismatches, 0, "{}: {}", report.name, report.first.unwrap());
    }
}

#[test]
fn planted_bugs_are_caught() {
    let gpu = gpu();
    let batch = Batch::new(&gpu, cases(1024, 1)).unwrap();
    let caught = |bug: &planted::Bug| planted::hunt(&gpu, &batch, bug).unwrap() > 0;
    let missed: Vec<_> = planted::BUGS.iter().filter(|bug| !caught(bug)).map(|bug| (bug.kernel, bug.name)).collect();
    assert_eq!(missed, []);
}

#[test]
fn a_mismatch_is_shown_event_by_event() {
    let gpu = gpu();
    let batch = Batch::new(&gpu, cases(64, 1)).unwrap();
    let bug = |text: String| text.replace("stack[at] = word;", "stack[at] = word + 4u;");
    let report = compare(&gpu, &batch, &Kernel::all(1)[0], &bug).unwrap();
    let text = report.first.unwrap().to_string();
    assert!(text.contains("visit ") && text.contains("expected ") && text.contains("tape "), "{text}");
}

/// Two searches for each of three scenes, 20,000 rays in all, by every kernel of one and two words.
#[test]
fn hits_are_those_of_the_model_and_of_rational_arithmetic() {
    let gpu = gpu();
    let arithmetic = probe::probe(&gpu).unwrap();
    for scene in Made::ALL {
        let mesh = scene.mesh(1).unwrap();
        let bvh = Bvh::sah(&mesh, SahOptions::default()).unwrap();
        let rays = made::rays(&mesh, 6700, 2);
        let on_device = Scene::new(&gpu, &bvh).unwrap();
        let tracer = Tracer::new(&bvh);
        let truth = tracer.closest_parallel(&rays);
        let hits = truth.iter().flatten().count();
        assert!((1000..6600).contains(&hits), "{hits}");
        for any in [false, true] {
            let query = Query::single(&arithmetic, &rays, any).unwrap();
            for kernel in (1..=2).flat_map(Kernel::all) {
                let name = format!("{} {} {any}", scene.name(), kernel.full_name());
                let found = rays::trace(&gpu, &on_device, &kernel, query, &rays).unwrap();
                let expected = rays::model(&arithmetic, &bvh, &kernel, &rays, any);
                let report = rays::compare(&kernel, &found, &expected, any, &rays);
                assert_eq!(report.mismatches, 0, "{name}: {}", report.first.unwrap());
                let errors = rays::errors(&found, &truth, any);
                assert_eq!(errors, rays::Errors::default(), "{name}");
            }
        }
    }
}

#[test]
fn what_the_device_refuses_is_an_error() {
    let gpu = gpu();
    let refused = gpu.compile("nonsense", "fn main( {", &[Access::Read], Checks::All);
    assert!(matches!(refused, Err(GpuError::Refused { .. })), "{refused:?}");
    // Whatever the limit is, this is beyond it, and nothing is allocated.
    let too_large = gpu.zeros("all memory there is", 1 << 46);
    assert!(matches!(too_large, Err(GpuError::Limit { .. })), "{too_large:?}");
    assert_eq!(too_large.unwrap_err().exit_code(), 3);
    // It works on.
    assert!(probe::probe(&gpu).is_ok());
}

#[test]
fn a_lost_device_is_an_error() {
    let gpu = gpu();
    gpu.lose();
    let error = probe::probe(&gpu).unwrap_err();
    assert!(matches!(error, GpuError::Lost(_)), "{error:?}");
}

#[test]
fn nothing_hangs() {
    let gpu = gpu().with_patience(Duration::ZERO);
    let error = (0..20).find_map(|_| Batch::new(&gpu, cases(512, 1)).err()).unwrap();
    assert!(matches!(error, GpuError::Timeout(_)), "{error:?}");
}

#[test]
fn without_an_adapter_nothing_passes() {
    let run = |arguments: &[&str]| Command::new(env!("CARGO_BIN_EXE_gpu-check")).args(arguments).output().unwrap();
    for command in ["tapes", "rays", "probe", "planted"] {
        let output = run(&["--adapter", "none of this name", command]);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!((output.status.code(), text.contains("pass")), (Some(3), false), "{command}: {text}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("unsupported: "));
    }
}

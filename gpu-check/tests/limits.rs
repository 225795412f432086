//! Lost, missing and insufficient devices: an error message, an exit code, and no waiting.

use std::process::Command;
use std::time::{Duration, Instant};

use gpu_check::kernel::Kernel;
use gpu_check::planted::by_name;
use gpu_check::suite::Adapter;
use gpu_check::tapes::{Batch, cases, compare, unchanged};
use gpu_check::{Gpu, GpuError, probe};
use stackless_suite::{Answer, Implementation as _, Suite};
use wgpu::Limits;

/// The name of a limit error.
fn limit(error: GpuError) -> String {
    assert_eq!(error.exit_code(), 3, "{error}");
    match error {
        GpuError::Limit { what, needed, limit } if needed > limit => what,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_limit_that_is_too_small_is_named() {
    let few = Gpu::open_within(None, |all| Limits { max_storage_buffers_per_shader_stage: 4, ..all }).unwrap();
    assert!(probe::probe(&few).is_ok());
    let batch = Batch::new(&few, cases(16, 1)).unwrap();
    let refused = compare(&few, &batch, &by_name("hashed").unwrap(), &unchanged).unwrap_err();
    assert_eq!(limit(refused), "hashed: storage buffers");

    let short = Gpu::open_within(None, |all| Limits { max_storage_buffer_binding_size: 1 << 14, ..all }).unwrap();
    assert!(limit(Batch::new(&short, cases(256, 1)).unwrap_err()).ends_with(": bytes"));

    let narrow = Gpu::open_within(None, |all| Limits { max_compute_workgroup_storage_size: 1 << 14, ..all }).unwrap();
    let batch = Batch::new(&narrow, cases(256, 1)).unwrap();
    let kernel = by_name("stack-workgroup").unwrap();
    let refused = compare(&narrow, &batch, &kernel, &unchanged).unwrap_err();
    assert_eq!(limit(refused), "stack-workgroup: bytes of a work group");
    // As an adapter it supports smaller trees.
    let adapter = Adapter::new(&narrow, kernel, None).unwrap();
    assert_eq!(adapter.hello().limits.max_depth, Some(64));
}

#[test]
fn more_than_an_adapter_has_is_unsupported() {
    let error = Gpu::open_within(None, |all| Limits { max_compute_workgroup_size_x: u32::MAX, ..all }).unwrap_err();
    assert!(matches!(error, GpuError::NoAdapter(_)) && error.exit_code() == 3, "{error:?}");
}

/// A buffer within all limits that are checked in advance: the device itself refuses it.
#[test]
fn memory_that_is_not_there_is_an_error() {
    let gpu = Gpu::open(None).unwrap();
    let buffer = gpu.zeros("a small one", 4).unwrap();
    let error = gpu.read(&buffer, 1 << 40).unwrap_err();
    assert!(matches!(error, GpuError::Refused { .. }) && error.to_string().starts_with("copy: "), "{error:?}");
    assert!(gpu.read(&buffer, 4).is_ok());
}

/// Answers one case repeatedly, and loses the device after the first answer.
fn answers_after(gpu: &Gpu, lose: impl Fn()) -> (Vec<Answer>, Option<GpuError>) {
    let mut adapter = Adapter::new(gpu, Kernel::all(1)[0], None).unwrap();
    let suite = Suite::shipped().unwrap();
    let mut cases = suite.cases().filter(|(profile, _)| profile.name() == "trace/script");
    let (profile, case) = cases.next().unwrap();
    let mut answers = Vec::new();
    for round in 0..4 {
        answers.push(adapter.answer(profile.level, &profile.profile, &case.input));
        if round == 0 {
            lose();
        }
    }
    (answers, adapter.into_failure())
}

#[test]
fn a_device_that_is_lost_answers_nothing_more() {
    let gpu = Gpu::open(None).unwrap();
    let (answers, failure) = answers_after(&gpu, || gpu.lose());
    assert!(matches!(answers[0], Answer::Result(_)), "{answers:?}");
    for answer in &answers[1..] {
        assert!(matches!(answer, Answer::Unsupported(why) if why.contains("lost")), "{answer:?}");
    }
    assert!(matches!(failure, Some(GpuError::Lost(_))), "{failure:?}");
}

#[test]
fn a_device_that_does_not_answer_is_not_waited_for() {
    let start = Instant::now();
    let impatient = Gpu::open(None).unwrap().with_patience(Duration::ZERO);
    let error = (0..20).find_map(|_| Adapter::new(&impatient, Kernel::all(1)[0], None).err());
    assert!(matches!(error, Some(GpuError::Timeout(_))), "{error:?}");
    assert!(start.elapsed() < Duration::from_mins(1));
}

#[test]
fn without_an_adapter_nothing_passes() {
    // The Vulkan loader reads this instead of the list of drivers.
    let none = [("VK_DRIVER_FILES", "no-such-driver.json"), ("VK_ICD_FILENAMES", "no-such-driver.json")];
    for command in ["tapes", "rays", "probe", "planted", "suite", "bench"] {
        let program = || Command::new(env!("CARGO_BIN_EXE_gpu-check"));
        let [mut unnamed, mut driverless] = [program(), program()];
        unnamed.args(["--adapter", "none of this name", command]);
        driverless.arg(command).envs(none);
        for (mut program, what) in [(unnamed, "unsupported: "), (driverless, "unsupported: no Vulkan adapter")] {
            let output = program.output().unwrap();
            let [said, error] =
                [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
            assert_eq!((output.status.code(), said.contains("pass")), (Some(3), false), "{command}: {said}{error}");
            assert!(error.contains(what), "{command}: {error}");
        }
    }
}

//! An adapter: a kernel as an implementation for the conformance suite.
//!
//! The kernel computes the answers on the device. The host only writes trees, scripts and scenes into buffers, formats
//! the answers, and rejects invalid trees and scenes. In `ray/exact` it settles the rays that the kernel leaves in
//! doubt, and rays with unsupported numbers.

mod rays;
mod tables;
mod walks;
mod words;

use serde_json::{Map, Value};
use stackless_suite::{Answer, Ask, Feature, Hello, Implementation, Level, Limits, PROTOCOL};

pub use rays::Share;

use crate::kernel::{Kernel, Traversal, WORKGROUP};
use crate::planted::Shader;
use crate::probe::{Arithmetic, probe};
use crate::{Access, Checks, Gpu, GpuError, Pipeline};

/// Maximum depth of trees, in edges, for kernels with a stack.
const STACK_EDGES: u32 = 255;

/// Maximum depth of a scene's hierarchy, in edges. Stacks are initialised to zero for each ray.
const SCENE_EDGES: u32 = 64;

/// A kernel that answers cases. Pipelines are compiled on first use, and kept.
#[derive(Debug)]
pub struct Adapter<'g> {
    device: Device<'g>,
    arithmetic: Arithmetic,
    words: Option<words::Words>,
    tables: Option<tables::Tables<'g>>,
    walks: Option<walks::Walks>,
    rays: Option<rays::Rays>,
    failure: Option<GpuError>,
}

/// A device and its kernel, optionally with a bug.
#[derive(Clone, Copy, Debug)]
struct Device<'g> {
    gpu: &'g Gpu,
    kernel: Kernel,
    bug: Option<&'static Shader>,
    /// Maximum depth of a tree, in edges.
    depth: u32,
}

impl<'g> Adapter<'g> {
    /// A kernel, optionally with a bug in its text.
    ///
    /// # Errors
    /// Errors of the device.
    pub fn new(gpu: &'g Gpu, kernel: Kernel, bug: Option<&'static Shader>) -> Result<Self, GpuError> {
        let depth = kernel.depth_limit().unwrap_or(match kernel.traversal {
            Traversal::StackWorkgroup => (gpu.workgroup_bytes() / (4 * WORKGROUP)).min(STACK_EDGES),
            _ => STACK_EDGES,
        });
        let device = Device { gpu, kernel, bug, depth };
        let arithmetic = probe(gpu)?;
        Ok(Self { device, arithmetic, words: None, tables: None, walks: None, rays: None, failure: None })
    }

    /// The error of the device, if there is one.
    pub fn into_failure(self) -> Option<GpuError> {
        self.failure
    }

    /// Number of rays of `ray/exact` that were certain on the device.
    pub fn share(&self) -> Share {
        self.rays.as_ref().map_or(Share::default(), rays::Rays::share)
    }

    fn profiles(&self) -> Vec<&'static str> {
        let kernel = &self.device.kernel;
        let mut profiles = Vec::new();
        match kernel.words {
            1 if kernel.has_words() => profiles.push("key/u32"),
            2 => profiles.push("key/u64"),
            _ => {}
        }
        // The suite's tables have keys of 64 bits.
        if kernel.has_keys() && kernel.words > 1 {
            profiles.extend(["hash/function", "hash/address", "hash/lookup", "hash/build"]);
        }
        if kernel.keeps_order() {
            profiles.extend(["trace/script", "trace/complete", "trace/invalid"]);
            profiles.push(match kernel.traversal {
                Traversal::StackT0 => "trace/distance",
                Traversal::HashedDisjoint => "trace/disjoint",
                _ => "trace/tape",
            });
        }
        if self.arithmetic.refines().is_ok() {
            profiles.push("ray/grid");
        }
        if crate::exact::holds(&self.arithmetic).is_ok() {
            profiles.push("ray/exact");
        }
        profiles.push("ray/invalid");
        profiles
    }

    fn answered(&mut self, level: Level, profile: &str, ask: &Ask) -> Result<Option<Answer>, GpuError> {
        let device = &self.device;
        match level {
            Level::Key => lazily(&mut self.words, || words::Words::new(device))?.answer(device, ask),
            Level::Hash => lazily(&mut self.tables, || tables::Tables::new(device))?.answer(device, ask),
            Level::Trace => lazily(&mut self.walks, || walks::Walks::new(device))?.answer(device, ask),
            Level::Ray => lazily(&mut self.rays, || Ok(rays::Rays::new(self.arithmetic)))?.answer(device, profile, ask),
            Level::Resume => Ok(None),
        }
    }
}

impl Implementation for Adapter<'_> {
    fn hello(&self) -> Hello {
        let Device { gpu, kernel, bug, depth } = &self.device;
        let has = [
            (kernel.has_trail(), Feature::Trails),
            (kernel.has_register(), Feature::Registers),
            (kernel.decides_once(), Feature::Changing),
            (true, Feature::Weights),
        ];
        let bug = bug.map_or(String::new(), |bug| format!(", planted: {}", bug.name));
        Hello {
            protocol: PROTOCOL,
            name: format!("gpu-check {}{bug} on {}", kernel.full_name(), gpu.name()),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            profiles: self.profiles().into_iter().map(ToOwned::to_owned).collect(),
            features: has.into_iter().filter_map(|(has, feature)| has.then_some(feature)).collect(),
            limits: Limits { max_depth: Some(*depth), ..Limits::default() },
        }
    }

    fn answer(&mut self, level: Level, profile: &str, input: &Map<String, Value>) -> Answer {
        // A lost device stays lost, and a device that does not answer is not queried again.
        if let Some(failure) = &self.failure {
            return Answer::Unsupported(failure.to_string());
        }
        if !self.profiles().contains(&format!("{level}/{profile}").as_str()) {
            return Answer::Unsupported(format!("{level}/{profile} was not named"));
        }
        let ask: Ask = match serde_json::from_value(Value::Object(input.clone())) {
            Ok(ask) => ask,
            Err(error) => return Answer::Unsupported(error.to_string()),
        };
        match self.answered(level, profile, &ask) {
            Ok(Some(answer)) => answer,
            Ok(None) => Answer::Unsupported("an operation or numbers that are not of this profile".to_owned()),
            Err(GpuError::Data(what)) => Answer::Unsupported(what),
            Err(error) => {
                let answer = Answer::Unsupported(error.to_string());
                self.failure = Some(error);
                answer
            }
        }
    }
}

impl Device<'_> {
    /// Maximum depth of the hierarchy, in edges.
    fn scene_depth(&self) -> u32 {
        self.depth.min(SCENE_EDGES)
    }

    /// Compiles a text, with the bug if there is one.
    fn compile(&self, what: &str, source: &str, bindings: &[Access]) -> Result<Pipeline, GpuError> {
        self.gpu.compile(what, &self.edited(source.to_owned()), bindings, Checks::All)
    }

    fn edited(&self, text: String) -> String {
        self.bug.map_or(text.clone(), |bug| text.replace(&bug.old, &bug.new))
    }
}

/// Returns the value, and creates it on first use.
fn lazily<T>(slot: &mut Option<T>, make: impl FnOnce() -> Result<T, GpuError>) -> Result<&mut T, GpuError> {
    match slot {
        Some(made) => Ok(made),
        empty => Ok(empty.insert(make()?)),
    }
}

fn result<const N: usize>(fields: [(&str, Value); N]) -> Answer {
    Answer::Result(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
}

/// Parses hexadecimal digits, up to 64 bits.
fn number(digits: &str) -> Option<u64> {
    u64::from_str_radix(digits, 16).ok()
}

fn hex(number: impl Into<u128>) -> Value {
    Value::String(format!("{:x}", number.into()))
}

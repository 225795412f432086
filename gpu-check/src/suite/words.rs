//! Level `key`: the functions of words, one invocation for each question.

use serde_json::{Value, json};
use stackless_suite::{Answer, Ask};

use super::{Device, hex, number, result};
use crate::layout::halves;
use crate::{Access, GpuError, Pass, Pipeline};

/// A kernel's words on the device.
#[derive(Debug)]
pub(super) struct Words {
    pipeline: Pipeline,
    answers: wgpu::Buffer,
}

/// The answer of `ask_key.wgsl` if no key remains.
const NOTHING: u32 = u32::MAX;

impl Words {
    pub(super) fn new(device: &Device<'_>) -> Result<Self, GpuError> {
        let word = match device.kernel.words {
            1 => include_str!("../../wgsl/word1.wgsl"),
            _ => include_str!("../../wgsl/word2.wgsl"),
        };
        let text = [word, include_str!("../../wgsl/ask_key.wgsl")].concat();
        let pipeline = device.compile("keys", &text, &[Access::Read, Access::Write])?;
        Ok(Self { pipeline, answers: device.gpu.zeros("answers", 8)? })
    }

    pub(super) fn answer(&self, device: &Device<'_>, ask: &Ask) -> Result<Option<Answer>, GpuError> {
        let Some((op, extra, [first, second])) = question(ask) else { return Ok(None) };
        if [first, second].iter().any(|word| word >> (32 * device.kernel.words - 1) > 1) {
            return Ok(None);
        }
        let words: Vec<u32> =
            [op, extra].into_iter().chain(halves(first)).chain(halves(second)).chain([0, 0]).collect();
        let asks = device.gpu.buffer("asks", &words)?;
        let buffers = vec![&asks, &self.answers];
        let pass = Pass { pipeline: &self.pipeline, buffers, groups: [1, 1], clear: Vec::new() };
        let [said] = device.gpu.run_and_read(&[pass], [(&self.answers, 8)])?;
        let levels = if said[0] == NOTHING { Value::Null } else { json!(said[0]) };
        let [first, second] = [2, 4].map(|at| hex(u64::from(said[at]) | u64::from(said[at + 1]) << 32));
        Ok(Some(match ask {
            Ask::Depth { .. } => result([("depth", levels)]),
            Ask::Levels { .. } | Ask::CounterLevels { .. } => result([("levels", levels)]),
            Ask::Backtrack { .. } => result([("levels", levels), ("key", first), ("trail", second)]),
            Ask::Descend { .. } => result([("trail", first)]),
            Ask::Counter { .. } => result([("counter", first)]),
            Ask::Swap { .. } => result([("index", first)]),
            _ => result([("key", first)]),
        }))
    }
}

/// The number of the operation in `ask_key.wgsl`, a number, and two words.
fn question(ask: &Ask) -> Option<(u32, u32, [u64; 2])> {
    let one = |op, extra, text: &str| Some((op, extra, [number(text)?, 0]));
    match ask {
        Ask::Child { key, right } => one(0, u32::from(*right), key),
        Ask::Parent { key } => one(1, 0, key),
        Ask::Sibling { key } => one(2, 0, key),
        Ask::LevelStart { key } => one(3, 0, key),
        Ask::Depth { key } => one(4, 0, key),
        Ask::Descend { trail, both } => one(0, u32::from(*both), trail),
        Ask::Levels { trail } => one(5, 0, trail),
        Ask::Backtrack { key, trail } => Some((6, 0, [number(key)?, number(trail)?])),
        Ask::Counter { trail, depth } => one(7, *depth, trail),
        Ask::CounterLevels { counter, depth } => one(8, *depth, counter),
        Ask::Swap { index, mask } => Some((9, 0, [number(index)?, number(mask)?])),
        _ => None,
    }
}

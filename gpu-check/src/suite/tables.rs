//! Level `hash`: lookups on the device in given tables, and tables that the device builds.

use serde_json::{Value, json};
use stackless_bvh::hash::Mix;
use stackless_bvh::hash::{KeySet, Options, Sizing};
use stackless_bvh::tree::{Reach, Tree};
use stackless_suite::{Answer, Ask, Build, LookupTable};

use super::{Device, hex, number, result};
use crate::layout::{TableHead, encoded, halves, node_of};
use crate::tables::Builder;
use crate::{Access, GpuError, Pass, Pipeline};

/// Lookups and the construction of tables.
#[derive(Debug)]
pub(super) struct Tables<'g> {
    questions: Pipeline,
    builder: Builder<'g>,
}

/// The value of empty cells; not an address.
const EMPTY: u32 = 0x7fff_ffff;

const CELL: u32 = 0;
const MIX: u32 = 1;
const ENCODE: u32 = 2;
const DECODE: u32 = 3;
const LOOK_UP: u32 = 4;

impl<'g> Tables<'g> {
    pub(super) fn new(device: &Device<'g>) -> Result<Self, GpuError> {
        let [word, fold] = match device.kernel.words {
            2 => [include_str!("../../wgsl/word2.wgsl"), include_str!("../../wgsl/fold2.wgsl")],
            _ => [include_str!("../../wgsl/word3.wgsl"), include_str!("../../wgsl/fold3.wgsl")],
        };
        let parts = [
            include_str!("../../wgsl/ask_hash.wgsl"),
            include_str!("../../wgsl/head.wgsl"),
            word,
            fold,
            include_str!("../../wgsl/wide.wgsl"),
            include_str!("../../wgsl/table.wgsl"),
            include_str!("../../wgsl/table_wide.wgsl"),
            include_str!("../../wgsl/remainder.wgsl"),
        ];
        let bindings = [Access::Read, Access::Read, Access::Read, Access::Write];
        let questions = device.compile("tables", &parts.concat(), &bindings)?;
        let builder = Builder::new(device.gpu, &|text| device.edited(text))?;
        Ok(Self { questions, builder })
    }

    pub(super) fn answer(&self, device: &Device<'_>, ask: &Ask) -> Result<Option<Answer>, GpuError> {
        match ask {
            Ask::Lookup(lookup) => self.look_up(device, lookup),
            Ask::Build(build) => self.build(build),
            _ => self.function(device, ask),
        }
    }

    /// Answers one question without tables.
    fn function(&self, device: &Device<'_>, ask: &Ask) -> Result<Option<Answer>, GpuError> {
        let plain = Mix { narrow: false, seed: None };
        let question = match ask {
            Ask::Cell { key, displacements, cells, displacement } if displacements.is_power_of_two() => {
                number(key).map(|key| (head(*displacements, *cells, plain), [CELL, *displacement], key))
            }
            Ask::Mix { key, seed, bits } => number(key)
                .zip(number(seed))
                .map(|(key, seed)| (head(1, 1, Mix { narrow: *bits == 32, seed: Some(seed) }), [MIX, 0], key)),
            Ask::Encode { leaf, index } => Some((head(1, 1, plain), [ENCODE, u32::from(*leaf)], u64::from(*index))),
            Ask::Decode { word } => number(word).map(|word| (head(1, 1, plain), [DECODE, 0], word)),
            _ => None,
        };
        let Some((head, question, key)) = question else { return Ok(None) };
        let [a, b] = self.ask(device, [&[0], &[0]], &head, &[(question, key)])?[0];
        Ok(Some(match ask {
            Ask::Cell { .. } => result([("bucket", json!(a)), ("cell", json!(b))]),
            Ask::Mix { .. } => result([("key", hex(u64::from(a) | u64::from(b) << 32))]),
            Ask::Encode { .. } => result([("word", hex(a))]),
            _ => match b {
                EMPTY => result([("displacement", json!(a))]),
                address => node(address),
            },
        }))
    }

    fn look_up(&self, device: &Device<'_>, lookup: &LookupTable) -> Result<Option<Answer>, GpuError> {
        let words = |texts: &[String]| {
            texts.iter().map(|text| number(text).and_then(|word| u32::try_from(word).ok())).collect::<Option<Vec<_>>>()
        };
        let (Some(displacements), Some(cells)) = (words(&lookup.displacements), words(&lookup.cells)) else {
            return Ok(None);
        };
        let Some(keys) = lookup.keys.iter().map(|key| number(key)).collect::<Option<Vec<_>>>() else { return Ok(None) };
        let seed = lookup.seed.as_deref().and_then(number);
        let mix = Mix { narrow: lookup.bits == Some(32), seed };
        let head = head(displacements.len() as u32, cells.len() as u32, mix);
        // The format of kernels: addresses, with a mark in the table of displacements.
        let address = |word: u32| node_of(word).map(|node| if node.is_leaf() { word } else { node.index() as u32 });
        let displacements: Vec<u32> = displacements.iter().map(|&word| address(word).map_or(word, encoded)).collect();
        let cells: Vec<u32> = cells.iter().map(|&word| address(word).unwrap_or(EMPTY)).collect();
        let questions: Vec<_> = keys.iter().map(|&key| ([LOOK_UP, 0], key)).collect();
        let said = self.ask(device, [&displacements, &cells], &head, &questions)?;
        let word = |address: u32| match address {
            EMPTY => 0,
            0..EMPTY => 1 << 31 | address,
            leaf => leaf,
        };
        let words = said.iter().map(|&[address, _]| hex(word(address))).collect();
        Ok(Some(result([("words", Value::Array(words))])))
    }

    fn build(&self, Build { children, reach, sizes }: &Build) -> Result<Option<Answer>, GpuError> {
        let Ok(tree) = Tree::new(children) else { return Ok(None) };
        let key_set = match reach.map(|[inner, leaf]| Reach::new(inner, leaf)) {
            Some(Some(reach)) => KeySet::Exact(reach),
            Some(None) => return Ok(None),
            None => KeySet::All,
        };
        let made = self.builder.make(&tree, Options { key_set, sizing: Sizing::Tight }, *sizes)?;
        Ok(Some(match made {
            Some(made) => {
                let words = |words: &[u32]| -> Value { words.iter().map(|&word| hex(word)).collect() };
                result([("displacements", words(&made.displacements)), ("cells", words(&made.cells))])
            }
            None => Answer::Reject("no-table".to_owned()),
        }))
    }

    /// Returns two words for each question. A question is an operation, a number and a key.
    fn ask(
        &self,
        device: &Device<'_>,
        [displacements, cells]: [&[u32]; 2],
        head: &[u32; 16],
        questions: &[([u32; 2], u64)],
    ) -> Result<Vec<[u32; 2]>, GpuError> {
        let gpu = device.gpu;
        let (displacements, cells) = (gpu.buffer("displacements", displacements)?, gpu.buffer("cells", cells)?);
        let questions = questions.iter().flat_map(|&(question, key)| question.into_iter().chain(halves(key)));
        let words: Vec<u32> = head.iter().copied().chain(questions).collect();
        let count = words.len() / 4 - 4;
        let (tasks, answers) = (gpu.buffer("tasks", &words)?, gpu.zeros("answers", 2 * count)?);
        let buffers = vec![&displacements, &cells, &tasks, &answers];
        let pass = Pass { pipeline: &self.questions, buffers, groups: [count as u32, 1], clear: Vec::new() };
        let [said] = gpu.run_and_read(&[pass], [(&answers, 2 * count)])?;
        Ok(said.as_chunks().0.to_vec())
    }
}

fn head(displacements: u32, cells: u32, mix: Mix) -> [u32; 16] {
    let reciprocal = u64::MAX / u64::from(cells.max(1));
    let mask = displacements.wrapping_sub(1);
    TableHead { mask, displacements_at: 0, size: cells, cells_at: 0, reciprocal, mix, fold_seed: 0 }.words(0, 0)
}

fn node(address: u32) -> Answer {
    let is_leaf = address > EMPTY;
    result([("leaf", json!(is_leaf)), ("index", json!(if is_leaf { !address } else { address }))])
}

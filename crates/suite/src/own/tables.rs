//! Level `hash`.

use serde_json::{Value, json};

use super::text::{hex, word};
use crate::ask::{Build, LookupTable};
use crate::{Answer, Ask};
use stackless_bvh::hash::Mix;
use stackless_bvh::hash::{BuildError, KeySet, Options, PerfectHash, Sizing, fold};
use stackless_bvh::internals::hash::{Header, Modulo, Reciprocal, TableSize, decode, encode, is_address, wrap};
use stackless_bvh::key::Grow;
use stackless_bvh::tree::{Keys, Node, Reach, Topology, Tree};

pub(super) fn answer(ask: &Ask) -> Option<Answer> {
    match ask {
        Ask::Cell { key, displacements, cells, displacement } => {
            let key: u64 = word(key)?;
            if !displacements.is_power_of_two() || displacement >= cells {
                return None;
            }
            let modulus = Reciprocal::of(TableSize::new(*cells)?);
            let cell = wrap(modulus.of_u64(key) + displacement, *cells);
            Some(Answer::of([("bucket", json!(key & u64::from(displacements - 1))), ("cell", json!(cell))]))
        }
        Ask::Mix { key, seed, bits } => {
            let mix = Mix { narrow: *bits == 32, seed: Some(word(seed)?) };
            Some(Answer::of([("key", Value::String(hex(&mix.apply(word(key)?))))]))
        }
        Ask::Fold { key, seed } => {
            Some(Answer::of([("key", Value::String(hex(&fold(&word::<Grow>(key)?, word(seed)?))))]))
        }
        Ask::Encode { leaf, index } => {
            if index >> 30 != 0 {
                return None;
            }
            let node = if *leaf { Node::leaf(*index) } else { Node::inner(*index) };
            Some(Answer::of([("word", Value::String(hex(&encode(node))))]))
        }
        Ask::Decode { word: text } => {
            let word: u32 = word(text)?;
            if !is_address(word) {
                return Some(Answer::of([("displacement", json!(word))]));
            }
            let node = decode(word);
            Some(Answer::of([("leaf", json!(node.is_leaf())), ("index", json!(node.index()))]))
        }
        Ask::HashedKeys { children, reach } => hashed_keys(children, *reach),
        Ask::HashedKeysWide { slots, children } => super::wide::hashed_keys(*slots, children),
        Ask::Lookup(table) => look_up(table),
        Ask::Build(tree) => build(tree),
        _ => None,
    }
}

fn hashed_keys(children: &[Option<[u32; 2]>], [inner, leaf]: [u32; 2]) -> Option<Answer> {
    let tree = Tree::new(children).ok()?;
    let keys = Keys::of(&tree);
    let hashed = KeySet::Exact(Reach::new(inner, leaf)?).slots(&tree);
    let mut keys: Vec<u64> = (0..tree.node_count()).filter(|&slot| hashed[slot]).map(|slot| keys.key(slot)).collect();
    keys.sort_unstable();
    Some(Answer::of([("keys", keys.iter().map(hex).collect())]))
}

fn look_up(table: &LookupTable) -> Option<Answer> {
    let words = |texts: &[String]| texts.iter().map(|text| word(text)).collect::<Option<Box<[u32]>>>();
    let mix = match (&table.seed, table.bits) {
        (Some(seed), Some(bits)) => Mix { narrow: bits == 32, seed: Some(word(seed)?) },
        _ => Mix { narrow: false, seed: None },
    };
    let hash = PerfectHash::given(words(&table.displacements)?, words(&table.cells)?, mix)?;
    let answer = |key: &String| hash.probe(&word::<u64>(key)?).map(|node| Value::String(hex(&encode(node))));
    Some(Answer::of([("words", Value::Array(table.keys.iter().map(answer).collect::<Option<_>>()?))]))
}

fn build(Build { children, reach, sizes }: &Build) -> Option<Answer> {
    let tree = Tree::new(children).ok()?;
    let key_set = match reach {
        Some([inner, leaf]) => KeySet::Exact(Reach::new(*inner, *leaf)?),
        None => KeySet::All,
    };
    let built = match sizes {
        Some(_) => PerfectHash::build_plain(&tree, Options { key_set, sizing: Sizing::Printed }),
        None => PerfectHash::build(&tree, Options { key_set, sizing: Sizing::Tight }),
    };
    let hash = match built {
        Ok(hash) => hash,
        Err(BuildError::NoDisplacement { .. }) => return Some(Answer::Reject("no-table".to_owned())),
        Err(_) => return None,
    };
    let Header { mix, displacements, cells, fold_seed, .. } = *hash.header();
    if sizes.is_some_and(|sizes| sizes != [displacements, cells.get()]) {
        return None;
    }
    let words = |words: &[u32]| -> Value { words.iter().map(hex).collect() };
    let tables = [("displacements", words(hash.displacements())), ("cells", words(hash.cells()))];
    let seed =
        mix.seed.map(|seed| [("seed", Value::String(hex(&seed))), ("bits", json!(if mix.narrow { 32 } else { 64 }))]);
    let fold = (tree.depth() >= u64::BITS).then(|| ("fold", Value::String(hex(&fold_seed))));
    Some(Answer::of(tables.into_iter().chain(seed.into_iter().flatten()).chain(fold)))
}

//! Level `key`.

use serde_json::{Value, json};

use super::{Author, result};
use crate::bits::Bits;
use crate::{Ask, Level, Profile};
use stackless_bvh::generate::{Rng, Source};

/// Name and width of each profile.
const PROFILES: [(&str, usize); 4] = [("u32", 32), ("u64", 64), ("u128", 128), ("wide", 300)];

pub(super) fn profiles() -> Vec<Profile> {
    PROFILES.iter().map(|&(name, width)| profile(name, width)).collect()
}

fn profile(name: &str, width: usize) -> Profile {
    let mut author = Author::new(Level::Key, name);
    let mut rng = Rng::new(width as u64);
    for (label, key) in keys(width, &mut rng) {
        of_key(&mut author, &label, &key, width);
    }
    for (label, key, trail) in trails(width, &mut rng) {
        of_trail(&mut author, &label, &key, &trail, width);
    }
    for (label, index, mask) in masks(width, &mut rng) {
        let swapped = Bits(index.0.iter().zip(&mask.0).map(|(a, b)| a != b).collect());
        let ask = Ask::Swap { index: index.hex(), mask: mask.hex() };
        let clauses = ["SWAP-1", "SWAP-2", "SWAP-3", "SWAP-4"];
        let why = "Each level of the mask changes sides.";
        author.case(&format!("swap-{label}"), &clauses, why, &ask, result([("index", hex(&swapped))]));
    }
    // Trail and counter have a bit for each level below the root: one level more than a key with the same number of
    // bits.
    for (name, bit) in patterns(width as u64) {
        let trail = Bits((0..=width).map(|i| i > 0 && bit(i)).collect());
        of_counter(&mut author, &format!("{name}-{width}"), &trail);
    }
    author.done()
}

fn hex(bits: &Bits) -> Value {
    Value::String(bits.hex())
}

fn of_key(author: &mut Author, label: &str, key: &Bits, width: usize) {
    let text = key.hex();
    let depth = key.0.len() - 1;
    if key.0.len() < width {
        for (right, side) in [(false, "left"), (true, "right")] {
            let ask = Ask::Child { key: text.clone(), right };
            let child = result([("key", hex(&key.clone().then(right)))]);
            author.case(&format!("child-{side}-{label}"), &["KEY-2"], "A bit is appended.", &ask, child);
        }
    }
    let parent = result([("key", hex(&key.clone().without(1)))]);
    let why = if depth == 0 { "The root has no parent: 0." } else { "The last bit is dropped." };
    author.case(&format!("parent-{label}"), &["KEY-3"], why, &Ask::Parent { key: text.clone() }, parent);
    if depth > 0 {
        let sibling = result([("key", hex(&key.clone().flip_last()))]);
        let ask = Ask::Sibling { key: text.clone() };
        author.case(&format!("sibling-{label}"), &["KEY-4"], "The last bit changes.", &ask, sibling);
    }
    let ask = Ask::Depth { key: text.clone() };
    let why = "One less than the number of bits.";
    author.case(&format!("depth-{label}"), &["KEY-5"], why, &ask, result([("depth", json!(depth))]));
    let mut start = Bits::zeros(depth + 1);
    start.0[0] = true;
    let ask = Ask::LevelStart { key: text };
    let why = "The leading one alone.";
    author.case(&format!("level-start-{label}"), &["KEY-6"], why, &ask, result([("key", hex(&start))]));
}

fn of_trail(author: &mut Author, label: &str, key: &Bits, trail: &Bits, width: usize) {
    let (depth, text) = (key.0.len() - 1, trail.hex());
    let levels = if trail.is_zero() { Value::Null } else { json!(trail.trailing(false)) };
    let why = if trail.is_zero() { "Nothing is postponed: the end." } else { "Zeros below the lowest one." };
    let ask = Ask::Levels { trail: text.clone() };
    author.case(&format!("levels-{label}"), &["TRAIL-3"], why, &ask, result([("levels", levels.clone())]));
    of_counter(author, label, trail);
    if depth + 1 < width {
        for both in [false, true] {
            let ask = Ask::Descend { trail: text.clone(), both };
            let why = if both { "The sibling is postponed: a one." } else { "Nothing is postponed: a zero." };
            let name = format!("descend-{}-{label}", if both { "both" } else { "one" });
            author.case(&name, &["TRAIL-2"], why, &ask, result([("trail", hex(&trail.clone().then(both)))]));
        }
    }
    if trail.is_zero() {
        return;
    }
    // The loop of the literal climb.
    let climbed = trail.trailing(false);
    let (to, left) = (key.clone().without(climbed).flip_last(), trail.clone().without(climbed).flip_last());
    let ask = Ask::Backtrack { key: key.hex(), trail: text };
    let why = match climbed {
        0 => "The sibling is postponed: no shift.",
        n if n + 1 == depth => "All the way up to a child of the root.",
        _ => "Up to the lowest one; then both last bits change.",
    };
    let answer = result([("levels", levels), ("key", hex(&to)), ("trail", hex(&left))]);
    author.case(&format!("backtrack-{label}"), &["TRAIL-4", "TRAIL-5"], why, &ask, answer);
}

/// Cases of a trail with one more bit than the counter.
fn of_counter(author: &mut Author, label: &str, trail: &Bits) {
    let (text, depth) = (trail.hex(), (trail.0.len() - 1) as u32);
    let counter = Bits(trail.0[1..].to_vec()).complement();
    let ask = Ask::Counter { trail: text, depth };
    let why = "The complement of the trail, below the depth.";
    author.case(&format!("counter-{label}"), &["TRAIL-6"], why, &ask, result([("counter", hex(&counter))]));
    let levels = if trail.is_zero() { Value::Null } else { json!(trail.trailing(false)) };
    let ask = Ask::CounterLevels { counter: counter.hex(), depth };
    let why = if trail.is_zero() { "All ones: the end." } else { "Ones below the lowest zero." };
    author.case(&format!("counter-levels-{label}"), &["TRAIL-6"], why, &ask, result([("levels", levels)]));
}

/// Keys at depths around the word sizes.
fn keys(width: usize, rng: &mut Rng) -> Vec<(String, Bits)> {
    let mut keys = vec![("root".to_owned(), Bits::root())];
    for depth in [1, 2, width / 2, width - 2, width - 1] {
        for (name, bit) in patterns(rng.bits()) {
            keys.push((format!("{name}-{depth}"), Bits((0..=depth).map(|i| i == 0 || bit(i)).collect())));
        }
    }
    keys
}

/// Keys and trails of equal depth. The trail has a bit for each bit of the key except the root's.
fn trails(width: usize, rng: &mut Rng) -> Vec<(String, Bits, Bits)> {
    let mut trails = vec![("root".to_owned(), Bits::root(), Bits::zeros(1))];
    for depth in [1, 2, 3, width / 2, width - 2, width - 1] {
        let seed = rng.bits();
        let key = Bits((0..=depth).map(|i| i == 0 || random_bit(seed, i)).collect());
        let trail = |set: &dyn Fn(usize) -> bool| Bits((0..=depth).map(|i| i > 0 && set(i)).collect());
        let seed = rng.bits();
        let shapes = [
            ("none", trail(&|_| false)),
            ("all", trail(&|_| true)),
            ("highest", trail(&|i| i == 1)),
            ("lowest", trail(&|i| i == depth)),
            ("two", trail(&|i| i == 1 || i + 1 == depth)),
            ("random", trail(&|i| random_bit(seed, i))),
            ("high-half", trail(&|i| i <= depth / 2)),
        ];
        trails.extend(shapes.map(|(name, trail)| (format!("{name}-{depth}"), key.clone(), trail)));
    }
    trails
}

fn masks(width: usize, rng: &mut Rng) -> Vec<(String, Bits, Bits)> {
    let mut masks = Vec::new();
    for (index_name, index) in patterns(rng.bits()) {
        for (mask_name, mask) in patterns(rng.bits()) {
            for length in [3, width] {
                let word = |bit: &dyn Fn(usize) -> bool| Bits((0..length).map(bit).collect());
                masks.push((format!("{index_name}-by-{mask_name}-{length}"), word(&*index), word(&*mask)));
            }
        }
    }
    masks
}

type Pattern = Box<dyn Fn(usize) -> bool>;

fn patterns(seed: u64) -> [(&'static str, Pattern); 4] {
    [
        ("zeros", Box::new(|_| false)),
        ("ones", Box::new(|_| true)),
        ("turns", Box::new(|i| i % 2 == 1)),
        ("random", Box::new(move |i| random_bit(seed, i))),
    ]
}

fn random_bit(seed: u64, i: usize) -> bool {
    Rng::new(seed ^ i as u64).coin()
}

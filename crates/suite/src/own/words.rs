//! Level `key`.

use serde_json::{Value, json};

use super::text::{hex, word};
use crate::{Answer, Ask};
use stackless_bvh::key::{self, Grow, KeyWord};
use stackless_bvh::{swap, trail};

pub(super) fn answer(profile: &str, ask: &Ask) -> Option<Answer> {
    match profile {
        "u32" => of_word::<u32>(ask),
        "u64" => of_word::<u64>(ask),
        "u128" => of_word::<u128>(ask),
        "wide" => of_word::<Grow>(ask),
        _ => None,
    }
}

fn of_word<W: KeyWord>(ask: &Ask) -> Option<Answer> {
    let text = |word: &W| Value::String(hex(word));
    let key_is = |key: W| Some(Answer::of([("key", text(&key))]));
    match ask {
        Ask::Child { key, right } => key_is(key::child(word(key)?, W::from_bit(*right))),
        Ask::Parent { key } => key_is(key::parent(word(key)?)),
        Ask::Sibling { key } => key_is(key::sibling(word(key)?)),
        Ask::LevelStart { key } => key_is(key::level_start(&word::<W>(key)?)),
        Ask::Depth { key } => Some(Answer::of([("depth", json!(key::depth(&word::<W>(key)?)))])),
        Ask::Descend { trail, both } => {
            Some(Answer::of([("trail", text(&trail::child(word(trail)?, W::from_bit(*both))))]))
        }
        Ask::Levels { trail } => {
            let trail: W = word(trail)?;
            let levels = if trail.is_zero() { Value::Null } else { json!(trail::levels(&trail)) };
            Some(Answer::of([("levels", levels)]))
        }
        Ask::Backtrack { key, trail } => {
            let (key, trail): (W, W) = (word(key)?, word(trail)?);
            if trail.is_zero() {
                return None;
            }
            let levels = trail::levels(&trail);
            let (key, trail) = trail::backtrack(key, trail);
            Some(Answer::of([("levels", json!(levels)), ("key", text(&key)), ("trail", text(&trail))]))
        }
        Ask::Counter { trail, depth } => {
            let counter = trail::counter(word(trail)?, level_start::<W>(*depth)?);
            Some(Answer::of([("counter", text(&counter))]))
        }
        Ask::CounterLevels { counter, depth } => {
            let trail = trail::counter(word(counter)?, level_start::<W>(*depth)?);
            let levels = if trail.is_zero() { Value::Null } else { json!(trail::levels(&trail)) };
            Some(Answer::of([("levels", levels)]))
        }
        Ask::Swap { index, mask } => {
            let index = swap::fcomp(word::<W>(index)?, &word(mask)?);
            Some(Answer::of([("index", text(&index))]))
        }
        _ => None,
    }
}

/// Returns two to the power of the depth, or 0 at the number of the word's bits; `None` for greater depths, or for
/// depths that would take too long.
fn level_start<W: KeyWord>(depth: u32) -> Option<W> {
    (depth <= W::WIDTH.unwrap_or(1 << 16)).then(|| (0..depth).fold(W::one(), |start, _| start.shl1()))
}

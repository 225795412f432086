//! Words and traces in the format of the suite's files.

use stackless_bvh::event::{Event, Trace};
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::tree::{Keys, Tree};

/// Formats a word in lower-case hexadecimal without leading zeros.
pub fn hex<W: KeyWord>(word: &W) -> String {
    let (mut rest, mut digits) = (word.clone(), Vec::new());
    while !rest.is_zero() {
        digits.push(char::from_digit(rest.low_bits() & 15, 16).unwrap_or('0'));
        rest = (0..4).fold(rest, |rest, _| rest.shr1());
    }
    if digits.is_empty() { "0".to_owned() } else { digits.into_iter().rev().collect() }
}

/// Parses a word; `None` if the digits are not in the format of [`hex`], or too long for the word.
pub(crate) fn word<W: KeyWord>(digits: &str) -> Option<W> {
    let is_plain = digits == "0" || !digits.is_empty() && !digits.starts_with('0');
    let bits =
        4 * digits.len() as u32 - digits.chars().next()?.to_digit(16)?.leading_zeros().min(31).saturating_sub(28);
    if !is_plain || W::WIDTH.is_some_and(|width| bits > width) {
        return None;
    }
    let mut word = W::zero();
    for digit in digits.bytes() {
        let digit = match digit {
            b'0'..=b'9' => digit - b'0',
            b'a'..=b'f' => digit - b'a' + 10,
            _ => return None,
        };
        word = (0..4).rev().fold(word, |word, bit| word.shl1().or(&W::from_bit(digit >> bit & 1 == 1)));
    }
    Some(word)
}

/// Formats a trace for answers. `[TRACE-1]`
pub(crate) fn events(trace: &Trace, tree: &Tree, keys: &Keys) -> Vec<String> {
    let text = |event| match event {
        Event::Enter(key) => format!("enter {}", hex(&key)),
        Event::Leaf(key) => format!("leaf {}", hex(&key)),
        Event::Backtrack(key, levels) => format!("backtrack {} {levels}", hex(&key)),
        Event::End => "end".to_owned(),
    };
    trace.events::<Grow>(tree, keys).map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_back() {
        for value in [0, 1, 0xf, 0x10, 0x1f, u64::MAX / 2, u64::MAX] {
            assert_eq!(hex(&value), format!("{value:x}"));
            assert_eq!(word(&format!("{value:x}")), Some(value));
            assert_eq!(hex(&word::<Grow>(&format!("{value:x}")).unwrap()), format!("{value:x}"));
        }
        let long = "1".repeat(80);
        assert_eq!(hex(&word::<Grow>(&long).unwrap()), long);
        assert_eq!(word::<u128>(&long), None);
        assert_eq!(word::<u8>("ff"), Some(255));
        assert_eq!(word::<u8>("100"), None);
        for wrong in ["", "00", "01", "0x1", "F", "-1", " 1", "g"] {
            assert_eq!(word::<u64>(wrong), None, "{wrong}");
        }
    }
}

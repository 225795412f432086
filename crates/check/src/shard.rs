//! Shards of a run.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// One shard of a run. Each list of work is divided into consecutive ranges, so all shards together equal the whole
/// run, for any number of shards.
///
/// ```
/// use stackless_check::Shard;
///
/// let third: Shard = "3/7".parse()?;
/// assert_eq!(third.range(100), 28..42);
/// assert_eq!(Shard::WHOLE.range(100), 0..100);
/// # Ok::<(), stackless_check::ShardError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Counted from 1.
    index: u64,
    count: u64,
}

/// The error for text that is not a shard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected I/N with I from 1 to N, as in 3/64")]
pub struct ShardError;

impl Shard {
    /// The whole run as one shard.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Returns the range of this shard, out of the numbers from 0 up to `total`. If `total` is below the number of
    /// shards, some ranges are empty.
    pub fn range(self, total: u64) -> Range<u64> {
        // The quotient is at most `total`.
        let end = |index: u64| (u128::from(total) * u128::from(index) / u128::from(self.count)) as u64;
        end(self.index - 1)..end(self.index)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let (index, count) = text.split_once('/').ok_or(ShardError)?;
        let number = |text: &str| text.parse::<u64>().map_err(|_| ShardError);
        let (index, count) = (number(index)?, number(count)?);
        if (1..=count).contains(&index) { Ok(Self { index, count }) } else { Err(ShardError) }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_follow_each_other() {
        for total in [0, 1, 6, 7, 100, u64::MAX] {
            for count in [1, 2, 7, 64, 1000] {
                let mut next = 0;
                for index in 1..=count {
                    let range = Shard { index, count }.range(total);
                    assert_eq!(range.start, next);
                    // Lengths differ by at most one.
                    assert!((total / count..=total.div_ceil(count)).contains(&(range.end - range.start)));
                    next = range.end;
                }
                assert_eq!(next, total);
            }
        }
    }

    #[test]
    fn other_texts_are_refused() {
        for text in ["", "1", "0/1", "2/1", "1/0", "-1/2", "1/2/3", "1 / 2", "a/b"] {
            assert_eq!(text.parse::<Shard>(), Err(ShardError), "{text}");
        }
        assert_eq!("5/9".parse::<Shard>().map(|shard| shard.to_string()).as_deref(), Ok("5/9"));
    }
}

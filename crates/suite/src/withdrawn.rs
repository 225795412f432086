//! Withdrawn cases, whose ids are never used again.

use core::fmt;

use serde::Serialize;

/// A withdrawn case: its expectation was wrong, or a definition has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Withdrawn {
    /// Its former id.
    pub id: &'static str,
    /// The first version of the suite without it.
    pub since: &'static str,
    /// The reason, with the case that replaces it.
    pub reason: &'static str,
}

macro_rules! by_rounded_distances {
    ($($name:literal)*) => {
        [$(Withdrawn {
            id: concat!("ray/exact/", $name),
            since: "2.0.0",
            reason: concat!(
                "replaced by ray/exact/",
                $name,
                "-ordered because hits at one rounded distance were in the order of their triangles' numbers",
            ),
        }),*]
    };
}

impl Withdrawn {
    /// All withdrawn cases.
    pub const ALL: &'static [Self] = &by_rounded_distances! {
        "far-origin"
        "stack-ulp"
        "stack-tilted"
        "ize"
        "max-and-tiny"
        "t-underflow"
        "t-above-0"
    };

    /// Returns the withdrawn case that had an id.
    pub fn of(id: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|case| case.id == id)
    }
}

impl fmt::Display for Withdrawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { id, since, reason } = self;
        write!(f, "case '{id}' was withdrawn in suite {since}: {reason}")
    }
}

//! Answers of this library.

mod rays;
mod tables;
pub(crate) mod text;
mod walks;
mod wide;
mod words;

pub use rays::{RayScene, RaysError};

use serde_json::{Map, Value};

use super::author::PROFILES;
use super::{Answer, Ask, Feature, Hello, Implementation, Level, Limits, PROTOCOL};
use stackless_bvh::internals::trace::Accuracy;
use stackless_bvh::traverse::{Method, Test, WordName};
use stackless_bvh::wide::Method as WideMethod;

/// This library as an implementation: one traversal with one word, or a suitable one for each profile.
///
/// ```
/// use stackless_suite::{Implementation, Library, author, judge};
///
/// let mut library = Library::default();
/// let hello = library.hello();
/// for (profile, case) in author::suite().cases().take(100) {
///     let answer = library.answer(profile.level, &profile.profile, &case.input);
///     assert_eq!(judge(case, &hello, &answer), Ok(()), "{}", case.id);
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Library {
    traversal: Option<Traversal>,
    word: Option<WordName>,
    accuracy: Accuracy,
    features: Vec<Feature>,
    limits: Limits,
}

/// A traversal of this library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Traversal {
    /// A traversal of binary trees.
    Binary(Method),
    /// A traversal of wide trees.
    Wide(WideMethod),
}

impl Traversal {
    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Binary(method) => method.name(),
            Self::Wide(method) => method.name(),
        }
    }

    /// Returns the traversals of binary trees and those of wide trees, in their order.
    pub fn of_each_kind(all: &[Self]) -> (Vec<Method>, Vec<WideMethod>) {
        let (mut binary, mut wide) = (Vec::new(), Vec::new());
        for &traversal in all {
            match traversal {
                Self::Binary(method) => binary.push(method),
                Self::Wide(method) => wide.push(method),
            }
        }
        (binary, wide)
    }
}

impl Default for Library {
    fn default() -> Self {
        Self::new(None, None)
    }
}

impl Library {
    /// Chooses a traversal and a word. Without a traversal, each profile uses a suitable one, with the growing word.
    /// Traversals of wide trees have their own words.
    pub fn new(traversal: Option<Traversal>, word: Option<WordName>) -> Self {
        let (binary, wide) = match traversal {
            None => (None, Some(WideMethod::default())),
            Some(Traversal::Binary(method)) => (Some(method), None),
            Some(Traversal::Wide(method)) => (None, Some(method)),
        };
        let (features, max_depth) = walks::claims(binary, word.unwrap_or(WordName::Grow));
        let limits = Limits { max_depth, wide: wide.map(wide::claims) };
        Self { traversal, word, accuracy: Accuracy::Exact, features, limits }
    }

    /// Selects other tests for rays. Inexact tests do not conform.
    #[must_use]
    pub fn with_accuracy(self, accuracy: Accuracy) -> Self {
        Self { accuracy, ..self }
    }

    fn word(&self) -> WordName {
        self.word.unwrap_or(WordName::Grow)
    }

    /// Returns the traversal for a profile; `None` if the chosen one does not support it.
    fn traversal_for(&self, level: Level, profile: &str) -> Option<Traversal> {
        let binary = || self.method_for(level, profile).map(Traversal::Binary);
        binary().or_else(|| self.wide_method_for(level, profile).map(Traversal::Wide))
    }

    fn method_for(&self, level: Level, profile: &str) -> Option<Method> {
        let usual = match (level, profile) {
            (Level::Trace, "script" | "tape" | "invalid") | (Level::Resume, "state" | "key-only" | "invalid") => {
                Method::Hashed
            }
            (Level::Trace, "node-left") => Method::LeftFirst,
            (Level::Trace, "node-sign") => Method::Hapala,
            (Level::Trace, "complete") => Method::Complete,
            (Level::Trace, "distance") => Method::StackT0,
            (Level::Trace | Level::Resume, "disjoint") => Method::HashedDisjoint,
            _ => return None,
        };
        let method = match self.traversal {
            None => return Some(usual),
            Some(Traversal::Binary(method)) => method,
            Some(Traversal::Wide(_)) => return None,
        };
        let is_whole = method.can_pause() && method.test() == Test::Children;
        let fits = match (level, profile) {
            (Level::Trace, "invalid") => true,
            // It supports complete trees only, and these profiles have any trees.
            (Level::Trace, "script" | "tape") => method.test() == Test::Children && method != Method::Complete,
            (Level::Trace, _) => method.test() == usual.test(),
            (Level::Resume, "disjoint") => method.can_pause() && method.test() == Test::Disjoint,
            _ => is_whole,
        };
        fits.then_some(method)
    }

    fn wide_method_for(&self, level: Level, profile: &str) -> Option<WideMethod> {
        let method = match self.traversal {
            None => WideMethod::default(),
            Some(Traversal::Binary(_)) => return None,
            Some(Traversal::Wide(method)) => method,
        };
        let fits = match (level, profile) {
            (Level::Trace, "wide" | "wide-invalid") => true,
            (Level::Resume, "wide") => wide::can_resume(method),
            _ => false,
        };
        fits.then_some(method)
    }
}

impl Implementation for Library {
    fn hello(&self) -> Hello {
        let all = PROFILES.iter().flat_map(|&(level, profiles)| profiles.iter().map(move |&profile| (level, profile)));
        let is_walk = |level| matches!(level, Level::Trace | Level::Resume);
        let profiles = all.filter(|&(level, profile)| !is_walk(level) || self.traversal_for(level, profile).is_some());
        // Crossings are counted by the exact test.
        let profiles = profiles.filter(|&(_, profile)| profile != "parity" || self.accuracy == Accuracy::Exact);
        let profiles = profiles.map(|(level, profile)| format!("{level}/{profile}")).collect();
        let method = self.traversal.map_or("stackless-bvh", Traversal::name);
        Hello {
            protocol: PROTOCOL,
            name: match (self.word, self.accuracy) {
                (None, Accuracy::Exact) => method.to_owned(),
                (Some(word), Accuracy::Exact) => format!("{method} in {word}"),
                (_, accuracy) => format!("{method}, {accuracy}"),
            },
            version: env!("CARGO_PKG_VERSION").to_owned(),
            profiles,
            features: self.features.iter().copied().chain([Feature::Weights]).collect(),
            limits: self.limits,
        }
    }

    fn answer(&mut self, level: Level, profile: &str, input: &Map<String, Value>) -> Answer {
        let ask = match Ask::of(input) {
            Ok(ask) => ask,
            Err(error) => return Answer::Unsupported(error.to_string()),
        };
        let unsupported = || Answer::Unsupported(format!("no {level}/{profile}"));
        match level {
            Level::Key => words::answer(profile, &ask),
            Level::Hash => tables::answer(&ask),
            Level::Ray => rays::answer(self.accuracy, &ask),
            Level::Trace | Level::Resume => match self.traversal_for(level, profile) {
                Some(Traversal::Binary(method)) => walks::answer(method, self.word(), &self.features, &ask),
                Some(Traversal::Wide(method)) => wide::answer(method, &ask),
                None => None,
            },
        }
        .unwrap_or_else(unsupported)
    }
}

//! What this library answers.

mod rays;
mod tables;
pub(crate) mod text;
mod walks;
mod words;

pub use rays::RaysError;

use serde_json::{Map, Value};

use super::author::PROFILES;
use super::{Answer, Ask, Feature, Hello, Implementation, Level, Limits, PROTOCOL};
use stackless_bvh::trace::Accuracy;
use stackless_bvh::traverse::{Method, Test, WordName};

/// This library as an implementation: one traversal in one word, or for each profile one that has it.
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
    method: Option<Method>,
    word: Option<WordName>,
    accuracy: Accuracy,
    features: Vec<Feature>,
    max_depth: Option<u32>,
}

impl Default for Library {
    fn default() -> Self {
        Self::new(None, None)
    }
}

impl Library {
    /// A traversal in a word; where none is given, one for each profile, in the word that grows.
    pub fn new(method: Option<Method>, word: Option<WordName>) -> Self {
        let (features, max_depth) = walks::claims(method, word.unwrap_or(WordName::Grow));
        Self { method, word, accuracy: Accuracy::Exact, features, max_depth }
    }

    /// The same, with rays traced by other tests: what is not exact does not conform.
    #[must_use]
    pub fn with_accuracy(self, accuracy: Accuracy) -> Self {
        Self { accuracy, ..self }
    }

    fn word(&self) -> WordName {
        self.word.unwrap_or(WordName::Grow)
    }

    /// The traversal that answers a profile; `None` if the chosen one does not.
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
        let Some(method) = self.method else { return Some(usual) };
        let is_whole = method.can_pause() && method.test() == Test::Children;
        let fits = match (level, profile) {
            (Level::Trace, "invalid") => true,
            // Complete trees are the only ones that it carries, and trees are what it is given.
            (Level::Trace, "script" | "tape") => method.test() == Test::Children && method != Method::Complete,
            (Level::Trace, _) => method.test() == usual.test(),
            (Level::Resume, "disjoint") => method.can_pause() && method.test() == Test::Disjoint,
            _ => is_whole,
        };
        fits.then_some(method)
    }
}

impl Implementation for Library {
    fn hello(&self) -> Hello {
        let all = PROFILES.iter().flat_map(|&(level, profiles)| profiles.iter().map(move |&profile| (level, profile)));
        let is_walk = |level| matches!(level, Level::Trace | Level::Resume);
        let profiles = all.filter(|&(level, profile)| !is_walk(level) || self.method_for(level, profile).is_some());
        let profiles = profiles.map(|(level, profile)| format!("{level}/{profile}")).collect();
        let method = self.method.map_or("stackless-bvh", Method::name);
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
            limits: Limits { max_depth: self.max_depth },
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
            Level::Trace | Level::Resume => match self.method_for(level, profile) {
                Some(method) => walks::answer(method, self.word(), &self.features, &ask),
                None => None,
            },
        }
        .unwrap_or_else(unsupported)
    }
}

//! What this library answers.

mod rays;
mod tables;
pub(crate) mod text;
mod walks;
mod wide;
mod words;

pub use rays::RaysError;

use serde_json::{Map, Value};

use super::author::PROFILES;
use super::{Answer, Ask, Feature, Hello, Implementation, Level, Limits, PROTOCOL};
use stackless_bvh::trace::Accuracy;
use stackless_bvh::traverse::{Method, Test, WordName};
use stackless_bvh::wide::Method as WideMethod;

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
    /// The traversal of wide trees, and whether it is the only one that was asked for.
    wide: Option<WideMethod>,
    is_wide: bool,
    limits: Limits,
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
        let wide = method.is_none().then(WideMethod::default);
        let limits = Limits { max_depth, wide: wide.map(wide::claims) };
        Self { method, word, accuracy: Accuracy::Exact, features, wide, is_wide: false, limits }
    }

    /// A traversal of wide trees, and none of others.
    pub fn wide(method: WideMethod) -> Self {
        let limits = Limits { max_depth: None, wide: Some(wide::claims(method)) };
        Self { wide: Some(method), is_wide: true, limits, ..Self::default() }
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
        let Some(method) = self.method else { return (!self.is_wide).then_some(usual) };
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

    /// The traversal of wide trees that answers a profile.
    fn wide_method_for(&self, level: Level, profile: &str) -> Option<WideMethod> {
        self.wide.filter(|&method| match (level, profile) {
            (Level::Trace, "wide" | "wide-invalid") => true,
            (Level::Resume, "wide") => wide::can_resume(method),
            _ => false,
        })
    }
}

impl Implementation for Library {
    fn hello(&self) -> Hello {
        let all = PROFILES.iter().flat_map(|&(level, profiles)| profiles.iter().map(move |&profile| (level, profile)));
        let is_walk = |level| matches!(level, Level::Trace | Level::Resume);
        let profiles = all.filter(|&(level, profile)| {
            let is_walked =
                || self.method_for(level, profile).is_some() || self.wide_method_for(level, profile).is_some();
            !is_walk(level) || is_walked()
        });
        let profiles = profiles.map(|(level, profile)| format!("{level}/{profile}")).collect();
        let wide = self.wide.filter(|_| self.is_wide).map(WideMethod::name);
        let method = self.method.map(Method::name).or(wide).unwrap_or("stackless-bvh");
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
            Level::Trace | Level::Resume => {
                match (self.method_for(level, profile), self.wide_method_for(level, profile)) {
                    (Some(method), _) => walks::answer(method, self.word(), &self.features, &ask),
                    (None, Some(method)) => wide::answer(method, &ask),
                    (None, None) => None,
                }
            }
        }
        .unwrap_or_else(unsupported)
    }
}

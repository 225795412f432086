//! Mistakes below the traversals, as implementations: what the mistake is in is replaced, and the rest is the
//! library's.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::hash::{KeySet, Mix};
use stackless_bvh::trace::Hit;
use stackless_bvh::tree::{Reach, Topology as _, Tree};
use stackless_check::planted::{Function, Instead, Table};
use stackless_suite::{
    Answer, Ask, Build, Flaw, Implementation as _, Level, Library, LookupTable, Profile, Query, RayScene, Rays, Suite,
    SuiteCase, judge,
};

/// Cases with what they ask, which is read once.
pub(crate) struct Asked<'s>(Vec<(&'s Profile, &'s SuiteCase, Ask, Option<Scene>)>);

type Scene = (Mesh, Vec<Ray>);

impl<'s> Asked<'s> {
    /// All but traversals.
    pub(crate) fn of(suite: &'s Suite) -> Self {
        let is_wanted = |level| matches!(level, Level::Hash | Level::Ray);
        let cases = suite.cases().filter(|(profile, _)| is_wanted(profile.level)).map(|(profile, case)| {
            let ask = Ask::of(&case.input).unwrap();
            let scene = if let Ask::Ray(asked) = &ask { asked.read().ok().and_then(RayScene::whole) } else { None };
            (profile, case, ask, scene)
        });
        Self(cases.collect())
    }

    /// How many cases ask for what is replaced, and those that are failed.
    pub(crate) fn failures(&self, instead: Instead) -> (usize, Vec<(&'s SuiteCase, Flaw)>) {
        let hello = Library::default().hello();
        let judged: Vec<_> = (self.0.iter())
            .filter_map(|(profile, case, ask, scene)| {
                let answer = answer(instead, profile, &case.input, ask, scene.as_ref())?;
                Some((*case, judge(case, &hello, &answer)))
            })
            .collect();
        let asked = judged.len();
        (asked, judged.into_iter().filter_map(|(case, verdict)| Some((case, verdict.err()?))).collect())
    }
}

/// The clause of the cases that ask for what is replaced, where none cites the clause that a mistake breaks.
pub(crate) fn seen_as(instead: Instead) -> &'static str {
    match instead {
        Instead::Table(_) | Instead::Reach(_) => "HASH-9",
        Instead::Function(_) => "HASH-1",
        Instead::Rays(_) => "EXACT-1",
        Instead::Wide(_) => "WIDE-7",
        Instead::Walk(_) | Instead::Nothing(_) => "TRAVERSE-1",
    }
}

/// The answer to a case that asks for what is replaced.
fn answer(
    instead: Instead,
    profile: &Profile,
    input: &Map<String, Value>,
    ask: &Ask,
    scene: Option<&Scene>,
) -> Option<Answer> {
    match (instead, ask) {
        (Instead::Table(table), Ask::Build(Build { children, reach, sizes: None })) => {
            let tree = Tree::new(children).unwrap();
            let key_set = reach.map_or(KeySet::All, |[inner, leaf]| KeySet::Exact(Reach::new(inner, leaf).unwrap()));
            Some(words(&table(&tree, key_set)?, tree.depth() >= u64::BITS))
        }
        (Instead::Reach(change), Ask::HashedKeys { reach, .. } | Ask::Build(Build { reach: Some(reach), .. })) => {
            let [inner, leaf] = *reach;
            let reach = change(Reach::new(inner, leaf).unwrap())?;
            let mut input = input.clone();
            input.insert("reach".to_owned(), json!([reach.of(false), reach.of(true)]));
            Some(Library::default().answer(profile.level, &profile.profile, &input))
        }
        (Instead::Function(function), ask) => look_up(function, ask),
        (Instead::Rays(cast), Ask::Ray(Rays { query, .. })) => {
            let (mesh, rays) = scene?;
            let hits = cast(mesh, rays)?;
            let hits = match query {
                Query::Closest => hits.closest.into_iter().map(hit).collect(),
                Query::Any => json!(hits.any),
                Query::Parity => return None,
            };
            Some(result([("hits", hits)]))
        }
        _ => None,
    }
}

fn look_up(function: Function, ask: &Ask) -> Option<Answer> {
    match ask {
        Ask::Cell { key, displacements, cells, displacement } => {
            let (key, d, h) = (number(key), u64::from(*displacements), u64::from(*cells));
            let cell = function.cell(key, h, *displacement);
            Some(result([("bucket", json!(function.bucket(key, d))), ("cell", json!(cell))]))
        }
        Ask::Decode { word } => {
            let word = number(word) as u32;
            let node = if function.is_address(word) { function.node(word) } else { None };
            Some(match node {
                Some(node) => result([("leaf", json!(node.is_leaf())), ("index", json!(node.index()))]),
                None => result([("displacement", json!(word))]),
            })
        }
        Ask::Lookup(LookupTable { displacements, cells, seed, bits, keys }) => {
            let words = |words: &[String]| words.iter().map(|word| number(word) as u32).collect::<Vec<_>>();
            let (displacements, cells) = (words(displacements), words(cells));
            let mix = Mix { narrow: *bits == Some(32), seed: seed.as_deref().map(number) };
            let word = |key: &String| function.word(&displacements, &cells, mix, number(key)).unwrap_or_default();
            Some(result([("words", keys.iter().map(|key| hex(word(key))).collect())]))
        }
        _ => None,
    }
}

fn words(table: &Table, has_long_keys: bool) -> Answer {
    let Table { displacements, cells, mix, fold } = table;
    let words = |words: &[u32]| words.iter().map(hex).collect();
    let tables = [("displacements", words(displacements)), ("cells", words(cells))];
    let seed = mix.seed.map(|seed| [("seed", hex(seed)), ("bits", json!(if mix.narrow { 32 } else { 64 }))]);
    let fold = has_long_keys.then(|| ("fold", hex(fold)));
    result(tables.into_iter().chain(seed.into_iter().flatten()).chain(fold))
}

fn hit(hit: Option<Hit>) -> Value {
    let bits = |x: f32| format!("{:08x}", x.to_bits());
    hit.map_or(Value::Null, |Hit { prim, t, u, v }| json!({ "prim": prim, "t": bits(t), "u": bits(u), "v": bits(v) }))
}

fn number(text: &str) -> u64 {
    u64::from_str_radix(text, 16).unwrap()
}

fn hex(word: impl std::fmt::LowerHex) -> Value {
    Value::String(format!("{word:x}"))
}

fn result<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Answer {
    let fields: BTreeMap<_, _> = fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    Answer::Result(fields.into_iter().collect())
}

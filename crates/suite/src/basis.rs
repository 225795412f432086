//! Dependencies between profiles: a mistake shows earlier in a more basic profile.

/// Profiles with the more basic ones. If both fail, the mistake is most often in the more basic one.
const BASES: [(&str, &[&str]); 25] = [
    ("hash/lookup", &["hash/function", "hash/address"]),
    ("hash/build", &["hash/function", "hash/keys", "hash/lookup"]),
    ("hash/build-deep", &["hash/fold", "hash/build"]),
    ("hash/keys", &["key/u32"]),
    ("trace/script", &["key/u32"]),
    ("trace/complete", &["key/u32"]),
    ("trace/tape", &["trace/script"]),
    ("trace/node-left", &["key/u32"]),
    ("trace/node-sign", &["trace/node-left"]),
    ("trace/disjoint", &["trace/tape"]),
    ("trace/distance", &["trace/tape"]),
    ("trace/invalid", &["trace/script"]),
    ("trace/wide-invalid", &["trace/wide"]),
    ("resume/state", &["trace/script"]),
    ("resume/key-only", &["resume/state"]),
    ("resume/disjoint", &["trace/disjoint"]),
    ("resume/invalid", &["resume/state"]),
    ("resume/wide", &["trace/wide"]),
    ("ray/exact", &["ray/grid"]),
    ("ray/watertight", &["ray/ulp-256"]),
    ("ray/parity", &["ray/watertight"]),
    ("ray/ulp-8", &["ray/ulp-256"]),
    ("ray/invalid", &["ray/grid"]),
    ("hash/wide", &["trace/wide"]),
    ("hash/wide-deep", &["hash/wide"]),
];

/// Returns the more basic profiles, the most basic first.
pub(crate) fn bases(profile: &str) -> Vec<&'static str> {
    let mut found = Vec::new();
    for base in BASES.iter().find(|(name, _)| *name == profile).into_iter().flat_map(|(_, bases)| *bases) {
        for name in bases(base).into_iter().chain([*base]) {
            if !found.contains(&name) {
                found.push(name);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::author::names;

    #[test]
    fn bases_are_profiles_and_come_first() {
        let names = names();
        for (profile, below) in BASES {
            assert!(names.iter().any(|name| name == profile), "{profile}");
            assert!(below.iter().all(|base| names.iter().any(|name| name == base)), "{profile}");
            assert!(!bases(profile).contains(&profile), "{profile}");
        }
        assert_eq!(bases("hash/lookup"), ["hash/function", "hash/address"]);
        assert_eq!(bases("resume/disjoint"), ["key/u32", "trace/script", "trace/tape", "trace/disjoint"]);
        assert_eq!(bases("key/u32"), [""; 0]);
    }
}

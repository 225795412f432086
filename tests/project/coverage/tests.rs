//! Tests of the judge of coverage, on a small specification.

use super::{Cover, Kind, citations, cited, clauses, judge};

#[test]
fn what_is_not_covered_is_seen() {
    let text = "**[A-1] One.** *Definition.* x\n\n**[A-2] Two.** *Rule.*\n**[A-3] Three.** *Theorem.*\n\
        **[A-4] Four.** *Theorem in part.* x\n\n- *By\nhand:* y\n**[A-5] Five.** *Argument.*\n";
    let spec = clauses(text);
    assert_eq!(spec.iter().map(|clause| clause.kind).collect::<Vec<_>>(), Kind::ALL.map(|(kind, _)| Some(kind)));
    let cite = |file: &str, text: &str, cover| citations(file, text, cover);
    let fine = [
        cite("a.rs", "/// x `[A-1]` and [A-2]\nfn f() {}", Cover::Source),
        cite("t.rs", "/// [A-2] [A-4] [A-5]\n#[test]\nfn holds() {}", Cover::Test),
        cite("b.v", "(** [A-3, A-4] *)\nTheorem three : True.", Cover::Rocq),
    ]
    .concat();
    let (wrong, text) = judge(&spec, &fine);
    assert_eq!(wrong, [""; 0]);
    assert!(text.contains("A-3 Three (Theorem)\n    rocq    b.v: three\n"), "{text}");
    assert!(text.contains("    source  a.rs\n    test    t.rs: holds\n"), "{text}");
    for missing in 0..fine.len() {
        let rest: Vec<_> = fine.iter().enumerate().filter(|&(i, _)| i != missing).map(|(_, x)| x.clone()).collect();
        assert_eq!(judge(&spec, &rest).0.len(), 1, "{:?} is not missed", fine[missing]);
    }
    let by = |text, cover| cite("p", text, cover).remove(0).by;
    assert_eq!(by("    lemma::<N>(\n  \"one step\",\n  \"[A-3] [A-1]\",", Cover::Smt), "p: one step");
    assert_eq!(by("lemma(\"step\", \"[A-3]\", step)", Cover::Smt), "p: step");
    assert_eq!(
        by("    /// Says `[A-3]`\n    /// more.\n    step_u32, step_u32_twin, 2 => step;", Cover::Harness),
        "p: step_u32"
    );
    let stray = cite("a.rs", "[A-9]", Cover::Source);
    assert_eq!(judge(&spec, &[fine.clone(), stray].concat()).0, ["a.rs cites A-9, which is not in the specification"]);
    assert_eq!(judge(&clauses("**[A-1] One.** *Definition.*\n**[A-1] One.** x"), &fine[..1]).0.len(), 2);
    let ids: Vec<_> = cited("[KEY-1] [a-1] [A] [A-b] [x, B-2][T-22, U-3](1, 3)").collect();
    assert_eq!(ids, [("KEY-1", vec![]), ("T-22", vec![1, 3]), ("U-3", vec![1, 3])]);
}

#[test]
fn a_lemma_that_states_less_than_its_clause_is_seen() {
    let judged = |clause: &str, lemmas: &[&str]| {
        let lemmas = lemmas.iter().flat_map(|text| citations("b.v", &format!("{text}\nLemma l."), Cover::Rocq));
        let test = citations("t.rs", "[A-1]", Cover::Test);
        judge(&clauses(clause), &lemmas.chain(test).collect::<Vec<_>>()).0
    };
    let two = "**[A-1] One.** *Theorem.* Let x be 1. (A remark. No\nmore.) Then x² is, by\nRef. 2, 1.\n\n- A reason. Another.\n";
    let missing = |number| format!("A-1 is a theorem, and no lemma states its sentence {number}");
    assert_eq!(judged(two, &["[A-1](1)", "[A-1](2)"]), [""; 0]);
    assert_eq!(judged(two, &["[A-1](2)"]), [missing(1)]);
    assert_eq!(judged(two, &["[A-1]"]), [missing(1), missing(2)]);
    assert_eq!(judged(two, &["[A-1](1, 2, 3)"]), ["b.v: l states a sentence that A-1 does not have"]);
    let one = |kind: &str, more: &str| judged(&format!("**[A-1] One.** *{kind}.* x.\n\n{more}"), &["[A-1]"]);
    assert_eq!(one("Theorem", ""), [""; 0]);
    assert_eq!(one("Theorem", "*By hand:* y."), ["A-1 is a theorem, and has a part by hand"]);
    assert_eq!(one("Theorem in part", "*By hand:* y."), [""; 0]);
    assert_eq!(one("Theorem in part", ""), ["A-1 is a theorem in part, and says of no part that it is by hand"]);
    assert_eq!(one("Argument", ""), ["A-1 is an argument, and b.v: l states a part"]);
}

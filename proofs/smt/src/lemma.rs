//! Lemmas, their proofs, and the controls that show that each can fail.

use std::fmt;
use std::time::Instant;

use z3::ast::{BV, Bool, Dynamic, Int};
use z3::{Model, Params, SatResult, Solver, Tactic};

use crate::word::{Symbolic, take_required};

/// The solver's limit for one claim, in its own steps, so machine load does not affect the proofs.
const LIMIT: u32 = 100_000_000;

/// The claim about operations. A separate test checks that they record their requirements.
const REQUIRED: &str = "no shift or count out of range, no overflow";

/// A lemma: a claim about the library's formulas, and about formulas with a slip.
pub(crate) struct Lemma {
    /// A short description.
    pub(crate) name: &'static str,
    /// Clauses of the specification that it covers.
    pub(crate) clauses: &'static str,
    /// Bits of a word.
    pub(crate) width: u32,
    /// The slip of the control.
    pub(crate) slip: &'static str,
    /// The lemma about the library's formulas.
    pub(crate) library: Query,
    /// The lemma about the formulas with the slip.
    pub(crate) control: Query,
    /// The lemma with other slips, computed on demand. Together they break each of its claims.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests ask for it"))]
    pub(crate) others: Box<dyn Fn() -> Vec<Query>>,
}

/// Unknowns, assumptions and claims.
#[derive(Default)]
pub(crate) struct Query {
    inputs: Vec<(&'static str, Dynamic)>,
    given: Vec<Bool>,
    claims: Vec<(&'static str, Bool)>,
    /// Claims that are steps of a proof, and not about the library.
    steps: Vec<&'static str>,
    /// Whether proved claims are assumed in later ones.
    chained: bool,
    /// Whether it is about integers.
    integers: bool,
}

impl Query {
    /// Adds an unknown word.
    pub(crate) fn word<const N: u32>(&mut self, name: &'static str) -> Symbolic<N> {
        Symbolic(self.bits(name, N))
    }

    /// Adds unknown bits.
    pub(crate) fn bits(&mut self, name: &'static str, width: u32) -> BV {
        let bits = BV::new_const(name, width);
        self.inputs.push((name, Dynamic::from_ast(&bits)));
        bits
    }

    /// Adds an unknown integer.
    pub(crate) fn integer(&mut self, name: &'static str) -> Int {
        let integer = Int::new_const(name);
        self.integers = true;
        self.inputs.push((name, Dynamic::from_ast(&integer)));
        integer
    }

    /// Adds an unknown bit: 0 or 1.
    pub(crate) fn bit<const N: u32>(&mut self, name: &'static str) -> Symbolic<N> {
        let bit = self.word(name);
        self.assume(bit.less(&Symbolic::number(2)));
        bit
    }

    /// Adds an assumption.
    pub(crate) fn assume(&mut self, condition: Bool) {
        self.given.push(condition);
    }

    /// Adds a claim, together with the requirements of all operations so far.
    pub(crate) fn claim(&mut self, says: &'static str, claim: Bool) {
        self.claims.push((says, claim));
        let required = take_required().into_iter();
        self.claims.extend(required.map(|required| (REQUIRED, required)));
    }

    /// Adds a claim that later claims use, independent of the library.
    pub(crate) fn step(&mut self, says: &'static str, claim: Bool) {
        self.steps.push(says);
        self.claim(says, claim);
    }

    /// Makes each claim available in the proofs of later ones.
    pub(crate) fn chain(&mut self) {
        self.chained = true;
    }

    /// Returns whether all claims hold.
    #[cfg(test)]
    pub(crate) fn is_proved(&self) -> bool {
        matches!(self.prove(), Proof::Proved)
    }

    fn prove(&self) -> Proof {
        let mut given = self.given.clone();
        for (says, claim) in &self.claims {
            let solver = self.without(&given, claim);
            match solver.check() {
                SatResult::Unsat if self.chained => given.push(claim.clone()),
                SatResult::Unsat => {}
                SatResult::Unknown => return Proof::Unknown(says, solver.get_reason_unknown().unwrap_or_default()),
                SatResult::Sat => return Proof::Refuted(says, self.example(solver.get_model())),
            }
        }
        if self.claims.is_empty() { Proof::Unknown("nothing", "it claims nothing".into()) } else { Proof::Proved }
    }

    /// Returns a solver that searches for a counterexample to the claim under these assumptions.
    fn without(&self, given: &[Bool], claim: &Bool) -> Solver {
        let solver = self.solver();
        let mut params = Params::new();
        params.set_u32("rlimit", LIMIT);
        solver.set_params(&params);
        for given in given {
            solver.assert(given);
        }
        solver.assert(claim.not());
        solver
    }

    /// Returns whether this claim can be broken, if it differs from the library's.
    #[cfg(test)]
    fn breaks(&self, says: &str, library: &Self) -> bool {
        let own = self.claims.iter().filter(|(own, _)| *own == says);
        let mut others = own.filter(|claim| !library.claims.contains(claim));
        others.any(|(_, claim)| self.without(&self.given, claim).check() == SatResult::Sat)
    }

    /// Returns a solver with bit-blasting, which takes half the time of the default strategy for 128 bits.
    fn solver(&self) -> Solver {
        if self.integers {
            return Solver::new();
        }
        let tactics = ["simplify", "solve-eqs", "bit-blast", "sat"].map(Tactic::new);
        let [first, rest @ ..] = tactics;
        rest.iter().fold(first, |all, next| all.and_then(next)).solver()
    }

    /// Formats the inputs of a counterexample.
    fn example(&self, model: Option<Model>) -> String {
        let value = |input: &Dynamic| model.as_ref().and_then(|model| model.eval(input, true)).map(|v| v.to_string());
        let inputs = self.inputs.iter().map(|(name, input)| {
            let value = value(input).unwrap_or_else(|| "?".into());
            format!("{name} = {}", shorten(&value))
        });
        let inputs = inputs.collect::<Vec<_>>();
        if inputs.is_empty() { "no inputs".into() } else { inputs.join(", ") }
    }
}

/// `#x0000002a` as `0x2a`.
fn shorten(value: &str) -> String {
    match value.strip_prefix("#x") {
        Some(digits) => match digits.trim_start_matches('0') {
            "" => "0".into(),
            digits => format!("0x{digits}"),
        },
        None => value.strip_prefix("#b").unwrap_or(value).into(),
    }
}

enum Proof {
    Proved,
    Refuted(&'static str, String),
    Unknown(&'static str, String),
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proved => f.write_str("proved"),
            Self::Refuted(says, inputs) => write!(f, "REFUTED: not \"{says}\" for {inputs}"),
            Self::Unknown(says, reason) => write!(f, "UNKNOWN: \"{says}\": {reason}"),
        }
    }
}

impl Lemma {
    /// Returns the claims that no slip breaks. There must be none.
    #[cfg(test)]
    pub(crate) fn unbroken(&self) -> Vec<&'static str> {
        let steps = &self.library.steps;
        let mut claims: Vec<_> = self.library.claims.iter().map(|(says, _)| *says).collect();
        claims.dedup();
        claims.retain(|says| *says != REQUIRED && !steps.contains(says));
        let others = (self.others)();
        let slips = || [&self.control].into_iter().chain(&others);
        claims.retain(|says| !slips().any(|slip| slip.breaks(says, &self.library)));
        claims
    }

    /// Proves the lemma, refutes its control, and prints a row. Returns whether both succeeded.
    pub(crate) fn check(&self) -> bool {
        let start = Instant::now();
        let proof = self.library.prove();
        let seconds = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let control = self.control.prove();
        let control_seconds = start.elapsed().as_secs_f64();
        let Self { name, clauses, width, slip, .. } = self;
        let control_text = match &control {
            Proof::Refuted(says, inputs) => format!("refuted: \"{says}\" for {inputs}"),
            Proof::Proved => "NOT REFUTED".into(),
            Proof::Unknown(..) => control.to_string(),
        };
        let cells = [
            (*name).to_owned(),
            (*clauses).to_owned(),
            width.to_string(),
            proof.to_string(),
            format!("{seconds:.2}"),
            format!("{slip}: {control_text}"),
            format!("{control_seconds:.2}"),
        ];
        println!("| {} |", cells.map(|cell| cell.replace('|', "\\|")).join(" | "));
        matches!(proof, Proof::Proved) && matches!(control, Proof::Refuted(..))
    }
}

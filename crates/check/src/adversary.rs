//! Adversaries: cases that cost a method as much as can be found.
//!
//! A [`Goal`] is a small function from a case to a [`Cost`]. A [`Search`] climbs: it starts at the worst of some random
//! cases, changes a few choices at a time, keeps what is not better, and starts anew where nothing gets worse for long.
//! The same seed gives the same steps on every machine. What it finds is a file that `stackless adversary GOAL --replay
//! FILE` runs again; those of trees are [`Replay`]s, for `stackless check --replay` too.
//!
//! ```
//! use stackless_check::adversary::{Goal, Search};
//!
//! let goal = Goal::named("restarts-laine-0").ok_or("no such goal")?;
//! let mut search = Search::new(goal, 1);
//! while search.steps() < 300 {
//!     search.step();
//! }
//! let worst = search.worst().ok_or("nothing found")?;
//! assert!(worst.cost.ratio() > search.random_average());
//! worst.subject.verify()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod boxes;
mod climb;
mod cost;
mod goals;
mod kernels;
mod rays;
mod trees;

pub use climb::{Search, Worst};
pub use cost::Cost;
pub use goals::GOALS;
pub use rays::RayCase;
pub use trees::change;

use std::fmt;

use super::{Case, Fault, Plan, Replay, ReplayError, Stress, Tally};
use crate::{CaseOptions, Errors};
use stackless_bvh::bvh::BuildError;
use stackless_bvh::generate::draw::Draw;
use stackless_bvh::generate::{Rng, Source as _, stress};
use stackless_bvh::geom::{MeshError, RayError};
use stackless_bvh::trace::{KernelName, SlabsName};
use stackless_bvh::traverse::{Method, Unfit, WordName};

/// What a search makes as great as it can.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// The name on the command line.
    pub name: &'static str,
    /// What is counted, and out of what.
    pub about: &'static str,
    of: Of,
}

/// What a cost is of. Without a cost, a case is not what the goal is about.
#[derive(Clone, Copy, Debug)]
enum Of {
    Tree(fn(&Case) -> Option<Cost>),
    Rays { triangles: usize, rays: usize, cost: fn(&stress::StressCase) -> Option<Cost> },
}

/// What is searched.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// A tree with a tape.
    Tree(Case),
    /// Triangles and rays.
    Rays(RayCase),
}

/// Why a text is not a case, or a case shows that something is wrong.
#[derive(Debug, thiserror::Error)]
pub enum AdversaryError {
    /// The text is not such a case. (The message names line and column.)
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// It is not a tree with a tape.
    #[error("{0}")]
    Replay(#[from] ReplayError),
    /// The triangles are not a mesh.
    #[error("triangles: {0}")]
    Mesh(#[from] MeshError),
    /// A triangle has no area.
    #[error("triangle {triangle} is degenerate")]
    Degenerate {
        /// Its index.
        triangle: usize,
    },
    /// Numbers are not a ray.
    #[error("ray {ray}: {error}")]
    Ray {
        /// Its index.
        ray: usize,
        /// What is wrong.
        error: RayError,
    },
    /// There is no tree over the triangles.
    #[error("{0}")]
    Build(#[from] BuildError),
    /// A traversal differs from its oracle.
    #[error("{method} {word}: {fault}")]
    Differs {
        /// The traversal.
        method: Method,
        /// Its word.
        word: WordName,
        /// The first difference.
        fault: Fault,
    },
    /// A traversal does not run.
    #[error("{0}")]
    Unfit(#[from] Unfit),
    /// An exact triangle test errs.
    #[error("{kernel}: {errors:?}")]
    Inexact {
        /// The test.
        kernel: KernelName,
        /// How often.
        errors: Errors,
    },
}

impl Goal {
    /// The goal of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        GOALS.iter().find(|goal| goal.name == name)
    }

    /// What a case costs. `None` if it is not what the goal is about: of the other kind, not a scene, without a hit
    /// where one is needed.
    pub fn cost(&self, subject: &Subject) -> Option<Cost> {
        match (self.of, subject) {
            (Of::Tree(cost), Subject::Tree(case)) => cost(case),
            (Of::Rays { cost, .. }, Subject::Rays(case)) => cost(&case.scene(self.name).ok()?),
            _ => None,
        }
    }

    /// The file's text for a case of this goal, on one line.
    ///
    /// # Errors
    /// None that a case can cause.
    pub fn write(&self, subject: &Subject, cost: Cost) -> Result<String, AdversaryError> {
        let found = Some(format!("{}: {cost}", self.name));
        Ok(match subject {
            Subject::Tree(case) => trees::write(case, found)?,
            Subject::Rays(case) => serde_json::to_string(&RayCase { found, ..case.clone() })?,
        })
    }

    /// The case in a file's text, and what is said of its cost.
    ///
    /// # Errors
    /// [`AdversaryError`], for what is not such a case.
    pub fn read(&self, text: &str) -> Result<(Subject, Option<String>), AdversaryError> {
        match self.of {
            Of::Tree(_) => {
                let replay: Replay = serde_json::from_str(text)?;
                Ok((Subject::Tree(replay.case()?), replay.fault))
            }
            Of::Rays { .. } => {
                let mut case: RayCase = serde_json::from_str(text)?;
                case.scene(self.name)?;
                let found = case.found.take();
                Ok((Subject::Rays(case), found))
            }
        }
    }

    /// The goal for which the case in a file's text was found, if the text says so.
    pub fn of(text: &str) -> Option<&'static Self> {
        let value: serde_json::Value = serde_json::from_str(text).ok()?;
        let said = value.get("found").or_else(|| value.get("fault"))?.as_str()?;
        Self::named(said.split(':').next()?)
    }

    /// A random case.
    fn draw(&self, rng: &mut Rng) -> Subject {
        match self.of {
            Of::Tree(_) => Subject::Tree(trees::draw(rng)),
            Of::Rays { triangles, rays, .. } => {
                Subject::Rays(RayCase::draw(&mut Draw::new(rng.bits()), triangles, rays))
            }
        }
    }
}

impl Subject {
    /// A case near to this one, if the changes that were drawn make one.
    fn change(&self, rng: &mut Rng) -> Option<Self> {
        Some(match self {
            Self::Tree(case) => Self::Tree(trees::change(case, rng)?),
            Self::Rays(case) => Self::Rays(case.change(&mut Draw::new(rng.bits()))?),
        })
    }

    /// Runs all traversals: on a tree in all words against the oracle, on rays with the exact tests against rational
    /// arithmetic.
    ///
    /// # Errors
    /// [`AdversaryError`], the first thing that is wrong.
    pub fn verify(&self) -> Result<(), AdversaryError> {
        match self {
            Self::Tree(case) => {
                let (methods, words) = (Method::ALL.to_vec(), WordName::ALL.to_vec());
                let plan = Plan { trees: 0, seed: 0, options: CaseOptions::default(), methods, words };
                match plan.check_case(case, &mut Tally::default()) {
                    None => Ok(()),
                    Some(found) => {
                        let (method, word, fault) = (found.method, found.word, found.fault);
                        Err(AdversaryError::Differs { method, word, fault })
                    }
                }
            }
            Self::Rays(case) => {
                let scene = case.scene("adversary")?;
                let stress = Stress::new(&scene)?;
                for kernel in [KernelName::Exact, KernelName::ExactFromSingle] {
                    let errors = stress.run((kernel, SlabsName::Directed), &Method::ALL)?;
                    if !errors.is_none() {
                        return Err(AdversaryError::Inexact { kernel, errors });
                    }
                }
                Ok(())
            }
        }
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name)
    }
}

/// A number below `n`, which is at least 1.
fn below(rng: &mut Rng, n: usize) -> usize {
    rng.below(n as u64) as usize
}

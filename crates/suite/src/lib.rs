//! The conformance suite: cases that tell any implementation, in any language, where it is wrong.
//!
//! [`author`] makes the cases, with expectations from references that share nothing with the traversals. `spec/suite`
//! holds them as files, with the text that says what they mean. A [`Runner`] asks a program the cases, one JSON line
//! each, and judges what it answers ([`judge()`]); [`serve`] is the other side of the line, and [`Library`] what this
//! library answers.

#![forbid(unsafe_code)]

mod ask;
pub mod author;
mod basis;
mod bits;
mod case;
mod files;
mod judge;
mod own;
mod process;
mod protocol;
mod report;
mod runner;
mod scripted;
mod shipped;
mod text;
mod waivers;
mod walk;
mod withdrawn;

pub use ask::{Ask, Best, Build, Children, LookupTable, Query, Rays, Start, Walk, WideChildren, WideWalk};
pub use case::{Expect, Feature, Level, Near, NearHit, Profile, Strength, Suite, SuiteCase, VERSION};
pub use files::SuiteError;
pub use judge::{Flaw, judge};
pub use own::text::hex;
pub use own::{Library, RayScene, RaysError, Traversal};
pub use protocol::{Answer, Hello, Implementation, Limits, PROTOCOL, Reply, WideLimits, serve};
pub use report::{CaseResult, Outcome, Report};
pub use runner::{RunError, Runner};
pub use scripted::{ScriptedSearch, wide_events};
pub use waivers::{Waiver, WaiverError, Waivers};
pub use walk::WalkError;
pub use withdrawn::Withdrawn;

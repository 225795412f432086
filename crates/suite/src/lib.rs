//! The conformance suite: language-neutral cases that locate the errors of an implementation.
//!
//! [`author`] generates the cases, with expectations from references that share no code with the traversals.
//! `spec/suite` has them as files, with a text that defines their meaning. A [`Runner`] sends the cases to a program,
//! one JSON line each, and checks its answers ([`judge()`]). [`serve`] implements the other side of the protocol.
//! [`Library`] answers with this library.

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
pub use text::parse_json;
pub use waivers::{Waiver, WaiverError, Waivers};
pub use walk::WalkError;
pub use withdrawn::Withdrawn;

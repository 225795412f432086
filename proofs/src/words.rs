//! x
use crate::harness::harnesses;
harnesses! {}

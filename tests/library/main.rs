//! What the library promises, tested from outside.

mod bites;
mod bounds;
mod departures;
mod depth;
mod disjoint;
mod double;
mod environment;
mod exact;
mod examples;
mod exhaustive;
mod hash;
mod instances;
mod kernels;
mod nearest;
mod oracle;
mod pause;
mod random;
mod reach;
mod refit;
mod regressions;
mod rocq_vectors;
mod secondary;
mod slabs;
mod state;
mod usage;
mod wide;

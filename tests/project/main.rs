//! Habits of the repository that a script can check: imports of modules, coverage of clauses, citations.

mod architecture;
mod bibliography;
mod coverage;
mod data;
mod files;
mod pointers;
mod readme;

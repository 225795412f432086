//! The habits of the repository that a script can see: which module imports which, what covers a clause, what is cited.

mod architecture;
mod bibliography;
mod coverage;
mod data;
mod files;
mod pointers;
mod readme;

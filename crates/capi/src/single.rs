//! C functions for scenes in single precision, in the order of the header.

pub mod scenes;

pub mod rays;

pub mod points;

pub mod exact;

pub mod instances;

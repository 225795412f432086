//! Lookup by name, for command line, files and tables.

use core::fmt;

/// A name that matches none of the alternatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownName;

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("unknown name")
    }
}

impl core::error::Error for UnknownName {}

/// Printing and parsing by name, for a type with `ALL` and `name`.
#[macro_export]
#[doc(hidden)]
macro_rules! named {
    ($type:ty) => {
        impl core::fmt::Display for $type {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.pad(self.name())
            }
        }

        impl core::str::FromStr for $type {
            type Err = $crate::name::UnknownName;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                Self::ALL.into_iter().find(|it| it.name() == name).ok_or($crate::name::UnknownName)
            }
        }
    };
}
#[doc(hidden)]
pub use crate::named;

//! Errors: a code for the program, and a message that names the element.

use std::fmt;

use stackless_bvh::bvh::{BuildError, RefitError, WideError};
use stackless_bvh::geom::{AffineError, BallError, EnvironmentError, MeshError, RayError};
use stackless_bvh::trace::{AssemblyError, SolidError};
use stackless_scene::SavedError;

/// The result of a function. After any code except `STACKLESS_ERROR_NONE`, `stackless_error_message` gives details, and
/// the outputs of the function are unspecified.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// Success.
    None = 0,
    /// A pointer is null or misaligned, or a number is out of range.
    InvalidArgument = 1,
    /// There is not enough memory, or no thread could be started.
    OutOfMemory = 2,
    /// A thread violates IEEE 754: it flushes subnormal numbers, or does not round to nearest.
    FloatEnvironment = 3,
    /// A file cannot be read or written.
    File = 4,
    /// Bytes are not a saved scene of this precision.
    InvalidData = 5,
    /// The mesh is open or not oriented, and the function or the rule needs a closed or an oriented mesh.
    UnsuitableMesh = 6,
    /// A bug in this library. Destroy the scene.
    Internal = 7,
}

/// The name of an argument, and optionally the index of an element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    pub(crate) name: &'static str,
    pub(crate) index: Option<usize>,
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        self.index.map_or(Ok(()), |index| write!(f, "[{index}]"))
    }
}

/// An error with its message.
#[derive(Debug)]
pub(crate) struct Fault {
    pub(crate) error: Error,
    pub(crate) message: String,
}

impl Fault {
    pub(crate) fn new(error: Error, message: impl ToString) -> Self {
        Self { error, message: message.to_string() }
    }

    pub(crate) fn argument(message: impl ToString) -> Self {
        Self::new(Error::InvalidArgument, message)
    }

    pub(crate) fn memory(bytes: usize) -> Self {
        Self::new(Error::OutOfMemory, format!("no memory for {bytes} bytes"))
    }

    /// Returns the fault of a part of an element.
    pub(crate) fn within(self, element: Element) -> Self {
        Self { message: format!("{element}.{}", self.message), ..self }
    }

    pub(crate) fn of_affine(error: AffineError, map: Element) -> Self {
        match error {
            AffineError::Environment(error) => error.into(),
            error => Self::argument(format!("{map}: {error}")),
        }
    }

    pub(crate) fn of_ray(error: RayError, ray: Element) -> Self {
        Self::argument(match error {
            RayError::Origin(origin) => format!("{ray}.origin: {origin}, expected finite numbers"),
            RayError::Direction(direction) => format!("{ray}.direction: {direction}, expected finite numbers"),
            RayError::ZeroDirection => format!("{ray}.direction: [0, 0, 0], expected a number other than 0"),
            RayError::NegativeTmin(tmin) => format!("{ray}.tmin: {tmin}, expected at least 0"),
            RayError::Interval { tmin, tmax } => {
                format!("{ray}: tmin {tmin}, tmax {tmax}, expected a finite tmin and a tmax that is not NaN")
            }
            RayError::EmptyInterval { tmin, tmax } => format!("{ray}.tmax: {tmax}, expected at least tmin, {tmin}"),
            RayError::Environment(error) => return error.into(),
        })
    }

    pub(crate) fn of_point(error: RayError, point: Element) -> Self {
        match error {
            RayError::Origin(found) => Self::argument(format!("{point}: {found}, expected finite numbers")),
            error => Self::of_ray(error, point),
        }
    }

    pub(crate) fn of_ball(error: BallError, point: Element) -> Self {
        Self::argument(match error {
            BallError::Center(found) => format!("{point}: {found}, expected finite numbers"),
            BallError::Radius(radius) => format!("radius: {radius}, expected at least 0"),
            BallError::Environment(error) => return error.into(),
        })
    }
}

impl From<EnvironmentError> for Fault {
    fn from(error: EnvironmentError) -> Self {
        Self::new(Error::FloatEnvironment, error)
    }
}

impl From<MeshError> for Fault {
    fn from(error: MeshError) -> Self {
        Self::argument(match error {
            MeshError::Empty => "face_count: 0, expected at least 1".to_owned(),
            MeshError::NonFinite { vertex, position } => {
                format!("vertices[{vertex}]: {position}, expected finite numbers")
            }
            MeshError::Index { triangle, index, vertices } => {
                format!("faces[{triangle}]: index {index}, expected less than vertex_count, {vertices}")
            }
            MeshError::Environment(error) => return error.into(),
            error @ MeshError::TooMany { .. } => error.to_string(),
        })
    }
}

impl From<WideError> for Fault {
    fn from(error: WideError) -> Self {
        match error {
            WideError::Build(BuildError::Memory(bytes)) => Self::memory(bytes),
            WideError::Build(BuildError::Environment(error)) | WideError::Environment(error) => error.into(),
            error => Self::argument(error),
        }
    }
}

impl From<AssemblyError> for Fault {
    fn from(error: AssemblyError) -> Self {
        match error {
            AssemblyError::OutOfRange { instance } => {
                Self::argument(format!("transforms[{instance}]: the image of its object leaves the range of floats"))
            }
            AssemblyError::Build(BuildError::Empty) => Self::argument("count: 0, expected at least 1"),
            AssemblyError::Build(error) => WideError::Build(error).into(),
            error => Self::argument(error),
        }
    }
}

impl From<RefitError> for Fault {
    fn from(error: RefitError) -> Self {
        match error {
            RefitError::Environment(error) => error.into(),
            error => Self::new(Error::UnsuitableMesh, error),
        }
    }
}

impl From<SolidError> for Fault {
    fn from(error: SolidError) -> Self {
        Self::new(Error::UnsuitableMesh, error)
    }
}

impl From<SavedError> for Fault {
    fn from(error: SavedError) -> Self {
        match error {
            SavedError::Mesh(MeshError::Environment(error)) => error.into(),
            error => Self::new(Error::InvalidData, error),
        }
    }
}

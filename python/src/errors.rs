//! Errors of the library as exceptions: `ValueError` for invalid arguments, `RuntimeError` for other errors.

use std::io::{self, ErrorKind};
use std::path::Path;

use glam::DVec3;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use stackless_bvh::bvh::RefitError;
use stackless_bvh::geom::{BallError, MeshError, RayError};

/// An error for an invalid argument.
pub(crate) fn refused(message: impl ToString) -> PyErr {
    PyValueError::new_err(message.to_string())
}

/// An error that no argument causes.
pub(crate) fn failed(message: impl ToString) -> PyErr {
    PyRuntimeError::new_err(message.to_string())
}

/// An error of the file system, like an error of `open`: with the exception type of its number, and the path.
pub(crate) fn of_file(error: io::Error, path: &Path) -> PyErr {
    let number = error.raw_os_error().or(match error.kind() {
        ErrorKind::PermissionDenied => Some(13),
        ErrorKind::IsADirectory => Some(21),
        _ => None,
    });
    match number {
        Some(number) => {
            let message = error.to_string();
            // Python adds the number.
            let message = message.split(" (os error").next().unwrap_or_default().to_owned();
            PyOSError::new_err((number, message, path.as_os_str().to_owned()))
        }
        None => PyOSError::new_err(format!("{}: {error}", path.display())),
    }
}

/// An error for an invalid mesh, with the row.
pub(crate) fn of_mesh(error: MeshError) -> PyErr {
    refused(match error {
        MeshError::Empty => "faces: no rows, expected at least one".into(),
        MeshError::NonFinite { vertex, position } => {
            format!("vertices[{vertex}]: {}, expected finite numbers", listed(position))
        }
        // Indices are checked earlier.
        MeshError::Index { .. } | MeshError::TooMany { .. } => error.to_string(),
        MeshError::Environment(_) => return failed(error),
    })
}

/// The message for an index without a vertex.
pub(crate) fn index_message(face: usize, index: i64, corner: usize, vertices: usize) -> String {
    let expected = if index < 0 { ">= 0".into() } else { format!("< {vertices}") };
    format!("faces[{face}]: index {index} of vertex {corner}, expected {expected}")
}

/// An error for an invalid ray, with the row.
pub(crate) fn of_ray(error: RayError, row: usize) -> PyErr {
    refused(match error {
        RayError::Origin(origin) => format!("origins[{row}]: {}, expected finite numbers", listed(origin)),
        RayError::Direction(direction) => format!("directions[{row}]: {}, expected finite numbers", listed(direction)),
        RayError::ZeroDirection => format!("directions[{row}]: [0, 0, 0], expected a direction"),
        RayError::NegativeTmin(tmin) => format!("tmin[{row}]: {tmin}, expected >= 0"),
        RayError::Interval { tmin, tmax } | RayError::EmptyInterval { tmin, tmax } => format!(
            "tmin[{row}] and tmax[{row}]: {tmin} and {tmax}, expected a finite tmin, and a tmax that is not less"
        ),
        RayError::Environment(_) => return failed(error),
    })
}

/// An error for an invalid ball, with the row.
pub(crate) fn of_ball(error: BallError, row: usize) -> PyErr {
    refused(match error {
        BallError::Center(point) => format!("points[{row}]: {}, expected finite numbers", listed(point)),
        BallError::Radius(radius) => format!("radius[{row}]: {radius}, expected >= 0"),
        BallError::Environment(_) => return failed(error),
    })
}

/// An error for a mesh that does not fit a hierarchy.
pub(crate) fn of_refit(error: RefitError) -> PyErr {
    match error {
        RefitError::Revived(face) => refused(format!(
            "faces[{face}]: no area when the scene was built, and some now; build a new Scene for these vertices"
        )),
        RefitError::Environment(_) => failed(error),
        RefitError::Count { .. } | RefitError::NoBox(_) => refused(error),
    }
}

/// Formats a point like a Python list.
pub(crate) fn listed(DVec3 { x, y, z }: DVec3) -> String {
    format!("[{x}, {y}, {z}]")
}

//! Errors of devices, and exit codes.

use std::time::Duration;

use stackless_bvh::geom::EnvironmentError;

/// Errors of running on a device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// There is no device, or no requested one.
    #[error("unsupported: {0}")]
    NoAdapter(String),
    /// A requirement exceeds a limit of the device.
    #[error("unsupported: {what} needs {needed}, and the device has {limit}")]
    Limit {
        /// The purpose.
        what: String,
        /// The required amount.
        needed: u64,
        /// The device's limit.
        limit: u64,
    },
    /// A device lacks a feature.
    #[error("unsupported: the device has no {0}")]
    Feature(&'static str),
    /// The device refused something: a shader, a buffer (no memory), a submission.
    #[error("{what}: {message}")]
    Refused {
        /// The rejected object.
        what: String,
        /// The device's message.
        message: String,
    },
    /// The device was lost: it was reset, unplugged, or the driver gave up.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The device did not answer within the time limit.
    #[error("the device did not finish within {} s", .0.as_secs_f32())]
    Timeout(Duration),
    /// Data that no kernel supports.
    #[error("{0}")]
    Data(String),
    /// The float modes of this machine's threads are unsuitable.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl GpuError {
    /// Returns the exit code: 3 if the device is insufficient, 2 for all other errors.
    pub const fn exit_code(&self) -> u8 {
        match self {
            Self::NoAdapter(_) | Self::Limit { .. } | Self::Feature(_) => 3,
            _ => 2,
        }
    }
}

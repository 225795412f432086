//! What can go wrong with a device, and what the program returns then.

use std::time::Duration;

use stackless_bvh::geom::EnvironmentError;

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// There is no device, or none that was asked for.
    #[error("unsupported: {0}")]
    NoAdapter(String),
    /// A device cannot do something that is needed.
    #[error("unsupported: {what} needs {needed}, and the device has {limit}")]
    Limit {
        /// What it is needed for.
        what: String,
        /// How much.
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
        /// What was asked for.
        what: String,
        /// What it says.
        message: String,
    },
    /// The device was lost: it was reset, unplugged, or the driver gave up.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The device did not answer in time.
    #[error("the device did not finish within {} s", .0.as_secs_f32())]
    Timeout(Duration),
    /// Data that no kernel can take.
    #[error("{0}")]
    Data(String),
    /// Floats of this machine's threads are of no use.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl GpuError {
    /// The exit code: 3 if the device cannot, 2 for all else.
    pub const fn exit_code(&self) -> u8 {
        match self {
            Self::NoAdapter(_) | Self::Limit { .. } | Self::Feature(_) => 3,
            _ => 2,
        }
    }
}

//! Selection of the device, and its error callbacks.

use std::sync::{Arc, Mutex, OnceLock};

use super::{Gpu, PATIENCE};
use crate::GpuError;

impl Gpu {
    /// Opens the first adapter whose name or backend contains `wanted`, ignoring case. Without a name, opens the
    /// fastest adapter.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] with a list of available adapters.
    pub fn open(wanted: Option<&str>) -> Result<Self, GpuError> {
        Self::open_within(wanted, |limits| limits)
    }

    /// Like [`open`](Self::open), with modified limits: a smaller device.
    ///
    /// # Errors
    /// The errors of [`open`](Self::open), also for limits that the adapter does not support.
    pub fn open_within(
        wanted: Option<&str>,
        limits: impl FnOnce(wgpu::Limits) -> wgpu::Limits,
    ) -> Result<Self, GpuError> {
        let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
        description.backends = wgpu::Backends::VULKAN;
        let instance = wgpu::Instance::new(description);
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        adapters.sort_by_key(|adapter| rank(adapter.get_info().device_type));
        let names: Vec<String> = adapters.iter().map(|adapter| name(&adapter.get_info())).collect();
        let wanted_lower = wanted.unwrap_or_default().to_lowercase();
        let at = names.iter().position(|name| name.to_lowercase().contains(&wanted_lower));
        let Some(at) = at else {
            let found = if names.is_empty() { "none is there".to_owned() } else { names.join("; ") };
            return Err(GpuError::NoAdapter(match wanted {
                Some(wanted) => format!("no Vulkan adapter named {wanted:?}: {found}"),
                None => format!("no Vulkan adapter: {found}"),
            }));
        };
        Self::with_adapter(&adapters[at], limits)
    }

    fn with_adapter(
        adapter: &wgpu::Adapter,
        limits: impl FnOnce(wgpu::Limits) -> wgpu::Limits,
    ) -> Result<Self, GpuError> {
        let features = adapter.features()
            & (wgpu::Features::TIMESTAMP_QUERY
                | wgpu::Features::SUBGROUP
                | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("gpu-check"),
            required_features: features,
            required_limits: limits(adapter.limits()),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| GpuError::NoAdapter(error.to_string()))?;
        let (lost, uncaptured) = (Arc::new(OnceLock::new()), Arc::new(Mutex::new(Vec::new())));
        let (on_loss, on_error) = (lost.clone(), uncaptured.clone());
        device.set_device_lost_callback(move |reason, message| {
            let _ = on_loss.set(format!("{reason:?}: {message}"));
        });
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut errors) = on_error.lock() {
                errors.push(error.to_string());
            }
        }));
        Ok(Self { device, queue, info: adapter.get_info(), lost, uncaptured, patience: PATIENCE })
    }
}

/// Hardware devices first.
const fn rank(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

pub(super) fn name(info: &wgpu::AdapterInfo) -> String {
    format!("{} ({:?}, {:?}, {} {})", info.name, info.device_type, info.backend, info.driver, info.driver_info)
}

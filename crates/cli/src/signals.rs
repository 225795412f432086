//! What a signal that ends the command leaves behind: nothing.

/// From now on Ctrl-C and the like end the command as ever, but no temporary file stays.
#[cfg(unix)]
pub(crate) fn watch() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // What whoever started us wants to be ignored (`nohup`, a shell's background) stays ignored.
    let ignored = ignored();
    let wanted = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored & (1 << (signal - 1)) == 0);
    // Where no handler can be set the signals act as they would without one.
    let Ok(mut signals) = Signals::new(wanted) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            stackless_scene::abandon_writes();
            let _ = emulate_default_handler(signal);
        }
    });
}

/// A bit for each signal that is ignored, as Linux tells; elsewhere none is known.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Elsewhere a temporary file may stay.
#[cfg(not(unix))]
pub(crate) fn watch() {}

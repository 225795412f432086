//! Removes temporary files when a signal ends the command.

/// Installs handlers: Ctrl-C and similar signals end the command as usual, without temporary files.
#[cfg(unix)]
pub(crate) fn watch() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // Signals that the parent process ignores (`nohup`, a shell's background job) stay ignored.
    let ignored = ignored();
    let wanted = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored & (1 << (signal - 1)) == 0);
    // Without handlers, signals have their default effect.
    let Ok(mut signals) = Signals::new(wanted) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            stackless_scene::abandon_writes();
            let _ = emulate_default_handler(signal);
        }
    });
}

/// A bit for each ignored signal, from Linux; 0 on other systems.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Does nothing: a temporary file may remain.
#[cfg(not(unix))]
pub(crate) fn watch() {}

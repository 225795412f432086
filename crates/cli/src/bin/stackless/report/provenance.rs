//! What made a page, where and when.

use std::fs;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::record;

/// The command line as a shell would take it.
pub(super) fn command_line(args: impl IntoIterator<Item = String>) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./,:=+@".contains(c);
    let quoted = |arg: String| {
        if !arg.is_empty() && arg.chars().all(is_plain) { arg } else { format!("'{}'", arg.replace('\'', "'\\''")) }
    };
    let mut args = args.into_iter();
    // Where the program lies says nothing to others.
    let program = args.next().map(|_| "stackless".to_owned());
    program.into_iter().chain(args.map(quoted)).collect::<Vec<_>>().join(" ")
}

/// Of the program, and the commit that it was built from where that is known.
pub(super) fn version() -> String {
    let version = concat!("stackless ", env!("CARGO_PKG_VERSION"));
    option_env!("STACKLESS_COMMIT").map_or_else(|| version.to_owned(), |commit| format!("{version}, commit {commit}"))
}

/// The machine of records, and its processor where the system tells it.
pub(super) fn machine() -> String {
    let model = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| model(&text));
    format!("{}, {}", record::machine(), model.unwrap_or_else(|| "processor not known".to_owned()))
}

/// The first processor's name in Linux's list.
fn model(cpuinfo: &str) -> Option<String> {
    let line = cpuinfo.lines().find_map(|line| line.strip_prefix("model name"))?;
    Some(line.trim_start_matches([' ', '\t', ':']).trim().to_owned()).filter(|name| !name.is_empty())
}

/// Now, in UTC.
pub(super) fn date() -> String {
    written(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()))
}

/// Seconds since 1970 as a date, in the Gregorian calendar.
fn written(seconds: u64) -> String {
    let (mut days, minutes) = (seconds / 86_400, seconds / 60 % 1440);
    let is_leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let mut month = 1;
    for length in [31, 28 + u64::from(is_leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02} {:02}:{:02} UTC", days + 1, minutes / 60, minutes % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(written(0), "1970-01-01 00:00 UTC");
        assert_eq!(written(951_782_399), "2000-02-28 23:59 UTC");
        assert_eq!(written(951_782_400), "2000-02-29 00:00 UTC");
        assert_eq!(written(1_798_761_599), "2026-12-31 23:59 UTC");
        assert_eq!(written(4_107_542_400), "2100-03-01 00:00 UTC");
    }

    #[test]
    fn a_command_line_can_be_run_again() {
        let args = ["/somewhere/stackless", "report", "a b.ply", "it's", "", "--build", "sah+2"];
        let expected = r"stackless report 'a b.ply' 'it'\''s' '' --build sah+2";
        assert_eq!(command_line(args.map(str::to_owned)), expected);
    }

    #[test]
    fn the_processor_has_a_name_where_linux_says_it() {
        assert_eq!(model("processor\t: 0\nmodel name\t: A B  @ 2\n").as_deref(), Some("A B  @ 2"));
        assert_eq!(model("processor\t: 0\n"), None);
    }
}

//! Runs a test program until its first failure, its limit, or its end.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use crate::copy::SWITCH;
use crate::layers::Job;

/// How a layer ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// All tests passed; their number.
    Passed(u32),
    /// The first failed test, or the exit status of a crashed program.
    Failed(String),
    /// The time limit was reached; the names are tests that had begun.
    TimedOut,
    /// The program used more than [`MOST_MEMORY`].
    OutOfMemory,
}

/// Bytes of memory that a program may use.
const MOST_MEMORY: u64 = 6 << 30;

/// The interval of checking time and memory.
const PERIOD: Duration = Duration::from_millis(100);

/// Runs a job with a bug (0: none). Returns the end and the seconds.
pub(crate) fn run(job: &Job<'_>, bug: usize, limit: Duration) -> std::io::Result<(End, f64)> {
    let began = Instant::now();
    let mut command = Command::new(job.program);
    command.args(&job.arguments).current_dir(job.folder).env(SWITCH, bug.to_string());
    // Cases are equal in each run, are not written to files, and are not shrunk.
    command.env("PROPTEST_RNG_SEED", "1").env("PROPTEST_MAX_SHRINK_ITERS", "0");
    command.env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true").env("RUST_BACKTRACE", "0");
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
    let (send, lines) = mpsc::channel();
    let output = child.stdout.take();
    // The thread ends with the program.
    thread::spawn(move || read_lines(output, &send));
    let end = watch(&mut child, &lines, began, limit);
    // The program may have ended before.
    let _ = child.kill();
    let status = child.wait()?;
    let end = match end {
        Some(end) => end,
        None => End::Failed(format!("the program ended with {status}")),
    };
    Ok((end, began.elapsed().as_secs_f64()))
}

fn read_lines(output: Option<impl Read>, send: &mpsc::Sender<String>) {
    for line in output.into_iter().flat_map(|output| BufReader::new(output).lines()).map_while(Result::ok) {
        if send.send(line).is_err() {
            return;
        }
    }
}

/// `None` if the output ends without a result.
fn watch(child: &mut Child, lines: &mpsc::Receiver<String>, began: Instant, limit: Duration) -> Option<End> {
    loop {
        match lines.recv_timeout(PERIOD) {
            Ok(line) => {
                if let Some(end) = meaning(&line) {
                    return Some(end);
                }
            }
            Err(mpsc::RecvTimeoutError::Disconnected) => return None,
            Err(mpsc::RecvTimeoutError::Timeout) => {}
        }
        if began.elapsed() > limit {
            return Some(End::TimedOut);
        }
        if memory(child.id()) > MOST_MEMORY {
            return Some(End::OutOfMemory);
        }
    }
}

/// The end of a test program according to a line of its output, if any.
fn meaning(line: &str) -> Option<End> {
    if let Some(test) = line.strip_prefix("test ").and_then(|line| line.strip_suffix(" ... FAILED")) {
        return Some(End::Failed(test.trim_end_matches(" - should panic").to_owned()));
    }
    let passed = line.strip_prefix("test result: ok. ")?.split(' ').next()?;
    Some(End::Passed(passed.parse().ok()?))
}

/// Resident bytes of a process; 0 if the system does not report them.
fn memory(process: u32) -> u64 {
    let pages = fs::read_to_string(format!("/proc/{process}/statm")).ok();
    let resident = pages.and_then(|text| text.split(' ').nth(1)?.parse::<u64>().ok());
    resident.unwrap_or(0) * 4096
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn shell(text: &str) -> End {
        let arguments = vec!["-c".to_owned(), text.to_owned()];
        let job = Job { program: Path::new("/bin/sh"), folder: Path::new("/"), arguments };
        run(&job, 7, Duration::from_millis(400)).unwrap().0
    }

    #[test]
    fn ends_are_told_apart() {
        assert_eq!(shell("echo test result: ok. 5 passed; 0 failed"), End::Passed(5));
        assert_eq!(shell("echo test a::b ... FAILED; exec sleep 60"), End::Failed("a::b".into()));
        assert_eq!(shell("test $STACKLESS_PLANTED = 7 && echo test c ... FAILED"), End::Failed("c".into()));
        assert_eq!(shell("exec sleep 60"), End::TimedOut);
        // No seeds are written: they would affect later bugs.
        let is_off = "test -n \"$PROPTEST_DISABLE_FAILURE_PERSISTENCE\" && echo test d ... FAILED";
        assert_eq!(shell(is_off), End::Failed("d".into()));
        assert_eq!(shell("exit 3"), End::Failed("the program ended with exit status: 3".into()));
    }
}

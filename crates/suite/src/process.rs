//! A program under test, with bounded waiting for its lines. Its processes end with the runner.

use std::io::{self, BufRead, BufReader, Read as _, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::thread;
use std::time::Duration;

use super::text::{Shown, read_line};

/// The maximum number of buffered lines. A program that writes more has to wait.
const HELD: usize = 4;

/// The result of waiting for a line.
#[derive(Debug)]
pub(super) enum Heard {
    Line(String),
    /// A line that is too long or not text.
    Garbage(String),
    /// The program has ended or closed its output.
    End,
    /// No line within the time limit.
    Silence,
}

/// A running program. Dropping it ends the program and its processes, by force if necessary.
#[derive(Debug)]
pub(super) struct Process {
    child: Child,
    /// Dropped after the program has ended.
    _group: Group,
    /// The channel to the writing thread; `None` when the program's input is closed.
    input: Option<Sender<String>>,
    output: Receiver<Heard>,
    /// The last line of standard error, received when it is closed; `None` if standard error is inherited.
    said: Option<Receiver<String>>,
}

impl Process {
    /// Starts a program. Its standard error is inherited, or its last line is stored.
    pub(super) fn start(command: &[String], passes_errors: bool) -> io::Result<Self> {
        let (program, arguments) =
            command.split_first().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "no command"))?;
        let group = Group::new()?;
        let mut command = Command::new(program);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
        command.stderr(if passes_errors { Stdio::inherit() } else { Stdio::piped() });
        let mut child = group.join(&mut command).spawn()?;
        let (input, to_write) = channel::<String>();
        let (heard, output) = sync_channel(HELD);
        // Separate threads, so a program that does not read, or writes unexpectedly, cannot block the runner.
        if let Some(mut stdin) = child.stdin.take() {
            thread::spawn(move || {
                for line in to_write {
                    if stdin.write_all(line.as_bytes()).and_then(|()| stdin.flush()).is_err() {
                        return;
                    }
                }
            });
        }
        if let Some(stdout) = child.stdout.take() {
            thread::spawn(move || listen(BufReader::new(stdout), &heard));
        }
        let said = child.stderr.take().map(|stderr| {
            let (tell, said) = channel();
            thread::spawn(move || tell.send(last_line(BufReader::new(stderr))));
            said
        });
        Ok(Self { child, _group: group, input: Some(input), output, said })
    }

    /// Queues a line for writing.
    pub(super) fn say(&self, line: String) {
        if let Some(input) = &self.input {
            // If the writer has ended, the program has ended, which `hear` reports.
            let _ = input.send(line + "\n");
        }
    }

    /// Waits for the next line.
    pub(super) fn hear(&self, within: Duration) -> Heard {
        match self.output.recv_timeout(within) {
            Ok(heard) => heard,
            Err(RecvTimeoutError::Timeout) => Heard::Silence,
            Err(RecvTimeoutError::Disconnected) => Heard::End,
        }
    }

    /// Closes the program's input.
    pub(super) fn close(&mut self) {
        self.input = None;
    }

    /// Ends the program. Returns its exit status and its last line of standard error.
    pub(super) fn end(mut self) -> String {
        let how = self.status();
        // The program's child processes may hold standard error open.
        let said = self.said.as_ref().and_then(|said| said.recv_timeout(Duration::from_millis(200)).ok());
        match said.filter(|line| !line.is_empty()) {
            Some(line) => format!("{how}; its standard error ends with: {}", Shown(line)),
            None => how,
        }
    }

    fn status(&mut self) -> String {
        // The output is closed. The program gets a short time to exit.
        for _ in 0..50 {
            match self.child.try_wait() {
                Ok(Some(status)) => return status.to_string(),
                Ok(None) => thread::sleep(Duration::from_millis(2)),
                Err(error) => return error.to_string(),
            }
        }
        "its output is closed".to_owned()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.input = None;
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A process group that ends with the runner, even after a crash. A shell in the group waits until its standard input,
/// whose other end only the runner holds, is closed, and then ends the group. Signals of a terminal do not reach the
/// group. A program that leaves the group (`setsid`) is not ended.
#[cfg(unix)]
#[derive(Debug)]
struct Group {
    shell: Child,
}

#[cfg(unix)]
impl Group {
    fn new() -> io::Result<Self> {
        use std::os::unix::process::CommandExt as _;
        let script = "trap '' HUP INT TERM; read -r line; kill -KILL 0";
        let mut shell = Command::new("/bin/sh");
        shell.args(["-c", script]).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
        Ok(Self { shell: shell.process_group(0).spawn()? })
    }

    fn join<'c>(&self, command: &'c mut Command) -> &'c mut Command {
        use std::os::unix::process::CommandExt as _;
        command.process_group(self.shell.id().cast_signed())
    }
}

#[cfg(unix)]
impl Drop for Group {
    fn drop(&mut self) {
        self.shell.stdin = None;
        let _ = self.shell.wait();
    }
}

/// On other systems, only the program is ended.
#[cfg(not(unix))]
#[derive(Debug)]
struct Group;

#[cfg(not(unix))]
impl Group {
    fn new() -> io::Result<Self> {
        Ok(Self)
    }

    fn join<'c>(&self, command: &'c mut Command) -> &'c mut Command {
        command
    }
}

/// Returns the last nonempty line, which is usually the reason. Reads to the end, so the program never waits for the
/// runner.
fn last_line(mut errors: impl BufRead) -> String {
    let (mut last, mut line) = (Vec::new(), Vec::new());
    loop {
        line.clear();
        // Very long lines are truncated.
        match errors.by_ref().take(1 << 12).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return String::from_utf8_lossy(&last).trim().to_owned(),
            Ok(_) if line.iter().all(u8::is_ascii_whitespace) => {}
            Ok(_) => last.clone_from(&line),
        }
    }
}

fn listen(mut output: impl BufRead, heard: &SyncSender<Heard>) {
    loop {
        let said = match read_line(&mut output) {
            Ok(Some(line)) => Heard::Line(line),
            Err(error) if error.kind() == io::ErrorKind::InvalidData => Heard::Garbage(error.to_string()),
            Ok(None) | Err(_) => Heard::End,
        };
        let is_end = matches!(said, Heard::End);
        if heard.send(said).is_err() || is_end {
            return;
        }
    }
}

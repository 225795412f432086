//! The command `lab`.

#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    stackless_cli::lab()
}

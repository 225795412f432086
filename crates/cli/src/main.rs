//! The command `stackless`.

#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    stackless_cli::stackless()
}

//! The command `stackless`.

fn main() -> std::process::ExitCode {
    stackless_cli::stackless()
}

//! The command `lab`.

fn main() -> std::process::ExitCode {
    stackless_cli::lab()
}

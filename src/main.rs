//! The command line of Eigenring: `eigenring help` teaches it by example.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}

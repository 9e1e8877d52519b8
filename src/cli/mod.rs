//! What does the user ask for?
//!
//! One file a command. Everything that is printed is printed here; exit status 0 means done, 1 that a check says no, 2 bad usage or
//! bad input.

mod analyze;
mod catalogue;
mod certify;
mod check;
mod claims;
mod curve;
mod grid;
mod matrix;
mod memory;
mod mesh_file;
mod open;
mod refine;
mod valences;
mod verify;

use clap::{Parser, Subcommand};
use eigenring::fault::Faults;
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

const EXAMPLES: &str = "Examples:
  eigenring analyze loop --valence 3..12           the report of Loop's scheme, under reports/loop/
  eigenring analyze my-scheme.toml --valence 3..50 the same for a scheme of your own
  eigenring schemes                                the schemes that come with the program
  eigenring schemes loop                           one of their files, ready to copy and edit
  eigenring claims                                 every claim of the literature: holds, fails, undecided
  eigenring certify loop                           what is proved for every valence at once
  eigenring check loop.json --scheme loop          a certificate of such a proof, checked again
  eigenring new my-scheme --like loop              start a scheme file
  eigenring matrix loop --valence 5 --block 1      a block of the local subdivision matrix
  eigenring refine loop in.obj -o out.ply -l 3     a mesh, refined three times
  eigenring limit loop in.obj -o out.ply           its vertices on the limit surface, with normals
  eigenring verify loop --valence 3..12            the masks against deep refinement
  eigenring analyze four-point --set w=1/16        a scheme for curves
  eigenring refine chaikin in.csv -o out.svg -l 5  a polygon

Exit status: 0 done, 1 a check says no (verify, claims, certify, check), 2 bad usage or bad input.";

/// Analyses subdivision schemes: local matrices at any valence, spectra, masks, characteristic maps, smoothness conditions.
#[derive(Parser)]
#[command(name = "eigenring", version, after_help = EXAMPLES, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Analyse a scheme and write its report
    Analyze(Box<analyze::Analyze>),
    /// List the schemes of the catalogue, or print the file of one
    Schemes(catalogue::Schemes),
    /// Hold every claim of the literature against the analysis
    Claims(claims::Claims),
    /// Prove what can be proved for every valence at once
    Certify(certify::Certify),
    /// Check a certificate of such a proof again, independently
    Check(check::Check),
    /// Start a scheme file of your own
    New(catalogue::New),
    /// Print the local subdivision matrix of a scheme, or a block of it
    Matrix(matrix::Matrix),
    /// Refine a mesh
    Refine(refine::Refine),
    /// Push the vertices of a mesh to the limit surface, with normals
    Limit(refine::Limit),
    /// Check the masks of a scheme against deep refinement of meshes
    Verify(Box<verify::Verify>),
}

/// Why a command could not be carried out.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Faults of a scheme file.
    Faults(Faults),
    /// Anything else, in words.
    Message(String),
    /// A check says no, and has said why.
    No,
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Failure::Faults(faults)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Faults(faults) => f.write_str(&faults.render(io::stderr().is_terminal())),
            Failure::Message(message) => write!(f, "error: {message}"),
            Failure::No => Ok(()),
        }
    }
}

/// A failure in words.
pub(crate) fn failure(message: impl Into<String>) -> Failure {
    Failure::Message(message.into())
}

/// Runs the program.
pub(crate) fn run() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        let _ = writeln!(io::stderr(), "error: an internal error, which should be reported: {panic}");
    }));
    let result = match Cli::parse().command {
        Command::Analyze(command) => command.run(),
        Command::Schemes(command) => command.run(),
        Command::Claims(command) => command.run(),
        Command::Certify(command) => command.run(),
        Command::Check(command) => command.run(),
        Command::New(command) => command.run(),
        Command::Matrix(command) => command.run(),
        Command::Refine(command) => command.run(),
        Command::Limit(command) => command.run(),
        Command::Verify(command) => command.run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::No) => ExitCode::from(1),
        Err(failure) => {
            let _ = writeln!(io::stderr(), "{failure}");
            ExitCode::from(2)
        }
    }
}

/// Says something on standard error, beside the result; that nobody listens is no fault.
pub(crate) fn say(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Prints to standard output; a reader that has gone away ends the printing quietly.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(failure(format!("standard output: {error}"))),
        _ => Ok(()),
    }
}

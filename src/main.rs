//! The command line of claimcheck; all of it is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    claimcheck::cli::main()
}

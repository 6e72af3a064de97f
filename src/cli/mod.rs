//! The command line: one file a subcommand, each thin.
//!
//! Exit codes: 0 everything as expected, 1 a verdict differs from what is expected (or a value cannot
//! be told), 2 a usage or input error, 3 an internal fault.

#[cfg(feature = "engine")]
mod chart;
#[cfg(feature = "engine")]
mod check;
#[cfg(feature = "engine")]
mod errata;
#[cfg(feature = "engine")]
mod eval;
mod explain;
#[cfg(feature = "engine")]
mod judging;
mod library;
mod output;
#[cfg(feature = "engine")]
mod probe;
#[cfg(feature = "engine")]
mod progress;
mod recheck;
#[cfg(feature = "engine")]
mod report;
#[cfg(feature = "engine")]
mod setting;
#[cfg(feature = "engine")]
mod simulate;

use clap::{Parser, Subcommand};
use output::{Exit, Failure};
use std::process::ExitCode;

/// Trees of formulas are walked by recursion, as deep as the parser allows.
const STACK_BYTES: usize = 64 << 20;

/// Checks the formulas of a paper: every claim gets a verdict that carries its evidence.
#[derive(Debug, Parser)]
#[command(name = "claimcheck", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[cfg(feature = "engine")]
    Check(check::Check),
    #[cfg(feature = "engine")]
    Eval(eval::Eval),
    Explain(explain::Explain),
    #[cfg(feature = "engine")]
    Errata(errata::Errata),
    #[cfg(feature = "engine")]
    Probe(probe::Probe),
    #[cfg(feature = "engine")]
    Report(report::Report),
    #[cfg(feature = "engine")]
    Simulate(simulate::Simulate),
    #[cfg(feature = "engine")]
    Chart(chart::Chart),
    Recheck(recheck::Recheck),
    /// A command that this build does not have.
    #[cfg(not(feature = "engine"))]
    #[command(external_subcommand)]
    Absent(Vec<String>),
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        output::error(&format!("internal fault: {panic}"), None)
    }));
    let work = std::thread::Builder::new()
        .stack_size(STACK_BYTES)
        .spawn(parse_and_run);
    let exit = match work.map(std::thread::JoinHandle::join) {
        Ok(Ok(exit)) => exit,
        // The hook has told what happened.
        Ok(Err(_)) => Exit::Internal,
        Err(error) => {
            output::error(&format!("a thread cannot be started: {error}"), None);
            Exit::Internal
        }
    };
    ExitCode::from(exit as u8)
}

fn parse_and_run() -> Exit {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => {
            // Help goes to stdout, errors to stderr; a closed pipe is no fault.
            let _ = message.print();
            return if message.use_stderr() {
                Exit::Input
            } else {
                Exit::AsExpected
            };
        }
    };
    match run(arguments.command) {
        Ok(exit) => exit,
        Err(failure) => {
            output::to_stderr(&failure.text);
            failure.exit
        }
    }
}

#[cfg(feature = "engine")]
fn run(command: Command) -> Result<Exit, Failure> {
    match command {
        Command::Check(check) => check.run(),
        Command::Eval(eval) => eval.run(),
        Command::Explain(explain) => explain.run(),
        Command::Errata(errata) => errata.run(),
        Command::Probe(probe) => probe.run(),
        Command::Report(report) => report.run(),
        Command::Simulate(simulate) => simulate.run(),
        Command::Chart(chart) => chart.run(),
        Command::Recheck(recheck) => recheck.run(),
    }
}

#[cfg(not(feature = "engine"))]
fn run(command: Command) -> Result<Exit, Failure> {
    match command {
        Command::Explain(explain) => explain.run(),
        Command::Recheck(recheck) => recheck.run(),
        Command::Absent(words) => Err(Failure::input(
            &format!(
                "this build has no command `{}`",
                words.first().map_or("", |word| word)
            ),
            Some("it was built without the feature `engine`; the other commands need it"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
